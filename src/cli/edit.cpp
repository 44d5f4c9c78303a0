// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/edit.h"

#include "cli/commands.h"
#include "cli/common_options.h"

namespace crowdface::cli {
namespace {

struct EditorOptions : CommonOptions {
  ConfigOptions config;
  std::string port = "0", preview_vertices = "50000";
  bool no_browser = false, benchmark = false, hash_all = false;
};

void declare_edit(CLI::App& command, EditorOptions& options) {
  options.config.add_to(command);
  add_option(command, "--port", options.port, "N",
             "The port to serve on at 127.0.0.1; 0: any free port");
  add_option(command, "--preview-vertices", options.preview_vertices, "N",
             "Approximate maximum number of vertices in the preview");
  add_flag(command, "--benchmark", options.benchmark,
           "Start no server; print how long full faces take after a change");
  add_flag(command, "--hash-all", options.hash_all,
           "Read all head files and cache entries in full, even if they have not changed");
  add_flag(command, "--no-browser", options.no_browser, "Print the address, but open no browser");
}

void edit(const EditorOptions& options) {
  constexpr std::uint64_t kLargestPort = 65535, kMaxVertices = 10'000'000;
  EditOptions edited;
  edited.cache = options.config.cache_path();
  edited.cache.skips_hash_of_unchanged_files = !options.hash_all;
  edited.generate_arguments = options.input_limit_arguments();
  if (!options.threads.empty()) {
    edited.generate_arguments.insert(edited.generate_arguments.end(),
                                     {"--threads", options.threads});
  }
  edited.port = static_cast<int>(parse_whole_number("--port", options.port, 0, kLargestPort));
  edited.preview_vertices =
      parse_whole_number("--preview-vertices", options.preview_vertices, 100, kMaxVertices);
  if (options.benchmark) {
    print(benchmark_edit(options.config.config_file, options.config.overrides, edited));
    return;
  }
  crowdface::edit(options.config.config_file, options.config.overrides, edited,
                  [&](const std::string& address) {
                    show_page(address, options.no_browser ? Browser::kNone : Browser::kOpen);
                  });
}

}  // namespace

CommandAction add_edit(CLI::App& program) {
  return add_command(program, "edit", "Edit faces by hand on a page in this machine's browser",
                     declare_edit, edit);
}

}  // namespace crowdface::cli
