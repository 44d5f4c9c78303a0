// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <span>
#include <vector>

#include "crowdface/heads/face_attachments.h"
#include "crowdface/io/glb_part.h"

namespace crowdface {

/// Attachments as they stand in GLB files: what material files say is made into glTF's materials. A picture
/// whose holes another file tells gets them as its alpha.
class GlbAttachments {
 public:
  /// Warns of a texture that cannot be read, and leaves it out.
  explicit GlbAttachments(const Inputs& inputs);

  /// What a face wears; refers to both.
  std::vector<PlacedGlbPart> parts(std::span<const WornAttachment> worn) const;

  std::size_t memory_bytes() const;

 private:
  std::map<const Attachment*, GlbPart> parts_;
};

}  // namespace crowdface
