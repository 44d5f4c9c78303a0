// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "crowdface/heads/inputs.h"
#include "crowdface/io/usda_part.h"
#include "crowdface/run/attachment_parts.h"

namespace crowdface {

/// Attachments as they stand in USD layers, with the pictures that lie beside meshes: see attachment_folder.
using UsdAttachments = AttachmentParts<UsdaPart, PlacedUsdaPart>;

/// Warns of a texture that cannot be read, and leaves it out.
/// \param shared  as MeshWriters takes it
UsdAttachments usd_attachments(const Inputs& inputs, const std::string& shared);

}  // namespace crowdface
