// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pick/pickable_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "crowdface/mesh/vector3.h"
#include "crowdface/page/binary_answer.h"
#include "crowdface/preview/reduced_mesh.h"

namespace crowdface {
namespace {

/// Bounding box of the triangles. Unused vertices may lie anywhere.
Eigen::AlignedBox3d box_of(const Positions& positions, const std::vector<Triangle>& triangles) {
  Eigen::AlignedBox3d box;
  for (const Triangle& t : triangles) {
    for (const std::uint32_t v : t) box.extend(row3(positions, v));
  }
  if (triangles.empty()) box.extend(Eigen::Vector3d(0, 0, 0));
  return box;
}

std::vector<Triangle> joined(std::vector<Triangle> triangles, const std::vector<Triangle>& more) {
  triangles.insert(triangles.end(), more.begin(), more.end());
  return triangles;
}

}  // namespace

PickableMesh::PickableMesh(Positions positions, std::vector<Triangle> skin,
                           const std::vector<Triangle>& others)
    : positions_(std::move(positions)),
      skin_(std::move(skin)),
      quads_(quads_of(joined(skin_, others))),
      normals_(vertex_normals_or_zero(joined(skin_, others), positions_)),
      box_(box_of(positions_, skin_)),
      middle_(box_.center()),
      scene_(device_, points_around(positions_, middle_), quads_),
      tree_(positions_, skin_) {}

PickedPlace PickableMesh::place_in_triangle(const Triangle& corners,
                                            const std::array<double, 3>& barycentric) const {
  PickedPlace place;
  for (std::size_t k = 0; k < 3; ++k) {
    place.point += barycentric[k] * row3(positions_, corners[k]);
    place.normal += barycentric[k] * row3(normals_, corners[k]);
  }
  place.normal = place.normal.normalized();
  place.vertex = *std::ranges::min_element(corners, {}, [&](std::uint32_t corner) {
    return (row3(positions_, corner) - place.point).squaredNorm();
  });
  return place;
}

std::optional<PickableMesh::Hit> PickableMesh::first_hit(const Eigen::Vector3d& origin,
                                                         const Eigen::Vector3d& direction) const {
  const Eigen::Vector3d way = direction.normalized();
  const Ray ray{(origin - middle_).cast<float>(), way.cast<float>()};
  const auto hit = scene_.nearest_hits(std::span(&ray, 1)).front();
  if (!hit) return std::nullopt;
  const Quad& quad = quads_[hit->primitive];
  const double u = hit->u, v = hit->v;
  return Hit{hit->primitive, hit->primitive < skin_.size(),
             (1 - u - v) * row3(positions_, quad[0]) + u * row3(positions_, quad[1]) +
                 v * row3(positions_, quad[2])};
}

std::optional<PickedPlace> PickableMesh::cast_ray(const Eigen::Vector3d& origin,
                                                  const Eigen::Vector3d& direction,
                                                  double max_skin_distance) const {
  const auto hit = first_hit(origin, direction);
  if (!hit) return std::nullopt;
  if (hit->is_skin) {
    const Triangle& corners = skin_[hit->triangle];
    return place_in_triangle(corners,
                             nearest_on_triangle(positions_, corners, hit->point).barycentric);
  }
  return nearest(hit->point, -direction.normalized(), 0, max_skin_distance);
}

std::optional<PickedPlace> PickableMesh::nearest(const Eigen::Vector3d& point,
                                                 const Eigen::Vector3d& facing, double min_cosine,
                                                 double reach) const {
  const SurfaceHit hit = tree_.nearest_facing(point, facing, min_cosine, reach);
  if (hit.triangle == kNoIndex) return std::nullopt;
  return place_in_triangle(skin_[hit.triangle], hit.barycentric);
}

PickedPlace PickableMesh::place_at_vertex(std::uint32_t vertex) const {
  return {vertex, row3(positions_, vertex), row3(normals_, vertex)};
}

PickedPlace PickableMesh::place_at_point(const Eigen::Vector3d& point) const {
  const SurfaceHit hit = tree_.nearest(point, std::numeric_limits<double>::infinity());
  if (hit.triangle == kNoIndex) return {kNoIndex, point, Eigen::Vector3d::Zero()};
  PickedPlace place = place_in_triangle(skin_[hit.triangle], hit.barycentric);
  place.point = point;
  return place;
}

std::string PickableMesh::encode_reduced(std::size_t max_triangles,
                                         const ColourRows& colours) const {
  std::vector<Triangle> all;
  all.reserve(quads_.size());
  for (const Quad& quad : quads_) all.push_back({quad[0], quad[1], quad[2]});
  all = reduce_triangles(all, positions_, max_triangles);

  std::vector<bool> is_skin(static_cast<std::size_t>(positions_.rows()));
  for (const Triangle& t : skin_) {
    for (const std::uint32_t v : t) is_skin[v] = true;
  }
  constexpr double kSteps = 32767;
  std::vector<std::uint32_t> row(is_skin.size(), kNoIndex), triangles;
  std::vector<float> points;
  std::vector<std::int16_t> normals;
  std::vector<std::uint8_t> part, shown_colours;
  for (const Triangle& t : all) {
    for (const std::uint32_t v : t) {
      if (row[v] == kNoIndex) {
        row[v] = static_cast<std::uint32_t>(part.size());
        for (int c = 0; c < 3; ++c) {
          points.push_back(static_cast<float>(positions_(v, c) - middle_[c]));
          normals.push_back(static_cast<std::int16_t>(std::lround(kSteps * normals_(v, c))));
        }
        part.push_back(is_skin[v] ? 0 : 1);
        for (int c = 0; c < 3 && colours.rows() > 0; ++c) shown_colours.push_back(colours(v, c));
      }
      triangles.push_back(row[v]);
    }
  }
  BinaryAnswer answer;
  const auto list = [](const Eigen::Vector3d& v) {
    return nlohmann::ordered_json::array({v.x(), v.y(), v.z()});
  };
  answer.json["origin"] = list(middle_);
  answer.json["low"] = list(box_min() - middle_);
  answer.json["high"] = list(box_max() - middle_);
  answer.json["whole_triangles"] = quads_.size();
  answer.add("positions", std::span<const float>(points));
  answer.add("normals", std::span<const std::int16_t>(normals));
  answer.add("triangles", std::span<const std::uint32_t>(triangles));
  answer.add("part", std::span<const std::uint8_t>(part));
  if (colours.rows() > 0) answer.add("colours", std::span<const std::uint8_t>(shown_colours));
  return answer.bytes();
}

}  // namespace crowdface
