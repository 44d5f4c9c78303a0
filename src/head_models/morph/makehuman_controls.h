// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "head_models/morph/morph_targets.h"

namespace crowdface {

/// The ancestries that MakeHuman's targets model.
inline constexpr std::array<std::string_view, 3> kAncestries = {"african", "asian", "caucasian"};

/// Attributes of a person. They determine the means of the person's random measures.
struct MakeHumanPerson {
  bool is_male = false;              ///< whether the person is male; false: female
  double age_years = 0;              ///< age in years, 20 … 80
  std::array<double, 3> ancestry{};  ///< shares of kAncestries, which sum to 1
  /// Amounts of muscle and of body weight, 0 (least) … 1 (most).
  double muscle = 0.5, weight = 0.5;
};
/// Returns the random person of head `index` of a seed.
MakeHumanPerson random_makehuman_person(std::uint64_t seed, std::uint64_t index);

/// Returns the weighted morph targets of head `index`: the targets of the person (sex, age,
/// ancestry, build), then the targets of about a hundred random measures of head, forehead, brows,
/// eyes, nose, mouth, chin, cheeks, ears, neck and asymmetry. Targets of weight zero are omitted.
std::vector<TargetWeight> makehuman_targets(const MakeHumanPerson& person, std::uint64_t seed,
                                            std::uint64_t index);

/// Returns the name of every target that `makehuman_targets` can return.
std::vector<std::string> makehuman_target_names();

}  // namespace crowdface
