// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <cstddef>
#include <string>

#include "crowdface/io/little_endian.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

inline constexpr std::size_t kVectorSize = 3 * sizeof(float);  ///< of three numbers, bytes
inline constexpr Index kRowsPerBlock = 1 << 15;                ///< that a thread encodes at a time

/// The number as every mesh format holds it: single precision, like the scans, and no negative
/// zero.
inline float to_single(double value) {
  const auto single = static_cast<float>(value);
  return single == 0 ? 0.0F : single;
}

/// No text of a single-precision number is longer: "-1.17549435e-38".
inline constexpr std::size_t kLongestSingle = 15;

/// Writes the shortest text that reads back as the same single-precision number to `out`, where there is room
/// for kLongestSingle characters. \return where it ends.
inline char* write_single(char* out, double value) {
  return std::to_chars(out, out + kLongestSingle, to_single(value)).ptr;
}

/// Positions as every mesh format holds them: what is made from these is the same from a file.
Positions as_written(const Positions& positions);

/// Writes a row's three numbers as binary formats hold them. \return where they end.
inline char* put_row(char* out, const Positions& rows, Index i) {
  for (Index c = 0; c < 3; ++c) out = put_number(out, to_single(rows(i, c)));
  return out;
}

/// Rows of three single-precision numbers each, as binary formats hold them.
/// \param bytes   where the first row begins.
/// \param stride  bytes from row to row.
/// \param what    names the mesh in messages.
/// \throws InvalidInput if one is not finite.
Positions read_singles(const char* bytes, Index rows, std::size_t stride, const std::string& what);

/// \param what  names the mesh in messages.
/// \throws BrokenPrecondition unless there are `vertices` rows; InvalidInput unless all are finite in
/// single precision.
void require_finite(const Positions& positions, Index vertices, const std::string& what);

}  // namespace crowdface
