// SPDX-License-Identifier: Apache-2.0
// What can happen to a run at its system calls. Test programs that link io_faults.cpp with the
// linker's --wrap send the calls of crowdface's own code through it (tests/reliability/CMakeLists.txt).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace crowdface::testing {

/// What happens at one of the calls that concern files and folders below a folder: open, read, write,
/// fsync, close, rename, unlink, flock, fstat, mmap, opendir, readdir.
struct Fault {
  enum class Kind {
    kNone,
    kFail,        ///< the call fails with `error`
    kKillBefore,  ///< SIGKILL instead of the call
    kKillWithin,  ///< SIGKILL when half of a write is done; before any other call
    kKillAfter,   ///< SIGKILL when the call has returned
    kSignal,      ///< the signal `error` before the call
    kDiskFull,    ///< from this many written bytes on there is no room: ENOSPC
    kShortWrites  ///< every write takes one byte less than asked for, if that leaves any
  };
  Kind kind = Kind::kNone;
  std::uint64_t at = 0;  ///< which call, from 0; with kDiskFull: bytes
  int error = 0;         ///< errno, or a signal
};

/// How a child process ended.
struct ChildOutcome {
  int code = 0;               ///< exit code; −signal if a signal ended it
  std::string message;        ///< of the error that ended it
  std::uint64_t calls = 0;    ///< that concerned the folder
  std::uint64_t written = 0;  ///< bytes, into files below the folder
  bool struck = false;        ///< whether the fault happened
};

/// What a child process does, and what happens to it.
struct Child {
  Fault fault;
  std::function<void()> work;
};

/// Runs children at the same time, each in a process of its own, with its fault at the files below
/// `folder`; an Error becomes an exit code, as in the program itself. This process must not have
/// started threads: they would not live on in its children.
std::vector<ChildOutcome> run_together(const std::filesystem::path& folder,
                                       const std::vector<Child>& children);

/// Runs one child.
ChildOutcome run_with_fault(const std::filesystem::path& folder, const Fault& fault,
                            const std::function<void()>& work);

/// How far the clock of the children is ahead, in seconds.
void shift_clock(std::int64_t seconds);

}  // namespace crowdface::testing
