// SPDX-License-Identifier: Apache-2.0
#include "crowdface/job/crowd_renders.h"

#include <cmath>
#include <system_error>

#include "crowdface/core/file.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/progress.h"
#include "crowdface/core/text.h"
#include "crowdface/io/image.h"
#include "crowdface/render/contact_sheet.h"

namespace crowdface {
namespace {

/// Of a bust, shoulders may leave the picture: it is for judging faces.
constexpr double kCutBelow = 0.22;

std::vector<Camera> fit_to_heads(const Config& config, const Config::ContactSheet& sheet,
                                 const Inputs& inputs) {
  std::vector<const Positions*> heads;
  for (const Head& head : inputs.faces.heads) heads.push_back(&head.positions);
  return fit_cameras(heads, {config.faces.up, config.faces.front}, sheet.views,
                     {.cut_below = kCutBelow});
}

/// By the names of materials; what is called nothing but has an eyeball's shape is an eye too.
std::vector<SurfaceKind> surface_kinds(const Inputs& inputs) {
  std::vector<bool> eyeball(static_cast<std::size_t>(inputs.components.count()), false);
  for (const Part& part : inputs.parts.parts) {
    for (const std::uint32_t c : part.components) eyeball[c] = part.eyeball;
  }
  std::vector<SurfaceKind> kinds;
  for (Index f = 0; f < inputs.faces.topology.face_count(); ++f) {
    kinds.push_back(surface_kind_of_material(inputs.materials[static_cast<std::size_t>(f)]));
    const std::uint32_t first = inputs.faces.topology.face(f)[0];
    if (kinds.back() == SurfaceKind::kSkin && eyeball[inputs.components.of_vertex[first]]) {
      kinds.back() = SurfaceKind::kEye;
    }
  }
  return kinds;
}

std::string to_png(const Rgb8Image& image) {
  return encode_png(image.width, image.height, 3, image.pixels);
}

void remove_pages_from(const CrowdDirectory& directory, std::size_t page) {
  std::error_code error;
  while (std::filesystem::remove(directory.sheet(page), error)) ++page;
}

}  // namespace

CrowdRenders::CrowdRenders(const Config& config, const Config::ContactSheet& sheet,
                           const Inputs& inputs)
    : cameras_(fit_to_heads(config, sheet, inputs)),
      renderer_(inputs.faces.topology,
                RenderOptions{.size_px = sheet.cell, .front = config.faces.front},
                surface_kinds(inputs), &inputs.faces.heads.front().positions) {}

Rgb8Image CrowdRenders::render(const Positions& positions, const VertexColours* colours) const {
  std::vector<Rgb8Image> views;
  for (const Camera& camera : cameras_) {
    views.push_back(renderer_.render(positions, camera, colours));
  }
  return side_by_side(views);
}

std::string CrowdRenders::render_png(const Positions& positions,
                                     const VertexColours* colours) const {
  return to_png(render(positions, colours));
}

std::size_t write_sheets(const CrowdDirectory& directory, const Config::ContactSheet& sheet,
                         const std::string& title, const std::vector<std::string>& ids,
                         const std::function<Rgb8Image(std::size_t)>& picture) {
  make_directories(directory.sheets());
  const std::size_t per_page =
      static_cast<std::size_t>(sheet.columns) * static_cast<std::size_t>(sheet.rows);
  const std::size_t pages = (ids.size() + per_page - 1) / per_page;
  Progress progress("contact sheets", pages);
  for (std::size_t page = 0; page < pages; ++page) {
    throw_if_interrupted();
    const std::size_t first = page * per_page;
    std::vector<SheetCell> cells(std::min(per_page, ids.size() - first));
    parallel_for_each(static_cast<Index>(cells.size()), [&](Index c) {
      const auto i = static_cast<std::size_t>(c);
      cells[i] = {picture(first + i), ids[first + i]};
    });
    const std::string note = pages > 1 ? concat("sheet ", page + 1, " of ", pages) : std::string();
    write_file(directory.sheet(page + 1),
               to_png(contact_sheet(
                   cells, {.columns = sheet.columns, .rows = 0, .title = title, .note = note})));
    progress.step();
  }
  remove_pages_from(directory, pages + 1);
  return pages;
}

Rgb8Image read_render(const std::filesystem::path& path) {
  const Image image = read_image(path);
  Rgb8Image result(image.width, image.height);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const float value = image.at(x, y, std::min(c, image.channels - 1));
        result.at(x, y)[c] = static_cast<std::uint8_t>(std::lround(value * 255.0F));
      }
    }
  }
  return result;
}

}  // namespace crowdface
