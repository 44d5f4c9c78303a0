// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "crowdface/heads/head_cache.h"
#include "crowdface/run/generate.h"

#include "cli/commands.h"
#include "cli/common_options.h"

namespace crowdface::cli {

Run add_gather(CLI::App& program) {
  struct Options {
    CommonOptions common;
    std::string directory, cache;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "gather", "After generate --shard: checks all faces, then makes sheets and report");
  command->add_option("directory", options->directory, "The crowd's folder")
      ->required()
      ->type_name("CROWD_DIR");
  command->add_option("--cache", options->cache, "Folder of prepared heads")->type_name("DIR");
  options->common.add_to(*command);
  return [options] {
    const auto threads = options->common.apply();
    gather(options->directory,
           options->cache.empty() ? cache_directory() : std::filesystem::path(options->cache));
  };
}

}  // namespace crowdface::cli
