// SPDX-License-Identifier: Apache-2.0
// For the readers of configs and reviews: what a config may name.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <unistd.h>

namespace crowdface::fuzz {

/// A folder with heads, an empty wardrobe, a mask and a review, and room for one more file.
class JobFolder {
 public:
  explicit JobFolder(const std::string& name)
      : folder_(std::filesystem::temp_directory_path() /
                ("crowdface_fuzz_" + name + std::to_string(::getpid()))) {
    for (const char* folder : {"heads", "wardrobe"}) {
      std::filesystem::create_directories(folder_ / folder);
    }
    for (const char* head : {"ann", "bob", "cyd"}) {
      write(std::string("heads/") + head + ".obj", "v 0 0 0\n");
    }
    write("mask.png", "");
    write("review.yaml", "schema: 1\nfaces: {mob_0001: reject}\n");
  }

  std::filesystem::path write(const std::string& name, std::string_view bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }

 private:
  std::filesystem::path folder_;
};

}  // namespace crowdface::fuzz
