// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pictures/shape_sheet.h"

#include <algorithm>
#include <optional>

#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/progress.h"
#include "crowdface/core/text.h"
#include "crowdface/crowd/face_mesh.h"

namespace crowdface {
namespace {

/// Shapes side by side on one page.
constexpr std::size_t kMostColumns = 16;

/// A face at rest and in some of its shapes.
void add_row(const CrowdRenders& renders, const ShapeSet& set, std::size_t first, std::size_t count,
             const std::string& name, const Positions& face,
             const std::vector<Displacements>& moves, std::vector<SheetCell>& cells) {
  std::vector<SheetCell> row(1 + count);
  row[0] = {renders.render_front(face), name};
  parallel_for_each(count, [&](std::size_t s) {
    Positions moved = face;
    moves[first + s].add_to(moved);
    row[1 + s] = {renders.render_front(moved), set.shapes[first + s].name};
  });
  cells.insert(cells.end(), row.begin(), row.end());
}

}  // namespace

void add_shape_pages(const Config& config, const Config::ContactSheet& sheet, const Inputs& inputs,
                     const CrowdDirectory& directory, const CrowdRenders& renders,
                     const FaceShapes& shapes, const std::vector<CastFace>& crowd,
                     SheetWriter& pages) {
  const ShapeSet& set = inputs.shapes;
  const std::size_t faces = std::min(crowd.size(), static_cast<std::size_t>(sheet.shapes));
  if (faces == 0) return;
  std::vector<Displacements> of_template;
  for (const Shape& shape : set.shapes) of_template.push_back(shape.moves);
  const std::size_t count = (set.shapes.size() + kMostColumns - 2) / (kMostColumns - 1);
  const std::size_t per_page = (set.shapes.size() + count - 1) / count;
  Progress progress("sheets of shapes", count);
  for (std::size_t page = 0; page < count; ++page) {
    const std::size_t first = page * per_page;
    const std::size_t shown = std::min(per_page, set.shapes.size() - first);
    std::vector<SheetCell> cells;
    add_row(renders, set, first, shown, set.of_head.empty() ? "template" : "mean head", set.neutral,
            of_template, cells);
    for (std::size_t f = 0; f < faces; ++f) {
      throw_if_interrupted();
      const Positions face = read_face(directory, crowd[f].id, config.output.meshes,
                                       inputs.faces.topology.vertex_count);
      add_row(renders, set, first, shown, crowd[f].id, face, shapes.of_face(crowd[f].recipe, face),
              cells);
    }
    pages.add(concat("shapes_", zero_padded(page + 1, 3)), "shapes",
              contact_sheet(cells, {.columns = static_cast<int>(1 + shown),
                                    .rows = 0,
                                    .title = concat(config.crowd.name, ": shapes"),
                                    .legend = {},
                                    .note = count > 1 ? concat("sheet ", page + 1, " of ", count)
                                                      : std::string()}));
    progress.step();
  }
}

}  // namespace crowdface
