// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/wrap_inputs.h"

#include <algorithm>
#include <map>
#include <set>

#include "crowdface/config/input_files.h"
#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/folder.h"
#include "crowdface/core/log.h"
#include "crowdface/core/problems.h"
#include "crowdface/core/text.h"
#include "crowdface/core/units.h"
#include "crowdface/io/material_files.h"
#include "crowdface/io/mesh_as_obj.h"
#include "crowdface/io/read_mesh.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/pick/proposed_landmarks.h"
#include "crowdface/region/region_weights.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// Part of the digest of the inputs. Increase this number when a code change alters the resulting
/// heads, so that finished heads are wrapped again.
constexpr int kWrapVersion = 11;

Axis axis_of(const std::string& option, const std::string& text) {
  const auto axis = parse_axis(text);
  if (!axis) {
    throw UsageError(concat(option, ": expected an axis such as +Y, found ", quoted(text)));
  }
  return *axis;
}

/// Guesses the length unit: the unit in which the mesh has about the size of a human head with
/// neck.
LengthUnit guess_unit(const Positions& positions) {
  constexpr double kTypicalDiagonalMm = 430;
  return nearest_unit((positions.colwise().maxCoeff() - positions.colwise().minCoeff()).norm(),
                      kTypicalDiagonalMm, kMetricUnits);
}

/// Reads the heads of `--model`, computes the shape model, and sets `positions` to the model's
/// mean, in mm.
void read_model(const WrapOptions& options, WrapInputs& inputs, Positions& positions,
                Hasher& digest) {
  const std::vector<fs::path> files = list_heads(options.model);
  if (files.size() < 2) {
    refuse_file(options.model,
                concat("expected at least two heads in the template's topology (OBJ, "
                       "PLY, GLB, glTF, FBX, USD, NumPy), found ",
                       files.size()));
  }
  std::vector<Positions> heads;
  Problems problems;
  for (const fs::path& path : files) {
    const ObjFile head = read_mesh_as_obj(path);
    if (const std::string other = first_difference(inputs.file.topology, head.topology);
        !other.empty()) {
      problems.add(ExitCode::kBadData, concat(path.string(), ": expected the topology of ",
                                              options.template_file, ": ", other));
      continue;
    }
    digest.add(hash_file(path).digest);
    heads.emplace_back(head.positions * inputs.mm_per_unit);
  }
  problems.throw_if_any();
  inputs.model = make_shape_model(heads);
  inputs.model_head_count = heads.size();
  positions = inputs.model->mean;
}

/// Excludes the white areas of a mask from the fit: multiplies the skin's `ambient_visibility` by
/// 1 − mask.
void exclude_ignored_area(const std::string& mask, const ObjFile& file, WrapTemplate& wrap_template,
                          Hasher& digest) {
  const std::vector<double> ignored =
      mask_values(file.topology, file.uvs, MaskSource(mask), {}, file.path.string());
  for (std::size_t v = 0; v < wrap_template.skin.vertices.size(); ++v) {
    const double left = 1 - std::clamp(ignored[wrap_template.skin.vertices[v]], 0.0, 1.0);
    wrap_template.skin.ambient_visibility[v] *= left;
    digest.add(left);
  }
}

int texture_size_of(const WrapOptions& options) {
  constexpr std::uint64_t kMin = 64, kMax = 16384;
  if (options.texture_size.empty()) {
    if (options.removes_shading) throw UsageError("--delight: expected --texture SIZE, found none");
    return 0;
  }
  const auto size = parse_unsigned(options.texture_size);
  if (!size || *size < kMin || *size > kMax) {
    throw UsageError(concat("--texture: expected a whole number from ", kMin, " to ", kMax,
                            ", found ", quoted(options.texture_size)));
  }
  return static_cast<int>(*size);
}

std::optional<PoseHint> pose_hint(const WrapOptions& options) {
  if (options.scan_up.empty() && options.scan_front.empty()) return std::nullopt;
  if (options.scan_up.empty() || options.scan_front.empty()) {
    throw UsageError("--scan-up and --scan-front: expected both or neither, found one");
  }
  const PoseHint hint = {unit_vector(axis_of("--scan-up", options.scan_up)),
                         unit_vector(axis_of("--scan-front", options.scan_front))};
  if (hint.up.dot(hint.front) != 0) {
    throw UsageError(
        "--scan-up and --scan-front: expected two different axes, found the same axis");
  }
  return hint;
}

bool is_array(const fs::path& file) {
  return lower_case(file.extension().string()) == ".npy";
}

}  // namespace

LengthUnit parse_unit(const std::string& option, const std::string& text) {
  const auto unit = parse_length_unit(text);
  if (!unit)
    throw UsageError(concat(option, ": expected ", kUnitChoices, ", found ", quoted(text)));
  return *unit;
}

