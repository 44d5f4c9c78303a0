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

/// Progress of a run, parsed from log lines such as "info: casting: 12/24, 3.1/s, 4 s left".
struct RunProgress {
  /// number of finished tasks and of all tasks in the current stage, such as faces to cast
  std::uint64_t done = 0, total = 0;
  double seconds_left = 0;  ///< estimated time until the stage ends; 0 if unknown
  std::string message;      ///< the last line of the log; a prefix "info: " is removed
};
/// Parses the last line of the log of a run.
RunProgress read_progress(std::string_view log);

/// Runs `crowdface generate` as a separate process, so that a crash of one process does not stop
/// the other process. After a stop, the next start continues the work. Thread-safe.
class GenerateRun {
 public:
  enum class State { kIdle, kRunning, kDone, kFailed, kStopped };
  /// \param arguments  arguments of the program; the first is "generate"
  /// \param log        file for the output of the run
  GenerateRun(std::vector<std::string> arguments, std::filesystem::path log);
  /// Stops the run and waits for its end.
  ~GenerateRun();
  GenerateRun(const GenerateRun&) = delete;
  GenerateRun& operator=(const GenerateRun&) = delete;

  /// Starts the run unless it is running.
  /// \throws IoError if the program cannot be started.
  void start();
  /// Asks the run to stop. Does not wait for its end.
  void stop();
  State state();
  RunProgress progress() const;

 private:
  /// Updates `state_` if the process has ended.
  /// \param wait_options  options of waitpid: WNOHANG, or 0 to wait for the end of the process.
  void update_state(int wait_options);

  std::vector<std::string> arguments_;
  std::filesystem::path log_;  ///< file with the output of the newest run
  std::mutex mutex_;
  State state_ = State::kIdle;
  bool was_stopped_ = false;  ///< whether `stop` was called during the newest run
  pid_t process_ = 0;         ///< process id of the newest run
};

/// Returns the name of a state: "idle", "running", "done", "failed" or "stopped".
std::string_view name_of(GenerateRun::State state);

}  // namespace crowdface
