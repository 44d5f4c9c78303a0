// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/usd_attachments.h"

#include <algorithm>
#include <filesystem>

#include "crowdface/core/error.h"
#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/io/image.h"
#include "crowdface/io/surface_materials.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// \param file_of  a texture as layers name it.
template <class FileOf>
UsdaSurface surface_of(const SurfaceMaterial& material, const FileOf& file_of) {
  UsdaSurface surface;
  if (material.colour) std::ranges::copy(*material.colour, surface.colour.begin());
  surface.colour[3] = material.opacity;
  for (float& value : surface.colour) value = std::clamp(value, 0.0F, 1.0F);
  const fs::path& colours = material.colour_map;
  const fs::path& holes = material.opacity_map.empty() ? colours : material.opacity_map;
  if (!colours.empty()) {
    read_image_size(colours, {.jpeg = true});
    surface.picture = file_of(colours);
  }
  if (holes.empty()) return surface;
  surface.holes_in_alpha = read_image(holes, {.jpeg = true}).alpha_channel >= 0;
  if (surface.holes_in_alpha || !material.opacity_map.empty()) surface.holes = file_of(holes);
  return surface;
}

/// \param name  the prim's
UsdaPart part_of(const Attachment& item, std::string name, const Inputs& inputs,
                 const std::string& shared) {
  const FaceMaterials named = face_materials(item.file.materials, item.file.topology.face_count());
  const auto file_of = [&](const fs::path& from) {
    const auto file = std::ranges::find(item.materials.files, from, &MaterialFile::from);
    return (fs::path(shared) / attachment_folder(item.name) / file->relative).generic_string();
  };
  std::vector<UsdaPart::Material> materials;
  for (const SurfaceMaterial& material : surface_materials_of(named.names, item.materials)) {
    materials.push_back({material.name, {}});
    try {
      materials.back().surface = surface_of(material, file_of);
    } catch (const InvalidInput& error) {
      log_warning(concat(error.what(), "; USD layers do without"));
    }
  }
  std::vector<std::string> targets;
  for (const Shape& shape : inputs.shapes.shapes) targets.push_back(shape.name);
  return {std::move(name),      item.file.topology, item.file.uvs,
          std::move(materials), named.of_face,      targets};
}

}  // namespace

UsdAttachments::UsdAttachments(const Inputs& inputs, const std::string& shared) {
  UsdaNames names;
  for (const char* taken : {"face", "mesh", "materials", "skeleton", "animation", "points"}) {
    names.add(taken);
  }
  for (const Attachment& item : inputs.attachments.items) {
    parts_.emplace(&item, part_of(item, names.add(item.name), inputs, shared));
  }
}

std::vector<PlacedUsdaPart> UsdAttachments::parts(std::span<const WornAttachment> worn) const {
  std::vector<PlacedUsdaPart> parts;
  for (const WornAttachment& one : worn) {
    parts.push_back({&parts_.at(one.item), &one.positions, one.moves});
  }
  return parts;
}

std::size_t UsdAttachments::memory_bytes() const {
  std::size_t bytes = 0;
  for (const auto& [item, part] : parts_) bytes += part.memory_bytes();
  return bytes;
}

std::size_t UsdAttachments::encode_bytes() const {
  std::size_t bytes = 0;
  for (const auto& [item, part] : parts_) bytes += part.encode_bytes();
  return bytes;
}

}  // namespace crowdface
