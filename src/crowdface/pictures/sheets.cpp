// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pictures/sheets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <system_error>

#include "crowdface/blend/blend.h"
#include "crowdface/config/sheet_page_size.h"
#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/log.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/progress.h"
#include "crowdface/core/rounded.h"
#include "crowdface/core/text.h"
#include "crowdface/crowd/face_mesh.h"
#include "crowdface/io/obj_file.h"
#include "crowdface/mesh/alignment.h"
#include "crowdface/pictures/sheet_writer.h"
#include "crowdface/render/heat_colours.h"

namespace crowdface {
namespace {

using With = Config::Comparison::With;

constexpr int kMostRows = 64;  // of heads or of a family's members on one page

std::string counted(std::size_t count, const char* one, const char* many) {
  return concat(count, ' ', count == 1 ? one : many);
}

/// \throws MissingInput if it cannot be said, as of what is in a folder that may not be read.
bool is_there(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (std::filesystem::status_known(status)) return std::filesystem::exists(status);
  throw MissingInput(concat(path.string(), ": cannot be read: ", error.message()));
}

/// In which format a crowd has a face. \throws MissingInput if in none.
MeshFormat format_of_face(const CrowdDirectory& directory, const std::string& id) {
  for (const MeshFormat format : all_mesh_formats()) {
    if (is_there(directory.mesh(id, format))) return format;
  }
  throw MissingInput(
      concat(directory.root.string(), ": holds no mesh of ", quoted(id), " to compare with"));
}

/// The mesh with which all faces are compared.
Positions read_reference(const std::filesystem::path& file, Index vertices) {
  Positions positions = read_obj(file).positions;
  if (positions.rows() == vertices) return positions;
  throw InvalidInput(concat(file.string(), ": expected ", vertices,
                            " vertices to compare with, found ", positions.rows()));
}

/// The sheets of one crowd.
class CrowdSheets {
 public:
  CrowdSheets(const Config& config, const Config::ContactSheet& sheet, const Inputs& inputs,
              const CrowdDirectory& directory, const CrowdRenders& renders,
              const std::vector<CastFace>& crowd, const Likeness& likeness)
      : config_(config),
        sheet_(sheet),
        inputs_(inputs),
        directory_(directory),
        renders_(renders),
        crowd_(crowd),
        likeness_(likeness),
        pages_(directory.sheets(), sheet.formats, title()) {
    if (sheet.compare.with == With::kFile && !std::filesystem::is_directory(sheet.compare.file)) {
      reference_ = read_reference(sheet.compare.file, inputs.faces.topology.vertex_count);
    }
  }

  WrittenSheets write() {
    const std::size_t pages = write_faces();
    write_heads();
    write_families();
    return {pages, pages_.finish()};
  }

 private:
  std::string title() const {
    return concat(config_.crowd.name, " · ", counted(crowd_.size(), "face", "faces"), " · seed ",
                  config_.crowd.seed);
  }

  Positions mesh_of(std::size_t face) const {
    return read_face(directory_, crowd_[face].id, config_.output.meshes,
                     inputs_.faces.topology.vertex_count);
  }

  /// What a face is compared with; nothing if it has no neighbour.
  std::optional<Positions> compared_with(std::size_t face) const {
    switch (sheet_.compare.with) {
      case With::kTarget:
        return target_positions(inputs_.faces, crowd_[face].recipe);
      case With::kNearest:
        if (likeness_.near[face].empty()) return std::nullopt;
        return mesh_of(likeness_.near[face].front().face);
      case With::kFile:
        if (reference_.rows() > 0) return reference_;
        return read_face({sheet_.compare.file}, crowd_[face].id,
                         {format_of_face({sheet_.compare.file}, crowd_[face].id)},
                         inputs_.faces.topology.vertex_count);
      case With::kNothing:
        break;
    }
    return std::nullopt;
  }

  /// How far each point of a face is from the same point of the other, moved onto it.
  Eigen::VectorXd differences_mm(const Positions& face, const Positions& other) const {
    const Similarity move = fit_similarity(other, face, ScaleFit::kRigid);
    return mm_per(config_.faces.units) * (move.apply(other) - face).rowwise().norm();
  }

