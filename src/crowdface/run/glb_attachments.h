// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "crowdface/heads/inputs.h"
#include "crowdface/io/glb_part.h"
#include "crowdface/run/attachment_parts.h"
#include "crowdface/run/worn_level.h"

namespace crowdface {

/// Attachments as they stand in GLB files: what material files say is made into glTF's materials. A picture
/// whose holes another file tells gets them as its alpha.
using GlbAttachments = AttachmentParts<GlbPart, PlacedGlbPart>;

/// Whole, and then as they are on each of the levels. Warns of a texture that cannot be read, and leaves it out.
std::vector<GlbAttachments> glb_attachments(const Inputs& inputs,
                                            std::span<const WornLevel> levels);

}  // namespace crowdface
