// SPDX-License-Identifier: Apache-2.0
// The section `regions`.
#include <algorithm>
#include <set>
#include <system_error>

#include "crowdface/config/config_sections.h"
#include "crowdface/core/text.h"
#include "crowdface/io/tile_files.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostRegions = 16;

void read_mask(const YamlNode& node, ConfigDraft& draft) {
  const auto text = read_text(node, "an image file", draft.complaints);
  if (!text) return;
  const fs::path mask = resolve(draft.folder, *text);
  const std::string name = mask.filename().string();
  const std::size_t tiles = mask.string().find(kTileWord);
  if (tiles == std::string::npos) {
    if (!file_exists(mask)) {
      draft.complaints.about(node, concat("the mask ", quoted(mask.string()), " is missing"),
                             ExitCode::kMissingInput);
    }
  } else if (name.find(kTileWord) == std::string::npos ||
             mask.string().find(kTileWord, tiles + 1) != std::string::npos) {
    draft.complaints.about(node, "<UDIM> can stand once, in the name of the file");
  } else if (find_tiles(mask).empty()) {
    draft.complaints.about(node,
                           concat("no tile of the mask ", quoted(mask.string()),
                                  " is there, such as 1001 in place of <UDIM>"),
                           ExitCode::kMissingInput);
  }
  draft.config.regions.mask.push_back(mask.string());
}

void read_masks(const YamlNode* node, ConfigDraft& draft) {
  if (node == nullptr) return;
  if (node->kind == YamlNode::Kind::kScalar) return read_mask(*node, draft);
  if (node->kind != YamlNode::Kind::kList || node->items.empty()) {
    draft.complaints.expected(*node, "an image file or a list of them");
    return;
  }
  for (const YamlNode& item : node->items) read_mask(item, draft);
}

/// Region names stand among keys of the config, and in the columns of crowd.csv.
void read_region_name(const YamlNode& node, ConfigDraft& draft) {
  auto& names = draft.config.regions.names;
  const auto name = read_name(node, draft.complaints);
  if (!name) return;
  static const std::set<std::string> reserved = {"all", "default", "none", "iterations"};
  if (reserved.contains(*name)) {
    draft.complaints.about(
        node, concat("no region can be called ", quoted(*name), ", the word has its own meaning"));
  } else if (std::find(names.begin(), names.end(), *name) != names.end()) {
    draft.complaints.about(node, concat("the region ", quoted(*name), " is named twice"));
  }
  names.push_back(*name);
}

}  // namespace

void read_regions(const YamlNode* node, ConfigDraft& draft) {
  draft.regions_known = true;
  if (node == nullptr) return;
  if (node->kind == YamlNode::Kind::kScalar && node->text == "none") return;
  const std::size_t complaints_before = draft.complaints.size();
  if (node->kind != YamlNode::Kind::kMap) {
    draft.complaints.expected(*node, "none or a mapping with the keys names, mask");
    draft.regions_known = false;
    return;
  }
  const MapReader map(node, {"names", "mask"}, draft.complaints);
  const YamlNode* names = map.require("names", "such as [top, middle, bottom]");
  if (names != nullptr) {
    if (names->kind != YamlNode::Kind::kList || names->items.empty() ||
        names->items.size() > kMostRegions) {
      draft.complaints.expected(*names, concat("a list of 1 to ", kMostRegions, " names"));
    } else {
      for (const YamlNode& item : names->items) read_region_name(item, draft);
    }
  }
  draft.regions_known = draft.complaints.size() == complaints_before;
  read_masks(map.require("mask", "the image whose channels are the regions"), draft);
}

}  // namespace crowdface
