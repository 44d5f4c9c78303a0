// SPDX-License-Identifier: Apache-2.0
// The config section `output`.
#include <algorithm>
#include <charconv>

#include "crowdface/config/config_keys.h"
#include "crowdface/config/starter_config.h"
#include "crowdface/core/file.h"
#include "crowdface/render/contact_sheet.h"

namespace crowdface {
namespace {

using Sheet = Config::ContactSheet;
using Output = Config::Output;
using Reference = Config::MeshComparison::Reference;

constexpr double kLongestScaleMm = 1000;
constexpr std::uint64_t kMaxFacesPerFolder = 1'000'000;

void read_comparison(const YamlNode& node, Sheet& sheet, ConfigDraft& draft) {
  const auto file = path("none, target, nearest, or a file or crowd folder").read(node, draft);
  if (!file) return;
  const auto& words = words_of<Reference>();
  const auto word = std::ranges::find_if(
      words, [&](const Word<Reference>& known) { return known.text == node.text; });
  if (word != words.end()) {
    sheet.compare.reference = word->value;
  } else {
    sheet.compare = {Reference::kFile, *file, sheet.compare.scale_mm};
    if (!is_folder(*file)) {
      expect_file(node, *file, draft,
                  "expected none, target, nearest, or an existing file or crowd folder; ");
    }
  }
  if (sheet.compare.reference != Reference::kNothing && draft.config.output.meshes.empty()) {
    draft.complaints.add_at(node, "a comparison needs meshes, but output.meshes is empty");
  }
}

std::string write_comparison(const Sheet& sheet, const WriteContext& context) {
  return sheet.compare.reference == Reference::kFile
             ? path("").write(sheet.compare.file, context)
             : std::string(word_of(sheet.compare.reference));
}

/// Parses a colour such as "#rrggbb".
std::optional<std::array<std::uint8_t, 3>> parse_colour(std::string_view text) {
  std::uint32_t colour = 0;
  const char* const end = text.data() + text.size();
  if (text.size() != 7 || std::from_chars(text.data() + 1, end, colour, 16).ptr != end) {
    return std::nullopt;
  }
  const auto byte = [&](unsigned shift) { return static_cast<std::uint8_t>(colour >> shift); };
  return std::array{byte(16), byte(8), byte(0)};
}

std::string write_colour(const std::array<std::uint8_t, 3>& colour) {
  std::string text = "\"#";
  for (const std::uint8_t value : colour) text += hex(value, 2);
  return text + '"';
}

void read_surfaces(const YamlNode& node, Output& output, ConfigDraft& draft) {
  draft.complaints.expect_map(node, "a mapping from materials to surfaces, {M_Lashes: hidden}");
  for (const auto& [name, place, value] : node.entries) {
    MaterialAppearance& surface = output.surfaces[name];
    if (value.kind == YamlNode::Kind::kScalar && value.text.starts_with('#')) {
      surface.colour = parse_colour(value.text);
      if (!surface.colour) draft.complaints.add_mismatch(value, "a colour such as \"#c0a080\"");
    } else {
      surface.kind = word<SurfaceKind>().read(value, draft).value_or(surface.kind);
    }
  }
}

/// Parses a percentage such as "20 %"; accepts values above 0 and below 100.
std::optional<double> parse_percent(std::string_view text) {
  if (!text.ends_with('%')) return std::nullopt;
  text.remove_suffix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  const auto percent = parse_double(text);
  if (!percent || !(*percent > 0 && *percent < 100)) return std::nullopt;
  return percent;
}

/// Returns whether a name is used for levels of detail: "LOD1" and so on.
bool is_level_name(std::string_view name) {
  return name.starts_with("LOD") && parse_unsigned(name.substr(3)).has_value();
}

void read_lods(const YamlNode& node, Output& output, ConfigDraft& draft) {
  constexpr std::size_t kMaxLevels = 8;
  constexpr const char* kExpected = "a decreasing list of up to 8 percentages, [50 %, 20 %, 5 %]";
  draft.complaints.expect_list(node, kExpected);
  for (const YamlNode& child : node.items) {
    const auto percent =
        child.kind == YamlNode::Kind::kScalar ? parse_percent(child.text) : std::nullopt;
    if (!percent || (!output.lods.empty() && *percent >= output.lods.back()) ||
        output.lods.size() == kMaxLevels) {
      draft.complaints.add_mismatch(child, kExpected);
      return;
    }
    output.lods.push_back(*percent);
  }
  if (output.lods.empty()) return;
  const auto& names = draft.config.shapes.names;
  const auto name = std::ranges::find_if(names, is_level_name);
  if (name != names.end()) {
    draft.complaints.add_at(node,
                            concat("a shape is called ", *name,
                                   ", which is the name of a level of detail; rename the shape"));
  }
}

std::string write_lods(const Output& output, const WriteContext&) {
  return yaml_flow_list(
      texts_of(output.lods, [](double percent) { return concat(percent, " %"); }));
}

std::string write_surfaces(const Output& output, const WriteContext&) {
  return yaml_flow_map(texts_of(output.surfaces, [](const auto& named) {
    const auto& [name, surface] = named;
    return yaml_entry(write_scalar(name),
                      surface.colour ? write_colour(*surface.colour) : word_of(surface.kind));
  }));
}

/// Adds a complaint about the key `shapes` of a contact sheet if the config has no shapes or writes
/// no meshes. Always returns true, because this function itself reports an invalid value.
///
/// \param faces  number of faces whose shapes the sheet should show.
bool check_sheet_shapes(std::uint64_t faces, const YamlNode& node, ConfigDraft& draft) {
  if (faces > 0 && draft.config.shapes.names.empty()) {
    draft.complaints.add_at(node, "the config has no shapes; add the key shapes");
  }
  if (faces > 0 && draft.config.output.meshes.empty()) {
    draft.complaints.add_at(node, "shapes are rendered from meshes, but output.meshes is empty");
  }
  return true;
}

const Keys<Sheet>& contact_sheet_keys() {
  static const Keys<Sheet> keys = {
      key("columns", &Sheet::columns, whole_number(1, 32)).not_affecting_face_files(),
      key("rows", &Sheet::rows, whole_number(1, 64)).not_affecting_face_files(),
      key("cell", &Sheet::cell, whole_number(32, 2048)),
      key("views", &Sheet::views,
          words<View>("a list of views, [front, three_quarter, profile, back]")),
      key("labels", &Sheet::labels, words<SheetLabel>("a list of labels, [id, target, nearest]"))
          .not_affecting_face_files(),
      word_key("order", &Sheet::order).not_affecting_face_files(),
      Key<Sheet>{"compare", read_comparison, write_comparison}
          .with_accepted_values(concat(quoted_words<Reference>(), ", or a file or crowd folder"))
          .not_affecting_face_files(),
      Key<Sheet>{"compare_scale",
                 [](const YamlNode& node, Sheet& sheet, ConfigDraft& draft) {
                   const auto scale = positive_length(kLongestScaleMm).read(node, draft);
                   sheet.compare.scale_mm = scale.value_or(sheet.compare.scale_mm);
                 },
                 [](const Sheet& sheet, const WriteContext& context) {
                   return length(kLongestScaleMm).write(sheet.compare.scale_mm, context);
                 }}
          .with_accepted_values(positive_length(kLongestScaleMm).accepted_values)
          .not_affecting_face_files(),
      key("formats", &Sheet::formats, words<SheetFormat>("a list of formats, [png, exr, pdf]"))
          .not_affecting_face_files(),
      key("shapes", &Sheet::face_count_on_shape_pages,
          restricted(whole_number(0, 64), check_sheet_shapes))
          .not_affecting_face_files(),
      word_key("texture", &Sheet::texture)};
  return keys;
}

/// Returns whether the pages of a contact sheet with these options stay below the size limit.
bool fits_on_a_page(const Sheet& sheet) {
  CellSize cell = sheet.plain_cell_size();
  cell.label_lines = std::max(cell.label_lines, static_cast<int>(sheet.labels.size()));
  SheetOptions options{.columns = sheet.columns, .title = "title", .legend = {}, .note = {}};
  if (sheet.compare.reference != Reference::kNothing) {
    cell.width += sheet.cell;
    cell.label_lines += 1;
    options.legend.emplace();
  }
  return sheet.rows <= max_rows(cell, options);
}

void read_contact_sheet(const YamlNode& node, Output& output, ConfigDraft& draft) {
  if (is_word(node, "none")) return output.contact_sheet.reset();
  if (!draft.complaints.expect_map(node,
                                   "none or a mapping with the keys columns, rows, cell, views")) {
    return;
  }
  read_keys(node, contact_sheet_keys(), *output.contact_sheet, draft);
  if (!fits_on_a_page(*output.contact_sheet)) {
    draft.complaints.add_at(node,
                            "a page with this cell size, rows and columns is too large (at most "
                            "65500 pixels per side and 5e8 in total)");
  }
}

std::string write_contact_sheet(const Output& output, const WriteContext& context) {
  if (!output.contact_sheet) return "none";
  return yaml_block_map(write_keys(contact_sheet_keys(), *output.contact_sheet, context));
}

/// Returns the lines for the key `contact_sheet` in a starter config: the first four keys of a
/// contact sheet, which users change most often, with their default values.
StarterLines starter_sheet(const StarterFacts&) {
  std::vector<std::string> entries = write_keys(contact_sheet_keys(), Sheet{}, {Config{}, {}});
  entries.resize(4);
  return {yaml_flow_map(entries)};
}

/// Returns the names of all mesh formats except the first format.
std::vector<std::string> other_formats() {
  std::vector<std::string> words =
      texts_of(all_mesh_formats(), [](MeshFormat format) { return name_of(format); });
  words.erase(words.begin());
  return words;
}

}  // namespace

const Keys<Output>& output_keys() {
  static const Keys<Output> keys = {
      key("directory", &Output::directory, path("a folder"))
          .with_starter_lines([](const StarterFacts& facts) {
            return StarterLines{write_scalar(concat("out/", facts.crowd_name))};
          })
          .not_affecting_face_files(),
      key("meshes", &Output::meshes,
          words<MeshFormat>("a list, such as [obj], or [] for no meshes", 0))
          .with_starter_lines(
              {"[obj]", concat("and ", join(other_formats()), "; [] for pictures only")}),
      Key<Output>{"lods", read_lods, write_lods}.with_accepted_values(
          "decreasing list of up to 8 percentages"),
      word_key("subdivision", &Output::subdivision),
      word_key("gallery", &Output::gallery),
      key("faces_per_folder", &Output::faces_per_folder, whole_number(0, kMaxFacesPerFolder)),
      Key<Output>{"surfaces", read_surfaces, write_surfaces}.with_accepted_values(
          concat("`{material: surface}`, a surface is one of ", quoted_words<SurfaceKind>(),
                 " or a colour `\"#rrggbb\"`")),
      Key<Output>{"contact_sheet", read_contact_sheet, write_contact_sheet, {}, starter_sheet}
          .with_nested_keys(contact_sheet_keys())};
  return keys;
}

}  // namespace crowdface
