// SPDX-License-Identifier: Apache-2.0
// MappedFile (declared in file.h). If a file is truncated while mapped, access to a missing page
// raises SIGBUS. The signal handler finds the mapping in a table and does what the mapping's
// `OnTruncation` value says.
#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/file_descriptor.h"
#include "crowdface/core/memory.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// A mapping that the SIGBUS handler watches: one entry of the handler's table.
struct Watch {
  std::atomic<bool> taken = false;
  std::atomic<char*> begin = nullptr;
  std::atomic<std::size_t> size = 0;
  std::atomic<bool> fill = false;
  std::atomic<bool> cut = false;
  std::array<char, 512> message = {};
};

// The table has more entries than a process usually has open files. If the table is full, the
// handler does not watch further mappings.
std::array<Watch, 4096> watches;
std::atomic<bool> watching = false;

// The SIGBUS handler. Calls only functions that are safe in a signal handler. (On Linux, mmap is
// one of these, because it is a plain system call.)
void on_bus_error(int signal, siginfo_t* info, void*) {
  auto* at = static_cast<char*>(info->si_addr);
  for (Watch& watch : watches) {
    char* begin = watch.begin;
    if (begin == nullptr || at < begin || at >= begin + watch.size) continue;
    if (!watch.fill) {
      [[maybe_unused]] const ssize_t written =
          ::write(STDERR_FILENO, watch.message.data(), std::strlen(watch.message.data()));
      ::_exit(static_cast<int>(ExitCode::kIoError));
    }
    const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    char* first = begin + static_cast<std::size_t>(at - begin) / page * page;
    const std::size_t rest = static_cast<std::size_t>(begin + watch.size - first);
    watch.cut = true;
    if (::mmap(first, rest, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1, 0) == first) {
      return;
    }
    break;
  }
  // The address is in no watched mapping: remove the handler, so that the repeated access ends the
  // process.
  std::signal(signal, SIG_DFL);
}

constexpr std::string_view kWasTruncated =
    ": was truncated while it was being read; write the file again, then run the same command "
    "again";

int begin_watch(char* begin, std::size_t size, OnTruncation on_truncation, const fs::path& path) {
  for (std::size_t i = 0; i < watches.size(); ++i) {
    Watch& watch = watches[i];
    if (watch.taken.exchange(true)) continue;
    const std::string message =
        concat("error: ", printable(path.string()).substr(0, 400), kWasTruncated, '\n');
    std::memcpy(watch.message.data(), message.c_str(), message.size() + 1);
    watch.cut = false;
    watch.fill = on_truncation == OnTruncation::kFill;
    watch.size = size;
    watch.begin = begin;
    return static_cast<int>(i);
  }
  return -1;
}

}  // namespace

void watch_mapped_files() {
  watching = true;
  // A mapping that fills missing pages keeps its file open: allow as many open files as possible
  struct rlimit open_files {};
  if (::getrlimit(RLIMIT_NOFILE, &open_files) == 0) {
    open_files.rlim_cur = open_files.rlim_max;
    ::setrlimit(RLIMIT_NOFILE, &open_files);
  }
  struct sigaction before {};
  if (::sigaction(SIGBUS, nullptr, &before) != 0 || before.sa_handler != SIG_DFL) return;
  struct sigaction action {};
  action.sa_sigaction = on_bus_error;
  action.sa_flags = SA_SIGINFO;
  ::sigaction(SIGBUS, &action, nullptr);
}

struct MappedFile::Mapping {
  /// Anonymous memory for a copy of the file.
  explicit Mapping(std::size_t length, const fs::path& name)
      : data(::mmap(nullptr, length, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0)),
        size(length) {
    if (data == MAP_FAILED) throw_with_errno<IoError>(name, "cannot be read");
  }
  Mapping(FileDescriptor file, std::size_t length, OnTruncation on_truncation, const fs::path& name)
      : data(::mmap(nullptr, length, PROT_READ, MAP_PRIVATE, file.get(), 0)), size(length) {
    if (data == MAP_FAILED) throw_with_errno<IoError>(name, "cannot be mapped");
    watch = begin_watch(static_cast<char*>(data), size, on_truncation, name);
    if (on_truncation == OnTruncation::kFill) kept = std::move(file);
  }
  ~Mapping() {
    if (watch >= 0) {
      watches[static_cast<std::size_t>(watch)].begin = nullptr;
      watches[static_cast<std::size_t>(watch)].taken = false;
    }
    ::munmap(data, size);
  }

  void* data;
  std::size_t size;
  int watch = -1;
  FileDescriptor kept{-1};  ///< the open file; kept open only with kFill
};

MappedFile::MappedFile(const fs::path& path, OnTruncation on_truncation) {
  auto [file, size] = open_for_reading(path);
  if (size == 0) return;
  if (watching) {
    mapping_ = std::make_shared<const Mapping>(std::move(file), size, on_truncation, path);
    return;
  }
  mapping_ = std::make_shared<const Mapping>(size, path);
  if (read_up_to(file, static_cast<char*>(mapping_->data), size, path) < size) {
    throw IoError(concat(path.string(), kWasTruncated));
  }
}

MappedFile MappedFile::from_text(std::string text) {
  MappedFile file;
  file.text_ = std::make_shared<const std::string>(std::move(text));
  return file;
}

std::string_view MappedFile::bytes() const {
  if (text_) return *text_;
  if (!mapping_) return {};
  return {static_cast<const char*>(mapping_->data), mapping_->size};
}

bool MappedFile::was_truncated() const {
  if (!mapping_) return false;
  const auto& [data, size, watch, kept] = *mapping_;
  if (watch >= 0 && watches[static_cast<std::size_t>(watch)].cut) return true;
  struct stat status {};
  return kept.valid() &&
         (::fstat(kept.get(), &status) != 0 || static_cast<std::size_t>(status.st_size) < size);
}

}  // namespace crowdface
