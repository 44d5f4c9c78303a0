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
#include "crowdface/crowd/shard.h"
#include "crowdface/io/obj_file.h"
#include "crowdface/pick/landmark_file.h"
#include "crowdface/wrap/report.h"
#include "crowdface/wrap/wrap.h"

namespace crowdface {

/// The options of `crowdface wrap`, as the user typed them; `crowdface wrap --help` explains them.
/// An empty value means that the option was not given.
struct WrapOptions {
  std::string template_file;  ///< mesh file of the template
  std::string scan;       ///< file of one scan; if given, `out` is the file of the head to write
  std::string batch;      ///< folder of scans; if given, `out` is the folder of the heads to write
  std::string out;        ///< file or folder to write; depends on `scan` and `batch`
  std::string landmarks;  ///< file of landmarks, or kNoLandmarks
  std::string template_landmarks;  ///< file of the template's landmarks
  std::string model;               ///< folder of heads, from which a shape model is computed
  std::string ignored_area_mask;   ///< mask of the template's areas that the fit ignores
  std::string units, scan_units, up = "+Y", front = "+Z", scan_up, scan_front;
  std::string texture_size;  ///< side length of the textures to bake, in texels
  /// the command options of the same names
  bool no_pictures = false, force = false, dry_run = false, estimate = false;
  bool removes_shading = false;  ///< `--delight`: see BakeOptions::removes_shading
  bool strict = false;  ///< whether to refuse heads with a doubtful feature or a misplaced landmark
  Shard shard;          ///< the part of the batch to wrap
};

/// A value of `--landmarks`: the program neither reads landmarks from files nor detects landmarks.
inline constexpr const char* kNoLandmarks = "none";

/// The inputs of `crowdface wrap` that are equal for all scans.
struct WrapInputs {
  ObjFile file;                  ///< the template
  double mm_per_unit = 10;       ///< millimetres per unit of the template
  HeadFrame frame;               ///< up and front axes of the template
  std::optional<PoseHint> hint;  ///< up and front directions of the scans; empty if unknown
  WrapTemplate wrap_template;    ///< the template's mesh, separated into skin and other parts
  /// regions of the template's skin, for which reports list the distances to the scan
  SkinRegions regions;
  std::optional<ShapeModel> model;   ///< statistical shape model in the template's topology
  std::size_t model_head_count = 0;  ///< number of heads of the shape model
  LandmarkFile landmarks;            ///< landmarks that the user gave; empty if none
  /// The landmarks that the program can detect on a scan: for the name of each landmark, the vertex
  /// of the template at this landmark.
  std::map<std::string, std::uint32_t> detected_landmarks;
  /// mouth, nose, eyes and ears of the template, as far as its landmarks are known
  std::vector<FaceFeature> features;
  int texture_size = 0;  ///< texels per side of baked textures; 0: none
  Digest digest;         ///< hash of all inputs in this struct
};

/// Reads the files that the options name. \throws Error that names the faulty file or option.
WrapInputs read_wrap_inputs(const WrapOptions& options);

/// Parses a length unit. \throws UsageError naming the option.
LengthUnit parse_unit(const std::string& option, const std::string& text);

/// Lists the files in a folder with one of these extensions, sorted by name. Omits hidden files.
/// \param endings  lower-case extensions, such as ".obj". \throws MissingInput.
std::vector<std::filesystem::path> list_files_with_extensions(
    const std::filesystem::path& folder, const std::vector<std::string>& endings);

/// Lists the scans in a folder, sorted by name. Omits array files (.npy) that hold landmarks or
/// polygons instead of a scan.
/// \throws MissingInput; UsageError if a scan would give a head with a reserved name or with the
/// name of another head; InvalidInput if there are no scans.
std::vector<std::filesystem::path> list_scans(const std::filesystem::path& folder);

}  // namespace crowdface
