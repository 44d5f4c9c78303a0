// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace crowdface {

/// What an additional mesh, such as hair, looks like on one face: its tint and its texture.
struct PartLook {
  /// Factors by which the materials' colours are multiplied, linear RGB.
  std::array<float, 3> tint = {1, 1, 1};
  /// Text that replaces `UsdaPart::kLookPlaceholder` in the names of texture files.
  std::string name = {};
  /// Content of a PNG texture that belongs to this face only; empty if there is no such texture.
  std::string_view image = {};
};

}  // namespace crowdface
