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
  void add(std::span<const std::uint8_t> bytes);
  /// Writes the rest of the stream. No function may be called afterwards.
  void finish();

 private:
  void write_block(bool is_last);

  std::string& out_;
  /// bytes to write, after the last byte of the block before
  std::vector<std::uint8_t> block_;
  std::vector<char> packed_;   ///< working memory for the compressed bytes of a block
  std::size_t written_ = 0;    ///< number of bytes in `block_` that are in `out_`: 0 or 1
  std::uint64_t pending_ = 0;  ///< up to 7 bits that are not yet in `out_`
  unsigned pending_count_ = 0;
  std::uint32_t checksum_;
};

}  // namespace crowdface
