// SPDX-License-Identifier: Apache-2.0
// A plan that stands in the folder, for shards that need not cast the crowd again.
#pragma once

#include <optional>
#include <vector>

#include "crowdface/crowd/ledger.h"
#include "crowdface/crowd/shard.h"
#include "crowdface/run/pipeline.h"

namespace crowdface {

/// Says in the folder that its plan is whole, and which job's it is. To be written last.
void mark_planned(const Job& job, const CrowdDirectory& directory);

/// A shard's part of the folder's plan.
struct PlannedFaces {
  std::vector<CastFace> faces;           ///< the shard's, in the plan's order
  std::vector<LedgerEntry::File> files;  ///< the plan and those written with it
};

/// \return nothing if the plan is not there, not as `mark_planned` found it, or another job's.
/// \throws InvalidInput if a line is none of ours.
std::optional<PlannedFaces> planned_faces(const Job& job, const CrowdDirectory& directory,
                                          const Shard& shard);

}  // namespace crowdface
