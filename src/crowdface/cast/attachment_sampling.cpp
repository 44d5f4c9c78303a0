// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/attachment_sampling.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "crowdface/cast/hair_chooser.h"
#include "crowdface/cast/sampling.h"
#include "crowdface/cast/shares.h"
#include "crowdface/core/contains.h"
#include "crowdface/core/random.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

using Items = std::vector<const AttachmentItem*>;

template <class Wanted>
Items matching_items(const Items& items, const Wanted& wanted) {
  Items found = items;
  std::erase_if(found, [&](const AttachmentItem* item) { return !wanted(*item); });
  return found;
}

/// Removes all items that do not match, unless no item matches.
///
/// \return  Whether any item matches.
template <class Wanted>
bool keep_matching(Items& items, const Wanted& wanted) {
  Items found = matching_items(items, wanted);
  if (found.empty()) return false;
  items = std::move(found);
  return true;
}

/// Returns whether a tag describes a colour: "brown" and "brown_hair" describe brown.
bool names_colour(const std::string& tag, const std::string& colour) {
  return !colour.empty() && (tag == colour || tag.starts_with(colour + '_'));
}

/// Maps the name of each item to the number of faces that wear the item.
using WearerCounts = std::map<std::string, int>;

/// Removes the items that already have their share. An item with share s (relative to the sum of
/// all shares in `items`) stays if fewer than s·(n + 1) faces wear this item, where n is the number
/// of faces that wear any of `items`. At least one item stays.
void keep_underused(const WearerCounts& counts, Items& items) {
  constexpr double kRounding = 1e-9;
  const auto given = [&](const AttachmentItem* item) {
    const auto found = counts.find(item->name);
    return found == counts.end() ? 0 : found->second;
  };
  double shares = 0, faces = 1;
  for (const AttachmentItem* item : items) {
    shares += item->relative_frequency;
    faces += given(item);
  }
  std::erase_if(items, [&](const AttachmentItem* item) {
    return faces * item->relative_frequency / shares - given(item) < kRounding;
  });
}

/// Keeps only the items that the fewest faces wear so far, relative to each item's share.
void keep_least_worn(const WearerCounts& counts, Items& items) {
  const auto level = [&](const AttachmentItem* item) {
    const auto found = counts.find(item->name);
    return found == counts.end() ? 0.0 : found->second / item->relative_frequency;
  };
  double least = HUGE_VAL;
  for (const AttachmentItem* item : items) least = std::min(least, level(item));
  std::erase_if(items, [&](const AttachmentItem* item) { return level(item) > least; });
}

/// The attachments of a face, and the face's hair colour if the face may wear items with a tint.
struct ChosenAttachments {
  std::vector<std::string> names;
  std::optional<HairColour> hair;
};

/// The quotas for items of one kind and, for each quota, the faces that the quota applies to.
struct KindQuotas {
  std::vector<std::string> words;
  std::vector<double> shares;
  /// Maps the index of each group to one entry per sampled face of the group. The entry is the
  /// index of the quota that applies to this face, or −1 if no quota applies.
  std::map<int, std::vector<int>> schedules;

  bool of_kind(const std::string& kind) const { return contains(words, kind); }
};

class AttachmentChooser {
 public:
  /// \param crowd     all faces, in the order of the plan.
  /// \param sequence  faces in an order in which no face may look like the previous or the next
  ///                  face (see must_differ); may be empty.
  AttachmentChooser(const AttachmentOptions& options, const std::vector<int>& groups,
                    const std::vector<FacePlan>& crowd, const std::vector<FacePlan>& sequence)
      : options_(options) {
    for (const AttachmentItem& item : options.items) {
      if (!contains(kinds_, item.kind)) kinds_.push_back(item.kind);
    }
    for (const int group : groups) group_indices_.emplace_back(group, group_sizes_[group]++);
    for (const auto& quota : options.quotas) {
      const std::string& word = quota.first;
      const auto first =
          std::find_if(options.items.begin(), options.items.end(),
                       [&](const auto& item) { return matches_kind_name_or_colour(item, word); });
      if (first == options.items.end()) continue;
      quotas_[first->kind].words.push_back(word);
      quotas_[first->kind].shares.push_back(quota.second);
    }
    if (std::ranges::any_of(options.items,
                            [](const auto& item) { return item.tint != Tint::kNone; })) {
      hair_.emplace(HairOptions{options.seed, options.tags, options.head_names,
                                options.hair_colours, options.twin_families},
                    crowd);
      for (std::size_t i = 1; i < sequence.size(); ++i) {
        if (must_differ(sequence[i - 1], sequence[i])) {
          neighbours_[sequence[i].id].push_back(sequence[i - 1].id);
          neighbours_[sequence[i - 1].id].push_back(sequence[i].id);
        }
      }
      for (const FacePlan& face : sequence) {
        if (face.index) sampled_ids_.insert(face.id);
      }
    }
    for (auto& [kind, quotas] : quotas_) {
      for (const auto& [group, faces] : group_sizes_) {
        quotas.schedules[group] = schedule_shares_randomly(
            quotas.shares, faces, options.seed, concat("attachment quotas/", kind, '/', group));
      }
    }
  }

