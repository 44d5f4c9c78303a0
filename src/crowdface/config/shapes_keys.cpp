// SPDX-License-Identifier: Apache-2.0
// The config section `shapes`.
#include <algorithm>
#include <system_error>
#include <utility>

#include "crowdface/config/config_keys.h"
#include "crowdface/config/input_files.h"
#include "crowdface/core/contains.h"
#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/file_descriptor.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using Shapes = Config::Shapes;

constexpr std::size_t kMaxShapes = 1000;

/// Pairs of a shape's name and the path of the shape's file, sorted by name.
using ShapeFiles = std::vector<std::pair<std::string, fs::path>>;
ShapeFiles list_shapes(const YamlNode& node, const fs::path& folder, const fs::path& neutral,
                       ConfigDraft& draft) {
  ShapeFiles shapes;
  for (const fs::path& file : list_heads(folder)) {
    std::error_code error;
    const bool is_neutral = fs::equivalent(file, neutral, error);
    throw_if_system_error(file, error);
    if (is_neutral) continue;
    const std::string name = file.stem().string();
    if (!is_valid_name(name)) {
      draft.complaints.add_at(
          node, concat("the name of a shape is its file name; expected at most 64 letters (a-z), "
                       "digits, '_', '-' and '.', found ",
                       quoted(name)));
    } else if (std::ranges::any_of(shapes, [&](const auto& one) { return one.first == name; })) {
      draft.complaints.add_at(
          node, concat("two shapes are called ", quoted(name), "; rename one of the files"));
    }
    shapes.emplace_back(name, file);
  }
  return shapes;
}

/// Reads the OBJ files of a folder as shapes, except the neutral mesh. The key `neutral` must
/// therefore be read before this key.
void read_shape_directory(const YamlNode& node, Shapes& shapes, ConfigDraft& draft) {
  const auto folder = path("a folder of OBJ files").read(node, draft);
  if (!folder) return;
  shapes.directory = *folder;
  try {
    for (const auto& [name, file] : list_shapes(node, *folder, shapes.neutral, draft)) {
      shapes.names.push_back(name);
      shapes.template_files.push_back(file);
    }
  } catch (const MissingInput& error) {
    return draft.complaints.add_at(node, error.what(), error.code());
  }
  if (shapes.template_files.empty()) {
    draft.complaints.add_at(
        node, concat("expected an OBJ file for each shape, found none in ", quoted(node.text)));
  }
}

void add_name(const std::string& name, Shapes& shapes) {
  if (contains(shapes.names, name)) return;
  shapes.names.push_back(name);
  shapes.template_files.emplace_back();
}

/// Reads the shapes of each head from the subfolder that has the head's name. The subfolder may
/// also contain the neutral mesh of the head.
void read_shape_heads(const YamlNode& node, Shapes& shapes, ConfigDraft& draft) {
  const auto folder =
      path("a folder that has a subfolder of OBJ files for each head").read(node, draft);
  if (!folder) return;
  shapes.heads_directory = *folder;
  if (!is_folder(*folder)) {
    return draft.complaints.add_at(
        node, concat("the folder ", quoted(folder->string()), " does not exist"),
        ExitCode::kMissingInput);
  }
  if (!draft.are_heads_known) return;
  const Config::Faces& faces = draft.config.faces;
  std::vector<ShapeFiles> found(faces.files.size());
  for (std::size_t h = 0; h < faces.files.size(); ++h) {
    const fs::path of_head = *folder / faces.names[h];
    try {
      if (!shapes.template_files.empty() && !path_exists(of_head)) continue;
      found[h] = list_shapes(node, of_head, faces.files[h], draft);
    } catch (const MissingInput& error) {
      draft.complaints.add_at(node, error.what(), error.code());
    }
    for (const auto& [name, file] : found[h]) add_name(name, shapes);
  }
  // All shape names are known now, so each head's files can be assigned to the names.
  for (const auto& files : found) {
    std::vector<fs::path>& of_head = shapes.head_files.emplace_back(shapes.names.size());
    for (const auto& [name, file] : files) {
      const auto at = std::ranges::find(shapes.names, name) - shapes.names.begin();
      of_head[static_cast<std::size_t>(at)] = file;
    }
  }
}

const Keys<Shapes>& shapes_keys() {
  static const Keys<Shapes> keys = {
      key("neutral", &Shapes::neutral, obj_file()),
      Key<Shapes>{"directory", read_shape_directory,
                  [](const Shapes& shapes, const WriteContext& context) {
                    return path("").write(shapes.directory, context);
                  }}
          .with_accepted_values("folder"),
      Key<Shapes>{"heads", read_shape_heads,
                  [](const Shapes& shapes, const WriteContext& context) {
                    return path("").write(shapes.heads_directory, context);
                  }}
          .with_accepted_values("folder")};
  return keys;
}

/// The template supplies shapes that a head lacks. Adds a complaint about each shape that both a
/// head and the template lack.
void check_lacking(const YamlNode& node, const Shapes& shapes, ConfigDraft& draft) {
  for (std::size_t h = 0; h < shapes.head_files.size(); ++h) {
    std::vector<std::string> lacking;
    for (std::size_t s = 0; s < shapes.names.size(); ++s) {
      if (shapes.head_files[h][s].empty() && shapes.template_files[s].empty()) {
        lacking.push_back(shapes.names[s] + ".obj");
      }
    }
    if (lacking.empty()) continue;
    const std::string& head = draft.config.faces.names[h];
    draft.complaints.add(
        node.place,
        concat(node.path, ": the head ", head, " lacks shapes that other heads have: ",
               (shapes.heads_directory / head).string(), " has no ", join(lacking),
               "; add these files, or set neutral and directory, so that the template's shapes are "
               "transferred"),
        ExitCode::kMissingInput);
  }
}

void check_shapes(const YamlNode& node, const Shapes& shapes, ConfigDraft& draft) {
  if (shapes.neutral.empty() != shapes.directory.empty() ||
      (shapes.neutral.empty() && shapes.heads_directory.empty())) {
    return draft.complaints.add_at(
        node,
        "expected neutral (the template's mesh at rest, an OBJ file) and "
        "directory (the folder of its shapes), or heads (a folder that "
        "has a subfolder of shapes for each head), or all three");
  }
  if (shapes.heads_directory.empty() ? shapes.names.empty() : !draft.are_heads_known) return;
  if (shapes.names.empty() || shapes.names.size() > kMaxShapes) {
    return draft.complaints.add_at(
        node, concat("expected 1 to ", kMaxShapes, " shapes, found ", shapes.names.size()));
  }
  check_lacking(node, shapes, draft);
}

void read_shapes(const YamlNode& node, Config& config, ConfigDraft& draft) {
  if (is_word(node, "none")) return;
  if (!draft.complaints.expect_map(node,
                                   "none or a mapping with the keys neutral, directory, heads")) {
    return;
  }
  const std::size_t before = draft.complaints.size();
  read_keys(node, shapes_keys(), config.shapes, draft);
  if (draft.complaints.size() == before) check_shapes(node, config.shapes, draft);
}

std::string write_shapes(const Config& config, const WriteContext& context) {
  if (config.shapes.names.empty()) return "none";
  return yaml_block_map(write_keys(shapes_keys(), config.shapes, context));
}

}  // namespace

Key<Config> shapes_key() {
  return Key<Config>{"shapes", read_shapes, write_shapes}.with_nested_keys(shapes_keys());
}

}  // namespace crowdface
