// SPDX-License-Identifier: Apache-2.0
// The section `shapes`.
#include <algorithm>
#include <system_error>

#include "crowdface/config/config_keys.h"
#include "crowdface/config/input_files.h"
#include "crowdface/core/error.h"
#include "crowdface/core/name.h"
#include "crowdface/io/mesh_format.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using Shapes = Config::Shapes;

constexpr std::size_t kMostShapes = 1000;

void read_neutral(const YamlNode& node, Shapes& shapes, ConfigDraft& draft) {
  const auto file = path("an OBJ file").read(node, draft);
  if (!file) return;
  if (mesh_format_of(*file) != MeshFormat::kObj) {
    draft.complaints.expected(node, "a file whose name ends in .obj");
    return;
  }
  expect_file(node, *file, draft);
  shapes.neutral = *file;
}

/// Every OBJ file of the folder but the neutral mesh, which comes first in the section.
void read_directory(const YamlNode& node, Shapes& shapes, ConfigDraft& draft) {
  const auto folder = path("a folder of OBJ files").read(node, draft);
  if (!folder) return;
  shapes.directory = *folder;
  try {
    for (const fs::path& file : list_heads(*folder)) {
      std::error_code ignored;
      if (fs::equivalent(file, shapes.neutral, ignored)) continue;
      const std::string name = file.stem().string();
      if (!is_name(name)) {
        draft.complaints.about(
            node, concat("a shape is called like its file, and ", quoted(name),
                         " is no name: letters (a-z), digits, '_', '-' and '.', 64 at most"));
      } else if (std::find(shapes.names.begin(), shapes.names.end(), name) != shapes.names.end()) {
        draft.complaints.about(node, concat("two shapes are called ", quoted(name)));
      }
      shapes.files.push_back(file);
      shapes.names.push_back(name);
    }
    if (shapes.files.empty() || shapes.files.size() > kMostShapes) {
      draft.complaints.about(
          node, concat("expected 1 to ", kMostShapes, " shapes, found ", shapes.files.size(),
                       " OBJ files in ", quoted(node.text)));
    }
  } catch (const MissingInput& error) {
    draft.complaints.about(node, error.what(), error.code());
  }
}

const Keys<Shapes>& shapes_keys() {
  static const Keys<Shapes> keys = {{"neutral", read_neutral,
                                     [](const Shapes& shapes, const ConfigWriting& writing) {
                                       return path("").write(shapes.neutral, writing);
                                     },
                                     "the template's mesh at rest, an OBJ file"},
                                    {"directory", read_directory,
                                     [](const Shapes& shapes, const ConfigWriting& writing) {
                                       return path("").write(shapes.directory, writing);
                                     },
                                     "the folder of the template's shapes, an OBJ file each"}};
  return keys;
}

}  // namespace

void read_shapes(const YamlNode& node, Config& config, ConfigDraft& draft) {
  if (is_word(node, "none")) return;
  if (!draft.complaints.expect_map(node, "none or a mapping with the keys neutral, directory")) {
    return;
  }
  read_keys(node, shapes_keys(), config.shapes, draft);
}

std::string write_shapes(const Config& config, const ConfigWriting& writing) {
  if (config.shapes.files.empty()) return "none";
  return block_map(write_keys(shapes_keys(), config.shapes, writing));
}

}  // namespace crowdface
