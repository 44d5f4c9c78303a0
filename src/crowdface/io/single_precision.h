// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// The number as every mesh format holds it: single precision, like the scans, and no negative
/// zero.
inline float to_single(double value) {
  const auto single = static_cast<float>(value);
  return single == 0 ? 0.0F : single;
}

/// No single-precision number is longer: "-1.17549435e-38".
inline constexpr std::size_t kLongestSingle = 15;
/// How much room write_single needs: it writes more than it means to keep.
inline constexpr std::size_t kSingleRoom = 24;

/// Writes the shortest text that reads back as the same single-precision number, the very text of
/// std::to_chars, to `out`, where there is room for kSingleRoom characters. \return where it ends.
char* write_single(char* out, double value);

/// Rows of three single-precision numbers each, as binary formats hold them.
/// \param bytes   where the first row begins.
/// \param stride  bytes from row to row.
Positions read_singles(const char* bytes, Index rows, std::size_t stride);

/// \param what  names the mesh in messages.
/// \throws InvalidInput unless there are `vertices` rows and all are finite in single precision.
void require_finite(const Positions& positions, Index vertices, const std::string& what);

}  // namespace crowdface
