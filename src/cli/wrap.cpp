// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/wrap.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/length_units.h"
#include "crowdface/core/log.h"
#include "crowdface/core/output_file.h"
#include "crowdface/core/problems.h"
#include "crowdface/core/progress.h"
#include "crowdface/core/text.h"
#include "crowdface/core/version.h"
#include "crowdface/io/obj_file.h"
#include "crowdface/io/obj_writer.h"
#include "crowdface/region/region_weights.h"
#include "crowdface/wrap/report.h"
#include "crowdface/wrap/scan_file.h"

#include "cli/commands.h"
#include "cli/common_options.h"
#include "cli/landmark_file.h"

namespace crowdface::cli {
namespace {

namespace fs = std::filesystem;

/// Raised whenever a change of the code gives other heads: finished ones are then made anew.
constexpr int kWrapVersion = 1;

struct Options {
  CommonOptions common;
  std::string first, scan, shape, landmarks, model, ignore, out, batch;
  std::string units, scan_units, up = "+Y", front = "+Z", scan_up, scan_front;
  bool no_pictures = false, force = false, dry_run = false;
};

LengthUnit unit_of(const std::string& option, const std::string& text) {
  const auto unit = parse_length_unit(text);
  if (!unit) throw UsageError(concat(option, ": expected mm, cm, m or in, found ", quoted(text)));
  return *unit;
}

Axis axis_of(const std::string& option, const std::string& text) {
  const auto axis = parse_axis(text);
  if (!axis) {
    throw UsageError(concat(option, ": expected an axis such as +Y, found ", quoted(text)));
  }
  return *axis;
}

Eigen::Vector3d vector_of(Axis axis) {
  return axis.sign * Eigen::Vector3d::Unit(axis.index);
}

/// The unit in which the mesh is as large as a head with its neck.
LengthUnit guess_unit(const Positions& positions) {
  constexpr double kTypicalDiagonalMm = 430;
  return nearest_unit((positions.colwise().maxCoeff() - positions.colwise().minCoeff()).norm(),
                      kTypicalDiagonalMm);
}

/// Everything that all scans of a run share.
struct Shared {
  ObjFile file;
  double mm = 10;  ///< in one unit of the template
  HeadFrame frame;
  std::optional<PoseHint> hint;
  WrapTemplate shape;
  std::optional<ShapeModel> model;
  std::size_t model_heads = 0;
  LandmarkFile landmarks;
  Digest inputs;  ///< of all of this
};

std::vector<fs::path> files_of(const fs::path& folder, const std::vector<std::string>& endings) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string ending = lower_case(entry.path().extension().string());
    if (std::find(endings.begin(), endings.end(), ending) != endings.end()) {
      files.push_back(entry.path());
    }
  }
  if (error) throw MissingInput(concat(folder.string(), ": cannot be read: ", error.message()));
  std::sort(files.begin(), files.end());
  return files;
}

/// The heads of the model, and with them where the template's vertices are on average.
void read_model(const Options& options, Shared& shared, Positions& positions, Hasher& inputs) {
  const std::vector<fs::path> files = files_of(options.model, {".obj"});
  if (files.size() < 2) {
    throw InvalidInput(concat(options.model,
                              ": expected two heads or more in the template's "
                              "topology (.obj), found ",
                              files.size()));
  }
  std::vector<Positions> heads;
  Problems problems;
  for (const fs::path& path : files) {
    const ObjFile head = read_obj(path);
    if (const std::string other = first_difference(shared.file.topology, head.topology);
        !other.empty()) {
      problems.add(ExitCode::kBadData, concat(path.string(), ": is no head in the topology of ",
                                              options.shape, ": ", other));
      continue;
    }
    inputs.add(hash_file(path).digest);
    heads.emplace_back(head.positions * shared.mm);
  }
  problems.throw_if_any();
  shared.model = make_model(heads);
  shared.model_heads = heads.size();
  positions = shared.model->mean;
}

