// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/head_tags.h"

#include <algorithm>
#include <set>

#include "crowdface/config/config_values.h"
#include "crowdface/config/yaml.h"
#include "crowdface/core/contains.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

/// Adds a complaint about a tag that is also a head's name, `all` or `target`.
void check_tag(const YamlNode& node, const Config::Faces& faces, Complaints& out) {
  const std::string& tag = node.text;
  if (contains(faces.names, tag)) {
    out.add_at(node,
               concat("the tag ", quoted(tag), " is also the name of a head; rename the tag"));
  } else if (tag == "all" || tag == "target") {
    out.add_at(node, concat("a tag cannot have the name ", quoted(tag),
                            ", because the word is reserved; rename the tag"));
  }
}

std::vector<std::string> read_tags_of_head(const YamlNode& node, const Config::Faces& faces,
                                           Complaints& out) {
  std::vector<std::string> tags;
  if (!out.expect_list(node, "a list of tags, [old, bearded]")) return tags;
  for (const YamlNode& item : node.items) {
    const auto tag = read_name(item, out);
    if (!tag) continue;
    check_tag(item, faces, out);
    if (contains(tags, *tag)) {
      out.add_at(item, concat("the tag ", quoted(*tag), " is named twice"));
    }
    tags.push_back(*tag);
  }
  return tags;
}

}  // namespace

void read_head_tags(const YamlNode& node, Config::Faces& faces, ConfigDraft& draft) {
  const std::size_t complaints_before = draft.complaints.size();
  draft.complaints.expect_map(node, "a mapping from heads to tags, {head: [tag, ...]}");
  for (const YamlEntry& entry : node.entries) {
    const auto head = find_head(entry.key, entry.key_place, node.path, draft);
    if (!head) continue;
    faces.tags[static_cast<std::size_t>(*head)] =
        read_tags_of_head(entry.value, faces, draft.complaints);
  }
  draft.are_tags_known = draft.complaints.size() == complaints_before;
}

void read_head_ages(const YamlNode& node, Config::Faces& faces, ConfigDraft& draft) {
  constexpr double kOldest = 150;
  draft.complaints.expect_map(node, "a mapping from heads to years, {head: 70}");
  faces.ages_years.resize(faces.names.size());
  for (const YamlEntry& entry : node.entries) {
    const auto head = find_head(entry.key, entry.key_place, node.path, draft);
    const auto years = read_number(entry.value, 0, kOldest, draft.complaints);
    if (head && years) faces.ages_years[static_cast<std::size_t>(*head)] = *years;
  }
}

std::string_view age_class(double years) {
  constexpr double kAdultFrom = 35, kOldFrom = 55;
  if (years >= kOldFrom) return "old";
  return years >= kAdultFrom ? "adult" : "young";
}

void add_age_tags(Config::Faces& faces) {
  for (std::size_t h = 0; h < faces.ages_years.size(); ++h) {
    std::vector<std::string>& tags = faces.tags[h];
    const auto is_age = [](const std::string& tag) {
      return tag == "young" || tag == "adult" || tag == "old";
    };
    if (!faces.ages_years[h] || std::ranges::any_of(tags, is_age)) continue;
    tags.emplace_back(age_class(*faces.ages_years[h]));
  }
}

void read_tags_from_head_folders(Config::Faces& faces, ConfigDraft& draft) {
  const std::size_t complaints_before = draft.complaints.size();
  std::set<std::filesystem::path> folders;
  for (const std::filesystem::path& head : faces.files) folders.insert(head.parent_path());
  for (const std::filesystem::path& folder : folders) {
    const std::filesystem::path file = folder / "tags.yaml";
    if (!is_file(file)) continue;
    draft.config.tag_and_attachment_files.push_back(file);
    const auto root = read_yaml(file.string(), draft.complaints);
    const YamlEntry* section = root ? root->find("faces") : nullptr;
    bool has_any = false;
    for (const auto& [key, read] :
         {std::pair("tags", &read_head_tags), std::pair("ages", &read_head_ages)}) {
      const YamlEntry* entry = section != nullptr ? section->value.find(key) : nullptr;
      if (entry == nullptr) continue;
      has_any = true;
      YamlNode of_heads = entry->value;
      std::erase_if(of_heads.entries,
                    [&](const YamlEntry& head) { return !contains(faces.names, head.key); });
      read(of_heads, faces, draft);
    }
    if (root && !has_any) {
      draft.complaints.add(
          root->place, "expected faces.tags, the tags of the heads, or faces.ages, found neither");
    }
  }
  draft.are_tags_known = draft.complaints.size() == complaints_before;
}

}  // namespace crowdface
