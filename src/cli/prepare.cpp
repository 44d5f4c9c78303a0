// SPDX-License-Identifier: Apache-2.0
#include "crowdface/job/prepare.h"

#include <memory>

#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/job/pipeline.h"
#include "crowdface/smooth/level_size.h"

#include "cli/commands.h"
#include "cli/common_options.h"

namespace crowdface::cli {

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
    prepare(job.config, job.inputs, job.smoothing, options->config.cache_path());
    const double size =
        size_of_iterations(job.smoothing.kind(), job.inputs.max_level, job.inputs.edge_length_mm);
    log_info(concat("L_max is ", job.inputs.max_level, " iterations, a size of ",
                    format_fixed(size, 1), " mm on edges of ",
                    format_fixed(job.inputs.edge_length_mm, 2), " mm"));
  };
}

}  // namespace crowdface::cli