Shared read_shared(const Options& options) {
  Shared shared;
  shared.file = read_obj(options.shape);
  Hasher inputs;
  inputs.add(kWrapVersion).add(hash_file(options.shape).digest);
  const LengthUnit unit =
      options.units.empty() ? guess_unit(shared.file.positions) : unit_of("--units", options.units);
  shared.mm = mm_per(unit);
  shared.frame = {axis_of("--up", options.up), axis_of("--front", options.front)};
  Positions positions = shared.file.positions * shared.mm;
  if (!options.model.empty()) read_model(options, shared, positions, inputs);
  shared.shape =
      make_template(shared.file.topology, positions,
                    {.front = vector_of(shared.frame.front), .up = vector_of(shared.frame.up)});
  if (shared.model) {
    ShapeModel of_skin{shared.shape.skin.of(shared.model->mean), {}};
    for (const Positions& mode : shared.model->modes) {
      of_skin.modes.push_back(shared.shape.skin.of(mode));
    }
    shared.model = std::move(of_skin);
  }
  if (!options.ignore.empty()) {
    const std::vector<double> ignored =
        mask_values(shared.file.topology, shared.file.uvs, MaskSource(options.ignore));
    for (std::size_t v = 0; v < shared.shape.skin.vertices.size(); ++v) {
      const double left = 1 - std::clamp(ignored[shared.shape.skin.vertices[v]], 0.0, 1.0);
      shared.shape.skin.openness[v] *= left;
      inputs.add(left);
    }
  }
  if (!options.scan_up.empty() || !options.scan_front.empty()) {
    if (options.scan_up.empty() || options.scan_front.empty()) {
      throw UsageError("--scan-up and --scan-front belong together: expected both or none");
    }
    shared.hint = {vector_of(axis_of("--scan-up", options.scan_up)),
                   vector_of(axis_of("--scan-front", options.scan_front))};
    if (shared.hint->up.dot(shared.hint->front) != 0) {
      throw UsageError("--scan-up and --scan-front: expected two axes, found one");
    }
  }
  if (!options.landmarks.empty()) {
    shared.landmarks = read_landmarks(options.landmarks);
    inputs.add(hash_file(options.landmarks).digest);
  }
  for (const std::string& text : {options.units, options.scan_units, options.up, options.front,
                                  options.scan_up, options.scan_front}) {
    inputs.add(text);
  }
  shared.inputs = inputs.digest();
  log_info(concat(options.shape, ": ", shared.shape.skin.vertex_count(), " of ",
                  shared.file.topology.vertex_count, " vertices are skin; one unit is taken for 1 ",
                  name_of(unit)));
  return shared;
}

/// A scan and where what comes of it goes.
struct Task {
  fs::path scan, own_landmarks, head, report, picture;
};

Task make_task(const fs::path& scan, const fs::path& head, const fs::path& reports) {
  const std::string name = head.stem().string();
  Task task{scan, scan, head, reports / concat(name, ".wrap.json"),
            reports / concat(name, ".wrap.png")};
  task.own_landmarks.replace_extension(".yaml");
  std::error_code ignored;
  if (!fs::exists(task.own_landmarks, ignored)) task.own_landmarks.clear();
  return task;
}

std::vector<Task> tasks_of(const Options& options) {
  if (options.batch.empty()) {
    const fs::path head = output_file(options.out);
    refuse_to_write_over({options.shape, options.scan}, head);
    return {make_task(options.scan, head, head.parent_path())};
  }
  std::vector<Task> tasks;
  std::map<std::string, fs::path> names;
  for (const fs::path& scan : files_of(options.batch, {".obj", ".ply", ".stl", ".glb"})) {
    const std::string name = scan.stem().string();
    if (const auto [before, added] = names.emplace(name, scan); !added) {
      throw UsageError(concat(before->second.string(), " and ", scan.string(),
                              " would give one head; expected different names"));
    }
    tasks.push_back(make_task(scan, fs::path(options.out) / concat(name, ".obj"),
                              fs::path(options.out) / "reports"));
  }
  if (tasks.empty()) {
    throw InvalidInput(
        concat(options.batch, ": expected scans (.obj, .ply, .stl, .glb), found none"));
  }
  return tasks;
}

