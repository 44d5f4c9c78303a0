// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace crowdface {

/// Randomness as a pure function of (seed, index, purpose, attempt, lane): nothing is drawn in
/// order, so a face keeps its numbers whatever the count, the threads or the shard, and a purpose
/// added later disturbs no other. Philox4x32-10 (Salmon et al. 2011, "Parallel random numbers: as
/// easy as 1, 2, 3").
struct RandomKey {
  std::uint64_t seed = 0;
  std::uint64_t index = 0;        ///< which face or head
  std::string_view purpose = {};  ///< what for, such as "position/top"
  std::uint32_t attempt = 0;      ///< how many draws of this face were thrown away before
};

/// Two independent numbers in [0, 1), multiples of 2⁻⁵³. `lane` (< 2¹⁶) numbers the pairs of one
/// key.
std::array<double, 2> random_pair(const RandomKey& key, std::uint32_t lane = 0);

/// The first number of `random_pair`.
double random_unit(const RandomKey& key, std::uint32_t lane = 0);

/// Uniform in [low, high).
double random_between(const RandomKey& key, double low, double high);

/// Uniform in [0, 1), evenly spread over successive indices: of each run of `strata` of them that
/// begins at a multiple of `strata`, one number lies in each of as many equal parts.
double random_stratified(const RandomKey& key, std::uint64_t strata);

/// Approximately standard normal (sum of twelve uniforms less six, cut at ±6): free of the C
/// library's log and cos, whose last bits differ between machines.
double random_normal(const RandomKey& key, std::uint32_t lane = 0);

}  // namespace crowdface
