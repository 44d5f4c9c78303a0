// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pictures/sheets.h"

#include <algorithm>
#include <array>
#include <functional>
#include <map>

#include "crowdface/core/contains.h"
#include "crowdface/core/file.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/log.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/progress.h"
#include "crowdface/core/text.h"
#include "crowdface/pictures/face_comparison.h"
#include "crowdface/pictures/sheet_labels.h"
#include "crowdface/render/heat_colours.h"

namespace crowdface {
namespace {

constexpr int kMaxRows = 64;  // maximum number of rows of heads or family members on one page

std::string counted(std::size_t count, const char* one, const char* many) {
  return concat(count, ' ', count == 1 ? one : many);
}

/// Writes the sheets of one crowd.
class CrowdSheets {
 public:
  explicit CrowdSheets(const PicturedCrowd& crowd)
      : crowd_(crowd),
        sheet_(*crowd.config.output.contact_sheet),
        compared_(crowd),
        pages_(crowd.directory.sheets(), sheet_.formats, title()) {}

  WrittenSheets write() {
    const std::size_t pages = write_faces();
    write_heads();
    write_families();
    add_shape_pages(crowd_, pages_);
    return {pages, pages_.finish()};
  }

 private:
  std::string title() const {
    return concat(crowd_.config.crowd.name, " · ", counted(crowd_.faces.size(), "face", "faces"),
                  " · seed ", crowd_.config.crowd.seed);
  }

  SheetCell cell(std::size_t face) const {
    SheetCell cell{read_render(crowd_.directory.render(crowd_.faces[face].id)),
                   sheet_label(sheet_.labels, crowd_.faces, face, crowd_.likeness,
                               crowd_.config.faces.names, crowd_.config.faces.tags)};
    if (sheet_.compare.reference == Config::MeshComparison::Reference::kNothing) return cell;
    const ComparedFace compared = compared_.compare(face);
    const VertexColours colours = heat_colours(compared.mm, sheet_.compare.scale_mm);
    cell.image = joined_pictures(
        std::vector{cell.image, crowd_.renders.render_front(compared.mesh, &colours)});
    cell.label += concat("\n", compared_.label(compared));
    return cell;
  }

  /// Returns the file name of a page without extension, such as "sheet_001", preceded by the name
  /// of its subfolder, if any. Creates the subfolder.
  std::string stem_of_page(std::size_t page) const {
    const std::filesystem::path path = crowd_.directory.sheet(page);
    make_directories(path.parent_path());
    return path.lexically_relative(crowd_.directory.sheets()).replace_extension().generic_string();
  }

  void add_page(const std::string& stem, const std::string& caption, const std::string& title,
                const std::string& note, const std::vector<SheetCell>& cells,
                const std::optional<HeatLegend>& legend) {
    pages_.add(
        stem, caption,
        contact_sheet(cells, {.columns = std::min(sheet_.columns,
                                                  std::max(1, static_cast<int>(cells.size()))),
                              .rows = 0,
                              .title = title,
                              .legend = legend,
                              .note = note}));
  }

  std::size_t write_faces() {
    const std::vector<std::size_t> order = sheet_order(sheet_.order, crowd_.faces, crowd_.likeness);
    const std::size_t per_page =
        static_cast<std::size_t>(sheet_.columns) * static_cast<std::size_t>(sheet_.rows);
    const std::size_t pages = sheet_page_count(sheet_, order.size());
    Progress progress("contact sheets", pages);
    for (std::size_t page = 0; page < pages; ++page) {
      throw_if_interrupted();
      const std::size_t first = page * per_page;
      std::vector<SheetCell> cells(std::min(per_page, order.size() - first));
      parallel_for_each(cells.size(), [&](std::size_t c) { cells[c] = cell(order[first + c]); });
      add_page(stem_of_page(page + 1),
               concat(crowd_.faces[order[first]].id, " to ",
                      crowd_.faces[order[first + cells.size() - 1]].id),
               title(), pages > 1 ? concat("sheet ", page + 1, " of ", pages) : std::string(),
               cells, compared_.legend());
      progress.step();
    }
    return pages;
  }

  /// Adds a sheet with as many rows as its cells need. Splits the sheet into several pages if one
  /// page would be too large.
  /// \param stem  returns the file name of a page without extension; takes the page number, from 1.
  void add_tall_pages(const std::function<std::string(std::size_t)>& stem,
                      const std::string& caption, const std::string& title, const std::string& note,
                      std::size_t count, const std::function<SheetCell(std::size_t)>& cell) {
    const std::size_t per_page =
        static_cast<std::size_t>(sheet_.columns) *
        static_cast<std::size_t>(std::min(
            kMaxRows,
            max_rows(sheet_.plain_cell_size(),
                     {.columns = sheet_.columns, .title = title, .legend = {}, .note = note})));
    const std::size_t pages = (count + per_page - 1) / per_page;
    for (std::size_t page = 0; page < pages; ++page) {
      throw_if_interrupted();
      const std::size_t first = page * per_page;
      std::vector<SheetCell> cells(std::min(per_page, count - first));
      parallel_for_each(cells.size(), [&](std::size_t c) { cells[c] = cell(first + c); });
      add_page(stem(page + 1), caption, title,
               pages > 1 ? concat(note, ", sheet ", page + 1, " of ", pages) : note, cells,
               std::nullopt);
    }
  }

  void write_heads() {
    const std::vector<std::string>& names = crowd_.config.faces.names;
    add_tall_pages([](std::size_t page) { return concat("heads_", zero_padded(page, 3)); },
                   "the heads", crowd_.config.crowd.name, counted(names.size(), "head", "heads"),
                   names.size(),
                   [&](std::size_t h) {
                     std::string label = names[h];
                     const auto& tags = crowd_.config.faces.tags[h];
                     if (!tags.empty()) label += concat("\n", join(tags));
                     return SheetCell{read_render(crowd_.directory.head_render(names[h])), label};
                   });
  }

