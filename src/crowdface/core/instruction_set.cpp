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
    // Set the mask of allowed targets to the one bit `known.target`. Highway then chooses this
    // target, or the portable target if the bit fits no target that this processor supports.
    if (known.name == name && is_here(known)) return hwy::GetChosenTarget().Update(known.target);
  }
  throw UsageError(concat("expected an instruction set of this machine (", join(instruction_sets()),
                          "), found ", quoted(name)));
}

}  // namespace crowdface
