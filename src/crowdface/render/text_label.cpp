// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/text_label.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include <ft2build.h>
#include FT_FREETYPE_H

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFontFile = "DejaVuSans.ttf";

/// Folders with fonts: first the system's folders, then the user's folders.
std::vector<fs::path> font_folders() {
  std::vector<fs::path> folders = {"/usr/share/fonts", "/usr/local/share/fonts"};
  // NOLINTNEXTLINE(concurrency-mt-unsafe): no thread sets environment variables
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != 0) {
    folders.push_back(fs::path(home) / ".local/share/fonts");
    folders.push_back(fs::path(home) / ".fonts");
  }
  return folders;
}

fs::path find_font() {
  fs::path usual = fs::path("/usr/share/fonts/truetype/dejavu") / kFontFile;
  if (fs::exists(usual)) return usual;
  for (const fs::path& folder : font_folders()) {
    if (!fs::is_directory(folder)) continue;
    for (const fs::directory_entry& entry :
         fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied)) {
      if (entry.path().filename() == kFontFile) return entry.path();
    }
  }
  throw MissingInput(
      "the font DejaVu Sans is needed for labels and was not found; on Debian: "
      "apt install fonts-dejavu-core");
}

/// Throws if FreeType reports an error. \throws std::bad_alloc; IoError if the font cannot be used.
void check(FT_Error error) {
  if (error == FT_Err_Out_Of_Memory) throw std::bad_alloc();
  if (error != FT_Err_Ok) throw IoError(concat(kFontFile, ": FreeType fails with error ", error));
}

/// The font. One object per thread, because FreeType's objects are not thread-safe.
class Font {
 public:
  Font() {
    static const std::string bytes = read_file(find_font());
    check(FT_Init_FreeType(&library_));
    const FT_Error error =
        FT_New_Memory_Face(library_, reinterpret_cast<const FT_Byte*>(bytes.data()),
                           static_cast<FT_Long>(bytes.size()), 0, &face_);
    if (error != FT_Err_Ok) FT_Done_FreeType(library_);
    check(error);
  }
  ~Font() { FT_Done_FreeType(library_); }
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;

  void set_size(int text_px) { check(FT_Set_Pixel_Sizes(face_, 0, static_cast<FT_UInt>(text_px))); }
  bool has(char32_t character) const { return FT_Get_Char_Index(face_, character) != 0; }
  /// Renders a letter; the result is valid until the next call.
  FT_GlyphSlot letter(char32_t character) {
    check(FT_Load_Char(face_, character, FT_LOAD_RENDER));
    return face_->glyph;
  }

 private:
  FT_Library library_ = nullptr;
  FT_Face face_ = nullptr;
};

Font& font() {
  thread_local std::unique_ptr<Font> of_thread;
  if (!of_thread) of_thread = std::make_unique<Font>();
  return *of_thread;
}

/// Decodes UTF-8 and replaces characters that cannot be drawn.
std::u32string characters_of(std::string_view text) {
  std::u32string characters;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    char32_t code = U'?';
    if (length > 0) {
      const auto lead = static_cast<unsigned char>(text[0]);
      code = length == 1 ? lead : lead & (0x7FU >> length);
      for (std::size_t i = 1; i < length; ++i) {
        code = code << 6U | (static_cast<unsigned char>(text[i]) & 0x3FU);
      }
      if (code < 0x20 || (code >= 0x7F && code <= 0xA0)) {
        code = U' ';
      } else if (!font().has(code)) {
        code = U'?';
      }
    }
    characters += code;
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return characters;
}

/// Horizontal extent of a line's visible pixels, relative to the start of the line.
struct Extent {
  int begin = 0, end = 0;
  int width() const { return end - begin; }
};

/// Calls use(letter, x) for each letter, where x is the left edge of the letter's bitmap.
template <class Use>
void set_line(const std::u32string& line, int text_px, const Use& use) {
  font().set_size(text_px);
  FT_Pos pen = 0;  // in 1/64 pixel
  for (const char32_t character : line) {
    const FT_GlyphSlot letter = font().letter(character);
    use(*letter, static_cast<int>(pen >> 6) + letter->bitmap_left);
    pen += letter->advance.x;
  }
}

