// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

namespace crowdface {

/// How far a run is, by what it says: a line such as "info: casting: 12/24, 3.1/s, 4 s left".
struct RunProgress {
  std::uint64_t done = 0, total = 0;
  double seconds_left = 0;
  std::string message;  ///< the last line, without "info: "
};
RunProgress read_progress(std::string_view log);

/// `crowdface generate` beside the editor, as a process of its own: neither ends with the other's mistakes,
/// and what is stopped goes on where it was. Any thread may ask.
class GenerateRun {
 public:
  enum class State { kIdle, kRunning, kDone, kFailed, kStopped };
  /// \param arguments  of the program, "generate" first
  /// \param log        takes what it says
  GenerateRun(std::vector<std::string> arguments, std::filesystem::path log);
  /// Stops it and waits until it has ended.
  ~GenerateRun();
  GenerateRun(const GenerateRun&) = delete;
  GenerateRun& operator=(const GenerateRun&) = delete;

  /// Begins, unless it runs. \throws IoError if the program cannot be started.
  void start();
  void stop();
  State state();
  RunProgress progress() const;

 private:
  void look(int options);

  std::vector<std::string> arguments_;
  std::filesystem::path log_;
  std::mutex mutex_;
  State state_ = State::kIdle;
  bool stopped_ = false;
  pid_t process_ = 0;
};

/// "idle", "running", "done", "failed" or "stopped".
std::string_view name_of(GenerateRun::State state);

}  // namespace crowdface
