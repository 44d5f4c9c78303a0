// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>
#include <fstream>

#include "crowdface/job/config_reader.h"

#include "fuzz/input_file.h"

namespace {

/// A good config and its heads, made once.
const std::filesystem::path& config_file() {
  static const std::filesystem::path file = [] {
    const auto folder = std::filesystem::temp_directory_path() / "crowdface_fuzz_review";
    std::filesystem::create_directories(folder / "heads");
    for (const char* head : {"ann", "bob"}) {
      std::ofstream(folder / "heads" / (std::string(head) + ".obj")) << "v 0 0 0\n";
    }
    std::ofstream(folder / "crowd.yaml") << "schema: 1\ncrowd: {name: mob, count: 3}\n"
                                            "faces: {directory: heads, units: cm}\n";
    return folder / "crowd.yaml";
  }();
  return file;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const crowdface::fuzz::InputFile review(data, size);
  crowdface::ConfigOverrides overrides;
  overrides.review = {review.path().string()};
  crowdface::Problems problems;
  const auto config = crowdface::read_config(config_file(), overrides, problems);
  if (config.has_value() != problems.empty()) std::abort();
  return 0;
}
