// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/own_materials.h"

#include <algorithm>
#include <set>
#include <string_view>

#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/io/material_files.h"

namespace crowdface {
namespace {

/// The name at the end of a statement that stands below a folder now.
std::string moved_below(const std::string& folder, const std::string& rest) {
  const std::size_t blank = rest.starts_with('-') ? rest.find_last_of(" \t") : rest.npos;
  const std::size_t name = blank == rest.npos ? 0 : blank + 1;
  return rest.substr(0, name) + folder + '/' + rest.substr(name);
}

}  // namespace

OwnMaterials::OwnMaterials(const std::filesystem::path& mesh,
                           const std::vector<std::string>& libraries, const std::string& shared) {
  for (const MaterialFile& file : find_material_files(mesh, libraries).files) {
    if (!file.is_library) continue;
    std::string folder = file.relative.parent_path().generic_string();
    if (!shared.empty()) folder = concat(shared, folder.empty() ? "" : "/", folder);
    const std::string text = read_file(file.from);
    std::string material;
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      Line line{text.substr(begin, end - begin), {}, {}, {}};
      begin = end + 1;
      const MaterialStatement statement = material_statement(line.text);
      line.word = statement.word;
      line.rest = statement.rest;
      if (line.word == "newmtl") material = line.rest;
      line.material = material;
      if (is_texture_statement(line.word) && !folder.empty()) {
        line.rest = moved_below(folder, line.rest);
        line.text = concat(line.word, ' ', line.rest);
      }
      lines_.push_back(std::move(line));
    }
  }
}

std::string OwnMaterials::text(const std::map<std::string, std::string>& colours) const {
  std::map<std::string, std::string> replaced;  // what a material names so far
  std::set<std::string> there;
  for (const Line& line : lines_) {
    if (line.word == "map_Kd") replaced.emplace(line.material, line.rest);
    if (line.word == "newmtl") there.insert(line.material);
  }
  std::string text;
  for (const Line& line : lines_) {
    const auto colour = colours.find(line.material);
    const auto old = replaced.find(line.material);
    if (colour == colours.end()) {
      text += line.text + '\n';
    } else if (old != replaced.end()) {
      const bool is_it = is_texture_statement(line.word) && line.rest == old->second;
      text += is_it ? concat(line.word, ' ', colour->second, '\n') : line.text + '\n';
    } else if (line.word != "Kd") {
      text += line.text + '\n';
      if (line.word == "newmtl") text += concat("Kd 1 1 1\nmap_Kd ", colour->second, '\n');
    }
  }
  for (const auto& [material, colour] : colours) {
    if (there.contains(material) || material.empty()) continue;
    text += concat("newmtl ", material, "\nKd 1 1 1\nmap_Kd ", colour, '\n');
  }
  return text;
}

}  // namespace crowdface
