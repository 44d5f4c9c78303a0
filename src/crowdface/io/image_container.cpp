// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/image_container.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "crowdface/core/text.h"
#include "crowdface/io/little_endian.h"
#include "crowdface/io/tiff_container.h"

namespace crowdface {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kJpegStart = "\xFF\xD8\xFF";

bool has_at(std::string_view bytes, std::size_t at, std::string_view wanted) {
  return bytes.size() >= at && bytes.substr(at).starts_with(wanted);
}

/// Whether a file begins with the header of a Truevision TGA file. The format has no fixed first
/// bytes. The function therefore checks whether the types of picture and palette are known, width
/// and height are above zero, and the number of bits per pixel fits the type.
bool is_targa(std::string_view bytes) {
  constexpr std::size_t kHeader = 18;
  if (bytes.size() <= kHeader) return false;
  const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(bytes[at]); };
  const unsigned type = byte(2) & ~8U, bits = byte(16);  // 8: run lengths
  const bool has_palette = byte(1) == 1;
  const bool fits_type = type == 1   ? has_palette && (bits == 8 || bits == 16)
                         : type == 2 ? bits == 15 || bits == 16 || bits == 24 || bits == 32
                                     : type == 3 && (bits == 8 || bits == 16);
  const bool fits_palette =
      has_palette ? byte(7) >= 15 && byte(7) <= 32 : byte(1) == 0 && byte(5) == 0 && byte(6) == 0;
  const bool has_size = (byte(12) | byte(13)) != 0 && (byte(14) | byte(15)) != 0;
  return fits_type && fits_palette && has_size && (byte(17) & 0xC0U) == 0;
}

/// The sections of a Photoshop file. `picture` is the last section: all layers merged into one
/// picture.
struct PsdSections {
  std::string_view header_and_palette, metadata, picture;
};

/// Divides a Photoshop file into its sections.
/// \return nothing if a section is longer than the file.
std::optional<PsdSections> psd_sections(std::string_view bytes) {
  constexpr std::size_t kHeader = 26;
  if (bytes.size() < kHeader) return std::nullopt;
  const bool is_large = bytes[5] == 2;  // PSB: 64 bits for the length of the layers
  std::string_view rest = bytes.substr(kHeader);
  const auto section = [&](std::size_t length_bytes) -> std::optional<std::string_view> {
    if (rest.size() < length_bytes) return std::nullopt;
    std::uint64_t length = 0;
    for (const char c : rest.substr(0, length_bytes))
      length = length << 8U | static_cast<unsigned char>(c);
    if (length > rest.size() - length_bytes) return std::nullopt;
    const std::string_view found = rest.substr(length_bytes, length);
    rest.remove_prefix(length_bytes + length);
    return found;
  };
  const auto palette = section(4);
  if (!palette) return std::nullopt;
  const std::string_view begin = bytes.substr(0, bytes.size() - rest.size());
  const auto metadata = section(4);
  const auto layers = metadata ? section(is_large ? 8 : 4) : std::nullopt;
  if (!layers) return std::nullopt;
  return PsdSections{begin, *metadata, rest};
}

/// Whether Photoshop has merged the layers into the section `picture`. If not, the section contains
/// a white picture.
bool psd_has_picture(std::string_view metadata) {
  const std::size_t version = metadata.find("8BIM\x04\x21\0\0"sv);  // block 1057
  constexpr std::size_t kFlag = 16;                                 // after size and version
  return version == metadata.npos || version + kFlag >= metadata.size() ||
         metadata[version + kFlag] != 0;
}

std::string psd_defect(std::string_view bytes, int max_side) {
  const auto sections = psd_sections(bytes);
  if (!sections) return "is damaged or cut short: its sections run beyond the file's end";
  const std::uint32_t height = big_endian_at(bytes.data() + 14);
  const std::uint32_t width = big_endian_at(bytes.data() + 18);
  const auto most = static_cast<std::uint32_t>(max_side);
  if (height > most || width > most) {
    return concat("expected at most ", max_side, " pixels a side, found ", width, " x ", height);
  }
  if (!psd_has_picture(sections->metadata)) {
    return "holds layers without their merged picture: save it with \"Maximize Compatibility\", or "
           "as PNG";
  }
  return {};
}

std::string gif_defect(std::string_view bytes, int max_side) {
  constexpr std::size_t kHeader = 13;
  if (bytes.size() < kHeader) return "is damaged or cut short";
  const int width = number_at<std::uint16_t>(bytes.data() + 6);
  const int height = number_at<std::uint16_t>(bytes.data() + 8);
  if (width <= max_side && height <= max_side) return {};
  return concat("expected at most ", max_side, " pixels a side, found ", width, " x ", height);
}