std::vector<fs::path> list_files_with_extensions(const fs::path& folder,
                                                 const std::vector<std::string>& endings) {
  std::error_code error;
  std::vector<fs::path> files = list_files(
      folder,
      [&](const fs::path& path) {
        const std::string ending = lower_case(path.extension().string());
        const bool is_hidden = path.filename().string().starts_with('.');
        return !is_hidden && std::ranges::find(endings, ending) != endings.end();
      },
      &error);
  if (error)
    throw MissingInput(concat(folder.string(), ": cannot read the folder: ", error.message()));
  return files;
}

std::vector<fs::path> list_scans(const fs::path& folder) {
  std::vector<std::string> endings(mesh_extensions().begin(), mesh_extensions().end());
  std::vector<fs::path> scans = list_files_with_extensions(folder, endings);
  // Omit .npy files that are not scans: a file with the name of a scan holds landmarks, and
  // faces.npy holds polygons.
  std::set<std::string> stems;
  for (const fs::path& scan : scans) {
    if (!is_array(scan)) stems.insert(scan.stem().string());
  }
  std::erase_if(scans, [&](const fs::path& scan) {
    return is_array(scan) && (stems.contains(scan.stem().string()) || !is_head_file(scan));
  });
  if (scans.empty()) {
    refuse_file(folder, concat("expected scans (", join(endings), "), found none"));
  }
  Problems problems;
  std::map<std::string, fs::path> names;
  for (const fs::path& scan : scans) {
    const std::string name = valid_head_name(scan.stem().string());
    if (const auto [before, added] = names.emplace(name, scan); !added) {
      problems.add(ExitCode::kUsage,
                   concat(before->second.string(), " and ", scan.string(),
                          " would be wrapped to the same head, ", quoted(name),
                          "; expected scans with different names, not counting accents and other "
                          "characters than letters (a-z), digits, '_', '-' and '.'"));
    } else if (const std::string why = objection_to_head_name(name, scan, {}); !why.empty()) {
      problems.add(ExitCode::kUsage, why);
    }
  }
  problems.throw_if_any();
  return scans;
}

WrapInputs read_wrap_inputs(const WrapOptions& options) {
  WrapInputs inputs;
  inputs.file = read_mesh_as_obj(options.template_file);
  for (const std::string& note : inputs.file.notes) {
    log_warning(concat(options.template_file, ": ", note));
  }
  Hasher digest;
  digest.add(kWrapVersion).add(hash_file(options.template_file).digest);
  const LengthUnit unit = options.units.empty() ? guess_unit(inputs.file.positions)
                                                : parse_unit("--units", options.units);
  inputs.mm_per_unit = mm_per(unit);
  inputs.frame = {axis_of("--up", options.up), axis_of("--front", options.front)};
  Positions positions = inputs.file.positions * inputs.mm_per_unit;
  if (!options.model.empty()) read_model(options, inputs, positions, digest);
  inputs.wrap_template =
      make_template(inputs.file.topology, positions,
                    {.front = unit_vector(inputs.frame.front), .up = unit_vector(inputs.frame.up)});
  inputs.regions = face_regions(inputs.wrap_template);
  if (inputs.model) inputs.model = skin_model(*inputs.model, inputs.wrap_template);
  if (!options.ignored_area_mask.empty())
    exclude_ignored_area(options.ignored_area_mask, inputs.file, inputs.wrap_template, digest);
  inputs.hint = pose_hint(options);
  const auto proposed = propose_landmarks(inputs.wrap_template);
  inputs.features = face_features(inputs.wrap_template, proposed);
  if (options.landmarks == kNoLandmarks) {
    digest.add("--landmarks none");
  } else {
    inputs.detected_landmarks = proposed;
  }
  if (!options.landmarks.empty() && options.landmarks != kNoLandmarks) {
    inputs.landmarks = read_landmarks(
        options.landmarks, options.batch.empty() ? LandmarkMesh::kScan : LandmarkMesh::kTemplate);
    digest.add(hash_file(options.landmarks).digest);
  }
  if (!options.template_landmarks.empty()) {
    inputs.landmarks.template_places =
        read_landmarks(options.template_landmarks, LandmarkMesh::kTemplate).template_places;
    digest.add(hash_file(options.template_landmarks).digest);
  }
  for (const std::string& text : {options.units, options.scan_units, options.up, options.front,
                                  options.scan_up, options.scan_front}) {
    digest.add(text);
  }
  if (options.estimate) digest.add("--estimate");
  if (options.strict) digest.add("--strict");
  inputs.texture_size = texture_size_of(options);
  if (inputs.texture_size > 0) {
    digest.add("--texture").add(inputs.texture_size).add(options.removes_shading ? 1 : 0);
    for (const MaterialFile& used :
         find_material_files(inputs.file.material_path(), inputs.file.material_libraries).files) {
      digest.add(hash_file(used.source).digest);
    }
  }
  inputs.digest = digest.digest();
  log_info(concat(options.template_file, ": ", inputs.wrap_template.skin.vertex_count(), " of ",
                  inputs.file.topology.vertex_count,
                  " vertices are skin; assumed unit: ", name_of(unit)));
  return inputs;
}

}  // namespace crowdface
