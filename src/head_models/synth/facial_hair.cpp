// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/facial_hair.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Core>

#include "crowdface/core/parallel.h"
#include "crowdface/mesh/all_columns.h"
#include "crowdface/mesh/normals.h"
#include "head_models/synth/hair_picture.h"
#include "head_models/synth/noise.h"
#include "head_models/synth/skin_paint.h"

namespace crowdface::synth {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kAboveSkin = 0.04;      // cm
constexpr double kTexelsPerUnit = 2048;  // texels per unit of texture coordinates
constexpr int kMaxTexels = 512;
constexpr std::uint64_t kSeed = 41;  // seed of the noise in the strands

SkinPaint paint_of(const FacialHair& style) {
  Complexion look;
  look.brow_density = style.brow_density;
  look.brow_width = style.brow_width;
  look.brow_arch = style.brow_arch;
  look.beard = style.cheek_beard;
  look.moustache = style.lip_beard;
  look.chin_beard = style.chin_beard;
  return SkinPaint(kSeed, 1, 1, look);
}

/// Returns the point of a polygon at parameters (s, t), interpolated between the corners of the
/// polygon.
Vector3d point_of(const Mesh& mesh, std::span<const std::uint32_t> corners, double s, double t) {
  const auto at = [&](std::size_t c) -> Vector3d {
    return mesh.positions.row(corners[std::min(c, corners.size() - 1)]).transpose();
  };
  return (1 - t) * ((1 - s) * at(0) + s * at(1)) + t * ((1 - s) * at(3) + s * at(2));
}

/// Returns the polygons of the skin that hair covers partly or completely.
template <class Cover>
std::vector<Index> covered_faces(const Mesh& skin, const Cover& cover) {
  constexpr int kSteps = 6;
  constexpr double kLeast = 0.02;
  std::vector<char> is_covered(static_cast<std::size_t>(skin.topology.face_count()));
  parallel_for_each(is_covered.size(), [&](std::size_t f) {
    const auto corners = skin.topology.face(static_cast<Index>(f));
    for (int i = 0; i <= kSteps * kSteps + 2 * kSteps && is_covered[f] == 0; ++i) {
      const double s = static_cast<double>(i % (kSteps + 1)) / kSteps;
      const int row = i / (kSteps + 1);
      const double t = static_cast<double>(row) / kSteps;
      if (cover(point_of(skin, corners, s, t)) > kLeast) is_covered[f] = 1;
    }
  });
  std::vector<Index> faces;
  for (std::size_t f = 0; f < is_covered.size(); ++f) {
    if (is_covered[f] != 0) faces.push_back(static_cast<Index>(f));
  }
  return faces;
}

/// Calls paint(x, y, point) for each texel of a triangle.
template <class Paint>
void fill_triangle(const std::array<Vector2d, 3>& uv, const std::array<Vector3d, 3>& points,
                   int width, int height, const Paint& paint) {
  const auto cross = [](const Vector2d& a, const Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
  };
  std::array<Vector2d, 3> at;
  for (std::size_t c = 0; c < 3; ++c) at[c] = {uv[c].x() * width, (1 - uv[c].y()) * height};
  const double area = cross(at[1] - at[0], at[2] - at[0]);
  if (area == 0) return;
  const auto first = [](double low) { return std::max(0, static_cast<int>(std::floor(low))); };
  const auto across = std::minmax({at[0].x(), at[1].x(), at[2].x()});
  const auto down = std::minmax({at[0].y(), at[1].y(), at[2].y()});
  constexpr double kEdge = -1e-6;
  for (int y = first(down.first); y < std::min(height, static_cast<int>(down.second) + 1); ++y) {
    for (int x = first(across.first); x < std::min(width, static_cast<int>(across.second) + 1);
         ++x) {
      const Vector2d place(x + 0.5, y + 0.5);
      const double b = cross(place - at[0], at[2] - at[0]) / area;
      const double c = cross(at[1] - at[0], place - at[0]) / area;
      if (std::min({1 - b - c, b, c}) < kEdge) continue;
      paint(x, y, (1 - b - c) * points[0] + b * points[1] + c * points[2]);
    }
  }
}

}  // namespace

