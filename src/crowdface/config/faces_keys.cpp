// SPDX-License-Identifier: Apache-2.0
// The config section `faces`.
#include <algorithm>

#include "crowdface/config/config_keys.h"
#include "crowdface/config/head_tags.h"
#include "crowdface/config/input_files.h"
#include "crowdface/config/starter_config.h"
#include "crowdface/core/contains.h"
#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/core/units.h"
#include "crowdface/io/mesh_as_obj.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using Faces = Config::Faces;

/// Adds a head to the section. Also adds a complaint if the file is missing, or if the name is
/// invalid, reserved or already used.
void add_head(const fs::path& file, const std::string& name, const YamlNode& node, Faces& faces,
              ConfigDraft& draft) {
  expect_file(node, file, draft);
  const std::string objection = objection_to_head_name(name, file, faces.names);
  if (!objection.empty()) draft.complaints.add_at(node, objection);
  faces.files.push_back(file);
  faces.names.push_back(name);
  faces.tags.emplace_back();
  faces.ages_years.emplace_back();
}

void add_heads(const std::vector<fs::path>& files, const std::vector<const YamlNode*>& nodes,
               Faces& faces, ConfigDraft& draft) {
  const std::vector<std::string> names = names_of_heads(files);
  for (std::size_t h = 0; h < files.size(); ++h)
    add_head(files[h], names[h], *nodes[h], faces, draft);
}

bool expect_head_count(const YamlNode& node, std::size_t count, const std::string& where,
                       Complaints& out) {
  if (count >= kMinHeads && count <= kMaxHeads) return true;
  out.add_at(node,
             concat("expected ", kMinHeads, " to ", kMaxHeads, " heads, found ", count, where));
  return false;
}

void read_head_directory(const YamlNode& node, Faces& faces, ConfigDraft& draft) {
  const auto folder = path("a folder of heads").read(node, draft);
  if (!folder) return;
  try {
    const std::vector<fs::path> files = list_heads(*folder);
    const std::string left_out = left_out_meshes_message(*folder);
    if (!left_out.empty()) log_warning(left_out);
    std::string where = concat(" in ", quoted(node.text));
    if (files.empty())
      where += concat(" (OBJ, PLY, GLB, glTF, FBX, USD, NumPy)", suggested_head_pattern(*folder));
    draft.are_heads_known = expect_head_count(node, files.size(), where, draft.complaints);
    add_heads(files, std::vector<const YamlNode*>(files.size(), &node), faces, draft);
  } catch (const MissingInput& error) {
    draft.complaints.add_at(node, error.what(), error.code());
  }
}

void read_file_pattern(const YamlNode& node, Faces& faces, ConfigDraft& draft) {
  const auto pattern = path("a pattern").read(node, draft);
  if (!pattern) return;
  std::string left_out;
  const std::vector<fs::path> files = heads_matching(*pattern, left_out);
  if (!left_out.empty()) log_warning(left_out);
  draft.are_heads_known = expect_head_count(
      node, files.size(), concat(" that match ", quoted(node.text)), draft.complaints);
  add_heads(files, std::vector<const YamlNode*>(files.size(), &node), faces, draft);
}

/// Reads a list of files that are heads.
///
/// \return whether all entries are files of a kind that may be a head.
bool read_file_list(const YamlNode& node, std::vector<fs::path>& files,
                    std::vector<const YamlNode*>& nodes, ConfigDraft& draft) {
  bool is_valid = true;
  for (const YamlNode& item : node.items) {
    const auto file = path("a mesh").read(item, draft);
    if (file && is_head_file(*file)) {
      files.push_back(*file);
      nodes.push_back(&item);
      continue;
    }
    is_valid = false;
    if (file)
      draft.complaints.add_mismatch(
          item, "a file whose name ends in .obj, .ply, .glb, .gltf, .fbx, .usda or .npy");
  }
  return is_valid;
}

void read_files(const YamlNode& node, Faces& faces, ConfigDraft& draft) {
  if (node.kind == YamlNode::Kind::kScalar && node.text.find_first_of("*?") != std::string::npos) {
    return read_file_pattern(node, faces, draft);
  }
  if (!draft.complaints.expect_list(
          node, "a list of meshes, [a.obj, b.obj], or a pattern, \"people/*/neutral.obj\""))
    return;
  std::vector<fs::path> files;
  std::vector<const YamlNode*> nodes;
  const bool is_valid = read_file_list(node, files, nodes, draft);
  add_heads(files, nodes, faces, draft);
  draft.are_heads_known =
      is_valid && expect_head_count(node, node.items.size(), " files", draft.complaints);
}

