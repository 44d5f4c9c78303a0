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

/// Transfers expressions to faces of the same topology (docs/shapes.md). The shapes come from a
/// template. If each head has its own shapes, a face gets weighted means of these shapes,
/// normalised to the mean head.
///
/// - Skin, and everything bound to the skin: displacements are multiplied by the local rotation and
///   stretch from the template's skin to the face's skin (FrameField).
/// - Lids close as on the template and stay outside the eyeballs (LidClosure). Lashes follow the
///   lids.
/// - Each rigid part (teeth or eyeball) rotates as in the shape, about the part's own centre. The
///   part's translation is transferred like a displacement of the skin.
///
/// The constructor computes everything that depends on the shapes only. If the face is the
/// template, or a head with its own shapes, the results equal the shapes of the template or of this
/// head, up to rounding. A result contains only vertices that the shape moves.
class ShapeTransfer {
 public:
  /// \param head_set    At least one head; must outlive this object.
  /// \param parts    If there are no parts, everything is skin.
  /// \param shapes   Must outlive this object.
  /// \param regions  Region weights α, #V by #regions; needed if each head has its own shapes.
  ShapeTransfer(const HeadSet& head_set, const Adjacency& adjacency, const PartList& parts,
                const HeadAxes& axes, const ShapeSet& shapes, const RegionWeights& regions = {});
  ~ShapeTransfer();

  /// Transfers all shapes to a face. May be called from several threads.
  ///
  /// \param target    The head that the face is built on. The face has this head's eyeballs.
  /// \param face      #V by 3.
  /// \param shares    For each shape: weights of the heads' own shapes. If empty, the template's
  ///                  shapes are used.
  /// \param crossing_counts  Optional output, one entry per shape: number of skin triangles that
  ///                  intersect other skin in this shape of the face, but neither in this shape of
  ///                  the template nor on the face at rest.
  /// \return          For each shape: displacements of the same vertices as in the ShapeSet.
  std::vector<Displacements> transfer_to_face(Index target, const Positions& face,
                                              std::span<const RegionShares> shares = {},
                                              std::vector<Index>* crossing_counts = nullptr) const;

  /// Returns the index of the shape with which a corrective shape must be applied, see
  /// find_prerequisites; nothing if `shape` is not corrective.
  std::optional<std::size_t> prerequisite_of(std::size_t shape) const;

  /// Returns the memory, in bytes, of the heads' normalised shapes and region weights.
  std::size_t memory_bytes() const;

 private:
  std::unique_ptr<const PreparedShapes> prepared_;
};

}  // namespace crowdface
