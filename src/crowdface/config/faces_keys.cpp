// SPDX-License-Identifier: Apache-2.0
// The section `faces`.
#include <algorithm>

#include "crowdface/config/config_keys.h"
#include "crowdface/config/input_files.h"
#include "crowdface/config/starter_config.h"
#include "crowdface/core/contains.h"
#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/io/mesh_format.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using Faces = Config::Faces;

/// Adds a head called like its file; refuses what would make a name mean two things.
void add_head(const fs::path& file, const YamlNode& node, Faces& faces, ConfigDraft& draft) {
  const std::string name = file.stem().string();
  const std::string shown = quoted(file.string());
  expect_file(node, file, draft);
  if (!is_name(name)) {
    draft.complaints.about(
        node, concat("the head's name, ", quoted(name), ", is its file's name and may hold ",
                     "letters (a-z), digits, '_', '-' and '.', 64 at most; rename ", shown));
  } else if (name == "all" || name == "target") {
    draft.complaints.about(node, concat("no head can be called ", quoted(name),
                                        ", the word has its own meaning; rename ", shown));
  } else if (contains(faces.names, name)) {
    draft.complaints.about(
        node, concat("two heads are called ", quoted(name), "; the second is ", shown));
  }
  faces.files.push_back(file);
  faces.names.push_back(name);
  faces.tags.emplace_back();
}

bool expect_head_count(const YamlNode& node, std::size_t count, const std::string& where,
                       Complaints& out) {
  if (count >= kFewestHeads && count <= kMostHeads) return true;
  out.about(node,
            concat("expected ", kFewestHeads, " to ", kMostHeads, " heads, found ", count, where));
  return false;
}

void read_head_directory(const YamlNode& node, Faces& faces, ConfigDraft& draft) {
  const auto folder = path("a folder of OBJ files").read(node, draft);
  if (!folder) return;
  try {
    const std::vector<fs::path> files = list_heads(*folder);
    draft.heads_known = expect_head_count(
        node, files.size(), concat(" OBJ files in ", quoted(node.text)), draft.complaints);
    for (const fs::path& file : files) add_head(file, node, faces, draft);
  } catch (const MissingInput& error) {
    draft.complaints.about(node, error.what(), error.code());
  }
}

void read_files(const YamlNode& node, Faces& faces, ConfigDraft& draft) {
  if (!draft.complaints.expect_list(node, "a list of OBJ files, [a.obj, b.obj]")) return;
  bool sound = true;
  for (const YamlNode& item : node.items) {
    const auto file = path("an OBJ file").read(item, draft);
    if (file && mesh_format_of(*file) == MeshFormat::kObj) {
      add_head(*file, item, faces, draft);
      continue;
    }
    sound = false;
    if (file) draft.complaints.expected(item, "a file whose name ends in .obj");
  }
  draft.heads_known =
      sound && expect_head_count(node, node.items.size(), " files", draft.complaints);
}

std::string write_files(const Faces& faces, const ConfigWriting& writing) {
  return block_list(
      texts_of(faces.files, [&](const fs::path& file) { return path("").write(file, writing); }));
}

/// A tag may not be read as a head, nor as the word for all of them.
void check_tag(const YamlNode& node, const Faces& faces, Complaints& out) {
  const std::string& tag = node.text;
  if (contains(faces.names, tag)) {
    out.about(node, concat("the tag ", quoted(tag), " is also the name of a head"));
  } else if (tag == "all" || tag == "target") {
    out.about(node, concat("no tag can be called ", quoted(tag)));
  }
}

std::vector<std::string> read_tags_of_head(const YamlNode& node, const Faces& faces,
                                           Complaints& out) {
  std::vector<std::string> tags;
  if (!out.expect_list(node, "a list of tags, [old, bearded]")) return tags;
  for (const YamlNode& item : node.items) {
    const auto tag = read_name(item, out);
    if (!tag) continue;
    check_tag(item, faces, out);
    if (contains(tags, *tag)) {
      out.about(item, concat("the tag ", quoted(*tag), " is named twice"));
    }
    tags.push_back(*tag);
  }
  return tags;
}

void read_head_tags(const YamlNode& node, Faces& faces, ConfigDraft& draft) {
  const std::size_t complaints_before = draft.complaints.size();
  draft.complaints.expect_map(node, "a mapping from heads to tags, {head: [tag, ...]}");
  for (const YamlEntry& entry : node.entries) {
    const auto head = find_head(entry.key, entry.key_place, node.path, draft);
    if (!head) continue;
    faces.tags[static_cast<std::size_t>(*head)] =
        read_tags_of_head(entry.value, faces, draft.complaints);
  }
  draft.tags_known = draft.complaints.size() == complaints_before;
}

std::string write_tags(const Faces& faces, const ConfigWriting&) {
  std::vector<std::string> heads;
  for (std::size_t i = 0; i < faces.tags.size(); ++i) {
    if (faces.tags[i].empty()) continue;
    heads.push_back(entry(write_scalar(faces.names[i]), flow_names(faces.tags[i])));
  }
  return block_map(heads);
}

