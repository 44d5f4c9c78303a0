// SPDX-License-Identifier: Apache-2.0
// The key `changes` of configs and reviews, which changes single faces.
#include <algorithm>

#include "crowdface/cast/review.h"
#include "crowdface/config/config_keys.h"
#include "crowdface/config/traits_keys.h"
#include "crowdface/core/contains.h"

namespace crowdface {
namespace {

using AgeStep = FaceChange::AgeStep;

constexpr double kLargestDistanceMm = 1000;

void read_change_of_age(const YamlNode& node, FaceChange& change, ConfigDraft& draft) {
  for (const Word<AgeStep>& word : words_of<AgeStep>()) {
    if (!is_word(node, word.text)) continue;
    change.age_step = word.value;
    const bool is_older = word.value == AgeStep::kOlder;
    const SamplingOptions& sampling = *draft.config.sampling;
    if ((is_older ? sampling.heads_tagged_old : sampling.heads_tagged_young).empty() &&
        draft.are_tags_known && draft.are_heads_known) {
      draft.complaints.add_at(node, concat("no head has the tag ", is_older ? "old" : "young",
                                           "; add the tag to heads under faces.tags"));
    }
    return;
  }
  if (node.kind != YamlNode::Kind::kScalar ||
      node.text.find_first_of("0123456789") == std::string::npos) {
    draft.complaints.add_mismatch(
        node, "older, younger or a number from -1 to 1, or years, such as \"70 years\"");
  } else if (const auto own = age().read(node, draft)) {
    change.age = Age{own->range.low, own->unit};
  }
}

std::string write_change_of_age(const FaceChange& change, const WriteContext& context) {
  if (change.age_step) return std::string(word_of(*change.age_step));
  if (!change.age) return "";
  return age().write({{change.age->value, change.age->value}, change.age->unit}, context);
}

void read_wears(const YamlNode& node, FaceChange& change, ConfigDraft& draft) {
  const auto names = list(name(), "a list of attachments, [bob]").read(node, draft);
  if (!names || !draft.complaints.empty()) return;
  const std::vector<Config::Attachment>& items = draft.config.attachments.items;
  const std::vector<std::string> known =
      texts_of(items, [](const Config::Attachment& item) { return item.name; });
  std::map<std::string, std::string> by_kind;
  for (std::size_t i = 0; i < names->size(); ++i) {
    const std::string& name = (*names)[i];
    const auto item = std::ranges::find(items, name, &Config::Attachment::name);
    if (item == items.end()) {
      draft.complaints.add_at(node.items[i], concat("no attachment is called ", quoted(name),
                                                    suggestion_or_choices(name, known)));
    } else if (const auto [other, is_new] = by_kind.emplace(item->kind, name); !is_new) {
      draft.complaints.add_at(
          node.items[i], concat(name, " and ", other->second, " are both of the ", "kind ",
                                item->kind, ", of which a face wears at most one; remove one"));
    } else {
      const auto excluded = std::ranges::find_if(*names, [&](const std::string& worn) {
        return std::ranges::any_of(items, [&](const Config::Attachment& one) {
          return one.name == worn && worn != name &&
                 (contains(item->excludes, one.name) || contains(item->excludes, one.kind));
        });
      });
      if (excluded == names->end()) continue;
      draft.complaints.add_at(
          node.items[i], concat("a face cannot wear ", name, " and ", *excluded, ", because ", name,
                                " excludes ", *excluded, "; remove one"));
    }
  }
  change.attachments = *names;
}

void read_takes_off(const YamlNode& node, FaceChange& change, ConfigDraft& draft) {
  const auto words = list(name(), "a list of kinds or attachments, [beard]").read(node, draft);
  if (!words || !draft.complaints.empty()) return;
  std::vector<std::string> known;
  for (const Config::Attachment& item : draft.config.attachments.items) {
    known.push_back(item.name);
    if (!contains(known, item.kind)) known.push_back(item.kind);
  }
  for (std::size_t i = 0; i < words->size(); ++i) {
    if (contains(known, (*words)[i])) continue;
    draft.complaints.add_at(node.items[i],
                            concat("no attachment or kind is called ", quoted((*words)[i]),
                                   suggestion_or_choices((*words)[i], known)));
  }
  change.removed_attachments = *words;
}

/// Adds a complaint about each attachment that a change both puts on the face and takes off.
void check_takes_off(const FaceChange& change, const YamlNode& node, ConfigDraft& draft) {
  if (!change.attachments) return;
  for (const Config::Attachment& item : draft.config.attachments.items) {
    if (!contains(*change.attachments, item.name)) continue;
    for (const std::string& word : {item.name, item.kind}) {
      if (!contains(change.removed_attachments, word)) continue;
      draft.complaints.add_at(
          node.find("takes_off")->value,
          concat(quoted(word), " contradicts wears: [", item.name, "]; remove one of the two"));
    }
  }
}

void check_hair(const FaceChange& change, const YamlNode& node, ConfigDraft& draft) {
  const YamlEntry* hair = node.find("hair");
  if (hair == nullptr) return;
  if (!change.hair) return;
  const auto& items = draft.config.attachments.items;
  if (std::ranges::none_of(items, [](const auto& item) { return item.tint != Tint::kNone; })) {
    draft.complaints.add_at(
        hair->value,
        "requires attachments with a tint; add the key tint to items under attachments");
  }
}

Codec<std::string> hair_colour() {
  std::vector<std::string> names;
  for (const NamedHairColour& colour : named_hair_colours()) names.emplace_back(colour.name);
  return {[names](const YamlNode& node, ConfigDraft& draft) -> std::optional<std::string> {
            if (node.kind == YamlNode::Kind::kScalar && contains(names, node.text))
              return node.text;
            return draft.complaints.add_mismatch(node, concat("a hair colour: ", join(names)));
          },
          [](const std::string& name, const auto&) { return name; }, join(names)};
}

void read_variant_of(const YamlNode& node, FaceChange& change, ConfigDraft& draft) {
  const auto id = name().read(node, draft);
  if (!id) return;
  if (!is_face_id(*id, draft.config)) {
    draft.complaints.add_at(node, concat("no face of this crowd is called ", quoted(*id)));
  } else if (*id == change.id) {
    draft.complaints.add_at(node, "a face cannot be a variant of itself");
  }
  change.variant_of = *id;
}

std::string write_locked(const FaceChange& change, const WriteContext& context) {
  const std::vector<std::string> parts = context.config.region_band_names();
  return change.locked_bands.empty()
             ? ""
             : yaml_flow_list(texts_of(change.locked_bands, [&](std::size_t part) {
                 return write_scalar(parts[part]);
               }));
}

const Keys<FaceChange>& change_keys() {
  const auto known_group =
      restricted(name(), [](const std::string& name, const YamlNode& node, ConfigDraft& draft) {
        const auto& groups = draft.config.groups;
        if (std::ranges::find(groups, name, &Group::name) != groups.end()) return true;
        const auto known = texts_of(groups, [](const Group& group) { return group.name; });
        draft.complaints.add_at(
            node, concat("no group is called ", quoted(name), suggestion_or_choices(name, known)));
        return false;
      });
  static const Keys<FaceChange> keys = {
      Key<FaceChange>{"age", read_change_of_age, write_change_of_age}.with_accepted_values(
          "`older`, `younger`, number, -1 … 1, or `70 years`"),
      Key<FaceChange>{"wears", read_wears,
                      [](const FaceChange& change, const WriteContext& context) {
                        return change.attachments
                                   ? list(name(), "").write(*change.attachments, context)
                                   : "";
                      }}
          .with_accepted_values("list of attachments"),
      Key<FaceChange>{"takes_off", read_takes_off,
                      [](const FaceChange& change, const WriteContext& context) {
                        return change.removed_attachments.empty()
                                   ? ""
                                   : list(name(), "").write(change.removed_attachments, context);
                      }}
          .with_accepted_values("list of kinds or attachments"),
      key("hair", &FaceChange::hair, hair_colour()),
      colours_key(&FaceChange::colours),
      Key<FaceChange>{
          "variant_of", read_variant_of,
          [](const FaceChange& change, const auto&) { return change.variant_of.value_or(""); }}
          .with_accepted_values("id of a face"),
      key("distance", &FaceChange::variant_distance_mm, positive_length(kLargestDistanceMm))
          .written_if(
              [](const FaceChange& change, const auto&) { return change.variant_of.has_value(); }),
      key("group", &FaceChange::group, known_group),
      Key<FaceChange>{"lock",
                      [](const YamlNode& node, FaceChange& change, ConfigDraft& draft) {
                        change.locked_bands = read_locked_bands(node, draft);
                      },
                      write_locked}
          .with_accepted_values("list of regions or bands"),
      key("traits", &FaceChange::traits, trait_limits())};
  return keys;
}

/// Adds a complaint if two keys of a change contradict each other, or if a key cannot be used for
/// this face.
void check_change(const YamlEntry& entry, const FaceChange& change, ConfigDraft& draft) {
  const YamlNode& node = entry.value;
  if (node.entries.empty()) {
    draft.complaints.add_mismatch(node, concat("at least one of ", join(names_of(change_keys()))));
  }
  const auto complain = [&](std::string_view key, const std::string& what) {
    draft.complaints.add_at(node.find(key)->value, what);
  };
  if (change.variant_of) {
    for (const char* other : {"group", "lock", "traits"}) {
      if (node.find(other) != nullptr) {
        complain(other, "contradicts variant_of; a variant has the group and target of its face");
      }
    }
  } else if (node.find("distance") != nullptr) {
    complain("distance", "requires variant_of");
  }
  check_hair(change, node, draft);
  check_takes_off(change, node, draft);
  if ((change.variant_of || change.needs_redraw()) &&
      !is_sampled_face_id(change.id, draft.config)) {
    draft.complaints.add(
        entry.key_place,
        concat(quoted(entry.key),
               " is not a sampled face and can only change age, wears, takes_off and hair"));
  }
}

}  // namespace

std::vector<FaceChange> read_changes(const YamlNode& node, ConfigDraft& draft) {
  std::vector<FaceChange> changes;
  if (!draft.complaints.expect_map(
          node, "a mapping from faces to their changes, {market_0007: {age: older}}")) {
    return changes;
  }
  for (const YamlEntry& entry : node.entries) {
    FaceChange change;
    change.id = entry.key;
    if (!is_face_id(entry.key, draft.config)) {
      draft.complaints.add(entry.key_place,
                           concat("no face of this crowd is called ", quoted(entry.key)));
      continue;
    }
    if (!read_keys(entry.value, change_keys(), change, draft)) continue;
    check_change(entry, change, draft);
    changes.push_back(std::move(change));
  }
  return changes;
}

std::string write_changes(const std::vector<FaceChange>& changes, const WriteContext& context) {
  return yaml_block_map(texts_of(changes, [&](const FaceChange& change) {
    return yaml_entry(write_scalar(change.id),
                      yaml_flow_map(write_keys(change_keys(), change, context)));
  }));
}

Key<Config> changes_key() {
  return Key<Config>{"changes",
                     [](const YamlNode& node, Config& config, ConfigDraft& draft) {
                       config.changes = read_changes(node, draft);
                     },
                     [](const Config& config, const WriteContext& context) {
                       return write_changes(config.changes, context);
                     }}
      .with_nested_keys(change_keys())
      .written_if([](const Config& config, const auto&) { return !config.changes.empty(); });
}

}  // namespace crowdface
