// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/prepare.h"

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/core/units.h"
#include "crowdface/run/job.h"
#include "crowdface/smooth/level_size.h"

#include "cli/commands.h"
#include "cli/common_options.h"

namespace crowdface::cli {

namespace {

/// Logs for each head the measured error of the fitted smoothing levels.
void log_level_errors(const Job& job, const PreparedHeads& prepared) {
  const double mm = mm_per(job.config.faces.units);
  for (std::size_t h = 0; h < prepared.levels.size(); ++h) {
    const StoredLevels& levels = prepared.levels[h];
    log_info(concat(job.names.heads[h], ": ", levels.fields.rank, " fields, error at most ",
                    format_fixed(levels.error.max * mm, 4), " mm (at ", levels.error.level,
                    " iterations), rms ", format_fixed(levels.error.rms * mm, 5), " mm"));
  }
}

/// Throws an error if a prepared head could not be stored in the cache. Other commands can continue
/// without a cache, but filling the cache is the purpose of `prepare`.
void require_heads_in_cache(const PreparedHeads& prepared, const std::vector<std::string>& names,
                            const std::filesystem::path& cache) {
  for (std::size_t h = 0; h < names.size(); ++h) {
    if (prepared.levels[h].mapped_file) continue;
    throw IoError(
        concat(cache.string(), ": the cache does not contain the head ", names[h],
               " in prepared form; check that the folder is writable and has free space"));
  }
}

}  // namespace

CommandAction add_prepare(CLI::App& program) {
  struct Options : CommonOptions {
    ConfigOptions config;
    std::string shard;
  };
  return add_command<Options>(
      program, "prepare", "Smooth and fit the heads only, and store them in the cache",
      [](CLI::App& command, Options& options) {
        options.config.add_to(command);
        add_option(command, "--shard", options.shard, "I/N",
                   "Prepare only part I of N of the heads; other tasks prepare the other parts");
      },
      [](const Options& options) {
        const Shard shard = parse_shard_option(options.shard);
        const Job job = load_job(options.config.config_file, options.config.overrides,
                                 options.config.cache_path());
        const std::filesystem::path cache = options.config.cache_path();
        make_directories(cache);
        if (!shard.is_whole_crowd()) {
          return prepare_heads(job.config, job.inputs, job.smoothing, cache,
                               [&](std::size_t head) { return shard.owns(head); });
        }
        const PreparedHeads prepared = prepare(job.config, job.inputs, job.smoothing, cache);
        require_heads_in_cache(prepared, job.names.heads, cache);
        const double size = wavelength_of_iterations(job.smoothing.kind(), job.inputs.max_level,
                                                     job.inputs.edge_length_mm);
        log_info(concat("L_max is ", job.inputs.max_level, " iterations, a size of ",
                        format_fixed(size, 1), " mm on edges of ",
                        format_fixed(job.inputs.edge_length_mm, 2), " mm"));
        if (job.config.smoothing.levels == LevelRepresentation::kBasis)
          log_level_errors(job, prepared);
      });
}

}  // namespace crowdface::cli
