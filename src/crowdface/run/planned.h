// SPDX-License-Identifier: Apache-2.0
// The plan in a crowd's folder. One run writes the plan; shards and resumed runs read it.
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
#include "crowdface/run/job.h"

namespace crowdface {

/// Writes a file of the crowd's folder. \return the hash of its bytes.
using WriteFile = std::function<FileDigest(const std::filesystem::path& path, const TextPieces&)>;

/// The tags of heads and the kinds of attachments, for the table crowd.csv.
HeadTagsAndAttachmentKinds head_tags_and_attachment_kinds(const Config& config);

/// Writes the plan of a cast crowd, the table crowd.csv, the founders, the rejected faces and
/// casting.json. Then writes a marker file, which shows that the plan is complete. The marker file
/// contains a hash that identifies the job, and the names and hashes of the other files (except
/// crowd.csv).
/// \param casting  content of casting.json
/// \param neck_colours  see table_text
void write_plan(const Job& job, const CrowdDirectory& directory, const CrowdPlan& crowd_plan,
                const nlohmann::ordered_json& casting,
                const std::vector<Eigen::Array3d>& neck_colours, const WriteFile& write);

/// The faces of a shard, or of the whole crowd, as read from the plan in the folder.
struct PlannedFaces {
  std::vector<FacePlan> faces;           ///< the shard's faces, in the plan's order
  std::vector<LedgerEntry::File> files;  ///< the files that the marker file lists, see write_plan
};

/// Reads the faces of a shard from the plan.
/// \return nothing if there is no plan, if the plan changed since `write_plan`, or if the plan
///         belongs to another job. For the whole crowd, also nothing if any other file that the
///         marker file lists has changed.
/// \throws InvalidInput if a line is not a valid plan entry.
std::optional<PlannedFaces> read_planned_faces(const Job& job, const CrowdDirectory& directory,
                                               const Shard& shard);

/// Reads the founders of families from the crowd's folder. A founder is a hidden face from which
/// the members of a family are derived. Returns an empty list if the folder has no file of
/// founders.
std::vector<FacePlan> read_founders(const Job& job, const CrowdDirectory& directory);

/// Restores the result of casting from a plan, as far as later stages need it. The result lacks the
/// distances, the rejections, and the reports on families and measurements, which casting.json
/// stores.
/// \param cache  see casting_space
CrowdPlan restore_crowd_plan(const Job& job, const CrowdDirectory& directory,
                             const PreparedHeads& prepared, std::vector<FacePlan> crowd,
                             const std::filesystem::path& cache);

}  // namespace crowdface
