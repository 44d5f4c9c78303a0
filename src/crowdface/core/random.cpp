// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/random.h"

#include <Random123/philox.h>

#include "crowdface/core/hash.h"

namespace crowdface {
namespace {

double to_unit(std::uint32_t high, std::uint32_t low) {
  const std::uint64_t bits = (std::uint64_t{high} << 32 | low) >> 11;
  return static_cast<double>(bits) * 0x1p-53;
}

}  // namespace

std::array<double, 2> random_pair(const RandomKey& key, std::uint32_t lane) {
  // The generator's counter has 128 bits: 64 for the index, and 64 for a mix of purpose, attempt
  // and lane.
  const std::uint64_t purpose = hash_bytes(key.purpose).low;
  const std::uint64_t attempt = std::uint64_t{key.attempt} << 16 | (lane & 0xffffU);
  const std::uint64_t mixed = purpose ^ attempt * 0x9E3779B97F4A7C15ULL;
  const philox4x32_ctr_t counter = {
      {static_cast<std::uint32_t>(key.index), static_cast<std::uint32_t>(key.index >> 32),
       static_cast<std::uint32_t>(mixed), static_cast<std::uint32_t>(mixed >> 32)}};
  const philox4x32_key_t philox_key = {
      {static_cast<std::uint32_t>(key.seed), static_cast<std::uint32_t>(key.seed >> 32)}};
  const philox4x32_ctr_t bits = philox4x32(counter, philox_key);
  return {to_unit(bits[0], bits[1]), to_unit(bits[2], bits[3])};
}

double random_uniform(const RandomKey& key, std::uint32_t lane) {
  return random_pair(key, lane)[0];
}

double random_between(const RandomKey& key, double low, double high) {
  return low + (high - low) * random_uniform(key);
}

double random_stratified(const RandomKey& key, std::uint64_t strata) {
  // [0, 1) is divided into `strata` equal intervals. A run is the sequence of the indices k·strata,
  // …, k·strata + strata − 1 for one k. Each index of a run gets a number in a different interval:
  // the first index in a random interval, and each further index in the next interval or, in half
  // of the runs, in the previous interval. The lane kStrataLane gives the two random numbers that
  // determine this order.
  constexpr std::uint32_t kStrataLane = 0x5A17;
  const RandomKey run{key.seed, key.index / strata, key.purpose, key.attempt};
  const auto [place, direction] = random_pair(run, kStrataLane);
  const auto count = static_cast<double>(strata);
  const std::uint64_t at = key.index % strata;
  const std::uint64_t step = direction < 0.5 ? at : strata - at;
  const std::uint64_t part = (static_cast<std::uint64_t>(place * count) + step) % strata;
  return (static_cast<double>(part) + random_uniform(key)) / count;
}

double random_normal(const RandomKey& key, std::uint32_t lane) {
  double sum = -6;
  for (std::uint32_t i = 0; i < 6; ++i) {
    const auto pair = random_pair(key, lane * 6 + i);
    sum += pair[0] + pair[1];
  }
  return sum;
}

}  // namespace crowdface
