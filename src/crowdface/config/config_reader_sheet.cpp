// SPDX-License-Identifier: Apache-2.0
// The keys `output.contact_sheet` and `output.surfaces`.
#include <algorithm>

#include "crowdface/config/config_keys.h"
#include "crowdface/config/sheet_page_size.h"

namespace crowdface {
namespace {

constexpr double kLongestScaleMm = 1000;

void read_comparison(const YamlNode& node, Config::ContactSheet& sheet, ConfigDraft& draft) {
  Config::Comparison& compare = sheet.compare;
  using With = Config::Comparison::With;
  const auto text =
      read_text(node, "none, target, nearest, or a file or crowd folder", draft.complaints);
  if (!text) return;
  const auto& words = words_of<With>();
  const auto word = std::find_if(words.begin(), words.end(),
                                 [&](const Word<With>& known) { return known.text == *text; });
  if (word != words.end()) {
    compare.with = word->value;
  } else {
    compare.with = With::kFile;
    compare.file = resolve(draft.folder, *text);
    if (!file_exists(compare.file)) {
      draft.complaints.about(node,
                             concat("expected none, target, nearest, or a file that is there; ",
                                    quoted(compare.file.string()), " is missing"),
                             ExitCode::kMissingInput);
    }
  }
  if (compare.with != With::kNothing && draft.config.output.meshes.empty()) {
    draft.complaints.about(node, "comparing needs meshes, and output.meshes asks for none");
  }
}

std::string write_comparison(const Config::ContactSheet& sheet,
                             const std::filesystem::path& folder) {
  const Config::Comparison& compare = sheet.compare;
  return compare.with == Config::Comparison::With::kFile ? write_path(compare.file, folder)
                                                         : std::string(word_of(compare.with));
}

/// "#rrggbb".
std::optional<std::array<std::uint8_t, 3>> parse_colour(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  if (text.size() != 7) return std::nullopt;
  std::array<std::uint8_t, 3> colour{};
  for (std::size_t i = 0; i < 6; ++i) {
    const char c = text[i + 1];
    const std::size_t digit =
        kDigits.find(c >= 'A' && c <= 'F' ? static_cast<char>(c - 'A' + 'a') : c);
    if (digit == kDigits.npos) return std::nullopt;
    colour[i / 2] = static_cast<std::uint8_t>(16 * colour[i / 2] + digit);
  }
  return colour;
}

}  // namespace

const Keys<Config::ContactSheet>& contact_sheet_keys() {
  using Sheet = Config::ContactSheet;
  static const Keys<Sheet> keys = {
      whole_key("columns", &Sheet::columns, 1, 32),
      whole_key("rows", &Sheet::rows, 1, 64),
      whole_key("cell", &Sheet::cell, 32, 2048),
      words_key("views", &Sheet::views, "a list of views, [front, three_quarter, profile]"),
      words_key("labels", &Sheet::labels, "a list of labels, [id, target, nearest]"),
      word_key("order", &Sheet::order),
      {"compare", read_comparison, write_comparison},
      {"compare_scale",
       [](const YamlNode& node, Sheet& sheet, ConfigDraft& draft) {
         read_positive_mm(node, kLongestScaleMm, sheet.compare.scale_mm, draft.complaints);
       },
       [](const Sheet& sheet, const auto&) { return write_mm(sheet.compare.scale_mm); }},
      words_key("formats", &Sheet::formats, "a list of formats, [png, exr, pdf]"),
      word_key("texture", &Sheet::texture)};
  return keys;
}

void read_contact_sheet(const YamlNode* node, ConfigDraft& draft) {
  auto& sheet = draft.config.output.contact_sheet;
  Complaints& out = draft.complaints;
  if (node == nullptr) return;
  if (node->kind == YamlNode::Kind::kScalar && node->text == "none") {
    sheet.reset();
    return;
  }
  if (!out.expect_map(*node, "none or a mapping with the keys columns, rows, cell, views")) return;
  read_keys(node, contact_sheet_keys(), *sheet, draft);
  if (!fits_on_a_page(*sheet)) {
    out.about(*node,
              "one page of so many cells, rows and columns is too large (at most 65500 "
              "pixels a side and 5e8 in all)");
  }
}

void read_surfaces(const YamlNode* node, ConfigDraft& draft) {
  if (node == nullptr) return;
  if (!draft.complaints.expect_map(*node,
                                   "a mapping from materials to surfaces, {M_Lashes: hidden}"))
    return;
  for (const YamlEntry& entry : node->entries) {
    SurfaceChoice& surface = draft.config.output.surfaces[entry.key];
    if (entry.value.kind == YamlNode::Kind::kScalar && entry.value.text.starts_with('#')) {
      surface.colour = parse_colour(entry.value.text);
      if (!surface.colour) draft.complaints.expected(entry.value, "a colour such as \"#c0a080\"");
    } else {
      read_choice_into(&entry.value, surface.kind, draft.complaints);
    }
  }
}

}  // namespace crowdface
