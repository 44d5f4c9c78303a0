// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/wrap_scans.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "crowdface/config/input_files.h"
#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/log.h"
#include "crowdface/core/output_file.h"
#include "crowdface/core/problems.h"
#include "crowdface/core/progress.h"
#include "crowdface/core/text.h"
#include "crowdface/core/units.h"
#include "crowdface/io/obj_writer.h"
#include "crowdface/io/read_mesh.h"
#include "crowdface/paint/face_marks.h"
#include "crowdface/pick/found_landmarks.h"
#include "crowdface/pick/landmark_lists.h"
#include "crowdface/pick/suggested_places.h"
#include "crowdface/run/wrap_inputs.h"
#include "crowdface/run/wrap_page.h"
#include "crowdface/run/wrap_textures.h"
#include "crowdface/wrap/report.h"
#include "crowdface/wrap/scan_face.h"
#include "crowdface/wrap/scan_file.h"
#include "crowdface/wrap/wrap.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// A scan and its output files.
struct Task {
  fs::path scan, own_landmarks, head, report, picture;
  TextureFiles textures = {};  ///< empty without --texture
};

/// Whether a file that has the name of a scan holds landmarks; warns if it does not, because a text
/// or JSON file may hold other data.
bool holds_landmarks(const fs::path& file) {
  try {
    read_landmarks(file);
    return true;
  } catch (const RecoverableError& error) {
    log_warning(concat(error.what(), "; the file is not used"));
    return false;
  }
}

Task make_task(const fs::path& scan, const fs::path& head, const fs::path& reports) {
  const std::string name = head.stem().string();
  Task task{scan, scan, head, reports / concat(name, ".wrap.json"),
            reports / concat(name, ".wrap.png")};
  task.own_landmarks.clear();
  const auto take = [&](const std::string& ending, const auto& is_wanted) {
    const fs::path beside = scan.parent_path() / concat(scan.stem().string(), ending);
    if (task.own_landmarks.empty() && beside != scan && path_exists(beside) && is_wanted(beside))
      task.own_landmarks = beside;
  };
  for (const char* ending : {".yaml", ".pp", "_picked_points.pp", ".mrk.json"}) {
    take(ending, [](const fs::path&) { return true; });
  }
  for (const std::string& ending : landmark_extensions()) take(ending, holds_landmarks);
  return task;
}

std::vector<Task> tasks_without_textures(const WrapOptions& options) {
  if (options.batch.empty()) {
    const fs::path head = checked_output_path(options.out);
    return {make_task(options.scan, head, head.parent_path())};
  }
  std::vector<Task> tasks;
  for (const fs::path& scan : list_scans(options.batch)) {
    const std::string name = valid_head_name(scan.stem().string());
    if (name != scan.stem().string()) {
      log_warning(concat(scan.string(), ": its head is called ", quoted(name),
                         ", because a head's name has only letters (a-z), digits, '_', '-' and "
                         "'.'"));
    }
    tasks.push_back(make_task(scan, fs::path(options.out) / concat(name, ".obj"),
                              fs::path(options.out) / "reports"));
  }
  return tasks;
}

std::vector<Task> tasks_of(const WrapOptions& options, const LandmarkFile& given,
                           const WrapTextures* textures) {
  std::vector<Task> tasks = tasks_without_textures(options);
  const bool has_given = options.batch.empty() && !given.scan_places.empty();
  if (options.landmarks == kNoLandmarks || has_given) {
    for (Task& task : tasks) task.own_landmarks.clear();
  }
  if (const fs::path& beside = tasks.front().own_landmarks;
      options.batch.empty() && !beside.empty()) {
    log_info(concat(options.scan, ": uses the landmarks in ", beside.string(), ", beside the scan",
                    " (--landmarks none: no landmarks)"));
  }
  if (textures == nullptr) return tasks;
  for (Task& task : tasks) {
    task.textures = textures->files_of(task.head, task.report.parent_path());
  }
  return tasks;
}

void refuse_to_write_over_inputs(const WrapOptions& options, const std::vector<Task>& tasks) {
  std::vector<fs::path> inputs = {options.template_file, options.ignored_area_mask};
  if (options.landmarks != kNoLandmarks) inputs.emplace_back(options.landmarks);
  if (!options.model.empty()) {
    for (fs::path& head : list_heads(options.model)) inputs.push_back(std::move(head));
  }
  std::vector<fs::path> outputs;
  for (const Task& task : tasks) {
    inputs.insert(inputs.end(), {task.scan, task.own_landmarks});
    outputs.insert(outputs.end(), {task.head, task.report, task.picture});
    const std::vector<fs::path> textures = task.textures.all_paths();
    outputs.insert(outputs.end(), textures.begin(), textures.end());
  }
  refuse_to_write_over(inputs, outputs);
}