  SheetCell cell(std::size_t face) const {
    SheetCell cell{read_render(directory_.render(crowd_[face].id)),
                   sheet_label(sheet_.labels, crowd_, face, likeness_, config_.faces.names)};
    if (sheet_.compare.with == With::kNothing) return cell;
    const Positions mesh = mesh_of(face);
    const auto other = compared_with(face);
    const Eigen::VectorXd mm =
        other ? differences_mm(mesh, *other) : Eigen::VectorXd::Zero(mesh.rows());
    const VertexColours colours = heat_colours(mm, sheet_.compare.scale_mm);
    cell.image = side_by_side(std::vector{cell.image, renders_.render_front(mesh, &colours)});
    const double rms = mm.size() > 0 ? mm.norm() / std::sqrt(static_cast<double>(mm.size())) : 0;
    cell.label += concat("\nrms ", format_fixed(rms, digits()), " mm, largest ",
                         format_fixed(mm.size() > 0 ? mm.maxCoeff() : 0, digits()), " mm");
    return cell;
  }

  /// As many behind the point as the scale calls for.
  int digits() const {
    return std::clamp(2 - static_cast<int>(std::floor(std::log10(sheet_.compare.scale_mm))), 2, 6);
  }

  std::optional<HeatLegend> legend() const {
    switch (sheet_.compare.with) {
      case With::kTarget:
        return HeatLegend{sheet_.compare.scale_mm, "distance from its target"};
      case With::kNearest:
        return HeatLegend{sheet_.compare.scale_mm, "distance from its nearest face"};
      case With::kFile:
        return HeatLegend{sheet_.compare.scale_mm,
                          concat("distance from ", sheet_.compare.file.filename().string())};
      case With::kNothing:
        break;
    }
    return std::nullopt;
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
    const std::vector<std::size_t> order = sheet_order(sheet_.order, crowd_, likeness_);
    const std::size_t per_page =
        static_cast<std::size_t>(sheet_.columns) * static_cast<std::size_t>(sheet_.rows);
    const std::size_t pages = sheet_page_count(sheet_, order.size());
    Progress progress("contact sheets", pages);
    for (std::size_t page = 0; page < pages; ++page) {
      throw_if_interrupted();
      const std::size_t first = page * per_page;
      std::vector<SheetCell> cells(std::min(per_page, order.size() - first));
      parallel_for_each(static_cast<Index>(cells.size()), [&](Index c) {
        const auto i = static_cast<std::size_t>(c);
        cells[i] = cell(order[first + i]);
      });
      add_page(directory_.sheet(page + 1).stem().string(),
               concat(crowd_[order[first]].id, " to ", crowd_[order[first + cells.size() - 1]].id),
               title(), pages > 1 ? concat("sheet ", page + 1, " of ", pages) : std::string(),
               cells, legend());
      progress.step();
    }
    return pages;
  }

  /// Cells in as many rows as they need; on several pages if one would be too large.
  /// \param stem  of a page's file, from its number, from 1.
  void add_tall_pages(const std::function<std::string(std::size_t)>& stem,
                      const std::string& caption, const std::string& title, const std::string& note,
                      std::size_t count, const std::function<SheetCell(std::size_t)>& cell) {
    const std::size_t per_page =
        static_cast<std::size_t>(sheet_.columns) *
        static_cast<std::size_t>(std::min(
            kMostRows,
            most_rows(plain_cell_size(sheet_),
                      {.columns = sheet_.columns, .title = title, .legend = {}, .note = note})));
    const std::size_t pages = (count + per_page - 1) / per_page;
    for (std::size_t page = 0; page < pages; ++page) {
      throw_if_interrupted();
      std::vector<SheetCell> cells;
      for (std::size_t i = page * per_page; i < std::min(count, (page + 1) * per_page); ++i) {
        cells.push_back(cell(i));
      }
      add_page(stem(page + 1), caption, title,
               pages > 1 ? concat(note, ", sheet ", page + 1, " of ", pages) : note, cells,
               std::nullopt);
    }
  }

  void write_heads() {
    const std::vector<std::string>& names = config_.faces.names;
    add_tall_pages([](std::size_t page) { return concat("heads_", zero_padded(page, 3)); },
                   "the heads", config_.crowd.name, counted(names.size(), "head", "heads"),
                   names.size(),
                   [&](std::size_t h) {
                     std::string label = names[h];
                     const auto& tags = config_.faces.tags[h];
                     if (!tags.empty()) label += concat("\n", join(tags));
                     return SheetCell{read_render(directory_.head_render(names[h])), label};
                   });
  }

  /// Each family on a sheet of its own, after those whom its members take after.
  void write_families() {
    std::map<std::string, std::vector<std::size_t>> families;
    for (std::size_t face = 0; face < crowd_.size(); ++face) {
      if (crowd_[face].family) families[*crowd_[face].family].push_back(face);
    }
    for (const auto& family : families) write_family(family.first, family.second);
  }

