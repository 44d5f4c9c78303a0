// SPDX-License-Identifier: Apache-2.0
// The steps by which a run continues the work of an earlier, stopped run.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <vector>

#include "crowdface/run/face_ledger.h"

namespace crowdface {

/// The finished and the missing faces of a crowd.
struct FaceProgress {
  /// one per face of the crowd; a missing face has a default value
  std::vector<FaceResult> faces;
  std::vector<std::size_t> missing_faces;  ///< indices of this shard's missing faces, ascending
  std::size_t shard_face_count = 0;        ///< number of faces of this shard
};

/// Finds the faces of a shard that the ledger records and whose files are unchanged. Reads every
/// file once, in parallel. \throws Interrupted.
/// \param on_checked_face  called from any thread after each face of the shard; may be empty
FaceProgress find_done_faces(const FaceLedger& ledger, const std::vector<FacePlan>& crowd,
                             const Shard& shard, const std::function<void()>& on_checked_face = {});

/// Checks that no face is missing. \throws MissingInput that names the first few missing faces.
void require_all_faces(const CrowdDirectory& directory, const std::vector<FacePlan>& crowd,
                       const std::vector<std::size_t>& missing_faces);

/// Writes the files that all faces share, if a format needs such files and they do not exist yet.
void write_shared_files(const Config& config, const Inputs& inputs, const CrowdDirectory& directory,
                        Ledger& ledger);

/// Returns the ledgers in the folder that may record faces of this shard. Omits the ledgers of the
/// other shards of the same split, because these shards make other faces. For example, shard 3/7
/// does not need the ledger of shard 2/7, but may need the ledger of shard 2/5.
std::vector<std::filesystem::path> relevant_ledgers(const CrowdDirectory& directory,
                                                    const Shard& shard);

/// Removes the files that shards write for other shards and for `crowdface status`. Call this only
/// when the crowd is complete.
void remove_shard_files(const CrowdDirectory& directory);

/// Appends the logs of the shards to the crowd's log.
void gather_logs(const CrowdDirectory& directory);

}  // namespace crowdface
