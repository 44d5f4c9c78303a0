// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/io/image.h"
#include "crowdface/io/material_files.h"
#include "crowdface/io/usda_template.h"
#include "crowdface/io/usda_text.h"
#include "crowdface/run/attachments_in_format.h"
#include "crowdface/run/crowd_glb_options.h"
#include "crowdface/run/mesh_encoder.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// Converts a material to USD.
/// \param file_of  returns the path by which USD layers refer to a texture of the material
template <class FileOf>
UsdaSurface surface_of(const SurfaceMaterial& material, const FileOf& file_of) {
  UsdaSurface surface;
  if (material.colour) std::ranges::copy(*material.colour, surface.colour.begin());
  surface.colour[3] = material.opacity;
  const fs::path& colours = material.colour_map;
  const fs::path& holes = material.opacity_map.empty() ? colours : material.opacity_map;
  if (!colours.empty()) {
    read_image_size(colours, {.allows_jpeg = true});
    surface.colour_map = file_of(colours);
  }
  if (holes.empty()) return surface;
  surface.is_opacity_in_alpha = read_image(holes, {.allows_jpeg = true}).alpha_channel >= 0;
  if (surface.is_opacity_in_alpha || !material.opacity_map.empty())
    surface.opacity_map = file_of(holes);
  return surface;
}

/// The USD prim name and the materials of an attachment.
struct PrimLook {
  std::string prim;
  std::vector<UsdaPart::Material> materials;
  std::vector<std::uint32_t> of_face;
};

PrimLook prim_look_of(const Attachment& item, std::string prim, const MeshSource& source) {
  PolygonMaterials named = polygon_materials(item.file.materials, item.file.topology.face_count());
  if (has_own_texture(source, item)) {
    PrimLook look{std::move(prim), {}, std::move(named.material_of_polygon)};
    for (const std::string& name : named.names) {
      look.materials.push_back({name, {}});
      look.materials.back().surface.colour_map =
          concat("./", kBlendedFolder, '/', UsdaPart::kLookPlaceholder, ".body.png");
    }
    return look;
  }
  const std::string shared = source.shared_folder.empty() ? "." : source.shared_folder;
  const auto file_of = [&](const fs::path& from) {
    const auto file = std::ranges::find(item.materials.files, from, &MaterialFile::source);
    fs::path folder = fs::path(shared) / attachment_folder(item.name);
    if (item.tint != Tint::kNone) folder /= UsdaPart::kLookPlaceholder;
    return (folder / file->destination).generic_string();
  };
  PrimLook look{std::move(prim), {}, std::move(named.material_of_polygon)};
  for (const SurfaceMaterial& material : surface_materials_of(named.names, item.materials)) {
    look.materials.push_back({material.name, {}});
    try {
      look.materials.back().surface = surface_of(material, file_of);
    } catch (const InvalidInput& error) {
      log_warning(concat(error.what(), "; USD layers omit it"));
    }
  }
  return look;
}

std::map<const Attachment*, PrimLook> prim_looks(const MeshSource& source) {
  UsdaNames names;
  for (const char* taken : {"face", "mesh", "materials", "skeleton", "animation", "points"}) {
    names.add(taken);
  }
  std::map<const Attachment*, PrimLook> looks;
  for (const Attachment* item :
       source.levels.front().attachments_in_files(source.inputs.attachments)) {
    looks.emplace(item, prim_look_of(*item, names.add(item->name), source));
  }
  return looks;
}

}  // namespace

MeshEncoders usd_encoders(const MeshSource& source) {
  const Inputs& inputs = source.inputs;
  const auto looks = prim_looks(source);
  std::vector<std::string> targets;
  for (const Shape& shape : inputs.shapes.shapes) targets.push_back(shape.name);
  const auto make_part = [&](const Attachment& item, const DetailLevel* here) {
    const auto& [prim, materials, of_face] = looks.at(&item);
    GivenNormals fixed = normals_at_neck_ring(inputs, item, here);
    if (here == nullptr) {
      return UsdaPart(prim, item.file.topology, item.file.uvs, materials, of_face, targets,
                      std::move(fixed));
    }
    return UsdaPart(prim, here->topology, here->uvs, materials,
                    select_rows(of_face, here->source_faces), targets, std::move(fixed));
  };
  using FormatData = MeshWithAttachments<UsdaTemplate, UsdaPart>;
  MeshEncoders encoders;
  for (const MeshLevel& level : source.levels) {
    // Meshes at a reduced level of detail are not subdivided, because they are coarse on purpose.
    const Subdivision subdivision =
        level.is_whole_mesh() ? source.config.output.subdivision : Subdivision::kNone;
    encoders.push_back(make_encoder(
        std::make_shared<const FormatData>(
            FormatData{UsdaTemplate(level.topology(inputs), level.uvs(inputs),
                                    glb_options(source.config, inputs, source.shared_folder, level),
                                    subdivision),
                       AttachmentsInFormat<UsdaPart>(inputs.attachments, level, make_part)}),
        [](const FormatData& format_data, const FaceMesh& face) {
          return format_data.mesh.encode(
              *face.positions, *face.normals, face.id, face.moves, face.image_names, *face.points,
              format_data.parts.placed<PlacedUsdaPart>(face.placed_attachments), *face.colours);
        }));
  }
  return encoders;
}

}  // namespace crowdface
