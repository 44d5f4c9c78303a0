// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/cast/cast_face.h"
#include "crowdface/cast/plan_names.h"
#include "crowdface/core/hash.h"
#include "crowdface/core/text_pieces.h"

namespace crowdface {

/// One line of plan.jsonl, without line end (docs/crowd-directory.md has the fields). Numbers have
/// full precision, distances four decimals.
std::string format_recipe(const CastFace& face, const PlanNames& names, const Digest& settings);

/// A face as read, with the hash of the settings it was cast under.
struct PlanLine {
  CastFace face;
  std::string settings;
};

/// Reads one line. \param place  "file:line", for messages.
/// \throws InvalidInput naming the place, the field, what was expected and what was found.
PlanLine parse_recipe(std::string_view line, const PlanNames& names, const std::string& place);

/// All lines of a plan file.
std::vector<PlanLine> read_plan(const std::filesystem::path& path, const PlanNames& names);

/// The lines of a plan. All must outlive the text.
TextPieces plan_text(const std::vector<CastFace>& crowd, const PlanNames& names,
                     const Digest& settings);

}  // namespace crowdface
