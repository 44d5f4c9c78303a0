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

/// Where a point lies against the skin.
struct SkinPlace {
  std::uint32_t vertex = 0;                            ///< a corner of the nearest triangle
  double height = 0;                                   ///< off the skin; negative: inside
  Eigen::Vector3d outward = Eigen::Vector3d::Zero();   ///< unit, smooth over the skin
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< on the skin
};

/// The skin of the mesh that attachments were fitted to, and how any face of its topology is asked
/// about.
class FittedSkin {
 public:
  /// \param topology  must outlive this object.
  /// \param mesh      #V by 3.
  /// \param skin      its skin's vertices, ascending, at least three that are not on a line.
  /// \param mm        how much of the mesh's unit a millimetre is.
  FittedSkin(const Topology& topology, Positions mesh, std::vector<std::uint32_t> skin, double mm);
  FittedSkin(const FittedSkin&) = delete;
  FittedSkin& operator=(const FittedSkin&) = delete;

  const Positions& mesh() const { return mesh_; }
  std::span<const std::uint32_t> vertices() const { return skin_; }
  const PointGrid& grid() const { return levels_.front().grid; }
  const std::vector<double>& areas() const { return areas_; }
  double mm() const { return mm_; }
  /// How far vertices of the skin are apart.
  double spacing() const { return levels_.front().spacing; }

  /// A part of the skin, by vertices that stand for all of it.
  struct Patch {
    std::vector<std::uint32_t> vertices;
    std::vector<double> weights;  ///< #vertices: area × nearness
    double reach = 0;
  };
  /// The skin around a point, which counts less with its distance and from `reach` on not at all. The
  /// reach is a few millimetres at the skin and grows with the distance from it; weights and reach
  /// are continuous in the point, so that neighbours hear of almost the same skin.
  Patch patch_around(const Eigen::Vector3d& point) const;
  /// \param least  the reach at the skin, where vertices lie closely enough
  Patch patch_around(const Eigen::Vector3d& point, double least) const;

  /// Unit normals of a face's vertices, #V by 3, that look off the skin.
  Positions normals(const Positions& face) const;
  /// \param start    a vertex of the skin near the point
  /// \param normals  of the face, see above
  SkinPlace place_near(const Positions& face, const Positions& normals, std::uint32_t start,
                       const Eigen::Vector3d& point) const;

 private:
  /// Vertices that stand for the skin in cells of one width.
  struct Level {
    double spacing;
    std::vector<std::uint32_t> vertices;
    std::vector<double> areas;  ///< #V
    PointGrid grid;
  };
  void add_level(double spacing, std::vector<std::uint32_t> vertices, std::vector<double> areas);
  void add_coarser(double spacing);
  double reach_at(const Eigen::Vector3d& point, double least) const;
  void add_samples(const Level& level, const Eigen::Vector3d& point, double share,
                   Patch& patch) const;

  const Topology& topology_;
  Positions mesh_;
  std::vector<std::uint32_t> skin_;
  double mm_;
  FacesAround around_;
  NormalFans fans_;
  double side_ = 1;  ///< −1: faces are wound so that their normals look inwards
  std::vector<double> areas_;
  std::vector<Level> levels_;  ///< each of twice the spacing before it
};

}  // namespace crowdface
