// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/text_label.h"

#include <algorithm>
#include <string>

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include "crowdface/core/error.h"
#include "crowdface/core/utf8.h"

namespace crowdface {
namespace {

constexpr const char* kFont = "DejaVuSans";

/// The number of a character of these bytes; 0xFFFD of a byte that is none.
char32_t code_of(std::string_view character, std::size_t length) {
  if (length == 0) return 0xFFFD;
  const auto lead = static_cast<unsigned char>(character[0]);
  char32_t code = length == 1 ? lead : lead & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    code = code << 6U | (static_cast<unsigned char>(character[i]) & 0x3FU);
  }
  return code;
}

/// OpenImageIO 2.4 draws ASCII only (it drops all but the last bits of other characters), so
/// western letters lose their accents and what is left becomes a question mark.
std::string drawable(std::string_view text) {
  // U+00C0 to U+00FF.
  constexpr std::string_view kPlain =
      "AAAAAAACEEEEIIIIDNOOOOOxOUUUUYTsaaaaaaaceeeeiiiidnooooo/ouuuuyty";
  std::string out;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const char32_t code = code_of(text, length);
    text.remove_prefix(std::max<std::size_t>(length, 1));
    if (code < 0x20 || code == 0x7F || code == 0xA0) {
      out += ' ';
    } else if (code < 0x7F) {
      out += static_cast<char>(code);
    } else if (code >= 0xC0 && code <= 0xFF) {
      out += kPlain[code - 0xC0];
    } else {
      out += code == 0xB7 || (code >= 0x2010 && code <= 0x2015) ? '-' : '?';
    }
  }
  return out;
}

OIIO::ROI extent(const std::string& text, int text_px) {
  const OIIO::ROI roi = OIIO::ImageBufAlgo::text_size(text, text_px, kFont);
  if (!roi.defined() && !text.empty() &&
      OIIO::ImageBufAlgo::text_size(text, text_px, kFont).defined()) {
    throw IoError("a label cannot be measured: is there too little memory?");
  }
  if (!roi.defined() && !text.empty()) {
    throw MissingInput(
        "the font DejaVu Sans is needed for labels and was not found; on Debian: "
        "apt install fonts-dejavu-core");
  }
  return roi;
}

int width_of(const std::string& text, int text_px) {
  return text.empty() ? 0 : extent(text, text_px).width();
}

/// The longest text that fits, its middle left out.
std::string shortened(const std::string& text, int width_px, int text_px) {
  const auto keep = [&](std::size_t kept) {
    const std::size_t tail = kept / 2;
    return text.substr(0, kept - tail) + "..." + text.substr(text.size() - tail);
  };
  std::size_t low = 0;
  std::size_t high = text.size() - 1;
  while (low < high) {  // the most characters that fit, by bisection
    const std::size_t middle = (low + high + 1) / 2;
    if (width_of(keep(middle), text_px) <= width_px) {
      low = middle;
    } else {
      high = middle - 1;
    }
  }
  const std::string best = keep(low);
  return width_of(best, text_px) <= width_px ? best : std::string();
}

struct FittedText {
  std::string text;
  int text_px;
};

FittedText fit(std::string_view text, int width_px, int height_px, const LabelStyle& style) {
  const std::string whole = drawable(text);
  const int largest = std::max(1, std::min(style.text_px, height_px * 3 / 4));
  const int smallest = std::min(style.min_text_px, largest);
  for (int size = largest; size >= smallest; --size) {
    if (width_of(whole, size) <= width_px) return {whole, size};
  }
  return {shortened(whole, width_px, smallest), smallest};
}

void draw(Rgb8Image& image, const FittedText& fitted, const LabelStyle& style, int padding) {
  const OIIO::ROI roi = extent(fitted.text, fitted.text_px);
  int x = padding - roi.xbegin;
  if (style.align == TextAlign::kCentre) x = (image.width - roi.width()) / 2 - roi.xbegin;
  if (style.align == TextAlign::kRight) x = image.width - padding - roi.xend;
  // One baseline for all labels of a size, whatever letters they hold.
  const int y = (image.height + fitted.text_px * 7 / 10) / 2;
  const OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::UINT8);
  const float colour[3] = {static_cast<float>(style.text[0]) / 255,
                           static_cast<float>(style.text[1]) / 255,
                           static_cast<float>(style.text[2]) / 255};
  const auto draw_into = [&](Rgb8Image& on) {
    OIIO::ImageBuf buffer(spec, on.pixels.data());
    return OIIO::ImageBufAlgo::render_text(buffer, x, y, fitted.text, fitted.text_px, kFont, colour,
                                           OIIO::ImageBufAlgo::TextAlignX::Left,
                                           OIIO::ImageBufAlgo::TextAlignY::Baseline, 0, {}, 1);
  };
  // A letter for which there is no memory is left out without a word: then two do not come out alike.
  Rgb8Image again = image;
  if (!draw_into(image) || !draw_into(again) || !(image == again)) {
    throw IoError("a label cannot be drawn: is there too little memory?");
  }
}

}  // namespace

Rgb8Image label_strip(std::string_view text, int width_px, int height_px, const LabelStyle& style) {
  Rgb8Image image(width_px, height_px, style.background);
  const int padding = std::min(4, width_px / 8);
  if (text.empty() || width_px < 8 || height_px < 6) return image;
  const FittedText fitted = fit(text, width_px - 2 * padding, height_px, style);
  if (!fitted.text.empty()) draw(image, fitted, style, padding);
  return image;
}

}  // namespace crowdface
