// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/crowd_sheets.h"

#include "cli/commands.h"
#include "cli/common_options.h"

namespace crowdface::cli {

CommandAction add_sheet(CLI::App& program) {
  struct Options : CommonOptions {
    CacheOption cache;
    std::string directory;
    std::vector<std::string> set;
  };
  return add_command<Options>(
      program, "sheet", "Render the contact sheets of a finished crowd again from its meshes",
      [](CLI::App& command, Options& options) {
        add_option(command, "directory", options.directory, "CROWD_DIR", "The crowd's folder")
            .required();
        add_repeated(command, "--set", options.set, "KEY.PATH=VALUE",
                     "Override a value of the sheet, such as output.contact_sheet.columns=8");
        options.cache.add_to(command);
      },
      [](const Options& options) {
        remake_sheets(options.directory, options.set, options.cache.cache_path());
      });
}

}  // namespace crowdface::cli
