// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>

#include "crowdface/config/config_reader.h"

#include "fuzz/input_file.h"
#include "fuzz/job_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const crowdface::fuzz::JobFolder folder("review");
  static const auto config_file = folder.write(
      "crowd.yaml",
      "schema: 1\ncrowd: {name: mob, count: 3}\nfaces: {directory: heads, units: cm}\n"
      "regions: {names: [top, low], mask: mask.png}\n"
      "recipes: [{id: mine, target: bob, regions: {all: {weights: {ann: 1}, smoothness: 0.3}}}]\n"
      "families: [{name: smith, members: 2, target: ann}]\n");
  crowdface::ConfigOverrides overrides;
  overrides.review = {folder.write("marks.yaml", crowdface::fuzz::text_of(data, size)).string()};
  crowdface::Problems problems;
  const auto config = crowdface::read_config(config_file, overrides, problems);
  if (config.has_value() != problems.empty()) std::abort();
  return 0;
}
