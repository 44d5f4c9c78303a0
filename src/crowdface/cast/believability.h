// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

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
  double max_exposed_mm2 =
      3;  ///< skin that may show its back beyond the target's, see exposed_back
};

}  // namespace crowdface
