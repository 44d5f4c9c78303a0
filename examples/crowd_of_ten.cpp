// SPDX-License-Identifier: Apache-2.0
// Ten new faces from a folder of heads, with pictures, contact sheet and report.
#include <iostream>

#include "crowdface/crowdface.h"

using namespace crowdface;

int main(int argc, char** argv) try {
  if (argc != 3) throw UsageError("usage: crowd_of_ten HEADS_DIR CROWD_DIR");
  // Paths in the text are relative to the folder of the file that it might be from.
  Problems problems;
  Config config = read_config_text(
                      "schema: 1\n"
                      "crowd: {name: ten, count: 10}\n"
                      "faces: {directory: ., units: cm}\n",
                      std::filesystem::path(argv[1]) / "ten.yaml", {}, problems)
                      .config;
  problems.throw_if_any();
  config.output.directory = argv[2];
  generate(config, {.cache = cache_directory()});

  const CrowdCheck check = verify_crowd(argv[2]);
  std::cout << argv[2] << ": " << check.file_count << " files, "
            << (check.is_intact() ? "all whole" : "some damaged") << '\n';
} catch (const Error& error) {
  std::cerr << error.what() << '\n';
  return static_cast<int>(error.code());
}
