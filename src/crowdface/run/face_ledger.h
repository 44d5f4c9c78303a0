// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "crowdface/crowd/ledger.h"
#include "crowdface/run/face_files.h"
#include "crowdface/run/pipeline.h"

namespace crowdface {

/// A face and what its files are.
struct MadeFace {
  const CastFace* face = nullptr;
  FaceResult result;
};

/// The faces of a crowd in its ledger. A face is one item: the files of its list, and what was found about its skin
/// and shapes, so that a run that goes on writes the same sheets and the same report.
class FaceLedger {
 public:
  /// All must outlive this object. \param recorded  called after each face that is, by any thread.
  FaceLedger(Ledger& ledger, const Job& job, const FaceFileLists& lists,
             std::function<void()> recorded);

  /// What is known of a face if all of its files are there as an earlier run wrote them.
  std::optional<FaceResult> done(const CastFace& face) const;
  /// Once all files of these faces are there.
  void record(std::span<const MadeFace> faces) const;

 private:
  LedgerEntry entry_of(const CastFace& face, const FaceResult& result) const;

  Ledger& ledger_;
  const Job& job_;
  const FaceFileLists& lists_;
  std::function<void()> recorded_;
  bool judges_skin_;
  std::size_t shapes_;  ///< how many are carried to each face
  Digest common_;       ///< of what the files of all faces depend on
};

}  // namespace crowdface
