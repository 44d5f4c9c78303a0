// SPDX-License-Identifier: Apache-2.0

#include "crowdface/run/estimate.h"
#include "crowdface/run/generate.h"

#include "cli/commands.h"
#include "cli/common_options.h"

namespace crowdface::cli {

CommandAction add_plan(CLI::App& program) {
  struct Options : CommonOptions {
    ConfigOptions config;
    WriteOptions write;
    bool estimate = false;
  };
  return add_command<Options>(
      program, "plan", "Plan the crowd only: write plan.jsonl and crowd.csv, but no meshes",
      [](CLI::App& command, Options& options) {
        options.config.add_to(command);
        options.config.add_review_to(command);
        options.config.add_without_reviews_to(command);
        options.write.add_to(command);
        add_flag(command, "--estimate", options.estimate,
                 "Make no plan; estimate how many faces these heads allow at each minimum distance")
            .excludes({"--dry-run", "--force", "--memory"});
      },
      [](const Options& options) {
        const ConfigOptions& job = options.config;
        const std::filesystem::path cache = options.config.cache_path();
        if (options.estimate) {
          print(estimate(job.config_file, job.overrides, cache));
        } else {
          plan(job.config_file, job.overrides, options.write.generate_options(cache));
        }
      });
}

}  // namespace crowdface::cli
