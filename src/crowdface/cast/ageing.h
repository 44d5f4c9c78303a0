// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/cast/casting_options.h"
#include "crowdface/cast/face_plan.h"

namespace crowdface {

/// Ages a face. This is the last step of casting that changes which heads a face is blended from,
/// and with which weights. In every region, moves the fraction |age| of each head's weight to the
/// nearest head tagged old (age above 0) or young (age below 0). Heads with this tag keep their
/// weight. The key `ageing` of a band is a factor on the fraction. The nearest head to a head h is
/// chosen in three steps: keep the heads with the sex of h, if there are any; of these, keep the
/// heads that have the most tags in common with h; of these, take the head whose anchor is nearest
/// to the anchor of h. So faces that are blended from different heads also get their old or young
/// detail from different heads. (The paper, too, transfers an older person's detail to a younger
/// person, Fig. 2.) Removes the positions of the bands, because the changed weights no longer
/// correspond to a position. Sets FacePlan::age, and FacePlan::age_years if the age is in years;
/// see age_as_fraction.
///
/// \param face  A face whose age is 0, with its group (see sampling_of).
/// \throws BrokenPrecondition if no head has the tag, or if the age is in years and the ages of the
///     heads are unknown.
void apply_age(FacePlan& face, const Age& age, const CastingOptions& casting);

/// Converts an age, which may be in years, to a value from −1 to 1. A face's age in years is the
/// weighted mean of the ages of the heads that lend the finest detail. If ageing cannot give the
/// face the wanted age, returns the value with which the face's age comes nearest to this age.
/// Parameters and exceptions are those of apply_age.
double age_as_fraction(const Age& age, const FacePlan& face, const CastingOptions& casting);

/// Undoes apply_age, so that children do not inherit the age of this face. At an age of −1 or 1,
/// apply_age may have moved all weight of a band to old or young heads. Then the original weights
/// of this band are lost, and the band and the face's age stay as they are.
void undo_age(FacePlan& face, const CastingOptions& casting);

}  // namespace crowdface