  /// Writes one sheet per family: the family's ancestors or founder (the face from which the
  /// members are derived), then the members.
  void write_families() {
    std::map<std::string, std::vector<std::size_t>> families;
    for (std::size_t face = 0; face < crowd_.faces.size(); ++face) {
      if (crowd_.faces[face].family) families[*crowd_.faces[face].family].push_back(face);
    }
    for (const auto& family : families) write_family(family.first, family.second);
  }

  /// The sheet of a family with parents is a family tree with a row per generation: grandparents,
  /// parents, children. On the sheet of a family without parents, the founder comes first.
  void write_family(const std::string& family, const std::vector<std::size_t>& members) {
    const std::vector<std::string>& parents = crowd_.faces[members.front()].parents;
    std::vector<Relative> cells;
    if (!parents.empty()) {
      std::vector<Relative> grandparents;
      const std::array<std::string, 2> roles = {"mother", "father"};
      for (std::size_t p = 0; p < 2; ++p) {
        cells.push_back(relative(parents[p], roles[p]));
        const FacePlan* parent = face_called(parents[p]);
        for (std::size_t g = 0; parent != nullptr && g < parent->parents.size(); ++g) {
          grandparents.push_back(
              relative(parent->parents[g], concat("the ", roles[p], "'s ", roles[g])));
        }
      }
      fill_row(grandparents);
      fill_row(cells);
      cells.insert(cells.begin(), grandparents.begin(), grandparents.end());
    } else if (const auto founder = founder_of(family, members.front())) {
      cells.push_back({*founder, "founder\nnot in the crowd"});
    }
    for (const std::size_t member : members) {
      cells.push_back({crowd_.directory.render(crowd_.faces[member].id), label_of_member(member)});
    }
    const auto cell = [&](std::size_t i) -> SheetCell {
      const Relative& shown = cells[i];
      if (!shown.picture.empty()) return {read_render(shown.picture), shown.label};
      const Rgb8Image face = read_render(crowd_.directory.render(crowd_.faces[members.front()].id));
      return {pad_picture({}, face.width, face.height), ""};
    };
    // Separate the parts of the file name by '+', which names of families do not contain.
    const auto stem = [&](std::size_t page) {
      return concat("family_", family, page > 1 ? concat('+', page) : std::string());
    };
    add_tall_pages(stem, concat("family ", family), concat("family ", family),
                   counted(members.size(), "member", "members"), cells.size(), cell);
  }

  /// The content of one cell of a family's sheet. If `picture` is empty, the cell is blank.
  struct Relative {
    std::filesystem::path picture;
    std::string label;
  };

  void fill_row(std::vector<Relative>& cells) const {
    while (cells.size() % static_cast<std::size_t>(sheet_.columns) != 0) cells.emplace_back();
  }

  /// Returns the face with the id `name`; null if a head has this name or no face has this id.
  const FacePlan* face_called(const std::string& name) const {
    if (contains(crowd_.config.faces.names, name)) return nullptr;
    const auto found = std::ranges::find(crowd_.faces, name, &FacePlan::id);
    return found == crowd_.faces.end() ? nullptr : &*found;
  }

  Relative relative(const std::string& name, const std::string& role) const {
    return {face_called(name) != nullptr ? crowd_.directory.render(name)
                                         : crowd_.directory.head_render(name),
            concat(name, '\n', role)};
  }

  /// The label of a family member. The label of a child names what the child inherits. The label of
  /// any other member names the most similar face.
  std::string label_of_member(std::size_t member) const {
    const FacePlan& face = crowd_.faces[member];
    if (face.parents.empty()) {
      return sheet_label({SheetLabel::kId, SheetLabel::kNearest}, crowd_.faces, member,
                         crowd_.likeness, crowd_.config.faces.names, crowd_.config.faces.tags);
    }
    return inheritance_label(face, crowd_.config.plan_names());
  }

  /// Returns the image file of a family's founder; nothing if the file is missing, or if the image
  /// has another size than the images of the members.
  std::optional<std::filesystem::path> founder_of(const std::string& family,
                                                  std::size_t member) const {
    const std::filesystem::path path = crowd_.directory.founder_render(family);
    if (!std::filesystem::exists(path)) return std::nullopt;
    const Rgb8Image founder = read_render(path);
    const Rgb8Image other = read_render(crowd_.directory.render(crowd_.faces[member].id));
    if (founder.width == other.width && founder.height == other.height) return path;
    log_info(concat("the founder of ", family,
                    " is left out of its sheet: its picture has another size, and ",
                    "there is no mesh to render it again; run crowdface generate"));
    return std::nullopt;
  }

  const PicturedCrowd& crowd_;
  const Config::ContactSheet& sheet_;
  FaceComparison compared_;
  SheetWriter pages_;
};

}  // namespace

std::size_t sheet_page_count(const Config::ContactSheet& sheet, std::size_t faces) {
  const std::size_t per_page =
      static_cast<std::size_t>(sheet.columns) * static_cast<std::size_t>(sheet.rows);
  return (faces + per_page - 1) / per_page;
}

WrittenSheets write_sheets(const PicturedCrowd& crowd) {
  make_directories(crowd.directory.sheets());
  WrittenSheets sheets = CrowdSheets(crowd).write();
  for (const std::filesystem::path& old : crowd_sheets(crowd.directory)) {
    if (!contains(sheets.files, old)) remove_if_exists(old);
  }
  return sheets;
}

}  // namespace crowdface
