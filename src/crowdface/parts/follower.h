// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "crowdface/mesh/topology.h"
#include "crowdface/parts/eye_socket.h"
#include "crowdface/parts/part_list.h"
#include "crowdface/parts/part_options.h"

namespace crowdface {

/// Moves the parts of a head with its skin after blending. The constructor determines on the mean
/// head how parts are bound to the skin, and measures the positions of the parts on each head.
///
/// - A rigid part moves by the rotation, translation and uniform scale that best fits the motion of
///   the surrounding skin from the target to the face. Then each eyeball is shifted and rescaled,
///   so that its mean gap to each lid is the same as on the target. Other parts move out of lips
///   and cheeks.
/// - A vertex of a bound part keeps its position relative to the nearest skin.
///
/// Where the skin around a part has not moved, the part keeps exactly its positions on the target.
class PartFollower {
 public:
  /// \param heads  Must outlive this object.
  PartFollower(const HeadSet& heads, const PartList& parts, const HeadAxes& axes,
               PartShape shape = PartShape::kTarget);
  ~PartFollower();

  /// Moves the parts of a blended face. Several threads may call this function, each with its own
  /// `result`.
  ///
  /// \param target  The head that the face is built on.
  /// \param result  #V by 3, blended; the skin is left unchanged.
  void move_parts(Index target, Positions& result) const;

 private:
  struct State;
  std::unique_ptr<const State> state_;
};

}  // namespace crowdface
