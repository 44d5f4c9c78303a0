// SPDX-License-Identifier: Apache-2.0
// Ten new faces from a folder of heads, with pictures, contact sheet and report.
#include <fstream>
#include <iostream>

#include "crowdface/crowdface.h"

using namespace crowdface;

int main(int argc, char** argv) try {
  if (argc != 3) throw UsageError("usage: crowd_of_ten HEADS_DIR CROWD_DIR");
  const auto path = [](const char* name) {
    return write_scalar(std::filesystem::absolute(name).string());
  };
  const std::filesystem::path config = std::string(argv[2]) + ".yaml";
  std::ofstream(config) << "schema: 1\n"
                        << "crowd: {name: ten, count: 10}\n"
                        << "faces: {directory: " << path(argv[1]) << ", units: cm}\n"
                        << "output: {directory: " << path(argv[2]) << "}\n";
  generate(config, {}, {.cache = cache_directory()});

  const CrowdCheck check = verify_crowd(argv[2]);
  std::cout << argv[2] << ": " << check.files << " files, "
            << (check.good() ? "all whole" : "some damaged") << '\n';
} catch (const Error& error) {
  std::cerr << error.what() << '\n';
  return static_cast<int>(error.code());
}
