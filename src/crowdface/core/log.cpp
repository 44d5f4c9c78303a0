// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/log.h"

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/ringbuffer_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

struct Sinks {
  std::shared_ptr<spdlog::sinks::stderr_color_sink_mt> terminal =
      std::make_shared<spdlog::sinks::stderr_color_sink_mt>();
  std::vector<std::shared_ptr<spdlog::sinks::basic_file_sink_mt>> files;
  LogLevel level = LogLevel::kNormal;
  std::shared_ptr<spdlog::logger> logger = std::make_shared<spdlog::logger>("crowdface", terminal);
  std::mutex failure_mutex;
  std::optional<std::string> failure;

  Sinks() {
    terminal->set_pattern("%^%l:%$ %v");
    terminal->set_level(spdlog::level::info);
    logger->set_level(spdlog::level::debug);
    logger->flush_on(spdlog::level::info);
    logger->set_error_handler([this](const std::string& what) { note_failure(what); });
  }

  void note_failure(const std::string& what) {
    const std::lock_guard<std::mutex> lock(failure_mutex);
    if (!failure) failure = what;
  }

  /// Runs `work`, which calls a log sink directly. If `work` throws, passes the message to
  /// note_failure. (Calls to the logger do not throw: the logger passes its errors to its error
  /// handler.)
  template <class Work>
  void guarded(const Work& work) {
    try {
      work();
    } catch (const spdlog::spdlog_ex& error) {
      note_failure(error.what());
    }
  }
};

Sinks& sinks() {
  static Sinks instance;
  return instance;
}

void log(spdlog::level::level_enum level, std::string_view text) {
  const std::string line = printable(text);
  sinks().logger->log(level, spdlog::string_view_t(line.data(), line.size()));
}

}  // namespace

void set_log_level(LogLevel level) {
  sinks().level = level;
  sinks().terminal->set_level(level == LogLevel::kQuiet     ? spdlog::level::warn
                              : level == LogLevel::kVerbose ? spdlog::level::debug
                                                            : spdlog::level::info);
}

LogLevel log_level() {
  return sinks().level;
}

void add_log_file(const std::filesystem::path& path) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    throw CannotCreate(concat(path.string(), ": log file: expected a regular file, or none yet"));
  }
  std::shared_ptr<spdlog::sinks::basic_file_sink_mt> file;
  try {
    file = std::make_shared<spdlog::sinks::basic_file_sink_mt>(path.string());
  } catch (const spdlog::spdlog_ex& error) {
    throw CannotCreate(concat(path.string(), ": log file cannot be opened: ", error.what()));
  }
  file->set_pattern("%Y-%m-%dT%H:%M:%S.%e%z %l %v");
  file->set_level(spdlog::level::debug);
  sinks().logger->sinks().push_back(file);
  sinks().files.push_back(std::move(file));
}

void close_log_file() noexcept {
  if (sinks().files.empty()) return;
  sinks().guarded([] { sinks().files.back()->flush(); });
  std::erase(sinks().logger->sinks(), sinks().files.back());
  sinks().files.pop_back();
}

std::optional<std::string> first_log_file_error() {
  sinks().logger->flush();
  const std::lock_guard<std::mutex> lock(sinks().failure_mutex);
  return sinks().failure;
}

struct LogBuffer::Lines {
  static constexpr std::size_t kMax = 1000;
  std::shared_ptr<spdlog::sinks::ringbuffer_sink_mt> sink =
      std::make_shared<spdlog::sinks::ringbuffer_sink_mt>(kMax);
};

LogBuffer::LogBuffer() : lines_(std::make_unique<Lines>()) {
  lines_->sink->set_level(spdlog::level::debug);
  sinks().logger->sinks().push_back(lines_->sink);
}

LogBuffer::~LogBuffer() {
  std::erase(sinks().logger->sinks(), lines_->sink);
}

void LogBuffer::replay() const {
  if (sinks().files.empty()) return;
  sinks().guarded([&] {
    for (const auto& line : lines_->sink->last_raw()) sinks().files.back()->log(line);
    sinks().files.back()->flush();
  });
}

void log_debug(std::string_view text) {
  log(spdlog::level::debug, text);
}
void log_info(std::string_view text) {
  log(spdlog::level::info, text);
}
void log_warning(std::string_view text) {
  log(spdlog::level::warn, text);
}
void log_error(std::string_view text) {
  log(spdlog::level::err, text);
}

}  // namespace crowdface
