// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>

namespace crowdface {

/// How different the faces of a crowd must be.
struct DiversityOptions {
  /// How casting chooses the sampled faces.
  enum class Mode {
    /// Casting chooses one face after the other, and accepts a candidate that is far enough from
    /// all earlier faces. If the crowd is made larger later, its first faces stay the same.
    kFirstFit,
    /// Casting generates a pool with many more candidates than the crowd has faces, and chooses
    /// candidates that are far from each other.
    kSpread,
  };
  Mode mode = Mode::kFirstFit;
  double min_distance_mm = 0;  ///< smallest allowed distance between any two faces of the crowd
  /// kFirstFit: values that replace `min_distance_mm` for the first sampled faces. The key is the
  /// number of the last face that the value applies to. With {24: 1.2, 40: 1}, the minimum distance
  /// is 1.2 mm for faces 1 … 24, 1 mm for faces 25 … 40, and `min_distance_mm` for later faces.
  /// Family members and parents, which casting makes before the first sampled face, have the
  /// minimum distance of face 1.
  std::map<std::uint64_t, double> min_distance_mm_up_to_face = {};
  /// Smallest allowed distance between a face of the crowd and an input head. (In the config, where
  /// input heads are called faces, the key is `min_distance_to_faces`.)
  double min_distance_to_heads_mm = 0;
  /// Smallest distance between a face that a review rejected and its replacement. Empty: half the
  /// median distance between the faces of the crowd.
  std::optional<double> min_distance_to_rejected_mm;
  double max_weight = 1;  ///< largest weight that one head may have in one band of one region
  /// number of candidates that are tried for one face before casting gives up
  int max_attempts = 1000;
  /// A face whose distance from a head is smaller than this value counts as the same person as the
  /// head.
  static constexpr double kSamePersonMm = 0.5;
  /// Number of candidates for each face that casting compares with the heads, to reject candidates
  /// that are the same person as a head (see kSamePersonMm). Later candidates are not compared,
  /// because some configs yield only faces near heads.
  static constexpr std::uint32_t kCandidatesCheckedForSamePerson = 100;
  /// kSpread: number of candidates in the pool, in multiples of the crowd's size
  static constexpr std::uint64_t kPoolSizeFactor = 10;

  /// Number of candidates in a round of kFirstFit. Of the candidates that are far enough from the
  /// crowd, kFirstFit keeps the farthest one; if there is none, another round follows. The number
  /// must not depend on the size of the crowd, because the first faces stay the same if the crowd
  /// is made larger.
  ///
  /// \param index  Index of the face, from 1.
  static int candidate_count(std::uint64_t index) { return index <= 1000 ? 32 : 8; }

  /// Returns the smallest distance in mm that a sampled face may have from any earlier face.
  ///
  /// \param index  number of the sampled face, beginning with 1; 0 for a face of a family.
  double min_distance_mm_of(std::uint64_t index) const {
    const auto first = min_distance_mm_up_to_face.lower_bound(index);
    return first == min_distance_mm_up_to_face.end() ? min_distance_mm : first->second;
  }
  /// Returns a copy of these options with the `min_distance_mm` of one sampled face.
  DiversityOptions options_of_face(std::uint64_t index) const {
    DiversityOptions options = *this;
    options.min_distance_mm = min_distance_mm_of(index);
    return options;
  }
};

/// Limits for a believable face. The defaults accept mixtures of the heads (although scans have
/// sliver triangles and touching lips) and reject excessive extrapolation. docs/casting.md has
/// figures.
struct BelievabilityOptions {
  /// Whether whole meshes are checked in addition to the coarse meshes of the samples (ProxySkin).
  /// With kJudge, casting checks the whole mesh of each candidate. With kAuto and kAll, whole
  /// meshes are checked when they are built, after casting, and the results only appear in the
  /// report.
  enum class MeshChecks {
    kAuto,  ///< whole meshes are checked if they have at most 200,000 polygons
    kAll,   ///< whole meshes are always checked
    kNone,  ///< whole meshes are never checked
    /// casting checks the whole mesh of each candidate before it accepts the candidate, and the
    /// report lists the results
    kJudge,
  };
  MeshChecks meshes = MeshChecks::kAuto;
  bool check = true;  ///< whether candidates are checked for believability
  /// Largest allowed Plausibility::score of a face. The score measures how far the face deviates
  /// from the heads' mean; a larger score is less plausible.
  double max_deviation = 2.5;
  /// largest allowed 99th percentile of the stretch of the skin's triangles
  double max_stretch = 3;
  /// largest fraction of the skin's triangles that may be turned over or collapsed
  double max_flipped = 0.003;
  /// Largest allowed fraction of the face's skin triangles that intersect other skin triangles of
  /// the same face. Intersections that the skin of the face's target has too are not counted.
  double max_intersecting = 0.01;
  /// how much the gap between the lips may exceed the widest gap between the lips of any head, in
  /// mm; see SkinContacts
  double max_gap_mm = 0.5;
  /// Largest allowed increase, compared with the target, of the visible area of the skin's back
  /// side, in mm²; see skin_check.h.
  double max_exposed_mm2 = 3;
};

}  // namespace crowdface
