// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/generate.h"

#include "cli/commands.h"
#include "cli/common_options.h"

namespace crowdface::cli {

CommandAction add_generate(CLI::App& program) {
  struct Options : CommonOptions {
    ConfigOptions config;
    WriteOptions write;
  };
  return add_command<Options>(
      program, "generate", "Run the whole job: prepare, plan, blend, write, render, report",
      [](CLI::App& command, Options& options) {
        options.config.add_to(command);
        options.config.add_review_to(command);
        options.config.add_without_reviews_to(command);
        options.write.add_to(command);
        options.write.add_shard_to(command);
      },
      [](const Options& options) {
        generate(options.config.config_file, options.config.overrides,
                 options.write.generate_options(options.config.cache_path()));
      });
}

}  // namespace crowdface::cli
