// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace crowdface {

/// Compresses bytes to a zlib stream (RFC 1950 and 1951) with Huffman codes and runs of equal
/// bytes, as zlib does with the strategy Z_RLE. Filtered photographs become as small as with zlib,
/// in a third of the time, and the result does not depend on the version of zlib.
class RunDeflater {
 public:
  /// Appends the stream to `out`, which must outlive this object.
  explicit RunDeflater(std::string& out);
  /// Compresses further bytes.
  void add(std::span<const std::uint8_t> bytes);
  /// Writes the rest of the stream. No function may be called afterwards.
  void finish();

 private:
  /// Compresses the bytes of `block_` as one deflate block.
  void write_block(bool is_last);

  std::string& out_;  ///< the text to which the compressed stream is appended
  /// The last byte of the previous deflate block, and then the bytes of the next block. The next
  /// block may begin with a run that repeats the last byte.
  std::vector<std::uint8_t> block_;
  std::vector<char> packed_;  ///< working memory for the compressed bytes of a block
  /// number of bytes at the start of `block_` that belong to the previous block: 0 or 1
  std::size_t written_ = 0;
  std::uint64_t pending_ = 0;   ///< up to 7 bits that are not yet in `out_`
  unsigned pending_count_ = 0;  ///< number of bits in `pending_`
  std::uint32_t checksum_;      ///< Adler-32 checksum of all uncompressed bytes
};

}  // namespace crowdface
