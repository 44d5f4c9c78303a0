// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>

namespace crowdface {

/// How different the faces of a crowd must be.
struct DiversityOptions {
  enum class Mode {
    /// accept candidates that are far enough from all earlier faces; a larger crowd changes no
    /// earlier face
    kFirstFit,
    kSpread,  ///< choose faces far from each other from a pool many times as large as the crowd
  };
  Mode mode = Mode::kFirstFit;
  double min_distance_mm = 0;  ///< smallest distance between any two faces
  /// kFirstFit: other values of `min_distance_mm` for the first sampled faces, by their number.
  /// With {24: 1.2, 40: 1}, faces 1 … 24 and families have 1.2 mm, faces 25 … 40 have 1 mm.
  std::map<std::uint64_t, double> min_distance_of_first_mm = {};
  double min_distance_to_faces_mm = 0;  ///< smallest distance from every input head
  /// Smallest distance between a rejected face and its replacement; empty: half the crowd's median
  /// distance.
  std::optional<double> min_distance_to_rejected_mm;
  double max_weight = 1;    ///< largest weight of one head in one region
  int max_attempts = 1000;  ///< number of candidates for one face before casting gives up
  /// A face nearer than this to a head counts as the same person.
  static constexpr double kSamePersonMm = 0.5;
  /// Number of first candidates for a face that are rejected if they are the same person as a head.
  /// Later candidates are accepted, because some configs yield only faces near heads.
  static constexpr std::uint32_t kCandidatesUnlikeHeads = 100;
  /// kSpread: size of the pool, in multiples of the crowd's size
  static constexpr std::uint64_t kPoolSizeFactor = 10;

  /// Number of acceptable candidates for one face, of which kFirstFit keeps the candidate farthest
  /// from the crowd. Must not depend on the size of the crowd.
  ///
  /// \param index  Index of the face, from 1.
  static int candidate_count(std::uint64_t index) { return index <= 1000 ? 32 : 8; }

  /// Smallest distance of a sampled face from all earlier faces. \param index  0: a family's face.
  double min_distance_mm_of(std::uint64_t index) const {
    const auto first = min_distance_of_first_mm.lower_bound(index);
    return first == min_distance_of_first_mm.end() ? min_distance_mm : first->second;
  }
  /// These options with the `min_distance_mm` of a sampled face.
  DiversityOptions options_of_face(std::uint64_t index) const {
    DiversityOptions own = *this;
    own.min_distance_mm = min_distance_mm_of(index);
    return own;
  }
};

/// Limits for a believable face. The defaults accept mixtures of the heads (although scans have
/// sliver triangles and touching lips) and reject excessive extrapolation. docs/casting.md has
/// figures.
struct BelievabilityOptions {
  /// Whether whole meshes are checked in addition to the coarse samples. Except with kJudge, the
  /// check takes place after casting, when the meshes are built, and only adds to the report.
  enum class Meshes {
    kAuto,  ///< check whole meshes of up to 200,000 polygons
    kAll,
    kNone,
    /// casting accepts a candidate only after judging its mesh; the report lists the results, too
    kJudge,
  };
  Meshes meshes = Meshes::kAuto;
  bool check = true;  ///< false: candidates are not checked for believability
  /// largest Plausibility of a face: its deviation from the heads' mean
  double max_deviation = 2.5;
  double max_stretch = 3;  ///< 99th percentile of the stretch of the skin's triangles
  /// fraction of the skin's triangles that are turned over or collapsed
  double max_flipped = 0.003;
  /// fraction of triangles that intersect others where the target's triangles do not
  double max_intersecting = 0.01;
  /// how much the gap between the lips may exceed the largest gap of any head, see SkinContacts
  double max_gap_mm = 0.5;
  /// Area of skin that may show its back side, in excess of the target's; see skin_check.h.
  double max_exposed_mm2 = 3;
};

}  // namespace crowdface
