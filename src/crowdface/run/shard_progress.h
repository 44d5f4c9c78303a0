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

/// Writes a shard's progress into the crowd's folder for `crowdface status`: at the start, at most
/// every five seconds while faces are made, and at the end. A failed write does not stop the run;
/// an observer then sees that updates have stopped. Thread-safe.
class ShardProgress {
 public:
  /// \param done  number of the shard's `faces` that are finished at the start
  ShardProgress(std::filesystem::path file, std::size_t faces, std::size_t done);

  /// Counts one more finished face.
  void step();
  /// \param reason  why the shard ended without finishing
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
