// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/starter_config.h"

#include <algorithm>

#include "crowdface/config/config_keys.h"

namespace crowdface {

std::string starter_lines(std::string_view key, const StarterLines& lines) {
  constexpr std::size_t kCommentColumn = 23;
  std::string text;
  for (const std::string_view line : split_lines(lines.comment_above)) text += concat("\n# ", line);
  if (lines.value.empty()) return text;
  std::string line = yaml_entry(key, lines.value);
  if (!lines.comment_beside.empty()) {
    line.resize(std::max(line.size() + 1, kCommentColumn), ' ');
    line += concat("# ", lines.comment_beside);
  }
  return concat(text, '\n', line);
}

std::string starter_config(const StarterFacts& facts) {
  std::string text =
      "# A first crowd. Run it with: crowdface generate THIS_FILE\n"
      "# Every key, with its range and default, is explained in docs/config.md.";
  for (const Key<Config>& key : root_keys()) {
    const auto lines = key.make_starter_lines ? key.make_starter_lines(facts) : std::nullopt;
    if (lines) text += concat(starter_lines(key.name, *lines), '\n');
  }
  return text;
}

bool has_attachments(const std::filesystem::path& folder, const StarterFacts& facts,
                     Complaints& complaints) {
  ConfigDraft draft(complaints);
  draft.config.faces.names = facts.head_names;
  draft.config.faces.tags = facts.tags;
  draft.are_heads_known = true;
  YamlNode from, section;
  from.kind = YamlNode::Kind::kScalar;
  from.path = "attachments.from";
  from.text = folder.string();
  section.kind = YamlNode::Kind::kMap;
  section.entries.push_back({"from", {}, std::move(from)});
  attachments_key().read(section, draft.config, draft);
  return complaints.empty() && !draft.config.attachments.items.empty();
}

}  // namespace crowdface
