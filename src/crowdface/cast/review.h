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
    kKeep,    ///< the face stays unchanged
    kReject,  ///< a new random face replaces the face; only the locked parts stay
  };
  std::string id;  ///< id of the face that is marked
  Verdict verdict = Verdict::kKeep;
  /// Bands of regions that stay the same when the face is redrawn. The number of a band is (index
  /// of the region) · #bands + (index of the band). If the crowd has no bands, #bands is 1, and the
  /// numbers are the indices of the regions.
  std::vector<std::size_t> locked_bands;
  std::optional<std::string> note;  ///< the reviewer's comment on the face
};

/// A change of one face. To add a config key, add a member here, a row in config/changes_keys.cpp,
/// and code that applies the change in cast/face_changes.cpp (for attachments: in
/// run/changed_faces.cpp).
struct FaceChange {
  enum class AgeStep { kOlder, kYounger };
  std::string id;                   ///< id of the face that is changed
  std::optional<AgeStep> age_step;  ///< makes the face older or younger by a fixed step
  std::optional<Age> age;           ///< new age; a change has at most one of `age` and `age_step`
  /// id of the face of which this face becomes a variant
  std::optional<std::string> variant_of;
  /// requested distance between this face and the face `variant_of`
  double variant_distance_mm = 1.5;
  std::optional<std::string> group;  ///< group in which the face is redrawn
  /// Bands of regions that stay the same while the other bands are redrawn; encoded as in
  /// ReviewMark.
  std::vector<std::size_t> locked_bands;
  /// Limits on the face's measurements. The face is changed only as far as these limits require.
  TraitLimits traits;
  /// If set: names of attachments that the face gets; each replaces the face's attachment of the
  /// same kind. Special case: an empty list removes all attachments of the face.
  std::optional<std::vector<std::string>> attachments;
  /// Kinds and names of attachments that are taken off the face.
  std::vector<std::string> removed_attachments;
  std::optional<std::string> hair;  ///< name of the face's new hair colour
  /// heads whose textures are blended for the face; empty: no change
  std::vector<WeightedHead> colours;

  /// Returns whether parts of the face are drawn at random again.
  bool needs_redraw() const { return group || !locked_bands.empty() || !traits.empty(); }
  bool is_empty() const {
    return !age && !age_step && !variant_of && !needs_redraw() && !attachments &&
           removed_attachments.empty() && !hair && colours.empty();
  }
};

/// The marks and changes that one reviewer requests.
struct Review {
  /// Number n of sampled faces that the crowd had when it was reviewed. If the crowd is larger now,
  /// casting first casts the faces 1 … n, then applies the review, and then casts the faces after
  /// n. So no reviewed face changes when the crowd becomes larger. Empty, or in spread mode: the
  /// review applies after all faces of the crowd are cast.
  std::optional<std::uint64_t> reviewed_face_count;
  /// Number of reviews, from the start of the list, whose results the reviewer saw; see
  /// merged_reviews. Empty: all earlier reviews.
  std::optional<std::uint64_t> review_count_seen_by_reviewer = {};
  /// Value of DiversityOptions::min_distance_mm for the faces that the review redraws or changes,
  /// so that these faces stay the same if the crowd's value changes later. Empty: the crowd's
  /// current value applies.
  std::optional<double> min_distance_mm = {};
  std::vector<ReviewMark> marks;
  std::vector<FaceChange> changes;  ///< requested changes of faces; applied after the marks
};

}  // namespace crowdface
