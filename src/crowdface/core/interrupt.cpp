// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/interrupt.h"

#include <atomic>
#include <csignal>

#include "crowdface/core/error.h"

namespace crowdface {
namespace {

// Set by a handler, which may do so without a lock, and read by all threads.
std::atomic<int> signal_seen = 0;
static_assert(std::atomic<int>::is_always_lock_free);

extern "C" void remember_signal(int signal) {
  signal_seen = signal;
  // A user who asks twice means it.
  std::signal(signal, SIG_DFL);
}

}  // namespace

void catch_interrupts() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
    struct sigaction action {};
    // Whoever started us wants it ignored: nohup, or a shell script that ends before we do.
    if (::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN) continue;
    action = {};
    action.sa_handler = remember_signal;
    ::sigemptyset(&action.sa_mask);
    ::sigaction(signal, &action, nullptr);
  }
}

bool interrupted() {
  return signal_seen != 0;
}

void throw_if_interrupted() {
  if (interrupted()) {
    throw Interrupted("interrupted by a signal; run the same command again to go on");
  }
}

}  // namespace crowdface
