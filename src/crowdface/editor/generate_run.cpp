// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/generate_run.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

/// Parses the number whose last digit stands just before position `end`.
std::uint64_t number_before(std::string_view text, std::size_t end) {
  std::size_t begin = end;
  while (begin > 0 && text[begin - 1] >= '0' && text[begin - 1] <= '9') --begin;
  return parse_unsigned(text.substr(begin, end - begin)).value_or(0);
}

std::uint64_t number_at(std::string_view text, std::size_t begin) {
  const std::size_t end = std::min(text.find_first_not_of("0123456789", begin), text.size());
  return parse_unsigned(text.substr(begin, end - begin)).value_or(0);
}

}  // namespace

RunProgress read_progress(std::string_view log) {
  RunProgress progress;
  while (log.ends_with('\n')) log.remove_suffix(1);
  std::string_view line = log.substr(log.rfind('\n') + 1);
  constexpr std::string_view kLevel = "info: ";
  if (line.starts_with(kLevel)) line.remove_prefix(kLevel.size());
  progress.message = line;
  const std::size_t slash = line.find('/');
  if (!line.ends_with(" left") || slash == line.npos) return progress;
  progress.done = number_before(line, slash);
  progress.total = number_at(line, slash + 1);
  const std::size_t rate = line.find(", ", slash);
  const std::size_t end = line.find("/s", rate == line.npos ? slash : rate);
  if (rate == line.npos || end == line.npos) return progress;
  const auto a_second = parse_double(line.substr(rate + 2, end - rate - 2));
  if (a_second && *a_second > 0 && progress.total > progress.done) {
    progress.seconds_left = static_cast<double>(progress.total - progress.done) / *a_second;
  }
  return progress;
}

std::string_view name_of(GenerateRun::State state) {
  constexpr std::array<std::string_view, 5> kNames = {"idle", "running", "done", "failed",
                                                      "stopped"};
  return kNames[static_cast<std::size_t>(state)];
}

GenerateRun::GenerateRun(std::vector<std::string> arguments, std::filesystem::path log)
    : arguments_(std::move(arguments)), log_(std::move(log)) {}

GenerateRun::~GenerateRun() {
  stop();
  const std::lock_guard lock(mutex_);
  update_state(0);
}

void GenerateRun::start() {
  const std::lock_guard lock(mutex_);
  update_state(WNOHANG);
  if (state_ == State::kRunning) return;
  write_file(log_, "");
  std::vector<char*> arguments;
  std::string program = "crowdface";
  arguments.push_back(program.data());
  for (std::string& argument : arguments_) arguments.push_back(argument.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawnattr_init(&attributes);
  ::posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_addopen(&files, STDERR_FILENO, log_.c_str(), O_WRONLY | O_APPEND, 0);
  ::posix_spawn_file_actions_adddup2(&files, STDERR_FILENO, STDOUT_FILENO);
  // Close the editor's file descriptors in the process of the run, so that this process does not
  // hold connections to the page open.
  ::posix_spawn_file_actions_addclosefrom_np(&files, STDERR_FILENO + 1);
  // Put the run into a separate process group. A signal from the editor's terminal (Ctrl+C) then
  // reaches only the editor, and the editor stops the run.
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  const int error =
      ::posix_spawn(&process_, "/proc/self/exe", &files, &attributes, arguments.data(), environ);
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&files);
  if (error != 0) {
    throw IoError(
        concat("crowdface generate cannot be started: ", std::generic_category().message(error)));
  }
  state_ = State::kRunning;
  was_stopped_ = false;
}

void GenerateRun::stop() {
  const std::lock_guard lock(mutex_);
  update_state(WNOHANG);
  if (state_ != State::kRunning) return;
  was_stopped_ = true;
  ::kill(process_, SIGTERM);
}

GenerateRun::State GenerateRun::state() {
  const std::lock_guard lock(mutex_);
  update_state(WNOHANG);
  return state_;
}

void GenerateRun::update_state(int wait_options) {
  if (state_ != State::kRunning) return;
  int status = 0;
  if (::waitpid(process_, &status, wait_options) != process_) return;
  const bool done = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  state_ = done ? State::kDone : was_stopped_ ? State::kStopped : State::kFailed;
}

RunProgress GenerateRun::progress() const {
  return path_exists(log_) ? read_progress(read_file(log_)) : RunProgress{};
}

}  // namespace crowdface
