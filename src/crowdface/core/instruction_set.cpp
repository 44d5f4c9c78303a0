// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/instruction_set.h"

#include <hwy/highway.h>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

struct Known {
  std::string_view name;
  std::int64_t target;
};
constexpr std::int64_t kPortable = 0;  // used when no other target is chosen
constexpr Known kKnown[] = {{"avx512", HWY_AVX3}, {"avx2", HWY_AVX2}, {"portable", kPortable}};

bool is_here(const Known& known) {
  return known.target == kPortable || (hwy::SupportedTargets() & known.target) != 0;
}

}  // namespace

std::vector<std::string> instruction_sets() {
  std::vector<std::string> names;
  for (const Known& known : kKnown) {
    if (is_here(known)) names.emplace_back(known.name);
  }
  return names;
}

void use_instruction_set(std::string_view name) {
  for (const Known& known : kKnown) {
    // Highway chooses the best target whose bit is set, or the portable target if no bit fits this
    // processor.
    if (known.name == name && is_here(known)) return hwy::GetChosenTarget().Update(known.target);
  }
  throw UsageError(concat("expected an instruction set of this machine (", join(instruction_sets()),
                          "), found ", quoted(name)));
}

}  // namespace crowdface
