// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/camera_space.h"

#include <algorithm>
#include <utility>

#include <Eigen/Geometry>

#include "crowdface/core/error.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

constexpr Index kVertexBlock = 4096;

/// Checks that positions are finite. \param first  vertex index of the first row, for the message
void check_finite(const Eigen::Ref<const Positions>& some, Index first) {
  if (some.allFinite()) return;
  Index i = 0;
  while (some.row(i).allFinite()) ++i;
  throw InvalidInput(concat("a render needs finite positions, but that of vertex ", first + i + 1,
                            " is not finite"));
}

}  // namespace

Eigen::Vector3f to_camera_space(const Camera& camera, Axis axis) {
  const Eigen::Vector3d d = unit_vector(axis);
  return Eigen::Vector3d(d.dot(camera.right), d.dot(camera.up), d.dot(camera.back)).cast<float>();
}

std::vector<float> to_camera_space(const Positions& positions, const Camera& camera) {
  std::vector<float> points;
  to_camera_space(positions, camera, points);
  return points;
}

void to_camera_space(const Positions& positions, const Camera& camera, std::vector<float>& points) {
  Eigen::Matrix3d axes;
  axes << camera.right.transpose(), camera.up.transpose(), camera.back.transpose();
  axes /= camera.half_extent();
  // reserves one more float, which RayScene appends
  points.reserve(static_cast<std::size_t>(positions.rows()) * 3 + 1);
  points.resize(static_cast<std::size_t>(positions.rows()) * 3);
  parallel_blocks(positions.rows(), kVertexBlock, [&](Index begin, Index end) {
    check_finite(positions.middleRows(begin, end - begin), begin);
    for (Index i = begin; i < end; ++i) {
      const Eigen::Vector3f point = (axes * (row3(positions, i) - camera.target)).cast<float>();
      std::copy_n(point.data(), 3, points.begin() + 3 * i);
    }
  });
}

std::vector<Eigen::Vector3f> camera_normals(const Topology& topology, const NormalFans& fans,
                                            const std::vector<float>& points, float sign) {
  CameraNormals result;
  result.compute(topology, fans, points, sign);
  return std::move(result.normals);
}

void CameraNormals::compute(const Topology& topology, const NormalFans& fans,
                            const std::vector<float>& points, float sign) {
  using Vector = Eigen::Vector3f;
  const auto point = [&](std::uint32_t vertex) {
    return Eigen::Map<const Vector>(points.data() + std::size_t{3} * vertex);
  };
  area_vectors.resize(static_cast<std::size_t>(topology.face_count()));
  parallel_for_each(topology.face_count(), kVertexBlock, [&](Index f) {
    const auto face = topology.face(f);
    Vector sum = Vector::Zero();
    for (std::size_t c = 1; c + 1 < face.size(); ++c) {
      sum += (point(face[c]) - point(face[0])).cross(point(face[c + 1]) - point(face[0]));
    }
    area_vectors[static_cast<std::size_t>(f)] = sum;
  });
  normals.resize(static_cast<std::size_t>(fans.rows()));
  parallel_for_each(fans.rows(), kVertexBlock, [&](Index i) {
    Vector sum = Vector::Zero();
    for (const std::uint32_t face : fans.polygons_at(i)) sum += area_vectors[face];
    const float length = sum.norm();
    normals[static_cast<std::size_t>(i)] =
        length > 0 ? Vector(sum * (sign / length)) : Vector(sign * Vector::UnitZ());
  });
}

}  // namespace crowdface
