// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace crowdface {

/// Values of a field that the product works on at a time, and faces it makes of them at a time: what
/// a processor's vector registers hold.
inline constexpr std::size_t kChunkValues = 32;
inline constexpr std::size_t kChunkFaces = 6;

/// products[face][i] = Σ_f coefficients[f][face]·chunk[fields[f]][i], added in the order of f with
/// one rounding a term.
/// \param chunk         #fields by kChunkValues
/// \param fields        `count` rows of it
/// \param coefficients  `count` by kChunkFaces
/// \param products      kChunkFaces by kChunkValues, overwritten
void multiply_chunk(const float* chunk, const std::uint32_t* fields, std::size_t count,
                    const float* coefficients, float* products);

}  // namespace crowdface