void read_more_files(const YamlNode& node, Faces& faces, ConfigDraft& draft) {
  if (!draft.complaints.expect_list(node, "a list of meshes, [a.obj, b.obj]")) return;
  std::vector<fs::path> files;
  std::vector<const YamlNode*> nodes;
  const bool is_valid = read_file_list(node, files, nodes, draft);
  // Name each head after its own file alone, so that a head keeps its name when another head is
  // added.
  for (std::size_t h = 0; h < files.size(); ++h) {
    add_head(files[h], files[h].stem().string(), *nodes[h], faces, draft);
  }
  draft.are_heads_known =
      draft.are_heads_known && is_valid &&
      expect_head_count(node, faces.files.size(), " with these", draft.complaints);
}

std::string write_files(const Faces& faces, const WriteContext& context) {
  return yaml_block_list(
      texts_of(faces.files, [&](const fs::path& file) { return path("").write(file, context); }));
}

std::string write_tags(const Faces& faces, const WriteContext&) {
  std::vector<std::string> heads;
  for (std::size_t i = 0; i < faces.tags.size(); ++i) {
    if (faces.tags[i].empty()) continue;
    heads.push_back(
        yaml_entry(write_scalar(faces.names[i]), yaml_flow_list_of_names(faces.tags[i])));
  }
  return yaml_block_map(heads);
}

std::string write_ages(const Faces& faces, const WriteContext&) {
  std::vector<std::string> heads;
  for (std::size_t i = 0; i < faces.ages_years.size(); ++i) {
    if (!faces.ages_years[i]) continue;
    heads.push_back(yaml_entry(write_scalar(faces.names[i]), format_number(*faces.ages_years[i])));
  }
  return heads.empty() ? "" : yaml_block_map(heads);
}

Codec<Axis> axis() {
  return {[](const YamlNode& node, ConfigDraft& draft) {
            const auto axis = node.kind == YamlNode::Kind::kScalar ? parse_axis(node.text)
                                                                   : std::optional<Axis>();
            if (!axis) draft.complaints.add_mismatch(node, "an axis, +X, -X, +Y, -Y, +Z or -Z");
            return axis;
          },
          [](const Axis& axis, const WriteContext&) { return name_of(axis); },
          "axis: `+X`, `-X`, `+Y`, `-Y`, `+Z`, `-Z`"};
}

/// Returns a head's name for use in a YAML comment. Quotes an invalid name, because it may contain
/// a line end.
std::string quoted_if_invalid(const std::string& name) {
  return is_valid_name(name) ? name : quoted(name);
}

std::string name_some(std::vector<std::string> names) {
  std::transform(names.begin(), names.end(), names.begin(), quoted_if_invalid);
  if (names.empty()) return "none yet";
  if (names.size() < 3) return join(names, " and ");
  return concat(names.front(), ", ", names[1], ", … ", names.back());
}

StarterLines starter_units(const StarterFacts& facts) {
  const double height_cm = facts.head_height * mm_per(facts.units) / 10;
  return {name_of(facts.units), "",
          concat("The unit of the files: ", kUnitChoices, ". Guessed, because ", facts.units_reason,
                 ".\nWith this unit the first mesh is ", format_fixed(height_cm, 1),
                 " cm high. PLEASE CHECK: all sizes below depend on it.")};
}

StarterLines starter_tags(const StarterFacts& facts) {
  const bool any = std::ranges::any_of(facts.tags, [](const auto& tags) { return !tags.empty(); });
  if (any) return {"", "", "The heads' tags are in tags.yaml in their folder."};
  return {"", "",
          "tags: {head_a: [old], head_b: [young]}   # groups of heads, for use under sampling"};
}

