// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/tiff_container.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "crowdface/core/text.h"

namespace crowdface {
namespace {

enum Tag : std::uint64_t {
  kWidth = 256,
  kHeight = 257,
  kBitsPerSample = 258,
  kCompression = 259,
  kStripOffsets = 273,
  kSamplesPerPixel = 277,
  kRowsPerStrip = 278,
  kStripByteCounts = 279,
  kPlanarConfiguration = 284,
  kTileWidth = 322,
  kTileLength = 323,
  kTileOffsets = 324,
  kTileByteCounts = 325,
};

/// The first image file directory of a TIFF, with its tags and their values. Reading beyond the end
/// of the file throws an exception.
class Directory {
 public:
  struct BeyondTheEnd {};

  explicit Directory(std::string_view bytes) : bytes_(bytes), big_endian_(bytes.starts_with("MM")) {
    big_tiff_ = number(2, 2) == 43;
    begin_ = number(big_tiff_ ? 8 : 4, offset_size());
    count_ = number(begin_, big_tiff_ ? 8 : 2);
    begin_ += big_tiff_ ? 8 : 2;
    if (count_ > bytes_.size() / entry_size()) throw BeyondTheEnd();
    require_inside(begin_, count_ * entry_size());
  }

  /// \return the numbers of an entry; empty if there is no such entry, or if it does not contain
  /// integers.
  std::vector<std::uint64_t> numbers(Tag tag) const {
    for (std::uint64_t e = 0; e < count_; ++e) {
      const std::uint64_t entry = begin_ + e * entry_size();
      if (number(entry, 2) == tag) return values_of(entry);
    }
    return {};
  }

  /// The first of `numbers(tag)`; `otherwise` if there are no numbers.
  std::uint64_t first(Tag tag, std::uint64_t otherwise) const {
    const std::vector<std::uint64_t> all = numbers(tag);
    return all.empty() ? otherwise : all.front();
  }

  bool holds(std::uint64_t begin, std::uint64_t size) const {
    return begin <= bytes_.size() && size <= bytes_.size() - begin;
  }

 private:
  std::uint64_t offset_size() const { return big_tiff_ ? 8 : 4; }
  std::uint64_t entry_size() const { return big_tiff_ ? 20 : 12; }

  void require_inside(std::uint64_t begin, std::uint64_t size) const {
    if (!holds(begin, size)) throw BeyondTheEnd();
  }

  std::uint64_t number(std::uint64_t at, std::uint64_t size) const {
    require_inside(at, size);
    std::uint64_t value = 0;
    for (std::uint64_t i = 0; i < size; ++i) {
      const std::uint64_t next = big_endian_ ? at + i : at + size - 1 - i;
      value = value << 8U | static_cast<unsigned char>(bytes_[next]);
    }
    return value;
  }

  /// An entry consists of a tag, a type, a count, and either the values or their offset.
  std::vector<std::uint64_t> values_of(std::uint64_t entry) const {
    constexpr std::uint64_t kSizes[17] = {0, 0, 0, 2, 4, 0, 0, 0, 0, 0, 0, 0, 0, 4, 0, 0, 8};
    const std::uint64_t type = number(entry + 2, 2), count = number(entry + 4, offset_size());
    const std::uint64_t size = type < 17 ? kSizes[type] : 0;
    if (size == 0) return {};
    if (count > bytes_.size()) throw BeyondTheEnd();
    std::uint64_t place = entry + 4 + offset_size();
    if (count * size > offset_size()) place = number(place, offset_size());
    require_inside(place, count * size);
    std::vector<std::uint64_t> values(count);
    for (std::uint64_t i = 0; i < count; ++i) values[i] = number(place + i * size, size);
    return values;
  }

  std::string_view bytes_;
  bool big_endian_, big_tiff_ = false;
  std::uint64_t begin_ = 0, count_ = 0;
};

/// Maximum number of bytes that one compressed byte can expand to; nothing for unsupported
/// compressions.
std::optional<std::uint64_t> max_expansion(std::uint64_t compression, bool jpeg) {
  constexpr std::uint64_t kJpeg = 7;
  constexpr std::pair<std::uint64_t, std::uint64_t> kMax[] = {
      {1, 1},         // uncompressed
      {5, 2600},      // LZW: a 12-bit code stands for at most 3,840 bytes
      {8, 1100},      // Deflate: at most 1032 bytes
      {32946, 1100},  // Deflate, old code
      {32773, 64},    // PackBits: two bytes expand to 128
      {kJpeg, 1000},  // JPEG: a block of 64 values takes at least 2 bits
  };
  for (const auto& [known, most] : kMax) {
    if (known == compression && (jpeg || known != kJpeg)) return most;
  }
  return std::nullopt;
}

std::uint64_t parts_of(std::uint64_t whole, std::uint64_t part) {
  return whole / part + (whole % part != 0 ? 1 : 0);
}

/// The division of a TIFF image into pieces (strips or tiles). A strip is treated as a tile that is
/// as wide as the image.
struct PieceLayout {
  std::uint64_t width, height;              ///< size of the image in pixels
  std::uint64_t piece_width, piece_height;  ///< size of a strip or tile in pixels
  std::uint64_t bits;                       ///< number of bits per pixel in each plane of the image
  std::uint64_t planes;
  std::vector<std::uint64_t> begins, sizes;

