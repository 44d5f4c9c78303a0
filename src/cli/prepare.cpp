// SPDX-License-Identifier: Apache-2.0
#include "crowdface/job/prepare.h"

#include <memory>

#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/core/units.h"
#include "crowdface/job/pipeline.h"
#include "crowdface/smooth/level_size.h"

#include "cli/commands.h"
#include "cli/common_options.h"

namespace crowdface::cli {

namespace {

/// What the fitted levels were measured to miss, head by head.
void tell_errors(const Job& job, const Prepared& prepared) {
  const double mm = mm_per(job.config.faces.units);
  for (std::size_t h = 0; h < prepared.levels.size(); ++h) {
    const StoredLevels& levels = prepared.levels[h];
    log_info(concat(job.names.heads[h], ": ", levels.rank, " fields, error at most ",
                    format_fixed(levels.error.max * mm, 4), " mm (at ", levels.error.level,
                    " iterations), rms ", format_fixed(levels.error.rms * mm, 5), " mm"));
  }
}

}  // namespace

Run add_prepare(CLI::App& program) {
  struct Options {
    CommonOptions common;
    ConfigOptions config;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("prepare", "Smooth and fit the heads only, into the cache");
  options->config.add_to(*command);
  options->common.add_to(*command);
  return [options] {
    const auto threads = options->common.apply();
    const Job job = load_job(options->config.config, options->config.overrides);
    const Prepared prepared =
        prepare(job.config, job.inputs, job.smoothing, options->config.cache_path());
    const double size =
        size_of_iterations(job.smoothing.kind(), job.inputs.max_level, job.inputs.edge_length_mm);
    log_info(concat("L_max is ", job.inputs.max_level, " iterations, a size of ",
                    format_fixed(size, 1), " mm on edges of ",
                    format_fixed(job.inputs.edge_length_mm, 2), " mm"));
    if (job.config.smoothing.levels == Levels::kBasis) tell_errors(job, prepared);
  };
}

}  // namespace crowdface::cli
