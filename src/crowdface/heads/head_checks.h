// SPDX-License-Identifier: Apache-2.0
// Checks for heads: differing meshes, wrong orientation or unit, the same person twice.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "crowdface/config/config.h"
#include "crowdface/core/problems.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/heads/read_heads.h"

namespace crowdface {

/// Adds a problem for each head whose mesh differs from the mesh of most heads. The message
/// names the difference and the export setting that probably caused it.
void compare_meshes(const std::vector<HeadFile>& heads, Problems& problems);

/// Checks that the heads face the configured direction and have the size of people. Returns a
/// warning if the mesh is too coarse for this check. Checks nothing with `faces.align: none`.
/// \throws InvalidInput if the heads face another direction than the config says, or have an
///         impossible size: every measurement would then be wrong.
std::optional<std::string> check_orientation_and_size(const Config& config, const Inputs& inputs);

/// Warns about each pair of heads whose shapes suggest that they belong to the same person.
/// \param mm  millimetres per file unit
std::vector<std::string> same_person_warnings(const Inputs& inputs, double mm);

/// Warns about each head whose file has so few decimals that positions are rounded to more than a
/// tenth of a millimetre.
/// \param mm  millimetres per file unit
std::vector<std::string> few_decimals_warnings(const std::vector<HeadFile>& heads, double mm);

/// Warns if the heads are so far from the origin that single precision, in which meshes are
/// written, cannot represent a hundredth of a millimetre there.
std::optional<std::string> far_from_origin_warning(const Config& config, const Inputs& inputs);

}  // namespace crowdface
