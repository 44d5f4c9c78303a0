// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "crowdface/io/little_endian.h"

namespace crowdface {

/// The binary glTF 2.0 container: a header, a JSON chunk and a chunk with the buffer.
namespace glb {
inline constexpr std::uint32_t kMagic = 0x46546c67, kContainerVersion = 2;  // "glTF" and version 2
/// Type codes of the chunks: "JSON" and "BIN".
inline constexpr std::uint32_t kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;
inline constexpr std::size_t kFileHeaderSize = 12, kChunkHeaderSize = 8;  ///< header sizes in bytes
/// Number of bytes of all headers: the file header and the headers of both chunks.
inline constexpr std::size_t kBinaryHeaderSize = kFileHeaderSize + 2 * kChunkHeaderSize;
}  // namespace glb

/// Constants of the glTF 2.0 specification.
namespace gltf {
/// Codes of the component types of accessors.
inline constexpr int kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123;
inline constexpr int kUnsignedInt = 5125, kFloat = 5126;  ///< further component types
/// Targets of buffer views: vertex attributes, and vertex indices.
inline constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;
}  // namespace gltf

/// The contents of the two chunks of a GLB file.
struct GlbChunks {
  std::string_view json, binary;
};

/// Finds the two chunks of a GLB file; nothing if the bytes are not a GLB file or the file is
/// truncated.
inline std::optional<GlbChunks> glb_chunks(std::string_view bytes) {
  using namespace glb;
  if (bytes.size() < kBinaryHeaderSize || number_at<std::uint32_t>(bytes.data()) != kMagic ||
      number_at<std::uint32_t>(bytes.data() + 4) != kContainerVersion) {
    return std::nullopt;
  }
  const std::size_t json = number_at<std::uint32_t>(bytes.data() + kFileHeaderSize);
  if (json > bytes.size() - kBinaryHeaderSize) return std::nullopt;
  const std::size_t binary =
      number_at<std::uint32_t>(bytes.data() + kFileHeaderSize + kChunkHeaderSize + json);
  if (binary > bytes.size() - kBinaryHeaderSize - json) return std::nullopt;
  return GlbChunks{bytes.substr(kFileHeaderSize + kChunkHeaderSize, json),
                   bytes.substr(kBinaryHeaderSize + json, binary)};
}

}  // namespace crowdface
