// SPDX-License-Identifier: Apache-2.0
// Pages of contact sheets that show faces with their shapes (expressions).
#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/progress.h"
#include "crowdface/core/text.h"
#include "crowdface/crowd/face_mesh.h"
#include "crowdface/pictures/sheets.h"

namespace crowdface {
namespace {

/// Largest number of columns on a page, including the neutral face.
constexpr std::size_t kMaxColumns = 16;

/// A column of a page. Each column shows one blend shape. If this is a corrective shape, the column
/// also applies the shape that it corrects (see find_prerequisites).
struct Column {
  std::string name;
  std::vector<std::size_t> shapes;
};

std::vector<Column> columns_of(const ShapeSet& set, const FaceShapes& shapes) {
  std::vector<Column> columns;
  for (std::size_t s = 0; s < set.shapes.size(); ++s) {
    Column column{set.shapes[s].name, {s}};
    if (const auto other = shapes.prerequisite_of(s)) {
      column.name += concat(" + ", set.shapes[*other].name);
      column.shapes.push_back(*other);
    }
    columns.push_back(std::move(column));
  }
  return columns;
}

/// Adds a row: the neutral face, then the face with each column's shapes.
void add_row(const CrowdRenders& renders, std::span<const Column> columns, const std::string& name,
             const Positions& face, const std::vector<Displacements>& moves,
             std::vector<SheetCell>& cells) {
  std::vector<SheetCell> row(1 + columns.size());
  row[0] = {renders.render_front(face), name};
  parallel_for_each(columns.size(), [&](std::size_t c) {
    Positions moved = face;
    for (const std::size_t s : columns[c].shapes) moves[s].add_to(moved);
    row[1 + c] = {renders.render_front(moved), columns[c].name};
  });
  cells.insert(cells.end(), row.begin(), row.end());
}

}  // namespace

void add_shape_pages(const PicturedCrowd& crowd, SheetWriter& pages) {
  const ShapeSet& set = crowd.inputs.shapes;
  const std::size_t faces = std::min(
      crowd.faces.size(),
      static_cast<std::size_t>(crowd.config.output.contact_sheet->face_count_on_shape_pages));
  if (faces == 0) return;
  std::vector<Displacements> of_template;
  for (const Shape& shape : set.shapes) of_template.push_back(shape.moves);
  const std::vector<Column> columns = columns_of(set, crowd.shapes);
  const std::size_t count = (set.shapes.size() + kMaxColumns - 2) / (kMaxColumns - 1);
  const std::size_t per_page = (set.shapes.size() + count - 1) / count;
  Progress progress("sheets of shapes", count);
  for (std::size_t page = 0; page < count; ++page) {
    const std::size_t first = page * per_page;
    const std::span shown =
        std::span(columns).subspan(first, std::min(per_page, columns.size() - first));
    std::vector<SheetCell> cells;
    add_row(crowd.renders, shown, set.head_shapes.empty() ? "template" : "mean head", set.neutral,
            of_template, cells);
    for (std::size_t f = 0; f < faces; ++f) {
      throw_if_interrupted();
      const FacePlan& shown_face = crowd.faces[f];
      const Positions face =
          read_face_positions(crowd.directory, shown_face.id, crowd.config.output.meshes,
                              crowd.inputs.head_set.topology.vertex_count);
      add_row(crowd.renders, shown, shown_face.id, face,
              crowd.shapes.shapes_of_face(shown_face.recipe, face), cells);
    }
    pages.add(concat("shapes_", zero_padded(page + 1, 3)), "shapes",
              contact_sheet(cells, {.columns = static_cast<int>(1 + shown.size()),
                                    .rows = 0,
                                    .title = concat(crowd.config.crowd.name, ": shapes"),
                                    .legend = {},
                                    .note = count > 1 ? concat("sheet ", page + 1, " of ", count)
                                                      : std::string()}));
    progress.step();
  }
}

}  // namespace crowdface
