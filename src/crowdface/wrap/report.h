// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "crowdface/render/camera.h"
#include "crowdface/wrap/scan_faults.h"
#include "crowdface/wrap/wrap.h"

namespace crowdface {

/// Distances from a wrapped skin to the scan over vertices that the scan shows, mm.
struct WrapDistances {
  double median = 0, percentile_95 = 0;
};
WrapDistances distances_of(const WrapTemplate& shape, const WrapResult& result);
/// The share of the visible skin for which the scan has nothing.
double share_without_data(const WrapTemplate& shape, const WrapResult& result);

/// What the user should look at, a sentence each that says what to do.
/// \param regions      that are named where much of one is far from the scan.
/// \param model_heads  how many heads the model has; 0: there is none.
std::vector<std::string> wrap_warnings(const WrapTemplate& shape, const WrapResult& result,
                                       const SkinRegions& regions, std::size_t model_heads);

/// \throws InvalidInput, saying what to do, if the result is no wrap of this scan.
void refuse_bad_wrap(const WrapTemplate& shape, const WrapResult& result,
                     const SkinRegions& regions);

/// What stands in the report beside what was measured.
struct WrapFacts {
  std::string template_file, scan_file, inputs, mesh;  ///< the last two: digests
  double output_scale = 1;  ///< what the head was multiplied with, so that it has the scan's size
  /// How far landmarks lie from where a similarity of all others puts them, mm; those without are not told.
  std::map<std::string, double> left_out_mm;
  /// See unseen_landmarks; of none: not asked for.
  std::map<std::string, double> unseen_mm = {};
};

/// The report as JSON.
std::string format_wrap_report(const WrapFacts& facts, const WrapTemplate& shape,
                               const WrapResult& result, const SkinRegions& regions,
                               const std::vector<std::string>& warnings);

/// The scan above, the wrapped head in the middle, its distance to the scan below, each from three
/// sides, as a PNG file.
std::string wrap_picture(const WrapTemplate& shape, const Scan& scan, const WrapResult& result,
                         const HeadFrame& frame, const std::string& title);

}  // namespace crowdface
