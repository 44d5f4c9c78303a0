// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace crowdface {

/// to[i] = from[i]·scale, rounded to the nearest whole number, halves to even.
/// \param from  times scale from −32768 to 32767
void narrow(const float* from, std::size_t count, float scale, std::int16_t* to);

}  // namespace crowdface
