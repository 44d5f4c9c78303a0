// SPDX-License-Identifier: Apache-2.0
#include "reliability/io_faults.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstring>
#include <ctime>
#include <set>
#include <stdexcept>
#include <string_view>

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "crowdface/core/error.h"

namespace {

using crowdface::testing::Fault;

/// Shared between a child and the test that watches it.
struct Watch {
  std::atomic<std::uint64_t> calls = 0, written = 0;
  std::atomic<bool> struck = false;
  std::array<char, 4000> message = {};
};

// Of the child; the test itself has no fault.
Fault fault_in_force;
std::string watched_folder;
Watch* watch = nullptr;
std::array<std::atomic<bool>, 4096> is_watched = {};
std::int64_t clock_shift = 0;

bool watches(const char* path) {
  return watch != nullptr && std::string_view(path).starts_with(watched_folder);
}

bool watches(int fd) {
  return watch != nullptr && fd >= 0 && static_cast<std::size_t>(fd) < is_watched.size() &&
         is_watched[static_cast<std::size_t>(fd)];
}

void set_watched(int fd, bool watched) {
  if (fd >= 0 && static_cast<std::size_t>(fd) < is_watched.size()) {
    is_watched[static_cast<std::size_t>(fd)] = watched;
  }
}

[[noreturn]] void die() {
  watch->struck = true;
  ::raise(SIGKILL);
  std::abort();
}

/// Makes one watched call, or what the fault makes of it.
/// \param failed  what it returns if it fails.
template <class Call, class HalfCall, class Result>
auto watched_call(const Call& call, const HalfCall& half, Result failed) {
  const bool now = watch->calls++ == fault_in_force.at;
  using Kind = Fault::Kind;
  if (!now) return call();
  switch (fault_in_force.kind) {
    case Kind::kFail:
      watch->struck = true;
      errno = fault_in_force.error;
      return static_cast<decltype(call())>(failed);
    case Kind::kSignal:
      watch->struck = true;
      ::kill(::getpid(), fault_in_force.error);
      return call();
    case Kind::kKillBefore:
      die();
    case Kind::kKillWithin:
      half();
      die();
    case Kind::kKillAfter:
      call();
      die();
    default:
      return call();
  }
}

template <class Call>
auto watched_call(const Call& call) {
  return watched_call(
      call, [] {}, -1);
}

/// Folders that are being listed. (One thread lists at a time.)
std::set<DIR*> watched_listings;

}  // namespace

