// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "crowdface/wrap/wrap.h"

namespace crowdface {

inline constexpr double kFarFromScanMm =
    3;  ///< farther off the scan than this skin does not lie on it

/// Parts of the skin that a report speaks of one by one.
struct SkinRegions {
  std::vector<std::string> names;
  std::vector<std::size_t> of_vertex;  ///< #skin, < #names; or empty: there are none

  /// Whether a vertex of the skin is of the region with this name.
  bool is(std::uint32_t vertex, const std::string& name) const;
};

/// What about a scan makes it a bad one, told by where the template came to lie on it: closed eyes (lids
/// that came together before an eyeball), an open mouth (lips that came apart), hair (a skull that
/// stands out beyond the template's, once their faces lie on each other, or stays far from the scan).
/// A sentence each that says what to do; without regions eyes alone are looked at.
std::vector<std::string> scan_faults(const WrapTemplate& shape, const WrapResult& result,
                                     const SkinRegions& regions);

}  // namespace crowdface
