// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace crowdface {

/// OpenImageIO's name of the format, recognised by the file's first bytes; empty if the format is
/// not supported.
std::string image_format(std::string_view bytes);

/// Finds defects that a decoder would miss, or that would make the decoder allocate as much memory
/// as the file claims to need. The defects are: a PNG or JPEG without end marker; an OpenEXR header
/// with an attribute longer than the file, or a data window wider or higher than `max_side` pixels;
/// a TIFF rejected by `tiff_defect`; a GIF or Photoshop file wider or higher than `max_side`; a
/// Photoshop file without the merged picture of its layers.
/// \param jpeg  whether a TIFF may contain JPEG data.
/// \return a description of the defect; empty if there is none.
std::string container_defect(std::string_view format, std::string_view bytes, int max_side,
                             bool jpeg);

/// Removes the layers, the layers' transparency, the paths and the metadata from the content of a
/// Photoshop file, because the library that decodes the file trusts the sizes that these sections
/// claim.
/// \param bytes  content of a file in which container_defect finds no defect.
std::string flattened_psd(std::string_view bytes);

}  // namespace crowdface