Digest inputs_of(const WrapInputs& shared, const Task& task) {
  Hasher hasher;
  hasher.add(shared.digest).add(hash_file(task.scan).digest);
  if (!task.own_landmarks.empty()) hasher.add(hash_file(task.own_landmarks).digest);
  if (shared.texture_size > 0) add_texture_files(task.scan, hasher);
  return hasher.digest();
}

/// Returns whether the task's report contains the digests of these inputs and of the existing head,
/// and whether the textures exist.
bool is_done(const Task& task, const Digest& inputs) {
  if (!path_exists(task.report) || !path_exists(task.head)) return false;
  if (!std::ranges::all_of(task.textures.all_paths(), path_exists)) return false;
  const std::string report = read_file(task.report);
  return report.find(concat("\"inputs\": \"", inputs.hex(), '"')) != std::string::npos &&
         report.find(concat("\"mesh\": \"", hash_file(task.head).digest.hex(), '"')) !=
             std::string::npos;
}

LandmarkFile landmarks_for(const WrapInputs& shared, const Task& task) {
  LandmarkFile file = shared.landmarks;
  if (task.own_landmarks.empty()) return file;
  const LandmarkFile own = read_landmarks(task.own_landmarks);
  for (const auto& [name, place] : own.template_places) file.template_places[name] = place;
  for (const auto& [name, place] : own.scan_places) file.scan_places[name] = place;
  return file;
}

/// Returns the landmarks from the files. If the files have too few landmarks, searches the scan for
/// a face, and adds landmarks that are detected from the scan's shape. Adds none if the scan's pose
/// is unknown and no face is found.
/// \param hint  The caller passes the pose of the scan, or an empty value if the pose is unknown.
///     If the function finds a face, it stores the face in `hint->face`. If `hint` was empty, the
///     function also stores the face's axes as the pose of the scan.
std::vector<WrapLandmark> landmarks_on(const WrapInputs& shared, const Task& task, const Scan& scan,
                                       std::optional<PoseHint>& hint) {
  const LandmarkFile file = landmarks_for(shared, task);
  std::vector<WrapLandmark> landmarks = match_landmarks(file, shared.file.positions, scan);
  if (landmarks.empty() && !file.scan_places.empty()) {
    log_warning(concat(task.scan.string(), ": none of its ", file.scan_places.size(),
                       " landmarks (", file.scan_places.begin()->first,
                       ", …) has the name of a template landmark: ",
                       "name template landmarks with --template-landmarks, or under template in "
                       "the YAML file"));
  }
  if (landmarks.size() >= kMinLandmarks) return landmarks;
  auto face = find_scan_face(scan, hint);
  if (hint) {
    hint->face = std::move(face);
  } else {
    if (!face) return landmarks;
    hint = PoseHint{face->axes.up, face->axes.front, face};
    const Orientation orientation = all_orientations()[face->nearest_orientation_index];
    log_info(concat(task.scan.string(), ": found a face that looks along ",
                    name_of(orientation.front), " with ", name_of(orientation.up), " up"));
  }
  std::vector<std::string> found;
  for (WrapLandmark& landmark :
       find_landmarks(shared.wrap_template, shared.detected_landmarks, scan, *hint)) {
    if (std::ranges::any_of(landmarks, [&](const auto& l) { return l.name == landmark.name; })) {
      continue;
    }
    found.push_back(landmark.name);
    landmarks.push_back(std::move(landmark));
  }
  if (!found.empty()) {
    log_info(concat(task.scan.string(), ": ", found.size(),
                    " landmarks detected from the shape: ", join(found)));
  }
  return landmarks;
}

/// Returns the factor by which to scale the wrapped head to the size of the scan. If the unit of
/// the scan is not given, the factor is 1: the head keeps the size of the template. \throws
/// UsageError if the factor is implausible.
double output_scale(const WrapOptions& options, const Similarity& pose) {
  if (options.scan_units.empty()) return 1;
  const auto fits = [](double scale) {
    constexpr double kMax = 1.5;
    return scale <= kMax && scale >= 1 / kMax;
  };
  const double scale = pose.scale * mm_per(parse_unit("--scan-units", options.scan_units));
  if (fits(scale)) return scale;
  std::string expected = "another unit";
  for (const LengthUnit unit : kLengthUnits) {
    if (fits(pose.scale * mm_per(unit))) expected = name_of(unit);
  }
  throw UsageError(concat("--scan-units ", options.scan_units, ": the head would be ",
                          format_fixed(scale, 3), " times as large as the template; expected ",
                          expected, ", or none"));
}

