// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/cast/face_plan.h"
#include "crowdface/cast/plan_names.h"
#include "crowdface/core/hash.h"
#include "crowdface/core/text_pieces.h"

namespace crowdface {

/// One line of plan.jsonl without a line end (docs/crowd-directory.md lists the fields). Distances
/// have four decimals; all other numbers have full precision.
std::string format_plan_line(const FacePlan& face, const PlanNames& names, const Digest& settings);

/// A face read from a plan, and the hash of the settings under which it was cast.
struct PlanLine {
  FacePlan face;
  std::string settings_hash;  ///< the hash as in the file: the output of Digest::hex
};

/// Reads one line.
/// \param place  "file:line", for messages.
/// \throws InvalidInput with the place, the name of the field, the expected value and the actual
/// value.
PlanLine parse_plan_line(std::string_view line, const PlanNames& names, const std::string& place);

/// Reads all lines of a plan file.
std::vector<PlanLine> read_plan(const std::filesystem::path& path, const PlanNames& names);

/// The text of a plan. All arguments must outlive the text.
TextPieces plan_text(const std::vector<FacePlan>& crowd, const PlanNames& names,
                     const Digest& settings);

}  // namespace crowdface