  std::uint64_t pieces() const {
    return parts_of(width, piece_width) * parts_of(height, piece_height) * planes;
  }
  /// Number of uncompressed bytes of a piece. The last strip may have fewer rows than the others.
  std::uint64_t bytes_of(std::uint64_t piece, bool tiled) const {
    const std::uint64_t row = piece % parts_of(height, piece_height);
    const std::uint64_t rows =
        tiled ? piece_height : std::min(piece_height, height - row * piece_height);
    return (piece_width * bits + 7) / 8 * rows;
  }
};

std::string defect_of(const Directory& directory, bool jpeg) {
  constexpr std::uint64_t kMaxSide = 1U << 24U, kMaxBits = 64, kMaxSamples = 1U << 16U;
  const std::uint64_t width = directory.first(kWidth, 0), height = directory.first(kHeight, 0);
  const std::uint64_t samples = directory.first(kSamplesPerPixel, 1);
  const std::vector<std::uint64_t> depths = directory.numbers(kBitsPerSample);
  const std::uint64_t depth = depths.empty() ? 1 : *std::ranges::max_element(depths);
  const bool tiled = directory.first(kTileWidth, 0) != 0;
  const std::uint64_t piece_width = tiled ? directory.first(kTileWidth, 0) : width;
  const std::uint64_t piece_height = tiled
                                         ? directory.first(kTileLength, 0)
                                         : std::min(directory.first(kRowsPerStrip, height), height);
  for (const std::uint64_t side : {width, height, piece_width, piece_height}) {
    if (side < 1 || side > kMaxSide)
      return concat("expected an image of 1 to ", kMaxSide, " pixels a side, found ", side);
  }
  if (depth < 1 || depth > kMaxBits || samples < 1 || samples > kMaxSamples) {
    return concat("expected samples of 8, 16 or 32 bits, found ", samples, " of ", depth);
  }
  const std::uint64_t compression = directory.first(kCompression, 1);
  const auto most = max_expansion(compression, jpeg);
  if (!most) {
    return concat("expected no compression, LZW, Deflate or PackBits, found TIFF's compression ",
                  compression, "; save it with one of these, or as PNG");
  }
  const bool planar = directory.first(kPlanarConfiguration, 1) == 2;
  const PieceLayout cut{width,
                        height,
                        piece_width,
                        piece_height,
                        depth * (planar ? 1 : samples),
                        planar ? samples : 1,
                        directory.numbers(tiled ? kTileOffsets : kStripOffsets),
                        directory.numbers(tiled ? kTileByteCounts : kStripByteCounts)};
  const std::string_view pieces = tiled ? "tiles" : "strips";
  const std::uint64_t expected = cut.pieces();
  if (cut.begins.size() < expected || cut.sizes.size() < expected) {
    return concat("expected ", expected, ' ', pieces, " for ", width, " x ", height,
                  " pixels, found ", std::min(cut.begins.size(), cut.sizes.size()));
  }
  for (std::uint64_t p = 0; p < expected; ++p) {
    if (!directory.holds(cut.begins[p], cut.sizes[p])) throw Directory::BeyondTheEnd();
    const std::uint64_t claimed = cut.bytes_of(p, tiled);
    if (parts_of(claimed, *most) <= cut.sizes[p]) continue;
    return concat("is too short for the ", width, " x ", height,
                  " pixels that it claims to hold: ", "expected at least ",
                  parts_of(claimed, *most), " bytes of one of its ", pieces, ", found ",
                  cut.sizes[p], " (cut short?)");
  }
  return {};
}

}  // namespace

std::string tiff_defect(std::string_view bytes, bool jpeg) {
  try {
    return defect_of(Directory(bytes), jpeg);
  } catch (const Directory::BeyondTheEnd&) {
    return "is damaged or cut short: its directory refers to data beyond the file's end";
  }
}

}  // namespace crowdface
