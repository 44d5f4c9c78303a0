// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "crowdface/cast/draw_recipe.h"

namespace crowdface {

/// Returns the share to which each face belongs, or −1. Of the first n faces, share q gets at least
/// ⌊q·n⌋; if several shares are due at once, some get a face a little earlier. Each entry depends
/// only on the shares and its own place, so a larger crowd changes no entry.
///
/// Schedules as late as possible, by earliest deadline first (Liu & Layland 1973): the m-th face of
/// a share is due at face ⌈m/q⌉. A place goes to a share only if some share would be late
/// otherwise.
///
/// \param shares  Sum to at most 1.
std::vector<int> schedule_shares(const std::vector<double>& shares, std::uint64_t count);

/// Like schedule_shares, but draws the place at which a share is served between two deadlines. A
/// share may get one face more than ⌊q·n⌋ of the first n. If two shares draw the same face, the
/// other one gets the next free face.
///
/// \param purpose  Purpose of the random numbers; see random_pair.
std::vector<int> scatter_shares(const std::vector<double>& shares, std::uint64_t count,
                                std::uint64_t seed, const std::string& purpose);

/// Returns the group of each sampled face 1 … count, or −1: first the groups with a count, in their
/// order, then groups by share. A larger count changes no entry.
///
/// \param times  Factor for the groups' counts, for a pool of candidates.
std::vector<int> schedule_groups(const std::vector<Group>& groups, std::uint64_t count,
                                 std::uint64_t times = 1);

/// Returns the parameters of sampled faces: of faces without group, then of each group.
std::vector<FaceKind> face_kinds(const CastingOptions& casting);

}  // namespace crowdface
