// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/lattice.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <numeric>

namespace crowdface::synth {
namespace {

// Width of each lattice interval, in lattice units (see lattice.h).
constexpr std::array<double, kColumns - 1> kColumnWeights = {2, 3, 4, 5, 4, 5, 6, 5, 4, 5, 4, 3, 2};
constexpr std::array<double, kRows - 1> kRowWeights = {4, 4, 7, 3, 3, 2, 5, 3, 3, 5, 5};

constexpr std::array<Opening, 4> kOpenings = {{{SkinPatch::kEye, 2, 4, 2, 3},
                                               {SkinPatch::kNostril, 1, 2, 4, 5},
                                               {SkinPatch::kMouth, -3, 3, 6, 7},
                                               {SkinPatch::kEar, 6, 7, 2, 5}}};

}  // namespace

double column_distance(int column) {
  const auto first = kColumnWeights.begin();
  const double sum = std::accumulate(first, first + std::abs(column), 0.0);
  return column < 0 ? -sum : sum;
}

double row_distance(int row) {
  return std::accumulate(kRowWeights.begin(), kRowWeights.begin() + row, 0.0);
}

const Opening& opening_of(SkinPatch patch) {
  for (const Opening& opening : kOpenings) {
    if (opening.patch == patch) return opening;
  }
  return kOpenings.back();
}

std::span<const Opening> openings() {
  return kOpenings;
}

}  // namespace crowdface::synth
