// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace crowdface {

/// Encodes images as a PDF 1.4 document, one image per page, at 150 pixels per inch; pages larger
/// than PDF's limit of 200 inches are scaled down. Every pixel is kept: the PDF contains the
/// compressed data of the PNGs unchanged.
/// \param pngs  files made by `encode_png` with three channels.
/// \throws BrokenPrecondition if there are no images or an image is not a three-channel PNG of this
/// kind.
std::string encode_pdf(std::span<const std::string> pngs);

}  // namespace crowdface
