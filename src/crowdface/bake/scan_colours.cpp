// SPDX-License-Identifier: Apache-2.0
#include "crowdface/bake/scan_colours.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "crowdface/core/parallel.h"
#include "crowdface/core/scratch_folder.h"
#include "crowdface/heads/image_values.h"
#include "crowdface/io/image.h"
#include "crowdface/io/material_files.h"
#include "crowdface/io/mesh_textures.h"
#include "crowdface/io/obj_colours.h"
#include "crowdface/io/srgb.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/texture/triangle_texels.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

TextureMap map_of(const Image& image, TextureKind kind) {
  if (kind == TextureKind::kColour) {
    return make_texture_map(image.width, image.height, linear_light_of(image));
  }
  return make_texture_map(image.width, image.height, normal_slopes_of(image),
                          MapCoding::slope_coding());
}

/// For each texel of an image file, whether a polygon that uses the file covers the texel's centre.
std::vector<bool> coverage(const MeshMaps& maps, std::uint32_t file, int width, int height,
                           const Topology& topology, const TextureCoordinates& uvs) {
  std::vector<bool> covered(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (Index f = 0; f < topology.face_count(); ++f) {
    if (maps.texture_of_polygon[static_cast<std::size_t>(f)] != file) continue;
    const auto corners = topology.face_uvs(f);
    if (std::ranges::count(corners, kNoIndex) > 0) continue;
    const auto& tile = maps.tile_of_polygon[static_cast<std::size_t>(f)];
    const auto at = [&](std::size_t corner) -> Eigen::Vector2d {
      const auto uv = uvs.row(corners[corner]);
      return {(uv[0] - tile[0]) * width, (1 - (uv[1] - tile[1])) * height};
    };
    for (std::size_t c = 1; c + 1 < corners.size(); ++c) {
      for_each_texel({at(0), at(c), at(c + 1)}, width, height, [&](int x, int y) {
        covered[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(x)] = true;
      });
    }
  }
  return covered;
}

/// Returns the lower left corner (u, v) of the unit square of texture space that contains the
/// centre of a polygon. Textures repeat in each unit square.
std::array<std::int32_t, 2> unit_square_of(std::span<const std::uint32_t> corners,
                                           const TextureCoordinates& uvs) {
  constexpr double kFarthest = 1e6;
  Eigen::RowVector2d sum(0, 0);
  for (const std::uint32_t uv : corners) {
    if (uv == kNoIndex) return {0, 0};
    sum += uvs.row(uv);
  }
  const Eigen::RowVector2d middle = sum / static_cast<double>(corners.size());
  if (!(middle.cwiseAbs().maxCoeff() < kFarthest)) return {0, 0};
  return {static_cast<std::int32_t>(std::floor(middle.x())),
          static_cast<std::int32_t>(std::floor(middle.y()))};
}

}  // namespace

MeshMaps read_mesh_maps(const HeadTextureFiles& textures, TextureKind kind,
                        const Topology& topology, const TextureCoordinates& uvs) {
  MeshMaps maps;
  maps.texture_of_polygon = textures.file_of_polygon;
  if (textures.files.empty()) return maps;
  maps.tile_of_polygon.resize(static_cast<std::size_t>(topology.face_count()));
  constexpr Index kBlock = 16384;
  parallel_for_each(topology.face_count(), kBlock, [&](Index f) {
    maps.tile_of_polygon[static_cast<std::size_t>(f)] = unit_square_of(topology.face_uvs(f), uvs);
  });
  maps.textures.resize(textures.files.size());
  parallel_for_each(textures.files.size(), [&](std::size_t i) {
    TextureMap map = map_of(read_image(textures.files[i].path, {.allows_jpeg = true}), kind);
    std::vector<bool> covered =
        coverage(maps, static_cast<std::uint32_t>(i), map.width, map.height, topology, uvs);
    maps.textures[i] = std::make_unique<FilteredTexture>(std::move(map), std::move(covered));
  });
  return maps;
}

ScanColours::ScanColours(FileMesh mesh, const fs::path& file) {
  mesh_.topology = std::move(mesh.topology);
  mesh_.uvs = std::move(mesh.uvs);
  const Topology& topology = mesh_.topology;
  // List the corners of each triangle, in the order of triangles_of.
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto [begin, end] = topology.corners(f);
    for (std::uint32_t c = begin + 1; c + 1 < end; ++c) {
      triangle_corners_.push_back({static_cast<std::uint32_t>(f), begin, c, c + 1});
    }
  }
  // Read textures: files that material files name, or images inside the mesh file.
  const ScratchFolder scratch;
  for (MaterialRange& range : mesh.materials) range.name = material_name_of(range.name);
  ObjFile named;
  named.path = file;
  named.materials = mesh.materials;
  named.material_libraries = mesh.material_libraries;
  if (!mesh.textures.empty()) {
    named.material_libraries = {write_mesh_textures(mesh, scratch.path(), "scan")};
    named.material_base = scratch.path() / "scan";
  }
  FoundTextureFiles found = find_texture_files(mesh_, {&named, 1}).front();
  warnings_ = std::move(found.warnings);
  for (std::string& warning : leave_out_unreadable_files(found))
    warnings_.push_back(std::move(warning));
  colours_ = read_mesh_maps(found.heads[0], TextureKind::kColour, topology, mesh_.uvs);
  // Read colours of vertices and of materials.
  if (mesh.colours.rows() > 0) vertex_linear_colours_ = linear_light(byte_colours(mesh.colours));
  PolygonMaterials materials = polygon_materials(mesh.materials, topology.face_count());
  const std::vector<SurfaceMaterial> looks =
      surface_materials_of(materials.names, find_material_files(file, mesh.material_libraries));
  for (std::size_t m = 0; m < materials.names.size(); ++m) {
    auto colour = looks[m].colour;
    const auto own = mesh.material_colours.find(materials.names[m]);
    if (own != mesh.material_colours.end()) colour = own->second;
    material_linear_colours_.push_back(colour);
  }
  material_of_polygon_ = std::move(materials.material_of_polygon);
  has_colours_ = !colours_.textures.empty() || has_vertex_colours() ||
                 std::ranges::any_of(material_linear_colours_,
                                     [](const auto& light) { return light.has_value(); });
}

