// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/project_library.h"

#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

#include <dlfcn.h>
#include <unistd.h>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

/// Says what needs the libraries that are now being loaded, such as "images need (OpenImageIO)".
/// The error message "the libraries that … cannot be started" contains this text.
std::atomic<const char*> current_dependents_phrase{"run"};

// Ends the process with a message that a library cannot be started. As a signal handler, calls only
// async-signal-safe functions.
[[noreturn]] void end_without_libraries(int /*signal*/) {
  const auto say = [](const char* text) {
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text, std::strlen(text));
  };
  say("error: the libraries that ");
  say(current_dependents_phrase.load());
  say(" cannot be started: out of memory, or of threads?\n");
  ::_exit(static_cast<int>(ExitCode::kIoError));
}

constexpr unsigned kLoadTimeoutSeconds = 60;  ///< seconds that loading a library may take

std::atomic<bool> handles_crashes = false;
volatile std::sig_atomic_t is_loading = 0;

/// Handler of exit(): ends the process with a message if a library calls exit() while the library
/// is being loaded. For example, libgfortran calls exit() if it cannot allocate memory.
void end_if_loading() {
  if (is_loading != 0) end_without_libraries(0);
}

/// Lives while a library is being loaded. If the library ends the process (for example for lack of
/// memory) or hangs (for example a logger that waits for a thread that could not start), the
/// program ends with an error message.
class LoadingGuard {
 public:
  explicit LoadingGuard(const char* dependents_phrase) {
    current_dependents_phrase = dependents_phrase;
    [[maybe_unused]] static const int registered = std::atexit(end_if_loading);
    is_loading = 1;
    struct sigaction action {};
    action.sa_handler = end_without_libraries;
    for (std::size_t i = 0; i < kSignals.size(); ++i) {
      ::sigaction(kSignals[i], &action, &previous_actions_[i]);
    }
    ::alarm(kLoadTimeoutSeconds);
    previous_terminate_ = std::set_terminate([] { end_without_libraries(0); });
  }
  ~LoadingGuard() {
    is_loading = 0;
    std::set_terminate(previous_terminate_);
    ::alarm(0);
    for (std::size_t i = 0; i < kSignals.size(); ++i) {
      ::sigaction(kSignals[i], &previous_actions_[i], nullptr);
    }
  }
  LoadingGuard(const LoadingGuard&) = delete;
  LoadingGuard& operator=(const LoadingGuard&) = delete;

 private:
  static constexpr std::array kSignals = {SIGABRT, SIGALRM, SIGSEGV, SIGTRAP};
  std::array<struct sigaction, kSignals.size()> previous_actions_ = {};
  std::terminate_handler previous_terminate_ = nullptr;
};

void* open_library(const std::string& name, int flags, const char* dependents_phrase,
                   const char* failure_phrase) {
  std::optional<LoadingGuard> start;
  if (handles_crashes) start.emplace(dependents_phrase);
  try {
    return ::dlopen(name.c_str(), flags | RTLD_LAZY);
  } catch (...) {  // the dynamic loader stays locked, so recovery is impossible
    if (handles_crashes) end_without_libraries(0);
    throw IoError(concat(failure_phrase, ": their libraries failed to start"));
  }
}

}  // namespace

void handle_crashes_during_library_loading() {
  handles_crashes = true;
}

void* load_library_function(const char* library, const char* function,
                            const char* dependents_phrase, const char* failure_phrase) {
  // A third-party program may link `library`, so that it is loaded already. Otherwise load it from
  // a folder relative to the executable.
  void* opened = open_library(library, RTLD_NOLOAD, dependents_phrase, failure_phrase);
  std::string why;
  if (opened == nullptr) {
    std::error_code ignored;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", ignored);
    const auto file = program.parent_path() / CROWDFACE_LIBRARIES / library;
    opened = open_library(file.lexically_normal().string(), 0, dependents_phrase, failure_phrase);
    if (opened == nullptr) why = ::dlerror();  // NOLINT(concurrency-mt-unsafe): one per thread
  }
  if (opened == nullptr) opened = open_library(library, 0, dependents_phrase, failure_phrase);
  if (opened == nullptr) {
    throw IoError(
        concat(failure_phrase,
               ", because a library cannot be loaded (is the installation complete?): ", why));
  }
  void* found = ::dlsym(opened, function);
  if (found == nullptr) throw IoError(concat(library, ": belongs to another version of crowdface"));
  return found;
}

}  // namespace crowdface