// Calls of open, write, … and the real ones.
// NOLINTBEGIN(readability-identifier-naming): the linker's own names
extern "C" {
int __real_open(const char* path, int flags, ...);
ssize_t __real_read(int fd, void* to, size_t size);
ssize_t __real_write(int fd, const void* from, size_t size);
int __real_fsync(int fd);
int __real_close(int fd);
int __real_dup(int fd);
int __real_rename(const char* from, const char* to);
int __real_unlink(const char* path);
int __real_flock(int fd, int operation);
int __real_fstat(int fd, struct stat* status);
void* __real_mmap(void* at, size_t size, int protection, int flags, int fd, off_t offset);
DIR* __real_opendir(const char* path);
dirent* __real_readdir(DIR* folder);
int __real_closedir(DIR* folder);

int __wrap_open(const char* path, int flags, ...) {
  mode_t mode = 0;
  if ((flags & O_CREAT) != 0) {
    va_list more;
    va_start(more, flags);
    mode = va_arg(more, mode_t);
    va_end(more);
  }
  if (!watches(path)) return __real_open(path, flags, mode);
  const int fd = watched_call([&] { return __real_open(path, flags, mode); });
  set_watched(fd, true);
  return fd;
}

ssize_t __wrap_read(int fd, void* to, size_t size) {
  if (!watches(fd)) return __real_read(fd, to, size);
  return watched_call([&] { return __real_read(fd, to, size); });
}

ssize_t __wrap_write(int fd, const void* from, size_t size) {
  if (!watches(fd)) return __real_write(fd, from, size);
  if (fault_in_force.kind == Fault::Kind::kShortWrites && size > 1) --size;
  if (fault_in_force.kind == Fault::Kind::kDiskFull) {
    const std::uint64_t before = watch->written.fetch_add(size);
    const std::uint64_t room = before < fault_in_force.at ? fault_in_force.at - before : 0;
    if (room < size) {
      watch->struck = true;
      if (room > 0) return __real_write(fd, from, room);  // as a full disk does
      errno = ENOSPC;
      return -1;
    }
    return __real_write(fd, from, size);
  }
  watch->written += size;
  return watched_call([&] { return __real_write(fd, from, size); },
                      [&] { __real_write(fd, from, size / 2); }, -1);
}

int __wrap_fsync(int fd) {
  if (!watches(fd)) return __real_fsync(fd);
  return watched_call([&] { return __real_fsync(fd); });
}

int __wrap_close(int fd) {
  if (!watches(fd)) return __real_close(fd);
  set_watched(fd, false);
  return watched_call([&] { return __real_close(fd); });
}

int __wrap_dup(int fd) {
  const int copy = __real_dup(fd);
  if (watches(fd)) set_watched(copy, true);
  return copy;
}

int __wrap_rename(const char* from, const char* to) {
  if (!watches(to)) return __real_rename(from, to);
  return watched_call([&] { return __real_rename(from, to); });
}

int __wrap_unlink(const char* path) {
  if (!watches(path)) return __real_unlink(path);
  return watched_call([&] { return __real_unlink(path); });
}

int __wrap_flock(int fd, int operation) {
  if (!watches(fd)) return __real_flock(fd, operation);
  return watched_call([&] { return __real_flock(fd, operation); });
}

int __wrap_fstat(int fd, struct stat* status) {
  if (!watches(fd)) return __real_fstat(fd, status);
  return watched_call([&] { return __real_fstat(fd, status); });
}

void* __wrap_mmap(void* at, size_t size, int protection, int flags, int fd, off_t offset) {
  const auto call = [&] { return __real_mmap(at, size, protection, flags, fd, offset); };
  return watches(fd) ? watched_call(
                           call, [] {}, MAP_FAILED)
                     : call();
}

DIR* __wrap_opendir(const char* path) {
  const auto call = [&] { return __real_opendir(path); };
  if (!watches(path)) return call();
  DIR* folder = watched_call(
      call, [] {}, nullptr);
  if (folder != nullptr) watched_listings.insert(folder);
  return folder;
}

dirent* __wrap_readdir(DIR* folder) {
  const auto call = [&] { return __real_readdir(folder); };
  return watched_listings.contains(folder) ? watched_call(
                                                 call, [] {}, nullptr)
                                           : call();
}

int __wrap_closedir(DIR* folder) {
  watched_listings.erase(folder);
  return __real_closedir(folder);
}

// Libraries ask a program that has them for these, before the C library.
int clock_gettime(clockid_t clock, timespec* time) noexcept {
  const auto result = static_cast<int>(::syscall(SYS_clock_gettime, clock, time));
  if (clock == CLOCK_REALTIME) time->tv_sec += clock_shift;
  return result;
}

time_t time(time_t* result) noexcept {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  if (result != nullptr) *result = now.tv_sec;
  return now.tv_sec;
}
}
// NOLINTEND(readability-identifier-naming)

namespace crowdface::testing {
namespace {

void keep_message(const char* text) {
  std::strncpy(watch->message.data(), text, watch->message.size() - 1);
}

int run_child(const std::function<void()>& work) {
  // What it warns of is meant for nobody.
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(nowhere, STDERR_FILENO);
  try {
    work();
    return 0;
  } catch (const RecoverableError& error) {
    keep_message(error.what());
    return static_cast<int>(error.code());
  } catch (const std::exception& error) {
    keep_message(error.what());
    return static_cast<int>(ExitCode::kBug);
  }
}

}  // namespace

std::vector<ChildOutcome> run_together(const std::filesystem::path& folder,
                                       const std::vector<Child>& children) {
  const std::size_t size = sizeof(Watch) * children.size();
  void* shared = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED) throw std::runtime_error("cannot map");
  auto* watches_of_all = static_cast<Watch*>(shared);
  std::vector<pid_t> processes;
  for (std::size_t c = 0; c < children.size(); ++c) {
    new (watches_of_all + c) Watch();
    const pid_t process = ::fork();
    if (process < 0) throw std::runtime_error("cannot fork");
    if (process == 0) {
      fault_in_force = children[c].fault;
      watched_folder = folder.string();
      watch = watches_of_all + c;
      ::_exit(run_child(children[c].work));
    }
    processes.push_back(process);
  }
  std::vector<ChildOutcome> outcomes;
  for (std::size_t c = 0; c < children.size(); ++c) {
    int status = 0;
    ::waitpid(processes[c], &status, 0);
    const Watch& seen = watches_of_all[c];
    outcomes.push_back({WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status),
                        seen.message.data(), seen.calls, seen.written, seen.struck});
  }
  ::munmap(shared, size);
  return outcomes;
}

ChildOutcome run_with_fault(const std::filesystem::path& folder, const Fault& fault,
                            const std::function<void()>& work) {
  return run_together(folder, {{fault, work}}).front();
}

void shift_clock(std::int64_t seconds) {
  clock_shift = seconds;
}

}  // namespace crowdface::testing
