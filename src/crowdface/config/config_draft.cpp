// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/config_draft.h"

#include <algorithm>
#include <set>

#include "crowdface/cast/sampling.h"
#include "crowdface/config/config_values.h"
#include "crowdface/config/input_files.h"
#include "crowdface/core/contains.h"
#include "crowdface/core/file.h"

namespace crowdface {

ConfigDraft::ConfigDraft(Complaints& out) : complaints(out) {
  config.sampling->regions.resize(1);
}

std::filesystem::path resolve(const std::filesystem::path& folder, const std::string& path) {
  std::filesystem::path resolved = (folder / path).lexically_normal();
  // for a path that ends with '/', parent_path() only removes this '/'
  return resolved.has_filename() ? resolved : resolved.parent_path();
}

bool expect_file(const YamlNode& node, const std::filesystem::path& file, ConfigDraft& draft,
                 std::string_view what) {
  if (path_exists(file) && !is_folder(file)) return true;
  const std::string found =
      is_folder(file) ? " is a folder; name the file in it" : " is missing" + advice_on_path(file);
  draft.complaints.add_at(node, concat(what, quoted(file.string()), found),
                          ExitCode::kMissingInput);
  return false;
}

std::optional<Eigen::Index> find_head(const std::string& name, const YamlPlace& place,
                                      const std::string& path, ConfigDraft& draft) {
  const auto& names = draft.config.faces.names;
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return found - names.begin();
  if (draft.are_heads_known) {
    draft.complaints.add(place, concat(path, ": no head is called ", quoted(name),
                                       suggestion_or_choices(name, names)));
  }
  return std::nullopt;
}

bool has_tags(const std::vector<std::string>& head_tags, const std::vector<std::string>& tags) {
  return std::ranges::all_of(tags,
                             [&](const std::string& tag) { return contains(head_tags, tag); });
}

std::vector<Eigen::Index> heads_with_tags(const std::vector<std::string>& tags,
                                          const Config::Faces& faces) {
  std::vector<Eigen::Index> heads;
  for (std::size_t h = 0; h < faces.tags.size(); ++h) {
    if (has_tags(faces.tags[h], tags)) heads.push_back(static_cast<Eigen::Index>(h));
  }
  return heads;
}

std::string known_tags(const Config::Faces& faces) {
  constexpr std::size_t kMaxShownTags = 30;
  std::set<std::string> tags;
  for (const auto& of_head : faces.tags) tags.insert(of_head.begin(), of_head.end());
  if (tags.empty()) return "; no head has any tag, see faces.tags";
  std::vector<std::string> shown(tags.begin(), tags.end());
  if (shown.size() > kMaxShownTags) shown.resize(kMaxShownTags);
  return concat("; the heads have the tags ", join(shown),
                tags.size() > kMaxShownTags ? ", …" : "");
}

std::vector<std::string> remove_age_tags(std::vector<std::string> tags) {
  std::erase_if(tags,
                [](const auto& tag) { return tag == "young" || tag == "adult" || tag == "old"; });
  return tags;
}

std::vector<std::size_t> find_region_bands(const std::string& name, const Config& config) {
  const std::vector<std::string> regions = config.region_names();
  const std::vector<std::string> bands = config.plan_names().bands;
  const std::vector<std::string> parts = config.region_band_names();
  const std::size_t each = parts.size() / regions.size();
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const bool of_band = !bands.empty() && bands[i % each] == name;
    if (parts[i] == name || regions[i / each] == name || of_band) found.push_back(i);
  }
  return found;
}

std::vector<Eigen::Index> find_heads(const std::string& name, const YamlPlace& place,
                                     const std::string& path, ConfigDraft& draft) {
  std::vector<Eigen::Index> heads;
  std::vector<std::string> known = draft.config.faces.names;
  const auto& tags = draft.config.faces.tags;
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known[i] == name || contains(tags[i], name)) {
      heads.push_back(static_cast<Eigen::Index>(i));
    }
  }
  if (heads.empty() && draft.are_heads_known && draft.are_tags_known) {
    for (const auto& head_tags : tags)
      known.insert(known.end(), head_tags.begin(), head_tags.end());
    const std::string similar = suggestion(name, known);
    draft.complaints.add(place, concat(path, ": no head and no tag is called ", quoted(name),
                                       similar.empty() ? known_tags(draft.config.faces) : similar));
  }
  return heads;
}

}  // namespace crowdface
