// SPDX-License-Identifier: Apache-2.0
// The steps with which a run continues after an earlier run was stopped.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <vector>

#include "crowdface/run/face_ledger.h"

namespace crowdface {

/// The finished and the missing faces of a crowd.
struct FaceProgress {
  std::vector<FaceResult> faces;           ///< #crowd; default value for missing faces
  std::vector<std::size_t> missing_faces;  ///< this shard's missing faces, ascending
  std::size_t shard_face_count = 0;        ///< number of faces of this shard
};

/// Looks up the faces in the ledger, in parallel; reads every file once. \throws Interrupted.
/// \param checked  called from any thread after each face of the shard; may be empty
FaceProgress find_done_faces(const FaceLedger& ledger, const std::vector<FacePlan>& crowd,
                             const Shard& shard, const std::function<void()>& checked = {});

/// \throws MissingInput that names the first few missing faces, if there are any.
void refuse_missing_faces(const CrowdDirectory& directory, const std::vector<FacePlan>& crowd,
                          const std::vector<std::size_t>& missing_faces);

/// Writes the files that all faces share, if a format needs such files and they do not exist yet.
void write_shared_files(const Config& config, const Inputs& inputs, const CrowdDirectory& directory,
                        Ledger& ledger);

/// The folder's ledgers that may record faces of this shard. Excludes the ledgers of other shards
/// if the crowd was split into the same number of shards, because their faces are different.
std::vector<std::filesystem::path> relevant_ledgers(const CrowdDirectory& directory,
                                                    const Shard& shard);

/// Removes the files that shards leave for each other and for `crowdface status`, once the crowd is
/// complete.
void remove_shard_files(const CrowdDirectory& directory);

/// Appends the logs of the shards to the crowd's log.
void gather_logs(const CrowdDirectory& directory);

}  // namespace crowdface
