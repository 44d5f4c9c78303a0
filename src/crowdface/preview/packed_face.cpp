// SPDX-License-Identifier: Apache-2.0
#include "crowdface/preview/packed_face.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "crowdface/core/require.h"
#include "crowdface/mesh/normals.h"

namespace crowdface {
namespace {

constexpr double kSteps = 65535;

void append(std::string& bytes, double value) {
  const auto number = static_cast<std::uint32_t>(std::lround(std::clamp(value, 0.0, kSteps)));
  bytes += static_cast<char>(number & 0xFFU);
  bytes += static_cast<char>(number >> 8U);
}

/// The octahedral encoding of a unit vector, in [−1, 1]².
Eigen::Vector2d octahedral(const Eigen::Vector3d& normal) {
  const Eigen::Vector3d n = normal / normal.lpNorm<1>();
  if (n.z() >= 0) return n.head<2>();
  const auto sign = [](double value) { return value < 0 ? -1.0 : 1.0; };
  return {(1 - std::abs(n.y())) * sign(n.x()), (1 - std::abs(n.x())) * sign(n.y())};
}

Eigen::Vector3d normal_at(const Topology& topology, const Positions& positions,
                          std::span<const std::uint32_t> faces) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::uint32_t face : faces) sum += face_area_vector(topology, face, positions);
  const double length = sum.norm();
  return length > 0 ? Eigen::Vector3d(sum / length) : Eigen::Vector3d::UnitZ();
}

}  // namespace

PackingGrid PackingGrid::enclosing(std::span<const Positions* const> heads) {
  Eigen::AlignedBox3d box;
  for (const Positions* head : heads) {
    if (head->rows() == 0) continue;
    box.extend(Eigen::Vector3d(head->colwise().minCoeff().transpose()));
    box.extend(Eigen::Vector3d(head->colwise().maxCoeff().transpose()));
  }
  require(!box.isEmpty(), "packed faces: expected heads with vertices, found none");
  const double half = std::max(0.75 * box.sizes().maxCoeff(), 1e-12);
  return {box.center() - Eigen::Vector3d::Constant(half), 2 * half / kSteps};
}

std::string pack_points(std::span<const std::uint32_t> vertices, const PackingGrid& frame,
                        const Positions& positions) {
  std::string bytes;
  bytes.reserve(10 * vertices.size());  // space for the normals too
  for (const std::uint32_t vertex : vertices) {
    for (int axis = 0; axis < 3; ++axis) {
      append(bytes, (positions(vertex, axis) - frame.low_corner[axis]) / frame.step);
    }
  }
  return bytes;
}

std::string pack_face(const Topology& topology, std::span<const std::uint32_t> vertices,
                      const VertexFaces& vertex_faces, const PackingGrid& frame,
                      const Positions& positions) {
  require(positions.rows() == topology.vertex_count, "pack: ", positions.rows(), " positions, ",
          topology.vertex_count, " vertices");
  std::string bytes = pack_points(vertices, frame, positions);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const Eigen::Vector2d square =
        octahedral(normal_at(topology, positions, vertex_faces.items_of(vertices[v])));
    for (int axis = 0; axis < 2; ++axis) append(bytes, (square[axis] + 1) / 2 * kSteps);
  }
  return bytes;
}

std::string pack_displacement(const Eigen::RowVector3d& move, const PackingGrid& frame) {
  constexpr double kMax = 32767;
  std::string bytes;
  for (int axis = 0; axis < 3; ++axis) {
    const double steps = std::clamp(move[axis] / frame.step, -kMax, kMax);
    const auto value = static_cast<std::uint16_t>(std::lround(steps));
    bytes += static_cast<char>(value & 0xFFU);
    bytes += static_cast<char>(value >> 8U);
  }
  return bytes;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto byte = i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U;
      group = group << 8U | byte;
    }
    const std::size_t left = bytes.size() - i;
    text += kDigits[group >> 18U];
    text += kDigits[group >> 12U & 63U];
    text += left > 1 ? kDigits[group >> 6U & 63U] : '=';
    text += left > 2 ? kDigits[group & 63U] : '=';
  }
  return text;
}

}  // namespace crowdface
