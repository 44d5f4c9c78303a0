// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/config/config.h"
#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// The rotation, shift and scale of a head relative to the reference head.
struct HeadPose {
  double angle_degrees = 0;  ///< rotation that aligns the head with the reference
  /// distance between the centroids of head and reference, as a fraction of the head's size
  double relative_shift = 0;
  double scale = 1;  ///< size of the head divided by the size of the reference head
  /// Whether left and right are swapped: the head fits the reference several times better after a
  /// reflection than without one.
  bool is_mirrored = false;
};

/// Poses of all heads relative to the reference head. The reference is the medoid: the head whose
/// pose is nearest to the poses of all other heads. Uses only skin vertices.
std::vector<HeadPose> head_poses(const HeadSet& heads, const Components& components);

/// A message that says why `align_heads` refuses a head even with `rigid`: the head is mirrored, or
/// its coordinates are in another unit. Empty if `align_heads` accepts the head.
std::string objection_to_pose(const HeadPose& pose, const std::string& head);

/// Whether the config should use `align: rigid`: all heads have the same size, but at least one
/// head is rotated or shifted so far that `align_heads` would warn.
bool needs_rigid_alignment(const HeadSet& heads, const Components& components);

/// Warns about heads that are rotated, shifted or scaled relative to the other heads. Blending
/// would treat such a difference in pose as detail. With `check`, heads stay as they are; with
/// `rigid`, each head is first aligned with the first head.
/// \return the warnings, one per head that differs.
/// \throws InvalidInput if a head is mirrored or has another unit, and with `check` also if a head
///         is rotated by more than 45 degrees.
std::vector<std::string> align_heads(HeadSet& heads, const Components& components, Align align);

}  // namespace crowdface
