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
#include "crowdface/run/pipeline.h"

namespace crowdface {

/// Writes a file of the crowd's folder. \return the hash of its bytes.
using WriteFile = std::function<FileDigest(const std::filesystem::path& path, const TextPieces&)>;

/// The tags of heads and the kinds of attachments, for the table crowd.csv.
HeadTagsAndAttachmentKinds head_tags_and_attachment_kinds(const Config& config);

/// Writes the plan of a cast crowd, the table, and the other files that casting produces. Then
/// writes a marker file, which shows that the plan is complete and to which job the plan belongs.
/// \param casting  content of casting.json
/// \param neck_colours  see table_text
void write_plan(const Job& job, const CrowdDirectory& directory, const CrowdPlan& crowd_plan,
                const nlohmann::ordered_json& casting,
                const std::vector<Eigen::Array3d>& neck_colours, const WriteFile& write);

/// The faces of a shard, or of the whole crowd, as read from the plan in the folder.
struct PlannedFaces {
  std::vector<FacePlan> faces;           ///< the shard's faces, in the plan's order
  std::vector<LedgerEntry::File> files;  ///< the plan and the files written with it
};

/// \return nothing if there is no plan, if the plan changed since `write_plan`, or if the plan
///         belongs to another job. For the whole crowd: also nothing if one of the other files from
///         `write_plan` changed.
/// \throws InvalidInput if a line is not a valid plan entry.
std::optional<PlannedFaces> read_planned_faces(const Job& job, const CrowdDirectory& directory,
                                               const Shard& shard);

/// The founders of families (hidden faces from which the members are made) that the folder records;
/// empty if the folder has no file of founders.
std::vector<FacePlan> read_founders(const Job& job, const CrowdDirectory& directory);

/// Restores the result of casting from a plan. The result has everything that later stages need. It
/// lacks the distances, rejections and family reports, which casting.json stores.
/// \param cache  see casting_space
CrowdPlan restore_crowd_plan(const Job& job, const CrowdDirectory& directory,
                             const Prepared& prepared, std::vector<FacePlan> crowd,
                             const std::filesystem::path& cache);

}  // namespace crowdface
