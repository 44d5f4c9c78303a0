// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "crowdface/cast/attachment_sampling.h"
#include "crowdface/cast/casting_result.h"
#include "crowdface/cast/draw_recipe.h"
#include "crowdface/cast/face_colours.h"
#include "crowdface/config/config.h"

namespace crowdface {

/// Replaces each changed face of a crowd by the result of the change, and gives this face its
/// colours and attachments. No other face changes.
///
/// - A changed face that is still the same person keeps its colours and attachments. If its age
///   changes, the fraction of grey hair changes with the age.
/// - A face that was sampled again gets new colours and attachments, see
///   choose_attachments_of_changed_face. A variant keeps the colours of its original.
///
/// \param casting, attachments, colours  the options with which the crowd was sampled.
/// \param groups  index of each sampled face's group, see choose_attachments.
/// \param crowd  the faces as they were cast, with colours and attachments.
void replace_changed_faces(const Config& config, const CastingOptions& casting,
                           const AttachmentOptions& attachments, const ColourOptions& colours,
                           const std::vector<int>& groups,
                           const std::map<std::size_t, ChangedFace>& changed,
                           std::vector<FacePlan>& crowd);

}  // namespace crowdface
