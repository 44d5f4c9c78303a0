// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/generate.h"

#include "cli/commands.h"
#include "cli/common_options.h"

namespace crowdface::cli {

CommandAction add_gather(CLI::App& program) {
  struct Options : CommonOptions {
    CacheOption cache;
    std::string directory;
  };
  return add_command<Options>(
      program, "gather",
      "After generate --shard: check all faces, then make the contact sheets and the report",
      [](CLI::App& command, Options& options) {
        add_option(command, "directory", options.directory, "CROWD_DIR", "The crowd's folder")
            .required();
        options.cache.add_to(command);
      },
      [](const Options& options) { gather(options.directory, options.cache.cache_path()); });
}

}  // namespace crowdface::cli
