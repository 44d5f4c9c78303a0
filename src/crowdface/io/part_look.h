// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace crowdface {

/// The colour of an additional mesh in the file of one face.
struct PartLook {
  std::array<float, 3> tint = {1, 1, 1};  ///< factors on the light of the materials, linear RGB
  /// Replaces `UsdaPart::kLookName` in the names of texture files.
  std::string name = {};
  /// Content of a PNG file that only this face has; empty: there is none.
  std::string_view image = {};
};

}  // namespace crowdface
