// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/material_files.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "crowdface/core/file.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestMaterialFile = 16U << 20U;

std::vector<std::string> words_of(std::string_view line) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < line.size();) {
    const std::size_t begin = line.find_first_not_of(" \t\r", i);
    if (begin == line.npos) break;
    const std::size_t end = std::min(line.find_first_of(" \t\r", begin), line.size());
    words.emplace_back(line.substr(begin, end - begin));
    i = end;
  }
  return words;
}

/// Stays below the folder it starts from.
bool stays_inside(const fs::path& relative) {
  const fs::path normal = relative.lexically_normal();
  return !normal.empty() && normal.is_relative() && *normal.begin() != "..";
}

bool is_texture_statement(const std::string& word) {
  return word.starts_with("map_") || word == "bump" || word == "disp" || word == "decal" ||
         word == "refl" || word == "norm";
}

/// The last word of each texture statement: options come before the name.
std::vector<std::string> textures_of(const std::string& text) {
  std::vector<std::string> textures;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const auto words = words_of(std::string_view(text).substr(begin, end - begin));
    if (words.size() >= 2 && is_texture_statement(words[0])) textures.push_back(words.back());
    begin = end + 1;
  }
  return textures;
}

class Collector {
 public:
  explicit Collector(fs::path folder) : folder_(std::move(folder)) {}

  void add_library(const std::string& argument) {
    // A name may hold blanks, or the line may name several files: whichever exists.
    if (exists(argument)) return take_library(argument);
    for (const std::string& name : words_of(argument)) take_library(name);
  }

  MaterialFiles take() { return std::move(result_); }

 private:
  bool exists(const fs::path& relative) const {
    std::error_code ignored;
    return fs::is_regular_file(folder_ / relative, ignored);
  }

  bool take_file(const fs::path& relative, std::string_view what) {
    if (!stays_inside(relative)) {
      result_.warnings.push_back(concat(what, " ", quoted(relative.string()),
                                        " lies outside the head's folder and is not copied"));
      return false;
    }
    if (!exists(relative)) {
      result_.warnings.push_back(concat(what, " ", quoted(relative.string()),
                                        " is missing; meshes will name it all the same"));
      return false;
    }
    const fs::path normal = relative.lexically_normal();
    for (const MaterialFile& known : result_.files) {
      if (known.relative == normal) return false;
    }
    result_.files.push_back({folder_ / normal, normal});
    return true;
  }

  void take_library(const fs::path& name) {
    if (!take_file(name, "material file")) return;
    std::error_code error;
    if (fs::file_size(folder_ / name, error) > kLargestMaterialFile || error) return;
    for (const std::string& texture : textures_of(read_file(folder_ / name))) {
      std::string forward = texture;
      std::replace(forward.begin(), forward.end(), '\\', '/');
      take_file(name.parent_path() / forward, "texture");
    }
  }

  fs::path folder_;
  MaterialFiles result_;
};

}  // namespace

MaterialFiles find_material_files(const fs::path& mesh, const std::vector<std::string>& libraries) {
  Collector collector(mesh.parent_path());
  for (const std::string& library : libraries) collector.add_library(library);
  return collector.take();
}

}  // namespace crowdface
