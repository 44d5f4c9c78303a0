// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/plain_png.h"

#include <string_view>

#include "crowdface/core/require.h"
#include "crowdface/io/little_endian.h"

namespace crowdface {
namespace {

void append_big_endian(std::string& out, std::uint32_t number) {
  append_number(out, __builtin_bswap32(number));
}

/// The cyclic redundancy check of PNG's chunks (ISO 3309), bit by bit.
std::uint32_t crc(std::string_view bytes) {
  constexpr std::uint32_t kPolynomial = 0xedb88320U;
  std::uint32_t sum = 0xffffffffU;
  for (const char byte : bytes) {
    sum ^= static_cast<std::uint8_t>(byte);
    for (int bit = 0; bit < 8; ++bit) sum = (sum >> 1U) ^ ((sum & 1U) != 0 ? kPolynomial : 0U);
  }
  return ~sum;
}

/// The checksum at the end of a zlib stream (RFC 1950).
std::uint32_t adler(std::string_view bytes) {
  constexpr std::uint32_t kModulus = 65521;
  std::uint32_t low = 1, high = 0;
  for (const char byte : bytes) {
    low = (low + static_cast<std::uint8_t>(byte)) % kModulus;
    high = (high + low) % kModulus;
  }
  return high << 16U | low;
}

void append_chunk(std::string& png, const std::string& kind, const std::string& content) {
  append_big_endian(png, static_cast<std::uint32_t>(content.size()));
  png += kind + content;
  append_big_endian(png, crc(kind + content));
}

/// One block that is stored as it is (RFC 1951).
std::string zlib_stream(const std::string& bytes) {
  const auto size = static_cast<std::uint16_t>(bytes.size());
  std::string stream = "\x78\x01\x01";
  append_number(stream, size);
  append_number(stream, static_cast<std::uint16_t>(~size));
  stream += bytes;
  append_big_endian(stream, adler(bytes));
  return stream;
}

}  // namespace

std::string plain_png(int width, int height, std::span<const std::uint8_t> pixels) {
  constexpr std::size_t kMostBytes = 0xffff, kChannels = 3;
  require(width > 0 && height > 0, "a PNG of ", width, " x ", height, " pixels");
  const std::size_t row = kChannels * static_cast<std::size_t>(width);
  const auto rows = static_cast<std::size_t>(height);
  require(pixels.size() == rows * row && rows * (1 + row) <= kMostBytes, "a plain PNG of ",
          pixels.size(), " bytes for ", width, " x ", height);
  std::string header, lines;
  append_big_endian(header, static_cast<std::uint32_t>(width));
  append_big_endian(header, static_cast<std::uint32_t>(height));
  header += std::string("\x08\x02\x00\x00\x00", 5);  // eight bits, RGB, not interlaced
  for (std::size_t y = 0; y < rows; ++y) {
    lines += '\0';  // no filter
    lines.append(reinterpret_cast<const char*>(pixels.data()) + y * row, row);
  }
  std::string png = "\x89PNG\r\n\x1a\n";
  append_chunk(png, "IHDR", header);
  append_chunk(png, "sRGB", std::string(1, '\0'));
  append_chunk(png, "IDAT", zlib_stream(lines));
  append_chunk(png, "IEND", "");
  return png;
}

}  // namespace crowdface
