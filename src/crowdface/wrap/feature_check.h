// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "crowdface/wrap/wrap_template.h"

namespace crowdface {

/// A part of the face whose relief differs from the skin around it: the mouth, the nose, an eye, an
/// ear.
struct FaceFeature {
  std::string name;
  std::vector<std::uint32_t> skin_vertices;  ///< rows of the skin, ascending
};

/// Finds the facial features of a template from its landmarks. Omits a feature if one of the
/// feature's landmarks is missing.
/// \param landmarks  landmarks of the template by name, as vertex numbers (see propose_landmarks)
std::vector<FaceFeature> face_features(const WrapTemplate& wrap_template,
                                       const std::map<std::string, std::uint32_t>& landmarks);

/// Returns, for each feature, the correlation between the feature's relief before and after a wrap.
/// The relief is the height of the skin above a quadratic surface that is fitted to the feature.
/// The correlation is above 0.75 if the template's feature lies on the same feature of the scan,
/// and mostly below 0.5 if the template's feature lies elsewhere (measured by
/// scripts/measure_wrap.sh).
/// \param wrapped  positions of the whole template, #V by 3
/// \return #features
std::vector<double> relief_correlations(const WrapTemplate& wrap_template,
                                        const std::vector<FaceFeature>& features,
                                        const Positions& wrapped);

}  // namespace crowdface
