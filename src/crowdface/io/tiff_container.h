// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace crowdface {

/// Looks at the first directory of a TIFF, classic or BigTIFF, before a decoder does, which would
/// take memory for all pixels that the directory claims, and leave what it does not find as it was.
/// \param jpeg  whether strips and tiles may be JPEG.
/// \return what is wrong with it, empty if nothing is: entries, strips or tiles that lie beyond the
///         file's end; fewer of them, or shorter ones, than the picture takes by its compression; a
///         compression other than none, LZW, Deflate and PackBits.
std::string tiff_defect(std::string_view bytes, bool jpeg);

}  // namespace crowdface
