// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "crowdface/cast/draw_recipe.h"

namespace crowdface {

/// Which share each face counts for, −1 for none: of the first n faces a share q gets ⌊q·n⌋, and
/// never fewer; where several shares would fall due at once some get theirs a little earlier. Each
/// entry depends on the shares and its own place alone, so growing the crowd moves nobody.
/// As late as possible, earliest deadline first (Liu & Layland 1973): the m-th face of a share is
/// due at face ⌈m/q⌉, and a place goes to a share only if one would otherwise come too late.
/// \param shares  add up to at most 1.
std::vector<int> schedule_shares(const std::vector<double>& shares, std::uint64_t count);

/// Like schedule_shares, but the place between two deadlines at which a share is served is drawn, and a
/// share may get one more than ⌊q·n⌋ of the first n. Where two fall on one face the other gets the next free face.
/// \param purpose  of the draws; see random_pair.
std::vector<int> scatter_shares(const std::vector<double>& shares, std::uint64_t count,
                                std::uint64_t seed, const std::string& purpose);

/// Which group each of sampled faces 1 … count is of, −1 for none: first those that have a count, in their
/// order, then by shares. A larger count moves nobody.
/// \param times  what counts are multiplied by, for a pool of candidates.
std::vector<int> schedule_groups(const std::vector<Group>& groups, std::uint64_t count,
                                 std::uint64_t times = 1);

/// What sampled faces are drawn from: first those of no group, then those of each.
std::vector<FaceKind> face_kinds(const Casting& casting);

}  // namespace crowdface
