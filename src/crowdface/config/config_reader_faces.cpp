// SPDX-License-Identifier: Apache-2.0
// The section `faces`.
#include <algorithm>
#include <array>
#include <set>
#include <system_error>

#include "crowdface/config/config_sections.h"
#include "crowdface/config/input_files.h"
#include "crowdface/core/error.h"
#include "crowdface/core/name.h"
#include "crowdface/core/text.h"
#include "crowdface/io/mesh_format.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// Files and, for each, where the config names it.
struct NamedFiles {
  std::vector<fs::path> files;
  std::vector<const YamlNode*> nodes;
};

NamedFiles read_directory(const YamlNode& node, ConfigDraft& draft) {
  NamedFiles named;
  const auto text = read_text(node, "a folder of OBJ files", draft.complaints);
  if (!text) return named;
  try {
    named.files = list_heads(resolve(draft.folder, *text));
  } catch (const MissingInput& error) {
    draft.complaints.about(node, error.what(), error.code());
  }
  named.nodes.assign(named.files.size(), &node);
  return named;
}

NamedFiles read_files(const YamlNode& node, ConfigDraft& draft) {
  NamedFiles named;
  if (!draft.complaints.expect_list(node, "a list of OBJ files, [a.obj, b.obj]")) return named;
  for (const YamlNode& item : node.items) {
    const auto text = read_text(item, "an OBJ file", draft.complaints);
    if (!text) continue;
    if (mesh_format_of(*text) != MeshFormat::kObj) {
      draft.complaints.expected(item, "a file whose name ends in .obj");
      continue;
    }
    named.files.push_back(resolve(draft.folder, *text));
    named.nodes.push_back(&item);
  }
  return named;
}

/// Names the heads after their files and refuses what would make a name mean two things.
void name_heads(const NamedFiles& named, ConfigDraft& draft) {
  std::set<std::string> seen;
  for (std::size_t i = 0; i < named.files.size(); ++i) {
    const fs::path& file = named.files[i];
    const YamlNode& node = *named.nodes[i];
    const std::string name = file.stem().string();
    const std::string shown = quoted(file.string());
    if (!file_exists(file)) {
      draft.complaints.about(node, concat("the file ", shown, " is missing"),
                             ExitCode::kMissingInput);
    }
    if (!is_name(name)) {
      draft.complaints.about(node,
                             concat("the head's name, ", quoted(name), ", is its file's name ",
                                    "and may hold letters (a-z), digits, '_', '-' and '.', 64 ",
                                    "at most; rename ", shown));
    } else if (name == "all" || name == "target") {
      draft.complaints.about(node, concat("no head can be called ", quoted(name),
                                          ", the word has its own meaning; rename ", shown));
    } else if (!seen.insert(name).second) {
      draft.complaints.about(
          node, concat("two heads are called ", quoted(name), "; the second is ", shown));
    }
    draft.config.faces.files.push_back(file);
    draft.config.faces.names.push_back(name);
  }
}

void read_heads(const YamlNode* node, const MapReader& map, ConfigDraft& draft) {
  if (node == nullptr || node->kind != YamlNode::Kind::kMap) return;
  if (map.has("directory") == map.has("files")) {
    draft.complaints.about(*node, map.has("files")
                                      ? "either directory or files, not both"
                                      : "directory or files is missing; where are the heads?");
    return;
  }
  const YamlNode* directory = map.find("directory");
  const YamlNode* files = map.find("files");
  const YamlNode* heads = directory != nullptr ? directory : files;
  if (heads == nullptr) return;
  const std::size_t complaints_before = draft.complaints.size();
  const NamedFiles named =
      directory != nullptr ? read_directory(*heads, draft) : read_files(*heads, draft);
  if (draft.complaints.size() == complaints_before &&
      (named.files.size() < kFewestHeads || named.files.size() > kMostHeads)) {
    const std::string where =
        directory != nullptr ? concat(" OBJ files in ", quoted(directory->text)) : " files";
    draft.complaints.about(*heads, concat("expected ", kFewestHeads, " to ", kMostHeads,
                                          " heads, found ", named.files.size(), where));
  }
  draft.heads_known = draft.complaints.size() == complaints_before;
  name_heads(named, draft);
}

