// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace crowdface {

/// The format's name in OpenImageIO, told by the file's first bytes; empty if it is not one we
/// read.
std::string image_format(std::string_view bytes);

/// What keeps a file from its decoder, because that would take it for whole, or would take as much
/// memory as the file claims to need: a PNG or JPEG without its end mark; an OpenEXR
/// header with an attribute longer than the file, or a data window wider or higher than `max_side` pixels; a
/// TIFF that tiff_defect objects to.
/// \param jpeg  whether a TIFF may hold JPEGs.
/// \return what is wrong; empty if nothing is.
std::string container_defect(std::string_view format, std::string_view bytes, int max_side,
                             bool jpeg);

}  // namespace crowdface
