// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/crowd/ledger.h"
#include "crowdface/run/face_files.h"
#include "crowdface/run/pipeline.h"

namespace crowdface {

/// What belongs to a face beside its meshes.
struct FaceExtras {
  bool picture = false;    ///< its render
  bool preview = false;    ///< its mesh in the gallery
  bool skin = false;       ///< its mesh is judged
  std::size_t shapes = 0;  ///< how many are carried to it
};

/// A face and what its files are.
struct MadeFace {
  const CastFace* face = nullptr;
  FaceFiles files;
};

/// The faces of a crowd in its ledger. A face is one item: its meshes, its picture and what was
/// found about its skin, so that a run that goes on writes the same sheets and the same report.
class FaceLedger {
 public:
  /// All must outlive this object. \param recorded  called after each face that is, by any thread.
  FaceLedger(Ledger& ledger, const Job& job, const CrowdDirectory& directory,
             std::function<void()> recorded);

  /// A face's files if all of them are there as an earlier run wrote them.
  std::optional<FaceFiles> done(const CastFace& face) const;
  /// Once all files of these faces are there.
  void record(std::span<const MadeFace> faces) const;

 private:
  Digest key_of(const CastFace& face) const;
  LedgerEntry entry_of(const CastFace& face, const FaceFiles& files) const;

  Ledger& ledger_;
  const Job& job_;
  const CrowdDirectory& directory_;
  FaceExtras extras_;
  std::function<void()> recorded_;
  Digest output_;  ///< of what the config says about files and pictures
};

}  // namespace crowdface