const Keys<Faces>& faces_keys() {
  static const Keys<Faces> keys = {
      Key<Faces>{"directory", read_head_directory, [](const auto&...) { return ""; }}
          .with_accepted_values("folder")
          .with_starter_lines([](const StarterFacts& facts) {
            return StarterLines{write_scalar(facts.heads_folder.string())};
          }),
      Key<Faces>{"files", read_files, write_files}.with_accepted_values(
          "list of meshes, or a pattern"),
      Key<Faces>{"also", read_more_files, [](const auto&...) { return ""; }}.with_accepted_values(
          "list of meshes"),
      key("units", &Faces::units, length_unit(),
          "write the unit of the files: mm, cm, m, in, ft, or a length")
          .with_starter_lines(starter_units),
      key("up", &Faces::up, axis()).with_starter_lines([](const StarterFacts& facts) {
        return StarterLines{name_of(facts.up), "the axis that points to the top of the head"};
      }),
      key("front", &Faces::front, axis()).with_starter_lines([](const StarterFacts& facts) {
        return StarterLines{name_of(facts.front), "the axis along which the faces look"};
      }),
      word_key("align", &Faces::align).with_starter_lines([](const StarterFacts& facts) {
        if (!facts.uses_rigid_alignment)
          return StarterLines{
              std::string(word_of(Align::kCheck)),
              "warn about heads in another pose than the others; rigid aligns them"};
        return StarterLines{
            std::string(word_of(Align::kRigid)),
            "some heads are in another pose; each is turned and moved onto the first"};
      }),
      Key<Faces>{"tags", read_head_tags, write_tags, {}, starter_tags}.with_accepted_values(
          "`{head: [tag, …]}`"),
      Key<Faces>{"ages", read_head_ages, write_ages}.with_accepted_values("`{head: years}`")};
  return keys;
}

/// Warns about heads that have tags in tags.yaml but not in the config. (If the config has tags,
/// tags.yaml is not used.)
void warn_of_lost_tags(const Faces& faces, ConfigDraft& draft) {
  Complaints complaints;
  ConfigDraft beside(complaints);
  beside.are_heads_known = true;
  Faces& tagged = beside.config.faces;
  tagged.files = faces.files;
  tagged.names = faces.names;
  tagged.tags.resize(faces.names.size());
  read_tags_from_head_folders(tagged, beside);
  std::vector<std::string> lost;
  for (std::size_t h = 0; h < faces.names.size() && complaints.empty(); ++h) {
    if (faces.tags[h].empty() && !tagged.tags[h].empty()) lost.push_back(faces.names[h]);
  }
  if (lost.empty()) return;
  draft.warnings.push_back(concat("faces.tags: replaces tags.yaml beside the heads, so ",
                                  lost.size(), " of ", faces.names.size(),
                                  " heads lose their tags: ", name_some(lost)));
}

void read_faces(const YamlNode& node, Config& config, ConfigDraft& draft) {
  Faces& faces = config.faces;
  const std::size_t complaints_before = draft.complaints.size();
  YamlNode section = node;
  const bool has_files = node.find("files") != nullptr;
  if (node.kind == YamlNode::Kind::kMap && has_files == (node.find("directory") != nullptr)) {
    draft.complaints.add_at(
        node,
        has_files
            ? "expected either directory or files, found both"
            : "expected directory (the folder of the heads) or files (the heads), found neither");
    std::erase_if(section.entries, [](const YamlEntry& entry) {
      return entry.key == "directory" || entry.key == "files";
    });
  }
  read_keys(section, faces_keys(), faces, draft);
  if (node.find("tags") == nullptr) {
    const auto ages = faces.ages_years;
    read_tags_from_head_folders(faces, draft);
    if (node.find("ages") != nullptr) faces.ages_years = ages;
  } else {
    warn_of_lost_tags(faces, draft);
  }
  add_age_tags(faces);
  if (faces.up.index == faces.front.index && draft.complaints.size() == complaints_before) {
    const YamlEntry* front = node.find("front");
    draft.complaints.add_at((front != nullptr ? front : node.find("up"))->value,
                            concat("front and up need two different axes, found up ",
                                   name_of(faces.up), " and front ", name_of(faces.front)));
  }
  for (std::size_t h = 0; h < faces.names.size(); ++h) {
    config.sampling->targets.push_back({static_cast<Eigen::Index>(h), 1});
    config.sampling->sources.push_back(static_cast<Eigen::Index>(h));
  }
  config.sampling->heads_tagged_old = heads_with_tags({"old"}, faces);
  config.sampling->heads_tagged_young = heads_with_tags({"young"}, faces);
}

std::optional<StarterLines> faces_starter(const StarterFacts& facts) {
  return StarterLines{starter_keys(faces_keys(), facts), "",
                      concat("The heads: meshes that share one topology. This folder holds ",
                             facts.head_names.size(), ": ", name_some(facts.head_names), ".")};
}

std::string write_faces(const Config& config, const WriteContext& context) {
  return yaml_block_map(write_keys(faces_keys(), config.faces, context));
}

}  // namespace

Key<Config> faces_key() {
  return Key<Config>{"faces", read_faces, write_faces,
                     "such as \"faces: {directory: heads, units: cm}\"", faces_starter}
      .with_nested_keys(faces_keys());
}

}  // namespace crowdface
