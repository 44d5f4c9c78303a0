// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace crowdface {

/// A PDF 1.4 document of pictures, one a page, at 150 pixels an inch; pages larger than PDF's 200
/// inches are made smaller. The pictures keep every pixel: a PNG's data stand in it as they are.
/// \param pngs  files as encode_png makes them with three channels.
/// \throws BrokenPrecondition if there is none, or one is of another kind.
std::string encode_pdf(std::span<const std::string> pngs);

}  // namespace crowdface
