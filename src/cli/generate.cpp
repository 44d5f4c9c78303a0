// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/generate.h"

#include <memory>

#include "cli/commands.h"
#include "cli/common_options.h"

namespace crowdface::cli {

Run add_generate(CLI::App& program) {
  struct Options {
    CommonOptions common;
    ConfigOptions config;
    WriteOptions write;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "generate", "The whole job: prepare, cast, blend, write, render, report");
  options->config.add_to(*command);
  options->config.add_review_to(*command);
  options->write.add_to(*command);
  options->write.add_shard_to(*command);
  options->common.add_to(*command);
  return [options] {
    const auto threads = options->common.apply();
    generate(options->config.config, options->config.overrides,
             options->write.with_cache(options->config.cache_path()));
  };
}

}  // namespace crowdface::cli
