// SPDX-License-Identifier: Apache-2.0
// The plan in a crowd's folder: written once, then taken by shards and by whoever goes on.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <nlohmann/json.hpp>

#include "crowdface/core/text_pieces.h"
#include "crowdface/crowd/ledger.h"
#include "crowdface/crowd/shard.h"
#include "crowdface/run/casting.h"
#include "crowdface/run/pipeline.h"

namespace crowdface {

/// Writes a file of the crowd's folder. \return its bytes' digest.
using WriteFile = std::function<FileDigest(const std::filesystem::path& path, const TextPieces&)>;

/// Writes the plan, the table and what else is known once a crowd is cast; at last a file that says that the plan is
/// whole, and which job's it is.
/// \param casting  what stands in casting.json
void write_plan(const Job& job, const CrowdDirectory& directory, const Cast& cast,
                const nlohmann::ordered_json& casting, const WriteFile& write);

/// A shard's part of the folder's plan, or the whole of it.
struct PlannedFaces {
  std::vector<CastFace> faces;           ///< the shard's, in the plan's order
  std::vector<LedgerEntry::File> files;  ///< the plan and those written with it
};

/// \return nothing if the plan is not there, not as `write_plan` left it, or another job's; for the
/// whole crowd also if one of the other files is not as it was.
/// \throws InvalidInput if a line is none of ours.
std::optional<PlannedFaces> planned_faces(const Job& job, const CrowdDirectory& directory,
                                          const Shard& shard);

/// The founders of families that stand in the folder; none if it has no such file.
std::vector<CastFace> read_founders(const Job& job, const CrowdDirectory& directory);

/// What `cast` says of a crowd, as far as it is needed once its plan is written: nothing of distances,
/// rejections and how families came out, which casting.json tells.
/// \param cache  as of casting_space.
Cast cast_as_planned(const Job& job, const CrowdDirectory& directory, const Prepared& prepared,
                     std::vector<CastFace> crowd, const std::filesystem::path& cache);

}  // namespace crowdface
