// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "crowdface/config/head_tags.h"
#include "crowdface/config/input_files.h"
#include "crowdface/config/starter_config.h"
#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/log.h"
#include "crowdface/core/output_file.h"
#include "crowdface/core/problems.h"
#include "crowdface/core/text.h"
#include "crowdface/core/units.h"
#include "crowdface/heads/alignment_check.h"
#include "crowdface/heads/load_inputs.h"
#include "crowdface/io/image.h"
#include "crowdface/io/mesh_as_obj.h"
#include "crowdface/io/tile_files.h"
#include "crowdface/mesh/adjacency.h"
#include "crowdface/paint/face_marks.h"
#include "crowdface/paint/proposed_masks.h"
#include "crowdface/region/mask_source.h"

#include "cli/commands.h"
#include "cli/common_options.h"

namespace crowdface::cli {
namespace {

namespace fs = std::filesystem;

/// Returns whether an image is a mask of three regions.
bool has_three_regions(const fs::path& image) {
  try {
    return mask_channel_indices(read_image(image)).size() == 3;
  } catch (const RecoverableError&) {
    throw_if_interrupted();
    return false;
  }
}

/// Returns the file name of the three-region mask that `synth` or `import` wrote into the folder of
/// the heads; empty if there is no such mask.
std::string find_mask(const fs::path& heads) {
  for (const char* name : {"regions.png", "makehuman_bands.png", "ict_bands.png"}) {
    if (is_file(heads / name) && has_three_regions(heads / name)) return name;
  }
  const char* tiles = "ict_bands.<UDIM>.png";
  const std::vector<fs::path> files = find_tiles(heads / tiles);
  return !files.empty() && has_three_regions(files.front()) ? tiles : "";
}

void throw_if_any(const Complaints& complaints) {
  Problems problems;
  complaints.report_to(problems);
  problems.throw_if_any();
}

/// Reads the heads' tags from tags.yaml in their folder.
/// \throws InvalidInput if the file is not valid.
std::vector<std::vector<std::string>> read_tags(const std::vector<fs::path>& files,
                                                const std::vector<std::string>& names) {
  Complaints complaints;
  ConfigDraft draft(complaints);
  draft.are_heads_known = true;
  Config::Faces& faces = draft.config.faces;
  faces.files = files;
  faces.names = names;
  faces.tags.resize(names.size());
  read_tags_from_head_folders(faces, draft);
  add_age_tags(faces);
  throw_if_any(complaints);
  return faces.tags;
}

/// Name of the folder into which `synth` and `import` write attachments.
constexpr const char* kAttachments = "attachments";

/// Returns whether there is a folder of attachments beside the heads, and at least one head may
/// wear at least one of the attachments.
bool has_wearable_attachments(const fs::path& heads, const StarterFacts& facts) {
  if (!is_file(heads / kAttachments / "attachments.yaml")) return false;
  Complaints complaints;
  const bool any = has_attachments(heads / kAttachments, facts, complaints);
  throw_if_any(complaints);
  return any;
}

struct InitOptions : CommonOptions {
  std::string heads, out = "crowd.yaml";
  bool force = false;
};

void declare_init(CLI::App& command, InitOptions& options) {
  add_option(command, "heads", options.heads, "HEADS_DIR", "The folder of heads").required();
  add_option(command, "-o,--output", options.out, "CONFIG", "The config to write");
  add_flag(command, "--force", options.force, "Replace an existing file");
}

/// Formats a number below 1 with four decimals, and any other number with two decimals.
std::string format_number_of(double value) {
  return format_fixed(value, value < 1 ? 4 : 2);
}

constexpr std::size_t kHeadsLookedAt = 8;

/// Properties of the heads that are computed from the shapes of the heads.
struct ShapeAnalysis {
  Positions first;                         ///< vertex positions of the first head
  std::optional<Orientation> orientation;  ///< up and front axes of the heads; nothing: not found
  std::optional<PaintedMasks> masks;
  bool has_uvs = true;
  /// whether at least one head is rotated or shifted relative to the other heads
  bool has_misaligned_head = false;
  /// distance from the eyes to the mouth, in mesh units; 0: no face was found
  double eyes_to_mouth = 0;
};

/// Removes heads that the command `check` would refuse because of their pose, and logs warnings. A
/// mean that included these heads would not look like a human face.
void remove_odd_heads(HeadSet& set, const Components& components) {
  const std::vector<HeadPose> poses = head_poses(set, components);
  std::vector<Head> kept;
  for (std::size_t h = 0; h < poses.size(); ++h) {
    const std::string objection = objection_to_pose(poses[h], set.heads[h].name);
    if (objection.empty()) {
      kept.push_back(std::move(set.heads[h]));
    } else {
      log_warning(objection);
    }
  }
  set.heads = std::move(kept);
}

/// Analyses the shapes of some of the heads. If no regions can be proposed, logs a warning instead
/// of failing, because a config without regions is valid.
ShapeAnalysis analyse_shapes(const std::vector<fs::path>& files, bool with_masks) {
  Config::Faces faces;
  for (std::size_t i = 0; i < std::min(files.size(), kHeadsLookedAt); ++i) {
    faces.files.push_back(files[i * files.size() / std::min(files.size(), kHeadsLookedAt)]);
    faces.names.push_back(faces.files.back().stem().string());
  }
  Problems problems;
  auto set = load_head_set(faces, {}, problems);
  if (!set) {
    throw_if_interrupted();
    log_warning(concat("no regions: ", problems.messages().front()));
    return {read_mesh_as_obj(files[0]).positions, {}, {}};
  }
  // Align the heads in the same way as the new config does, because only the mean of aligned heads
  // looks like a human face.
  const Components components = find_components(build_adjacency(set->topology));
  remove_odd_heads(*set, components);
  const bool has_misaligned_head = needs_rigid_alignment(*set, components);
  if (has_misaligned_head) align_heads(*set, components, Align::kRigid);
  const HeadShape mean = mean_head_shape(*set);
  ShapeAnalysis analysis{set->heads[0].positions, find_orientation(set->topology, mean), {}};
  if (const auto marks =
          find_face_marks(set->topology, mean,
                          axes_of(analysis.orientation.value_or(Orientation{{1, 1}, {2, 1}})))) {
    analysis.eyes_to_mouth = marks->eye_to_mouth();
  }
  analysis.has_uvs = set->uvs.rows() > 0;
  analysis.has_misaligned_head = has_misaligned_head;
  if (!with_masks) return analysis;
  try {
    const Orientation orientation = analysis.orientation.value_or(Orientation{{1, 1}, {2, 1}});
    analysis.masks = propose_masks(*set, mean, orientation, parse_bands("brow,nose,mouth"),
                                   mask_side_texels(set->topology.vertex_count));
  } catch (const InvalidInput& error) {
    log_warning(concat("no regions: ", error.what()));
  }
  return analysis;
}

/// Guesses the length unit of the meshes: the named unit in which the face (or, if no face was
/// found, the head) has the size of a human's. Tries inches and feet last. If no named unit fits,
/// computes the length of a unit that gives the face human size.
void guess_units(const ShapeAnalysis& analysis, StarterFacts& facts) {
  constexpr double kTypicalHeightMm = 280;  // of a head with or without neck
  constexpr double kTypicalFaceMm = 65, kMinFaceMm = 35, kMaxFaceMm = 120;
  constexpr double kMaxTimes = 3;  // largest plausible ratio to kTypicalHeightMm
  facts.units = nearest_unit(facts.head_height, kTypicalHeightMm, kMetricUnits);
  const std::string height =
      concat("the first head is ", format_number_of(facts.head_height), " units tall");
  facts.units_reason = height;
  const double face_mm = analysis.eyes_to_mouth * mm_per(facts.units);
  const double times = facts.head_height * mm_per(facts.units) / kTypicalHeightMm;
  const auto is_human = [&](double mm) { return mm >= kMinFaceMm && mm <= kMaxFaceMm; };
  if (analysis.eyes_to_mouth > 0 && !is_human(face_mm)) {
    const LengthUnit named = nearest_unit(analysis.eyes_to_mouth, kTypicalFaceMm, kLengthUnits);
    facts.units = is_human(analysis.eyes_to_mouth * mm_per(named))
                      ? named
                      : fitting_unit(analysis.eyes_to_mouth, kTypicalFaceMm);
    facts.units_reason = concat(height, " and ", format_number_of(analysis.eyes_to_mouth),
                                " from the eyes to the mouth (about ", kTypicalFaceMm,
                                " mm in people), and mm, cm and m do not fit");
  } else if (analysis.eyes_to_mouth == 0 && (times > kMaxTimes || times < 1 / kMaxTimes)) {
    facts.units = fitting_unit(facts.head_height, kTypicalHeightMm);
    facts.units_reason = concat(height, ", and mm, cm and m do not fit");
  }
}

void refuse_existing(const fs::path& file, bool force) {
  if (!force && path_exists(file)) {
    throw UsageError(concat(file.string(), ": already exists; use --force to replace it"));
  }
}

/// Returns the names that the new config gives to the heads.
/// \throws InvalidInput if the command `check` would refuse a name; UsageError if it would refuse a
///         path; MissingInput if a file is a link to a missing file.
std::vector<std::string> valid_head_names(const std::vector<fs::path>& files) {
  std::vector<std::string> names;
  for (const std::string& name : names_of_heads(files)) {
    const fs::path& file = files[names.size()];
    if (!path_exists(file)) {
      throw MissingInput(concat(file.string(), ": is a link to a file that is missing"));
    }
    require_storable_path(file);
    const std::string objection = objection_to_head_name(name, file, names);
    if (!objection.empty()) throw InvalidInput(objection);
    names.push_back(name);
  }
  return names;
}

void init(const InitOptions& options) {
  const fs::path heads = options.heads, out = options.out;
  const std::vector<fs::path> files = list_heads(heads);
  if (files.size() < kMinHeads || files.size() > kMaxHeads) {
    const std::string left_out = left_out_meshes_message(heads);
    throw MissingInput(
        concat(heads.string(), ": expected ", kMinHeads, " to ", kMaxHeads,
               " heads (OBJ, PLY, GLB, glTF, FBX, USD, NumPy), found ", files.size(),
               left_out.empty() ? suggested_head_pattern(heads) : concat("; ", left_out)));
  }
  if (const std::string left_out = left_out_meshes_message(heads); !left_out.empty()) {
    log_warning(left_out);
  }
  // Refuse to overwrite inputs or an existing config.
  const fs::path file = checked_output_path(out);
  refuse_to_write_over(files, {file});
  std::string mask = find_mask(heads);
  std::vector<fs::path> beside = find_tiles(heads / mask);
  beside.push_back(heads / mask);
  beside.push_back(heads / "tags.yaml");
  beside.push_back(heads / kAttachments / "attachments.yaml");
  refuse_to_write_over(beside, {file});
  refuse_existing(file, options.force);
  // Collect the facts about the heads that the new config states.
  StarterFacts facts;
  facts.head_names = valid_head_names(files);
  const fs::path here = fs::absolute(file).lexically_normal().parent_path();
  facts.heads_folder = fs::absolute(heads).lexically_normal().lexically_relative(here);
  require_storable_path(facts.heads_folder);
  const ShapeAnalysis analysis = analyse_shapes(files, mask.empty());
  if (!analysis.has_uvs && !mask.empty()) {
    log_warning(concat("no regions: the heads have no texture coordinates, which the mask ", mask,
                       " needs"));
    mask.clear();
  }
  if (analysis.orientation) {
    facts.up = analysis.orientation->up;
    facts.front = analysis.orientation->front;
  }
  facts.uses_rigid_alignment = analysis.has_misaligned_head;
  const auto up = analysis.first.col(facts.up.index);
  facts.head_height = up.maxCoeff() - up.minCoeff();
  guess_units(analysis, facts);
  facts.vertex_count = analysis.first.rows();
  facts.crowd_name = "crowd";
  facts.tags = read_tags(files, facts.head_names);
  if (!mask.empty()) facts.mask_file = (facts.heads_folder / mask).string();
  // Propose a region mask if there is no mask for the heads.
  MaskFiles proposed;
  if (analysis.masks) {
    proposed = encode_masks(*analysis.masks, here / concat(file.stem().string(), "_bands.png"));
    for (const auto& [path, bytes] : proposed.png_files) refuse_existing(path, options.force);
    facts.mask_file = proposed.mask_paths[0].filename().string();
    facts.regions = {"brow", "nose", "mouth"};
  }
  if (has_wearable_attachments(heads, facts))
    facts.attachments_folder = facts.heads_folder / kAttachments;
  // Write the files, and report the guessed values so that the user can check them.
  for (const auto& [path, bytes] : proposed.png_files) write_file(path, bytes);
  write_file(file, starter_config(facts));
  log_info(concat(out.string(), ": a config for ", files.size(),
                  " heads; assumed unit: ", name_of(facts.units), ", because ", facts.units_reason,
                  "; the heads look along ", name_of(facts.front), " with ", name_of(facts.up),
                  " up. Check these, then run: crowdface check ", out.string()));
  if (facts.uses_rigid_alignment) {
    log_info(
        "some heads are turned or moved relative to the others: the config aligns all heads with "
        "the first (faces.align: rigid)");
  }
  if (!facts.attachments_folder.empty()) {
    log_info(
        "the faces get the attachments beside the heads; heads tagged female and male form "
        "separate "
        "groups of women and men");
  }
  if (!facts.mask_file.empty()) {
    log_info(concat(
        "regions ", join(facts.regions), ": ",
        mask.empty() ? concat(proposed.mask_paths[0].string(), ", proposed from the heads' shape")
                     : (heads / mask).string()));
  }
}

}  // namespace

CommandAction add_init(CLI::App& program) {
  return add_command(program, "init", "Write a commented starter config for a folder of heads",
                     declare_init, init);
}

}  // namespace crowdface::cli
