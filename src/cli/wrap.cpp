// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <utility>

#include "crowdface/bake/scan_colours.h"
#include "crowdface/core/error.h"
#include "crowdface/core/output_file.h"
#include "crowdface/core/text.h"
#include "crowdface/io/read_mesh.h"
#include "crowdface/pick/pick_api.h"
#include "crowdface/pictures/gallery_page.h"
#include "crowdface/run/wrap_scans.h"
#include "crowdface/wrap/scan_file.h"

#include "cli/commands.h"
#include "cli/common_options.h"

namespace crowdface::cli {
namespace {

/// The options and arguments of the command `wrap`.
struct WrapCommand : CommonOptions, WrapOptions {
  /// The argument TEMPLATE.obj; --batch needs --template in its place.
  std::string template_argument;
  std::string shard_text;  ///< value of `--shard`, the part of the batch, such as 2/7
  std::string port = "0";  ///< TCP port of the page of --pick; 0: any free port
  bool pick = false, no_browser = false;  ///< whether these options are given
};

/// Returns the path that `--landmarks` gives. The file need not exist; the page saves landmarks to
/// this file.
std::filesystem::path landmarks_file(const WrapOptions& options) {
  if (options.landmarks.empty()) {
    throw UsageError("--pick: expected --landmarks FILE.yaml, the file to save the landmarks to");
  }
  if (lower_case(std::filesystem::path(options.landmarks).extension().string()) != ".yaml") {
    throw UsageError(
        concat("--landmarks ", options.landmarks, ": expected a file name that ends in .yaml"));
  }
  std::filesystem::path file = checked_output_path(options.landmarks);
  refuse_to_write_over({options.template_file, options.scan}, {file});
  return file;
}

/// Returns the scans with their landmark files. Without --batch: one scan and the file of
/// --landmarks. With --batch: all scans of a folder; the landmark file of a scan is the YAML file
/// with the same name in this folder.
std::vector<PickableScans::Entry> entries_of(const WrapOptions& options) {
  if (options.batch.empty()) return {{options.scan, landmarks_file(options)}};
  std::vector<PickableScans::Entry> entries;
  for (const std::filesystem::path& scan : list_scans(options.batch)) {
    std::filesystem::path landmarks = scan;
    entries.push_back({scan, landmarks.replace_extension(".yaml")});
  }
  return entries;
}

/// Executes `wrap --pick`: serves the page on which the user picks landmarks on the template and on
/// the scan.
void pick(const WrapCommand& options) {
  constexpr std::uint64_t kLargestPort = 65535;
  const auto port = static_cast<int>(parse_whole_number("--port", options.port, 0, kLargestPort));
  WrapOptions without_landmarks = options;
  without_landmarks.landmarks.clear();  // PickableScans reads the landmarks together with each scan
  const std::vector<PickableScans::Entry> entries = entries_of(options);
  const WrapInputs inputs = read_wrap_inputs(without_landmarks);
  PickableScans scans(entries, [&](const PickableScans::Entry& entry) {
    FileMesh mesh = read_mesh(entry.scan_file);
    Scan scan = scan_of(mesh, entry.scan_file);
    ColourRows colours = colours_at_vertices(scan, ScanColours(std::move(mesh), entry.scan_file));
    return PickInputs{inputs.wrap_template,
                      inputs.file.positions * inputs.mm_per_unit,
                      inputs.file.positions,
                      std::move(scan),
                      inputs.hint,
                      options.template_file,
                      entry.scan_file,
                      entry.landmark_file,
                      options.batch.empty() ? std::string() : options.landmarks,
                      std::move(colours)};
  });
  pick_landmarks(scans, gallery_page_folder(), port, [&](const std::string& address) {
    show_page(address, options.no_browser ? Browser::kNone : Browser::kOpen);
  });
}

/// Checks that the options are compatible with each other, and returns them. Without --batch, moves
/// the path of the template from `template_argument` to `template_file`.
WrapCommand checked_options(WrapCommand options) {
  if (options.pick && !options.out.empty()) {
    throw UsageError("--pick: expected no -o, --output, because --pick wraps nothing");
  }
  if (!options.pick && options.out.empty()) throw UsageError("-o, --output is required");
  options.shard = parse_shard_option(options.shard_text);
  if (options.batch.empty()) {
    if (options.template_argument.empty() || options.scan.empty() ||
        !options.template_file.empty()) {
      throw UsageError("expected TEMPLATE.obj and SCAN, or --batch with --template");
    }
    options.template_file = options.template_argument;
    if (!options.pick) require_obj_output(options.out);
  } else if (options.template_file.empty() || !options.template_argument.empty()) {
    throw UsageError("--batch: expected --template TEMPLATE.obj and no other file");
  }
  return options;
}

void declare_wrap(CLI::App& command, WrapCommand& options) {
  add_option(command, "template_file", options.template_argument, "TEMPLATE.obj",
             "The template head, whose topology the result has");
  add_option(command, "scan_file", options.scan, "SCAN",
             "The scan, in any unit and pose: OBJ, PLY, STL, GLB, glTF, FBX or USD");
  add_option(command, "-o,--output", options.out, "OUT",
             "The head to write, or the folder with --batch");
  add_option(command, "--batch", options.batch, "DIR",
             "A folder of scans, with the landmarks of each scan in NAME.yaml");
  add_option(command, "--template", options.template_file, "TEMPLATE.obj",
             "With --batch: the template head");
  add_option(command, "--shard", options.shard_text, "I/N",
             "Wrap only part I of N of the batch; several machines may share one output folder")
      .needs("--batch");
  add_option(command, "--landmarks", options.landmarks, "FILE",
             "A YAML file with template: {NAME: vertex}, numbered from 0, and scan: {NAME: [x, y, "
             "z]}; or only the landmarks of the scan, as .pp (MeshLab), CSV, JSON or .npy; or "
             "none: use no "
             "landmarks, also none that are detected");
  add_option(command, "--template-landmarks", options.template_landmarks, "FILE",
             "Only the landmarks of the template, in the same formats");
  add_option(
      command, "--model", options.model, "DIR",
      "A folder of heads in the template's topology; their mean and variation guide the wrap");
  add_option(
      command, "--ignore", options.ignored_area_mask, "MASK",
      "A mask over the template's texture; white areas, such as hair, are not fitted to the scan");
  add_option(command, "--texture", options.texture_size, "SIZE",
             "Bake the scan's colours into the template's texture layout, with this many texels "
             "per side");
  add_flag(command, "--delight", options.removes_shading,
           "With --texture: even out the light that the scan's colours contain");
  add_option(command, "--units", options.units, "UNIT",
             "The length unit of the template (default: guessed)");
  add_option(
      command, "--scan-units", options.scan_units, "UNIT",
      "The length unit of the scans; heads get the size of the scan (default: of the template)");
  add_option(command, "--up", options.up, "AXIS", "The up axis of the template");
  add_option(command, "--front", options.front, "AXIS", "The axis along which the template looks");
  add_option(command, "--scan-up", options.scan_up, "AXIS",
             "The up axis of scans without landmarks");
  add_option(command, "--scan-front", options.scan_front, "AXIS",
             "The axis along which scans without landmarks look");
  add_flag(command, "--pick", options.pick, "Wrap nothing; open a page to pick and save landmarks");
  add_option(command, "--port", options.port, "N",
             "With --pick: the port to serve on at 127.0.0.1; 0: any free port");
  add_flag(command, "--no-browser", options.no_browser,
           "With --pick: print the address, but open no browser");
  add_flag(
      command, "--estimate", options.estimate,
      "Wrap several more times without some landmarks, and report how far these end from their "
      "picked places (unseen_mm and correspondence_mm)");
  add_flag(command, "--strict", options.strict,
           "Write no head whose face, eyes, nose, mouth or ears are doubtful, only its picture and "
           "report");
  add_flag(command, "--no-pictures", options.no_pictures, "Write no picture beside the report");
  add_flag(command, "--force", options.force,
           "Wrap all scans again, including those already wrapped");
  add_flag(command, "--dry-run", options.dry_run, "Read and check everything, but write nothing");
}

}  // namespace

CommandAction add_wrap(CLI::App& program) {
  return add_command<WrapCommand>(
      program, "wrap", "Fit a template head to raw scans, so that all heads share one topology",
      declare_wrap, [](const WrapCommand& options) {
        const WrapCommand known = checked_options(options);
        known.pick ? pick(known) : wrap_scans(known);
      });
}

}  // namespace crowdface::cli
