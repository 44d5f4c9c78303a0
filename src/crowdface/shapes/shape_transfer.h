// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "crowdface/mesh/adjacency.h"
#include "crowdface/parts/head_axes.h"
#include "crowdface/parts/part_list.h"
#include "crowdface/region/region_weights.h"
#include "crowdface/shapes/shape_set.h"

namespace crowdface {

struct PreparedShapes;

/// Carries expressions to faces of their topology (docs/shapes.md): those of a template, or between
/// those of the heads, each first measured on the mean head:
///
/// - skin, lashes and whatever else is bound to the skin by how the face's skin is turned and stretched
///   against the template's (FrameField);
/// - lids so that they close as on the template and keep off the eyeballs (LidClosure), lashes with them;
/// - a rigid part, teeth or eyeball, by the turn that the shape gives it, about its own middle (an
///   eyeball's centre), and the shift of that, carried like skin.
///
/// What depends on the shapes alone is found once. A face that is the template, or a head with shapes of
/// its own, has the shapes themselves up to rounding, and vertices that a shape leaves alone are in no
/// displacement.
class ShapeTransfer {
 public:
  /// \param faces, shapes  must outlive this object; at least one head.
  /// \param parts          of no parts: all is skin.
  /// \param regions        α, #V by #regions, for sets of shapes of the heads.
  ShapeTransfer(const FaceSet& faces, const Adjacency& adjacency, const PartList& parts,
                const HeadAxes& axes, const ShapeSet& shapes, const RegionWeights& regions = {});
  ~ShapeTransfer();

  /// \param target  the head the face was built on, whose eyeballs it has.
  /// \param face    #V by 3.
  /// \param shares  #shapes: whose shapes count how much, by head; none: the template's.
  /// \param crossing  if given, gets how many triangles of the skin pass through other skin in each shape and
  ///                  neither in that shape on the template nor in the face at rest.
  /// \return        #shapes, each with the vertices of the set's shape.
  std::vector<Displacements> carry(Index target, const Positions& face,
                                   std::span<const RegionShares> shares = {},
                                   std::vector<Index>* crossing = nullptr) const;

  /// The shape to which one is made to be added, see companions_of.
  std::optional<std::size_t> companion(std::size_t shape) const;

  /// What it keeps of the heads' own shapes.
  std::size_t memory_bytes() const;

 private:
  std::unique_ptr<const PreparedShapes> prepared_;
};

}  // namespace crowdface
