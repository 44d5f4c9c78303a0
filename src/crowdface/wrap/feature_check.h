// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "crowdface/wrap/lip_line.h"
#include "crowdface/wrap/wrap_template.h"

namespace crowdface {

/// A part of the face whose relief differs from the skin around it: the mouth, the nose, an eye, an
/// ear.
struct FaceFeature {
  std::string name;                          ///< name of the feature for messages, such as "mouth"
  std::vector<std::uint32_t> skin_vertices;  ///< vertex indices in the skin, ascending
  LipLine lip_line = {};                     ///< of the mouth; empty for the other features
};

/// Finds the facial features of a template from its landmarks. Omits a feature if one of the
/// feature's landmarks is missing.
/// \param landmarks  landmarks of the template by name, as vertex numbers (see propose_landmarks)
std::vector<FaceFeature> face_features(const WrapTemplate& wrap_template,
                                       const std::map<std::string, std::uint32_t>& landmarks);

/// How well the reliefs of a feature before and after a wrap agree. The relief is the height of the
/// skin above a quadratic surface that is fitted to the feature.
struct ReliefCorrelation {
  /// correlation between the template's and the wrapped head's relief
  double correlation_at_feature = 1;
  /// The highest correlation between the template's relief and the wrapped head's relief at places
  /// up to 20 mm above or below the feature. −1: not computed, because `correlation_at_feature` is
  /// high.
  double best_correlation_nearby = -1;

  /// From kHigh on, a feature cannot be doubtful; below kDoubtful, it is doubtful.
  static constexpr double kHigh = 0.7, kDoubtful = 0.55;

  /// Whether the correlation at the feature is so high that the feature cannot be doubtful.
  bool is_high() const { return correlation_at_feature >= kHigh; }
  /// Whether the template's feature probably lies on another part of the scan: the correlation
  /// between the reliefs of template and scan is low at the feature, or hardly higher there than
  /// `best_correlation_nearby`. Measured for mouths: On ICT heads, whose vertices are known, the
  /// correlation is 0.55 to 0.9 within 2 mm of the correct place, and −0.1 to 0.86 at more than
  /// 4 mm. On synthetic heads, within 4 mm of the correct place, the correlation is at least 0.5,
  /// and exceeds `best_correlation_nearby` by at least 0.12.
  bool is_doubtful() const {
    return correlation_at_feature < kDoubtful ||
           (!is_high() && correlation_at_feature - best_correlation_nearby < 0.1);
  }
};

/// Compares the relief of each feature on the template and on the wrapped head.
/// \param wrapped  #V by 3, positions of the whole template after the wrap.
/// \return one entry per feature
std::vector<ReliefCorrelation> relief_correlations(const WrapTemplate& wrap_template,
                                                   const std::vector<FaceFeature>& features,
                                                   const Positions& wrapped);

}  // namespace crowdface
