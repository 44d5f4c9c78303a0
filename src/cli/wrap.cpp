// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/error.h"
#include "crowdface/run/wrap_scans.h"

#include "cli/commands.h"
#include "cli/pick.h"

namespace crowdface::cli {
namespace {

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
