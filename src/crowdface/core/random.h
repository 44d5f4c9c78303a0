// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace crowdface {

/// The key of a random number. Random numbers are a pure function of a key and a lane. There is no
/// generator state, so the numbers of a face do not depend on the number of faces, the threads or
/// the shard, and adding a new purpose leaves the numbers of all other purposes unchanged.
/// Generator: Philox4x32-10 (Salmon et al. 2011, "Parallel random numbers: as easy as 1, 2, 3").
struct RandomKey {
  std::uint64_t seed = 0;
  std::uint64_t index = 0;        ///< index of the face or head that the random number is for
  std::string_view purpose = {};  ///< what the random number is used for, such as "position/top"
  std::uint32_t attempt = 0;      ///< number of rejected earlier samples for this face
};

/// Two independent uniform numbers in [0, 1). Both are multiples of 2⁻⁵³.
/// \param lane  number of the pair for this key; < 2¹⁶.
std::array<double, 2> random_pair(const RandomKey& key, std::uint32_t lane = 0);

/// The first number of `random_pair`.
double random_uniform(const RandomKey& key, std::uint32_t lane = 0);

/// A uniform number in [low, high).
double random_between(const RandomKey& key, double low, double high);

/// A uniform number in [0, 1), stratified over successive indices: [0, 1) is divided into `strata`
/// equal intervals, and the indices k·strata, …, k·strata + strata − 1 (for each k) have one number
/// in each interval.
double random_stratified(const RandomKey& key, std::uint64_t strata);

/// An approximately standard normal number: the sum of twelve uniform numbers minus 6, hence in
/// [−6, 6). It avoids log and cos of the C library, whose last bits differ between machines.
double random_normal(const RandomKey& key, std::uint32_t lane = 0);

}  // namespace crowdface
