// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>

#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/head_cache.h"

#include "cli/commands.h"
#include "cli/common_options.h"

namespace crowdface::cli {

Run add_cache(CLI::App& program) {
  struct Options {
    CommonOptions common;
    std::string cache;
    bool clear = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("cache", "Where prepared heads are kept, and what is there");
  command->add_option("--cache", options->cache, "Another folder than the default")
      ->type_name("DIR");
  command->add_flag("--clear", options->clear, "Remove all entries");
  options->common.add_to(*command);
  return [options] {
    const auto threads = options->common.apply();
    const std::filesystem::path folder =
        options->cache.empty() ? cache_directory() : std::filesystem::path(options->cache);
    if (options->clear) {
      log_info(concat(clear_cache(folder), " entries removed from ", folder.string()));
      return;
    }
    const CacheContents contents = list_cache(folder);
    std::cout << concat(folder.string(), "\n", contents.entries.size(), " prepared heads, ",
                        format_fixed(static_cast<double>(contents.bytes) / 1e6, 1), " MB\n");
  };
}

}  // namespace crowdface::cli
