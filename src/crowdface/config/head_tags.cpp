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
    out.add_at(node, concat("the tag ", quoted(tag), " is also the name of a head"));
  } else if (tag == "all" || tag == "target") {
    out.add_at(node, concat("a tag cannot have the reserved name ", quoted(tag)));
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
    const YamlEntry* tags = section != nullptr ? section->value.find("tags") : nullptr;
    if (tags == nullptr) {
      if (root) draft.complaints.add(root->place, "faces.tags is missing: the tags of the heads");
      continue;
    }
    YamlNode of_heads = tags->value;
    std::erase_if(of_heads.entries,
                  [&](const YamlEntry& entry) { return !contains(faces.names, entry.key); });
    read_head_tags(of_heads, faces, draft);
  }
  draft.are_tags_known = draft.complaints.size() == complaints_before;
}

}  // namespace crowdface
