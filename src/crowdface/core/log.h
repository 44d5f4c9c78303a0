// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace crowdface {

/// Which log lines standard error receives: kQuiet: warnings and errors; kNormal: also the lines of
/// log_info; kVerbose: also the lines of log_debug.
enum class LogLevel { kQuiet, kNormal, kVerbose };

/// Sets the level of the log lines that standard error receives. Log files always receive all
/// lines.
void set_log_level(LogLevel level);
/// The level that was set last; at first kNormal.
LogLevel log_level();
/// Opens one more log file. All later lines are appended to this file and to the earlier log files.
/// \throws CannotCreate.
void add_log_file(const std::filesystem::path& path);
/// Stops writing to the log file added last.
void close_log_file() noexcept;
/// Flushes the log files. Returns the message of the first failed write to a log file; the message
/// names this file. Returns nothing if all lines were written. Logging itself never throws, so that
/// work continues; the caller checks for an error at the end.
std::optional<std::string> first_log_file_error();

/// Keeps the last 1000 log lines while the object lives, for a log file that is opened later.
class LogBuffer {
 public:
  LogBuffer();
  ~LogBuffer();
  LogBuffer(const LogBuffer&) = delete;
  LogBuffer& operator=(const LogBuffer&) = delete;
  /// Writes the kept lines to the log file added last.
  void replay() const;

 private:
  struct Lines;
  std::unique_ptr<Lines> lines_;  ///< the last 1000 log lines
};

/// Log one or more lines, with unprintable characters escaped (see `printable`).
void log_debug(std::string_view text);
void log_info(std::string_view text);
void log_warning(std::string_view text);
void log_error(std::string_view text);

}  // namespace crowdface
