// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/merged_materials.h"

#include <algorithm>
#include <optional>
#include <set>

#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/io/material_files.h"

namespace crowdface {
namespace {

/// Position of the file name after a statement's options and their values (numbers, on, off, or a
/// channel letter).
std::size_t start_of_name(const std::string& rest) {
  std::size_t name = 0;
  bool in_options = false;
  for (const std::string& word : words_of(rest)) {
    const std::size_t at = rest.find(word, name);
    const bool is_option = word.size() > 1 && word[0] == '-' && !parse_double(word);
    const bool is_value =
        in_options && (parse_double(word) || word == "on" || word == "off" || word.size() == 1);
    if (!is_option && !is_value) return at;
    in_options = true;
    name = at + word.size();
  }
  return 0;  // the whole text is a name
}

}  // namespace

MergedMaterials::MergedMaterials(const std::filesystem::path& mesh,
                                 const std::vector<std::string>& libraries,
                                 const std::string& shared) {
  for (const MaterialFile& file : find_material_files(mesh, libraries).files) {
    if (!file.is_material_file) continue;
    std::string folder = file.destination.parent_path().generic_string();
    if (!shared.empty()) folder = concat(shared, folder.empty() ? "" : "/", folder);
    const std::string text = read_material_text(file.source);
    for (const MaterialLine& original : material_lines(text)) {
      Line line{std::string(original.text), std::string(original.keyword),
                std::string(original.arguments), std::string(original.material)};
      if (is_texture_statement(line.keyword) && !folder.empty()) {
        line.arguments.insert(start_of_name(line.arguments), folder + '/');
        line.text = concat(line.keyword, ' ', line.arguments);
      }
      lines_.push_back(std::move(line));
    }
  }
}

std::string MergedMaterials::text(const Replacements& textures) const {
  std::map<std::string, std::string> old_colours;      // first colour texture of each material
  std::map<std::string, std::set<TextureKind>> there;  // key "": lines before the first material
  for (const Line& line : lines_) {
    const std::optional<TextureKind> kind = texture_kind_of(line.keyword);
    if (kind == TextureKind::kColour) old_colours.emplace(line.material, line.arguments);
    auto& kinds = there[line.material];
    if (kind) kinds.insert(*kind);
  }
  const bool has_one_material = there.size() - there.count("") == 1;
  const auto file_of = [&](TextureKind kind, const std::string& material) -> const std::string* {
    const auto of_kind = textures.find(kind);
    if (of_kind == textures.end()) return nullptr;
    auto file = of_kind->second.find(material);
    if (file == of_kind->second.end() && has_one_material) file = of_kind->second.find("");
    return file == of_kind->second.end() ? nullptr : &file->second;
  };
  const auto replaced = [&](const Line& line) -> std::string {
    const std::optional<TextureKind> kind = texture_kind_of(line.keyword);
    const std::string* file =
        kind && kind != TextureKind::kColour ? file_of(*kind, line.material) : nullptr;
    if (file != nullptr) {
      return concat(line.keyword, ' ', line.arguments.substr(0, start_of_name(line.arguments)),
                    *file, '\n');
    }
    const std::string* colour = file_of(TextureKind::kColour, line.material);
    if (colour == nullptr) return line.text + '\n';
    const auto old = old_colours.find(line.material);
    if (old == old_colours.end()) return line.keyword == "Kd" ? "" : line.text + '\n';
    const bool is_it = is_texture_statement(line.keyword) && line.arguments == old->second;
    return is_it ? concat(line.keyword, ' ', *colour, '\n') : line.text + '\n';
  };
  const auto added = [&](const std::string& material, const std::set<TextureKind>& kinds) {
    std::string text;
    for (const TextureStatement& statement : kTextureStatements) {
      const std::string* file = file_of(statement.kind, material);
      if (file == nullptr || kinds.contains(statement.kind)) continue;
      if (statement.kind == TextureKind::kColour) text += "Kd 1 1 1\n";
      text += concat(statement.word, ' ', *file, '\n');
    }
    return text;
  };
  std::string text;
  for (const Line& line : lines_) {
    text += replaced(line);
    if (line.keyword == "newmtl") text += added(line.material, there.at(line.material));
  }
  std::set<std::string> missing;
  for (const auto& [kind, files] : textures) {
    for (const auto& [material, file] : files) {
      if (!there.contains(material) && !material.empty()) missing.insert(material);
    }
  }
  for (const std::string& material : missing) {
    text += concat("newmtl ", material, '\n', added(material, {}));
  }
  return text;
}

}  // namespace crowdface
