// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "crowdface/mesh/adjacency.h"
#include "crowdface/parts/head_axes.h"
#include "crowdface/parts/part_list.h"
#include "crowdface/shapes/shape_set.h"

namespace crowdface {

/// Carries the expressions of a template to faces of its topology (docs/shapes.md):
///
/// - skin, lashes and whatever else is bound to the skin by how the face's skin is turned and stretched
///   against the template's (FrameField);
/// - lids so that they close as on the template and keep off the eyeballs (LidClosure), lashes with them;
/// - a rigid part, teeth or eyeball, by the turn that the shape gives it, about its own middle (an
///   eyeball's centre), and the shift of that, carried like skin.
///
/// What depends on the template alone is found once. A face that is the template gives the shapes
/// themselves up to rounding, and vertices that a shape leaves alone are in no displacement.
class ShapeTransfer {
 public:
  /// \param faces, shapes  must outlive this object; at least one head.
  /// \param parts          of no parts: all is skin.
  ShapeTransfer(const FaceSet& faces, const Adjacency& adjacency, const PartList& parts,
                const HeadAxes& axes, const ShapeSet& shapes);
  ~ShapeTransfer();

  /// \param target  the head the face was built on, whose eyeballs it has.
  /// \param face    #V by 3.
  /// \return        #shapes, each with the vertices of the template's shape.
  std::vector<Displacements> carry(Index target, const Positions& face) const;

 private:
  struct State;
  std::unique_ptr<const State> state_;
};

}  // namespace crowdface
