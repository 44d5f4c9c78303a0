// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <mutex>
#include <string>
#include <string_view>

#include "crowdface/crowd/shard.h"

namespace crowdface {

/// Tells in the crowd's folder how far a shard is, for `crowdface status`: when it begins, at most
/// every five seconds while faces are made, and at its end. A file that cannot be written stops
/// nothing: whoever watches sees that nothing more comes. Any thread may step it.
class ShardProgress {
 public:
  /// \param done  of the shard's `faces`, what is done when it begins.
  ShardProgress(std::filesystem::path file, std::size_t faces, std::size_t done);

  /// One more face is done.
  void step();
  /// \param reason  why it ended, if it is not done.
  void end(ShardState state, std::string_view reason = {});

 private:
  using Clock = std::chrono::steady_clock;
  void write() noexcept;

  std::filesystem::path file_;
  ShardNotes notes_;
  Clock::time_point start_ = Clock::now(), written_ = start_;
  std::mutex mutex_;
};

}  // namespace crowdface
