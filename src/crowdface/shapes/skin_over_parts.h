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

/// A row of a shape's displacements, and its vertex.
struct ShapeRow {
  std::uint32_t row, vertex;
};

/// Keeps skin in front of gums and teeth. When a jaw opens, it pulls the cheeks in; on some faces
/// the gums would penetrate the skin.
class SkinOverParts {
 public:
  SkinOverParts() = default;
  /// \param shaped  Template in the shape, #V by 3.
  /// \param inner   Vertices that the skin may cover: gums and teeth.
  /// \param moved   Vertices that the shape moves, ascending.
  /// \param extent  Diagonal of the skin's bounding box.
  SkinOverParts(const Positions& shaped, const SkinTriangles& skin,
                std::span<const std::uint32_t> inner, std::span<const std::uint32_t> moved,
                const HeadAxes& axes, double extent);

  /// Pushes skin outwards until it covers the same vertices on the face as on the template.
  ///
  /// \param rest   The mesh to which the shape is added, #V by 3.
  /// \param whole  Motion from the template to the face.
  /// \param rows   Rows of the shape that are skin.
  /// \param mesh   Equal to `rest`; modified during the call and restored.
  /// \param shape  Displacements of the face; adjusted.
  void keep(const Positions& rest, const RigidMotion& whole, std::span<const ShapeRow> rows,
            Positions& mesh, Displacements& shape) const;

 private:
  /// A vertex under the skin, and the triangle in front of it on the template in the shape.
  struct Covered {
    std::uint32_t vertex;
    Triangle over;
    /// `over` and the triangles around it, of which one covers the vertex on each face
    std::vector<Triangle> near;
    double depth;  ///< depth below the skin that the vertex should have
  };

  struct Push {
    Eigen::Vector3d at, by;
  };
  /// \param most  #covered: largest further push of each covered vertex.
  std::vector<Push> pushes_in(const Positions& mesh, const RigidMotion& whole,
                              std::span<double> most) const;
  void push(std::span<const Push> pushes, double scale, std::span<const ShapeRow> rows,
            Positions& mesh, Displacements& shape) const;

  HeadAxes axes_;
  double extent_ = 0;
  std::vector<Covered> covered_;
};

}  // namespace crowdface
