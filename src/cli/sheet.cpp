// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "crowdface/run/crowd_sheets.h"

#include "cli/commands.h"
#include "cli/common_options.h"

namespace crowdface::cli {

Run add_sheet(CLI::App& program) {
  struct Options {
    CommonOptions common;
    std::string directory, cache;
    std::vector<std::string> set;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "sheet", "The contact sheets of a finished crowd again, from its meshes");
  command->add_option("directory", options->directory, "The crowd's folder")
      ->required()
      ->type_name("CROWD_DIR");
  command
      ->add_option("--set", options->set,
                   "Change the sheet, such as output.contact_sheet.columns=8; may be repeated")
      ->type_name("KEY.PATH=VALUE")
      ->expected(1)
      ->take_all();
  command->add_option("--cache", options->cache, "Folder of prepared heads")->type_name("DIR");
  options->common.add_to(*command);
  return [options] {
    const auto threads = options->common.apply();
    remake_sheets(
        options->directory, options->set,
        options->cache.empty() ? cache_directory() : std::filesystem::path(options->cache));
  };
}

}  // namespace crowdface::cli