Digest inputs_of(const Shared& shared, const Task& task) {
  Hasher hasher;
  hasher.add(shared.inputs).add(hash_file(task.scan).digest);
  if (!task.own_landmarks.empty()) hasher.add(hash_file(task.own_landmarks).digest);
  return hasher.digest();
}

/// Whether a report proves that just this head was made from just these inputs.
bool is_done(const Task& task, const Digest& inputs) {
  std::error_code ignored;
  if (!fs::exists(task.report, ignored) || !fs::exists(task.head, ignored)) return false;
  const std::string report = read_file(task.report);
  return report.find(concat("\"inputs\": \"", inputs.hex(), '"')) != std::string::npos &&
         report.find(concat("\"mesh\": \"", hash_file(task.head).digest.hex(), '"')) !=
             std::string::npos;
}

LandmarkFile landmarks_for(const Shared& shared, const Task& task) {
  LandmarkFile file = shared.landmarks;
  if (task.own_landmarks.empty()) return file;
  const LandmarkFile own = read_landmarks(task.own_landmarks);
  for (const auto& [name, place] : own.of_template) file.of_template[name] = place;
  for (const auto& [name, place] : own.of_scan) file.of_scan[name] = place;
  return file;
}

/// The factor that gives the head the scan's size; without the scan's unit heads have the template's.
double output_scale(const Options& options, const Similarity& pose) {
  if (options.scan_units.empty()) return 1;
  const double scale = pose.scale * mm_per(unit_of("--scan-units", options.scan_units));
  constexpr double kMost = 1.5;
  if (scale > kMost || scale < 1 / kMost) {
    throw UsageError(concat("--scan-units ", options.scan_units, ": the head would be ",
                            format_fixed(scale, 3),
                            " times as large as the template; expected another unit, or none"));
  }
  return scale;
}

void wrap_one(const Options& options, const Shared& shared, const Task& task,
              const Digest& inputs) {
  const Scan scan = read_scan(task.scan);
  const std::vector<WrapLandmark> landmarks =
      match_landmarks(landmarks_for(shared, task), shared.file.positions, scan);
  const WrapResult result = [&] {
    try {
      WrapResult wrapped =
          wrap(shared.shape, shared.model ? &*shared.model : nullptr, scan, landmarks, shared.hint);
      refuse_bad_wrap(shared.shape, wrapped);
      return wrapped;
    } catch (const InvalidInput& error) {
      throw InvalidInput(concat(task.scan.string(), ": ", error.what()));
    }
  }();
  const double scale = output_scale(options, result.pose);
  const std::vector<std::string> warnings = wrap_warnings(shared.shape, result, shared.model_heads);
  const Digest mesh = write_obj_like(shared.file, shared.file.topology,
                                     Positions(result.positions * (scale / shared.mm)), task.head);
  if (!options.no_pictures) {
    write_file(task.picture, wrap_picture(shared.shape, scan, result, shared.frame,
                                          task.scan.filename().string()));
  }
  write_file(task.report, format_wrap_report(
                              {options.shape, task.scan.string(), inputs.hex(), mesh.hex(), scale},
                              shared.shape, result, warnings));
  for (const std::string& warning : warnings) {
    log_warning(concat(task.scan.string(), ": ", warning));
  }
  const WrapDistances distances = distances_of(shared.shape, result);
  log_info(concat(task.scan.string(), ": ", task.head.string(), ", ",
                  format_fixed(distances.median, 2), " mm from the scan (95 %: ",
                  format_fixed(distances.percentile_95, 2), "), ", landmarks.size(), " landmarks"));
}

void check_one(const Shared& shared, const Task& task) {
  const Scan scan = read_scan(task.scan);
  const auto landmarks = match_landmarks(landmarks_for(shared, task), shared.file.positions, scan);
  log_info(concat(task.scan.string(), ": ", scan.triangles.size(), " triangles, ", landmarks.size(),
                  " landmarks; would become ", task.head.string()));
}