std::span<const FacialHair> facial_hairs() {
  static constexpr auto kStyles = std::to_array<FacialHair>({
      {.name = "brows_fine",
       .is_for_women = true,
       .brow_width = 0.7,
       .brow_arch = 0.3,
       .brow_density = 1.15},
      {.name = "brows_arched",
       .is_for_women = true,
       .brow_width = 0.7,
       .brow_arch = 0.5,
       .brow_density = 1.15},
      {.name = "brows_soft",
       .is_for_women = true,
       .brow_width = 0.8,
       .brow_arch = 0.33,
       .brow_density = 1},
      {.name = "brows_full",
       .is_for_women = true,
       .brow_width = 0.9,
       .brow_arch = 0.37,
       .brow_density = 1.1},
      {.name = "brows_straight", .brow_width = 1.25, .brow_density = 1},
      {.name = "brows_broad", .brow_width = 1.45, .brow_density = 1.05},
      {.name = "brows_thin", .brow_width = 1.2, .brow_arch = 0.02, .brow_density = 0.95},
      {.name = "brows_bushy", .brow_width = 1.6, .brow_arch = 0.08, .brow_density = 1.15},
      {.name = "stubble",
       .is_beard = true,
       .relative_frequency = 2,
       .cheek_beard = 0.45,
       .lip_beard = 0.45,
       .chin_beard = 0.45},
      {.name = "moustache",
       .is_beard = true,
       .relative_frequency = 0.5,
       .cheek_beard = 0.12,
       .lip_beard = 1,
       .chin_beard = 0.12},
      {.name = "goatee",
       .is_beard = true,
       .relative_frequency = 0.8,
       .cheek_beard = 0.15,
       .lip_beard = 0.95,
       .chin_beard = 1},
      {.name = "full_beard",
       .is_beard = true,
       .relative_frequency = 1.2,
       .cheek_beard = 1,
       .lip_beard = 0.95,
       .chin_beard = 1},
  });
  return kStyles;
}

FacialHairLayer facial_hair_layer(const FacialHair& style, const Mesh& skin) {
  const SkinPaint paint = paint_of(style);
  const auto cover = [&](const Vector3d& p) {
    return style.is_beard ? paint.beard_coverage(p) : paint.brow_coverage(p);
  };
  const std::vector<Index> faces = covered_faces(skin, cover);
  const Positions normals =
      vertex_normals(NormalFans(skin.topology), skin.topology, skin.positions);
  FacialHairLayer layer;
  Topology& topology = layer.mesh.topology;
  for (const Index f : faces) topology.add_face(skin.topology.face(f), skin.topology.face_uvs(f));
  const auto rows = renumber(topology.corner_vertices, skin.topology.vertex_count);
  const auto uv_rows = renumber(topology.corner_uvs, skin.uvs.rows());
  topology.vertex_count = static_cast<Index>(rows.size());
  const Positions on_skin = skin.positions(rows, kAllColumns);
  layer.mesh.positions = on_skin + kAboveSkin * normals(rows, kAllColumns);
  // The texture of the layer covers only a part of the head's texture: the bounding rectangle of
  // the layer's polygons.
  TextureCoordinates uvs = skin.uvs(uv_rows, kAllColumns);
  const Eigen::RowVector2d low = uvs.colwise().minCoeff(), high = uvs.colwise().maxCoeff();
  uvs = (uvs.rowwise() - low).array().rowwise() / (high - low).array();
  const auto texels = [](double size) {
    return std::clamp(static_cast<int>(std::lround(kTexelsPerUnit * size)), 16, kMaxTexels);
  };
  layer.width = texels(high.x() - low.x());
  layer.height = texels(high.y() - low.y());
  layer.pixels.assign(
      4 * static_cast<std::size_t>(layer.width) * static_cast<std::size_t>(layer.height), 0);
  const std::uint8_t neutral = to_byte(kNeutralTone);
  for (std::size_t i = 0; i < layer.pixels.size(); ++i) {
    if (i % 4 != 3) layer.pixels[i] = neutral;
  }
  const SmoothNoise strands(kSeed, 0.09);
  const auto paint_texel = [&](int x, int y, const Vector3d& p) {
    const std::size_t texel =
        4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(layer.width) +
             static_cast<std::size_t>(x));
    const double light =
        kNeutralTone * (0.82 + 0.2 * strands.at({1.6 * p.x(), 0.4 * p.y(), p.z()}));
    for (std::size_t c = 0; c < 3; ++c) layer.pixels[texel + c] = to_byte(light);
    layer.pixels[texel + 3] = to_byte(std::clamp(cover(p), 0.0, 1.0));
  };
  parallel_for_each(topology.face_count(), Index{16}, [&](Index f) {
    const auto corners = topology.face(f), of_uvs = topology.face_uvs(f);
    for (std::size_t c = 2; c < corners.size(); ++c) {
      std::array<Vector2d, 3> uv;
      std::array<Vector3d, 3> points;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t corner = k == 0 ? 0 : c + k - 2;
        uv[k] = uvs.row(of_uvs[corner]).transpose();
        points[k] = on_skin.row(corners[corner]).transpose();
      }
      fill_triangle(uv, points, layer.width, layer.height, paint_texel);
    }
  });
  layer.mesh.uvs = std::move(uvs);
  return layer;
}

}  // namespace crowdface::synth