/// A tag may not be read as a head, nor as the word for all of them.
void check_tag(const YamlNode& node, const std::string& tag, ConfigDraft& draft) {
  const auto& names = draft.config.faces.names;
  if (std::find(names.begin(), names.end(), tag) != names.end()) {
    draft.complaints.about(node, concat("the tag ", quoted(tag), " is also the name of a head"));
  } else if (tag == "all" || tag == "target") {
    draft.complaints.about(node, concat("no tag can be called ", quoted(tag)));
  }
}

void read_tags_of_head(const YamlNode& node, Eigen::Index head, ConfigDraft& draft) {
  if (!draft.complaints.expect_list(node, "a list of tags, [old, bearded]")) return;
  auto& tags = draft.config.faces.tags[static_cast<std::size_t>(head)];
  for (const YamlNode& item : node.items) {
    const auto tag = read_name(item, draft.complaints);
    if (!tag) continue;
    check_tag(item, *tag, draft);
    if (std::find(tags.begin(), tags.end(), *tag) != tags.end()) {
      draft.complaints.about(item, concat("the tag ", quoted(*tag), " is named twice"));
    }
    tags.push_back(*tag);
  }
}

void read_tags(const YamlNode* node, ConfigDraft& draft) {
  draft.config.faces.tags.assign(draft.config.faces.names.size(), {});
  if (node == nullptr) return;
  if (node->kind != YamlNode::Kind::kMap) {
    draft.complaints.expected(*node, "a mapping from heads to tags, {head: [tag, ...]}");
    draft.tags_known = false;
    return;
  }
  const std::size_t complaints_before = draft.complaints.size();
  for (const YamlEntry& entry : node->entries) {
    const auto head = find_head(entry.key, entry.key_place, node->path, draft);
    if (head) read_tags_of_head(entry.value, *head, draft);
  }
  draft.tags_known = draft.complaints.size() == complaints_before;
}

std::optional<Axis> read_axis(const YamlNode& node, Complaints& out) {
  const auto axis =
      node.kind == YamlNode::Kind::kScalar ? parse_axis(node.text) : std::optional<Axis>();
  if (!axis) out.expected(node, "an axis, +X, -X, +Y, -Y, +Z or -Z");
  return axis;
}

void read_frame(const MapReader& map, ConfigDraft& draft) {
  Config::Faces& faces = draft.config.faces;
  const YamlNode* up = map.find("up");
  const YamlNode* front = map.find("front");
  std::optional<Axis> up_axis = faces.up, front_axis = faces.front;
  if (up != nullptr) up_axis = read_axis(*up, draft.complaints);
  if (front != nullptr) front_axis = read_axis(*front, draft.complaints);
  if (!up_axis || !front_axis) return;
  const YamlNode* shown = front != nullptr ? front : up;
  if (shown != nullptr && up_axis->index == front_axis->index) {
    draft.complaints.about(*shown, concat("front and up need two different axes, found up ",
                                          name_of(*up_axis), " and front ", name_of(*front_axis)));
  }
  faces.up = *up_axis;
  faces.front = *front_axis;
}

}  // namespace

void read_faces(const YamlNode* node, ConfigDraft& draft) {
  const MapReader map(node, {"directory", "files", "units", "up", "front", "align", "tags"},
                      draft.complaints);
  read_heads(node, map, draft);
  const YamlNode* units =
      map.require("units", "what is one unit of the OBJ files: mm, cm, m or in?");
  if (units != nullptr) {
    const auto words = words_by_name(std::array{LengthUnit::kMillimetre, LengthUnit::kCentimetre,
                                                LengthUnit::kMetre, LengthUnit::kInch});
    const auto unit = read_choice(*units, words, draft.complaints);
    if (unit) draft.config.faces.units = *unit;
  }
  read_frame(map, draft);
  read_choice_into(map.find("align"), draft.config.faces.align, draft.complaints);
  read_tags(map.find("tags"), draft);
}

}  // namespace crowdface
