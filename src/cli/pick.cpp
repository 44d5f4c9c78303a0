// SPDX-License-Identifier: Apache-2.0
#include "cli/pick.h"

#include <utility>

#include "crowdface/bake/scan_colours.h"
#include "crowdface/core/error.h"
#include "crowdface/core/output_file.h"
#include "crowdface/core/text.h"
#include "crowdface/io/read_mesh.h"
#include "crowdface/pick/pick_api.h"
#include "crowdface/pictures/gallery_page.h"
#include "crowdface/wrap/scan_file.h"

namespace crowdface::cli {
namespace {

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

}  // namespace

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

}  // namespace crowdface::cli