/// Whether the chunks of a PNG follow each other without a gap up to the IEND chunk. The check is
/// needed because libpng accepts files without an IEND chunk.
bool png_is_whole(std::string_view bytes) {
  std::size_t at = 8;
  while (at + 12 <= bytes.size()) {
    const std::size_t next = at + 12 + big_endian_at(bytes.data() + at);
    if (bytes.substr(at + 4, 4) == "IEND") return next <= bytes.size();
    at = next;
  }
  return false;
}

/// Whether the data of a JPEG reaches the end marker; if not, the decoder would invent the missing
/// pixels. The function skips the segments before the scan data (each has a two-byte marker and a
/// length), because bytes in a segment may look like an end marker.
bool jpeg_is_whole(std::string_view bytes) {
  constexpr char kStartOfScan = '\xDA';
  std::size_t at = 2;
  while (at + 4 <= bytes.size() && bytes[at] == '\xFF') {
    if (bytes[at + 1] == kStartOfScan) return bytes.find("\xFF\xD9"sv, at) != bytes.npos;
    at += bytes[at + 1] == '\xFF' ? 1 : 2 + (big_endian_at(bytes.data() + at) & 0xFFFFU);
  }
  return false;
}

/// An attribute of an OpenEXR header.
struct Attribute {
  std::string_view name, type, value;
};

/// Iterates over the attributes in the headers of an OpenEXR file. An attribute is a
/// zero-terminated name, a zero-terminated type, the 32-bit size of the value, and the value. An
/// empty name ends a header.
class ExrHeader {
 public:
  // Skips magic number and version.
  explicit ExrHeader(std::string_view bytes)
      : bytes_(bytes), at_(std::min<std::size_t>(8, bytes.size())) {}

  bool at_end() const { return at_ < bytes_.size() && bytes_[at_] == '\0'; }
  void skip_end() { ++at_; }

  /// Reads the next attribute.
  /// \return nothing if the attribute is truncated.
  std::optional<Attribute> next() {
    Attribute attribute;
    attribute.name = text();
    attribute.type = text();
    if (bytes_.size() - at_ < 4) return std::nullopt;
    const auto size = number_at<std::uint32_t>(bytes_.data() + at_);
    at_ += 4;
    if (size > bytes_.size() - at_) return std::nullopt;
    attribute.value = bytes_.substr(at_, size);
    at_ += size;
    return attribute;
  }

 private:
  std::string_view text() {
    const std::size_t end = std::min(bytes_.find('\0', at_), bytes_.size());
    const std::string_view found = bytes_.substr(at_, end - at_);
    at_ = std::min(end + 1, bytes_.size());
    return found;
  }

  std::string_view bytes_;
  std::size_t at_;
};

/// The types of OpenEXR attributes whose values have a fixed size, and this size in bytes.
constexpr std::pair<std::string_view, std::size_t> kFixedTypes[] = {
    {"box2f", 16},      {"box2i", 16},    {"chromaticities", 32},
    {"compression", 1}, {"double", 8},    {"envmap", 1},
    {"float", 4},       {"int", 4},       {"m33d", 72},
    {"m33f", 36},       {"m44d", 128},    {"m44f", 64},
    {"v2d", 16},        {"v2f", 8},       {"v2i", 8},
    {"v3d", 24},        {"v3f", 12},      {"v3i", 12},
    {"keycode", 28},    {"lineOrder", 1}, {"timecode", 8},
    {"rational", 8},    {"tiledesc", 9},  {"deepImageState", 1}};

/// Whether a value is a channel list: zero-terminated names, each followed by 16 bytes; an empty
/// name ends the list.
bool is_channel_list(std::string_view value) {
  constexpr std::size_t kOfChannel = 16;
  while (!value.empty() && value.front() != '\0') {
    const std::size_t end = value.find('\0');
    if (end == value.npos || value.size() - end - 1 < kOfChannel) return false;
    value.remove_prefix(end + 1 + kOfChannel);
  }
  return value.size() == 1;
}

/// Whether a value is a preview image: width, height, and four bytes per pixel.
bool is_preview(std::string_view value) {
  if (value.size() < 8) return false;
  const std::uint64_t width = number_at<std::uint32_t>(value.data());
  const std::uint64_t height = number_at<std::uint32_t>(value.data() + 4);
  const std::size_t pixels = (value.size() - 8) / 4;
  return value.size() % 4 == 0 && (height == 0 ? pixels == 0 : width <= pixels) &&
         width * height == pixels;
}

