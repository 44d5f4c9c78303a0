// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "crowdface/cast/draw_recipe.h"

namespace crowdface {

/// Returns the index of the share that each face belongs to, or −1. Of the first n faces, share q
/// gets at least ⌊q·n⌋. If several shares are due at the same face, some or all of them get an
/// earlier face. The first n entries do not depend on `count`.
///
/// The schedule is as late as possible, by earliest deadline first (Liu & Layland 1973): the m-th
/// face of share q is due at face ⌈m/q⌉. A face is assigned to a share only if some share would
/// otherwise miss its deadline.
///
/// \param shares  Sum to at most 1.
std::vector<int> schedule_shares(const std::vector<double>& shares, std::uint64_t count);

/// Like schedule_shares, but in random order: gives each face at random to one of the shares (or to
/// none), but only so that all shares can still get their faces. Of the first n faces, share q gets
/// ⌊q·n⌋ or ⌈q·n⌉.
///
/// \param shares   Sum to at most 1.
/// \param purpose  Purpose of the random numbers; see random_unit.
std::vector<int> scatter_shares(std::vector<double> shares, std::uint64_t count, std::uint64_t seed,
                                const std::string& purpose);

/// Returns the index of the group of each sampled face, or −1 if it has none; #count. Groups with a
/// fixed count come first, in their order, then groups with a share. The first n entries do not
/// depend on `count`.
///
/// \param times  Factor on the groups' counts, for a pool of candidates.
std::vector<int> schedule_groups(const std::vector<Group>& groups, std::uint64_t count,
                                 std::uint64_t times = 1);

/// Returns the parameters of faces without a group, followed by the parameters of each group.
std::vector<FaceKind> face_kinds(const CastingOptions& casting);

}  // namespace crowdface
