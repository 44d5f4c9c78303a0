// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "crowdface/cast/attachment_item.h"
#include "crowdface/cast/cast_face.h"
#include "crowdface/cast/typical_head.h"

namespace crowdface {

/// All that may sit on the faces of a crowd.
struct AttachmentDraw {
  std::uint64_t seed = 1;
  std::vector<AttachmentItem> items;
  std::map<std::string, double> none;  ///< by kind: the share of faces without one
  HeadTags tags;                       ///< #heads
  /// By kind, name or colour: the share of sampled faces that wear one, in each group apart. A kind has its
  /// own or those of some of its names and colours.
  std::map<std::string, double> quotas = {};
  std::vector<std::string> heads = {};  ///< their names: parents may be heads
};

/// Gives each face of a crowd its attachments, by name, in the order of the items: of each kind at most one,
/// drawn by the face's own index, or its id if it is not sampled, and by the kind, so that neither later faces
/// nor other kinds matter; but
/// - of what has a colour one that what is drawn already has, or else that of a parent or of the family,
///   is taken where the face may wear some. A child has a parent's colour whatever its own tags say of its
///   colour; but not that of an old parent, who may be grey, unless it is old itself,
/// - quotas serve the m-th sampled face of a group whatever else is drawn; one that may not wear what
///   a quota asks for goes as if it were not asked,
/// - sampled faces on one head, and the members of a family, take turns: of what those before have had their share of no
///   more is given, nor, where there is a choice, of what all sampled faces have had theirs of.
/// Then each in turn takes away what it excludes.
/// \param crowd     in the order of the plan.
/// \param groups    of sampled faces 1, 2, …: quota or group, or −1; empty: they are of none.
/// \param rejected  by reviews, in their order: sampled faces in their places are dressed last, so that nobody
///                  else changes.
void draw_attachments(const AttachmentDraw& draw, const std::vector<int>& groups,
                      std::vector<CastFace>& crowd, const std::vector<CastFace>& rejected = {});

}  // namespace crowdface
