// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "crowdface/cast/attachment_item.h"
#include "crowdface/cast/face_plan.h"
#include "crowdface/cast/typical_head.h"

namespace crowdface {

/// The attachments that faces of a crowd may wear, and parameters for choosing among these.
struct AttachmentOptions {
  std::uint64_t seed = 1;
  std::vector<AttachmentItem> items;
  /// by kind of attachment: fraction of the faces that wear no item of this kind
  std::map<std::string, double> fraction_without_item_by_kind;
  HeadTags tags;  ///< the tags of each head
  /// By kind, name or colour of items: the fraction of each group's sampled faces that wear an item
  /// of this kind, name or colour. A kind has either a quota of its own or quotas for some of its
  /// names and colours.
  std::map<std::string, double> quotas = {};
  std::vector<std::string> head_names = {};  ///< names of the heads, because a parent may be a head
  /// By group: the fraction of the faces that have each named hair colour, before age makes hair
  /// grey. The key "" is for groups without an entry and for faces without a group. Children
  /// inherit their parents' colours. Any other face without an entry gets its colour from the tags
  /// of its typical head.
  std::map<std::string, std::map<std::string, double>> hair_colours = {};
  std::set<std::string> twin_families = {};  ///< names of the families whose members are twins
};

/// Sets the attachments of each face: the names of at most one item of each kind, in the order of
/// the items. The random numbers for a kind depend only on the kind and on the face's index (or its
/// id, if the face is not sampled). So a choice does not change if faces or other kinds are added.
/// docs/attachments.md explains the rules:
///
/// - Colours: if an item of an earlier kind gave the face a colour, the items of later kinds have
///   the same colour, provided that the face may wear such items. Otherwise the colour comes from a
///   parent or from the family. A child may wear a parent's colour even if the child's own tags
///   name another colour. A child inherits a colour that requires the tag `old` (grey) only if the
///   child itself is old.
/// - Quotas: each quota determines in advance which of a group's sampled faces wear the item,
///   independently of all other choices. If a chosen face may not wear the item, the face is
///   treated like the faces that no quota chose.
/// - Equal use: among the sampled faces on one head, and among the members of one family, an item
///   is skipped once it has reached its share of the earlier faces. If several items are left,
///   sampled faces also skip items that have reached their share of all sampled faces.
///
/// Items with a tint follow other rules:
///
/// - Each face has a hair colour: a child has one of its parents' colours or a colour between them;
///   a family without parents shares one colour; any other face has a random colour from
///   `hair_colours` or the colour that the head's tags name (`brown_hair`). Age makes hair grey.
/// - A sampled face gets an item that the fewest earlier sampled faces wear. A member of a family
/// gets an item that the fewest earlier members wear.
/// - If the previous face has a similar hair colour, the face does not wear the item that the
///   previous face wears, unless no other item is allowed.
///
/// Finally, each item in turn removes the items that it excludes.
///
/// \param crowd     In the order of the plan.
/// \param groups    Group of each sampled face 1, 2, …, or −1. Empty: no face is in a group.
/// \param rejected  Faces that reviews rejected, in order. Their replacements are processed after
///                  all faces of the crowd that was reviewed, so that no other face changes.
/// \param crowd_size_at_rejection  for each rejected face, the size of the crowd that was reviewed.
///                                 Empty: the whole crowd.
void choose_attachments(const AttachmentOptions& options, const std::vector<int>& groups,
                        std::vector<FacePlan>& crowd, const std::vector<FacePlan>& rejected = {},
                        const std::vector<std::size_t>& crowd_size_at_rejection = {});

/// Chooses the attachments of a changed face as if it were the only sampled face. So the choice
/// neither depends on the other sampled faces nor affects the attachments of these faces.
///
/// \param crowd  In the order of the plan; may contain the face as it was before the change.
void choose_attachments_of_changed_face(const AttachmentOptions& options,
                                        const std::vector<int>& groups,
                                        const std::vector<FacePlan>& crowd, FacePlan& face);

}  // namespace crowdface
