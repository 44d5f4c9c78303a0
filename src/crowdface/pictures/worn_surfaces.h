// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "crowdface/core/made_once.h"
#include "crowdface/heads/face_attachments.h"
#include "crowdface/io/surface_materials.h"
#include "crowdface/render/worn_mesh.h"

namespace crowdface {

/// The attachments of a crowd as meshes for rendering. Materials and textures are read on first
/// use. Thread-safe.
class WornSurfaces {
 public:
  /// \param most_px   larger textures are reduced to this many texels a side.
  /// \param textured  whether colour textures are shown; opacity is always applied.
  WornSurfaces(int most_px, bool textured) : most_px_(most_px), textured_(textured) {}

  /// \param item  attachment of the inputs.
  const WornSurface& at(const Attachment& item) const;
  /// The attachments of a face, for rendering. The result refers to `worn` and to this object.
  std::vector<WornMesh> meshes(const std::vector<WornAttachment>& worn) const;

 private:
  struct Picture {
    std::shared_ptr<const Texture> colours;
    std::shared_ptr<const Texture> opacity;  ///< null: no alpha channel
  };
  WornMaterial material_of(const SurfaceMaterial& made_of) const;

  int most_px_;
  bool textured_;
  mutable MadeOnce<const Attachment*, WornSurface> surfaces_;
  // Many attachments share the same textures.
  mutable MadeOnce<std::filesystem::path, Picture> colour_maps_;
  mutable MadeOnce<std::filesystem::path, std::shared_ptr<const Texture>> opacity_maps_;
};

/// Memory in bytes that the textures of some attachments take once read.
std::uint64_t worn_picture_bytes(std::span<const Attachment* const> items, int most_px);

}  // namespace crowdface
