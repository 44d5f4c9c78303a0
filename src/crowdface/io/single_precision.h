// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <cstddef>
#include <string>

#include "crowdface/io/little_endian.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// size in bytes of three single-precision numbers
inline constexpr std::size_t kVectorSize = 3 * sizeof(float);
/// Number of rows in the block that a thread encodes at a time.
inline constexpr Index kRowsPerBlock = 1 << 15;

/// Rounds a number as every mesh format stores it: to single precision, without negative zero.
inline float to_single(double value) {
  const auto single = static_cast<float>(value);
  return single == 0 ? 0.0F : single;
}

/// Length of the longest text that `write_single` writes, such as "-1.17549435e-38".
inline constexpr std::size_t kMaxFloatTextLength = 15;

/// Writes the shortest text that reads back as the same single-precision number. `out` needs room
/// for kMaxFloatTextLength characters.
/// \return the end of the output.
inline char* write_single(char* out, double value) {
  return std::to_chars(out, out + kMaxFloatTextLength, to_single(value)).ptr;
}

/// Rounds positions as every mesh format stores them. Results computed from the rounded positions
/// equal results computed from positions that were written to a file and read again.
Positions round_to_single(const Positions& positions);

/// Writes the three numbers of a row in binary.
/// \return the end of the output.
inline char* put_row(char* out, const Positions& rows, Index i) {
  for (Index c = 0; c < 3; ++c) out = put_number(out, to_single(rows(i, c)));
  return out;
}

/// Reads rows of three single-precision numbers.
/// \param bytes  start of the first row.
/// \param stride  distance in bytes between the starts of consecutive rows.
/// \param what  names the mesh in messages.
/// \throws InvalidInput if a number is not finite.
Positions read_singles(const char* bytes, Index rows, std::size_t stride, const std::string& what);

/// Checks, before positions are written, the number of rows and whether all numbers are finite.
/// \param what  names the mesh in messages.
/// \throws BrokenPrecondition unless there are `vertices` rows; InvalidInput unless all numbers are
/// finite in single precision.
void require_finite(const Positions& positions, Index vertices, const std::string& what);

}  // namespace crowdface
