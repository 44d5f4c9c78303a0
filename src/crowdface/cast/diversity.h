// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace crowdface {

/// How different the faces of a crowd must be.
struct DiversityOptions {
  enum class Mode {
    kFirstFit,  ///< draw, keep if far enough from all before; growing the crowd moves no face
    kSpread,    ///< choose the most spread set from a pool many times the crowd's size
  };
  Mode mode = Mode::kFirstFit;
  double min_distance_mm = 0;           ///< between any two faces of the crowd
  double min_distance_to_faces_mm = 0;  ///< from every input head
  /// Between a face that a review rejected and the one in its place; none: half the crowd's median.
  std::optional<double> min_distance_to_rejected_mm;
  double max_weight = 1;                      ///< of one head in one region
  int max_attempts = 1000;                    ///< draws of one face before casting gives up
  static constexpr std::uint64_t kPool = 10;  ///< kSpread: pool size, in crowds

  /// kFirstFit: of that many faces that would do, the one farthest from the crowd is kept. It must not depend
  /// on how many faces there will be. \param index  of the face, from 1.
  static int candidates_for(std::uint64_t index) { return index <= 1000 ? 32 : 8; }
};

/// What a face must not be. The limits let through what faces between the heads do (scans have
/// slivers, and lips that touch) and refuse extrapolation that goes too far; docs/casting.md has
/// figures for choosing others.
struct BelievabilityOptions {
  /// Whether whole meshes are looked at besides the samples: when they are built, only to be
  /// reported, as by then the plan is made; or while casting.
  enum class Meshes {
    kAuto,  ///< up to 200,000 polygons
    kAll,
    kNone,
    kJudge,  ///< each candidate's mesh is built and judged before it is accepted; reported as well
  };
  Meshes meshes = Meshes::kAuto;
  bool check = true;               ///< false: no candidate is judged by any of these
  double max_deviation = 2.5;      ///< from the heads' mean, see Plausibility
  double max_stretch = 3;          ///< of all but one in a hundred triangles of the skin
  double max_flipped = 0.003;      ///< share of the skin's triangles turned over or collapsed
  double max_intersecting = 0.01;  ///< share that passes through others where the target's does not
  double max_gap_mm = 0.5;  ///< how much farther lips may part than any head's, see SkinContacts
  /// Skin that may show its back beyond the target's, see skin_check.h.
  double max_exposed_mm2 = 3;
};

}  // namespace crowdface