  ChosenAttachments choose(const FacePlan& face) {
    heads_[face.id] = typical_head(face.recipe, options_.tags);
    std::optional<HairColour> hair;
    if (hair_) hair = hairs_[face.id] = hair_->colour_of(face, heads_[face.id]);
    Items placed;
    for (const std::string& kind : kinds_) {
      const AttachmentItem* one = draw_one(kind, face, placed);
      if (one == nullptr) continue;
      placed.push_back(one);
      ++wearer_counts_[similar_faces_key(face)][one->name];
      if (face.index) ++all_wearer_counts_[one->name];
    }
    std::vector<std::string> names = without_excluded(placed);
    placed_[face.id] =
        matching_items(placed, [&](const auto& item) { return contains(names, item.name); });
    if (face.family) {
      for (const AttachmentItem* item : placed_[face.id]) {
        if (!item->colour.empty())
          family_colours_.try_emplace({*face.family, item->kind}, item->colour);
      }
    }
    return {std::move(names), hair};
  }

 private:
  const std::vector<std::string>& tags_of(Index head) const {
    return options_.tags[static_cast<std::size_t>(head)];
  }

  /// Returns the items of a kind that a head's tags allow.
  ///
  /// \param colour  A colour that the face inherits. An item of this colour is allowed even if the
  ///                head lacks the tag that names this colour.
  Items wearable_items(const std::string& kind, Index head, const std::string& colour = {}) const {
    const std::vector<std::string>& tags = tags_of(head);
    Items items;
    for (const AttachmentItem& item : options_.items) {
      const bool may = std::all_of(item.tags.begin(), item.tags.end(), [&](const std::string& tag) {
        return contains(tags, tag) || (item.colour == colour && names_colour(tag, colour));
      });
      const bool must_not = std::ranges::any_of(
          item.excluded_tags, [&](const std::string& tag) { return contains(tags, tag); });
      if (item.kind == kind && item.relative_frequency > 0 && may && !must_not)
        items.push_back(&item);
    }
    return items;
  }

  const AttachmentItem* draw_one(const std::string& kind, const FacePlan& face,
                                 const Items& placed) const {
    Items items = wearable_items(kind, heads_.at(face.id));
    if (items.empty()) return nullptr;
    const std::string purpose =
        face.index ? concat("attachment/", kind) : concat("attachment/", kind, '/', face.id);
    const auto drawn = random_pair({options_.seed, face.index.value_or(0), purpose});
    if (!apply_quotas(kind, face, drawn[0], items)) return nullptr;
    match_colours(kind, face, placed, items);
    while (!items.empty()) {
      const AttachmentItem* chosen = choose_from(items, face, drawn[1]);
      if (!options_.covers_eyes || !options_.covers_eyes(chosen->name, face)) return chosen;
      std::erase(items, chosen);
    }
    return nullptr;
  }

  /// Chooses one of the items that suit a face.
  const AttachmentItem* choose_from(Items items, const FacePlan& face, double drawn) const {
    if (items[0]->tint == Tint::kNone) return random_underused_item(items, face, drawn);
    avoid_neighbours(face, items);
    if (face.index) {
      keep_least_worn(all_wearer_counts_, items);
    } else if (const auto own = wearer_counts_.find(similar_faces_key(face));
               own != wearer_counts_.end()) {
      keep_least_worn(own->second, items);
    }
    return weighted_choice(items, drawn, &AttachmentItem::relative_frequency);
  }

  /// Returns whether two successive faces must not look alike: both are sampled, both are members
  /// of the same family, or both are hand-written. A sampled face must differ only from sampled
  /// faces. Otherwise the attachments of all other faces could change when a larger crowd gets more
  /// sampled faces.
  static bool must_differ(const FacePlan& first, const FacePlan& second) {
    return first.index ? second.index.has_value() : !second.index && first.family == second.family;
  }

