// SPDX-License-Identifier: Apache-2.0
// Preloaded into the program: one call of one kind fails, whoever makes it, our code, the C++ library or any
// other. FAULT_CALL names the kind, FAULT_AT its number, counted from the program's first call of signal(),
// with which main begins; FAULT_COUNT a file for how many there were. With FAULT_FOREVER all calls from that number on
// fail. FAULT_VANISHES names a file that is removed after each look at it.
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

// NOLINTBEGIN(readability-identifier-naming): the C library's own names
extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* __libc_calloc(std::size_t count, std::size_t size);
extern "C" void* __libc_realloc(void* memory, std::size_t size);
extern "C" void* __libc_memalign(std::size_t alignment, std::size_t size);
// NOLINTEND(readability-identifier-naming)

namespace {

std::atomic<bool> begun = false;
std::atomic<unsigned long> seen = 0;
const char* kind = nullptr;
const char* vanishing = nullptr;
unsigned long fail_at = 0;
bool forever = false;

bool fails(const char* call, int error) {
  if (!begun || std::strcmp(call, kind) != 0) return false;
  const unsigned long number = seen++;
  if (number < fail_at || (number > fail_at && !forever)) return false;
  errno = error;
  return true;
}

template <class Function>
Function* next(Function*, const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

const char* variable(const char* name) {
  return std::getenv(name);  // NOLINT(concurrency-mt-unsafe): nothing here sets one
}

void tell_count() {
  const char* file = variable("FAULT_COUNT");
  if (file == nullptr) return;
  char text[32];
  const int length = std::snprintf(text, sizeof text, "%lu\n", seen.load());
  const int fd =
      static_cast<int>(::syscall(SYS_openat, AT_FDCWD, file, O_WRONLY | O_CREAT | O_TRUNC, 0600));
  if (fd < 0) return;
  [[maybe_unused]] const ssize_t written = ::write(fd, text, static_cast<std::size_t>(length));
  ::syscall(SYS_close, fd);
}

}  // namespace

extern "C" {

sighandler_t signal(int number, sighandler_t handler) {
  static auto* const real = next(&signal, "signal");
  if (!begun) {
    kind = variable("FAULT_CALL");
    const char* at = variable("FAULT_AT");
    fail_at = at != nullptr ? std::strtoul(at, nullptr, 10) : ~0UL;
    forever = variable("FAULT_FOREVER") != nullptr;
    vanishing = variable("FAULT_VANISHES");
    if (kind != nullptr) {
      std::atexit(tell_count);
      begun = true;
    }
  }
  return real(number, handler);
}

void* malloc(std::size_t size) {
  return fails("malloc", ENOMEM) ? nullptr : __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) {
  return fails("calloc", ENOMEM) ? nullptr : __libc_calloc(count, size);
}

void* realloc(void* memory, std::size_t size) {
  return fails("realloc", ENOMEM) ? nullptr : __libc_realloc(memory, size);
}

int posix_memalign(void** memory, std::size_t alignment, std::size_t size) noexcept {
  void* const got = fails("posix_memalign", ENOMEM) ? nullptr : __libc_memalign(alignment, size);
  if (got != nullptr) *memory = got;
  return got != nullptr ? 0 : ENOMEM;
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  return fails("aligned_alloc", ENOMEM) ? nullptr : __libc_memalign(alignment, size);
}

void* mmap(void* at, std::size_t size, int protection, int flags, int fd, off_t offset) noexcept {
  if (fails("mmap", ENOMEM)) return MAP_FAILED;
  // NOLINTNEXTLINE(performance-no-int-to-ptr): that is what the call returns
  return reinterpret_cast<void*>(::syscall(SYS_mmap, at, size, protection, flags, fd, offset));
}

DIR* opendir(const char* path) {
  static auto* const real = next(&opendir, "opendir");
  return fails("opendir", EMFILE) ? nullptr : real(path);
}

dirent* readdir(DIR* folder) {
  static auto* const real = next(&readdir, "readdir");
  return fails("readdir", EIO) ? nullptr : real(folder);
}

std::size_t fread(void* to, std::size_t size, std::size_t count, FILE* file) {
  static auto* const real = next(&fread, "fread");
  return fails("fread", EIO) ? 0 : real(to, size, count, file);
}

int fstat(int fd, struct stat* status) noexcept {
  static auto* const real = next(&fstat, "fstat");
  return fails("fstat", EIO) ? -1 : real(fd, status);
}

int stat(const char* path, struct stat* status) noexcept {
  static auto* const real = next(&stat, "stat");
  if (fails("stat", EIO)) return -1;
  const int result = real(path, status);
  if (result == 0 && vanishing != nullptr && std::strcmp(path, vanishing) == 0) ::unlink(path);
  return result;
}

int lstat(const char* path, struct stat* status) noexcept {
  static auto* const real = next(&lstat, "lstat");
  return fails("lstat", EIO) ? -1 : real(path, status);
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*body)(void*),
                   void* argument) noexcept {
  static auto* const real = next(&pthread_create, "pthread_create");
  if (fails("pthread_create", EAGAIN)) return EAGAIN;
  return real(thread, attributes, body, argument);
}
}
