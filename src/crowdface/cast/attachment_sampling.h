// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
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
  std::uint64_t seed = 1;  ///< seed of the crowd's random numbers
  std::vector<AttachmentItem> items;
  /// For each group and kind, the fraction of the group's faces that wear no item of this kind. If
  /// the group has no fraction for a kind, the fraction in the entry "" applies. The entry "" also
  /// applies to faces without a group.
  std::map<std::string, std::map<std::string, double>> fractions_without_item;
  HeadTags tags;  ///< the tags of each head
  /// A key is a kind, a name or a colour of items. The value is the fraction of each group's
  /// sampled faces that wear an item of this kind, name or colour. A kind has either a quota of its
  /// own or quotas for some of its names and colours.
  std::map<std::string, double> quotas = {};
  /// names of the heads; used to find a parent of a face if this parent is a head
  std::vector<std::string> head_names = {};
  /// For each group, the fraction of the faces that have each named hair colour, before age makes
  /// hair grey. The entry "" applies to groups without an entry of their own and to faces without a
  /// group. If there is no entry "", these faces get their colours from the tags of their typical
  /// heads. Children inherit their parents' colours.
  std::map<std::string, std::map<std::string, double>> hair_colours = {};
  std::set<std::string> twin_families = {};  ///< names of the families whose members are twins
  /// Whether an item with this name would cover the eyes of a face too much; empty: never. Faces do
  /// not get such items, and wear nothing of a kind if all items that suit them cover the eyes.
  std::function<bool(const std::string& item, const FacePlan& face)> covers_eyes = {};
};

/// Sets the attachments of each face: the names of at most one item of each kind, in the order of
/// the items. The random numbers for a kind depend only on the kind and on the face's index (or its
/// id, if the face is not sampled). So a choice does not change if faces or other kinds are added.
/// docs/attachments.md has the rules for tags, shares, colours, quotas and hair colours.
///
/// For items with a tint, two rules replace the rule for shares:
///
/// - A sampled face gets an item that the fewest earlier sampled faces wear, relative to the items'
///   shares. A member of a family gets an item that the fewest earlier members wear.
/// - A face does not wear the item of the previous or of the next face if this face has a similar
///   hair colour, unless no other item is allowed. For a sampled face, the same holds for the most
///   similar earlier sampled face (CastingNotes::nearest).
///
/// \param crowd     In the order of the plan.
/// \param groups    For each sampled face: the index of its group, or −1. Empty: there are no
///                  groups.
/// \param rejected  Faces that reviews rejected, in order. The replacement of a rejected face gets
///                  its attachments after all other faces of the reviewed crowd, so that no other
///                  face changes.
/// \param crowd_size_at_rejection  for each rejected face, the size of the reviewed crowd. Empty:
///                                 the size of `crowd`.
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
