// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/overridden_plan.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "crowdface/cast/attachment_item.h"
#include "crowdface/cast/review.h"
#include "crowdface/cast/sampling.h"
#include "crowdface/cast/typical_head.h"
#include "crowdface/core/contains.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

using AttachmentEntry = Config::Attachment;

/// The faces that one warning names, with a remark about each face.
class NamedFaces {
 public:
  void add(const std::string& id, const std::string& remark) {
    const std::string text = concat(id, " (", remark, ')');
    if (!contains(faces_, text)) faces_.push_back(text);
  }
  /// Adds a warning of the form "2 faces …: mob_0001 (…), mob_0002 (…)" if there are any faces.
  void add_warning(const char* what, std::vector<std::string>& warnings) const {
    constexpr std::size_t kMaxNamed = 8;
    if (faces_.empty()) return;
    std::vector<std::string> named = faces_;
    named.resize(std::min(named.size(), kMaxNamed));
    warnings.push_back(concat("changes: ", faces_.size(), faces_.size() == 1 ? " face" : " faces",
                              what, ": ", join(named), faces_.size() > kMaxNamed ? ", …" : ""));
  }

 private:
  std::vector<std::string> faces_;
};

bool may_wear(const AttachmentEntry& item, const std::vector<std::string>& tags) {
  const auto has = [&](const std::string& tag) { return contains(tags, tag); };
  return std::ranges::all_of(item.tags, has) && std::ranges::none_of(item.excluded_tags, has);
}

class OverriddenPlan {
 public:
  OverriddenPlan(const Config& config, const std::vector<FacePlan>& crowd)
      : config_(config), crowd_(crowd) {
    for (const FacePlan& face : crowd) faces_[face.id] = &face;
  }

  std::vector<std::string> find() {
    find_missed_quotas();
    find_missed_hair();
    for (const FaceChange& change : config_.changes) find_in(change);
    for (const Review& review : config_.review.reviews) {
      for (const FaceChange& change : review.changes) {
        find_in(change);
        find_replaced(change);
      }
    }
    not_for_head_.add_warning(" with attachments whose key tags or without excludes the head",
                              warnings_);
    without_tint_.add_warning(
        " with a hair colour that does not show, because nothing worn has a tint", warnings_);
    not_in_group_.add_warning(" on a target outside the group, because lock keeps the target",
                              warnings_);
    replaced_.add_warning(" whose changes in the config are replaced by those of a review",
                          warnings_);
    return std::move(warnings_);
  }

 private:
  std::vector<const AttachmentEntry*> attachments_of(const FacePlan& face) const {
    std::vector<const AttachmentEntry*> worn;
    for (const AttachmentEntry& item : config_.attachments.items) {
      if (contains(face.attachments, item.name)) worn.push_back(&item);
    }
    return worn;
  }

  /// Whether the face may wear any attachment whose kind, name or colour is `word`. The tags of the
  /// face's typical head (see typical_head) decide this.
  bool may_wear_any(const std::string& word, const FacePlan& face) const {
    const auto head = static_cast<std::size_t>(typical_head(face.recipe, config_.faces.tags));
    return std::ranges::any_of(config_.attachments.items, [&](const AttachmentEntry& item) {
      return matches_kind_name_or_colour(item, word) && may_wear(item, config_.faces.tags[head]);
    });
  }

  /// Finds attachments that fewer sampled faces wear than a quota requests. A changed face counts
  /// as if it wears the attachment. Groups in which no face may wear the attachment, such as women
  /// for beards, do not count if a face of another group may wear it.
  void find_missed_quotas() {
    constexpr double kRounding = 1e-9;
    for (const auto& [word, share] : config_.attachments.quotas) {
      std::map<std::string, std::uint64_t> sizes;
      std::set<std::string> groups_that_may;
      std::uint64_t served = 0, reached = 0, asked = 0;
      for (const FacePlan& face : crowd_) {
        if (!face.index) continue;
        const std::string group = face.group.value_or("");
        ++sizes[group];
        if (may_wear_any(word, face)) groups_that_may.insert(group);
        const bool wears = std::ranges::any_of(attachments_of(face),
                                               [&, &called = word](const AttachmentEntry* item) {
                                                 return matches_kind_name_or_colour(*item, called);
                                               });
        reached += wears ? 1 : 0;
        served += wears || !face.notes.changes.empty() ? 1 : 0;
      }
      for (const auto& size : sizes) {
        if (!groups_that_may.empty() && !groups_that_may.contains(size.first)) continue;
        const double faces = share * static_cast<double>(size.second);
        asked += static_cast<std::uint64_t>(std::floor(faces + kRounding));
      }
      if (served >= asked) continue;
      warnings_.push_back(concat("attachments.quotas.", word, ": ", asked,
                                 " sampled faces should wear it, ", reached,
                                 " do: tags, without and excludes take precedence"));
    }
  }

