// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "crowdface/cast/sampling.h"

namespace crowdface {

/// Returns the index of the share that each face is assigned to, or −1 for no share. For every n, a
/// share with the fraction q gets at least ⌊q·n⌋ of the first n faces. A larger `count` adds
/// entries and does not change the earlier entries.
///
/// Faces are assigned as late as possible, in the order of their deadlines (earliest deadline
/// first, Liu & Layland 1973): for a share with the fraction q, the deadline of its m-th face is
/// face number ⌈m/q⌉. A face is assigned to a share only if some share would otherwise miss a
/// deadline. If several shares have the same deadline, at most one share gets the face with this
/// number, and the other shares get earlier faces.
///
/// \param shares  fractions of the faces; they sum to at most 1.
std::vector<int> schedule_shares(const std::vector<double>& shares, std::uint64_t count);

/// Like schedule_shares, but in random order: each face is assigned at random to a share (or to no
/// share), among the choices with which all shares can still get their faces. A share with the
/// fraction q gets ⌊q·n⌋ or ⌈q·n⌉ of the first n faces.
///
/// \param shares   fractions of the faces; they sum to at most 1.
/// \param purpose  Purpose of the random numbers; see random_uniform.
std::vector<int> schedule_shares_randomly(std::vector<double> shares, std::uint64_t count,
                                          std::uint64_t seed, const std::string& purpose);

/// Returns for each sampled face the index of its group, or −1 if the face has no group. Groups
/// with a fixed count get their faces first, in the order of the groups, then groups with a share.
/// A larger `count` adds entries and does not change the earlier entries.
///
/// \param pool_size_factor  Every Group::count is multiplied by this factor. If the result is for a
///                          pool of candidates, the factor is the number of candidates per face of
///                          the crowd.
std::vector<int> schedule_groups(const std::vector<Group>& groups, std::uint64_t count,
                                 std::uint64_t pool_size_factor = 1);

}  // namespace crowdface
