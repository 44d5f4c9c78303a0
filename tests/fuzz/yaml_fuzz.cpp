// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>

#include "crowdface/config/config_reader.h"

#include "fuzz/input_file.h"
#include "fuzz/job_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const crowdface::fuzz::JobFolder folder("yaml");
  const auto file = folder.write("crowd.yaml", crowdface::fuzz::text_of(data, size));
  crowdface::Problems problems;
  const auto config = crowdface::read_config(file, {}, problems);
  if (config.has_value() != problems.empty()) std::abort();
  return 0;
}
