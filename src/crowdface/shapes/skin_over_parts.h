// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/mesh/displacements.h"
#include "crowdface/parts/head_axes.h"
#include "crowdface/parts/rigid_motion.h"
#include "crowdface/shapes/meeting_skin.h"

namespace crowdface {

/// A row of a shape's displacements, and its vertex.
struct ShapeRow {
  std::uint32_t row, vertex;
};

/// Skin in front of gums and teeth, which a shape brings nearer to them than they let it on another face: a jaw that
/// opens draws the cheeks in.
class SkinOverParts {
 public:
  SkinOverParts() = default;
  /// \param shaped  the template in the shape, #V by 3
  /// \param inner   vertices of what lies under it, and maybe elsewhere
  /// \param moved   by the shape, ascending
  /// \param extent  of the skin
  SkinOverParts(const Positions& shaped, const SkinTriangles& skin,
                std::span<const std::uint32_t> inner, std::span<const std::uint32_t> moved,
                const HeadAxes& axes, double extent);

  /// Moves skin outwards until what lies under it on the template does so on a face.
  /// \param rest   what the shape is added to, #V by 3
  /// \param whole  from the template
  /// \param rows   of the shape that are skin
  /// \param mesh   the same as rest; changed while it works
  void keep(const Positions& rest, const RigidMotion& whole, std::span<const ShapeRow> rows,
            Positions& mesh, Displacements& shape) const;

 private:
  /// A vertex under the skin, and the triangle that is in front of it on the template in the shape.
  struct Covered {
    std::uint32_t vertex;
    Triangle over;
    std::vector<Triangle> near;  ///< and around it: one of them is in front on a face
    double depth;                ///< how far below it must be
  };

  struct Push {
    Eigen::Vector3d at, by;
  };
  /// \param most  #covered: how far each may still be pushed
  std::vector<Push> pushes_in(const Positions& mesh, const RigidMotion& whole,
                              std::span<double> most) const;
  void push(std::span<const Push> pushes, double scale, std::span<const ShapeRow> rows,
            Positions& mesh, Displacements& shape) const;

  HeadAxes axes_;
  double extent_ = 0;
  std::vector<Covered> covered_;
};

}  // namespace crowdface
