// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/bend_skin.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "crowdface/core/parallel.h"
#include "crowdface/core/selection.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/point_grid.h"
#include "crowdface/wrap/elastic_solve.h"

namespace crowdface {
namespace {

/// Ambient visibilities. kMinBendVisibility: vertices below this value are inside the mouth, the
/// nose or an eye socket. kFullBendVisibility: the scan has full weight from this value on.
constexpr double kMinBendVisibility = 0.04, kFullBendVisibility = 0.25;
constexpr std::size_t kMaxScanPoints = 8000;
constexpr int kBendSteps = 3;              // steps per round
constexpr double kHiddenStiffnessMm = 10;  // smallest stiffness where the scan shows no skin
constexpr double kReachFirstMm = 30, kReachLastMm = 6;
constexpr double kEndMm = 200, kRimReachMm = 15;
/// Weight of a tie between two vertices, relative to the square of the round's wavelength.
constexpr double kTieWeight = 100;

/// A pair of corresponding points: one on the skin and one on the scan. Either the point of the
/// skin is a vertex, or the point of the scan is a sampled point.
struct Correspondence {
  bool is_found = false;
  /// `normal`: normal of the scan at its point. `offset`: vector from the skin's point to the
  /// scan's point.
  Eigen::Vector3d normal, offset;
  double weight = 0;
};

double robust(double distance, double spread) {
  const double share = distance / spread;
  const double root = 1 / (1 + share * share);
  return root * root;
}

double spread_of(const std::vector<Correspondence>& correspondences, double reach) {
  std::vector<double> distances;
  for (const Correspondence& correspondence : correspondences) {
    if (correspondence.is_found)
      distances.push_back(std::abs(correspondence.normal.dot(correspondence.offset)));
  }
  return outlier_distance(std::move(distances), reach);
}

/// Deforms one skin onto one scan; holds the data that stays constant in all rounds.
class Bending {
 public:
  Bending(const SkinMesh& skin, const Positions& base, const ScanSurface& scan,
          const std::vector<WrapLandmark>& landmarks, const std::vector<TiedVertices>& ties,
          const BendOptions& options)
      : skin_(skin),
        scan_(scan),
        landmarks_(landmarks),
        ties_(ties),
        options_(options),
        base_(base),
        displacements_(Positions::Zero(base.rows(), 3)),
        areas_(vertex_areas(skin.triangles, base)),
        laplacian_(laplacian(skin.triangles, base)),
        scan_areas_(vertex_areas(scan.scan().triangles, scan.scan().positions)) {
    visibility_weights_.resize(skin.ambient_visibility.size());
    for (std::size_t v = 0; v < visibility_weights_.size(); ++v) {
      visibility_weights_[v] = std::clamp((skin.ambient_visibility[v] - kMinBendVisibility) /
                                              (kFullBendVisibility - kMinBendVisibility),
                                          0.0, 1.0);
    }
    choose_scan_points();
    choose_rims();
    last_scan_triangles_.assign(visibility_weights_.size(), kNoIndex);
    last_skin_hits_.resize(scan_points_.size());
  }

  Positions run() {
    const std::size_t rounds = options_.wavelengths_mm.size();
    for (std::size_t r = 0; r < rounds; ++r) {
      const double share =
          rounds > 1 ? static_cast<double>(r) / static_cast<double>(rounds - 1) : 1;
      run_round(
          options_.wavelengths_mm[r], kReachFirstMm * std::pow(kReachLastMm / kReachFirstMm, share),
          options_.first_round_landmark_weight +
              share * (options_.last_round_landmark_weight - options_.first_round_landmark_weight),
          options_.first_round_tangential_weight +
              share *
                  (options_.last_round_tangential_weight - options_.first_round_tangential_weight));
    }
    return base_ + displacements_;
  }

 private:
  void choose_scan_points() {
    std::vector<std::uint32_t> inside;
    const std::vector<bool> used = is_vertex_used(scan_.scan());
    for (std::uint32_t v = 0; v < used.size(); ++v) {
      if (used[v] && !scan_.is_boundary_vertex()[v]) inside.push_back(v);
    }
    scan_points_ = evenly_spaced_items(inside, kMaxScanPoints);
    const auto count = static_cast<double>(scan_points_.size());
    scan_vertices_per_sample_ = count == 0 ? 0 : static_cast<double>(inside.size()) / count;
  }

