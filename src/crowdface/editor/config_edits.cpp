// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/config_edits.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "crowdface/cast/sampling.h"
#include "crowdface/config/config_reader.h"
#include "crowdface/config/config_values.h"
#include "crowdface/config/edited_entries.h"
#include "crowdface/config/edits.h"
#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

YamlNode parsed(const std::string& text, const std::string& source) {
  Complaints complaints;
  auto root = parse_yaml(text, source, complaints);
  Problems problems;
  complaints.report_to(problems);
  problems.throw_if_any();
  return std::move(*root);
}

/// Formats a YAML value on one line.
std::string single_line_yaml(const YamlNode& node) {
  if (node.kind == YamlNode::Kind::kList)
    return yaml_flow_list(texts_of(node.items, single_line_yaml));
  if (node.kind == YamlNode::Kind::kMap) {
    return yaml_flow_map(texts_of(node.entries, [](const YamlEntry& child) {
      return yaml_entry(write_scalar(child.key), single_line_yaml(child.value));
    }));
  }
  return node.is_quoted ? write_scalar(node.text) : node.text;
}

/// Formats the edits as YAML. Each section and each list item takes one line.
std::string text_of(const YamlNode& edits) {
  std::string text = "# Written by crowdface edit; the config names this file as `edits`.\n";
  if (edits.entries.empty()) text += "{}\n";
  for (const auto& [key, place, value] : edits.entries) {
    const bool is_list = value.kind == YamlNode::Kind::kList;
    text += yaml_entry(key, is_list ? yaml_block_list(texts_of(value.items, single_line_yaml))
                                    : single_line_yaml(value));
    text += '\n';
  }
  return text;
}

/// Reads the file of edits, applies a change to the edits, and saves the file.
fs::path put_edit(const fs::path& config, const std::function<void(YamlNode& edits)>& change) {
  std::string config_text = read_file(config);
  const YamlNode root = parsed(config_text, config.string());
  const YamlEntry* named = root.find("edits");
  const std::string name =
      named != nullptr ? named->value.text : concat(config.stem().string(), "_edits.yaml");
  fs::path file = config.parent_path() / name;

  YamlNode edits;
  // The file of edits may exist even if the config does not name the file yet, because an editor
  // may have been killed after writing the file.
  if (named != nullptr || path_exists(file)) edits = parsed(read_file(file), file.string());
  change(edits);
  const std::string text = text_of(edits);

  const fs::path trial = concat(file.string(), ".trial");
  write_file(trial, text);
  ConfigOverrides with_trial;
  with_trial.assignments.push_back(concat("edits=", write_scalar(concat(name, ".trial"))));
  Problems problems;
  read_config(config, with_trial, problems);
  remove_if_exists(trial);
  problems.throw_if_any();
  write_file(file, text);
  if (named != nullptr) return file;

  const std::string line = yaml_entry("edits", write_scalar(name));
  config_text +=
      concat(config_text.ends_with('\n') ? "" : "\n", "\n", line, "  # saved by crowdface edit\n");
  Complaints complaints;
  const auto longer = parse_yaml(config_text, config.string(), complaints);
  if (!longer || !complaints.empty() || longer->find("edits") == nullptr) {
    throw UsageError(concat(config.string(), ": add \"", line,
                            "\" to this file; the edits are saved in ", file.string()));
  }
  write_file(config, config_text);
  return file;
}

/// Makes paths relative to the config's folder, and formats them as a YAML list on one line.
std::string paths_from(const fs::path& config, const std::vector<fs::path>& files) {
  const fs::path folder = fs::absolute(config).lexically_normal().parent_path();
  return yaml_flow_list_of_names(texts_of(files, [&](const fs::path& file) {
    return fs::absolute(file).lexically_normal().lexically_proximate(folder).generic_string();
  }));
}

/// Saves config sections in the file of edits.
/// \param sections  YAML text in the format of a config.
fs::path put_sections(const fs::path& config, const std::string& sections) {
  return put_edit(config, [&](YamlNode& edits) { merge_edits(parsed(sections, "edits"), edits); });
}

}  // namespace

fs::path save_recipe_in_edits(const ManualRecipe& recipe, const Config& config) {
  const YamlNode node = parsed(format_manual_recipe(recipe, config), "recipe");
  return put_sections(config.file, concat("recipes: [", single_line_yaml(node), "]\n"));
}

fs::path save_regions_in_edits(const fs::path& config, const std::vector<std::string>& names,
                               const std::vector<fs::path>& masks) {
  return put_sections(config, concat("regions: {names: ", yaml_flow_list_of_names(names),
                                     ", mask: ", paths_from(config, masks), "}\n"));
}

fs::path save_heads_in_edits(const fs::path& config, const std::vector<fs::path>& heads) {
  const YamlNode faces =
      parsed(concat("faces: {also: ", paths_from(config, heads), "}\n"), "edits");
  return put_edit(config, [&](YamlNode& edits) {
    YamlEntry* own = nullptr;
    for (YamlEntry& edit : edits.entries) own = edit.key == "faces" ? &edit : own;
    if (own == nullptr) return edits.entries.push_back(faces.entries.front());
    merge_faces_section(faces.entries.front().value, own->value);
  });
}

std::optional<std::string> section_in_edits(const fs::path& edits, const std::string& section) {
  if (edits.empty() || !path_exists(edits)) return std::nullopt;
  const YamlNode root = parsed(read_file(edits), edits.string());
  const YamlEntry* found = root.find(section);
  if (found == nullptr) return std::nullopt;
  return single_line_yaml(found->value);
}

fs::path restore_section(const fs::path& config, const std::string& section,
                         const std::optional<std::string>& value) {
  return put_edit(config, [&](YamlNode& edits) {
    std::erase_if(edits.entries, [&](const YamlEntry& edit) { return edit.key == section; });
    if (!value) return;
    YamlNode root = parsed(yaml_entry(section, *value), section);
    if (root.entries.size() != 1) throw UsageError(concat(section, ": expected one value"));
    edits.entries.push_back(std::move(root.entries.front()));
  });
}

}  // namespace crowdface
