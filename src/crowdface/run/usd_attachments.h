// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "crowdface/heads/inputs.h"
#include "crowdface/io/usda_part.h"
#include "crowdface/run/attachment_parts.h"
#include "crowdface/run/worn_level.h"

namespace crowdface {

/// Attachments as they stand in USD layers, with the pictures that lie beside meshes: see attachment_folder.
using UsdAttachments = AttachmentParts<UsdaPart, PlacedUsdaPart>;

/// What encoding takes of what a face wears at most.
std::size_t usd_bytes_worn_at_most(const UsdAttachments& attachments);

/// Whole, and then as they are on each of the levels. Warns of a texture that cannot be read, and leaves it out.
/// \param shared  as MeshWriters takes it
std::vector<UsdAttachments> usd_attachments(const Inputs& inputs, const std::string& shared,
                                            std::span<const WornLevel> levels);

}  // namespace crowdface
