// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/progress.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <utility>

#include <unistd.h>

#include "crowdface/core/log.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

bool on_terminal() {
  static const bool terminal = ::isatty(STDERR_FILENO) != 0;
  return terminal && log_level() != LogLevel::kQuiet;
}

std::atomic<bool> has_listener = false;
std::mutex listener_mutex;
/// the function that receives all progress; guarded by listener_mutex
ProgressListener progress_listener;

void tell_listener(const std::string& stage, std::size_t finished_steps, std::size_t total) {
  if (!has_listener) return;
  const std::lock_guard lock(listener_mutex);
  if (progress_listener) progress_listener(stage, finished_steps, total);
}

}  // namespace

std::string format_duration(double seconds) {
  if (seconds < 9.95) return concat(format_fixed(seconds, 1), " s");
  const auto whole = std::llround(seconds);
  if (whole < 60) return concat(whole, " s");
  if (whole < 3600) return concat(whole / 60, " min ", whole % 60, " s");
  return concat(whole / 3600, " h ", whole % 3600 / 60, " min");
}

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

SecondsClock steady_seconds_clock() {
  return [] {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double>(now).count();
  };
}

Progress::Progress(std::string stage, std::size_t total, std::size_t simultaneous_steps,
                   SecondsClock clock)
    : stage_(std::move(stage)),
      total_steps_(total),
      clock_(std::move(clock)),
      start_seconds_(clock_()),
      rate_(simultaneous_steps),
      last_shown_seconds_(start_seconds_) {
  tell_listener(stage_, 0, total_steps_);
}

Progress::~Progress() {
  if (has_shown_ && on_terminal()) std::fputs("\r\033[K", stderr);
  if (finished_steps_ == total_steps_)
    log_info(concat(stage_, ": ", total_steps_, " in ", format_duration(seconds())));
}

std::optional<double> Progress::seconds_left() const {
  const std::lock_guard lock(mutex_);
  return seconds_left(finished_steps_);
}

std::optional<double> Progress::seconds_left(std::size_t finished_steps) const {
  const std::optional<double> rate = rate_.rate();
  if (!rate) return std::nullopt;
  return static_cast<double>(total_steps_ - finished_steps) / *rate;
}

void set_progress_listener(ProgressListener listener) {
  const std::lock_guard lock(listener_mutex);
  has_listener = static_cast<bool>(listener);
  progress_listener = std::move(listener);
}

void Progress::step(std::size_t step_count) {
  const std::size_t finished_steps = finished_steps_.fetch_add(step_count) + step_count;
  tell_listener(stage_, finished_steps, total_steps_);
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock.owns_lock() || finished_steps >= total_steps_) return;
  rate_.record(clock_(), finished_steps);
  show(finished_steps);
}

void Progress::show(std::size_t finished_steps) {
  const double now = clock_();
  if (now - last_shown_seconds_ < (on_terminal() ? 0.2 : 10.0)) return;
  last_shown_seconds_ = now;
  has_shown_ = true;
  std::string line = concat(stage_, ": ", finished_steps, "/", total_steps_);
  if (const auto left = seconds_left(finished_steps)) {
    const double rate = *rate_.rate();
    line += concat(", ", format_fixed(rate, rate < 10 ? 2 : 0), "/s, ", format_duration(*left),
                   " left");
  }
  if (on_terminal()) {
    std::fputs(concat("\r\033[K", line).c_str(), stderr);
  } else {
    log_info(line);
  }
}

}  // namespace crowdface
