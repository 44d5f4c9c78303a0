// SPDX-License-Identifier: Apache-2.0
// What may be wrong with heads: another mesh, another stance or unit, one person twice.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "crowdface/config/config.h"
#include "crowdface/core/problems.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/heads/read_heads.h"

namespace crowdface {

/// A problem for each head that is not the first one's mesh: what is different, and what an export did.
void compare_with_first(const std::vector<HeadFile>& heads, Problems& problems);

/// \throws InvalidInput if the heads look another way than the config says, or are of a size that no
/// heads have: then everything that is measured would be wrong.
void check_stance(const Config& config, const Inputs& inputs);

/// A warning for each two heads that are one person's, as far as their shapes tell.
/// \param mm  per unit
std::vector<std::string> same_persons(const Inputs& inputs, double mm);

/// A warning if single precision, in which meshes are written, keeps no hundredth of a millimetre where
/// the heads stand.
std::optional<std::string> far_from_origin(const Config& config, const Inputs& inputs);

}  // namespace crowdface