  /// Removes items that the previous face or the next face wears in a similar hair colour, unless
  /// this removes all items. For a sampled face, does the same for the most similar earlier face if
  /// this face is sampled, too.
  void avoid_neighbours(const FacePlan& face, Items& items) const {
    std::vector<std::string> neighbours;
    if (const auto found = neighbours_.find(face.id); found != neighbours_.end())
      neighbours = found->second;
    if (face.index && face.notes.nearest && face.notes.nearest->earlier_face) {
      const std::string& similar = *face.notes.nearest->earlier_face;
      if (sampled_ids_.contains(similar)) neighbours.push_back(similar);
    }
    keep_matching(items, [&](const AttachmentItem& item) {
      return std::ranges::none_of(neighbours, [&](const std::string& other) {
        const auto placed = placed_.find(other);
        return placed != placed_.end() && contains(placed->second, &item) &&
               are_alike(hairs_.at(other), hairs_.at(face.id));
      });
    });
  }

  /// Returns the key of the set of similar faces that contains a face: all sampled faces with the
  /// same typical head, all members of one family, or one hand-written face alone.
  std::string similar_faces_key(const FacePlan& face) const {
    if (face.index) return concat("head/", heads_.at(face.id));
    return face.family ? concat("family/", *face.family) : concat("face/", face.id);
  }

  /// Chooses an item at random, with probabilities proportional to the items' shares. First
  /// excludes the items that have reached their share among similar faces. If `face` is a sampled
  /// face, then also excludes the items that have reached their share among all sampled faces.
  const AttachmentItem* random_underused_item(const Items& items, const FacePlan& face,
                                              double drawn) const {
    Items next = items;
    if (const auto own = wearer_counts_.find(similar_faces_key(face)); own != wearer_counts_.end())
      keep_underused(own->second, next);
    if (face.index) keep_underused(all_wearer_counts_, next);
    return weighted_choice(next, drawn, &AttachmentItem::relative_frequency);
  }

  /// Applies the quotas of one kind of items to a face. A quota is the fraction of faces that wear
  /// the items that the quota names. Removes from `items` the items that the face must not wear:
  ///
  /// - If a quota selects a sampled face, the face keeps only the items that this quota names. If
  ///   `items` contains no such item, the face is treated like a face that no quota selects.
  /// - If no quota selects a sampled face, the face keeps only the items that no quota names.
  /// - A face that is not sampled keeps all items. A quota of the whole kind is the probability
  ///   that this face wears an item; other quotas are ignored.
  ///
  /// \param items  the items of the kind that the face's tags allow.
  /// \param drawn  random number from 0 to 1.
  ///
  /// \return  Whether the face wears an item of the kind.
  bool apply_quotas(const std::string& kind, const FacePlan& face, double drawn,
                    Items& items) const {
    const bool bare = drawn < fraction_without_item(kind, face.group.value_or(""));
    const auto found = quotas_.find(kind);
    if (found == quotas_.end()) return !bare;
    const KindQuotas& quotas = found->second;
    if (!face.index) return quotas.of_kind(kind) ? drawn < quotas.shares[0] : !bare;
    const int asked = asked_at(*face.index, quotas);
    if (quotas.of_kind(kind)) return asked >= 0;
    if (asked >= 0) {
      const std::string& word = quotas.words[static_cast<std::size_t>(asked)];
      if (keep_matching(items,
                        [&](const auto& item) { return matches_kind_name_or_colour(item, word); }))
        return true;
    }
    keep_matching(items, [&](const AttachmentItem& item) {
      return std::none_of(quotas.words.begin(), quotas.words.end(), [&](const std::string& word) {
        return matches_kind_name_or_colour(item, word);
      });
    });
    return !bare;
  }

  /// Returns the fraction of a group's faces that wear no item of a kind.
  double fraction_without_item(const std::string& kind, const std::string& group) const {
    const auto of_group = options_.fractions_without_item.find(group);
    if (of_group != options_.fractions_without_item.end()) {
      const auto fraction = of_group->second.find(kind);
      if (fraction != of_group->second.end()) return fraction->second;
    }
    return group.empty() ? 0 : fraction_without_item(kind, "");
  }

  int asked_at(std::uint64_t index, const KindQuotas& quotas) const {
    if (index > group_indices_.size()) return -1;
    const auto& [group, place] = group_indices_[index - 1];
    return quotas.schedules.at(group)[place];
  }

