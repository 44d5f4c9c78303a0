// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/image_memory.h"

#include <algorithm>
#include <mutex>

#include "crowdface/core/error.h"
#include "crowdface/core/input_limits.h"
#include "crowdface/core/memory.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

struct Taken {
  std::mutex mutex;
  std::uint64_t bytes = 0;
};

Taken& taken() {
  static Taken instance;
  return instance;
}

/// \pre  the mutex is held.
std::uint64_t free_of(std::uint64_t most) {
  return most - std::min(taken().bytes, most);
}

class Share {
 public:
  Share(const std::filesystem::path& file, std::uint64_t bytes) : bytes_(bytes) {
    const std::uint64_t most = input_limits().image_bytes;
    const std::lock_guard lock(taken().mutex);
    const std::uint64_t free = free_of(most);
    if (bytes > free) {
      throw InvalidInput(concat(file.string(), ": its pixels take ", format_bytes(bytes), ", and ",
                                format_bytes(free), " of the ", format_bytes(most),
                                " for all images together are free (--limit image_bytes=NUMBER)"));
    }
    taken().bytes += bytes;
  }
  ~Share() {
    const std::lock_guard lock(taken().mutex);
    taken().bytes -= bytes_;
  }
  Share(const Share&) = delete;
  Share& operator=(const Share&) = delete;

 private:
  std::uint64_t bytes_;
};

}  // namespace

ImageMemory take_image_memory(const std::filesystem::path& file, std::uint64_t bytes) {
  return std::make_shared<const Share>(file, bytes);
}

std::uint64_t free_image_memory() {
  const std::lock_guard lock(taken().mutex);
  return free_of(input_limits().image_bytes);
}

}  // namespace crowdface
