// SPDX-License-Identifier: Apache-2.0

#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/cache_folder.h"

#include "cli/commands.h"
#include "cli/common_options.h"

namespace crowdface::cli {

CommandAction add_cache(CLI::App& program) {
  struct Options : CommonOptions {
    CacheOption cache;
    bool clear = false;
  };
  return add_command<Options>(
      program, "cache", "Show the folder and the contents of the head cache, or clear the cache",
      [](CLI::App& command, Options& options) {
        options.cache.add_to(command);
        add_flag(command, "--clear", options.clear, "Remove all entries");
      },
      [](const Options& options) {
        const std::filesystem::path folder = options.cache.cache_path();
        if (options.clear) {
          log_info(concat(clear_cache(folder), " entries removed from ", folder.string()));
          return;
        }
        const CacheContents contents = list_cache(folder);
        print(concat(folder.string(), "\n", contents.prepared_head_count, " prepared heads, ",
                     contents.loaded_head_count, " loaded heads, ",
                     format_fixed(static_cast<double>(contents.bytes) / 1e6, 1), " MB\n"));
      });
}

}  // namespace crowdface::cli
