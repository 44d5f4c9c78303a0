// SPDX-License-Identifier: Apache-2.0
#include "crowdface/bake/bake_template.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <Eigen/Geometry>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/picture_layout.h"
#include "crowdface/io/tile_files.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/texture/triangle_texels.h"

namespace crowdface {
namespace {

/// Removes textures that the skin does not use. Adds an entry with an empty path to `files` for
/// each material and tile of the skin that has no texture.
/// \param is_skin  for each polygon, whether it belongs to the skin
void choose_pictures(const PolygonMaterials& materials, const std::vector<bool>& is_skin,
                     FoundTextureFiles& found) {
  HeadTextureFiles& placed = found.heads[0];
  if (placed.file_of_polygon.empty()) placed.file_of_polygon.assign(is_skin.size(), kNoIndex);
  std::set<std::uint32_t> used;
  bool tiled = false;
  for (std::size_t f = 0; f < is_skin.size(); ++f) {
    if (!is_skin[f]) continue;
    if (placed.file_of_polygon[f] != kNoIndex) {
      used.insert(placed.file_of_polygon[f]);
    } else if (found.tile_of_polygon[f] != std::array<std::int32_t, 2>{0, 0}) {
      tiled = true;
    }
  }
  std::map<std::pair<std::uint32_t, std::array<std::int32_t, 2>>, std::uint32_t> rows;
  for (std::size_t f = 0; f < is_skin.size(); ++f) {
    std::uint32_t& file = placed.file_of_polygon[f];
    if (file != kNoIndex) {
      if (!used.contains(file)) file = kNoIndex;
    } else if (is_skin[f]) {
      const std::uint32_t material = materials.material_of_polygon[f];
      const auto [row, is_new] = rows.try_emplace({material, found.tile_of_polygon[f]},
                                                  static_cast<std::uint32_t>(placed.files.size()));
      if (is_new) {
        placed.files.push_back({{}, concat(materials.names[material], tiled ? kTileWord : "")});
      }
      file = row->second;
    }
  }
}

}  // namespace

BakeTemplate::BakeTemplate(const ObjFile& file, const WrapTemplate& wrap_template, int picture_side)
    : wrap_template_(wrap_template) {
  const Topology& topology = file.topology;
  skin_rows_.assign(static_cast<std::size_t>(topology.vertex_count), kNotSkin);
  for (std::uint32_t row = 0; row < wrap_template.skin.vertices.size(); ++row) {
    skin_rows_[wrap_template.skin.vertices[row]] = row;
  }
  std::vector<bool> is_skin(static_cast<std::size_t>(topology.face_count()), false);
  bool has_uvs = false;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto uvs = topology.face_uvs(f);
    if (uvs.empty() || std::ranges::count(uvs, kNoIndex) > 0) continue;
    is_skin[static_cast<std::size_t>(f)] = std::ranges::all_of(
        topology.face(f), [&](std::uint32_t v) { return skin_rows_[v] != kNotSkin; });
    has_uvs = has_uvs || is_skin[static_cast<std::size_t>(f)];
  }
  if (!has_uvs) {
    refuse_file(file.path,
                "--texture: expected texture coordinates on the template's skin, "
                "found none");
  }
  const PolygonMaterials materials = polygon_materials(file.materials, topology.face_count());
  FoundTextureFiles found =
      find_texture_files({topology, file.uvs, {{file.path.stem().string(), {}}}}, {&file, 1})
          .front();
  warnings_ = std::move(found.warnings);
  for (std::string& warning : leave_out_unreadable_files(found))
    warnings_.push_back(std::move(warning));
  const HeadTextureFiles own = found.heads[0];
  choose_pictures(materials, is_skin, found);
  TextureLayout layout;
  const std::vector<PictureSource> pictures = lay_out_pictures(found, layout);
  picture_names_ = crowdface::picture_names(found, pictures, materials);
  for (TextureLayout::Picture& picture : layout.pictures) picture = {picture_side, picture_side};
  for (std::size_t f = 0; f < layout.picture_of_polygon.size(); ++f) {
    if (layout.picture_of_polygon[f] == kNoIndex) continue;
    pictures_by_material_.try_emplace(materials.names[materials.material_of_polygon[f]],
                                      layout.picture_of_polygon[f]);
  }
  maps_ = read_mesh_maps(own, TextureKind::kColour, topology, file.uvs);
  for (std::uint32_t p = 0; p < pictures.size(); ++p) {
    texels_.emplace_back(topology, file.uvs, layout, p);
    textures_.push_back(pictures[p].file_index < maps_.textures.size()
                            ? maps_.textures[pictures[p].file_index].get()
                            : nullptr);
  }
  find_picture_vertices(file, layout);
}

void BakeTemplate::find_picture_vertices(const ObjFile& file, const TextureLayout& layout) {
  picture_vertices_.resize(wrap_template_.skin.vertices.size());
  const Topology& topology = file.topology;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const std::uint32_t picture = layout.picture_of_polygon[static_cast<std::size_t>(f)];
    if (picture == kNoIndex) continue;
    const auto& tile = layout.tile_of_polygon[static_cast<std::size_t>(f)];
    const auto vertices = topology.face(f), uvs = topology.face_uvs(f);
    if (std::ranges::count(uvs, kNoIndex) > 0) continue;
    const auto uv_at = [&](std::size_t corner) -> Eigen::Vector2d {
      return file.uvs.row(uvs[corner]).transpose() - Eigen::Vector2d(tile[0], tile[1]);
    };
    double uv_area = 0;
    for (std::size_t c = 1; c + 1 < uvs.size(); ++c) {
      uv_area += std::abs(cross(uv_at(c) - uv_at(0), uv_at(c + 1) - uv_at(0)));
    }
    const double area = face_area_vector(topology, f, wrap_template_.positions).norm();
    for (std::size_t c = 0; c < vertices.size(); ++c) {
      const std::uint32_t row = skin_rows_[vertices[c]];
      if (row == kNotSkin || picture_vertices_[row].picture != kNoIndex) continue;
      picture_vertices_[row] = {picture, uv_at(c), area > 0 ? std::sqrt(uv_area / area) : 0};
    }
  }
}

}  // namespace crowdface
