// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>

namespace crowdface {

/// Shows the progress of a stage: done/total, rate, time left. A terminal shows one line that is
/// updated in place; otherwise a line is logged every ten seconds. Silent if the log level is
/// kQuiet. `step` is thread-safe.
class Progress {
 public:
  /// \param stage  name of the stage, such as "reading heads".
  /// \param total  number of steps.
  Progress(std::string stage, std::size_t total);
  /// Logs how long the stage took, if all steps are done.
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

/// Receives the name of a stage, the number of finished steps and the number of all steps. Called on
/// any thread, one call at a time, at the start of a stage and after each step.
using ProgressListener =
    std::function<void(const std::string& stage, std::size_t done, std::size_t total)>;
/// Reports all progress of the process to `listener`; an empty listener ends the reports.
void set_progress_listener(ProgressListener listener);

/// "3 s", "2 min 5 s", "1 h 10 min".
std::string format_duration(double seconds);

}  // namespace crowdface
