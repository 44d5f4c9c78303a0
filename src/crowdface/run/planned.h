// SPDX-License-Identifier: Apache-2.0
// The plan in a crowd's folder: written once, then read by shards and by resumed runs.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <nlohmann/json.hpp>

#include "crowdface/core/text_pieces.h"
#include "crowdface/crowd/crowd_table.h"
#include "crowdface/crowd/ledger.h"
#include "crowdface/crowd/shard.h"
#include "crowdface/run/casting.h"
#include "crowdface/run/pipeline.h"

namespace crowdface {

/// Writes a file of the crowd's folder. \return the hash of its bytes.
using WriteFile = std::function<FileDigest(const std::filesystem::path& path, const TextPieces&)>;

/// The tags of heads and kinds of attachments, for the table.
TableFacts table_facts(const Config& config);

/// Writes the plan of a cast crowd, the table, and the files that go with them; then a marker file,
/// which shows that the plan is complete and to which job it belongs.
/// \param casting  content of casting.json
/// \param neck_colours  see table_text
void write_plan(const Job& job, const CrowdDirectory& directory, const CrowdPlan& crowd_plan,
                const nlohmann::ordered_json& casting,
                const std::vector<Eigen::Array3d>& neck_colours, const WriteFile& write);

/// A shard's part of the folder's plan, or the whole plan.
struct PlannedFaces {
  std::vector<FacePlan> faces;           ///< the shard's faces, in the plan's order
  std::vector<LedgerEntry::File> files;  ///< the plan and the files written with it
};

/// \return nothing if there is no plan, if it changed since `write_plan`, or if it belongs to
///         another job; for the whole crowd also if one of the other files changed.
/// \throws InvalidInput if a line is not a valid plan entry.
std::optional<PlannedFaces> read_planned_faces(const Job& job, const CrowdDirectory& directory,
                                               const Shard& shard);

/// The founders of families recorded in the folder; empty if it has no such file.
std::vector<FacePlan> read_founders(const Job& job, const CrowdDirectory& directory);

/// Restores the result of casting from a plan. The result has everything that later stages need,
/// but not the distances, rejections and family reports, which are stored in casting.json.
/// \param cache  see casting_space
CrowdPlan restore_crowd_plan(const Job& job, const CrowdDirectory& directory,
                             const Prepared& prepared, std::vector<FacePlan> crowd,
                             const std::filesystem::path& cache);

}  // namespace crowdface
