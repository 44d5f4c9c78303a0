// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/cast/face_plan.h"
#include "crowdface/cast/sampling.h"
#include "crowdface/cast/typical_head.h"
#include "crowdface/plane/weights.h"

namespace crowdface {

/// Properties of all heads; see CastingOptions. apply_age finds the nearest old or young head by
/// the anchors (positions on the weight plane) and tags.
struct HeadProperties {
  const std::vector<PlanePoint>& anchors;  ///< the anchor of each head
  const HeadTags& tags;                    ///< the tags of each head, or empty
  const std::vector<double>& ages_years;   ///< the age of each head, or empty
};

/// Ages a face. In every region, moves the fraction |age| of each head's weight to the nearest head
/// tagged old (age above 0) or young (age below 0). Heads with this tag keep their weight. The key
/// `ageing` of a band is a factor on the fraction. The nearest head is chosen first by equal sex,
/// then by the number of common tags, then by the distance between the anchors. So faces made from
/// different heads also take their aged detail from different heads. (The paper, too, transfers an
/// older person's detail to a younger person, Fig. 2.) Removes the positions of the bands, because
/// the changed weights no longer correspond to a position.
///
/// \param sampling  parameters of the face's group, or of the crowd.
/// \throws BrokenPrecondition if no head has the tag.
void apply_age(FacePlan& face, double age, const HeadProperties& heads,
               const SamplingOptions& sampling);

/// Converts an age, which may be in years, to the value from −1 to 1 that apply_age expects. A
/// face's age in years is the weighted mean of the ages of the heads that lend the finest detail.
/// If ageing cannot give the face the wanted number of years, returns the value with which the face
/// comes nearest to it.
///
/// \param face  a face whose age is 0.
/// \throws BrokenPrecondition if the age is in years and the ages of the heads are unknown.
double age_as_fraction(const Age& age, const FacePlan& face, const HeadProperties& heads,
                       const SamplingOptions& sampling);

/// Applies an age to a face whose age is 0. Sets FacePlan::age_years if the age is in years.
void apply_age(FacePlan& face, const Age& age, const HeadProperties& heads,
               const SamplingOptions& sampling);

/// Undoes apply_age, so that children do not inherit the age of this face. If an age of −1 or 1
/// moved all of a band's weight, the original weights are lost; the band and the face's age then
/// stay as they are.
void undo_age(FacePlan& face, const HeadProperties& heads, const SamplingOptions& sampling);

/// Mixes the two weights of each head: returns (1 − t)·a + t·b.
std::vector<SourceWeight> mixed_weights(const std::vector<SourceWeight>& a,
                                        const std::vector<SourceWeight>& b, double t);

}  // namespace crowdface
