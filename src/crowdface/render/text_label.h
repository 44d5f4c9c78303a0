// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "crowdface/render/rgb8_image.h"

namespace crowdface {

enum class TextAlign { kLeft, kCentre, kRight };

struct LabelStyle {
  int text_px = 14;  ///< nominal height of the letters; a long text may come out smaller
  int min_text_px =
      9;  ///< not smaller than this: beyond, the middle of the text gives way to "..."
  TextAlign align = TextAlign::kCentre;
  std::array<std::uint8_t, 3> text = {214, 214, 216};
  std::array<std::uint8_t, 3> background = {34, 35, 37};
};

/// A strip of width_px by height_px with one line of text, never cut off.
/// \param text  UTF-8, drawn from left to right, a character after the other. Control characters
///              become blanks; what the font has no letter for, and bytes that are no UTF-8, question marks.
/// \throws MissingInput if the font DejaVu Sans is not installed.
Rgb8Image label_strip(std::string_view text, int width_px, int height_px,
                      const LabelStyle& style = {});

}  // namespace crowdface
