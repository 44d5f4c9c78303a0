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
/// the file then only keeps its old content. Thread-safe.
class ShardProgress {
 public:
  /// \param finished_face_count  number of the shard's faces that earlier runs finished
  ShardProgress(std::filesystem::path file, std::size_t face_count,
                std::size_t finished_face_count);

  /// Increases the count of finished faces by one.
  void step();
  /// Records that the run of the shard has ended, and writes the file.
  /// \param reason  why the shard ended before it finished all faces
  void end(ShardState state, std::string_view reason = {});

 private:
  using Clock = std::chrono::steady_clock;
  /// Writes `notes_` to `file_`.
  void write() noexcept;

  std::filesystem::path file_;
  ShardNotes notes_;  ///< the shard's state and number of finished faces
  /// time at which the run of the shard started, and time of the last write of `file_`
  Clock::time_point start_ = Clock::now(), last_write_ = start_;
  std::mutex mutex_;
};

}  // namespace crowdface
