// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/render/camera.h"
#include "crowdface/wrap/scan_faults.h"
#include "crowdface/wrap/wrap.h"

namespace crowdface {

/// Statistics of the distances from a wrapped skin to the scan, in mm, over the visible vertices
/// that the scan covers.
struct WrapDistances {
  double median_mm = 0, percentile_95_mm = 0;
};
/// Computes the distances from the wrapped skin to the scan.
WrapDistances measure_distances(const WrapTemplate& wrap_template, const WrapResult& result);
/// Returns the fraction of the visible skin for which there is no scan data.
double fraction_without_data(const WrapTemplate& wrap_template, const WrapResult& result);

/// Warnings for the user; one sentence each, with advice.
/// \param regions  the warnings name the regions in which a large fraction of the skin is far from
///                 the scan.
/// \param model_head_count  number of heads in the model; 0: no model.
std::vector<std::string> wrap_warnings(const WrapTemplate& wrap_template, const WrapResult& result,
                                       const SkinRegions& regions, std::size_t model_head_count);

/// The warnings about parts of the wrapped head that may be wrong: features, automatically found
/// landmarks, and the position of the face.
std::vector<std::string> doubtful_part_warnings(const WrapTemplate& wrap_template,
                                                const WrapResult& result);

/// Rejects a result that is not a valid wrap of its scan.
/// \throws InvalidInput, with advice
void refuse_bad_wrap(const WrapTemplate& wrap_template, const WrapResult& result,
                     const SkinRegions& regions);

/// The facts in the report of a wrap that do not come from WrapResult.
struct WrapFacts {
  std::string template_file, scan_file;  ///< paths of the template and of the scan
  std::string inputs_digest;             ///< hash of all input files and of the options
  std::string mesh_digest;  ///< hash of the head's mesh file; empty: no head was written
  double output_scale = 1;  ///< factor by which the head was scaled to the size of the scan
  /// Leave-one-out error of the pose by landmark name, in mm: the distance between the landmark and
  /// its prediction. A similarity that is fitted to the other landmarks gives the prediction. A
  /// landmark that cannot be predicted has no entry.
  std::map<std::string, double> cross_validated_pose_errors_mm;
  /// Error of the wrap by landmark name, in mm: the result of `cross_validate_wrap`; empty if the
  /// user did not request it.
  std::map<std::string, double> cross_validated_wrap_errors_mm = {};
  /// Fraction of the new texture's texels, 0 … 1, that are filled in because the scan does not
  /// cover them. Nothing if no texture was made.
  std::optional<double> share_without_scan = {};
};

/// The report as JSON.
std::string format_wrap_report(const WrapFacts& facts, const WrapTemplate& wrap_template,
                               const WrapResult& result, const SkinRegions& regions,
                               const std::vector<std::string>& warnings);

/// The bytes of a PNG file with three rows: the scan, the wrapped head, and the wrapped head
/// coloured by its distance to the scan. Each row shows the surface from three sides.
std::string wrap_picture(const WrapTemplate& wrap_template, const Scan& scan,
                         const WrapResult& result, const HeadFrame& frame,
                         const std::string& title);

}  // namespace crowdface
