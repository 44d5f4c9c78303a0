// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>

#include "crowdface/run/estimate.h"
#include "crowdface/run/generate.h"

#include "cli/commands.h"
#include "cli/common_options.h"

namespace crowdface::cli {

Run add_plan(CLI::App& program) {
  struct Options {
    CommonOptions common;
    ConfigOptions config;
    WriteOptions write;
    bool estimate = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("plan", "Cast the crowd only: plan.jsonl and crowd.csv, no meshes");
  options->config.add_to(*command);
  options->config.add_review_to(*command);
  options->write.add_to(*command);
  command
      ->add_flag("--estimate", options->estimate,
                 "Cast nothing: how many faces these heads hold at which distance")
      ->excludes("--dry-run", "--force", "--memory");
  options->common.add_to(*command);
  return [options] {
    const auto threads = options->common.apply();
    if (options->estimate) {
      std::cout << estimate(options->config.config, options->config.overrides,
                            options->config.cache_path());
      return;
    }
    plan(options->config.config, options->config.overrides,
         options->write.with_cache(options->config.cache_path()));
  };
}

}  // namespace crowdface::cli
