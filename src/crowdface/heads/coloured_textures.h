// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/heads/inputs.h"

namespace crowdface {

/// A material file or texture of an attachment in a colour.
struct AttachmentFile {
  MaterialFile file;
  bool is_coloured = false;  ///< a colour texture, whose content is coloured_texture
};
/// The material files and textures of an attachment. Textures keep their names.
std::vector<AttachmentFile> files_of(const AttachmentLook& look);

/// Colours a neutral texture, and returns it as a PNG file with 8 bits per channel.
/// \throws InvalidInput if the file is not a readable image.
std::string coloured_texture(const std::filesystem::path& neutral, const HairColour& colour);

}  // namespace crowdface
