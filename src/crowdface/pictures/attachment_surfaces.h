// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "crowdface/core/lazy_map.h"
#include "crowdface/heads/face_attachments.h"
#include "crowdface/io/material_files.h"
#include "crowdface/render/attachment_mesh.h"

namespace crowdface {

/// Converts the attachments of a crowd to meshes for rendering. Reads materials and textures on
/// first use. Thread-safe.
class AttachmentSurfaces {
 public:
  /// \param max_px    larger textures are reduced so that the longer side has this many texels.
  /// \param shows_textures  whether colour textures are shown; opacity is always applied.
  AttachmentSurfaces(int max_px, bool shows_textures)
      : max_px_(max_px), shows_textures_(shows_textures) {}

  /// The surface of an attachment. \param item  one of the attachments in the crowd's inputs
  const AttachmentSurface& at(const Attachment& item) const;
  /// The attachments of a face, for rendering. The result holds references to `placed` and to this
  /// object.
  std::vector<AttachmentMesh> meshes(const std::vector<PlacedAttachment>& placed) const;

 private:
  /// A colour texture file: its colours and its alpha channel.
  struct Picture {
    std::shared_ptr<const Texture> colours;
    std::shared_ptr<const MipMap> opacity;  ///< the alpha channel of the file; null if it has none
  };
  /// Converts a material for rendering; reads the textures that the material names.
  AttachmentMaterial material_of(const SurfaceMaterial& source) const;

  int max_px_;           ///< largest side of a texture, in texels; see the constructor
  bool shows_textures_;  ///< whether colour textures are shown; see the constructor
  mutable LazyMap<const Attachment*, AttachmentSurface> surfaces_;  ///< results of `at`
  // Textures by file path; many attachments share the same texture file.
  mutable LazyMap<std::filesystem::path, Picture> colour_maps_;
  mutable LazyMap<std::filesystem::path, std::shared_ptr<const MipMap>> opacity_maps_;
};

/// Memory in bytes that the textures of `items` use once the textures have been read.
std::uint64_t attachment_texture_bytes(std::span<const Attachment* const> items, int max_px);

}  // namespace crowdface
