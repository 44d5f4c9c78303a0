// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/blend/recipe.h"

namespace crowdface {

/// The nearest neighbours of a face, for people to judge by.
struct Nearest {
  Index head = 0;  ///< the input head nearest to it
  double head_mm = 0;
  std::optional<std::string> crowd;  ///< the nearest face before it in the plan
  double crowd_mm = 0;
};

/// How a face was found. No mesh depends on it.
struct CastingNotes {
  std::uint32_t attempt = 0;  ///< how many draws were thrown away before this one
  std::optional<Nearest> nearest;
  std::optional<std::string> review;  ///< what a reviewer noted
};

/// One face of a crowd: a line of its plan.
struct CastFace {
  std::string id;
  std::optional<std::uint64_t> index;  ///< from 1; none unless it is sampled
  std::optional<std::string> family;
  std::optional<std::string> group;
  Recipe recipe;
  std::optional<double> age;          ///< −1 … 1, if it was moved along old or young detail
  std::vector<std::string> parents;   ///< of a family with parents: mother and father, heads or ids
  std::vector<std::string> inherits;  ///< with parents: #regions by #bands, whose detail
  double mother_share = 0;            ///< of the large forms, where these are inherited
  std::vector<std::string> attachments;  ///< by name
  CastingNotes notes;
};

}  // namespace crowdface