Codec<Axis> axis() {
  return {[](const YamlNode& node, ConfigDraft& draft) {
            const auto axis = node.kind == YamlNode::Kind::kScalar ? parse_axis(node.text)
                                                                   : std::optional<Axis>();
            if (!axis) draft.complaints.expected(node, "an axis, +X, -X, +Y, -Y, +Z or -Z");
            return axis;
          },
          [](const Axis& axis, const ConfigWriting&) { return name_of(axis); },
          "axis: `+X`, `-X`, `+Y`, `-Y`, `+Z`, `-Z`"};
}

/// In a comment: what is no head's name might end the line.
std::string shown(const std::string& name) {
  return is_name(name) ? name : quoted(name);
}

std::string name_some(std::vector<std::string> names) {
  std::transform(names.begin(), names.end(), names.begin(), shown);
  if (names.empty()) return "none yet";
  if (names.size() < 3) return join(names, " and ");
  return concat(names.front(), ", ", names[1], ", … ", names.back());
}

StarterLines starter_units(const StarterFacts& facts) {
  const double height_cm = facts.head_height * mm_per(facts.units) / 10;
  return {std::string(name_of(facts.units)), "",
          concat("What one unit of the OBJ files is: mm, cm, m or in. Guessed, because the first "
                 "mesh is ",
                 format_fixed(facts.head_height, 2), " units\nhigh, which makes ",
                 format_fixed(height_cm, 1), " cm. PLEASE CHECK: every size below rests on it.")};
}

StarterLines starter_tags(const StarterFacts& facts) {
  if (facts.tags.empty()) {
    return {
        "", "",
        "tags: {head_a: [old], head_b: [young]}   # groups of heads, to be named under sampling"};
  }
  std::vector<std::string> heads;
  for (const auto& [head, tags] : facts.tags) heads.push_back(entry(head, flow_list(tags)));
  return {block_map(heads), "", "Groups of heads, to be named under sampling."};
}

const Keys<Faces>& faces_keys() {
  static const Keys<Faces> keys = {
      Key<Faces>{"directory", read_head_directory, [](const auto&...) { return ""; }}
          .taking("folder")
          .in_starter([](const StarterFacts& facts) {
            return StarterLines{write_scalar(facts.heads.string())};
          }),
      Key<Faces>{"files", read_files, write_files}.taking("list of OBJ files"),
      word_key("units", &Faces::units, "what is one unit of the OBJ files: mm, cm, m or in?")
          .in_starter(starter_units),
      key("up", &Faces::up, axis()).in_starter([](const StarterFacts& facts) {
        return StarterLines{name_of(facts.up), "the axis that points to the top of the head"};
      }),
      key("front", &Faces::front, axis()).in_starter([](const StarterFacts& facts) {
        return StarterLines{name_of(facts.front), "the axis along which the faces look"};
      }),
      word_key("align", &Faces::align)
          .in_starter({std::string(word_of(Align::kCheck)),
                       "warn about heads that do not stand like the others; rigid moves them"}),
      Key<Faces>{"tags", read_head_tags, write_tags, {}, starter_tags}.taking(
          "`{head: [tag, …]}`")};
  return keys;
}

void read_faces(const YamlNode& node, Config& config, ConfigDraft& draft) {
  Faces& faces = config.faces;
  const std::size_t complaints_before = draft.complaints.size();
  YamlNode section = node;
  const bool has_files = node.find("files") != nullptr;
  if (node.kind == YamlNode::Kind::kMap && has_files == (node.find("directory") != nullptr)) {
    draft.complaints.about(node, has_files ? "either directory or files, not both"
                                           : "directory or files is missing; where are the heads?");
    std::erase_if(section.entries, [](const YamlEntry& entry) {
      return entry.key == "directory" || entry.key == "files";
    });
  }
  read_keys(section, faces_keys(), faces, draft);
  if (faces.up.index == faces.front.index && draft.complaints.size() == complaints_before) {
    const YamlEntry* front = node.find("front");
    draft.complaints.about((front != nullptr ? front : node.find("up"))->value,
                           concat("front and up need two different axes, found up ",
                                  name_of(faces.up), " and front ", name_of(faces.front)));
  }
  for (std::size_t h = 0; h < faces.names.size(); ++h) {
    config.sampling.targets.push_back({static_cast<Eigen::Index>(h), 1});
    config.sampling.sources.push_back(static_cast<Eigen::Index>(h));
  }
  config.sampling.old_heads = heads_with({"old"}, faces);
  config.sampling.young_heads = heads_with({"young"}, faces);
}

std::optional<StarterLines> faces_starter(const StarterFacts& facts) {
  return StarterLines{starter_keys(faces_keys(), facts), "",
                      concat("The heads: OBJ files that share one topology. This folder holds ",
                             facts.names.size(), ": ", name_some(facts.names), ".")};
}

std::string write_faces(const Config& config, const ConfigWriting& writing) {
  return block_map(write_keys(faces_keys(), config.faces, writing));
}

}  // namespace

Key<Config> faces_key() {
  return Key<Config>{"faces", read_faces, write_faces,
                     "such as \"faces: {directory: heads, units: cm}\"", faces_starter}
      .holding(faces_keys());
}

}  // namespace crowdface
