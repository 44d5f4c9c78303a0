// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

namespace crowdface {

/// Where the samples of a pixel lie: fixed and evenly spread, the same for every pixel but for a
/// turn, so that what is left of noise makes no pattern.
struct SamplingPattern {
  std::vector<Eigen::Vector2f> places;  ///< #samples in [0, 1)²: antialiasing
  std::vector<Eigen::Vector2f> lamp;    ///< #samples in the unit disc: towards an area light
  std::vector<Eigen::Vector2f> sky;     ///< #samples · rays in the unit disc, sample by sample

  /// \param samples_per_side, sky_rays  at least 1 and 0.
  SamplingPattern(int samples_per_side, int sky_rays);
};

/// The turn of one pixel's discs: cosine and sine of an angle that differs most between neighbours
/// (Jimenez 2014, "Next generation post processing in Call of Duty: Advanced Warfare").
Eigen::Vector2f pixel_turn(int x, int y);

}  // namespace crowdface
