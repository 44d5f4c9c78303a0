// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace crowdface {

/// Checks the first directory of a TIFF or BigTIFF before decoding. A decoder would allocate memory
/// for all pixels that the directory claims, and leave pixels without data uninitialised.
/// \param jpeg  whether strips and tiles may be JPEG.
/// \return a description of the defect, or an empty string. Defects are: entries, strips or tiles
/// beyond the end of the file; fewer or shorter strips or tiles than the image needs with its
/// compression; a compression other than none, LZW, Deflate, PackBits and (if `jpeg`) JPEG.
std::string tiff_defect(std::string_view bytes, bool jpeg);

}  // namespace crowdface
