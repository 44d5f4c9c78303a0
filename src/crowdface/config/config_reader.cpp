// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/config_reader.h"

#include "crowdface/config/config_keys.h"

namespace crowdface {
namespace {

constexpr std::uint64_t kSchema = 1;

void apply(const ConfigOverrides& overrides, YamlNode& root, Complaints& complaints) {
  for (const std::string& assignment : overrides.set) {
    set_value(root, assignment, complaints);
  }
  if (overrides.count) {
    set_text(root, "crowd.count", *overrides.count, concat("--count ", *overrides.count),
             complaints);
  }
  if (overrides.seed) {
    set_text(root, "crowd.seed", *overrides.seed, concat("--seed ", *overrides.seed), complaints);
  }
}

void read_schema(const MapReader& root, Complaints& complaints) {
  const YamlNode* node = root.require("schema", "write \"schema: 1\"");
  if (node == nullptr) return;
  if (node->kind != YamlNode::Kind::kScalar || node->quoted ||
      parse_unsigned(node->text) != kSchema) {
    complaints.about(*node, concat("this crowdface reads schema 1, found ", describe(*node)));
  }
}

void read_root(const YamlNode& node, const ConfigOverrides& overrides, ConfigDraft& draft) {
  const MapReader root(
      &node,
      {"schema", "crowd", "faces", "regions", "smoothing", "blending", "parts", "plane", "sampling",
       "distance", "diversity", "believability", "recipes", "families", "review", "output"},
      draft.complaints);
  if (node.kind != YamlNode::Kind::kMap) return;
  read_schema(root, draft.complaints);
  read_keys(root.require("crowd", "such as \"crowd: {name: market, count: 24}\""), crowd_keys(),
            draft.config.crowd, draft);
  read_faces(root.require("faces", "such as \"faces: {directory: heads, units: cm}\""), draft);
  read_regions(root.find("regions"), draft);
  draft.largest_size_mm = draft.config.smoothing.max_size_mm;
  read_keys(root.find("smoothing"), smoothing_keys(), draft.config.smoothing, draft);
  read_keys(root.find("blending"), blending_keys(), draft.config.blending, draft);
  read_parts(root.find("parts"), draft);
  read_plane(root.find("plane"), draft);
  read_sampling(root.find("sampling"), draft);
  read_keys(root.find("distance"), distance_keys(), draft.config.distance, draft);
  read_keys(root.find("diversity"), diversity_keys(), draft.config.diversity, draft);
  read_believability(root.find("believability"), draft);
  read_recipes(root.find("recipes"), draft);
  read_families(root.find("families"), draft);
  if (overrides.review.empty()) read_review(root.find("review"), draft);
  read_output(root.find("output"), draft);
}

/// `--review`: unlike the paths of the file, relative to the working directory.
void read_review_options(const std::vector<std::string>& files, ConfigDraft& draft) {
  for (const std::string& file : files) {
    YamlNode node;
    node.kind = YamlNode::Kind::kScalar;
    node.place.source = std::make_shared<const std::string>("--review");
    node.text = file;
    const auto text = read_text(node, "a review file", draft.complaints);
    if (!text) continue;
    draft.config.review.files.push_back(resolve("", *text));
    draft.config.review.reviews.push_back(
        read_review_file(draft.config.review.files.back(), node, draft));
  }
}

/// `--out`: unlike the paths of the file, relative to the working directory.
void read_out(const std::string& text, ConfigDraft& draft) {
  YamlNode node;
  node.kind = YamlNode::Kind::kScalar;
  node.place.source = std::make_shared<const std::string>("--out");
  node.text = text;
  const auto folder = read_text(node, "a folder", draft.complaints);
  if (folder) draft.config.output.directory = resolve("", *folder);
}

}  // namespace

ConfigReading read_config_parts(const std::filesystem::path& file, const ConfigOverrides& overrides,
                                Problems& problems) {
  Complaints complaints;
  ConfigDraft draft(complaints);
  draft.config.file = file;
  draft.folder = file.parent_path();
  auto root = read_yaml(file.string(), complaints);
  if (root) {
    apply(overrides, *root, complaints);
    read_root(*root, overrides, draft);
    read_review_options(overrides.review, draft);
  }
  if (overrides.out) read_out(*overrides.out, draft);
  complaints.tell(problems);
  const bool complete = complaints.empty();
  return {std::move(draft.config), complete, draft.heads_known, draft.regions_known};
}

std::optional<Config> read_config(const std::filesystem::path& file,
                                  const ConfigOverrides& overrides, Problems& problems) {
  ConfigReading reading = read_config_parts(file, overrides, problems);
  if (!reading.complete) return std::nullopt;
  return std::move(reading.config);
}

}  // namespace crowdface