  /// Finds hair colours that fewer faces have than the config requests. Does not count changed
  /// faces.
  void find_missed_hair() {
    // The key is the name of a group. The key "" stands for faces without a group and for faces
    // whose group has no hair colours of its own.
    std::map<std::string, std::vector<const FacePlan*>> groups;
    const auto own = [&](const std::string& name) {
      return std::ranges::find_if(config_.groups, [&](const Group& group) {
        return group.name == name && !group.hair_colours.empty();
      });
    };
    for (const FacePlan& face : crowd_) {
      if (!face.hair || !face.notes.changes.empty()) continue;
      const std::string name = face.group.value_or("");
      groups[own(name) == config_.groups.end() ? "" : name].push_back(&face);
    }
    for (const auto& [name, faces] : groups) {
      const auto group = own(name);
      const bool is_own = group != config_.groups.end();
      for (const auto& [colour, share] :
           is_own ? group->hair_colours : config_.attachments.hair_colours) {
        tell_missed_hair(is_own ? concat("groups.", name) : "attachments", colour, share, faces);
      }
    }
  }

  void tell_missed_hair(const std::string& section, const std::string& name, double share,
                        const std::vector<const FacePlan*>& faces) {
    const HairColour colour = *hair_colour_named(name);
    const auto has_it = [&](const FacePlan* face) { return is_shade_of(*face->hair, colour); };
    const auto is_grey = [&](const FacePlan* face) {
      return has_it(face) && looks_grey(*face->hair) && colour.grey_fraction == 0;
    };
    constexpr double kRounding = 1e-9;
    const double asked = std::floor(share * static_cast<double>(faces.size()) + kRounding);
    const auto have = std::ranges::count_if(faces, has_it);
    const auto grey = std::ranges::count_if(faces, is_grey);
    if (static_cast<double>(have - grey) >= asked) return;
    std::string why;
    if (grey > 0) why = concat(", ", grey, " of them grey with age");
    if (static_cast<double>(have) < asked) why += ": children have a colour of their parents";
    warnings_.push_back(concat(section, ".hair_colours.", name, ": ", asked, " of ", faces.size(),
                               " faces should have it, ", have, " do", why));
  }

  void find_in(const FaceChange& change) {
    const auto found = faces_.find(change.id);
    if (found == faces_.end()) return;
    const FacePlan& face = *found->second;
    const auto worn = attachments_of(face);
    const auto head = static_cast<std::size_t>(typical_head(face.recipe, config_.faces.tags));
    for (const AttachmentEntry* item : worn) {
      if (!change.attachments || !contains(*change.attachments, item->name)) continue;
      if (may_wear(*item, config_.faces.tags[head])) continue;
      not_for_head_.add(face.id, concat(item->name, ", ", config_.faces.names[head]));
    }
    const bool has_tint = std::ranges::any_of(
        worn, [](const AttachmentEntry* item) { return item->tint != Tint::kNone; });
    if (change.hair && !has_tint) without_tint_.add(face.id, *change.hair);
    if (!change.group || face.group != change.group) return;
    const auto group = std::ranges::find(config_.groups, *change.group, &Group::name);
    if (group == config_.groups.end()) return;
    const auto& targets = group->sampling.targets;
    if (std::ranges::find(targets, face.recipe.target, &WeightedHead::head) != targets.end())
      return;
    const std::string& target = config_.faces.names[static_cast<std::size_t>(face.recipe.target)];
    not_in_group_.add(face.id, concat(target, ", ", *face.group));
  }

  /// Finds faces for which the review change `later` and the config's `changes` set the same key to
  /// different values.
  void find_replaced(const FaceChange& later) {
    for (const FaceChange& change : config_.changes) {
      if (change.id != later.id) continue;
      const auto check = [&](const char* key, const auto& own, const auto& other) {
        const std::decay_t<decltype(own)> none = {};
        if (own != none && other != none && own != other) replaced_.add(change.id, key);
      };
      const bool steps = change.age_step || change.age;
      if (steps && later.age && later.age != change.age) replaced_.add(change.id, "age");
      check("variant_of", change.variant_of, later.variant_of);
      check("group", change.group, later.group);
      check("wears", change.attachments, later.attachments);
      check("takes_off", change.removed_attachments, later.removed_attachments);
      check("hair", change.hair, later.hair);
      check("colours", change.colours, later.colours);
    }
  }

  const Config& config_;
  const std::vector<FacePlan>& crowd_;
  /// the faces of the crowd; the key is the face's id
  std::map<std::string, const FacePlan*> faces_;
  NamedFaces not_for_head_, without_tint_, not_in_group_, replaced_;
  std::vector<std::string> warnings_;
};

}  // namespace

std::vector<std::string> overridden_plan_warnings(const Config& config,
                                                  const std::vector<FacePlan>& crowd) {
  return OverriddenPlan(config, crowd).find();
}

}  // namespace crowdface
