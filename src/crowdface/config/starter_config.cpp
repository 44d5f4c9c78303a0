// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/starter_config.h"

#include <algorithm>

#include "crowdface/config/config_keys.h"

namespace crowdface {

std::string starter_lines(std::string_view key, const StarterLines& lines) {
  constexpr std::size_t kCommentColumn = 23;
  std::string text;
  for (const std::string_view line : split_lines(lines.above)) text += concat("\n# ", line);
  if (lines.value.empty()) return text;
  std::string line = entry(key, lines.value);
  if (!lines.beside.empty()) {
    line.resize(std::max(line.size() + 1, kCommentColumn), ' ');
    line += concat("# ", lines.beside);
  }
  return concat(text, '\n', line);
}

std::string starter_config(const StarterFacts& facts) {
  std::string text =
      "# A first crowd. Run it with: crowdface generate THIS_FILE\n"
      "# Every key, with its range and default, is explained in docs/config.md.";
  for (const Key<Config>& key : root_keys()) {
    const auto lines = key.starter ? key.starter(facts) : std::nullopt;
    if (lines) text += concat(starter_lines(key.name, *lines), '\n');
  }
  return text;
}

std::string starter_attachments(const YamlNode& section, const StarterFacts& facts,
                                const std::filesystem::path& heads,
                                const std::filesystem::path& config_folder,
                                Complaints& complaints) {
  ConfigDraft draft(complaints);
  draft.folder = heads;
  draft.config.faces.names = facts.names;
  draft.heads_known = true;
  draft.tags_known = false;  // no complaints about items that no head may wear: removed below
  attachments_key().read(section, draft.config, draft);
  if (!complaints.empty()) return {};
  Config::Attachments& attachments = draft.config.attachments;
  std::erase_if(attachments.items, [&](const Config::Attachment& item) {
    return !item.tags.empty() && std::ranges::none_of(facts.tags, [&](const auto& head) {
      return has_tags(head.second, item.tags);
    });
  });
  const auto is_nobodys = [&](const std::string& word) {
    return std::ranges::none_of(attachments.items,
                                [&](const auto& item) { return is_called(item, word); });
  };
  const auto speaks_of_nobody = [&](const auto& share) { return is_nobodys(share.first); };
  std::erase_if(attachments.none, speaks_of_nobody);
  std::erase_if(attachments.quotas, speaks_of_nobody);
  for (Config::Attachment& item : attachments.items) std::erase_if(item.excludes, is_nobodys);
  return attachments_key().write(draft.config, {draft.config, config_folder});
}

}  // namespace crowdface
