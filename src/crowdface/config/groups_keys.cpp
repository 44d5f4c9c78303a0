// SPDX-License-Identifier: Apache-2.0
// The config section `groups`.
#include <algorithm>
#include <cmath>

#include "crowdface/config/config_keys.h"
#include "crowdface/config/starter_config.h"
#include "crowdface/config/traits_keys.h"
#include "crowdface/core/contains.h"

namespace crowdface {
namespace {

/// The value of Group::share for a group that has neither a share nor a count. These groups divide
/// the remaining faces equally.
constexpr double kUnsetShare = -1;

/// Removes from the list of old heads, and from the list of young heads, the heads for which
/// `wanted` is false. Leaves a list unchanged if no head would remain in it.
template <class Wanted>
void restrict_old_and_young_heads(SamplingOptions& sampling, const Wanted& wanted) {
  for (auto* heads : {&sampling.heads_tagged_old, &sampling.heads_tagged_young}) {
    std::vector<Eigen::Index> left = *heads;
    std::erase_if(left, [&](Eigen::Index head) { return !wanted(head); });
    if (!left.empty()) *heads = left;
  }
}

/// Reads the group's tags. Sets the group's targets and sources to the heads that have all of the
/// tags. Restricts the lists of old and young heads to heads that have all tags except age tags.
void read_group_tags(const YamlNode& node, Group& group, ConfigDraft& draft) {
  const auto tags = list(name(), "a list of tags, [old, female]").read(node, draft);
  if (!tags || tags->empty()) return;
  group.sampling.targets.clear();
  group.sampling.sources = heads_with_tags(*tags, draft.config.faces);
  for (const Eigen::Index head : group.sampling.sources)
    group.sampling.targets.push_back({head, 1});
  if (group.sampling.targets.empty() && draft.are_heads_known && draft.are_tags_known) {
    draft.complaints.add_at(
        node, concat("no head has all of these tags", known_tags(draft.config.faces)));
  }
  const auto of_any_age = heads_with_tags(remove_age_tags(*tags), draft.config.faces);
  restrict_old_and_young_heads(group.sampling,
                               [&](Eigen::Index head) { return contains(of_any_age, head); });
}

/// If a group has both `tags` and `targets`: keeps only the targets that have all of the tags, with
/// their weights. Adds a complaint about each entry of `targets` that names no head with all of the
/// tags.
void restrict_targets_to_tags(const YamlNode& node, Group& group, ConfigDraft& draft) {
  const YamlEntry *tags = node.find("tags"), *targets = node.find("targets");
  if (tags == nullptr || targets == nullptr || !draft.are_heads_known || !draft.are_tags_known)
    return;
  const std::vector<std::string> wanted =
      texts_of(tags->value.items, [](const YamlNode& item) { return item.text; });
  const std::vector<Eigen::Index> bound = heads_with_tags(wanted, draft.config.faces);
  const auto& heads = draft.config.faces.names;
  const auto check = [&](const std::string& name, const YamlPlace& place) {
    const auto head = std::ranges::find(heads, name);
    if (head != heads.end() && contains(bound, head - heads.begin())) return;
    const std::vector<Eigen::Index> called = heads_with_tags({name}, draft.config.faces);
    const auto is_bound = [&](Eigen::Index one) { return contains(bound, one); };
    // a name that is neither a head nor a tag already has a complaint
    const bool is_known = head != heads.end() || !called.empty();
    if (!is_known || std::ranges::any_of(called, is_bound)) return;
    draft.complaints.add(
        place, concat(head != heads.end() ? "" : "no head tagged ", quoted(name),
                      head != heads.end() ? " does not have" : " has", " the group's tags, ",
                      join(wanted), "; change targets or tags"));
  };
  for (const YamlEntry& entry : targets->value.entries) check(entry.key, entry.key_place);
  for (const YamlNode& item : targets->value.items) check(item.text, item.place);
  auto& own = group.sampling.targets;
  const bool had_some = !own.empty();
  std::erase_if(own, [&](const WeightedHead& target) { return !contains(bound, target.head); });
  if (had_some && own.empty()) {
    draft.complaints.add_at(targets->value, concat("no target has all of the group's tags, ",
                                                   join(wanted), "; change targets or tags"));
  }
}

/// Reads the key `without` of a group, a list of tags. From the targets and sources of the group
/// and of its bands, removes all heads that have at least one of these tags.
void read_without(const YamlNode& node, Group& group, ConfigDraft& draft) {
  const auto tags = list(name(), "a list of tags, [old, bearded]").read(node, draft);
  if (!tags) return;
  const bool known = draft.are_heads_known && draft.are_tags_known;
  SamplingOptions& sampling = group.sampling;
  const bool had_some = !sampling.targets.empty() && !sampling.sources.empty();
  for (const std::string& tag : remove_age_tags(*tags)) {
    const auto tagged = heads_with_tags({tag}, draft.config.faces);
    restrict_old_and_young_heads(sampling,
                                 [&](Eigen::Index head) { return !contains(tagged, head); });
  }
  std::vector<std::string> emptied;  // names of bands without a remaining head
  for (const std::string& tag : *tags) {
    const std::vector<Eigen::Index> tagged = heads_with_tags({tag}, draft.config.faces);
    if (known && tagged.empty()) {
      draft.complaints.add_at(
          node, concat("no head has the tag ", quoted(tag), known_tags(draft.config.faces)));
    }
    const auto is_tagged = [&](Eigen::Index head) { return contains(tagged, head); };
    std::erase_if(sampling.targets, [&](const auto& target) { return is_tagged(target.head); });
    std::erase_if(sampling.sources, is_tagged);
    for (BandSampling& band : sampling.bands) {
      if (!band.sources || std::erase_if(*band.sources, is_tagged) == 0) continue;
      if (band.sources->empty()) emptied.push_back(band.name);
    }
  }
  if (known && had_some && (sampling.targets.empty() || sampling.sources.empty())) {
    draft.complaints.add_at(node,
                            "the group has no head left, because each of its heads has one of "
                            "these tags; remove a tag");
  }
  for (const std::string& band : emptied) {
    draft.complaints.add_at(
        node,
        concat("the band ", band, " has no source left, because each of its ",
               "sources has one of these tags; set sources under bands.", band, " of the group"));
  }
}

const Keys<Group>& group_keys() {
  static const Keys<Group> keys = [] {
    constexpr std::uint64_t kMaxFaces = 1'000'000;
    const auto has_share = [](const Group& group, const auto&) {
      return !group.count && group.share != kUnsetShare;
    };
    Keys<Group> own = {
        key("name", &Group::name, name(), "such as elderly"),
        key("share", &Group::share, number(0, 1)).written_if(has_share),
        key("count", &Group::count, whole_number(0, kMaxFaces)),
        Key<Group>{"tags", read_group_tags, [](const auto&...) { return ""; }}.with_accepted_values(
            "list of tags")};
    for (const Key<SamplingOptions>& sampled : sampling_keys()) {
      own.push_back({sampled.name,
                     [read = sampled.read](const YamlNode& node, Group& group, ConfigDraft& draft) {
                       read(node, group.sampling, draft);
                     },
                     [write = sampled.write](const Group& group, const WriteContext& context) {
                       return write(group.sampling, context);
                     }});
    }
    const Codec<TraitLimits> limits = trait_limits();
    own.push_back(Key<Group>{
        "traits",
        [=](const YamlNode& node, Group& group, ConfigDraft& draft) {
          TraitLimits& all = group.sampling.traits;
          if (const auto own_limits = limits.read(node, draft)) {
            all = merge_limits(all, *own_limits);
          }
        },
        [=](const Group& group, const WriteContext& context) {
          return limits.write(group.sampling.traits, context);
        }}.with_accepted_values(limits.accepted_values));
    own.push_back(none_of_group_key());
    own.push_back(hair_colours_key(&Group::hair_colours));
    // `without` must be read after all keys that name heads, because it removes heads.
    own.push_back(
        Key<Group>{"without", read_without, [](const auto&...) { return ""; }}.with_accepted_values(
            "list of tags"));
    return own;
  }();
  return keys;
}

void check_group(const YamlNode& node, const Group& group, ConfigDraft& draft) {
  const auto& groups = draft.config.groups;
  if (std::ranges::find(groups, group.name, &Group::name) != groups.end()) {
    draft.complaints.add_at(node,
                            concat("two groups are called ", quoted(group.name), "; rename one"));
  }
  if (node.find("share") != nullptr && node.find("count") != nullptr) {
    draft.complaints.add_at(node, "expected either share or count, found both");
  }
}

/// Divides the remaining share equally among the groups that have neither a share nor a count. If
/// rounding makes the shares sum to slightly more than 1, scales them so that they sum to 1. Adds a
/// complaint if the shares sum to more, or if the counts sum to more than crowd.count.
void divide_remaining_share(const YamlNode& node, ConfigDraft& draft) {
  auto& groups = draft.config.groups;
  std::uint64_t counted = 0;
  double shared = 0, open = 0;
  std::vector<double> shares;
  for (const Group& group : groups) {
    counted += group.count.value_or(0);
    if (group.count) continue;
    (group.share == kUnsetShare ? open : shared) += group.share == kUnsetShare ? 1 : group.share;
    if (group.share != kUnsetShare) shares.push_back(group.share);
  }
  const auto factor = factor_of_rounded_shares(shares);
  if (!factor) {
    draft.complaints.add_at(node, concat("the shares sum to ", shared, ", more than 1"));
  }
  constexpr double kLargestRest = 0.02, kNoRest = 1e-9;
  if (open == 0 && shared > 1 - kLargestRest && shared < 1 - kNoRest) {
    draft.warnings.push_back(concat(node.path, ": the shares sum to ",
                                    format_number(std::round(1e6 * shared) / 1e6),
                                    ", so some faces may belong to no group; leave out the share "
                                    "of one group, which then gets all remaining faces"));
  }
  if (counted > draft.config.crowd.count) {
    draft.complaints.add_at(node, concat("the counts sum to ", counted, ", more than crowd.count, ",
                                         draft.config.crowd.count));
  }
  for (Group& group : groups) {
    if (group.share == kUnsetShare) {
      group.share = std::max(0.0, 1 - shared) / std::max(open, 1.0);
    } else {
      group.share *= factor.value_or(1);
    }
  }
}

void read_groups(const YamlNode& node, Config& config, ConfigDraft& draft) {
  draft.complaints.expect_list(node,
                               "a list of groups, [{name: elderly, share: 0.3, tags: [old]}]");
  for (const YamlNode& item : node.items) {
    Group group;
    group.share = kUnsetShare;
    group.sampling = *config.sampling;
    if (!read_keys(item, group_keys(), group, draft)) continue;
    restrict_targets_to_tags(item, group, draft);
    if (group.count) group.share = 0;
    if (!group.name.empty()) check_group(item, group, draft);
    config.groups.push_back(std::move(group));
  }
  divide_remaining_share(node, draft);
}

std::optional<StarterLines> groups_starter(const StarterFacts& facts) {
  if (head_count_of_rarer_sex(facts) == 0) return std::nullopt;
  return StarterLines{yaml_block_list({"{name: women, share: 0.5, tags: [female]}",
                                       "{name: men, share: 0.5, tags: [male]}"}),
                      "",
                      "Hair and beards depend on the tags of the target head, features on all "
                      "source heads:\nseparate groups keep women and men apart."};
}

std::string write_groups(const Config& config, const WriteContext& context) {
  return config.groups.empty() ? "" : write_sections(group_keys(), config.groups, context);
}

}  // namespace

std::size_t head_count_of_rarer_sex(const StarterFacts& facts) {
  const auto heads = [&](const std::string& tag) {
    return std::ranges::count_if(facts.tags,
                                 [&](const auto& tags) { return has_tags(tags, {tag}); });
  };
  const auto fewest = std::min(heads("female"), heads("male"));
  const bool mixes = fewest > 1;  // at least two heads, because a blend needs two
  return facts.attachments_folder.empty() || !mixes ? 0 : static_cast<std::size_t>(fewest);
}

Key<Config> groups_key() {
  Group open;
  open.share = kUnsetShare;
  return Key<Config>{"groups", read_groups, write_groups, {}, groups_starter}.with_nested_keys(
      group_keys(), open);
}

}  // namespace crowdface
