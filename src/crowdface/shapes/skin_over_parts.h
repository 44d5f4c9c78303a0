// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/mesh/displacements.h"
#include "crowdface/parts/head_axes.h"
#include "crowdface/parts/rigid_motion.h"
#include "crowdface/shapes/touching_skin.h"

namespace crowdface {

/// The index of a row in a shape's displacements, and the vertex that this row moves.
struct DisplacementRow {
  std::uint32_t row, vertex;
};

/// Keeps skin in front of gums and teeth. An opening jaw pulls the cheeks in, so that gums would
/// penetrate the skin on some faces.
class SkinOverParts {
 public:
  SkinOverParts() = default;
  /// \param shaped  Positions of the template's vertices with the shape applied, #V by 3.
  /// \param inner_vertices  Vertices of gums and teeth. Those that lie behind the skin in `shaped`
  ///            are kept behind the skin of faces.
  /// \param moved_vertices  Vertices that the shape moves, ascending.
  /// \param extent  Diagonal of the skin's bounding box.
  SkinOverParts(const Positions& shaped, const SkinTriangles& skin,
                std::span<const std::uint32_t> inner_vertices,
                std::span<const std::uint32_t> moved_vertices, const HeadAxes& axes, double extent);

  /// Pushes skin outwards until the skin covers the same vertices of gums and teeth on the face as
  /// on the template.
  ///
  /// \param rest   The mesh to which the shape is added, #V by 3.
  /// \param face_motion  Motion from the template to the face.
  /// \param rows   Rows of `shape` whose vertices are skin.
  /// \param mesh   Equal to `rest`; modified during the call and restored.
  /// \param shape  Displacements of the face; adjusted.
  void keep_in_front(const Positions& rest, const RigidMotion& face_motion,
                     std::span<const DisplacementRow> rows, Positions& mesh,
                     Displacements& shape) const;

 private:
  /// A vertex of gums or teeth under the skin. `covering_triangle` is the skin triangle in front of
  /// the vertex on the template with the shape applied.
  struct CoveredVertex {
    std::uint32_t vertex;
    Triangle covering_triangle;
    /// triangles near `covering_triangle`; on a generated face, any of them may cover the vertex
    std::vector<Triangle> candidates;
    /// How far the vertex should lie below the skin, in the unit of the template. On a face, this
    /// depth is multiplied by the scale of the face relative to the template.
    double depth;
  };

  /// A point of the skin, and the displacement by which to push the skin there.
  struct Push {
    Eigen::Vector3d position, displacement;
  };
  /// Returns the pushes that move skin in front of covered vertices.
  /// \param max_push  for each covered vertex, the largest push that the vertex may still cause;
  ///                  reduced by each push.
  std::vector<Push> find_pushes(const Positions& mesh, const RigidMotion& face_motion,
                                std::span<double> max_push) const;
  /// Moves the skin at the points of `pushes`, and the skin around these points with a falloff.
  void apply_pushes(std::span<const Push> pushes, double scale,
                    std::span<const DisplacementRow> rows, Positions& mesh,
                    Displacements& shape) const;

  HeadAxes axes_;
  double extent_ = 0;  ///< diagonal of the bounding box of the template's skin
  /// the vertices of gums and teeth that the skin covers in this shape
  std::vector<CoveredVertex> covered_vertices_;
};

}  // namespace crowdface
