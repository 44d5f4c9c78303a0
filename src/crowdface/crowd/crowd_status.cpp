// SPDX-License-Identifier: Apache-2.0
#include "crowdface/crowd/crowd_status.h"

#include <algorithm>
#include <chrono>
#include <system_error>
#include <unordered_set>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/folder.h"
#include "crowdface/core/text.h"
#include "crowdface/core/text_pieces.h"
#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/io/shallow_json.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// Returns the content of a file. If another process has just removed the file, returns an empty
/// text.
std::string text_of(const fs::path& path) {
  try {
    return read_file(path);
  } catch (const MissingInput&) {
    return {};
  }
}

/// If the line begins with `start`: the text between `start` and the next quotation mark. Otherwise
/// empty.
std::string_view quoted_after(std::string_view line, std::string_view start) {
  if (!line.starts_with(start)) return {};
  line.remove_prefix(start.size());
  return line.substr(0, line.find('"'));
}

/// Calls `use` with each complete line of a file. Other processes may replace or remove the file
/// meanwhile.
template <class Use>
void for_each_line_of(const fs::path& path, const Use& use) {
  try {
    read_lines(path, [&](std::string_view line, bool ended) {
      if (ended) use(line);
    });
  } catch (const MissingInput&) {
    return;
  }
}

/// Ids of faces that have a line in any ledger. Does not check whether the files still match these
/// lines; runs that continue the crowd or gather its shards check the files.
std::unordered_set<std::string> faces_in_ledgers(const CrowdDirectory& directory) {
  std::unordered_set<std::string> ids;
  for (const fs::path& path : directory.ledgers()) {
    for_each_line_of(path, [&](std::string_view line) {
      const std::string_view id = quoted_after(line, R"({"item":"faces/)");
      if (!id.empty()) ids.emplace(id);
    });
  }
  return ids;
}

/// Returns the number of shards. The number comes from the last submission to a farm or, without a
/// submission, from the file names of shards. Returns 1 if there are no shards.
std::uint64_t shard_count(const CrowdDirectory& directory) {
  const auto job = parse_shallow_json(text_of(directory.cluster_task_folder() / "job.json"));
  if (job.is_object() && job.contains("shards") && job["shards"].is_number_unsigned()) {
    const auto shards = job["shards"].get<std::uint64_t>();
    if (parse_shard(concat("1/", shards))) return shards;
  }
  std::uint64_t count = 1;
  for (const auto& files : {directory.shard_ledgers(), directory.progress_files()}) {
    for (const fs::path& file : files) {
      const std::string stem = file.stem().string();
      count = std::max(count, parse_shard_name(stem.substr(stem.find('-') + 1))->count);
    }
  }
  return count;
}

/// Seconds since the latest write to any of the files.
std::optional<double> seconds_since(const std::vector<fs::path>& files) {
  std::optional<double> least;
  for (const fs::path& file : files) {
    std::error_code error;
    const auto written = fs::last_write_time(file, error);
    if (error) continue;
    const std::chrono::duration<double> since = fs::file_time_type::clock::now() - written;
    least = std::max(0.0, std::min(least.value_or(since.count()), since.count()));
  }
  return least;
}

void add_notes(const CrowdDirectory& directory, ShardStatus& status) {
  const fs::path file = directory.progress(status.shard);
  const auto notes = parse_shard_notes(text_of(file));
  if (!notes) return;
  status.state = notes->state;
  status.machine = notes->machine;
  status.reason = notes->reason;
  if (notes->made_face_count > 0 && notes->seconds > 0) {
    status.faces_a_second = static_cast<double>(notes->made_face_count) / notes->seconds;
  }
}

/// Adds the error in the task's log to the status, because a task that died may have written no
/// notes to the crowd's folder.
void add_task_end(const CrowdDirectory& directory, ShardStatus& status) {
  const TaskEnd end = parse_task_end(text_of(directory.cluster_task_folder() / "log" /
                                             concat("blend-", status.shard.index, ".log")));
  if (!end.exit_code || *end.exit_code == 0) return;
  constexpr auto kAgain = static_cast<std::uint64_t>(ExitCode::kInterrupted);
  status.state = *end.exit_code == kAgain ? ShardState::kInterrupted : ShardState::kFailed;
  status.is_requeued = end.is_requeued;
  if (!end.reason.empty() || status.reason.empty()) {
    status.reason = end.reason.empty() ? concat("ended with code ", *end.exit_code) : end.reason;
  }
}

