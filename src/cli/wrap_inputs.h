// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/core/hash.h"
#include "crowdface/core/units.h"
#include "crowdface/io/obj_file.h"
#include "crowdface/pick/landmark_file.h"
#include "crowdface/wrap/report.h"
#include "crowdface/wrap/wrap.h"

#include "cli/common_options.h"

namespace crowdface::cli {

struct WrapOptions : CommonOptions {
  std::string first, scan, shape, landmarks, template_landmarks, model, ignore, out, batch;
  std::string units, scan_units, up = "+Y", front = "+Z", scan_up, scan_front;
  std::string port = "0";  ///< of the page of --pick
  bool no_pictures = false, force = false, dry_run = false, pick = false, no_browser = false;
  bool estimate = false;
};

/// What all scans of a run share.
struct WrapInputs {
  ObjFile file;    ///< the template
  double mm = 10;  ///< in one unit of the template
  HeadFrame frame;
  std::optional<PoseHint> hint;
  WrapTemplate shape;
  SkinRegions regions;              ///< of its skin
  std::optional<ShapeModel> model;  ///< of the template's skin
  std::size_t model_heads = 0;
  LandmarkFile landmarks;
  std::map<std::string, std::uint32_t> proposed;  ///< of the template, if there is a hint
  Digest digest;                                  ///< of all of this
};

/// \throws Error naming the file or option that is wrong.
WrapInputs read_wrap_inputs(const WrapOptions& options);

/// The unit of that name. \throws UsageError naming the option.
LengthUnit unit_of(const std::string& option, const std::string& text);

/// Files in the folder with one of these endings, in lower case, by name. \throws MissingInput.
std::vector<std::filesystem::path> files_of(const std::filesystem::path& folder,
                                            const std::vector<std::string>& endings);

/// The scans in a folder, by name. \throws MissingInput; UsageError if two have the name of one head;
/// InvalidInput if there are none.
std::vector<std::filesystem::path> scans_in(const std::filesystem::path& folder);

}  // namespace crowdface::cli
