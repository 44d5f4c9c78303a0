// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/regions_in_config.h"

#include "crowdface/config/yaml.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/editor/config_text.h"

namespace crowdface {
namespace {

std::string list_of(const std::vector<std::string>& texts) {
  std::vector<std::string> scalars;
  for (const std::string& text : texts) scalars.push_back(write_scalar(text));
  return concat('[', join(scalars), ']');
}

/// Whether the keys of a section stand on lines of their own.
bool has_lines(const ConfigText& text, const YamlEntry& section) {
  if (section.value.entries.empty()) return false;
  const YamlPlace& first = section.value.entries.front().key_place;
  if (line_of(first) == line_of(section.key_place)) return false;
  const std::string& line = text.line(line_of(first));
  return line[line.find_first_not_of(' ')] != '{';
}

}  // namespace

std::string with_regions(std::string_view text, const std::string& source,
                         const std::vector<std::string>& names,
                         const std::vector<std::string>& masks) {
  const std::string names_entry = concat("names: ", list_of(names));
  const std::string mask_entry =
      concat("mask: ", masks.size() == 1 ? write_scalar(masks.front()) : list_of(masks));
  const ConfigText old(text, source);
  const YamlEntry* section = old.root().find("regions");
  const std::vector<std::string> whole = {"regions:", concat("  ", names_entry),
                                          concat("  ", mask_entry)};
  if (section == nullptr) {
    std::vector<std::string> added = {""};
    added.insert(added.end(), whole.begin(), whole.end());
    return old.with(old.line_count(), old.line_count(), added);
  }
  const std::size_t begin = line_of(section->key_place);
  if (!has_lines(old, *section)) return old.with(begin, old.end_of_block(begin, 0), whole);
  const std::string& first = old.line(line_of(section->value.entries.front().key_place));
  const std::size_t indent = first.find_first_not_of(' ');
  std::string changed(text);
  for (const auto& [key, entry] :
       {std::pair("mask", mask_entry), std::pair("names", names_entry)}) {
    const ConfigText now(changed, source);
    const YamlEntry* there = now.root().find("regions")->value.find(key);
    const std::string line = concat(std::string(indent, ' '), entry);
    if (there == nullptr) {
      changed = now.with(begin + 1, begin + 1, {line});
      continue;
    }
    const std::vector<YamlNode>& items = there->value.items;  // dashes may stand below their key
    const YamlPlace& last = items.empty() ? there->key_place : items.back().place;
    changed = now.with(line_of(there->key_place), now.end_of_block(line_of(last), indent), {line});
  }
  return changed;
}

void put_regions(const std::filesystem::path& config, const std::vector<std::string>& names,
                 const std::vector<std::filesystem::path>& masks) {
  std::vector<std::string> from_config;
  for (const std::filesystem::path& mask : masks) {
    const auto path = std::filesystem::absolute(mask).lexically_normal();
    const auto folder = std::filesystem::absolute(config).lexically_normal().parent_path();
    from_config.push_back(path.lexically_proximate(folder).generic_string());
  }
  replace_config(config, with_regions(read_file(config), config.string(), names, from_config));
}

}  // namespace crowdface
