// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/overridden_keys.h"

#include <algorithm>

#include "crowdface/cast/family.h"
#include "crowdface/cast/shares.h"
#include "crowdface/config/config_draft.h"
#include "crowdface/config/yaml.h"
#include "crowdface/core/contains.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

using Heads = std::vector<Eigen::Index>;

/// Returns the value of a key in a mapping; null if the mapping does not have the key.
const YamlNode* value_at(const YamlNode& node, std::string_view key) {
  const YamlEntry* entry = node.find(key);
  return entry == nullptr ? nullptr : &entry->value;
}

const std::vector<YamlNode>& items_at(const YamlNode& root, std::string_view key) {
  static const std::vector<YamlNode> none;
  const YamlNode* list = value_at(root, key);
  return list == nullptr ? none : list->items;
}

std::vector<std::string> words_at(const YamlNode& node, std::string_view key) {
  std::vector<std::string> words;
  if (const YamlNode* value = value_at(node, key)) {
    for (const YamlNode& item : value->items) words.push_back(item.text);
    for (const YamlEntry& entry : value->entries) words.push_back(entry.key);
  }
  return words;
}

std::string counted_faces(std::uint64_t count) {
  return concat(count, count == 1 ? " face" : " faces");
}

class OverriddenKeys {
 public:
  OverriddenKeys(const YamlNode& root, const Config& config)
      : root_(root), config_(config), face_counts_(config.groups.size(), 0) {
    for (const int group : schedule_groups(config.groups, config.crowd.count)) {
      if (group >= 0) ++face_counts_[static_cast<std::size_t>(group)];
    }
    sampled_face_counts_ = face_counts_;
    for (const FamilyOptions& family : config.families) {
      if (family.group)
        face_counts_[*family.group] += static_cast<std::uint64_t>(family.member_count);
      for (const Parent& parent : family.parents) {
        if (parent.group) ++face_counts_[*parent.group];
      }
    }
  }

  std::vector<std::string> find() {
    const auto& groups = items_at(root_, "groups");
    for (std::size_t g = 0; g < std::min(groups.size(), config_.groups.size()); ++g) {
      find_in_group(groups[g], g);
    }
    const auto& families = items_at(root_, "families");
    for (std::size_t f = 0; f < std::min(families.size(), config_.families.size()); ++f) {
      find_in_family(families[f], config_.families[f]);
    }
    const auto& recipes = items_at(root_, "recipes");
    for (std::size_t r = 0; r < std::min(recipes.size(), config_.recipes.size()); ++r) {
      find_in_recipe(recipes[r], config_.recipes[r]);
    }
    find_in_attachments();
    return std::move(messages_);
  }

 private:
  template <class... Parts>
  void add_message(const Parts&... parts) {
    messages_.push_back(concat(parts...));
  }

  Heads with_any(const std::vector<std::string>& tags) const {
    Heads heads;
    for (std::size_t h = 0; h < config_.faces.tags.size(); ++h) {
      const bool has_one = std::ranges::any_of(
          tags, [&](const std::string& tag) { return contains(config_.faces.tags[h], tag); });
      if (has_one) heads.push_back(static_cast<Eigen::Index>(h));
    }
    return heads;
  }

  void find_in_group(const YamlNode& node, std::size_t g) {
    const Group& group = config_.groups[g];
    if (const auto tags = words_at(node, "tags"); !tags.empty())
      find_heads_without_group_tags(node, g, tags);
    if (const auto tags = words_at(node, "without"); !tags.empty())
      find_excluded_heads(node, g, tags);
    const YamlNode *count = value_at(node, "count"), *share = value_at(node, "share");
    const bool wants_none =
        (count != nullptr && group.count == 0U) || (share != nullptr && group.share == 0);
    if (sampled_face_counts_[g] == 0 && !wants_none && config_.crowd.count > 0) {
      add_message(node.path, ": the group ", group.name, " gets none of the ", config_.crowd.count,
                  " sampled faces: the counts and shares of all groups leave it none");
    }
  }

  /// Finds heads that lend detail to a group although the heads do not have the group's tags. Also
  /// finds keys of `sampling` that have no effect on the group, because the group's tags select its
  /// heads.
  void find_heads_without_group_tags(const YamlNode& node, std::size_t g,
                                     const std::vector<std::string>& tags) {
    const SamplingOptions &own = config_.groups[g].sampling, &all = *config_.sampling;
    const auto report_untagged = [&](const std::string& key, const Heads& heads, const char* what,
                                     const std::vector<std::string>& wanted) {
      const Heads tagged = heads_with_tags(wanted, config_.faces);
      const auto others =
          std::ranges::count_if(heads, [&](auto head) { return !contains(tagged, head); });
      if (others == 0) return;
      add_message(key, ": ", others, " of the ", heads.size(), " ", what,
                  " do not have the group's tags, ", join(wanted), "; ",
                  counted_faces(face_counts_[g]), " take detail from them");
    };
    const YamlNode *targets = value_at(node, "targets"), *sources = value_at(node, "sources");
    if (sources != nullptr) report_untagged(sources->path, own.sources, "sources", tags);
    for (const BandSampling& band : own.bands) {
      if (band.sources)
        report_untagged(concat(node.path, ".bands.", band.name), *band.sources, "sources", tags);
    }
    const bool in_years = own.age.unit == AgeUnit::kYears;
    if (in_years || own.age.range.high > 0)
      report_untagged(node.path + ".age", own.heads_tagged_old, "heads tagged old",
                      remove_age_tags(tags));
    if (in_years || own.age.range.low < 0)
      report_untagged(node.path + ".age", own.heads_tagged_young, "heads tagged young",
                      remove_age_tags(tags));
    const auto replaced = [&](const char* key) {
      add_message("sampling.", key, ": does not apply to the group ", config_.groups[g].name,
                  ", whose tags select its heads (", counted_faces(face_counts_[g]), ")");
    };
    const bool has_weights = std::ranges::any_of(
        all.targets, [](const WeightedHead& target) { return target.weight != 1; });
    const std::size_t heads = config_.faces.names.size();
    if (targets == nullptr && (has_weights || all.targets.size() != heads)) replaced("targets");
    if (sources == nullptr && all.sources.size() != heads) replaced("sources");
  }

