// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "crowdface/render/rgb8_image.h"

namespace crowdface {

/// Horizontal position of a text in its image.
enum class TextAlign { kLeft, kCentre, kRight };

/// Size, position and colours of a text.
struct LabelStyle {
  int text_px = 14;  ///< nominal height of the letters, reduced for long text
  /// Smallest height of the letters in a long text. If a text of this height is still too long,
  /// "..." replaces the middle of the text.
  int min_text_px = 9;
  TextAlign align = TextAlign::kCentre;
  std::array<std::uint8_t, 3> text_colour = {214, 214, 216};     ///< sRGB
  std::array<std::uint8_t, 3> background_colour = {34, 35, 37};  ///< sRGB
};

/// An image with one line of text, which always fits.
/// \param text  UTF-8, drawn from left to right character by character. Control characters become
///              blanks. Invalid bytes and characters missing in the font become question marks.
/// \throws MissingInput if the font DejaVu Sans is not installed.
Rgb8Image label_strip(std::string_view text, int width_px, int height_px,
                      const LabelStyle& style = {});

}  // namespace crowdface
