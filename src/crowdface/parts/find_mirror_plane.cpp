// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/find_mirror_plane.h"

#include "crowdface/core/parallel.h"
#include "crowdface/core/selection.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/smooth/symmetric_eigen.h"

namespace crowdface {
namespace {

constexpr std::size_t kPoints = 4000;  ///< number of skin vertices that determine the mirror plane
constexpr int kSteps = 30;

using Vertices = std::vector<std::uint32_t>;

class PlaneSearch {
 public:
  PlaneSearch(const Topology& topology, const VertexFaces& vertex_faces, const Positions& mean,
              const Vertices& skin, const MirrorPlane& start)
      : topology_(topology),
        around_(vertex_faces),
        mean_(mean),
        start_(start),
        grid_(mean, skin),
        sampled_vertices_(evenly_spaced_items(skin, kPoints)),
        nearest_points_(sampled_vertices_.size()) {}

  MirrorPlane find() {
    MirrorPlane by_vertices = start_;
    for (int step = 0; step < kSteps; ++step) {
      by_vertices = next(by_vertices, [&](std::uint32_t nearest, const Eigen::Vector3d&) {
        return row3(mean_, nearest);
      });
    }
    for (MirrorPlane plane : {start_, by_vertices}) {
      for (int step = 0; step < kSteps; ++step) {
        const MirrorPlane tried = plane;
        plane = next(plane, [&](std::uint32_t nearest, const Eigen::Vector3d& image) {
          return nearest_point_from(topology_, around_, mean_, nearest, image).position;
        });
        keep_best(tried);
      }
    }
    return best_;
  }

 private:
  /// One step of the iteration: fits the plane to vertices and to the surface points nearest to the
  /// mirror images of these vertices.
  ///
  /// \param place_of  Returns the surface point nearest to a mirror image.
  template <class PlaceOf>
  MirrorPlane next(const MirrorPlane& plane, const PlaceOf& place_of) {
    parallel_for_each(sampled_vertices_.size(), [&](std::size_t i) {
      const Eigen::Vector3d image = plane.mirrored(row3(mean_, sampled_vertices_[i]));
      nearest_points_[i] = place_of(grid_.nearest(image).vertex, image);
    });
    PlaneFit fit;
    for (std::size_t i = 0; i < sampled_vertices_.size(); ++i)
      fit.add(row3(mean_, sampled_vertices_[i]), nearest_points_[i]);
    return fit.plane(start_.normal);
  }

  void keep_best(const MirrorPlane& tried) {
    double squares = 0;
    for (std::size_t i = 0; i < sampled_vertices_.size(); ++i) {
      const Eigen::Vector3d off =
          tried.mirrored(row3(mean_, sampled_vertices_[i])) - nearest_points_[i];
      squares += off.squaredNorm();
    }
    if (squares >= least_) return;
    least_ = squares;
    best_ = tried;
  }

  const Topology& topology_;
  const VertexFaces& around_;
  const Positions& mean_;
  const MirrorPlane& start_;
  PointGrid grid_;
  Vertices sampled_vertices_;
  /// for each of `sampled_vertices_`: the surface point nearest to the vertex's mirror image
  std::vector<Eigen::Vector3d> nearest_points_;
  MirrorPlane best_;
  double least_ = HUGE_VAL;
};

}  // namespace

void PlaneFit::add(const Eigen::Vector3d& point, const Eigen::Vector3d& partner) {
  const Eigen::Vector3d joining = point - partner;
  scatter_ += joining * joining.transpose();
  midpoint_sum_ += 0.5 * (point + partner);
  ++pair_count_;
}

MirrorPlane PlaneFit::plane(const Eigen::Vector3d& side) const {
  MirrorPlane plane;
  plane.normal = symmetric_eigen(scatter_).eigenvectors.col(0).normalized();
  if (plane.normal.dot(side) < 0) plane.normal = -plane.normal;
  plane.offset = plane.normal.dot(midpoint_sum_ / static_cast<double>(pair_count_));
  return plane;
}

MirrorPlane find_mirror_plane(const Topology& topology, const VertexFaces& vertex_faces,
                              const Positions& mean, const std::vector<std::uint32_t>& skin,
                              const MirrorPlane& start) {
  return PlaneSearch(topology, vertex_faces, mean, skin, start).find();
}

}  // namespace crowdface