/// Whether a value is a list of strings, each preceded by its length.
bool is_list_of_texts(std::string_view value) {
  while (value.size() >= 4) {
    const auto length = number_at<std::uint32_t>(value.data());
    value.remove_prefix(4);
    if (length > value.size()) return false;
    value.remove_prefix(length);
  }
  return value.empty();
}

/// Whether the stored size of an attribute's value equals the size of the attribute's type. For
/// some types the decoder ignores the stored size. If the two sizes differed, the decoder would
/// read the next attribute at another position than this parser.
bool has_size_of_type(const Attribute& attribute) {
  for (const auto& [type, size] : kFixedTypes) {
    if (attribute.type == type) return attribute.value.size() == size;
  }
  if (attribute.type == "chlist") return is_channel_list(attribute.value);
  if (attribute.type == "preview") return is_preview(attribute.value);
  if (attribute.type == "stringvector") return is_list_of_texts(attribute.value);
  if (attribute.type == "floatvector") return attribute.value.size() % 4 == 0;
  return true;
}

/// A description of the defect if the data window is too large; otherwise empty. Large data windows
/// are dangerous because the decoder allocates a table entry for each row, and buffers as wide as
/// the window.
std::string window_defect(const Attribute& attribute, int max_side) {
  if (attribute.type != "box2i" || attribute.value.size() != 16) return {};
  const auto side = [&](std::size_t axis) {
    const auto low = number_at<std::int32_t>(attribute.value.data() + 4 * axis);
    const auto high = number_at<std::int32_t>(attribute.value.data() + 8 + 4 * axis);
    return std::int64_t{high} - low + 1;
  };
  const std::int64_t width = side(0), height = side(1);
  if (width <= max_side && height <= max_side) return {};
  return concat("expected at most ", max_side, " pixels a side, found a data window of ", width,
                " x ", height);
}

std::string exr_defect(std::string_view bytes, int max_side) {
  constexpr std::uint32_t kManyParts = 0x1000;
  const bool many =
      bytes.size() >= 8 && (number_at<std::uint32_t>(bytes.data() + 4) & kManyParts) != 0;
  ExrHeader header(bytes);
  do {
    while (!header.at_end()) {
      const auto attribute = header.next();
      if (!attribute) return "is damaged or cut short: its header runs beyond the file's end";
      if (!has_size_of_type(*attribute)) {
        return concat("is damaged: the ", attribute->value.size(), " bytes of its attribute ",
                      quoted(attribute->name), " are not of the type ", quoted(attribute->type));
      }
      if (attribute->name != "dataWindow") continue;
      if (std::string defect = window_defect(*attribute, max_side); !defect.empty()) return defect;
    }
    header.skip_end();
  } while (many && !header.at_end());
  return {};
}

}  // namespace

std::string image_format(std::string_view bytes) {
  if (bytes.starts_with(kJpegStart)) return "jpeg";
  if (bytes.starts_with("\x89PNG\r\n\x1a\n"sv)) return "png";
  if (bytes.starts_with("II*\0"sv) || bytes.starts_with("MM\0*"sv)) return "tiff";
  if (bytes.starts_with("II+\0"sv) || bytes.starts_with("MM\0+"sv)) return "tiff";
  if (bytes.starts_with("\x76\x2f\x31\x01"sv)) return "openexr";
  if (bytes.starts_with("BM"sv) && has_at(bytes, 6, "\0\0\0\0"sv)) return "bmp";
  if (bytes.starts_with("8BPS\0"sv)) return "psd";
  if (bytes.starts_with("GIF8"sv)) return "gif";
  if (bytes.starts_with("RIFF"sv) && has_at(bytes, 8, "WEBP"sv)) return "webp";
  return is_targa(bytes) ? "targa" : "";
}

std::string container_defect(std::string_view format, std::string_view bytes, int max_side,
                             bool jpeg) {
  if (format == "png" && !png_is_whole(bytes)) {
    return "is damaged or cut short: the PNG's end is missing";
  }
  if (format == "jpeg" && !jpeg_is_whole(bytes)) {
    return "is damaged or cut short: the JPEG's end is missing";
  }
  if (format == "openexr") return exr_defect(bytes, max_side);
  if (format == "tiff") return tiff_defect(bytes, jpeg);
  if (format == "psd") return psd_defect(bytes, max_side);
  if (format == "gif") return gif_defect(bytes, max_side);
  return {};
}

std::string flattened_psd(std::string_view bytes) {
  const PsdSections sections = psd_sections(bytes).value();
  const std::size_t empty_sections = bytes[5] == 2 ? 12 : 8;
  return concat(sections.header_and_palette, std::string(empty_sections, '\0'), sections.picture);
}

}  // namespace crowdface
