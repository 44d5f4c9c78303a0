// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/surface_materials.h"

#include <algorithm>
#include <string_view>

#include "crowdface/core/file.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

std::vector<float> leading_numbers(std::string_view text) {
  std::vector<float> numbers;
  for (const std::string& word : words_of(text)) {
    const auto number = parse_double(word);
    if (!number) break;
    numbers.push_back(static_cast<float>(*number));
  }
  return numbers;
}

/// The texture whose name stands at the end of a statement. If several names match, the texture
/// with the longest name.
std::filesystem::path texture_at_end(std::string_view rest, const std::filesystem::path& folder,
                                     const MaterialFiles& files) {
  for (const std::string_view suffix : suffixes_starting_at_words(rest)) {
    std::string name(suffix);
    std::replace(name.begin(), name.end(), '\\', '/');
    const std::filesystem::path relative = (folder / name).lexically_normal();
    const bool is_outside = relative.is_absolute() || *relative.begin() == "..";
    const std::filesystem::path copied = is_outside ? relative.filename() : relative;
    for (const MaterialFile& file : files.files) {
      if (!file.is_material_file && file.destination == copied) return file.source;
    }
  }
  return {};
}

float in_range(float value) {
  return std::clamp(value, 0.0F, 1.0F);
}

void take(const MaterialStatement& statement, const std::filesystem::path& folder,
          const MaterialFiles& files, SurfaceMaterial& material) {
  const std::vector<float> numbers = leading_numbers(statement.arguments);
  if (statement.keyword == "Kd" && numbers.size() == 3) {
    material.colour = {in_range(numbers[0]), in_range(numbers[1]), in_range(numbers[2])};
  } else if (statement.keyword == "d" && numbers.size() == 1) {
    material.opacity = in_range(numbers[0]);
  } else if (statement.keyword == "Tr" && numbers.size() == 1) {
    material.opacity = in_range(1 - numbers[0]);
  } else if (statement.keyword == "map_Kd") {
    material.colour_map = texture_at_end(statement.arguments, folder, files);
  } else if (statement.keyword == "map_d") {
    material.opacity_map = texture_at_end(statement.arguments, folder, files);
  }
}

}  // namespace

std::vector<SurfaceMaterial> read_surface_materials(const MaterialFiles& files) {
  std::vector<SurfaceMaterial> materials;
  for (const MaterialFile& file : files.files) {
    if (!file.is_material_file) continue;
    const std::string text = read_material_text(file.source);
    for (const std::string_view line : split_lines(text)) {
      throw_if_interrupted();
      const MaterialStatement statement = material_statement(line);
      if (statement.keyword == "newmtl") {
        materials.push_back({std::string(statement.arguments), std::nullopt, 1, {}, {}});
      } else if (!materials.empty()) {
        take(statement, file.destination.parent_path(), files, materials.back());
      }
    }
  }
  return materials;
}

std::vector<SurfaceMaterial> surface_materials_of(const std::vector<std::string>& names,
                                                  const MaterialFiles& files) {
  const std::vector<SurfaceMaterial> known = read_surface_materials(files);
  std::vector<SurfaceMaterial> materials;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(known, name, &SurfaceMaterial::name);
    materials.push_back(found != known.end() ? *found : SurfaceMaterial{name});
  }
  return materials;
}

}  // namespace crowdface
