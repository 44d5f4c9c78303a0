// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "head_models/morph/morph_targets.h"

namespace crowdface {

inline constexpr std::array<std::string_view, 3> kAncestries = {"african", "asian", "caucasian"};

/// What a MakeHuman head's targets hang together with.
struct MakeHumanPerson {
  bool male = false;
  double years = 0;                   ///< 20 … 80
  std::array<double, 3> ancestry{};   ///< shares of kAncestries; sum 1
  double muscle = 0.5, weight = 0.5;  ///< 0 least … 1 most
};
MakeHumanPerson draw_makehuman_person(std::uint64_t seed, std::uint64_t index);

/// The targets that make this head of the base mesh, each with its weight: the person's, then some
/// hundred drawn measures of head, forehead, brows, eyes, nose, mouth, chin, cheeks, ears, neck, and
/// what makes left and right differ.
std::vector<TargetWeight> makehuman_targets(const MakeHumanPerson& person, std::uint64_t seed,
                                            std::uint64_t index);

/// Every target that `makehuman_targets` can ask for.
std::vector<std::string> makehuman_target_names();

}  // namespace crowdface
