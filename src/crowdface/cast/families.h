// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "crowdface/cast/family_sampler.h"

namespace crowdface {

/// Casts a family: adds the family's new parents and then its members to the crowd. All members are
/// derived from one founder, who is not part of the crowd. If there is no room for all members
/// around the founder, tries another founder, a bounded number of times. New parents are chosen so
/// that, for each parent and child, at most one stranger in ten is nearer to the child than the
/// parent is.
///
/// \return  Nothing if the family cannot be cast; `rejections` then holds the reasons.
std::optional<FamilyPlan> cast_family(const CastingOptions& casting, const FamilyOptions& family,
                                      const FaceJudge& judge, const UnrelatedFaces& unrelated,
                                      CrowdSoFar& crowd, FamilySeparation& family_separation,
                                      RejectionCounts& rejections);

/// Returns the mean silhouette coefficient of a family's members, which measures how well a cluster
/// is separated (Rousseeuw 1987). The coefficient of a member is (b − a)/max(a, b), where a is the
/// member's mean distance from its own family, and b is the member's mean distance from the nearest
/// other family (from all other faces if there is no other family). A coefficient of 1 means that
/// the member is far from all other families. A coefficient below 0 means that the member is nearer
/// to another family than to its own.
double mean_silhouette_coefficient(const std::vector<FamilyPlan>& families, std::size_t family,
                                   const std::vector<FaceSpace::Point>& points);

}  // namespace crowdface
