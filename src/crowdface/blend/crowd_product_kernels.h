// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "crowdface/smooth/field_tile.h"

namespace crowdface {

/// Values of a field that the product works on at a time, and faces it makes of them at a time: what
/// a processor's vector registers hold.
inline constexpr std::size_t kChunkValues = 32;
inline constexpr std::size_t kChunkFaces = 6;

/// Numbers of a field, times their step, into rows of kChunkValues floats, `stride` apart, from place `in_row` of the first
/// on. May write up to 15 floats past the end of a row.
void unpack(const std::int16_t* numbers, std::size_t count, float step, std::size_t in_row,
            float* row, std::size_t stride);

/// What a face has of a tile's fields in one region.
struct RegionSums {
  const float* coefficients;  ///< of each field
  float* sums;                ///< kTileValues, where vector loads can take them aligned
};

/// sums[i] += Σ_f coefficients[f]·numbers[f][i] in each region, for one face, in the order and rounding of
/// `add_product`, for i from begin to end; some before and after are added up, too.
/// \param numbers  a tile's: `fields` rows of kTileValues
/// \param regions  one or two: numbers are read once for both
/// \param ahead    of a tile whose turn comes soon: memory is asked for as many of its numbers.
void add_fields(const std::int16_t* numbers, std::size_t fields,
                std::span<const RegionSums> regions, std::size_t begin, std::size_t end,
                const std::int16_t* ahead);

/// sums[face][i] += alpha[i]·Σ_f coefficients[fields[f]][face]·chunk[fields[f]][i] (Eq. 7), the products added
/// in the order of f with one rounding a term.
/// \param chunk         #fields by kChunkValues
/// \param fields        `count` rows of it and of the coefficients
/// \param coefficients  #fields by kChunkFaces
/// \param alpha         kChunkValues
/// \param sums          kChunkFaces rows of kChunkValues, `stride` apart
void add_product(const float* chunk, const std::uint32_t* fields, std::size_t count,
                 const float* coefficients, const float* alpha, float* sums, std::size_t stride);

/// results[i] = base[i] + added[i] for `count` numbers, written past the caches: a crowd's faces are
/// far larger, and a cached store would read from memory what it is about to overwrite.
/// finish_writing() must follow on the same thread before another may read them.
void write_sums(const double* base, const float* added, std::size_t count, double* results);
void finish_writing();

}  // namespace crowdface