  /// Selects the outer boundaries of skin and scan; ignores the boundaries of small holes.
  void choose_rims() {
    const auto ends = long_boundaries(scan_.scan().triangles, scan_.scan().positions, kEndMm);
    if (ends.empty()) return;
    scan_end_grid_.emplace(scan_.scan().positions, ends);
    for (const std::uint32_t v : long_boundaries(skin_.triangles, base_, kEndMm)) {
      if (visibility_weights_[v] > 0) skin_end_.push_back(v);
    }
  }

  /// Adds data terms that align the skin's boundary with the scan's boundary, where the distance
  /// between both boundaries is at most `reach`.
  void add_rim_terms(const Positions& current, double reach, DataTerms& data_terms) const {
    if (!scan_end_grid_) return;
    for (const std::uint32_t v : skin_end_) {
      const Eigen::Vector3d point = row3(current, v);
      const auto nearest = scan_end_grid_->nearest(point, reach);
      if (nearest.vertex == kNoIndex) continue;
      data_terms.add(
          v, Eigen::Vector3d::UnitX(), 0, areas_(v),
          row3(scan_.scan().positions, nearest.vertex) - point + row3(displacements_, v));
    }
  }

  void run_round(double length, double reach, double landmarks, double tangential) {
    const double fourth = std::pow(length, 4);
    Eigen::VectorXd factors(areas_.size()), typical(areas_.size());
    for (Index v = 0; v < areas_.size(); ++v) {
      const double seen = visibility_weights_[static_cast<std::size_t>(v)];
      const double hidden = std::pow(std::max(length, kHiddenStiffnessMm), 4);
      factors(v) = seen * fourth + (1 - seen) * hidden;
      typical(v) = areas_(v) * (0.8 * seen + 1e-4);
    }
    const double for_landmarks = landmarks * length * length;
    for (const WrapLandmark& landmark : landmarks_) typical(landmark.vertex) += for_landmarks;
    const double for_ties = kTieWeight * length * length;
    const SparseMatrix stiffness =
        bending_energy(laplacian_, areas_, factors) + tie_energy(for_ties);
    const ElasticSolver solver(stiffness, typical);
    for (int i = 0; i < kBendSteps; ++i) {
      const Positions current = base_ + displacements_;
      DataTerms data_terms(base_.rows());
      add_scan_terms(current, reach, tangential, data_terms);
      add_rim_terms(current, std::min(reach, kRimReachMm), data_terms);
      add_skin_terms(current, reach, tangential, data_terms);
      for (const WrapLandmark& landmark : landmarks_) {
        data_terms.add(landmark.vertex, Eigen::Vector3d::UnitX(), 0, for_landmarks,
                       landmark.scan_position - base_.row(landmark.vertex).transpose());
      }
      add_tie_terms(for_ties, data_terms);
      solver.solve(data_terms, {}, displacements_);
    }
  }

  /// Returns the matrix T, #V by #V, for which dᵀ T d is `weight` times the sum of |d_b − d_a|² over
  /// the tied vertices a and b.
  SparseMatrix tie_energy(double weight) const {
    std::vector<Eigen::Triplet<double>> entries;
    for (const TiedVertices& tie : ties_) {
      const auto [a, b] = tie.vertices;
      entries.insert(entries.end(), {{static_cast<int>(a), static_cast<int>(a), weight},
                                     {static_cast<int>(b), static_cast<int>(b), weight},
                                     {static_cast<int>(a), static_cast<int>(b), -weight},
                                     {static_cast<int>(b), static_cast<int>(a), -weight}});
    }
    SparseMatrix energy(base_.rows(), base_.rows());
    energy.setFromTriplets(entries.begin(), entries.end());
    return energy;
  }

  /// Adds the linear part of weight · |d_b − d_a − t|², where t is the wanted minus the present
  /// difference of the tied vertices a and b in the base.
  void add_tie_terms(double weight, DataTerms& data_terms) const {
    for (const TiedVertices& tie : ties_) {
      const auto [a, b] = tie.vertices;
      const Eigen::Vector3d change = tie.difference - (row3(base_, b) - row3(base_, a));
      data_terms.right_hand_side.row(a) -= weight * change.transpose();
      data_terms.right_hand_side.row(b) += weight * change.transpose();
    }
  }

