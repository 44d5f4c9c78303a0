// SPDX-License-Identifier: Apache-2.0
// The config section `attachments`.
#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "crowdface/config/config_keys.h"
#include "crowdface/config/starter_config.h"
#include "crowdface/config/yaml.h"
#include "crowdface/core/contains.h"
#include "crowdface/core/log.h"
#include "crowdface/io/mesh_format.h"

namespace crowdface {
namespace {

using Attachment = Config::Attachment;
using Attachments = Config::Attachments;

constexpr std::size_t kMaxAttachments = 1000;
constexpr double kMaxShare = 1e6;
constexpr const char* kMean = "mean";

void read_fitted_to(const YamlNode& node, Attachments& attachments, ConfigDraft& draft) {
  attachments.fitted_head.reset();
  attachments.file.clear();
  if (is_word(node, kMean)) return;
  const auto text = read_text(node, "mean, the name of a head or an OBJ file", draft.complaints);
  if (!text) return;
  if (mesh_format_of(*text) == MeshFormat::kObj) {
    attachments.file = obj_file().read(node, draft).value_or("");
  } else {
    attachments.fitted_head = find_head(*text, node.place, node.path, draft);
  }
}

std::string write_fitted_to(const Attachments& attachments, const WriteContext& context) {
  if (attachments.fitted_head) return context.head(*attachments.fitted_head);
  return attachments.file.empty() ? kMean : path("").write(attachments.file, context);
}

/// Reads the tags of an attachment. If no head has all of these tags, adds a complaint, because no
/// face could wear the attachment.
void read_item_tags(const YamlNode& node, Attachment& item, ConfigDraft& draft) {
  const auto tags = list(name(), "a list of tags, [female]").read(node, draft);
  if (!tags) return;
  item.tags = *tags;
  const bool any = !heads_with_tags(*tags, draft.config.faces).empty();
  if (!any && draft.are_heads_known && draft.are_tags_known) {
    draft.complaints.add_at(
        node, concat("no head has all of these tags, so no face would get this attachment",
                     known_tags(draft.config.faces)));
  }
}

/// Makes a key of an attachment. The value is stored in a member of the base class AttachmentItem.
template <class Member>
Key<Attachment> of_item(std::string_view name, Member AttachmentItem::*member,
                        const Codec<Member>& codec, std::string_view required = {}) {
  return key(name, static_cast<Member Attachment::*>(member), codec, required);
}

const Keys<Attachment>& item_keys() {
  const auto write_tags = [](const Attachment& item, const WriteContext&) {
    return item.tags.empty() ? "" : yaml_flow_list_of_names(item.tags);
  };
  const auto has_colour = [](const Attachment& item, const auto&) { return !item.colour.empty(); };
  const auto has_tint = [](const Attachment& item, const auto&) {
    return item.tint != Tint::kNone;
  };
  const auto has_without = [](const Attachment& item, const auto&) {
    return !item.excluded_tags.empty();
  };
  const auto excludes = [](const Attachment& item, const auto&) { return !item.excludes.empty(); };
  static const Keys<Attachment> keys = {
      of_item("name", &AttachmentItem::name, name(), "such as bob"),
      of_item("kind", &AttachmentItem::kind, name(), "such as hair, brows, beard, glasses or hat"),
      key("file", &Attachment::file, obj_file(), "an OBJ file").not_affecting_recipes(),
      Key<Attachment>{"tags", read_item_tags, write_tags}.with_accepted_values("list of tags"),
      of_item("without", &AttachmentItem::excluded_tags, list(name(), "a list of tags, [old]"))
          .written_if(has_without),
      word_key("moves", &Attachment::moves).not_affecting_recipes(),
      of_item("share", &AttachmentItem::relative_frequency, number(0, kMaxShare)),
      of_item("colour", &AttachmentItem::colour, name()).written_if(has_colour),
      of_item("tint", &AttachmentItem::tint, word<Tint>()).written_if(has_tint),
      of_item("excludes", &AttachmentItem::excludes,
              list(name(), "a list of kinds and names, [hair]"))
          .written_if(excludes)};
  return keys;
}

/// Returns whether another file of a face (a level of detail or a shape) has a file name that ends
/// with this attachment's name.
bool is_ending_taken(const std::string& name, const Config& config) {
  const bool is_level =
      name.starts_with("LOD") && name.find_first_not_of("0123456789", 3) == std::string::npos;
  return is_level || name == "shapes" || contains(config.shapes.names, name);
}

void check_item(const YamlNode& node, const Attachment& item, ConfigDraft& draft) {
  const auto& items = draft.config.attachments.items;
  if (std::ranges::find(items, item.name, &Attachment::name) != items.end()) {
    draft.complaints.add_at(
        node, concat("two attachments are called ", quoted(item.name), "; rename one"));
  } else if (is_ending_taken(item.name, draft.config)) {
    draft.complaints.add_at(node, concat("other files of a face already have the name ",
                                         quoted(item.name), "; choose another name"));
  }
}

void read_items(const YamlNode& node, Attachments& attachments, ConfigDraft& draft) {
  draft.complaints.expect_list(node,
                               "a list of attachments, [{name: bob, kind: hair, file: bob.obj}]");
  for (const YamlNode& child : node.items) {
    Attachment item;
    if (!read_keys(child, item_keys(), item, draft)) continue;
    if (!item.name.empty()) check_item(child, item, draft);
    attachments.items.push_back(std::move(item));
  }
  if (attachments.items.size() > kMaxAttachments) {
    draft.complaints.add_at(node, concat("expected at most ", kMaxAttachments,
                                         " attachments, found ", attachments.items.size()));
  }
}

std::string write_items(const Attachments& attachments, const WriteContext& context) {
  return yaml_block_list(texts_of(attachments.items, [&](const Attachment& item) {
    return yaml_flow_map(write_keys(item_keys(), item, context));
  }));
}

std::vector<std::string> kinds_of(const Attachments& attachments) {
  std::vector<std::string> kinds;
  for (const Attachment& item : attachments.items) {
    if (!contains(kinds, item.kind)) kinds.push_back(item.kind);
  }
  return kinds;
}

/// Reads the value of a key `none`: a mapping from kinds of attachments to the fraction of the
/// faces that wear no attachment of this kind.
void read_fractions_without_item(const YamlNode& node, const Attachments& attachments,
                                 std::map<std::string, double>& fractions, ConfigDraft& draft) {
  draft.complaints.expect_map(node, "a mapping from kinds to shares, {hair: 0.1}");
  const std::vector<std::string> kinds = kinds_of(attachments);
  for (const YamlEntry& entry : node.entries) {
    const auto share = number(0, 1).read(entry.value, draft);
    if (!contains(kinds, entry.key)) {
      draft.complaints.add_at(entry.value,
                              concat("no attachment is of the kind ", quoted(entry.key),
                                     suggestion_or_choices(entry.key, kinds)));
    } else if (share) {
      fractions[entry.key] = *share;
    }
  }
}

void read_none(const YamlNode& node, Attachments& attachments, ConfigDraft& draft) {
  read_fractions_without_item(node, attachments, attachments.fraction_without_item_by_kind, draft);
}

void read_none_of_group(const YamlNode& node, Group& group, ConfigDraft& draft) {
  const Attachments& attachments = draft.config.attachments;
  read_fractions_without_item(node, attachments, group.fraction_without_item_by_kind, draft);
  for (const YamlEntry& entry : node.entries) {
    if (!attachments.quotas.contains(entry.key)) continue;
    draft.complaints.add_at(entry.value, concat("attachments.quotas also sets ", entry.key,
                                                "; keep only one of the two"));
  }
}

/// Returns the first attachment whose kind, name or colour is `word`; null if there is no such
/// attachment. A quota for `word` applies to the kind of the returned attachment.
const Attachment* first_item_matching(const Attachments& attachments, const std::string& word) {
  const auto found = std::ranges::find_if(attachments.items, [&](const Attachment& item) {
    return matches_kind_name_or_colour(item, word);
  });
  return found == attachments.items.end() ? nullptr : &*found;
}

std::vector<std::string> words_of_items(const Attachments& attachments) {
  std::vector<std::string> words = kinds_of(attachments);
  for (const Attachment& item : attachments.items) {
    words.push_back(item.name);
    if (!item.colour.empty()) words.push_back(item.colour);
  }
  return words;
}

/// Scales the quotas for attachments of one kind to a sum of at most 1. The sum may be slightly
/// larger before, because users round the quotas (see factor_of_rounded_shares).
void scale_quotas(const std::string& kind, const std::vector<const YamlEntry*>& entries,
                  Attachments& attachments, ConfigDraft& draft) {
  std::vector<double> shares;
  for (const YamlEntry* entry : entries) shares.push_back(attachments.quotas[entry->key]);
  const auto factor = factor_of_rounded_shares(shares);
  if (!factor) {
    draft.complaints.add_at(entries.back()->value,
                            concat("the quotas of the kind ", kind, " add up to more than 1"));
  }
  for (const YamlEntry* entry : entries) attachments.quotas[entry->key] *= factor.value_or(1);
}

void read_item_quotas(const YamlNode& node, Attachments& attachments, ConfigDraft& draft) {
  draft.complaints.expect_map(node,
                              "a mapping from kinds, names or colours to shares, {glasses: 0.33}");
  std::map<std::string, std::vector<const YamlEntry*>> entries_by_kind;
  std::set<std::string> alone;  // kinds with a quota for the whole kind
  for (const YamlEntry& entry : node.entries) {
    const auto share = number(0, 1).read(entry.value, draft);
    if (!share) continue;
    const Attachment* item = first_item_matching(attachments, entry.key);
    if (item == nullptr) {
      draft.complaints.add_at(
          entry.value, concat("no attachment is of the kind, name or colour ", quoted(entry.key),
                              suggestion_or_choices(entry.key, words_of_items(attachments))));
      continue;
    }
    // Refuse quotas that break one of these rules:
    // - A kind with an entry in `attachments.none` has no quota for the whole kind.
    // - A kind has either one quota for the whole kind, or quotas for its items and colours.
    auto& entries = entries_by_kind[item->kind];
    const bool is_first = entries.empty();
    entries.push_back(&entry);
    if (attachments.fraction_without_item_by_kind.contains(item->kind) && entry.key == item->kind) {
      draft.complaints.add_at(entry.value, concat("attachments.none also sets ", entry.key,
                                                  "; keep only one of the two"));
    } else if (!is_first && (entry.key == item->kind || alone.contains(item->kind))) {
      draft.complaints.add_at(
          entry.value,
          concat(
              "expected one quota for the kind, or quotas for its names and colours, found both: ",
              item->kind));
    } else {
      attachments.quotas[entry.key] = *share;
    }
    if (entry.key == item->kind) alone.insert(item->kind);
  }
  for (const auto& of_kind : entries_by_kind)
    scale_quotas(of_kind.first, of_kind.second, attachments, draft);
}

/// Returns the function Key::write for a member that maps words to fractions of the crowd. For an
/// empty mapping, the function returns an empty text, so that the key is left out.
template <class Section>
auto write_shares(std::map<std::string, double> Section::*shares) {
  return [=](const Section& section, const WriteContext&) {
    const auto entries = texts_of(section.*shares, [](const auto& share) {
      return yaml_entry(write_scalar(share.first), format_number(share.second));
    });
    return entries.empty() ? "" : yaml_flow_map(entries);
  };
}

/// The keys of attachments.yaml.
const Keys<Attachments>& attachments_file_keys() {
  static const Keys<Attachments> keys = {
      Key<Attachments>{"fitted_to", read_fitted_to, write_fitted_to}
          .with_accepted_values("`mean`, head, or OBJ file")
          .not_affecting_recipes(),
      Key<Attachments>{"items", read_items, write_items}
          .with_accepted_values("list of mappings with the keys below")
          .with_nested_keys(item_keys()),
      Key<Attachments>{"none", read_none, write_shares(&Attachments::fraction_without_item_by_kind)}
          .with_accepted_values("`{kind: share}`, shares 0 … 1"),
      Key<Attachments>{"quotas", read_item_quotas, write_shares(&Attachments::quotas)}
          .with_accepted_values("`{kind, name or colour: share}`, shares 0 … 1"),
      hair_colours_key(&Attachments::hair_colours)};
  return keys;
}

/// Refuses an `excludes` entry that is not the name or kind of an attachment.
void check_excluded(const YamlNode& items, const Attachments& attachments, ConfigDraft& draft) {
  std::vector<std::string> known = kinds_of(attachments);
  for (const Attachment& item : attachments.items) known.push_back(item.name);
  for (const YamlNode& item : items.items) {
    const YamlEntry* excludes = item.find("excludes");
    if (excludes == nullptr) continue;
    for (const YamlNode& name : excludes->value.items) {
      if (contains(known, name.text)) continue;
      draft.complaints.add_at(name, concat("no attachment has the name or kind ", quoted(name.text),
                                           suggestion_or_choices(name.text, known)));
    }
  }
}

/// Returns whether at least one head may wear the attachment.
bool is_wearable(const Attachment& item, const Config::Faces& faces) {
  return std::ranges::any_of(faces.tags, [&](const std::vector<std::string>& tags) {
    return has_tags(tags, item.tags) &&
           std::ranges::none_of(item.excluded_tags,
                                [&](const std::string& tag) { return contains(tags, tag); });
  });
}

/// Removes the items that no head may wear, and everything that refers to these items.
void remove_unwearable(Attachments& attachments, const Config::Faces& faces) {
  std::erase_if(attachments.items,
                [&](const Attachment& item) { return !is_wearable(item, faces); });
  const auto is_unknown = [&](const std::string& word) {
    return first_item_matching(attachments, word) == nullptr;
  };
  const auto is_of_unknown = [&](const auto& share) { return is_unknown(share.first); };
  std::erase_if(attachments.fraction_without_item_by_kind, is_of_unknown);
  std::erase_if(attachments.quotas, is_of_unknown);
  for (Attachment& item : attachments.items) std::erase_if(item.excludes, is_unknown);
}

/// Reads the section `attachments` from the file attachments.yaml of a folder. Paths in this file
/// are relative to the folder.
void read_attachments_of_folder(const YamlNode& node, Attachments& attachments,
                                ConfigDraft& draft) {
  const auto folder = path("a folder of attachments").read(node, draft);
  if (!folder) return;
  const std::filesystem::path file = *folder / "attachments.yaml";
  if (!expect_file(node, file, draft)) return;
  draft.config.tag_and_attachment_files.push_back(file);
  const auto root = read_yaml(file.string(), draft.complaints);
  if (!root) return;
  const YamlEntry* section = root->find("attachments");
  if (section == nullptr) {
    draft.complaints.add(root->place, "expected the section attachments, found none");
    return;
  }
  const std::filesystem::path folder_of_config = std::exchange(draft.folder, *folder);
  const bool are_tags_known = std::exchange(draft.are_tags_known, false);
  read_keys(section->value, attachments_file_keys(), attachments, draft);
  if (const YamlEntry* items = section->value.find("items")) {
    check_excluded(items->value, attachments, draft);
  }
  draft.folder = folder_of_config;
  draft.are_tags_known = are_tags_known;
  if (!draft.are_heads_known || !are_tags_known) return;
  const bool any = !attachments.items.empty();
  remove_unwearable(attachments, draft.config.faces);
  if (any && attachments.items.empty()) {
    log_warning(concat(file.string(),
                       ": no head has the tags of any attachment, so faces get no attachment from "
                       "this file; give heads these tags under faces.tags"));
  }
}

const Keys<Attachments>& attachments_keys() {
  static const Keys<Attachments> keys = [] {
    // read_attachments reads the value of `from`. The value is not written, because the items are
    // written instead.
    Keys<Attachments> all = {Key<Attachments>{
        "from", [](const auto&...) {},
        [](const auto&...) {
          return "";
        }}.with_accepted_values("folder")};
    const Keys<Attachments>& more = attachments_file_keys();
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }();
  return keys;
}

/// If the config has `none` or `quotas`, the keys `none` and `quotas` of the attachments' folder
/// are ignored. Warns about the kinds of attachments that only the folder's keys mention.
///
/// \param from  the attachments as the folder specifies them.
void warn_of_ignored_quotas(const YamlNode& node, const Attachments& from, ConfigDraft& draft) {
  const Attachments& own = draft.config.attachments;
  std::set<std::string> kinds, lost;
  const auto add_kinds = [&](const std::map<std::string, double>& shares, auto& to) {
    for (const auto& share : shares) {
      if (const Attachment* item = first_item_matching(own, share.first)) to.insert(item->kind);
    }
  };
  add_kinds(own.fraction_without_item_by_kind, kinds);
  add_kinds(own.quotas, kinds);
  add_kinds(from.fraction_without_item_by_kind, lost);
  add_kinds(from.quotas, lost);
  std::erase_if(lost, [&](const std::string& kind) { return kinds.contains(kind); });
  if (lost.empty()) return;
  draft.warnings.push_back(concat(node.path,
                                  ": none and quotas of the config replace the shares of the "
                                  "attachments' folder, also for ",
                                  join(std::vector<std::string>(lost.begin(), lost.end())), " (",
                                  draft.config.crowd.count,
                                  " faces); write shares for each of these kinds"));
}

void read_attachments(const YamlNode& node, Config& config, ConfigDraft& draft) {
  if (is_word(node, "none")) return;
  if (!draft.complaints.expect_map(node, "none or a mapping with the keys from, items, none")) {
    return;
  }
  const YamlEntry *from = node.find("from"), *items = node.find("items");
  if (from == nullptr && items == nullptr) {
    draft.complaints.add_at(
        node,
        "from or items is missing; write from: FOLDER, or a list of attachments, [{name: bob, "
        "kind: hair, file: bob.obj}]");
  }
  Attachments of_folder;
  if (from != nullptr) {
    read_attachments_of_folder(from->value, config.attachments, draft);
    of_folder = config.attachments;
    if (node.find("none") != nullptr || node.find("quotas") != nullptr) {
      config.attachments.fraction_without_item_by_kind.clear();
      config.attachments.quotas.clear();
    }
  }
  read_keys(node, attachments_keys(), config.attachments, draft);
  if (node.find("none") != nullptr || node.find("quotas") != nullptr) {
    warn_of_ignored_quotas(node, of_folder, draft);
  }
  if (items != nullptr) check_excluded(items->value, config.attachments, draft);
}

std::optional<StarterLines> attachments_starter(const StarterFacts& facts) {
  if (facts.attachments_folder.empty()) return std::nullopt;
  return StarterLines{
      yaml_flow_map({yaml_entry("from", write_scalar(facts.attachments_folder.string()))}), "",
      "Hair, beards, … in the folder beside the heads; its file attachments.yaml lists them\n"
      "(docs/attachments.md)."};
}

std::string write_attachments(const Config& config, const WriteContext& context) {
  if (config.attachments.items.empty()) return "";
  return yaml_block_map(write_keys(attachments_keys(), config.attachments, context));
}

}  // namespace

Key<Group> none_of_group_key() {
  return Key<Group>{"none", read_none_of_group, write_shares(&Group::fraction_without_item_by_kind)}
      .with_accepted_values("`{kind: share}`, shares 0 … 1");
}

Key<Config> attachments_key() {
  return Key<Config>{"attachments", read_attachments, write_attachments, {}, attachments_starter}
      .with_nested_keys(attachments_keys());
}

}  // namespace crowdface