  /// Keeps only the items whose colour equals the colour of an item that the face already wears. If
  /// there are none, keeps only the items whose colour equals the colour of a parent's items
  /// (without parents: of the family's items). If there are none either, keeps all items.
  void match_colours(const std::string& kind, const FacePlan& face, const Items& placed,
                     Items& items) const {
    const auto keep_colour = [&](const std::string& colour) {
      return !colour.empty() && keep_matching(items, [&](const AttachmentItem& item) {
        return item.colour == colour;
      });
    };
    if (std::any_of(placed.begin(), placed.end(),
                    [&](const auto* item) { return keep_colour(item->colour); }))
      return;
    if (face.parents.empty()) {
      const auto found =
          face.family ? family_colours_.find({*face.family, kind}) : family_colours_.end();
      if (found != family_colours_.end()) keep_colour(found->second);
      return;
    }
    const Index head = heads_.at(face.id);
    std::vector<std::string> parents = face.parents;
    const std::string purpose = concat("attachment/", kind, "/parent/", face.id);
    if (random_uniform({options_.seed, 0, purpose}) < 0.5)
      std::reverse(parents.begin(), parents.end());
    for (const std::string& parent : parents) {
      const std::string colour = colour_of(kind, parent);
      if (!contains(tags_of(head), "old") && is_only_for_old_faces(kind, colour)) continue;
      if (keep_colour(colour)) return;
      Items others = matching_items(wearable_items(kind, head, colour),
                                    [&](const auto& item) { return item.colour == colour; });
      if (colour.empty() || others.empty()) continue;
      items = std::move(others);
      return;
    }
  }

  /// Returns the head whose tags apply to a parent of a face. If the parent is a head, this is the
  /// parent itself; if the parent is a face, the face's typical head. Returns −1 if the parent is
  /// neither a head nor a face that `choose` has handled.
  Index head_of(const std::string& parent) const {
    const auto face = heads_.find(parent);
    if (face != heads_.end()) return face->second;
    const auto head = std::find(options_.head_names.begin(), options_.head_names.end(), parent);
    return head == options_.head_names.end() ? -1 : head - options_.head_names.begin();
  }

  /// Returns whether only old faces may wear items of this kind in this colour, such as grey hair.
  bool is_only_for_old_faces(const std::string& kind, const std::string& colour) const {
    for (std::size_t head = 0; head < options_.tags.size(); ++head) {
      if (contains(options_.tags[head], "old")) continue;
      const Items items = wearable_items(kind, static_cast<Index>(head));
      if (std::any_of(items.begin(), items.end(),
                      [&](const auto* item) { return item->colour == colour; })) {
        return false;
      }
    }
    return true;
  }

  /// Returns the colour of the item of this kind that a parent wears. If the parent wears no such
  /// item, but all items that the parent may wear have the same colour, returns this colour.
  std::string colour_of(const std::string& kind, const std::string& parent) const {
    if (const auto found = placed_.find(parent); found != placed_.end()) {
      const Items own =
          matching_items(found->second, [&](const auto& item) { return item.kind == kind; });
      if (!own.empty()) return own[0]->colour;
    }
    const Index head = head_of(parent);
    if (head < 0) return {};
    const Items items = wearable_items(kind, head);
    const bool one = std::all_of(items.begin(), items.end(), [&](const auto* item) {
      return item->colour == items[0]->colour;
    });
    return one && !items.empty() ? items[0]->colour : std::string();
  }

  /// Goes through the items in order. Each item that is still in the list removes the items that it
  /// excludes. Returns the names of the remaining items in the same order.
  std::vector<std::string> without_excluded(const Items& placed) const {
    std::vector<bool> left(options_.items.size(), false);
    for (const AttachmentItem* item : placed) {
      left[static_cast<std::size_t>(item - options_.items.data())] = true;
    }
    for (std::size_t i = 0; i < left.size(); ++i) {
      if (!left[i]) continue;
      for (std::size_t j = 0; j < left.size(); ++j) {
        const std::vector<std::string>& excluded = options_.items[i].excludes;
        const bool taken = contains(excluded, options_.items[j].name) ||
                           contains(excluded, options_.items[j].kind);
        if (i != j && taken) left[j] = false;
      }
    }
    std::vector<std::string> names;
    for (std::size_t i = 0; i < left.size(); ++i) {
      if (left[i]) names.push_back(options_.items[i].name);
    }
    return names;
  }

