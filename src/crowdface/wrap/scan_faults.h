// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "crowdface/wrap/wrap.h"

namespace crowdface {

/// A vertex of the wrapped skin counts as far from the scan if its distance exceeds this length.
inline constexpr double kFarFromScanMm = 3;

/// Regions of the skin for which a report lists distances to the scan separately.
struct SkinRegions {
  std::vector<std::string> names;  ///< names of the regions
  /// For each skin vertex, the index of its region in `names`; empty: there are no regions.
  std::vector<std::size_t> region_of_vertex;

  /// Whether a vertex of the skin belongs to the region `name`.
  bool contains(std::uint32_t vertex, const std::string& name) const;
};

/// Finds defects of a scan from the wrapped template: closed eyes (lids that meet in front of an
/// eyeball), an open mouth (lips that do not touch), and hair (the scan's skull is larger than the
/// template's after the faces are aligned, or the wrapped skull is far from the scan). Returns one
/// sentence per defect, with advice. Without regions the function checks only the eyes.
std::vector<std::string> scan_faults(const WrapTemplate& wrap_template, const WrapResult& result,
                                     const SkinRegions& regions);

}  // namespace crowdface
