// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/config_reader.h"

#include <algorithm>

#include "crowdface/cast/review.h"
#include "crowdface/config/config_keys.h"
#include "crowdface/config/edits.h"
#include "crowdface/config/overridden_keys.h"

namespace crowdface {
namespace {

/// Turns the value of a command-line option into a YAML node.
YamlNode option_node(const char* option, const std::string& text) {
  YamlNode node;
  node.kind = YamlNode::Kind::kScalar;
  node.place.source = std::make_shared<const std::string>(option);
  node.text = text;
  return node;
}

/// Inserts the reviews stored in the crowd's folder before the reviews that the config lists.
void insert_stored_reviews(const std::vector<std::filesystem::path>& kept, YamlNode& root) {
  YamlNode reviews;
  reviews.kind = YamlNode::Kind::kList;
  for (const std::filesystem::path& file : kept) {
    reviews.items.push_back(option_node("review", std::filesystem::absolute(file).string()));
  }
  const auto named = std::ranges::find(root.entries, "review", &YamlEntry::key);
  if (named == root.entries.end()) {
    root.entries.push_back({"review", {}, std::move(reviews)});
    return;
  }
  const YamlNode& own = named->value;
  const std::vector<YamlNode> items =
      own.kind == YamlNode::Kind::kList ? own.items : std::vector<YamlNode>{own};
  reviews.items.insert(reviews.items.end(), items.begin(), items.end());
  named->value = std::move(reviews);
}

void apply(const ConfigOverrides& overrides, YamlNode& root, Complaints& complaints) {
  for (const std::string& assignment : overrides.assignments) {
    set_value(root, assignment, complaints);
  }
  if (overrides.count) {
    set_text(root, "crowd.count", *overrides.count, concat("--count ", *overrides.count),
             complaints);
  }
  if (overrides.seed) {
    set_text(root, "crowd.seed", *overrides.seed, concat("--seed ", *overrides.seed), complaints);
  }
  if (!overrides.stored_reviews.empty()) insert_stored_reviews(overrides.stored_reviews, root);
}

/// Reads the options `--review` and `--out`. The paths in these options are relative to the working
/// directory, not to the config's folder.
void read_path_options(const ConfigOverrides& overrides, ConfigDraft& draft) {
  draft.folder.clear();
  for (const std::string& file : overrides.review) {
    read_review(option_node("--review", file), draft.config, draft);
  }
  if (!overrides.out) return;
  const auto folder = path("a folder").read(option_node("--out", *overrides.out), draft);
  if (folder) draft.config.output.directory = *folder;
}

/// Reads a config from a parsed YAML tree.
///
/// \param parse  parse(complaints) returns the YAML tree, and adds complaints to its argument.
template <class Parse>
ConfigReading read_parsed(const std::filesystem::path& file, const ConfigOverrides& overrides,
                          Problems& problems, const Parse& parse) {
  Complaints complaints;
  ConfigDraft draft(complaints);
  draft.config.file = file;
  draft.folder = file.parent_path();
  draft.stored_reviews = overrides.stored_reviews;
  draft.former_face_count = overrides.former_face_count;
  draft.former_min_distance_mm = overrides.former_min_distance_mm;
  draft.ignored_reviews_folder = overrides.ignored_reviews_folder;
  std::optional<YamlNode> root = parse(complaints);
  if (root) {
    apply(overrides, *root, complaints);
    read_edits(*root, draft);
    read_keys(*root, root_keys(), draft.config, draft);
  }
  auto& directory = draft.config.output.directory;
  if (directory.empty()) directory = resolve(draft.folder, concat("out/", draft.config.crowd.name));
  if (root) read_path_options(overrides, draft);
  complaints.report_to(problems);
  const bool complete = complaints.empty();
  if (complete) {
    for (std::string& text : overridden_key_warnings(*root, draft.config)) {
      draft.warnings.push_back(std::move(text));
    }
  }
  return {std::move(draft.config), complete, draft.are_heads_known, root && draft.are_regions_known,
          std::move(draft.warnings)};
}

}  // namespace

ConfigReading read_partial_config(const std::filesystem::path& file,
                                  const ConfigOverrides& overrides, Problems& problems) {
  return read_parsed(file, overrides, problems,
                     [&](Complaints& out) { return read_yaml(file.string(), out); });
}

ConfigReading read_config_text(std::string_view text, const std::filesystem::path& file,
                               const ConfigOverrides& overrides, Problems& problems) {
  return read_parsed(file, overrides, problems,
                     [&](Complaints& out) { return parse_yaml(text, file.string(), out); });
}

std::optional<Config> read_config(const std::filesystem::path& file,
                                  const ConfigOverrides& overrides, Problems& problems) {
  ConfigReading reading = read_partial_config(file, overrides, problems);
  if (!reading.is_complete) return std::nullopt;
  return std::move(reading.config);
}

}  // namespace crowdface
