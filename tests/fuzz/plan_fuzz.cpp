// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/error.h"
#include "crowdface/crowd/plan_file.h"

#include "fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const crowdface::PlanNames names = {{"ann", "bob", "cyd"}, {"all"}};
  try {
    const crowdface::fuzz::InputFile file(data, size);
    for (const auto& line : crowdface::read_plan(file.path(), names)) {
      crowdface::format_plan_line(line.face, names, {});
    }
  } catch (const crowdface::Error&) {
  }
  return 0;
}
