// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/progress.h"

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
ProgressListener progress_listener;  ///< guarded by listener_mutex

void tell_listener(const std::string& stage, std::size_t done, std::size_t total) {
  if (!has_listener) return;
  const std::lock_guard lock(listener_mutex);
  if (progress_listener) progress_listener(stage, done, total);
}

}  // namespace

std::string format_duration(double seconds) {
  if (seconds < 9.95) return concat(format_fixed(seconds, 1), " s");
  const auto whole = std::llround(seconds);
  if (whole < 60) return concat(whole, " s");
  if (whole < 3600) return concat(whole / 60, " min ", whole % 60, " s");
  return concat(whole / 3600, " h ", whole % 3600 / 60, " min");
}

Progress::Progress(std::string stage, std::size_t total) : stage_(std::move(stage)), total_(total) {
  tell_listener(stage_, 0, total_);
}

Progress::~Progress() {
  if (shown_ && on_terminal()) std::fputs("\r\033[K", stderr);
  if (done_ == total_) log_info(concat(stage_, ": ", total_, " in ", format_duration(seconds())));
}

double Progress::seconds() const {
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

void set_progress_listener(ProgressListener listener) {
  const std::lock_guard lock(listener_mutex);
  has_listener = static_cast<bool>(listener);
  progress_listener = std::move(listener);
}

void Progress::step(std::size_t amount) {
  const std::size_t done = done_.fetch_add(amount) + amount;
  tell_listener(stage_, done, total_);
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (lock.owns_lock() && done < total_) show(done);
}

void Progress::show(std::size_t done) {
  const auto now = Clock::now();
  const double since = std::chrono::duration<double>(now - last_shown_).count();
  if (since < (on_terminal() ? 0.2 : 10.0)) return;
  last_shown_ = now;
  shown_ = true;
  const double elapsed = seconds();
  const double rate = static_cast<double>(done) / elapsed;
  const std::string line =
      concat(stage_, ": ", done, "/", total_, ", ", format_fixed(rate, rate < 10 ? 2 : 0), "/s, ",
             format_duration(static_cast<double>(total_ - done) / rate), " left");
  if (on_terminal()) {
    std::fputs(concat("\r\033[K", line).c_str(), stderr);
  } else {
    log_info(line);
  }
}

}  // namespace crowdface
