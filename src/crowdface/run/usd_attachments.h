// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "crowdface/heads/face_attachments.h"
#include "crowdface/io/usda_part.h"

namespace crowdface {

/// Attachments as they stand in USD layers, with the pictures that lie beside meshes: see attachment_folder.
class UsdAttachments {
 public:
  /// Warns of a texture that cannot be read, and leaves it out.
  /// \param shared  as MeshWriters takes it
  explicit UsdAttachments(const Inputs& inputs, const std::string& shared);

  /// What a face wears; refers to both.
  std::vector<PlacedUsdaPart> parts(std::span<const WornAttachment> worn) const;

  std::size_t memory_bytes() const;
  /// What the encoding of all that a face wears takes at most.
  std::size_t encode_bytes() const;

 private:
  std::map<const Attachment*, UsdaPart> parts_;
};

}  // namespace crowdface
