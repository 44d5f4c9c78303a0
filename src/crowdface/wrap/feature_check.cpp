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

/// Heights of vertices above the quadratic surface that fits these vertices best.
/// \param weights  #vertices
Eigen::VectorXd relief(const Positions& positions, const Positions& normals,
                       const std::vector<std::uint32_t>& vertices, const Eigen::VectorXd& weights) {
  Eigen::Vector3d up = Eigen::Vector3d::Zero(), middle = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    up += weights(static_cast<Index>(i)) * row3(normals, vertices[i]);
    middle += weights(static_cast<Index>(i)) * row3(positions, vertices[i]);
  }
  up.normalize();
  middle /= weights.sum();
  const Eigen::Vector3d x = up.unitOrthogonal(), y = up.cross(x);
  constexpr double kUnitMm = 20;  // keeps the powers near 1
  const auto count = static_cast<Index>(vertices.size());
  Eigen::MatrixXd surface(count, 6);
  Eigen::VectorXd heights(count);
  for (Index i = 0; i < count; ++i) {
    const Eigen::Vector3d p =
        (row3(positions, vertices[static_cast<std::size_t>(i)]) - middle) / kUnitMm;
    const double a = p.dot(x), b = p.dot(y);
    surface.row(i) << 1, a, b, a * a, a * b, b * b;
    heights(i) = p.dot(up);
  }
  const Eigen::MatrixXd weighted = weights.asDiagonal() * surface;
  const Eigen::VectorXd fit =
      (surface.transpose() * weighted).ldlt().solve(weighted.transpose() * heights);
  return kUnitMm * (heights - surface * fit);
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
    if (feature.skin_vertices.size() >= kMinVertices) features.push_back(std::move(feature));
  }
  return features;
}

std::vector<double> relief_correlations(const WrapTemplate& wrap_template,
                                        const std::vector<FaceFeature>& features,
                                        const Positions& wrapped) {
  const SkinMesh& skin = wrap_template.skin;
  const Positions before = skin.rows_of(wrap_template.positions), after = skin.rows_of(wrapped);
  const Positions normals_before = vertex_normals_or_zero(skin.triangles, before),
                  normals_after = vertex_normals_or_zero(skin.triangles, after);
  const Eigen::VectorXd areas = areas_at_vertices(skin, before);
  std::vector<double> agreements;
  for (const FaceFeature& feature : features) {
    const Eigen::VectorXd weights = areas(feature.skin_vertices);
    const Eigen::VectorXd a = relief(before, normals_before, feature.skin_vertices, weights),
                          b = relief(after, normals_after, feature.skin_vertices, weights);
    const auto product = [&](const Eigen::VectorXd& p, const Eigen::VectorXd& q) {
      return (weights.array() * p.array() * q.array()).sum();
    };
    const double sizes = std::sqrt(product(a, a) * product(b, b));
    agreements.push_back(sizes > 0 ? product(a, b) / sizes : 0);
  }
  return agreements;
}

}  // namespace crowdface
