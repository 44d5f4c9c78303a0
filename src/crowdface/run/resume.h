// SPDX-License-Identifier: Apache-2.0
// What a run does so that it can go on where another stopped.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <vector>

#include "crowdface/run/face_ledger.h"

namespace crowdface {

/// The crowd's faces as far as they are done, and which are not.
struct FacesSoFar {
  std::vector<FaceResult> faces;  ///< #crowd; of a face that is missing: nothing
  std::vector<std::size_t> todo;  ///< of this shard, ascending
  std::size_t owned = 0;          ///< by this shard
};

/// Asks the ledger, in parallel: every file is read once. \throws Interrupted.
/// \param asked  called after each face of the shard, by any thread; may be empty
FacesSoFar find_done_faces(const FaceLedger& ledger, const std::vector<CastFace>& crowd,
                           const Shard& shard, const std::function<void()>& asked = {});

/// \throws MissingInput if there are faces to do, naming the first few.
void refuse_missing_faces(const CrowdDirectory& directory, const std::vector<CastFace>& crowd,
                          const std::vector<std::size_t>& todo);

/// Writes the files that all faces share, if a format needs some and they are not there.
void write_shared_files(const Config& config, const Inputs& inputs, const CrowdDirectory& directory,
                        Ledger& ledger);

/// Of the folder's ledgers those that may hold what a shard looks for: none of another shard that shares
/// the crowd with it, whose faces are others.
std::vector<std::filesystem::path> ledgers_that_matter(const CrowdDirectory& directory,
                                                       const Shard& shard);

/// What shards left for each other and for those who watch them, once the crowd is whole.
void remove_notes_of_shards(const CrowdDirectory& directory);

/// What the shards said becomes part of the crowd's log.
void gather_logs(const CrowdDirectory& directory);

}  // namespace crowdface
