// SPDX-License-Identifier: Apache-2.0
#include "crowdface/crowd/shard_notes.h"

#include <array>
#include <utility>

#include <nlohmann/json.hpp>

#include "crowdface/core/rounded.h"
#include "crowdface/io/shallow_json.h"

namespace crowdface {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kStates = {ShardState::kWaiting, ShardState::kWorking, ShardState::kDone,
                                ShardState::kInterrupted, ShardState::kFailed};

}  // namespace

std::string_view name_of(ShardState state) {
  switch (state) {
    case ShardState::kWaiting:
      return "waiting";
    case ShardState::kWorking:
      return "working";
    case ShardState::kDone:
      return "done";
    case ShardState::kInterrupted:
      return "interrupted";
    case ShardState::kFailed:
      return "failed";
  }
  return "";
}

std::string format_shard_notes(const ShardNotes& notes) {
  const Json json = {{"state", name_of(notes.state)},
                     {"faces", notes.faces},
                     {"done", notes.done},
                     {"made", notes.made},
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
    const auto word = json.at("state").get<std::string>();
    bool known = false;
    for (const ShardState state : kStates) {
      if (name_of(state) != word) continue;
      notes.state = state;
      known = true;
    }
    if (!known) return std::nullopt;
    for (const auto& [key, number] :
         {std::pair("faces", &notes.faces), std::pair("done", &notes.done),
          std::pair("made", &notes.made)}) {
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
