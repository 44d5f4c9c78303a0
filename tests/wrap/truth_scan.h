// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/mesh/alignment.h"
#include "crowdface/wrap/scan.h"
#include "crowdface/wrap/shape_fit.h"
#include "crowdface/wrap/wrap_template.h"

namespace crowdface::testing {

struct TruthOptions {
  std::size_t triangles = 120000;  ///< about
  double noise_mm = 0.2;           ///< along the normal, one standard deviation
  int holes = 7;
  double hole_radius_mm = 9;
  double landmark_error_mm = 1;  ///< along each axis, one standard deviation
  bool moved = true;             ///< turned, moved and rescaled
  bool fused = false;            ///< one surface, as scanners make: eyeballs are not separate
  std::uint64_t seed = 1;
};

/// A scan of a head whose every vertex is known.
struct TruthScan {
  Scan scan;
  Similarity pose;                      ///< from the head to the scan
  std::vector<WrapLandmark> landmarks;  ///< rows of the head; places on the scan, as picked
};

/// Turns a head into what a scanner would make of it: only what can be seen from outside (eyeballs
/// too), about so many triangles that have nothing to do with the head's own, noise, holes, some place
/// in space; landmarks picked by a hand that errs. The same for the same seed on every machine.
/// \param landmarks  names and rows of the head.
TruthScan make_truth_scan(const WrapTemplate& head, const std::vector<WrapLandmark>& landmarks,
                          const TruthOptions& options = {});

}  // namespace crowdface::testing
