// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace crowdface {

enum class LogLevel { kQuiet, kNormal, kVerbose };

/// What reaches standard error; a log file always gets everything.
void set_log_level(LogLevel level);
LogLevel log_level();
/// Also writes everything to this file (appended), beside those added before. \throws CannotCreate.
void add_log_file(const std::filesystem::path& path);
/// Stops writing to the file that was added last.
void close_log_file() noexcept;
/// What has kept a log file from being written whole so far (its last lines are written first),
/// naming it; nothing if nothing has. Logging itself never throws: work goes on, and whoever started
/// it asks in the end.
std::optional<std::string> log_failure();

/// Remembers, for as long as it lives, the last thousand lines, for a log file that cannot be opened
/// yet.
class LogMemory {
 public:
  LogMemory();
  ~LogMemory();
  LogMemory(const LogMemory&) = delete;
  LogMemory& operator=(const LogMemory&) = delete;
  /// Writes what is remembered to the file that was added last.
  void replay() const;

 private:
  struct Lines;
  std::unique_ptr<Lines> lines_;
};

/// One line each, or several; what no terminal should be given is escaped (see printable).
void log_debug(std::string_view text);
void log_info(std::string_view text);
void log_warning(std::string_view text);
void log_error(std::string_view text);

}  // namespace crowdface
