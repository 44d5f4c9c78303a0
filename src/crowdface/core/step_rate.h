// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <optional>

namespace crowdface {

/// Estimates how many steps a stage makes per second, from the second half of the time since the
/// first step. The time before the first step does not count, because a stage may need a long
/// preparation. The first half does not count because steps may become slower, as in a crowd that
/// is nearly full.
class StepRate {
 public:
  /// \param simultaneous_steps  number of steps that may end at almost the same time, such as the
  ///     number of threads. Two samples are stored only if at least this many steps ended between
  ///     them.
  explicit StepRate(std::size_t simultaneous_steps = 1) : simultaneous_steps_(simultaneous_steps) {}

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
    double seconds = 0;  ///< time at which `record` was called: the argument `seconds` of the call
    std::size_t finished_steps = 0;
  };
  std::size_t simultaneous_steps_;
  double first_seconds_ = 0;  ///< `seconds` of the first call of `record`
  /// The samples in the second half of the time that has passed since the first step, and the last
  /// sample before that half.
  std::deque<Sample> samples_;
};

}  // namespace crowdface
