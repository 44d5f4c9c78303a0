// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/run/face_builder.h"
#include "crowdface/run/job.h"
#include "crowdface/validity/protruding_parts_check.h"

namespace crowdface {

/// Finds visible faults in the whole mesh of a face, with the checks of `generate`. Thread-safe.
class MeshFaults {
 public:
  /// \param job, builder  must outlive this object.
  MeshFaults(const Job& job, const FaceBuilder& builder) : job_(job), builder_(builder) {}

  /// One sentence for each visible fault of the mesh: gums, teeth or other parts that protrude
  /// through the skin, and violated limits of the config's section `believability`. Returns nothing
  /// if the config turns these checks off or if the meshes are too large for these checks. Takes
  /// some tenths of a second.
  /// \param face  built from this recipe, #V by 3.
  std::vector<std::string> faults_of(const Recipe& recipe, const Positions& face) const;

 private:
  /// The faults that a target head itself has. Faces built on this head may have the same faults.
  struct TargetFaults {
    SkinCheck skin_check;  ///< compares the skin of faces with the head's skin
    /// area of teeth and other parts that protrude through the head's skin
    double exposed_parts_mm2;
  };
  /// Returns the faults of a head; computed in the first call for this head.
  std::shared_ptr<const TargetFaults> target_faults(Index head) const;

  const Job& job_;
  const FaceBuilder& builder_;
  mutable std::mutex mutex_;
  mutable std::optional<const ProtrudingPartsCheck> protruding_parts_check_;
  /// maps the index of a head to the head's faults
  mutable std::map<Index, std::shared_ptr<const TargetFaults>> target_faults_;
};

}  // namespace crowdface
