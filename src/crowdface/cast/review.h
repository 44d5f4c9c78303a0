// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/cast/sampling.h"

namespace crowdface {

/// A reviewer's verdict on one face.
struct ReviewMark {
  enum class Verdict {
    kKeep,    ///< stays as it is
    kReject,  ///< redrawn, except for the locked parts
  };
  std::string id;
  Verdict verdict = Verdict::kKeep;
  /// Parts that do not change when the face is redrawn: region · #bands + band. Without bands, a
  /// part is a region.
  std::vector<std::size_t> locked;
  std::optional<std::string> note;
};

/// A change of one face. To add a key, add a member here, a row in config/changes_keys.cpp, and its
/// effect in cast/face_changes.cpp or, if it concerns attachments, in run/changed_faces.cpp.
struct FaceChange {
  enum class AgeStep { kOlder, kYounger };
  std::string id;
  std::optional<AgeStep> age_step;
  std::optional<double> age;              ///< −1 … 1, see apply_age; excludes `age_step`
  std::optional<std::string> variant_of;  ///< id of the face that this face becomes similar to
  double distance_mm = 1.5;               ///< distance from `variant_of`
  std::optional<std::string> group;       ///< the face is redrawn in this group
  /// Parts that stay while the other parts are redrawn, as in ReviewMark.
  std::vector<std::size_t> locked;
  TraitLimits traits;  ///< the face is changed as little as these limits require
  /// Names of attachments, which replace attachments of the same kinds. No names: the face wears
  /// nothing.
  std::optional<std::vector<std::string>> attachments;
  /// Kinds and names of attachments that the face does not wear.
  std::vector<std::string> removed_attachments;
  std::optional<std::string> hair;    ///< name of a hair colour
  std::vector<WeightedHead> colours;  ///< heads that lend textures; empty: no change

  bool needs_redraw() const { return group || !locked.empty() || !traits.empty(); }
  bool is_empty() const {
    return !age && !age_step && !variant_of && !needs_redraw() && !attachments &&
           removed_attachments.empty() && !hair && colours.empty();
  }
};

/// The marks and changes of one reviewer.
struct Review {
  /// Number of sampled faces of the crowd that was reviewed. The review applies to this crowd;
  /// faces with larger numbers are cast later, so that a larger crowd changes no reviewed face.
  /// Empty: the whole crowd.
  std::optional<std::uint64_t> count;
  /// Number of earlier reviews whose results the reviewer saw; see merged_reviews. Empty: all.
  std::optional<std::uint64_t> seen_reviews = {};
  /// Value of DiversityOptions::min_distance_mm for the faces that the review redraws or changes,
  /// so that these faces stay the same if the crowd's value changes later. Empty: the crowd's
  /// value.
  std::optional<double> min_distance_mm = {};
  std::vector<ReviewMark> marks;
  std::vector<FaceChange> changes;  ///< applied after the marks
};

}  // namespace crowdface
