// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/heads/inputs.h"
#include "crowdface/io/glb_part.h"
#include "crowdface/run/attachment_parts.h"

namespace crowdface {

/// Attachments as they stand in GLB files: what material files say is made into glTF's materials. A picture
/// whose holes another file tells gets them as its alpha.
using GlbAttachments = AttachmentParts<GlbPart, PlacedGlbPart>;

/// Warns of a texture that cannot be read, and leaves it out.
GlbAttachments glb_attachments(const Inputs& inputs);

}  // namespace crowdface
