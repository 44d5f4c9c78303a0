// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "crowdface/core/parallel.h"

namespace crowdface {

/// A function that returns the current time, as seconds since an arbitrary fixed time.
using SecondsClock = std::function<double()>;
/// Returns a clock that is not affected if somebody changes the system time.
SecondsClock steady_seconds_clock();

/// Estimates how many steps a stage makes per second, from the second half of the time since the
/// first step. The time before the first step does not count, because a stage may need a long
/// preparation. The first half does not count because steps may become slower, as in a crowd that
/// is nearly full.
class StepRate {
 public:
  /// \param simultaneous_steps  number of steps that may end at almost the same time, such as the
  ///     number of threads. Two samples are stored only if at least this many steps ended between
  ///     them.
  explicit StepRate(std::size_t simultaneous_steps) : simultaneous_steps_(simultaneous_steps) {}

  /// Records the number of finished steps.
  /// \param seconds  time of the call in seconds, counted from any fixed time; must not be less
  ///                 than in the previous call.
  void record(double seconds, std::size_t finished_steps);
  /// Returns the steps per second. Returns nothing until `simultaneous_steps` steps have ended
  /// since the first call of `record`.
  std::optional<double> rate() const;

 private:
  /// The number of finished steps at one time.
  struct Sample {
    double seconds = 0;  ///< the argument `seconds` of a call of `record`
    std::size_t finished_steps = 0;
  };
  std::size_t simultaneous_steps_;
  double first_seconds_ = 0;  ///< `seconds` of the first call of `record`
  /// The samples in the second half of the time that has passed since the first step, and the last
  /// sample before that half.
  std::deque<Sample> samples_;
};

/// Shows the progress of a stage: the numbers of finished steps and of all steps and, once known,
/// rate and remaining time (see StepRate). On a terminal, the object updates one line in place;
/// otherwise it logs a line every ten seconds. Silent if the log level is kQuiet. `step` is
/// thread-safe.
class Progress {
 public:
  /// \param stage  name of the stage, such as "reading heads".
  /// \param total  number of steps.
  /// \param simultaneous_steps  number of steps that may end at almost the same time.
  Progress(std::string stage, std::size_t total,
           std::size_t simultaneous_steps = static_cast<std::size_t>(thread_count()),
           SecondsClock clock = steady_seconds_clock());
  /// Logs how long the stage took, if all steps are done.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Adds to the number of finished steps.
  void step(std::size_t step_count = 1);
  /// Seconds since the construction.
  double seconds() const { return clock_() - start_seconds_; }
  /// Returns an estimate of the time that the remaining steps take; nothing if it is not known yet.
  std::optional<double> seconds_left() const;

 private:
  /// Shows the progress, unless it was shown a short time ago. The caller must hold mutex_.
  void show(std::size_t finished_steps);
  /// The estimate of `seconds_left()` for this number of finished steps. The caller must hold
  /// mutex_.
  std::optional<double> seconds_left(std::size_t finished_steps) const;

  std::string stage_;
  std::size_t total_steps_;
  SecondsClock clock_;
  double start_seconds_;  ///< time, measured by `clock_`, at which this object was constructed
  std::atomic<std::size_t> finished_steps_{0};
  mutable std::mutex mutex_;
  StepRate rate_;  ///< estimates the steps per second; guarded by mutex_
  /// Time of the last output, measured by `clock_`. Before the first output, the value is
  /// `start_seconds_`.
  double last_shown_seconds_;
  bool has_shown_ = false;  ///< whether `show` has written a line
};

/// A function that receives the name of a stage, the number of finished steps and the number of all
/// steps. It is called at the start of a stage and after each step, on any thread, but never by two
/// threads at the same time.
using ProgressListener = std::function<void(const std::string& stage, std::size_t finished_steps,
                                            std::size_t total_steps)>;
/// Reports all progress of the process to `listener`; an empty listener ends the reports.
void set_progress_listener(ProgressListener listener);

/// Formats a time as "3.2 s", "15 s", "2 min 5 s" or "1 h 10 min".
std::string format_duration(double seconds);

}  // namespace crowdface
