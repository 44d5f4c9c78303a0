// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "crowdface/heads/face_attachments.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/render/worn_mesh.h"

namespace crowdface {

/// The attachments of a crowd as pictures show them, with their materials.
class WornSurfaces {
 public:
  /// \param inputs   must outlive this object.
  /// \param most_px  larger textures are made smaller.
  /// \param textured  whether textures are shown; those that make holes are in any case.
  WornSurfaces(const Inputs& inputs, int most_px, bool textured);

  /// What a face wears, to be drawn; refers to both.
  std::vector<WornMesh> meshes(const std::vector<WornAttachment>& worn) const;

 private:
  std::map<const Attachment*, std::unique_ptr<const WornSurface>> surfaces_;
};

}  // namespace crowdface
