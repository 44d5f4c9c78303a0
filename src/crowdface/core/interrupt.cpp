// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/interrupt.h"

#include <atomic>
#include <csignal>
#include <cstring>
#include <ctime>

#include <unistd.h>

#include "crowdface/core/cancel.h"
#include "crowdface/core/error.h"

namespace crowdface {
namespace {

// The number of the signal that arrived; 0: none. The signal handler writes it, and all threads
// read it. It is lock-free, as a signal handler requires.
std::atomic<int> signal_seen = 0;
static_assert(std::atomic<int>::is_always_lock_free);

constexpr const char* kMessage = "interrupted by a signal; run the same command again to continue";
constexpr timespec kGrace = {0, 700'000'000};  ///< time from a signal to end_program: 0.7 s

timer_t grace_timer;
const int kGraceSignal = SIGRTMIN;

/// Ends the program immediately. No output file is left half-written, because a file gets its
/// final name only when it is complete.
extern "C" void end_program(int) {
  for (const char* text : {"error: ", kMessage, "\n"}) {
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text, std::strlen(text));
  }
  ::_exit(static_cast<int>(ExitCode::kInterrupted));
}

// Signal handler: records the signal and starts the timer that ends the program. Calls only
// functions that POSIX allows in signal handlers.
extern "C" void remember_signal(int signal) {
  signal_seen = signal;
  // A second signal ends the program.
  std::signal(signal, SIG_DFL);
  const itimerspec once = {{}, kGrace};
  ::timer_settime(grace_timer, 0, &once, nullptr);
}

}  // namespace

void catch_interrupts() {
  std::signal(kGraceSignal, end_program);
  sigevent event{};
  event.sigev_notify = SIGEV_SIGNAL;
  event.sigev_signo = kGraceSignal;
  // If no timer can be created, the program ends after the current block of work, however long this
  // block takes.
  ::timer_create(CLOCK_MONOTONIC, &event, &grace_timer);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
    struct sigaction action {};
    // If the parent process (such as nohup) has made this process ignore the signal, keep ignoring
    // it.
    if (::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN) continue;
    action = {};
    action.sa_handler = remember_signal;
    ::sigemptyset(&action.sa_mask);
    ::sigaction(signal, &action, nullptr);
  }
}

bool is_interrupted() {
  return signal_seen != 0 || is_cancelled();
}

void throw_if_interrupted() {
  if (is_interrupted()) {
    throw Interrupted(signal_seen != 0 ? kMessage : "cancelled; run again to continue");
  }
}

}  // namespace crowdface
