// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "crowdface/cast/heads_at_samples.h"
#include "crowdface/traits/trait_limits.h"

namespace crowdface {

/// Measures faces from their recipes, without building meshes. A landmark depends on only a few
/// vertices. The positions of these vertices on a face are computed from the positions of the same
/// vertices on the input heads, before and after smoothing (see HeadsAtSamples).
class FaceMeasurer {
 public:
  /// A landmark as a point in a triangle of the mesh: the weighted mean of the triangle's three
  /// corners. All weights are zero if no measurement needs the landmark.
  struct Landmark {
    /// corners of the triangle, as indices of samples in HeadsAtSamples
    std::array<Index, 3> samples = {};
    std::array<double, 3> weights = {};  ///< weights (barycentric coordinates) of the corners
  };
  /// Computes the landmarks on the mesh that is written for a face, #landmarks by 3 in millimetres.
  /// Must be callable from any thread.
  using ExactLandmarks = std::function<Positions(const Recipe&)>;

  /// \param heads  the heads' data at the vertices on which the landmarks depend
  /// \param landmarks           one entry per landmark, in the order of trait_landmarks()
  /// \param head_distributions  distributions of the heads' measurements
  FaceMeasurer(HeadsAtSamples heads, std::vector<Landmark> landmarks,
               TraitDistributions head_distributions, ExactLandmarks exact_landmarks)
      : heads_(std::move(heads)),
        landmarks_(std::move(landmarks)),
        head_distributions_(std::move(head_distributions)),
        exact_landmarks_(std::move(exact_landmarks)) {}

  /// Computes the positions of a face's landmarks: #landmarks by 3, in millimetres. The computation
  /// takes microseconds. Ignores the correction of the gap between the lips (made after blending),
  /// which moves the skin around the mouth by fractions of a millimetre.
  Positions landmarks(const Recipe& recipe) const;
  /// Computes the positions of the landmarks on the mesh that is written for a recipe. Takes about
  /// a millisecond.
  Positions exact_landmarks(const Recipe& recipe) const { return exact_landmarks_(recipe); }

  const TraitDistributions& head_distributions() const { return head_distributions_; }
  /// Returns whether the measurements between the landmarks meet all limits.
  bool meets(const TraitLimits& limits, const Positions& landmarks) const;

 private:
  HeadsAtSamples heads_;  ///< data of the heads at the corners of the landmarks' triangles
  std::vector<Landmark> landmarks_;
  TraitDistributions head_distributions_;
  ExactLandmarks exact_landmarks_;
};

}  // namespace crowdface
