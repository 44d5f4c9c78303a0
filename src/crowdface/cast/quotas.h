// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "crowdface/cast/diversity.h"
#include "crowdface/cast/draw_recipe.h"

namespace crowdface {

/// Which quota each face counts for, −1 for none: of the first n faces a quota q gets ⌊q·n⌋, and
/// never fewer; where several quotas would fall due at once some get theirs a little earlier. Each
/// entry depends on the shares and its own place alone, so growing the crowd moves nobody.
/// As late as possible, earliest deadline first (Liu & Layland 1973): the m-th face of a quota is
/// due at face ⌈m/q⌉, and a place goes to a quota only if one would otherwise come too late.
std::vector<int> schedule_quotas(const std::vector<Quota>& quotas, std::uint64_t count);

/// Like schedule_quotas, but where in its stretch between two deadlines a quota is served is drawn, and a
/// quota may get one more than ⌊q·n⌋ of the first n. Where two fall on one face the other gets the next one that is free.
/// \param shares  add up to at most 1. \param purpose  of the draws; see random_pair.
std::vector<int> scatter_quotas(const std::vector<double>& shares, std::uint64_t count,
                                std::uint64_t seed, const std::string& purpose);

/// The targets that faces of no quota may have, then those of each quota; those of a band have the first.
using TargetsOfQuota = std::vector<std::vector<WeightedHead>>;
TargetsOfQuota targets_by_quota(const std::vector<WeightedHead>& targets,
                                const std::vector<Quota>& quotas);

/// Who lends to each band of faces of a quota, −1 for none; empty: as sampling says. Heads of a band's
/// quotas lend to it in their own quota's faces alone.
std::vector<std::vector<Eigen::Index>> sources_by_quota(const SamplingOptions& sampling,
                                                        const std::vector<Quota>& quotas,
                                                        int quota);

/// Which group each face is of, −1 for none: first those that have a count, in their order, then by
/// shares as with quotas. A larger count moves nobody.
/// \param times  what counts are multiplied by, for a pool of candidates.
std::vector<int> schedule_groups(const std::vector<Group>& groups, std::uint64_t count,
                                 std::uint64_t times = 1);

/// The quotas or groups of sampled faces: which of them faces 1 … count are of, and what they are
/// drawn from: first those of none, then those of each.
std::vector<int> schedule_kinds(const Casting& casting, std::uint64_t count,
                                std::uint64_t times = 1);
std::vector<FaceKind> face_kinds(const Casting& casting);

}  // namespace crowdface
