// SPDX-License-Identifier: Apache-2.0
// The keys `output.contact_sheet` and `output.surfaces`.
#include <algorithm>

#include "crowdface/config/config_sections.h"
#include "crowdface/config/sheet_page_size.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

constexpr double kLongestScaleMm = 1000;

/// A list of words, each once; what stood there before is left where the key is missing.
template <class Value>
void read_words(const YamlNode* node, const Choices<Value>& choices, const std::string& expected,
                std::vector<Value>& values, Complaints& out) {
  if (node == nullptr) return;
  if (node->kind != YamlNode::Kind::kList || node->items.empty()) {
    out.expected(*node, expected);
    return;
  }
  values.clear();
  for (const YamlNode& item : node->items) {
    const auto value = read_choice(item, choices, out);
    if (!value) continue;
    if (std::find(values.begin(), values.end(), *value) != values.end()) {
      out.about(item, concat(quoted(item.text), " is named twice"));
    }
    values.push_back(*value);
  }
}

void read_comparison(const MapReader& map, Config::Comparison& compare, ConfigDraft& draft) {
  using With = Config::Comparison::With;
  if (const YamlNode* scale = map.find("compare_scale")) {
    const auto mm = read_length_mm(*scale, kLongestScaleMm, draft.complaints);
    if (mm && *mm <= 0) draft.complaints.expected(*scale, "a length above 0 mm");
    compare.scale_mm = mm.value_or(compare.scale_mm);
  }
  const YamlNode* node = map.find("compare");
  if (node == nullptr) return;
  const auto text =
      read_text(*node, "none, target, nearest, or a file or crowd folder", draft.complaints);
  if (!text || *text == "none") return;
  if (*text == "target") {
    compare.with = With::kTarget;
  } else if (*text == "nearest") {
    compare.with = With::kNearest;
  } else {
    compare.with = With::kFile;
    compare.file = resolve(draft.folder, *text);
    if (!file_exists(compare.file)) {
      draft.complaints.about(*node,
                             concat("expected none, target, nearest, or a file that is there; ",
                                    quoted(compare.file.string()), " is missing"),
                             ExitCode::kMissingInput);
    }
  }
  if (draft.config.output.meshes.empty()) {
    draft.complaints.about(*node, "comparing needs meshes, and output.meshes asks for none");
  }
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

void read_contact_sheet(const YamlNode* node, ConfigDraft& draft) {
  auto& sheet = draft.config.output.contact_sheet;
  Complaints& out = draft.complaints;
  if (node == nullptr) return;
  if (node->kind == YamlNode::Kind::kScalar && node->text == "none") {
    sheet.reset();
    return;
  }
  if (node->kind != YamlNode::Kind::kMap) {
    out.expected(*node, "none or a mapping with the keys columns, rows, cell, views");
    return;
  }
  const MapReader map(node,
                      {"columns", "rows", "cell", "views", "labels", "order", "compare",
                       "compare_scale", "formats", "texture"},
                      out);
  const auto read = [&](const char* key, std::uint64_t low, std::uint64_t high, int& value) {
    const YamlNode* found = map.find(key);
    if (found == nullptr) return;
    const auto number = read_whole(*found, low, high, out);
    if (number) value = static_cast<int>(*number);
  };
  read("columns", 1, 32, sheet->columns);
  read("rows", 1, 64, sheet->rows);
  read("cell", 32, 2048, sheet->cell);
  read_words<View>(map.find("views"),
                   {{"front", View::kFront},
                    {"three_quarter", View::kThreeQuarter},
                    {"profile", View::kProfile}},
                   "a list of views, [front, three_quarter, profile]", sheet->views, out);
  read_words<SheetLabel>(map.find("labels"),
                         {{"id", SheetLabel::kId},
                          {"family", SheetLabel::kFamily},
                          {"target", SheetLabel::kTarget},
                          {"nearest", SheetLabel::kNearest},
                          {"nearest_head", SheetLabel::kNearestHead}},
                         "a list of labels, [id, target, nearest]", sheet->labels, out);
  if (const YamlNode* order = map.find("order")) {
    const Choices<SheetOrder> choices = {{"plan", SheetOrder::kPlan},
                                         {"family", SheetOrder::kFamily},
                                         {"likeness", SheetOrder::kLikeness}};
    sheet->order = read_choice(*order, choices, out).value_or(SheetOrder::kPlan);
  }
  if (const YamlNode* texture = map.find("texture")) {
    const Choices<bool> choices = {{"true", true}, {"false", false}};
    sheet->texture = read_choice(*texture, choices, out).value_or(false);
  }
  read_comparison(map, sheet->compare, draft);
  read_words<SheetFormat>(
      map.find("formats"),
      {{"png", SheetFormat::kPng}, {"exr", SheetFormat::kExr}, {"pdf", SheetFormat::kPdf}},
      "a list of formats, [png, exr, pdf]", sheet->formats, out);
  if (!fits_on_a_page(*sheet)) {
    out.about(*node,
              "one page of so many cells, rows and columns is too large (at most 65500 "
              "pixels a side and 5e8 in all)");
  }
}

void read_surfaces(const YamlNode* node, ConfigDraft& draft) {
  if (node == nullptr) return;
  if (node->kind != YamlNode::Kind::kMap) {
    draft.complaints.expected(*node, "a mapping from materials to surfaces, {M_Lashes: hidden}");
    return;
  }
  const Choices<SurfaceKind> choices = {
      {"skin", SurfaceKind::kSkin}, {"eye", SurfaceKind::kEye},
      {"iris", SurfaceKind::kIris}, {"teeth", SurfaceKind::kTeeth},
      {"gums", SurfaceKind::kGums}, {"hidden", SurfaceKind::kHidden}};
  for (const YamlEntry& entry : node->entries) {
    SurfaceChoice& surface = draft.config.output.surfaces[entry.key];
    if (entry.value.kind == YamlNode::Kind::kScalar && entry.value.text.starts_with('#')) {
      surface.colour = parse_colour(entry.value.text);
      if (!surface.colour) draft.complaints.expected(entry.value, "a colour such as \"#c0a080\"");
    } else {
      surface.kind =
          read_choice(entry.value, choices, draft.complaints).value_or(SurfaceKind::kSkin);
    }
  }
}

}  // namespace crowdface
