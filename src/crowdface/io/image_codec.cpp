// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/image_codec.h"

#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
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

constexpr const char* kLibrary = "libcrowdface_images.so";
constexpr const char* kFunction = "crowdface_image_codec";

// Only what a signal handler may call.
[[noreturn]] void end_without_libraries(int /*signal*/) {
  constexpr std::string_view kText =
      "error: the libraries that images need (OpenImageIO) cannot be started: out of memory, or of "
      "threads?\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, kText.data(), kText.size());
  ::_exit(static_cast<int>(ExitCode::kIoError));
}

constexpr unsigned kLongestStart = 60;  ///< seconds

std::atomic<bool> guarded = false;
volatile std::sig_atomic_t starting = 0;

/// Called by exit(), which libgfortran calls where it gets no memory to start.
void end_if_starting() {
  if (starting != 0) end_without_libraries(0);
}

/// While it lives, a library that ends the program because it gets no memory to start does so in our words;
/// likewise one that waits for ever, as a logger among them does for a thread that could not start.
class StartOfLibraries {
 public:
  StartOfLibraries() {
    [[maybe_unused]] static const int registered = std::atexit(end_if_starting);
    starting = 1;
    struct sigaction action {};
    action.sa_handler = end_without_libraries;
    for (std::size_t i = 0; i < kSignals.size(); ++i) {
      ::sigaction(kSignals[i], &action, &before_[i]);
    }
    ::alarm(kLongestStart);
    end_before_ = std::set_terminate([] { end_without_libraries(0); });
  }
  ~StartOfLibraries() {
    starting = 0;
    std::set_terminate(end_before_);
    ::alarm(0);
    for (std::size_t i = 0; i < kSignals.size(); ++i) {
      ::sigaction(kSignals[i], &before_[i], nullptr);
    }
  }
  StartOfLibraries(const StartOfLibraries&) = delete;
  StartOfLibraries& operator=(const StartOfLibraries&) = delete;

 private:
  static constexpr std::array kSignals = {SIGABRT, SIGALRM, SIGSEGV, SIGTRAP};
  std::array<struct sigaction, kSignals.size()> before_ = {};
  std::terminate_handler end_before_ = nullptr;
};

void* open_library(const std::string& name, int flags) {
  std::optional<StartOfLibraries> start;
  if (guarded) start.emplace();
  try {
    return ::dlopen(name.c_str(), flags | RTLD_LAZY);
  } catch (...) {  // leaves the loader locked, so that nothing can be undone
    if (guarded) end_without_libraries(0);
    throw IoError(
        "images can be neither read nor written: the libraries for them threw as they started");
  }
}

const ImageCodec& load() {
  // Programs of others are linked with it; ours finds it where it is installed, beside itself.
  void* library = open_library(kLibrary, RTLD_NOLOAD);
  std::string why;
  if (library == nullptr) {
    std::error_code ignored;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", ignored);
    const auto file = program.parent_path() / CROWDFACE_LIBRARIES / kLibrary;
    library = open_library(file.lexically_normal().string(), 0);
    if (library == nullptr) why = ::dlerror();  // NOLINT(concurrency-mt-unsafe): of this thread
  }
  if (library == nullptr) library = open_library(kLibrary, 0);
  if (library == nullptr) {
    throw IoError(
        concat("images can be neither read nor written, as the library for them cannot be "
               "loaded (is the installation whole?): ",
               why));
  }
  using Function = const ImageCodec*();
  auto* const codec = reinterpret_cast<Function*>(::dlsym(library, kFunction));
  if (codec == nullptr) throw IoError(concat(kLibrary, ": is of another version"));
  return *codec();
}

}  // namespace

void guard_start_of_image_libraries() {
  guarded = true;
}

const ImageCodec& image_codec() {
  static const ImageCodec& codec = load();
  return codec;
}

}  // namespace crowdface
