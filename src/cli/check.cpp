// SPDX-License-Identifier: Apache-2.0

#include "crowdface/config/input_files.h"
#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/log.h"
#include "crowdface/core/output_file.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/find_levels.h"
#include "crowdface/heads/head_mirror.h"
#include "crowdface/heads/named_parts.h"
#include "crowdface/pictures/crowd_renders.h"
#include "crowdface/pictures/landmark_picture.h"
#include "crowdface/run/head_traits.h"
#include "crowdface/run/job.h"
#include "crowdface/run/output_check.h"
#include "crowdface/smooth/level_size.h"

#include "cli/commands.h"
#include "cli/common_options.h"

namespace crowdface::cli {
namespace {

/// Logs a warning if `generate` would refuse the output folder.
void warn_about_output(const Job& job) {
  try {
    check_output(job, Replace::kRefuse);
  } catch (const RecoverableError& error) {
    log_warning(concat("generate would refuse the output folder: ", error.what()));
  }
}

void describe(const Job& job) {
  const Inputs& inputs = job.inputs;
  const auto& boundary = inputs.adjacency.boundary;
  const std::string levels = describe_detail_levels(inputs);
  const auto& bands = job.names.bands;
  const std::uint64_t sampled = job.config.crowd.count, by_hand = job.config.recipes.size();
  print(concat(
      job.config.file.string(), " is fine\n", "heads       ", job.names.heads.size(), ": ",
      join(job.names.heads), "\ntopology    ", inputs.head_set.topology.vertex_count, " vertices, ",
      inputs.head_set.topology.face_count(), " faces, ", inputs.components.count(), " components, ",
      std::ranges::count(boundary, true), " boundary vertices\n", "edges       ",
      format_fixed(inputs.edge_length_mm, 3), " mm (rms, on the skin)\n", "smoothing   up to ",
      inputs.max_level, " iterations, a size of ",
      format_fixed(
          wavelength_of_iterations(job.smoothing.kind(), inputs.max_level, inputs.edge_length_mm),
          1),
      " mm\n", "parts       ", describe_parts(job.config, inputs), "\nsymmetry    ",
      describe_mirror(job.config, find_mirror(job.config, inputs)), "\nregions     ",
      join(job.names.regions), "\n",
      bands.size() > 1 ? concat("bands       ", join(bands), "\n") : "",
      levels.empty() ? "" : concat("lods        ", levels, "\n"),
      job.names.attachments.empty() ? ""
                                    : concat("attachments ", join(job.names.attachments), "\n"),
      "faces       ", sampled, " sampled, ", by_hand, " by hand, ",
      face_count(job.config) - sampled - by_hand, " in families\n", "output      ",
      job.config.output.directory.string(), "\n"));
}

/// Returns the colours in which to show the regions, #R by 3. If the regions are the channels of
/// one image, the colours are red, green and blue; otherwise colours of a palette.
VertexColours painted_colours(const Config::Regions& regions, Index count) {
  const bool channels = regions.mask.size() == 1 && count > 1;
  VertexColours colours(count, 3);
  for (Index k = 0; k < count; ++k) {
    if (channels && k < 3) {
      constexpr float kFull = 0.85F, kRest = 0.12F;
      colours.row(k).setConstant(kRest);
      colours(k, k) = kFull;
    } else {
      colours.row(k) = palette_colour(k).transpose();
    }
  }
  return colours;
}

/// Writes one image for each region. The image shows the mask of the region on the mean head.
void write_masks(const Job& job, const std::filesystem::path& directory) {
  const Positions mean = mean_head(job.inputs.head_set);
  Config::ContactSheet sheet;
  sheet.cell = 512;
  sheet.views = {View::kFront, View::kThreeQuarter, View::kBack};
  const CrowdRenders renders(job.config, sheet, job.inputs);
  const auto file_of = [&](const std::string& name) { return directory / concat(name, ".png"); };
  const std::vector<std::filesystem::path> inputs = input_files(job.config);
  for (const std::string& name : job.names.regions) refuse_to_write_over(inputs, {file_of(name)});
  refuse_to_write_over(inputs, {file_of("all")});
  make_directories(directory);
  const auto write = [&](const std::string& name, const VertexColours& shown) {
    write_file(file_of(name), renders.render_png(mean, &shown));
    log_info(file_of(name).string());
  };
  const auto& alpha = job.inputs.regions.alpha;
  const VertexColours colours = painted_colours(job.config.regions, alpha.cols());
  for (Index k = 0; k < alpha.cols(); ++k) {
    write(job.names.regions[static_cast<std::size_t>(k)],
          mask_colours(alpha.col(k), colours.row(k)));
  }
  if (alpha.cols() > 1) write("all", region_colours(alpha, colours));
}

/// Writes an image of the mean head that shows the landmarks from which traits are measured.
void write_landmarks(const Job& job, const HeadLandmarks& landmarks,
                     const std::filesystem::path& file) {
  Config::ContactSheet sheet;
  sheet.cell = 640;
  sheet.views = {View::kFront, View::kThreeQuarter, View::kProfile};
  const CrowdRenders renders(job.config, sheet, job.inputs);
  std::vector<LabelledPoint> points;
  for (std::size_t l = 0; l < landmarks.surface_points.size(); ++l) {
    if (landmarks.surface_points[l]) {
      points.push_back({std::string(trait_landmarks()[l].symbol), *landmarks.surface_points[l]});
    }
  }
  refuse_to_write_over(input_files(job.config), {file});
  write_file(file, landmark_picture(renders, job.inputs.head_set.topology,
                                    mean_head(job.inputs.head_set), points));
  log_info(file.string());
}

}  // namespace

CommandAction add_check(CLI::App& program) {
  struct Options : CommonOptions {
    ConfigOptions config;
    std::string masks, landmarks;
    bool traits = false;
  };
  return add_command<Options>(
      program, "check", "Check config, heads and masks, and report all problems",
      [](CLI::App& command, Options& options) {
        options.config.add_to(command);
        add_option(command, "--masks", options.masks, "DIR",
                   "Render the mask of each region on the mean head, to this folder");
        add_flag(command, "--traits", options.traits,
                 "Print the measurements of all heads (docs/traits.md)");
        add_option(command, "--landmarks", options.landmarks, "FILE",
                   "Render the landmarks of the measurements on the mean head, to this PNG file");
      },
      [](const Options& options) {
        const Job job = load_job(options.config.config_file, options.config.overrides,
                                 options.config.cache_path());
        warn_about_output(job);
        describe(job);
        if (!options.masks.empty()) write_masks(job, options.masks);
        const bool limited = !job.config.named_traits().empty();
        if (!limited && !options.traits && options.landmarks.empty()) return;
        const HeadLandmarks landmarks = find_head_landmarks(job.config, job.inputs);
        require_available_traits(job.config, landmarks);
        if (options.traits) print(format_head_traits(job.config, job.inputs, landmarks));
        if (!options.landmarks.empty()) write_landmarks(job, landmarks, options.landmarks);
      });
}

}  // namespace crowdface::cli