/// Leave-one-out check: returns, for each landmark, the distance from the position that the other
/// landmarks predict. Empty for fewer than five landmarks.
std::map<std::string, double> leave_one_out_distances(const WrapInputs& shared,
                                                      const std::vector<WrapLandmark>& landmarks) {
  constexpr std::size_t kMin = 5;
  std::map<std::string, double> result;
  std::vector<PickedLandmark> picked;
  for (const WrapLandmark& one : landmarks) {
    picked.push_back({one.name, one.vertex, one.scan_position, std::nullopt});
  }
  if (picked.size() < kMin) return result;
  const auto pose = fit_pose_to_picked(picked, shared.wrap_template.positions);
  if (!pose) return result;
  for (const auto& [name, residual] : pose->residuals) result[name] = residual.distance_mm;
  return result;
}

/// Returns hints for an error message if landmarks are missing: whether the scan shows only a part
/// of a head, and whether the relief of the scan shows a face with axes other than --scan-up and
/// --scan-front.
std::string likely_causes(const WrapInputs& shared, const Scan& scan,
                          const std::vector<WrapLandmark>& landmarks) {
  constexpr double kPart = 0.3;  // fraction of a head's surface that may be missing
  const auto picked = std::ranges::count(landmarks, false, &WrapLandmark::is_found_by_program);
  if (picked >= static_cast<std::ptrdiff_t>(kMinLandmarks)) return {};
  std::string part =
      net_area_fraction(scan) < kPart
          ? ""
          : "; the scan seems to be only a part of a head, which cannot be placed without "
            "landmarks: pick four or more";
  if (!shared.hint) return part;
  const auto face = find_scan_face(scan, std::nullopt);
  if (!face) return part;
  const Orientation found = all_orientations()[face->nearest_orientation_index];
  if (shared.hint->up == unit_vector(found.up) && shared.hint->front == unit_vector(found.front))
    return part;
  return concat(part, part.empty() ? "; the scan seems to look" : "; or it looks", " along ",
                name_of(found.front), " with ", name_of(found.up), " up: use --scan-up ",
                name_of(found.up), " --scan-front ", name_of(found.front));
}

void wrap_one(const WrapOptions& options, const WrapInputs& shared, const WrapTextures* textures,
              const Task& task, const Digest& inputs) {
  FileMesh mesh = read_mesh(task.scan);
  const Scan scan = scan_of(mesh, task.scan);
  for (const std::string& note : scan.notes) log_warning(concat(task.scan.string(), ": ", note));
  // Fit the template to the scan, and refuse a bad fit.
  std::optional<PoseHint> hint = shared.hint;
  const std::vector<WrapLandmark> landmarks = landmarks_on(shared, task, scan, hint);
  // Eyeballs would pull the lids over the eyes.
  const Scan skin = keep_skin(scan);
  const WrapResult result = [&] {
    try {
      WrapResult wrapped =
          wrap_checked(shared.wrap_template, shared.model ? &*shared.model : nullptr,
                       shared.features, skin, landmarks, hint);
      refuse_bad_wrap(shared.wrap_template, wrapped, shared.regions);
      return wrapped;
    } catch (const InvalidInput& error) {
      throw InvalidInput(
          concat(task.scan.string(), ": ", error.what(), likely_causes(shared, scan, landmarks)));
    }
  }();
  // Write head, image and report.
  const double scale = output_scale(options, result.pose);
  const std::vector<std::string> warnings =
      wrap_warnings(shared.wrap_template, result, shared.regions, shared.model_head_count);
  WrapFacts facts{options.template_file,
                  task.scan.string(),
                  inputs.hex(),
                  {},
                  scale,
                  leave_one_out_distances(shared, landmarks)};
  if (!options.no_pictures) {
    write_file(task.picture, wrap_picture(shared.wrap_template, scan, result, shared.frame,
                                          task.scan.filename().string()));
  }
  if (const auto doubts = doubtful_part_warnings(shared.wrap_template, result);
      options.strict && !doubts.empty()) {
    write_file(task.report,
               format_wrap_report(facts, shared.wrap_template, result, shared.regions, warnings));
    throw InvalidInput(concat(task.scan.string(), ": --strict: ", join(doubts, "; ")));
  }
  EncodedFile head = encode_obj_like(shared.file, shared.file.topology,
                                     Positions(result.positions * (scale / shared.mm_per_unit)),
                                     task.head.string());
  if (textures != nullptr) {
    const ScanColours colours(std::move(mesh), task.scan);
    for (const std::string& warning : colours.warnings()) log_warning(warning);
    if (!colours.has_colours()) {
      throw InvalidInput(concat(task.scan.string(),
                                ": --texture: expected a texture or colours at vertices, found "
                                "neither: an OBJ file names its texture in a material file"));
    }
    facts.share_without_scan = textures->write(result, skin, colours, task.textures);
    head = textures->with_material_lines(std::move(head), task.textures);
  }
  head.write(task.head);
  facts.mesh_digest = head.digest().hex();
  if (options.estimate) {
    facts.cross_validated_wrap_errors_mm = cross_validate_wrap(
        shared.wrap_template, shared.model ? &*shared.model : nullptr, skin, landmarks, hint);
  }
  write_file(task.report,
             format_wrap_report(facts, shared.wrap_template, result, shared.regions, warnings));
  for (const std::string& warning : warnings) {
    log_warning(concat(task.scan.string(), ": ", warning));
  }
  const WrapDistances distances = measure_distances(shared.wrap_template, result);
  log_info(concat(task.scan.string(), ": ", task.head.string(), ", ",
                  format_fixed(distances.median_mm, 2),
                  " mm from the scan (95 %: ", format_fixed(distances.percentile_95_mm, 2), "), ",
                  result.landmarks.size(), " landmarks",
                  result.dropped_landmarks.empty()
                      ? ""
                      : concat("; wrong and not used: ", join(result.dropped_landmarks))));
}

