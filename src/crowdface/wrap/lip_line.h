// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/mesh/alignment.h"
#include "crowdface/parts/surface_point.h"
#include "crowdface/wrap/scan.h"
#include "crowdface/wrap/wrap_template.h"

namespace crowdface {

/// The line between the lips of a template: pairs of points on the skin. The first point of a pair
/// is on the upper lip just above the line, the second on the lower lip just below the line.
using LipLine = std::vector<std::array<SurfacePoint, 2>>;

/// Finds the line between the lips of a template: the deepest crease, seen from the front, between
/// the landmarks `lip_upper` and `lip_lower`. Returns an empty line if the template has no such
/// landmarks or no crease.
/// \param landmarks  landmarks of the template by name, as vertex numbers (see propose_landmarks)
LipLine find_lip_line(const WrapTemplate& wrap_template,
                      const std::map<std::string, std::uint32_t>& landmarks);

/// The line between the lips of a scan.
struct ScanLipLine {
  double offset_mm = 0;   ///< height above the line between the lips of the wrapped head
  bool is_closed = true;  ///< whether the lips of the scan are at most about 1 mm apart
};

/// Finds the line between the scan's lips: the clearest crease within 20 mm above and below the line
/// between the lips of the wrapped head. Returns nothing if the scan has no clear crease there, or
/// two of them, or a wide open mouth.
/// \param scan  without eyeballs and teeth
/// \param wrapped  #V by 3, positions of the whole template after the wrap
/// \param pose     similarity transform from the template's frame to the scan's frame
std::optional<ScanLipLine> find_scan_lip_line(const WrapTemplate& wrap_template,
                                              const LipLine& line, const Positions& wrapped,
                                              const Scan& scan, const Similarity& pose);

}  // namespace crowdface
