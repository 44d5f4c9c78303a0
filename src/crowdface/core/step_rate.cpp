// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/step_rate.h"

namespace crowdface {

void StepRate::record(double seconds, std::size_t finished_steps) {
  // Smallest time between two stored samples, in seconds. It limits the memory that millions of
  // steps need.
  constexpr double kMinInterval = 0.05;
  if (samples_.empty()) {
    first_seconds_ = seconds;
  } else if (finished_steps < samples_.back().finished_steps + simultaneous_steps_ ||
             seconds < samples_.back().seconds + kMinInterval) {
    return;
  }
  samples_.push_back({seconds, finished_steps});
  const double middle = (first_seconds_ + seconds) / 2;
  while (samples_.size() > 2 && samples_[1].seconds <= middle) samples_.pop_front();
}

std::optional<double> StepRate::rate() const {
  if (samples_.size() < 2) return std::nullopt;
  const Sample& from = samples_.front();
  const Sample& to = samples_.back();
  return static_cast<double>(to.finished_steps - from.finished_steps) / (to.seconds - from.seconds);
}

}  // namespace crowdface
