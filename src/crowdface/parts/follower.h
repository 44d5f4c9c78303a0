// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "crowdface/mesh/topology.h"
#include "crowdface/parts/eye_socket.h"
#include "crowdface/parts/part_list.h"
#include "crowdface/parts/part_options.h"

namespace crowdface {

/// Lets the parts of a head go along with its skin after blending. How they hang on the skin is found
/// once, on the mean head, and measured once on each head (docs/parts.md says what a face then costs).
///
/// - A rigid part moves by the best rotation, translation and uniform scale that carries the skin
///   around it from the target to the result; an eyeball is then shifted until its gaps to the
///   lids are what they were.
/// - A vertex of a bound part keeps its place relative to the skin nearest to it.
///
/// Where the skin around a part has not moved, the part keeps the target's positions to the bit.
class PartFollower {
 public:
  /// \param faces  must outlive the follower.
  PartFollower(const FaceSet& faces, const PartList& parts, const HeadAxes& axes,
               PartShape shape = PartShape::kTarget);
  ~PartFollower();

  /// Puts the parts of a blended face in their places.
  /// \param target  the head it was built on.
  /// \param result  #V by 3, blended; its skin is not touched.
  void follow(Index target, Positions& result) const;

 private:
  struct State;
  std::unique_ptr<const State> state_;
};

}  // namespace crowdface
