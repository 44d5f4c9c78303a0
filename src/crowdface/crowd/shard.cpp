// SPDX-License-Identifier: Apache-2.0
#include "crowdface/crowd/shard.h"

#include <algorithm>
#include <array>
#include <utility>

#include <nlohmann/json.hpp>

#include "crowdface/core/folder.h"
#include "crowdface/core/rounded.h"
#include "crowdface/core/text.h"
#include "crowdface/io/shallow_json.h"

namespace crowdface {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

/// Names of the states, in the order of ShardState.
constexpr std::array<std::string_view, 5> kStateNames = {"waiting", "working", "done",
                                                         "interrupted", "failed"};

}  // namespace

std::string Shard::name() const {
  return concat(index, "of", count);
}

std::optional<Shard> parse_shard(std::string_view text) {
  constexpr std::uint64_t kMax = 9999;
  const std::size_t slash = text.find('/');
  if (slash == text.npos) return std::nullopt;
  const auto index = parse_unsigned(text.substr(0, slash));
  const auto count = parse_unsigned(text.substr(slash + 1));
  if (!index || !count || *index < 1 || *index > *count || *count > kMax) return std::nullopt;
  return Shard{*index, *count};
}

std::optional<Shard> parse_shard_name(std::string name) {
  const std::size_t of = name.find("of");
  return of == name.npos ? std::nullopt : parse_shard(name.replace(of, 2, "/"));
}

fs::path shard_path(const fs::path& path, const Shard& shard) {
  if (shard.is_whole_crowd()) return path;
  fs::path result = path;
  return result.replace_filename(
      concat(path.stem().string(), '-', shard.name(), path.extension().string()));
}

std::vector<fs::path> existing_shard_paths(const fs::path& path) {
  const std::string start = path.stem().string() + "-";
  return list_files(path.parent_path(), [&](const fs::path& file) {
    const std::string stem = file.stem().string();
    return file.extension() == path.extension() && stem.starts_with(start) &&
           parse_shard_name(stem.substr(start.size()));
  });
}

std::string_view name_of(ShardState state) {
  return kStateNames[static_cast<std::size_t>(state)];
}

std::string format_shard_notes(const ShardNotes& notes) {
  const Json json = {{"state", name_of(notes.state)},
                     {"faces", notes.face_count},
                     {"done", notes.finished_face_count},
                     {"made", notes.made_face_count},
                     {"seconds", rounded(notes.seconds)},
                     {"machine", notes.machine},
                     {"reason", notes.reason}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::optional<ShardNotes> parse_shard_notes(std::string_view text) {
  const Json json = parse_shallow_json(text);
  if (!json.is_object()) return std::nullopt;
  try {
    ShardNotes notes;
    const auto state = std::ranges::find(kStateNames, json.at("state").get<std::string>());
    if (state == kStateNames.end()) return std::nullopt;
    notes.state = static_cast<ShardState>(state - kStateNames.begin());
    for (const auto& [key, number] :
         {std::pair("faces", &notes.face_count), std::pair("done", &notes.finished_face_count),
          std::pair("made", &notes.made_face_count)}) {
      if (!json.at(key).is_number_unsigned()) return std::nullopt;
      *number = json.at(key).get<std::uint64_t>();
    }
    notes.seconds = json.at("seconds").get<double>();
    notes.machine = json.at("machine").get<std::string>();
    notes.reason = json.at("reason").get<std::string>();
    return notes;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

}  // namespace crowdface
