// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "crowdface/cast/family_draws.h"

namespace crowdface {

/// Casts one family and adds its members to the crowd, after those of its parents that are drawn.
/// Where a founder has no room for all of them another one is drawn, a bounded number of times.
/// Parents are drawn so that each child is nearer to both of them than to nine strangers in ten.
/// \return nothing if it cannot be cast; `rejections` says why.
std::optional<FamilyCast> cast_family(const Casting& casting, const FamilyOptions& family,
                                      const FaceJudge& judge, const Strangers& unrelated,
                                      CrowdSoFar& crowd, Kinship& kinship, Rejections& rejections);

/// Mean silhouette of a family's members (Rousseeuw 1987): (b − a)/max(a, b), a being the mean
/// distance to one's own, b that to the nearest other family (to everyone else, if it is the only
/// one). 1: far from all others; below 0: nearer to others.
double silhouette(const std::vector<FamilyCast>& families, std::size_t family,
                  const std::vector<FaceSpace::Point>& points);

}  // namespace crowdface
