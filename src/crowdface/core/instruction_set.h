// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace crowdface {

/// The instruction sets for which the kernels have code and which this processor supports, best
/// first: a subset of "avx512", "avx2", "portable". Results are bitwise equal with each of these
/// instruction sets.
std::vector<std::string> instruction_sets();

/// Makes the kernels use this instruction set from now on. Meant for tests and for tracking down
/// errors.
/// \throws UsageError if `name` is not one of `instruction_sets()`.
void use_instruction_set(std::string_view name);

}  // namespace crowdface
