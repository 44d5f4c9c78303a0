// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/feature_check.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include <Eigen/Dense>

#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

/// The landmarks of a feature, in order along the feature's outline, and a distance: vertices that
/// are at most this far from the outline belong to the feature.
struct Outline {
  std::string_view name;
  std::vector<std::string> landmarks;
  double reach_mm = 10;
};

const std::vector<Outline>& outlines() {
  static const std::vector<Outline> all = {
      {"mouth", {"mouth_left", "lip_upper", "mouth_right", "lip_lower"}, 10},
      {"nose", {"nose_wing_left", "nose_tip", "nose_wing_right", "nose_base"}, 10},
      {"left eye", {"eye_inner_left", "lid_upper_left", "eye_outer_left", "lid_lower_left"}, 10},
      {"right eye",
       {"eye_inner_right", "lid_upper_right", "eye_outer_right", "lid_lower_right"},
       10},
      {"left ear", {"ear_highest_left", "ear_lowest_left"}, 20},
      {"right ear", {"ear_highest_right", "ear_lowest_right"}, 20}};
  return all;
}

double distance_to_outline(const Eigen::Vector3d& p, const std::vector<Eigen::Vector3d>& outline) {
  double least = (p - outline.front()).norm();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector3d& a = outline[i];
    const Eigen::Vector3d edge = outline[(i + 1) % outline.size()] - a;
    const double length = edge.squaredNorm();
    const double t = length > 0 ? std::clamp((p - a).dot(edge) / length, 0.0, 1.0) : 0;
    least = std::min(least, (p - a - t * edge).norm());
  }
  return least;
}

/// The area of each vertex of the skin: a third of the areas of its triangles.
Eigen::VectorXd areas_at_vertices(const SkinMesh& skin, const Positions& positions) {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(positions.rows());
  for (const Triangle& t : skin.triangles) {
    const double third = area_vector(positions, t).norm() / 3;
    for (const std::uint32_t v : t) areas(v) += third;
  }
  return areas;
}

/// A frame at a feature: the middle of the feature's vertices, the mean of their normals, and two
/// directions along the skin.
struct FeatureFrame {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero(), side, up, normal = Eigen::Vector3d::Zero();

  /// Returns the coordinates of a point along `side`, `up` and `normal`, from `middle`.
  Eigen::Vector3d coordinates(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d offset = point - middle;
    return {offset.dot(side), offset.dot(up), offset.dot(normal)};
  }
};

/// Returns the frame of a feature that consists of `vertices`.
/// \param weights  weight of each of the `vertices`
/// \param up       the head's direction up
FeatureFrame feature_frame(const Positions& positions, const Positions& normals,
                           const std::vector<std::uint32_t>& vertices,
                           const Eigen::VectorXd& weights, const Eigen::Vector3d& up) {
  FeatureFrame frame;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    frame.normal += weights(static_cast<Index>(i)) * row3(normals, vertices[i]);
    frame.middle += weights(static_cast<Index>(i)) * row3(positions, vertices[i]);
  }
  frame.normal.normalize();
  frame.middle /= weights.sum();
  frame.side = up.cross(frame.normal).normalized();
  frame.up = frame.normal.cross(frame.side);
  return frame;
}

/// Coordinates of vertices in a frame, #vertices by 3.
Positions coordinates_of(const FeatureFrame& frame, const Positions& positions,
                         const std::vector<std::uint32_t>& vertices) {
  Positions coordinates(static_cast<Index>(vertices.size()), 3);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    coordinates.row(static_cast<Index>(i)) =
        frame.coordinates(row3(positions, vertices[i])).transpose();
  }
  return coordinates;
}

/// Heights of points above the quadratic surface that fits these points best.
/// \param points   #points by 3: two coordinates along the skin, and the height, in mm
/// \param weights  #points
Eigen::VectorXd relief(const Positions& points, const Eigen::VectorXd& weights) {
  constexpr double kUnitMm = 20;  // keeps the powers near 1
  const Eigen::ArrayXd a = points.col(0).array() / kUnitMm, b = points.col(1).array() / kUnitMm;
  Eigen::MatrixXd surface(points.rows(), 6);
  surface << Eigen::VectorXd::Ones(points.rows()), a, b, a * a, a * b, b * b;
  const Eigen::MatrixXd weighted = weights.asDiagonal() * surface;
  return points.col(2) -
         surface *
             (surface.transpose() * weighted).ldlt().solve(weighted.transpose() * points.col(2));
}

double weighted_correlation(const Eigen::VectorXd& p, const Eigen::VectorXd& q,
                            const Eigen::VectorXd& weights) {
  const auto product = [&](const Eigen::VectorXd& r, const Eigen::VectorXd& s) {
    return (weights.array() * r.array() * s.array()).sum();
  };
  const double sizes = std::sqrt(product(p, p) * product(q, q));
  return sizes > 0 ? product(p, q) / sizes : 0;
}

/// Height of a surface at the point (a, b), interpolated between the surface's vertices near this
/// point.
/// \param vertices  one row per vertex: the two coordinates and the height, in mm
double height_at(const Positions& vertices, double a, double b) {
  const Eigen::ArrayXd squares =
      (vertices.col(0).array() - a).square() + (vertices.col(1).array() - b).square();
  const Eigen::ArrayXd weights = (-squares / std::max(1.0, 2 * squares.minCoeff())).exp();
  return (weights * vertices.col(2).array()).sum() / weights.sum();
}

