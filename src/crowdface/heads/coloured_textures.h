// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/heads/inputs.h"

namespace crowdface {

/// A material file or a texture of an attachment, and whether it gets the attachment's colour.
struct AttachmentFile {
  MaterialFile file;  ///< the material file or texture, and the path of its copy
  /// whether the file on disk is a texture in a neutral colour, and the output gets the texture
  /// that `coloured_texture` makes from this file
  bool is_coloured = false;
};
/// Lists the material files and textures of an attachment. A coloured texture has the same file
/// name as the neutral texture.
std::vector<AttachmentFile> files_of(const ColouredAttachment& look);

/// Colours a neutral texture, and returns it as a PNG file with 8 bits per channel.
/// \throws InvalidInput if the file is not a readable image.
std::string coloured_texture(const std::filesystem::path& neutral, const HairColour& colour);

}  // namespace crowdface