/// Writes the HTML page about all scans of the batch, including the scans of other shards.
void write_page(const WrapOptions& options, const std::vector<Task>& tasks) {
  std::vector<WrappedScan> scans;
  for (const Task& task : tasks) scans.push_back({task.scan, task.report, task.picture});
  const fs::path page = fs::path(options.out) / "reports" / "index.html";
  write_file(page, wrap_page(scans));
  log_info(concat("all scans, the most doubtful first: ", page.string()));
}

void check_one(const WrapInputs& shared, const Task& task) {
  const Scan scan = read_scan(task.scan);
  std::optional<PoseHint> hint = shared.hint;
  const auto landmarks = landmarks_on(shared, task, scan, hint);
  log_info(concat(task.scan.string(), ": ", scan.triangles.size(), " triangles, ", landmarks.size(),
                  " landmarks; would be wrapped to ", task.head.string()));
}

}  // namespace

void wrap_scans(const WrapOptions& options) {
  const WrapInputs shared = read_wrap_inputs(options);
  std::optional<WrapTextures> textures;
  if (shared.texture_size > 0) textures.emplace(options, shared);
  const WrapTextures* const wrap_textures = textures ? &*textures : nullptr;
  const std::vector<Task> tasks = tasks_of(options, shared.landmarks, wrap_textures);
  refuse_to_write_over_inputs(options, tasks);
  if (!options.dry_run && !options.batch.empty()) {
    make_directories(fs::path(options.out) / "reports");
    remove_temporary_files(options.out);
  }
  std::vector<Task> own;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    if (options.shard.owns(i)) own.push_back(tasks[i]);
  }
  Progress progress("scans", own.size());
  Problems problems;
  std::size_t done = 0;
  for (const Task& task : own) {
    throw_if_interrupted();
    try {
      const Digest inputs = inputs_of(shared, task);
      if (!options.force && is_done(task, inputs)) {
        ++done;
      } else if (options.dry_run) {
        check_one(shared, task);
      } else {
        wrap_one(options, shared, wrap_textures, task, inputs);
      }
    } catch (const RecoverableError& error) {
      // An interruption or a failed write ends the command.
      if (error.code() == ExitCode::kInterrupted || error.code() == ExitCode::kIoError) throw;
      // After all other errors, record the problem of this scan and continue with the next scan.
      problems.add(error);
    }
    progress.step();
  }
  if (done > 0) log_info(concat(done, " of ", own.size(), " scans are already wrapped"));
  if (!options.dry_run && !options.batch.empty()) write_page(options, tasks);
  problems.throw_if_any();
}

}  // namespace crowdface
