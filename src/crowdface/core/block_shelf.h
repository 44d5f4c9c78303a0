// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

namespace crowdface {

/// Takes a block of memory, not initialised, for what is large and short-lived: one that was freed if blocks are
/// kept (see KeptBlocks). From any thread.
std::shared_ptr<char[]> take_block(std::size_t size);

/// While it lives, blocks that nobody holds any more are kept for others of their size, as memory that is new to the
/// process costs as much as filling it.
class KeptBlocks {
 public:
  /// \param most  bytes that all blocks take, those in use included, where any is kept.
  explicit KeptBlocks(std::uint64_t most);
  ~KeptBlocks();  ///< those that are in use are freed by whoever holds them
  KeptBlocks(const KeptBlocks&) = delete;
  KeptBlocks& operator=(const KeptBlocks&) = delete;
};

/// Bytes of blocks that are kept and that nobody holds.
std::uint64_t kept_block_bytes();

}  // namespace crowdface
