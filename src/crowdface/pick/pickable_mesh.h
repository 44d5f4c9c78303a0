// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "crowdface/mesh/colour_rows.h"
#include "crowdface/mesh/triangles.h"
#include "crowdface/render/ray_scene.h"
#include "crowdface/wrap/surface_tree.h"

namespace crowdface {

/// A point on a mesh that the user picked, or that is suggested to the user.
struct PickedPlace {
  /// nearest corner of the triangle that contains `point` or is nearest to `point`
  std::uint32_t vertex = kNoIndex;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< interpolated vertex normal, unit length
};

/// A mesh at full resolution for ray casts and nearest-point queries. Thread-safe. The page shows a
/// version with fewer triangles.
class PickableMesh {
 public:
  /// \param positions  #V by 3, finite, any unit
  /// \param skin       triangles that can be picked
  /// \param others     triangles that only occlude the skin: eyes, teeth
  PickableMesh(Positions positions, std::vector<Triangle> skin,
               const std::vector<Triangle>& others = {});
  PickableMesh(const PickableMesh&) = delete;
  PickableMesh& operator=(const PickableMesh&) = delete;

  /// Returns the first point of the skin along a ray. If the ray first hits another part, returns
  /// the skin point nearest to the hit, if this point lies within `max_skin_distance`. (Users often
  /// point at the eyeball when they mean the corner of the eye.)
  /// \param direction          any nonzero length
  /// \param max_skin_distance  in the unit of the mesh
  std::optional<PickedPlace> cast_ray(const Eigen::Vector3d& origin,
                                      const Eigen::Vector3d& direction,
                                      double max_skin_distance) const;
  /// First hit of a ray. `triangle` is an index into `skin` followed by `others`.
  struct Hit {
    std::uint32_t triangle = 0;
    bool is_skin = false;
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
  };
  /// Returns the first hit of a ray, on skin or other triangles.
  std::optional<Hit> first_hit(const Eigen::Vector3d& origin,
                               const Eigen::Vector3d& direction) const;

  /// The skin point nearest to `point`, among the skin points at most `reach` away at which the
  /// cosine between the surface normal and `facing` is at least `min_cosine`.
  /// \param facing  unit vector.
  std::optional<PickedPlace> nearest(const Eigen::Vector3d& point, const Eigen::Vector3d& facing,
                                     double min_cosine, double reach) const;
  /// Returns the position and normal of a vertex.
  PickedPlace place_at_vertex(std::uint32_t vertex) const;
  /// Returns `point` itself, with the normal and vertex of the nearest skin point.
  PickedPlace place_at_point(const Eigen::Vector3d& point) const;

  const Positions& positions() const { return positions_; }
  const std::vector<Triangle>& skin() const { return skin_; }
  Eigen::Vector3d box_min() const { return box_.min(); }
  Eigen::Vector3d box_max() const { return box_.max(); }

  /// The mesh reduced to about `max_triangles` triangles, with the normals of the full mesh, as a
  /// BinaryAnswer. JSON: `origin`, `low` and `high` (the skin's bounding box, relative to
  /// `origin`), `whole_triangles` (number of triangles of the full mesh). Arrays: `positions`
  /// (relative to `origin`), `normals` (16-bit integers), `triangles`, `part` (per vertex: 0 skin,
  /// 1 other), and `colours` if there are any.
  /// \param colours  vertex colours; no rows: none
  std::string encode_reduced(std::size_t max_triangles, const ColourRows& colours = {}) const;

 private:
  /// Returns the point with these barycentric coordinates in a triangle of the mesh.
  PickedPlace place_in_triangle(const Triangle& corners,
                                const std::array<double, 3>& barycentric) const;

  Positions positions_;
  std::vector<Triangle> skin_;
  /// The triangles of the skin, followed by the triangles of all other parts. Each triangle is
  /// stored as a quad whose last corner repeats.
  std::vector<Quad> quads_;
  Positions normals_;        ///< unit normals of the vertices, #V by 3
  Eigen::AlignedBox3d box_;  ///< bounding box of the skin
  Eigen::Vector3d middle_;   ///< centre of `box_`; origin of all coordinates in single precision
  RayDevice device_;         ///< Embree device of `scene_`
  RayScene scene_;           ///< `quads_` relative to `middle_`, for ray casts
  SurfaceTree tree_;         ///< finds nearest points on the skin
};

}  // namespace crowdface
