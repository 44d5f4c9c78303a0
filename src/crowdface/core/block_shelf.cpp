// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/block_shelf.h"

#include <map>
#include <mutex>
#include <utility>

namespace crowdface {
namespace {

/// Smaller ones come from the heap, where they are used again as it is.
constexpr std::size_t kLeast = std::size_t{1} << 20U;

using Memory = std::unique_ptr<char[]>;

class BlockShelf {
 public:
  Memory take(std::size_t& size) {
    const std::lock_guard lock(mutex_);
    Memory memory;
    const auto found = kept_.lower_bound(size);
    if (found != kept_.end() && found->first <= size + size / kMostSpare) {
      size = found->first;
      memory = std::move(found->second);
      kept_.erase(found);
      kept_bytes_ -= size;
    } else {
      memory = std::make_unique_for_overwrite<char[]>(size);
    }
    used_bytes_ += size;
    return memory;
  }
  /// What is not kept is freed when the lock is released.
  void give_back(Memory memory, std::size_t size) noexcept {
    const std::lock_guard lock(mutex_);
    used_bytes_ -= size;
    if (size < kLeast || used_bytes_ + kept_bytes_ + size > most_) return;
    try {
      kept_.emplace(size, std::move(memory));
      kept_bytes_ += size;
    } catch (...) {  // then it is freed
    }
  }
  void keep(std::uint64_t most) {
    std::multimap<std::size_t, Memory> freed;
    const std::lock_guard lock(mutex_);
    most_ = most;
    if (most > 0) return;
    std::swap(freed, kept_);
    kept_bytes_ = 0;
  }
  std::uint64_t kept_bytes() {
    const std::lock_guard lock(mutex_);
    return kept_bytes_;
  }

 private:
  static constexpr std::size_t kMostSpare = 8;  ///< an eighth more than was asked for

  std::mutex mutex_;
  std::multimap<std::size_t, Memory> kept_;  ///< by size
  std::uint64_t kept_bytes_ = 0, used_bytes_ = 0, most_ = 0;
};

BlockShelf& the_shelf() {
  static auto* const shelf = new BlockShelf;  // blocks may outlive everything
  return *shelf;
}

}  // namespace

std::shared_ptr<char[]> take_block(std::size_t size) {
  Memory memory = the_shelf().take(size);
  char* const block = memory.release();
  return {block, [size](char* held) { the_shelf().give_back(Memory(held), size); }};
}

KeptBlocks::KeptBlocks(std::uint64_t most) {
  the_shelf().keep(most);
}

KeptBlocks::~KeptBlocks() {
  the_shelf().keep(0);
}

std::uint64_t kept_block_bytes() {
  return the_shelf().kept_bytes();
}

}  // namespace crowdface