Extent extent_of(const std::u32string& line, int text_px) {
  Extent extent;
  bool any = false;
  set_line(line, text_px, [&](const FT_GlyphSlotRec& letter, int x) {
    if (letter.bitmap.width == 0) return;
    extent.begin = any ? std::min(extent.begin, x) : x;
    extent.end = std::max(extent.end, x + static_cast<int>(letter.bitmap.width));
    any = true;
  });
  return extent;
}

/// Replaces the middle of a line by "..." and keeps as many characters as fit into `width_px`.
std::u32string shortened(const std::u32string& line, int width_px, int text_px) {
  const auto keep = [&](std::size_t kept) {
    const std::size_t tail = kept / 2;
    return line.substr(0, kept - tail) + U"..." + line.substr(line.size() - tail);
  };
  const auto fits = [&](std::size_t kept) {
    return extent_of(keep(kept), text_px).width() <= width_px;
  };
  std::size_t low = 0;
  std::size_t high = line.size() - 1;
  while (low < high) {  // bisection for the largest number of characters that fit
    const std::size_t middle = (low + high + 1) / 2;
    if (fits(middle)) {
      low = middle;
    } else {
      high = middle - 1;
    }
  }
  return fits(low) ? keep(low) : std::u32string();
}

struct FittedLine {
  std::u32string line;
  int text_px;
};

FittedLine fit(const std::u32string& line, int width_px, int height_px, const LabelStyle& style) {
  const int largest = std::max(1, std::min(style.text_px, height_px * 3 / 4));
  const int smallest = std::min(style.min_text_px, largest);
  for (int size = largest; size >= smallest; --size) {
    if (extent_of(line, size).width() <= width_px) return {line, size};
  }
  return {shortened(line, width_px, smallest), smallest};
}

void draw_letter(Rgb8Image& image, const FT_Bitmap& bitmap, int left, int top,
                 const LabelStyle& style) {
  for (int row = 0; row < static_cast<int>(bitmap.rows); ++row) {
    for (int column = 0; column < static_cast<int>(bitmap.width); ++column) {
      const int x = left + column, y = top + row;
      if (x < 0 || x >= image.width || y < 0 || y >= image.height) continue;
      const int cover = bitmap.buffer[row * bitmap.pitch + column];
      auto* pixel =
          &image.pixels[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                             static_cast<std::size_t>(x))];
      for (int c = 0; c < 3; ++c) {
        const int mixed =
            (255 - cover) * pixel[c] + cover * style.text_colour[static_cast<std::size_t>(c)];
        pixel[c] = static_cast<std::uint8_t>((mixed + 127) / 255);
      }
    }
  }
}

void draw(Rgb8Image& image, const FittedLine& fitted, const LabelStyle& style, int padding) {
  const Extent extent = extent_of(fitted.line, fitted.text_px);
  int start = padding - extent.begin;
  if (style.align == TextAlign::kCentre) start = (image.width - extent.width()) / 2 - extent.begin;
  if (style.align == TextAlign::kRight) start = image.width - padding - extent.end;
  // The baseline depends only on the height of the image and on the size of the text, not on the
  // letters, so that all labels line up.
  const int baseline = (image.height + fitted.text_px * 7 / 10) / 2;
  set_line(fitted.line, fitted.text_px, [&](const FT_GlyphSlotRec& letter, int x) {
    draw_letter(image, letter.bitmap, start + x, baseline - letter.bitmap_top, style);
  });
}

}  // namespace

Rgb8Image label_strip(std::string_view text, int width_px, int height_px, const LabelStyle& style) {
  Rgb8Image image(width_px, height_px, style.background_colour);
  const int padding = std::min(4, width_px / 8);
  if (text.empty() || width_px < 8 || height_px < 6) return image;
  const FittedLine fitted = fit(characters_of(text), width_px - 2 * padding, height_px, style);
  draw(image, fitted, style, padding);
  return image;
}

}  // namespace crowdface
