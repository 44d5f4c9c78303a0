// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/mesh/normals.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/mesh/triangles.h"
#include "crowdface/parts/point_grid.h"
#include "crowdface/parts/surface_point.h"

namespace crowdface {

/// The point of the skin that is nearest to a given point.
struct NearestSkinPoint {
  /// index, in the mesh, of a corner of the skin triangle that contains `position`
  std::uint32_t vertex = 0;
  /// signed distance of the given point from the skin; negative if the given point is inside the
  /// head
  double height = 0;
  /// unit normal of the skin at `position`, interpolated between the normals of the vertices
  Eigen::Vector3d outward_normal = Eigen::Vector3d::Zero();
  /// the point of the skin that is nearest to the given point
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

/// The skin of the mesh to which attachments were fitted, with queries for any face of the same
/// topology. Const members may be called from several threads.
class FittedSkin {
 public:
  /// \param topology  Must outlive this object.
  /// \param mesh      #V by 3, the vertex positions.
  /// \param skin      Vertices of the skin, ascending; at least three that are not collinear.
  /// \param units_per_mm  Length of one millimetre in the mesh's unit.
  ///
  /// \throws BrokenPrecondition if sizes do not fit or the skin has no area.
  FittedSkin(const Topology& topology, Positions mesh, std::vector<std::uint32_t> skin,
             double units_per_mm);
  FittedSkin(const FittedSkin&) = delete;
  FittedSkin& operator=(const FittedSkin&) = delete;

  const Positions& mesh_positions() const { return positions_; }
  /// The skin's vertices, as ascending vertex indices of the mesh.
  std::span<const std::uint32_t> vertices() const { return skin_vertices_; }
  /// The skin's vertices in a grid, for nearest-vertex queries.
  const PointGrid& grid() const { return levels_.front().grid; }
  /// The area of skin around each vertex of the mesh; 0 outside the skin.
  const std::vector<double>& areas() const { return areas_; }
  double units_per_mm() const { return units_per_mm_; }
  /// Mean spacing of the skin's vertices: the square root of the skin's area divided by the number
  /// of vertices.
  double vertex_spacing() const { return levels_.front().spacing; }

  /// A patch of skin around a point: vertex indices of the mesh, and a weight for each vertex.
  struct Patch {
    std::vector<std::uint32_t> vertices;  ///< the vertices of the patch, as indices in the mesh
    /// for each vertex: the area of skin that the vertex represents, times a factor that falls to 0
    /// at the distance `radius` from the centre of the patch
    std::vector<double> weights;
    /// distance from the centre of the patch at and beyond which vertices have no weight
    double radius = 0;
  };
  /// Returns the patch of skin around a point. For a point on the skin, the radius is a few
  /// millimetres. The radius grows with the point's distance from the skin. Weights and radius are
  /// continuous in the point, so neighbouring points get almost the same patch.
  Patch patch_around(const Eigen::Vector3d& point) const;
  /// Like patch_around(point), but with another minimum of the radius.
  Patch patch_around(const Eigen::Vector3d& point, double min_radius) const;

  /// Returns the outward unit normals of a face's vertices, #V by 3.
  Positions normals(const Positions& face) const;
  /// Returns the point on a face's skin that is nearest to a given point. The search walks over the
  /// mesh from `start`.
  ///
  /// \param face     #V by 3.
  /// \param normals  Normals of the face, from `normals`.
  /// \param start    A vertex of the skin near the point.
  NearestSkinPoint nearest_skin(const Positions& face, const Positions& normals,
                                std::uint32_t start, const Eigen::Vector3d& point) const;

 private:
  /// A level of detail of the skin. The finest level has all vertices of the skin; each coarser
  /// level has one vertex in each occupied cell of a cubic grid.
  struct Level {
    double spacing;  ///< edge length of the grid's cells; in the finest level, vertex_spacing()
    /// the vertices of the level, as ascending indices in the mesh
    std::vector<std::uint32_t> vertices;
    /// one per mesh vertex: area of skin that the vertex represents in this level
    std::vector<double> areas;
    PointGrid grid;  ///< the level's vertices, for nearest-vertex queries
  };
  /// Adds a level of detail to `levels_`. The parameters become the members of Level.
  void add_level(double spacing, std::vector<std::uint32_t> vertices, std::vector<double> areas);
  /// Adds a level that contains one skin vertex from each cell of a cubic grid with edge length
  /// `spacing`.
  void add_coarser_level(double spacing);
  /// Returns Patch::radius for the patch around a point.
  double patch_radius_at(const Eigen::Vector3d& point, double min_radius) const;
  /// Adds to `patch` the vertices of a level of detail that lie inside the patch around `point`.
  /// \param share  Factor on the weights of the added vertices.
  void add_patch_vertices(const Level& level, const Eigen::Vector3d& point, double share,
                          Patch& patch) const;

  const Topology& topology_;
  Positions positions_;  ///< #V by 3: vertex positions of the mesh to which attachments were fitted
  /// indices, in the mesh, of the skin's vertices, ascending
  std::vector<std::uint32_t> skin_vertices_;
  double units_per_mm_;       ///< length of one millimetre in the mesh's unit
  VertexFaces vertex_faces_;  ///< the polygons at each vertex of the mesh
  NormalFans fans_;           ///< for each vertex, the polygons that determine the vertex's normal
  double normal_sign_ = 1;  ///< −1 if the polygons' winding makes the normals point inwards, else 1
  std::vector<double> areas_;  ///< the area of skin around each vertex of the mesh
  /// all levels, from fine to coarse; the spacing doubles from level to level
  std::vector<Level> levels_;
};

}  // namespace crowdface
