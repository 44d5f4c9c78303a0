// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/core/made_once.h"
#include "crowdface/heads/face_attachments.h"
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
  int most_px_;
  bool textured_;
  mutable MadeOnce<const Attachment*, WornSurface> surfaces_;
};

/// What the pictures of an attachment take once they are read.
std::uint64_t worn_picture_bytes(const Attachment& item, int most_px);

}  // namespace crowdface