ShardStatus status_of(const CrowdDirectory& directory, const Shard& shard) {
  ShardStatus status;
  status.shard = shard;
  add_notes(directory, status);
  add_task_end(directory, status);
  return status;
}

/// Sets the state kDone if all faces of the shard are finished. For a working shard, computes the
/// time since the last write and the remaining time. Requires the face counts of `status`.
void set_final_state(const CrowdDirectory& directory, ShardStatus& status) {
  if (status.face_count > 0 && status.finished_face_count == status.face_count) {
    status.state = ShardState::kDone;
    status.reason.clear();
    status.is_requeued = false;
  }
  if (status.state != ShardState::kWorking) return;
  status.seconds_since_write =
      seconds_since({directory.progress(status.shard), directory.ledger(status.shard)});
  if (status.faces_a_second) {
    status.seconds_left = static_cast<double>(status.face_count - status.finished_face_count) /
                          *status.faces_a_second;
  }
}

void add_failures(const CrowdDirectory& directory, CrowdStatus& status) {
  const auto is_log = [](const fs::path& path) {
    return path.extension() == ".log" && !path.filename().string().starts_with("blend-");
  };
  for (const fs::path& log : list_files(directory.cluster_task_folder() / "log", is_log)) {
    const TaskEnd end = parse_task_end(text_of(log));
    if (!end.exit_code || *end.exit_code == 0 || end.is_requeued) continue;
    status.failures.push_back(concat(log.stem().string(), ": ended with code ", *end.exit_code,
                                     end.reason.empty() ? "" : ": ", end.reason));
  }
}

}  // namespace

TaskEnd parse_task_end(std::string_view log) {
  TaskEnd end;
  // Skip an incomplete last line, which is still being written.
  for (const std::string_view line : split_lines(log.substr(0, log.rfind('\n') + 1))) {
    if (line.starts_with("=== ended with code ")) {
      end.exit_code = parse_unsigned(line.substr(line.rfind(' ') + 1));
      end.is_requeued = false;
    } else if (line == "=== requeued") {
      end.is_requeued = true;
    } else if (line.starts_with("===")) {
      end = {};
    } else if (line.find("error: ") != line.npos) {
      end.reason = line.substr(line.find("error: ") + std::string_view("error: ").size());
    }
  }
  return end;
}

CrowdStatus crowd_status(const fs::path& crowd_directory) {
  const CrowdDirectory directory{crowd_directory};
  if (!path_exists(directory.cluster_task_folder())) require_crowd(directory);
  CrowdStatus status;
  status.is_planned = path_exists(directory.plan());
  status.is_report_written = path_exists(directory.report());
  const std::uint64_t shards = status.is_report_written ? 1 : shard_count(directory);
  for (std::uint64_t index = 1; shards > 1 && index <= shards; ++index) {
    status.shards.push_back(status_of(directory, {index, shards}));
  }
  const std::unordered_set<std::string> made = faces_in_ledgers(directory);
  for_each_line_of(directory.plan(), [&](std::string_view line) {
    const bool done = made.contains(std::string(quoted_after(line, R"({"id":")")));
    if (!status.shards.empty()) {
      ShardStatus& shard = status.shards[status.face_count % shards];
      ++shard.face_count;
      shard.finished_face_count += done ? 1U : 0U;
    }
    ++status.face_count;
    status.finished_face_count += done ? 1U : 0U;
  });
  for (ShardStatus& shard : status.shards) {
    set_final_state(directory, shard);
    if (shard.seconds_left) {
      status.faces_a_second = status.faces_a_second.value_or(0) + *shard.faces_a_second;
      status.seconds_left = std::max(status.seconds_left.value_or(0), *shard.seconds_left);
    }
  }
  if (!status.is_report_written) add_failures(directory, status);
  return status;
}

}  // namespace crowdface