  /// With parents a tree, a generation a row: grandparents, parents, children. Else the founder first.
  void write_family(const std::string& family, const std::vector<std::size_t>& members) {
    const std::vector<std::string>& parents = crowd_[members.front()].parents;
    std::vector<Relative> cells;
    if (!parents.empty()) {
      std::vector<Relative> grandparents;
      const std::array<std::string, 2> roles = {"mother", "father"};
      for (std::size_t p = 0; p < 2; ++p) {
        cells.push_back(relative(parents[p], roles[p]));
        const CastFace* parent = face_called(parents[p]);
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
      cells.push_back({directory_.render(crowd_[member].id), label_of_member(member)});
    }
    const auto cell = [&](std::size_t i) -> SheetCell {
      const Relative& shown = cells[i];
      if (!shown.picture.empty()) return {read_render(shown.picture), shown.label};
      const Rgb8Image face = read_render(directory_.render(crowd_[members.front()].id));
      return {padded({}, face.width, face.height), ""};
    };
    // No family's name holds a '+'.
    const auto stem = [&](std::size_t page) {
      return concat("family_", family, page > 1 ? concat('+', page) : std::string());
    };
    add_tall_pages(stem, concat("family ", family), concat("family ", family),
                   counted(members.size(), "member", "members"), cells.size(), cell);
  }

  /// A cell of a family's sheet; without a picture a blank one.
  struct Relative {
    std::filesystem::path picture;
    std::string label;
  };

  void fill_row(std::vector<Relative>& cells) const {
    while (cells.size() % static_cast<std::size_t>(sheet_.columns) != 0) cells.emplace_back();
  }

  /// The face of that id, if it is one of the crowd and no head.
  const CastFace* face_called(const std::string& name) const {
    const auto& heads = config_.faces.names;
    if (std::find(heads.begin(), heads.end(), name) != heads.end()) return nullptr;
    const auto found = std::find_if(crowd_.begin(), crowd_.end(),
                                    [&](const CastFace& face) { return face.id == name; });
    return found == crowd_.end() ? nullptr : &*found;
  }

  Relative relative(const std::string& name, const std::string& role) const {
    return {face_called(name) != nullptr ? directory_.render(name) : directory_.head_render(name),
            concat(name, '\n', role)};
  }

  /// Who gave what, or for those of no parents who is nearest.
  std::string label_of_member(std::size_t member) const {
    const CastFace& face = crowd_[member];
    if (face.parents.empty()) {
      return sheet_label({SheetLabel::kId, SheetLabel::kNearest}, crowd_, member, likeness_,
                         config_.faces.names);
    }
    std::string label = face.id;
    if (face.mother_share > 0) {
      label += concat("\nform ", std::lround(100 * face.mother_share), " % mother");
    }
    for (const std::string role : {"mother", "father"}) {
      std::vector<std::string> regions;
      for (std::size_t k = 0; k < face.inherits.size(); ++k) {
        if (face.inherits[k] == role) regions.push_back(config_.region_names()[k]);
      }
      if (!regions.empty()) label += concat("\n", role, ": ", join(regions));
    }
    return label;
  }

  /// The picture of a family's founder, if there is one that can stand beside the members'.
  std::optional<std::filesystem::path> founder_of(const std::string& family,
                                                  std::size_t member) const {
    const std::filesystem::path path = directory_.founder_render(family);
    if (!std::filesystem::exists(path)) return std::nullopt;
    const Rgb8Image founder = read_render(path);
    const Rgb8Image other = read_render(directory_.render(crowd_[member].id));
    if (founder.width == other.width && founder.height == other.height) return path;
    log_info(concat("the founder of ", family, " is left out of its sheet: there is no mesh to ",
                    "make a picture of another size from; crowdface generate does it"));
    return std::nullopt;
  }

  const Config& config_;
  const Config::ContactSheet& sheet_;
  const Inputs& inputs_;
  const CrowdDirectory& directory_;
  const CrowdRenders& renders_;
  const std::vector<CastFace>& crowd_;
  const Likeness& likeness_;
  SheetWriter pages_;
  Positions reference_;  ///< the one mesh that all are compared with, or empty
};

/// "ann", or of a mixture "ann 60 %, bob 40 %".
std::string target_label(const Recipe& recipe, const std::vector<std::string>& heads) {
  if (recipe.mixture.empty()) return heads[static_cast<std::size_t>(recipe.target)];
  std::vector<std::string> parts;
  for (const SourceWeight& part : recipe.mixture) {
    parts.push_back(concat(heads[static_cast<std::size_t>(part.head)], ' ',
                           std::lround(100 * part.weight), " %"));
  }
  return join(parts);
}

}  // namespace

std::size_t sheet_page_count(const Config::ContactSheet& sheet, std::size_t faces) {
  const std::size_t per_page =
      static_cast<std::size_t>(sheet.columns) * static_cast<std::size_t>(sheet.rows);
  return (faces + per_page - 1) / per_page;
}

std::vector<std::size_t> sheet_order(SheetOrder order, const std::vector<CastFace>& crowd,
                                     const Likeness& likeness) {
  if (order == SheetOrder::kLikeness) return likeness.order;
  std::vector<std::size_t> faces(crowd.size());
  std::iota(faces.begin(), faces.end(), std::size_t{0});
  if (order == SheetOrder::kPlan) return faces;
  const auto kin = order == SheetOrder::kFamily ? &CastFace::family : &CastFace::group;
  std::stable_sort(faces.begin(), faces.end(), [&](std::size_t a, std::size_t b) {
    const auto& left = crowd[a].*kin;
    const auto& right = crowd[b].*kin;
    return left && (!right || *left < *right);  // those of none last
  });
  return faces;
}

std::string sheet_label(const std::vector<SheetLabel>& labels, const std::vector<CastFace>& crowd,
                        std::size_t face, const Likeness& likeness,
                        const std::vector<std::string>& heads) {
  const CastFace& labelled = crowd[face];
  const auto line = [&](SheetLabel label) -> std::string {
    switch (label) {
      case SheetLabel::kId:
        return labelled.id;
      case SheetLabel::kFamily:
        return labelled.family ? concat("family ", *labelled.family) : std::string();
      case SheetLabel::kGroup:
        return labelled.group ? concat("group ", *labelled.group) : std::string();
      case SheetLabel::kTarget:
        return concat("on ", target_label(labelled.recipe, heads));
      case SheetLabel::kNearest: {
        if (likeness.near[face].empty()) return {};
        const Neighbour& near = likeness.near[face].front();
        return concat("near ", crowd[near.face].id, ", ", format_fixed(rounded(near.mm), 2), " mm");
      }
      case SheetLabel::kNearestHead:
        if (!labelled.notes.nearest) return {};
        return concat("near ", heads[static_cast<std::size_t>(labelled.notes.nearest->head)], ", ",
                      format_fixed(rounded(labelled.notes.nearest->head_mm), 2), " mm");
    }
    return {};
  };
  std::vector<std::string> lines;
  for (const SheetLabel label : labels) lines.push_back(line(label));
  std::string text;
  for (std::size_t i = 0; i < lines.size(); ++i) text += concat(i > 0 ? "\n" : "", lines[i]);
  return text;
}

void check_compared_mesh(const Config& config, const Inputs& inputs, Problems& problems) {
  const auto& sheet = config.output.contact_sheet;
  if (!sheet || sheet->compare.with != With::kFile) return;
  const std::filesystem::path& file = sheet->compare.file;
  try {
    if (!is_there(file) || !std::filesystem::is_directory(file)) {
      read_reference(file, inputs.faces.topology.vertex_count);
    }
  } catch (const Error& error) {
    problems.add(error);
  }
}

void check_compared_crowd(const Config& config, const std::vector<CastFace>& crowd) {
  const auto& sheet = config.output.contact_sheet;
  if (!sheet || sheet->compare.with != With::kFile) return;
  const std::filesystem::path& folder = sheet->compare.file;
  if (!std::filesystem::is_directory(folder)) return;
  for (const CastFace& face : crowd) format_of_face({folder}, face.id);
}

WrittenSheets write_sheets(const Config& config, const Config::ContactSheet& sheet,
                           const Inputs& inputs, const CrowdDirectory& directory,
                           const CrowdRenders& renders, const std::vector<CastFace>& crowd,
                           const Likeness& likeness) {
  make_directories(directory.sheets());
  WrittenSheets sheets =
      CrowdSheets(config, sheet, inputs, directory, renders, crowd, likeness).write();
  for (const std::filesystem::path& old : crowd_sheets(directory)) {
    if (std::find(sheets.files.begin(), sheets.files.end(), old) != sheets.files.end()) continue;
    std::error_code ignored;
    std::filesystem::remove(old, ignored);
  }
  return sheets;
}

}  // namespace crowdface
