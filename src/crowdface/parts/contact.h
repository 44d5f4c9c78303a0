// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/parts/point_grid.h"
#include "crowdface/parts/rigid_motion.h"
#include "crowdface/parts/surface_point.h"

namespace crowdface {

/// Keeps a rigid part, such as the teeth, behind the skin in front of it, such as lips and cheeks.
/// Stores pairs, each of a vertex of the part and a triangle of the skin.
class PartContact {
 public:
  PartContact() = default;
  /// \param topology   Must outlive this object.
  /// \param faces      Must outlive this object.
  /// \param positions  The head on which the pairs are found.
  /// \param grid       The skin's vertices at these positions.
  /// \param skin       The skin's vertices.
  /// \param part       The part's vertices.
  /// \param reach      Largest distance between the vertex and the triangle of a pair.
  PartContact(const Topology& topology, const VertexFaces& faces, const Positions& positions,
              const PointGrid& grid, std::span<const std::uint32_t> skin,
              std::span<const std::uint32_t> part, double reach, const std::vector<Head>& heads);

  /// The height of a vertex of the part above the skin of a head.
  struct Height {
    double height = 0;        ///< signed distance from the skin; negative: inside the skin
    Eigen::Vector3d outward;  ///< outward unit normal of the skin near the vertex
  };
  /// Returns the height of a point of the part above the nearest skin.
  ///
  /// \param pair   Index of a pair. The pair's vertex of the part is at `point`; the search for the
  ///               nearest skin starts near the pair's triangle.
  /// \param skin   Positions of the head or face whose skin is used, #V by 3.
  Height height(std::size_t pair, const Eigen::Vector3d& point, const Positions& skin) const;

  /// Returns the motion that keeps the part out of the skin and is nearest to `motion`. Each vertex
  /// of the part has a largest depth inside the skin: its maximum over all input heads. After the
  /// returned motion, no vertex is deeper inside the skin than its largest depth. A vertex that is
  /// outside the skin in all heads stays outside. The returned motion differs from `motion` by a
  /// small translation, rotation and scaling.
  ///
  /// \param target  The head from which the face takes the part: the part's positions before the
  ///                motion.
  /// \param motion  Motion of the surrounding skin.
  /// \param moved_face  The face with the moved skin.
  /// \param margin  Distance that the part keeps from the skin, where the part is outside the skin
  /// in all heads.
  RigidMotion keep_out_of_skin(const Positions& target, const RigidMotion& motion,
                               const Positions& moved_face, double margin) const;

  /// Returns the number of pairs.
  std::size_t size() const { return pairs_.size(); }

 private:
  /// largest number of start vertices of one search for the nearest skin
  static constexpr std::size_t kMaxSearchStarts = 3;
  using SearchStarts = std::array<std::uint32_t, kMaxSearchStarts>;
  /// A vertex of the part, and a triangle of the skin near this vertex.
  struct Pair {
    std::uint32_t vertex;  ///< vertex of the part
    Triangle corners;      ///< triangle of the skin
    /// Barycentric coordinates of a point of the triangle. On the head where the pair was found, no
    /// other point of the triangle is nearer to the vertex.
    std::array<double, 3> barycentric;
    /// Vertices of the skin from which the search for the skin point nearest to `vertex` starts.
    /// Near both lips, some start vertices lie on the upper lip and others on the lower lip.
    SearchStarts search_starts;
    double min_height;  ///< smallest height of the vertex above the skin in all heads
  };
  /// Pairs that are close together. The height of the middle pair, minus `height_margin`, is a
  /// lower bound for the heights of all pairs of the cluster.
  struct Cluster {
    std::size_t begin, end;  ///< the cluster consists of `pairs_[begin]` to `pairs_[end - 1]`
    /// estimated upper bound for: height above the skin of the middle pair's vertex, minus the
    /// smallest such height of the cluster's vertices
    double height_margin;
    /// Returns the index of the middle pair.
    std::size_t middle() const { return begin + (end - begin) / 2; }
  };
  /// Sets Pair::search_starts of all pairs.
  void find_search_starts(const Positions& positions, std::span<const std::uint32_t> skin,
                          const std::vector<Head>& heads);
  /// Orders the pairs by cluster, and sets `clusters_`.
  void find_clusters(const Positions& positions, const std::vector<Head>& heads);
  /// Returns the height of `point` above the plane of the pair's triangle.
  double approximate_height(const Pair& pair, const Eigen::Vector3d& point,
                            const Positions& skin) const;
  /// Returns the outward normal of the skin at a surface point, interpolated from the corners.
  Eigen::Vector3d normal_near(const SurfacePoint& place, const Positions& skin) const;
  /// Improves `motion` by one step of the optimisation.
  ///
  /// \param target, moved_face, margin  see keep_out_of_skin.
  /// \param start  The parameter `motion` of keep_out_of_skin, from which the result differs least.
  /// \param near   Indices of `pairs_` to check; the function removes pairs that are far from the
  ///               skin.
  /// \return       false if every vertex is high enough above the skin, so that no step was needed.
  bool step(const Positions& target, const RigidMotion& start, const Positions& moved_face,
            double margin, std::vector<std::uint32_t>& near, RigidMotion& motion) const;

  const Topology* topology_ = nullptr;
  const VertexFaces* faces_ = nullptr;
  double reach_ = 0;        ///< the constructor's parameter `reach`
  double normal_sign_ = 1;  ///< −1 if the skin's normals point away from the part, else 1
  double radius_ = 0;       ///< root mean square distance of the part's vertices from `middle_`
  /// middle of the part, in the head that the constructor got as `positions`
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();
  std::vector<Pair> pairs_;  ///< all pairs, ordered by cluster
  std::vector<Cluster> clusters_;
};

}  // namespace crowdface
