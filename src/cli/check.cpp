// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "crowdface/config/input_files.h"
#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/log.h"
#include "crowdface/core/output_file.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/find_levels.h"
#include "crowdface/heads/head_mirror.h"
#include "crowdface/heads/named_parts.h"
#include "crowdface/io/image.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/pictures/crowd_renders.h"
#include "crowdface/render/contact_sheet.h"
#include "crowdface/render/text_label.h"
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

using Colour = std::array<std::uint8_t, 3>;
constexpr Colour kDot = {255, 214, 64}, kRim = {20, 20, 22};
/// smallest cosine between normal and camera direction at which dots are drawn
constexpr double kTurnedAway = 0.08;

struct Pixel {
  double x, y;
};

/// The pixel at which a camera shows a point.
Pixel project(const Camera& camera, const Eigen::Vector3d& point, int width) {
  const Eigen::Vector3d away = point - camera.target;
  const double depth = camera.distance - away.dot(camera.back);
  const double scale = width / 2.0 / (depth * camera.tan_half_fov);
  return {width / 2.0 + away.dot(camera.right) * scale, width / 2.0 - away.dot(camera.up) * scale};
}

void draw_dot(const Pixel& at, double radius, Rgb8Image& image) {
  const auto around = static_cast<int>(std::ceil(radius + 1.5));
  const int column = static_cast<int>(at.x), row = static_cast<int>(at.y);
  for (int y = row - around; y <= row + around; ++y) {
    for (int x = column - around; x <= column + around; ++x) {
      const double away = std::hypot(x + 0.5 - at.x, y + 0.5 - at.y);
      if (x < 0 || y < 0 || x >= image.width || y >= image.height || away > radius + 1) continue;
      const Colour& colour = away <= radius ? kDot : kRim;
      std::copy(colour.begin(), colour.end(), image.at(x, y));
    }
  }
}

void draw_label(const std::string& label, const Pixel& at, Rgb8Image& image) {
  constexpr int kHeight = 15, kPerLetter = 9, kBeside = 6;
  const Rgb8Image text =
      label_strip(label, kPerLetter * static_cast<int>(label.size()) + 4, kHeight,
                  {.text_px = 12, .text_colour = {255, 255, 255}, .background_colour = kRim});
  const int left = std::clamp(static_cast<int>(at.x) + kBeside, 0, image.width - text.width);
  const int top = std::clamp(static_cast<int>(at.y) - kHeight / 2, 0, image.height - kHeight);
  for (int y = 0; y < text.height; ++y) {
    for (int x = 0; x < text.width; ++x) {
      const std::uint8_t* from = text.at(x, y);
      if (from[0] == kRim[0] && from[1] == kRim[1] && from[2] == kRim[2]) continue;
      std::copy_n(from, 3, image.at(left + x, top + y));
    }
  }
}

/// Draws the landmarks that face the camera on an image of a head.
/// \param normals  #V by 3, the unit normals of `head`
void draw_landmarks(const HeadLandmarks& landmarks, const Positions& head, const Positions& normals,
                    const Camera& camera, Rgb8Image& image) {
  for (std::size_t l = 0; l < landmarks.surface_points.size(); ++l) {
    if (!landmarks.surface_points[l]) continue;
    const SurfacePoint& surface_point = *landmarks.surface_points[l];
    const Eigen::Vector3d point = point_on(head, surface_point.corners, surface_point.barycentric);
    const Eigen::Vector3d to_camera = (camera.position() - point).normalized();
    const Eigen::Vector3d normal =
        point_on(normals, surface_point.corners, surface_point.barycentric);
    if (normal.dot(to_camera) < kTurnedAway) continue;
    const Pixel at = project(camera, point, image.width);
    draw_dot(at, image.width / 250.0, image);
    draw_label(std::string(trait_landmarks()[l].symbol), at, image);
  }
}

/// Writes an image of the mean head that shows the landmarks from which traits are measured: three
/// views side by side.
void write_landmarks(const Job& job, const HeadLandmarks& landmarks,
                     const std::filesystem::path& file) {
  Config::ContactSheet sheet;
  sheet.cell = 640;
  sheet.views = {View::kFront, View::kThreeQuarter, View::kProfile};
  const CrowdRenders renders(job.config, sheet, job.inputs);
  refuse_to_write_over(input_files(job.config), {file});
  const Positions head = mean_head(job.inputs.head_set);
  const Positions normals = vertex_normals(job.inputs.head_set.topology, head);
  std::vector<Rgb8Image> views;
  for (const Camera& camera : renders.cameras()) {
    views.push_back(renders.render(head, camera));
    draw_landmarks(landmarks, head, normals, camera, views.back());
  }
  const Rgb8Image image = joined_pictures(views);
  write_file(file, encode_png(image.width, image.height, 3, image.pixels));
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
