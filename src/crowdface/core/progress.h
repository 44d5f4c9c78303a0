// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

namespace crowdface {

/// Shows how far a stage is: done/total, rate, time left. On a terminal one line that renews
/// itself, elsewhere a log line every ten seconds. Silent when the log is quiet. Any thread may
/// step it.
class Progress {
 public:
  /// \param stage  what is being done, such as "reading heads".
  Progress(std::string stage, std::size_t total);
  /// Says how long the stage took.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void step(std::size_t amount = 1);
  double seconds() const;

 private:
  using Clock = std::chrono::steady_clock;
  void show(std::size_t done);

  std::string stage_;
  std::size_t total_;
  Clock::time_point start_ = Clock::now();
  std::atomic<std::size_t> done_{0};
  std::mutex mutex_;
  Clock::time_point last_shown_ = start_;
  bool shown_ = false;
};

/// "3 s", "2 min 5 s", "1 h 10 min".
std::string format_duration(double seconds);

}  // namespace crowdface
