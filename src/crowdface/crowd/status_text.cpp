// SPDX-License-Identifier: Apache-2.0
#include "crowdface/crowd/status_text.h"

#include <algorithm>
#include <array>

#include <nlohmann/json.hpp>

#include "crowdface/core/progress.h"
#include "crowdface/core/rounded.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

using Json = nlohmann::ordered_json;

/// A shard that has written nothing for longer than this time may have been killed.
constexpr double kSilentSeconds = 60;

std::string percent(std::uint64_t done, std::uint64_t faces) {
  return faces == 0 ? "" : concat(100 * done / faces, "%");
}

std::string pace(const std::optional<double>& faces_a_second) {
  return faces_a_second ? concat(format_fixed(*faces_a_second, 2), "/s") : "";
}

std::string duration(const std::optional<double>& seconds) {
  return seconds ? format_duration(*seconds) : "";
}

using StatusRow = std::array<std::string, 7>;

StatusRow row_of(const ShardStatus& shard) {
  std::string remark = shard.reason;
  if (shard.seconds_since_write.value_or(0) > kSilentSeconds) {
    remark = concat("nothing written for ", format_duration(*shard.seconds_since_write));
  }
  return {concat(shard.shard.index, "/", shard.shard.count),
          std::string(shard.state_name()),
          concat(shard.finished_face_count, "/", shard.face_count),
          pace(shard.faces_a_second),
          duration(shard.seconds_left),
          shard.machine,
          remark};
}

/// Pads each column to the width of its widest field.
std::string aligned(const std::vector<StatusRow>& rows) {
  std::array<std::size_t, std::tuple_size_v<StatusRow>> widths = {};
  for (const StatusRow& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
  }
  std::string text;
  for (const StatusRow& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) {
      line += row[c] + std::string(widths[c] - row[c].size() + 2, ' ');
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

Json rounded_or_null(const std::optional<double>& value) {
  return value ? Json(rounded(*value)) : Json();
}

}  // namespace

std::string format_status_table(const CrowdStatus& status) {
  std::string text = status.is_report_written ? "finished"
                     : status.is_planned      ? "planned, not finished"
                                              : "not planned yet";
  if (status.is_planned) {
    text += concat(": ", status.finished_face_count, " of ", status.face_count, " faces, ",
                   percent(status.finished_face_count, status.face_count));
  }
  if (status.seconds_left) {
    text += concat(", ", pace(status.faces_a_second), ", ", duration(status.seconds_left), " left");
  }
  text += "\n";
  for (const std::string& failure : status.failures) text += failure + "\n";
  if (status.shards.empty()) return text;
  std::vector<StatusRow> rows = {{"shard", "state", "faces", "pace", "left", "machine", ""}};
  for (const ShardStatus& shard : status.shards) rows.push_back(row_of(shard));
  return text + aligned(rows);
}

std::string format_status_json(const CrowdStatus& status) {
  Json json = {{"planned", status.is_planned},
               {"finished", status.is_report_written},
               {"faces", status.face_count},
               {"done", status.finished_face_count},
               {"faces_a_second", rounded_or_null(status.faces_a_second)},
               {"seconds_left", rounded_or_null(status.seconds_left)},
               {"failures", status.failures},
               {"shards", Json::array()}};
  for (const ShardStatus& shard : status.shards) {
    json["shards"].push_back({{"shard", shard.shard.index},
                              {"of", shard.shard.count},
                              {"state", shard.state_name()},
                              {"faces", shard.face_count},
                              {"done", shard.finished_face_count},
                              {"faces_a_second", rounded_or_null(shard.faces_a_second)},
                              {"seconds_left", rounded_or_null(shard.seconds_left)},
                              {"silent_seconds", rounded_or_null(shard.seconds_since_write)},
                              {"machine", shard.machine},
                              {"reason", shard.reason}});
  }
  // Write ASCII only, because `printable` later escapes some non-ASCII characters in a way that is
  // not valid JSON.
  return json.dump(-1, ' ', true, Json::error_handler_t::replace) + "\n";
}

}  // namespace crowdface