void wrap_all(const Options& options) {
  const Shared shared = read_shared(options);
  const std::vector<Task> tasks = tasks_of(options);
  if (!options.dry_run && !options.batch.empty()) {
    make_directories(fs::path(options.out) / "reports");
    remove_leftovers(options.out);
  }
  Progress progress("scans", tasks.size());
  Problems problems;
  std::size_t done = 0;
  for (const Task& task : tasks) {
    throw_if_interrupted();
    try {
      const Digest inputs = inputs_of(shared, task);
      if (!options.force && is_done(task, inputs)) {
        ++done;
      } else if (options.dry_run) {
        check_one(shared, task);
      } else {
        wrap_one(options, shared, task, inputs);
      }
    } catch (const Error& error) {
      // A scan that is no good keeps none of the others from being wrapped.
      if (error.code() == ExitCode::kInterrupted || error.code() == ExitCode::kIoError) throw;
      problems.add(error);
    }
    progress.step();
  }
  if (done > 0) log_info(concat(done, " of ", tasks.size(), " were there already"));
  problems.throw_if_any();
}

void sort_arguments(Options& options) {
  if (options.batch.empty()) {
    if (options.first.empty() || options.scan.empty() || !options.shape.empty()) {
      throw UsageError("expected TEMPLATE.obj and SCAN, or --batch with --template");
    }
    options.shape = options.first;
  } else if (options.shape.empty() || !options.first.empty()) {
    throw UsageError("--batch: expected --template TEMPLATE.obj and no other file");
  }
}

}  // namespace

Run add_wrap(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "wrap", "Bend a template head onto raw scans, so that they share one topology");
  command->add_option("template", options->first, "The head whose topology the result has")
      ->type_name("TEMPLATE.obj");
  command->add_option("scan", options->scan, "The scan, in any unit and pose")
      ->type_name("SCAN.{obj,ply,stl,glb}");
  command->add_option("-o,--output", options->out, "The head to write, or with --batch the folder")
      ->required()
      ->type_name("OUT");
  command
      ->add_option("--batch", options->batch,
                   "A folder of scans, each with its own landmarks beside it (NAME.yaml)")
      ->type_name("DIR");
  command->add_option("--template", options->shape, "The template, with --batch")
      ->type_name("TEMPLATE.obj");
  command
      ->add_option("--landmarks", options->landmarks,
                   "template: {NAME: vertex} and scan: {NAME: [x, y, z]}; vertices count from 0")
      ->type_name("FILE.yaml");
  command
      ->add_option("--model", options->model,
                   "Heads in the template's topology, whose mean and variety guide the wrap")
      ->type_name("DIR");
  command
      ->add_option("--ignore", options->ignore,
                   "A mask over the template's texture: what is white there is left alone, as hair")
      ->type_name("MASK");
  command->add_option("--units", options->units, "One unit of the template (default: guessed)")
      ->type_name("UNIT");
  command
      ->add_option("--scan-units", options->scan_units,
                   "One unit of the scans: heads keep their size (default: the template's size)")
      ->type_name("UNIT");
  command->add_option("--up", options->up, "Where the template's head points")
      ->type_name("AXIS")
      ->capture_default_str();
  command->add_option("--front", options->front, "Where the template's face looks")
      ->type_name("AXIS")
      ->capture_default_str();
  command->add_option("--scan-up", options->scan_up, "The same of scans without landmarks")
      ->type_name("AXIS");
  command->add_option("--scan-front", options->scan_front, "The same of scans without landmarks")
      ->type_name("AXIS");
  command->add_flag("--no-pictures", options->no_pictures, "Write no picture beside the report");
  command->add_flag("--force", options->force, "Wrap again what is there already");
  command->add_flag("--dry-run", options->dry_run, "Read and check everything, write nothing");
  options->common.add_to(*command);
  return [options] {
    const auto threads = options->common.apply();
    sort_arguments(*options);
    wrap_all(*options);
  };
}

}  // namespace crowdface::cli