  const AttachmentOptions& options_;
  /// kinds of attachments, in the order of the first item of each kind
  std::vector<std::string> kinds_;
  std::map<std::string, KindQuotas> quotas_;
  /// for each sampled face: the face's group, and the face's index within the group
  std::vector<std::pair<int, std::uint64_t>> group_indices_;
  std::map<int, std::uint64_t> group_sizes_;  ///< number of sampled faces in each group
  /// maps the id of a face to the attachments that have been chosen for this face
  std::map<std::string, Items> placed_;
  /// maps the id of a face to the face's typical head, whose tags apply to the face
  std::map<std::string, Index> heads_;
  /// Maps a family's name and a kind of items to the colour of the items of this kind that the
  /// family wears.
  std::map<std::pair<std::string, std::string>, std::string> family_colours_;
  /// Maps the key of a set of similar faces (see similar_faces_key) to the number of faces of this
  /// set that wear each item.
  std::map<std::string, WearerCounts> wearer_counts_;
  WearerCounts all_wearer_counts_;  ///< how many of all sampled faces wear each item
  /// chooses the faces' hair colours; empty if no item has a tint
  std::optional<HairChooser> hair_;
  std::map<std::string, HairColour> hairs_;  ///< maps the id of a face to its hair colour
  /// Maps the id of a face to the ids of the previous and of the next face, if must_differ holds
  /// for the two faces.
  std::map<std::string, std::vector<std::string>> neighbours_;
  std::set<std::string> sampled_ids_;  ///< ids of the sampled faces of the sequence
};

}  // namespace

void choose_attachments(const AttachmentOptions& options, const std::vector<int>& groups,
                        std::vector<FacePlan>& crowd, const std::vector<FacePlan>& rejected,
                        const std::vector<std::size_t>& crowd_size_at_rejection) {
  AttachmentChooser drawing(options, groups, crowd, crowd);
  const auto set_attachments = [](FacePlan& face, ChosenAttachments drawn) {
    face.attachments = std::move(drawn.names);
    face.hair = drawn.hair;
  };
  // Maps the id of a redrawn face to all versions of this face: the rejected versions in order,
  // then the final version.
  std::map<std::string, std::vector<const FacePlan*>> versions_by_id;
  for (const FacePlan& face : rejected) {
    if (face.index) versions_by_id[face.id].push_back(&face);
  }
  for (FacePlan& face : crowd) {
    const auto found = versions_by_id.find(face.id);
    if (found != versions_by_id.end()) found->second.push_back(&face);
  }
  std::map<std::string, FacePlan*> redrawn;
  // By id of a face: the version of this face to which attachments were most recently assigned, as
  // an index into `versions_by_id[id]`
  std::map<std::string, std::size_t> version_indices;
  std::size_t next = 0;
  // Goes on through `rejected`, the rejected faces in the order of rejection, and chooses
  // attachments for the face that replaced each rejected face. Stops before the first rejection
  // that happened when the crowd had more than `size` faces. Called when the first `size` faces of
  // the crowd have their attachments.
  const auto replace_up_to = [&](std::size_t size) {
    for (; next < rejected.size(); ++next) {
      if (!crowd_size_at_rejection.empty() && crowd_size_at_rejection[next] > size) return;
      const std::string& id = rejected[next].id;
      if (!redrawn.contains(id)) continue;
      set_attachments(*redrawn[id], drawing.choose(*versions_by_id[id][++version_indices[id]]));
    }
  };
  // First choose attachments for the original version of each face, so that a redraw does not
  // change the choices for other faces of the reviewed crowd.
  for (std::size_t i = 0; i < crowd.size(); ++i) {
    if (!crowd_size_at_rejection.empty()) replace_up_to(i);
    FacePlan& face = crowd[i];
    const auto found = versions_by_id.find(face.id);
    if (found == versions_by_id.end()) {
      set_attachments(face, drawing.choose(face));
      continue;
    }
    drawing.choose(*found->second.front());
    redrawn[face.id] = &face;
  }
  replace_up_to(crowd.size());
}

void choose_attachments_of_changed_face(const AttachmentOptions& options,
                                        const std::vector<int>& groups,
                                        const std::vector<FacePlan>& crowd, FacePlan& face) {
  AttachmentChooser drawing(options, groups, crowd, {});
  for (const FacePlan& earlier : crowd) {
    if (earlier.index || earlier.id == face.id) break;
    drawing.choose(earlier);
  }
  ChosenAttachments drawn = drawing.choose(face);
  face.attachments = std::move(drawn.names);
  face.hair = drawn.hair;
}

}  // namespace crowdface
