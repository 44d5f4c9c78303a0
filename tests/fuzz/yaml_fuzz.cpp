// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>

#include "crowdface/core/error.h"
#include "crowdface/job/config_reader.h"
#include "crowdface/job/config_writer.h"

#include "fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const crowdface::fuzz::InputFile file(data, size);
  crowdface::Problems problems;
  const auto config = crowdface::read_config(file.path(), {}, problems);
  if (config.has_value() != problems.empty()) std::abort();
  return 0;
}
