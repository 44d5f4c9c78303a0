// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/interrupt.h"

#include <atomic>
#include <csignal>

#include "crowdface/core/error.h"

namespace crowdface {
namespace {

// Written by the signal handler and read by all threads. Lock-free, as a signal handler requires.
std::atomic<int> signal_seen = 0;
static_assert(std::atomic<int>::is_always_lock_free);

extern "C" void remember_signal(int signal) {
  signal_seen = signal;
  // A second signal ends the program.
  std::signal(signal, SIG_DFL);
}

}  // namespace

void catch_interrupts() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
    struct sigaction action {};
    // The parent process wants this signal ignored, as nohup does.
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
    throw Interrupted("interrupted by a signal; run the same command again to continue");
  }
}

}  // namespace crowdface
