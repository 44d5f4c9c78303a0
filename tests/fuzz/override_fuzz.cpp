// SPDX-License-Identifier: Apache-2.0
// --set KEY=VALUE, and the comparison with the config of a crowd's folder.
#include <cstdlib>
#include <string>

#include "crowdface/config/config_difference.h"
#include "crowdface/config/config_reader.h"

#include "fuzz/input_file.h"
#include "fuzz/job_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const crowdface::fuzz::JobFolder folder("override");
  static const std::string plain =
      "schema: 1\ncrowd: {name: mob, count: 3}\nfaces: {directory: heads, units: cm}\n";
  static const auto config_file = folder.write("crowd.yaml", plain);
  const std::string text(crowdface::fuzz::text_of(data, size));
  crowdface::ConfigOverrides overrides;
  overrides.assignments = {text};
  crowdface::Problems problems;
  const auto config = crowdface::read_config(config_file, overrides, problems);
  if (config.has_value() != problems.empty()) std::abort();
  crowdface::config_differences(text, plain);
  crowdface::number_in_config(text, "crowd.count");
  return 0;
}
