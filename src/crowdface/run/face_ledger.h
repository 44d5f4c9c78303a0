// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "crowdface/crowd/ledger.h"
#include "crowdface/run/face_files.h"
#include "crowdface/run/job.h"

namespace crowdface {

/// A face whose files are written, and the results for this face.
struct MadeFace {
  const FacePlan* face = nullptr;
  FaceResult result;
};

/// Records the finished faces of a crowd in the crowd's ledger. The entry of a face contains the
/// list of the face's files and the measurements of its skin and shapes. A resumed run therefore
/// writes the same sheets and the same report.
class FaceLedger {
 public:
  /// All referenced objects must outlive this object.
  /// \param recorded  called from any thread after each recorded face
  FaceLedger(Ledger& ledger, const Job& job, const FaceFileLists& lists,
             std::function<void()> recorded);

  /// Returns the recorded results of a face; nothing unless all of its files exist and are
  /// unchanged.
  std::optional<FaceResult> recorded_result(const FacePlan& face) const;
  /// Records faces whose files have all been written.
  void record(std::span<const MadeFace> faces) const;

 private:
  /// The face's ledger entry: its key, its file names, and the hashes in `result`, if any.
  LedgerEntry entry_of(const FacePlan& face, const FaceResult& result) const;

  Ledger& ledger_;
  const Job& job_;
  const FaceFileLists& lists_;  ///< lists the files of each face
  std::function<void()> recorded_;
  bool judges_skin_;         ///< whether each face's skin is checked for defects
  std::size_t shape_count_;  ///< number of shapes transferred to each face
  Digest common_digest_;     ///< hash of everything that the files of all faces depend on
};

}  // namespace crowdface