  /// Adds data terms that pull each vertex of the skin to the closest point of the scan.
  void add_scan_terms(const Positions& current, double reach, double tangential,
                      DataTerms& data_terms) {
    const Positions normals = vertex_normals_or_zero(skin_.triangles, current);
    std::vector<Correspondence> correspondences(visibility_weights_.size());
    parallel_for_each(
        static_cast<std::uint32_t>(correspondences.size()), 128, [&](std::uint32_t v) {
          const double seen = visibility_weights_[v];
          if (seen == 0) return;
          const Eigen::Vector3d point = row3(current, v);
          const auto place = scan_.nearest(point, row3(normals, v), kMinNormalCosine, reach,
                                           last_scan_triangles_[v]);
          last_scan_triangles_[v] = place.triangle;
          if (place.is_found)
            correspondences[v] = {true, place.normal, place.point - point, areas_(v) * seen};
        });
    const double spread = spread_of(correspondences, reach);
    for (std::uint32_t v = 0; v < correspondences.size(); ++v) {
      const Correspondence& correspondence = correspondences[v];
      if (!correspondence.is_found) continue;
      const double weight = correspondence.weight * robust(correspondence.offset.norm(), spread);
      data_terms.add(v, correspondence.normal, weight * (1 - tangential), weight * tangential,
                     correspondence.offset + row3(displacements_, v));
    }
  }

  /// Adds one data term for each sampled point of the scan. Let S be the point of the skin that is
  /// closest to the sampled point. The data term pulls S towards the sampled point.
  void add_skin_terms(const Positions& current, double reach, double tangential,
                      DataTerms& data_terms) {
    const SurfaceTree tree(current, skin_.triangles);
    std::vector<Correspondence> correspondences(scan_points_.size());
    std::vector<SurfaceHit>& hits = last_skin_hits_;
    parallel_for_each(correspondences.size(), 128, [&](std::size_t i) {
      const std::uint32_t s = scan_points_[i];
      const Eigen::Vector3d point = row3(scan_.scan().positions, s);
      const Eigen::Vector3d normal = row3(scan_.normals(), s);
      const SurfaceHit hit = hits[i] =
          tree.nearest_facing(point, normal, kMinNormalCosine, reach, hits[i].triangle);
      if (hit.triangle == kNoIndex || at_rim(hit)) return;
      correspondences[i] = {true, normal, point - hit.point,
                            scan_vertices_per_sample_ * scan_areas_(s)};
    });
    const double spread = spread_of(correspondences, reach);
    for (std::size_t i = 0; i < correspondences.size(); ++i) {
      const Correspondence& correspondence = correspondences[i];
      if (!correspondence.is_found) continue;
      const double weight = correspondence.weight * robust(correspondence.offset.norm(), spread);
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = skin_.triangles[hits[i].triangle][k];
        const double share = weight * hits[i].barycentric[k] * visibility_weights_[v];
        if (share == 0) continue;
        data_terms.add(v, correspondence.normal, share * (1 - tangential), share * tangential,
                       correspondence.offset + row3(displacements_, v));
      }
    }
  }

  bool at_rim(const SurfaceHit& hit) const {
    for (std::size_t k = 0; k < 3; ++k) {
      if (hit.barycentric[k] > 0 && !skin_.adjacency.boundary[skin_.triangles[hit.triangle][k]])
        return false;
    }
    return true;
  }

  const SkinMesh& skin_;
  const ScanSurface& scan_;
  const std::vector<WrapLandmark>& landmarks_;
  const std::vector<TiedVertices>& ties_;
  const BendOptions& options_;
  Positions base_, displacements_;
  Eigen::VectorXd areas_;
  SparseMatrix laplacian_;
  Eigen::VectorXd scan_areas_;
  /// For each skin vertex: weight of the scan, 0 … 1. The weight grows with the ambient visibility,
  /// and is 0 inside mouth, nose and eye sockets.
  std::vector<double> visibility_weights_;
  std::vector<std::uint32_t> scan_points_;
  /// For each skin vertex, the closest triangle of the scan in the previous search. The next search
  /// uses the triangle as a guess.
  std::vector<std::uint32_t> last_scan_triangles_;
  /// For each sampled scan point, the closest point of the skin in the previous search. The next
  /// search uses the triangle of this point as a guess.
  std::vector<SurfaceHit> last_skin_hits_;
  std::vector<std::uint32_t> skin_end_;
  std::optional<PointGrid> scan_end_grid_;
  /// Only some scan vertices are sampled; each sampled point stands for this many scan vertices.
  double scan_vertices_per_sample_ = 0;
};

}  // namespace

Positions bend_skin(const SkinMesh& skin, const Positions& base, const ScanSurface& scan,
                    const std::vector<WrapLandmark>& landmarks,
                    const std::vector<TiedVertices>& ties, const BendOptions& options) {
  return Bending(skin, base, scan, landmarks, ties, options).run();
}

}  // namespace crowdface
