// SPDX-License-Identifier: Apache-2.0
// The config section `families`.
#include <algorithm>
#include <cmath>

#include "crowdface/cast/face_ids.h"
#include "crowdface/cast/family.h"
#include "crowdface/config/config_keys.h"
#include "crowdface/config/traits_keys.h"
#include "crowdface/core/contains.h"
#include "crowdface/core/random.h"

namespace crowdface {
namespace {

constexpr std::uint64_t kMaxMembers = 1000;

/// Returns whether casting makes a face with this id for an earlier family of the config: a member
/// of the family, or a parent that does not exist yet (Parent::is_new). The id may lack the crowd's
/// name and the underscore at its start.
bool is_face_of_family(const std::string& id, const Config& config) {
  return std::ranges::any_of(config.families, [&](const FamilyOptions& family) {
    const std::vector<std::string> ids = face_ids_of_family(family, config.crowd.name);
    return contains(ids, id) || contains(ids, concat(config.crowd.name, '_', id));
  });
}

Codec<std::size_t> group() {
  return {[](const YamlNode& node, ConfigDraft& draft) -> std::optional<std::size_t> {
            const auto name = read_name(node, draft.complaints);
            if (!name) return std::nullopt;
            const auto& groups = draft.config.groups;
            const auto found = std::ranges::find(groups, *name, &Group::name);
            if (found != groups.end()) return static_cast<std::size_t>(found - groups.begin());
            draft.complaints.add_at(
                node, concat("no group is called ", quoted(*name),
                             suggestion_or_choices(*name, texts_of(groups, [](const Group& group) {
                               return group.name;
                             }))));
            return std::nullopt;
          },
          [](std::size_t index, const WriteContext& context) {
            return write_scalar(context.config.groups[index].name);
          },
          "name of a [group](#groups)"};
}

/// Reads a parent of a family.
///
/// \param role  "mother" or "father". The id of a parent that casting makes ends with this word.
std::optional<Parent> read_parent(const YamlNode& node, std::string_view role,
                                  const FamilyOptions& family, ConfigDraft& draft) {
  Parent drawn{std::nullopt, concat(family.name, '_', role), true};
  if (node.kind == YamlNode::Kind::kMap) {
    static const Keys<Parent> keys = {
        key("group", &Parent::group, group(), "write the group from which the parent is drawn")};
    read_keys(node, keys, drawn, draft);
    return drawn;
  }
  const auto name = read_name(node, draft.complaints);
  if (!name) return std::nullopt;
  if (*name == "drawn") {
    // If there are heads with the tag `female` (for a mother) or `male` (for a father), the new
    // parent's target is one of these heads.
    drawn.possible_target_heads =
        heads_with_tags({role == word_of(0) ? "female" : "male"}, draft.config.faces);
    return drawn;
  }
  const auto& heads = draft.config.faces.names;
  const auto head = std::ranges::find(heads, *name);
  if (head != heads.end()) return Parent{head - heads.begin(), *name};
  const auto& recipes = draft.config.recipes;
  const bool known = std::ranges::find(recipes, *name, &ManualRecipe::id) != recipes.end() ||
                     is_face_of_family(*name, draft.config);
  const auto& groups = draft.config.groups;
  if (std::ranges::find(groups, *name, &Group::name) != groups.end() && !known) {
    draft.complaints.add_at(node, concat(quoted(*name), " is a group; write {group: ", *name, '}'));
  } else if (!known && draft.are_heads_known) {
    draft.complaints.add_at(node, concat("expected drawn, a head, a recipe's id or a member of ",
                                         "an earlier family (smith_01), found ", quoted(*name)));
  }
  return Parent{std::nullopt, *name};
}

/// Returns the parent with this role (mother or father) for a family whose config names only the
/// other parent. The returned parent is a random head, not a new face of the crowd. The head is
/// tagged female for a mother and male for a father, if any head has this tag. The choice depends
/// only on the named parent `other`, so two families that name the same single parent get the same
/// second parent.
std::optional<Parent> absent_parent(std::string_view role, const Parent& other,
                                    const ConfigDraft& draft) {
  const Config::Faces& faces = draft.config.faces;
  std::vector<Eigen::Index> heads =
      heads_with_tags({role == word_of(0) ? "female" : "male"}, faces);
  if (heads.empty()) {
    for (std::size_t h = 0; h < faces.names.size(); ++h)
      heads.push_back(static_cast<Eigen::Index>(h));
  }
  if (heads.size() > 1) std::erase(heads, other.head.value_or(-1));
  if (heads.empty())
    return std::nullopt;  // the list of heads is invalid and already has a complaint
  const Config::Crowd& crowd = draft.config.crowd;
  std::string person = other.id;
  if (person.starts_with(crowd.name + '_')) person.erase(0, crowd.name.size() + 1);
  const double drawn = random_uniform({crowd.seed, 0, concat("absent parent/", person)});
  const auto at = static_cast<std::size_t>(drawn * static_cast<double>(heads.size()));
  const Eigen::Index head = heads[std::min(at, heads.size() - 1)];
  return Parent{head, faces.names[static_cast<std::size_t>(head)]};
}

void read_parents(const YamlNode& node, FamilyOptions& family, ConfigDraft& draft) {
  const MapReader map(node, {std::string(word_of(0)), std::string(word_of(1))}, draft.complaints);
  const YamlNode *mother = map.find(word_of(0)), *father = map.find(word_of(1));
  if (node.kind == YamlNode::Kind::kMap && node.entries.empty()) {
    draft.complaints.add_mismatch(node, "at least one of mother and father");
  }
  auto first = mother ? read_parent(*mother, word_of(0), family, draft) : std::nullopt;
  auto second = father ? read_parent(*father, word_of(1), family, draft) : std::nullopt;
  if (mother == nullptr && second) first = absent_parent(word_of(0), *second, draft);
  if (father == nullptr && first) second = absent_parent(word_of(1), *first, draft);
  if (first && second) family.parents = {*first, *second};
}

std::string write_parent(const Parent& parent, const WriteContext& context) {
  if (!parent.is_new) return write_scalar(parent.id);
  return parent.group ? yaml_flow_map({yaml_entry("group", group().write(*parent.group, context))})
                      : "drawn";
}

std::string write_parents(const FamilyOptions& family, const WriteContext& context) {
  if (family.parents.empty()) return "";
  return yaml_flow_map({yaml_entry(word_of(0), write_parent(family.parents[0], context)),
                        yaml_entry(word_of(1), write_parent(family.parents[1], context))});
}

void read_inherit(const YamlNode& node, FamilyOptions& family, ConfigDraft& draft) {
  if (node.kind == YamlNode::Kind::kMap && family.parents.empty()) {
    draft.complaints.add_at(node, "expected inherit only in a family with parents; add parents");
  }
  if (!draft.are_regions_known && node.kind == YamlNode::Kind::kMap) return;
  // Read the names in this order, because later names override earlier names: the name of a band
  // overrides the names of regions, and a name such as "top/skin" overrides both.
  std::vector<std::string> names = draft.config.region_names();
  for (const std::string& more : draft.config.plan_names().bands) names.push_back(more);
  for (const std::string& part : draft.config.region_band_names()) {
    if (!draft.config.sampling->bands.empty()) names.push_back(part);
  }
  const MapReader map(node, names, draft.complaints);
  for (const std::string& name : names) {
    const YamlNode* from = map.find(name);
    if (from == nullptr) continue;
    const int parent = word<int>().read(*from, draft).value_or(-1);
    for (const std::size_t part : find_region_bands(name, draft.config))
      family.parent_of_band[part] = parent;
  }
}

std::string write_inherit(const FamilyOptions& family, const WriteContext& context) {
  if (family.parents.empty()) return "";
  const std::vector<std::string> names = context.config.region_band_names();
  std::vector<std::string> entries;
  for (std::size_t part = 0; part < names.size(); ++part) {
    entries.push_back(
        yaml_entry(write_scalar(names[part]), std::string(word_of(family.parent_of_band[part]))));
  }
  return yaml_flow_map(entries);
}

void check_name(const YamlNode& node, const FamilyOptions& family, ConfigDraft& draft) {
  const auto& families = draft.config.families;
  if (std::ranges::find(families, family.name, &FamilyOptions::name) != families.end()) {
    draft.complaints.add_at(
        node, concat("two families are called ", quoted(family.name), "; rename one"));
  }
  if (family.name.find_first_not_of("0123456789") == std::string::npos) {
    draft.complaints.add_at(node,
                            "expected a family name with a letter; with digits only, the members "
                            "would have the ids of sampled faces");
  }
}

void refuse_taken_ids(const YamlNode& node, const FamilyOptions& family, ConfigDraft& draft) {
  const auto& recipes = draft.config.recipes;
  for (const std::string& id : face_ids_of_family(family, draft.config.crowd.name)) {
    if (std::ranges::find(recipes, id, &ManualRecipe::id) == recipes.end()) continue;
    draft.complaints.add_at(
        node, concat("the recipe ", quoted(id),
                     " has the id of a member of this family; rename the recipe or the family"));
  }
}

const Keys<FamilyOptions>& family_keys() {
  using Family = FamilyOptions;
  static const Keys<Family> keys = {
      key("name", &Family::name, name(), "such as smith"),
      key("members", &Family::member_count, whole_number(1, kMaxMembers),
          "write the number of faces"),
      key("group", &Family::group, group()),
      key("target", &Family::target, head()),
      Key<Family>{"parents", read_parents, write_parents}.with_accepted_values(
          "`{mother: …, father: …}`"),
      Key<Family>{"inherit", read_inherit, write_inherit}.with_accepted_values(
          "`{region or band: mother, father or drawn}`"),
      key("max_distance", &Family::max_distance_mm, positive_length(kMaxDistanceMm)),
      key("min_distance", &Family::min_distance_mm, length(kMaxDistanceMm)),
      word_key("twins", &Family::are_twins).written_if([](const Family& family, const auto&) {
        return family.are_twins;
      }),
      key("age", &Family::age, age()),
      key("traits", &Family::traits, trait_limits())};
  return keys;
}

void read_families(const YamlNode& node, Config& config, ConfigDraft& draft) {
  draft.complaints.expect_list(node, "a list of families, [{name: smith, members: 6, …}]");
  for (const YamlNode& item : node.items) {
    FamilyOptions family;
    family.parent_of_band.assign(config.region_band_names().size(), -1);
    if (!read_keys(item, family_keys(), family, draft)) continue;
    if (!family.name.empty()) check_name(item.find("name")->value, family, draft);
    constexpr double kTwinsMm = 0.1, kChildren = 0.4;
    if (item.find("min_distance") == nullptr && !family.parents.empty()) {
      family.min_distance_mm =
          std::min(family.are_twins ? kTwinsMm : HUGE_VAL, kChildren * family.max_distance_mm);
    }
    if (family.max_distance_mm > 0 && family.min_distance_mm > 2 * family.max_distance_mm) {
      draft.complaints.add_at(item.find("min_distance")->value,
                              "expected at most twice max_distance, because all members are within "
                              "max_distance of one founder");
    }
    refuse_taken_ids(item, family, draft);
    config.families.push_back(std::move(family));
  }
}

std::string write_families(const Config& config, const WriteContext& context) {
  return write_sections(family_keys(), config.families, context);
}

}  // namespace

std::vector<std::string> face_ids_of_family(const FamilyOptions& family, const std::string& crowd) {
  std::vector<std::string> ids;
  for (int m = 1; m <= family.member_count; ++m) ids.push_back(member_id(crowd, family.name, m));
  for (const Parent& parent : family.parents) {
    if (parent.is_new) ids.push_back(parent_id(crowd, parent));
  }
  return ids;
}

Key<Config> families_key() {
  return Key<Config>{"families", read_families, write_families}.with_nested_keys(family_keys());
}

}  // namespace crowdface
