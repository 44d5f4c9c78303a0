// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace crowdface {

/// The instruction sets that the vector kernels have code for and that this processor has, best
/// first: of "avx512", "avx2" and "portable". All give the same bits.
std::vector<std::string> instruction_sets();

/// Makes the kernels use this one from now on; for tests, and to find out what is to blame.
/// \throws UsageError if it is none of `instruction_sets`.
void use_instruction_set(std::string_view name);

}  // namespace crowdface
