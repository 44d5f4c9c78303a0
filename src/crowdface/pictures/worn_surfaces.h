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

/// The attachments of a crowd as pictures show them, with their materials. Pictures are read of those that
/// are asked for, then. Any thread may ask.
class WornSurfaces {
 public:
  /// \param most_px  larger textures are made smaller.
  /// \param textured  whether textures are shown; those that make holes are in any case.
  WornSurfaces(int most_px, bool textured) : most_px_(most_px), textured_(textured) {}

  /// \param item  of the inputs.
  const WornSurface& at(const Attachment& item) const;
  /// What a face wears, to be drawn; refers to both.
  std::vector<WornMesh> meshes(const std::vector<WornAttachment>& worn) const;

 private:
  struct Picture {
    std::shared_ptr<const Texture> colours;
    std::shared_ptr<const Texture> opacity;  ///< null: it has no alpha
  };
  WornMaterial material_of(const SurfaceMaterial& made_of) const;

  int most_px_;
  bool textured_;
  mutable MadeOnce<const Attachment*, WornSurface> surfaces_;
  // Many attachments wear the same pictures.
  mutable MadeOnce<std::filesystem::path, Picture> colour_maps_;
  mutable MadeOnce<std::filesystem::path, std::shared_ptr<const Texture>> opacity_maps_;
};

/// What the pictures of some attachments take once they are read.
std::uint64_t worn_picture_bytes(std::span<const Attachment* const> items, int most_px);

}  // namespace crowdface