  /// Finds heads that a group lists although the group's key `without` removes these heads.
  void find_excluded_heads(const YamlNode& node, std::size_t g,
                           const std::vector<std::string>& tags) {
    const Heads left_out = with_any(tags);
    for (const char* key : {"targets", "sources"}) {
      std::vector<std::string> named;
      for (const std::string& word : words_at(node, key)) {
        const auto head = std::ranges::find(config_.faces.names, word);
        const bool is_head = head != config_.faces.names.end();
        if (is_head && contains(left_out, head - config_.faces.names.begin())) {
          named.push_back(word);
        }
      }
      if (named.empty()) continue;
      add_message(node.path, '.', key, ": without, ", join(tags), ", leaves out ", join(named),
                  " (", counted_faces(face_counts_[g]), ")");
    }
  }

  void find_in_family(const YamlNode& node, const FamilyOptions& family) {
    const auto members = static_cast<std::uint64_t>(family.member_count);
    const auto is_target = [](const SamplingOptions& sampling, Eigen::Index head) {
      return std::ranges::find(sampling.targets, head, &WeightedHead::head) !=
             sampling.targets.end();
    };
    if (family.group) {
      const Group& group = config_.groups[*family.group];
      if (family.target && !is_target(group.sampling, *family.target)) {
        add_message(node.path,
                    ".target: ", config_.faces.names[static_cast<std::size_t>(*family.target)],
                    " is not a target of the group ", group.name, ", but ", counted_faces(members),
                    " of the group are built on it");
      }
      if (group.sampling.age != AgeRange{} && value_at(node, "age") == nullptr) {
        add_message(node.path, ": the age of the group ", group.name,
                    " does not apply to its members (", counted_faces(members),
                    "), whose age is 0; write age");
      }
    }
    for (std::size_t p = 0; p < family.parents.size(); ++p) {
      const Parent& parent = family.parents[p];
      const char *role = p == 0 ? "mother" : "father", *sex = p == 0 ? "female" : "male";
      if (!parent.is_new || parent.group || with_any({"female", "male"}).empty()) continue;
      const bool has_target = std::ranges::any_of(
          parent.possible_target_heads,
          [&](Eigen::Index head) { return is_target(*config_.sampling, head); });
      if (has_target) continue;
      add_message(node.path, ".parents.", role, ": no target of sampling.targets is tagged ", sex,
                  ", so 1 face is built on any target");
    }
  }

  void find_in_recipe(const YamlNode& node, const ManualRecipe& recipe) {
    const auto has_weights = [](const ManualRecipe::Band& band) { return !band.weights.empty(); };
    const bool has_any = std::ranges::any_of(recipe.regions, [&](const auto& region) {
      return has_weights(region) || std::ranges::any_of(region.bands, has_weights);
    });
    if (!has_any || recipe.age || config_.sampling->age == AgeRange{}) return;
    add_message(node.path, ": sampling.age moves the weights of ", recipe.id,
                " to other heads (1 face); write age: 0 to keep its weights");
  }

  void find_in_attachments() {
    const auto& attachments = config_.attachments;
    const bool has_tint = std::ranges::any_of(
        attachments.items, [](const auto& item) { return item.tint != Tint::kNone; });
    for (std::size_t g = 0; g < config_.groups.size() && !has_tint; ++g) {
      if (config_.groups[g].hair_colours.empty()) continue;
      add_message("groups #", g + 1, ".hair_colours: no attachment has a tint, so ",
                  counted_faces(face_counts_[g]), " keep the colours of the attachments' textures");
    }
    if (!has_tint && !attachments.hair_colours.empty()) {
      add_message("attachments.hair_colours: no attachment has a tint, so ",
                  counted_faces(config_.crowd.count),
                  " keep the colours of the attachments' textures");
    }
    for (const Config::Attachment& item : attachments.items) {
      Heads wearers = heads_with_tags(item.tags, config_.faces);
      const Heads refused = with_any(item.excluded_tags);
      std::erase_if(wearers, [&](Eigen::Index head) { return contains(refused, head); });
      if (wearers.empty()) {
        add_message("attachments.items: ", item.name,
                    ": each head that has its tags also has a tag of ", "without, ",
                    join(item.excluded_tags), "; no face wears it");
      }
    }
  }

  const YamlNode& root_;
  const Config& config_;
  std::vector<std::uint64_t> sampled_face_counts_;  ///< for each group: number of sampled faces
  /// for each group: number of faces, including the faces of families
  std::vector<std::uint64_t> face_counts_;
  std::vector<std::string> messages_;
};

}  // namespace

std::vector<std::string> overridden_key_warnings(const YamlNode& root, const Config& config) {
  return OverriddenKeys(root, config).find();
}

}  // namespace crowdface
