// SPDX-License-Identifier: Apache-2.0
// The config section `regions`.
#include <algorithm>
#include <set>

#include "crowdface/config/config_keys.h"
#include "crowdface/config/starter_config.h"
#include "crowdface/core/contains.h"
#include "crowdface/io/tile_files.h"

namespace crowdface {
namespace {

using Regions = Config::Regions;

constexpr std::size_t kMaxRegions = 16;

void read_mask_image(const YamlNode& node, Regions& regions, ConfigDraft& draft) {
  const auto mask = path("an image file").read(node, draft);
  if (!mask) return;
  const std::string text = mask->string();
  const std::size_t tiles = text.find(kTileWord);
  if (tiles == std::string::npos) {
    expect_file(node, *mask, draft, "the mask ");
  } else if (mask->filename().string().find(kTileWord) == std::string::npos ||
             text.find(kTileWord, tiles + 1) != std::string::npos) {
    draft.complaints.add_at(node, "expected <UDIM> only once, in the file name");
  } else if (find_tiles(*mask).empty()) {
    draft.complaints.add_at(
        node,
        concat(
            "no tile of the mask ", quoted(text),
            " exists; expected files whose names have a tile number in place of <UDIM>, such as ",
            quoted(udim_tile_path(*mask, 1001).filename().string())),
        ExitCode::kMissingInput);
  }
  regions.mask.push_back(text);
}

void read_masks(const YamlNode& node, Regions& regions, ConfigDraft& draft) {
  if (node.kind == YamlNode::Kind::kScalar) return read_mask_image(node, regions, draft);
  if (node.items.empty()) draft.complaints.add_mismatch(node, "an image file or a list of them");
  for (const YamlNode& item : node.items) read_mask_image(item, regions, draft);
}

std::string write_masks(const Regions& regions, const WriteContext& context) {
  return yaml_block_list(texts_of(
      regions.mask, [&](const std::string& mask) { return path("").write(mask, context); }));
}

/// Reads the name of a region. Some words are reserved, because region names are also keys of the
/// config and parts of the column names in crowd.csv.
void read_region_name(const YamlNode& node, Regions& regions, Complaints& out) {
  static const std::set<std::string> reserved = {"all", "default", "none", "iterations"};
  auto& names = regions.names;
  const auto name = read_name(node, out);
  if (!name) return;
  if (reserved.contains(*name)) {
    out.add_at(node, concat("a region cannot have the name ", quoted(*name),
                            ", because the word is reserved; rename the region"));
  } else if (contains(names, *name)) {
    out.add_at(node, concat("the region ", quoted(*name), " is named twice"));
  }
  names.push_back(*name);
}

void read_region_names(const YamlNode& node, Regions& regions, ConfigDraft& draft) {
  const std::size_t complaints_before = draft.complaints.size();
  if (node.items.empty() || node.items.size() > kMaxRegions) {
    draft.complaints.add_mismatch(node, concat("a list of 1 to ", kMaxRegions, " names"));
  } else {
    for (const YamlNode& item : node.items) read_region_name(item, regions, draft.complaints);
  }
  draft.are_regions_known = draft.complaints.size() == complaints_before;
}

const Keys<Regions>& regions_keys() {
  static const Keys<Regions> keys = {
      Key<Regions>{"names", read_region_names,
                   [](const Regions& regions, const auto&) {
                     return yaml_flow_list_of_names(regions.names);
                   },
                   "such as [top, middle, bottom]"}
          .with_accepted_values(concat("list of 1 to ", kMaxRegions, " names")),
      Key<Regions>{"mask", read_masks, write_masks, "the image whose channels are the regions"}
          .with_accepted_values("image file, or list of image files")};
  return keys;
}

void read_regions(const YamlNode& node, Config& config, ConfigDraft& draft) {
  if (is_word(node, "none")) return;
  draft.are_regions_known = false;
  if (!draft.complaints.expect_map(node, "none or a mapping with the keys names, mask")) return;
  read_keys(node, regions_keys(), config.regions, draft);
  config.sampling->regions.resize(config.region_names().size());
}

std::optional<StarterLines> regions_starter(const StarterFacts& facts) {
  if (facts.mask_file.empty()) {
    return StarterLines{
        "none", "",
        "Regions of the face that are blended separately need a mask image: one colour channel "
        "per\nregion, in the layout of the meshes' UVs (crowdface mask proposes one). Without it, "
        "the\nhead is a single region.\nregions: {names: [top, middle, bottom], mask: bands.png}"};
  }
  return StarterLines{yaml_block_map({concat("names: [", join(facts.regions), ']'),
                                      yaml_entry("mask", write_scalar(facts.mask_file))}),
                      "",
                      "Regions of the face that are blended separately: each colour channel of the "
                      "image masks one\nregion. \"regions: none\" makes the head a single region."};
}

std::string write_regions(const Config& config, const WriteContext& context) {
  if (config.regions.names.empty()) return "none";
  return yaml_block_map(write_keys(regions_keys(), config.regions, context));
}

}  // namespace

Key<Config> regions_key() {
  return Key<Config>{"regions", read_regions, write_regions, {}, regions_starter}.with_nested_keys(
      regions_keys());
}

}  // namespace crowdface