std::optional<Eigen::Array3f> ScanColours::mean_at(const Scan& scan, const ScanArea& area) const {
  const TriangleCorners& source = triangle_corners_[scan.file_triangle_indices[area.triangle]];
  const std::uint32_t file =
      colours_.texture_of_polygon.empty() ? kNoIndex : colours_.texture_of_polygon[source.face];
  if (file != kNoIndex) {
    const auto& rows = mesh_.topology.corner_uvs;
    if (rows[source.first] != kNoIndex && rows[source.second] != kNoIndex &&
        rows[source.third] != kNoIndex) {
      const auto& tile = colours_.tile_of_polygon[source.face];
      const auto uv_of = [&](std::uint32_t corner) -> Eigen::Vector2d {
        return mesh_.uvs.row(rows[corner]).transpose();
      };
      const Eigen::Vector2d first = uv_of(source.first);
      const Eigen::Vector2d second = uv_of(source.second) - first;
      const Eigen::Vector2d third = uv_of(source.third) - first;
      // Express a vector in space as a combination of two edges of the triangle (least squares).
      const Triangle& corners = scan.triangles[area.triangle];
      const Eigen::Vector3d at = row3(scan.positions, corners[0]);
      const Eigen::Vector3d one = row3(scan.positions, corners[1]) - at;
      const Eigen::Vector3d other = row3(scan.positions, corners[2]) - at;
      const double aa = one.dot(one), ab = one.dot(other), bb = other.dot(other);
      const double det = aa * bb - ab * ab;
      const auto in_uv = [&](const Eigen::Vector3d& step) -> Eigen::Vector2d {
        if (!(det > 0)) return Eigen::Vector2d::Zero();
        const double a = one.dot(step), b = other.dot(step);
        return ((bb * a - ab * b) * second + (aa * b - ab * a) * third) / det;
      };
      const Eigen::Vector2d uv = first + area.barycentric[1] * second + area.barycentric[2] * third;
      return colours_.textures[file]->mean_at(uv - Eigen::Vector2d(tile[0], tile[1]),
                                              in_uv(area.to_right_texel),
                                              in_uv(area.to_lower_texel));
    }
  }
  if (has_vertex_colours()) {
    const auto& vertices = mesh_.topology.corner_vertices;
    const Eigen::Vector3d light =
        area.barycentric[0] * row3(vertex_linear_colours_, vertices[source.first]) +
        area.barycentric[1] * row3(vertex_linear_colours_, vertices[source.second]) +
        area.barycentric[2] * row3(vertex_linear_colours_, vertices[source.third]);
    return light.cast<float>().array();
  }
  const auto& light = material_linear_colours_[material_of_polygon_[source.face]];
  if (!light) return std::nullopt;
  return Eigen::Array3f((*light)[0], (*light)[1], (*light)[2]);
}

ColourRows colours_at_vertices(const Scan& scan, const ScanColours& colours) {
  if (!colours.has_colours()) return {};
  constexpr float kUnknown = 0.3F;
  ColourRows rows(scan.positions.rows(), 3);
  std::vector<bool> is_done(static_cast<std::size_t>(rows.rows()), false);
  for (std::size_t t = 0; t < scan.triangles.size(); ++t) {
    const Triangle& corners = scan.triangles[t];
    // Average the texture over the area that a vertex represents: a parallelogram whose sides are
    // half as long as two edges of the triangle.
    const Eigen::Vector3d first = row3(scan.positions, corners[0]);
    ScanArea area{static_cast<std::uint32_t>(t),
                  {},
                  (row3(scan.positions, corners[1]) - first) / 2,
                  (row3(scan.positions, corners[2]) - first) / 2};
    for (std::size_t c = 0; c < 3; ++c) {
      if (is_done[corners[c]]) continue;
      is_done[corners[c]] = true;
      area.barycentric = {};
      area.barycentric[c] = 1;
      const Eigen::Array3f light =
          colours.mean_at(scan, area).value_or(Eigen::Array3f::Constant(kUnknown));
      for (int k = 0; k < 3; ++k) {
        rows(corners[c], k) =
            static_cast<std::uint8_t>(std::lround(255 * srgb_of_linear(light[k])));
      }
    }
  }
  return rows;
}

}  // namespace crowdface