/// The template's skin before and after the wrap, prepared once for all features.
struct SkinPair {
  SkinPair(const WrapTemplate& wrap_template, const Positions& wrapped)
      : skin(wrap_template.skin),
        up(wrap_template.axes.up),
        before(skin.rows_of(wrap_template.positions)),
        after(skin.rows_of(wrapped)),
        normals_before(vertex_normals_or_zero(skin.triangles, before)),
        normals_after(vertex_normals_or_zero(skin.triangles, after)),
        areas(areas_at_vertices(skin, before)) {}

  const SkinMesh& skin;
  Eigen::Vector3d up;
  Positions before, after, normals_before, normals_after;
  Eigen::VectorXd areas;
};

/// Keeps every k-th element, with the smallest k for which at most `count` elements remain.
std::vector<std::uint32_t> thinned(const std::vector<std::uint32_t>& all, std::size_t count) {
  std::vector<std::uint32_t> kept;
  const std::size_t step = (all.size() + count - 1) / count;
  for (std::size_t i = 0; i < all.size(); i += step) kept.push_back(all[i]);
  return kept;
}

/// The relief of some vertices of a skin: their heights above a fitted quadratic surface.
/// \param up  the head's direction up
Eigen::VectorXd relief(const Positions& positions, const Positions& normals,
                       const std::vector<std::uint32_t>& vertices, const Eigen::VectorXd& weights,
                       const Eigen::Vector3d& up) {
  const FeatureFrame frame = feature_frame(positions, normals, vertices, weights, up);
  return relief(coordinates_of(frame, positions, vertices), weights);
}

double relief_correlation_at_feature(const SkinPair& pair,
                                     const std::vector<std::uint32_t>& vertices) {
  const Eigen::VectorXd weights = pair.areas(vertices);
  return weighted_correlation(relief(pair.before, pair.normals_before, vertices, weights, pair.up),
                              relief(pair.after, pair.normals_after, vertices, weights, pair.up),
                              weights);
}

/// The highest correlation between the feature's relief on the template and the relief of the
/// wrapped skin up to 20 mm above or below the feature, at steps of 4 mm. (A wrap that takes the
/// crease of the chin for the mouth puts the mouth 17 mm too low.)
double correlation_beside(const SkinPair& pair, const FaceFeature& feature) {
  constexpr std::size_t kMaxVertices = 400, kMaxSurroundings = 20000;
  constexpr double kSurroundingsMm = 70, kMinCosine = 0.1;
  constexpr int kMaxShiftMm = 20, kStepMm = 4;
  const std::vector<std::uint32_t> vertices = thinned(feature.skin_vertices, kMaxVertices);
  const Eigen::VectorXd weights = pair.areas(vertices);
  const Eigen::VectorXd expected =
      relief(pair.before, pair.normals_before, vertices, weights, pair.up);
  const FeatureFrame frame =
      feature_frame(pair.after, pair.normals_after, vertices, weights, pair.up);
  std::vector<std::uint32_t> around;
  for (std::uint32_t v = 0; v < pair.skin.vertices.size(); ++v) {
    if (pair.skin.ambient_visibility[v] > kVisibleSkinThreshold &&
        (row3(pair.after, v) - frame.middle).norm() < kSurroundingsMm &&
        row3(pair.normals_after, v).dot(frame.normal) > kMinCosine) {
      around.push_back(v);
    }
  }
  const Positions surroundings =
      coordinates_of(frame, pair.after, thinned(around, kMaxSurroundings));
  const Positions in_place = coordinates_of(frame, pair.after, vertices);
  double best = -1;
  for (int shift = -kMaxShiftMm; shift <= kMaxShiftMm; shift += kStepMm) {
    if (shift == 0) continue;
    Positions shifted = in_place;
    for (Index i = 0; i < shifted.rows(); ++i) {
      shifted(i, 2) = height_at(surroundings, in_place(i, 0), in_place(i, 1) + shift);
    }
    best = std::max(best, weighted_correlation(expected, relief(shifted, weights), weights));
  }
  return best;
}

}  // namespace

std::vector<FaceFeature> face_features(const WrapTemplate& wrap_template,
                                       const std::map<std::string, std::uint32_t>& landmarks) {
  constexpr std::size_t kMinVertices = 40;
  std::vector<FaceFeature> features;
  for (const Outline& outline : outlines()) {
    std::vector<Eigen::Vector3d> places;
    for (const std::string& name : outline.landmarks) {
      const auto found = landmarks.find(name);
      if (found != landmarks.end()) places.push_back(row3(wrap_template.positions, found->second));
    }
    if (places.size() < outline.landmarks.size()) continue;
    FaceFeature feature{std::string(outline.name), {}};
    for (std::uint32_t v = 0; v < wrap_template.skin.vertices.size(); ++v) {
      if (wrap_template.skin.ambient_visibility[v] <= kVisibleSkinThreshold) continue;
      const Eigen::Vector3d p = row3(wrap_template.positions, wrap_template.skin.vertices[v]);
      if (distance_to_outline(p, places) < outline.reach_mm) feature.skin_vertices.push_back(v);
    }
    if (feature.name == "mouth") feature.lip_line = find_lip_line(wrap_template, landmarks);
    if (feature.skin_vertices.size() >= kMinVertices) features.push_back(std::move(feature));
  }
  return features;
}

std::vector<ReliefCorrelation> relief_correlations(const WrapTemplate& wrap_template,
                                                   const std::vector<FaceFeature>& features,
                                                   const Positions& wrapped) {
  const SkinPair pair(wrap_template, wrapped);
  std::vector<ReliefCorrelation> correlations;
  for (const FaceFeature& feature : features) {
    ReliefCorrelation correlation{relief_correlation_at_feature(pair, feature.skin_vertices)};
    if (!correlation.is_high())
      correlation.best_correlation_nearby = correlation_beside(pair, feature);
    correlations.push_back(correlation);
  }
  return correlations;
}

}  // namespace crowdface
