// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "crowdface/cast/attachment_item.h"
#include "crowdface/cast/face_plan.h"
#include "crowdface/cast/typical_head.h"

namespace crowdface {

/// The attachments that faces of a crowd may wear.
struct AttachmentDraw {
  std::uint64_t seed = 1;
  std::vector<AttachmentItem> items;
  std::map<std::string, double> none;  ///< by kind: share of faces that wear none
  HeadTags tags;                       ///< #heads
  /// By kind, name or colour: share of each group's sampled faces that wear one. A kind has either
  /// a quota of its own or quotas for some of its names and colours.
  std::map<std::string, double> quotas = {};
  std::vector<std::string> heads = {};  ///< names of the heads: parents may be heads
};

/// Chooses the attachments of each face: names, in the order of the items, at most one per kind.
/// Each kind is drawn separately, with random numbers that depend on the face's index (or id, if it
/// is not sampled) and on the kind only. So later faces and other kinds do not change them.
/// docs/attachments.md explains the rules:
///
/// - Colours: if an item in the chosen set has a colour, later kinds use it where the face may wear
///   it. Otherwise the colour comes from a parent or from the family. A child may wear a parent's
///   colour even if its own tags name another colour. Colours that only the old wear (grey) are
///   inherited by old children only.
/// - Quotas decide for the m-th sampled face of a group, independently of all other draws. A face
///   that may not wear what a quota asks for is treated as if there were no quota.
/// - Turns: sampled faces on one head, and members of one family, skip items that have reached
///   their share among the earlier of these faces. If several items are left, sampled faces also
///   skip items that have reached their share among all sampled faces.
///
/// At last, each item in turn removes the items it excludes.
///
/// \param crowd     In the order of the plan.
/// \param groups    Group of each sampled face 1, 2, …, or −1. Empty: no face is in a group.
/// \param rejected  Faces that reviews rejected, in order. Their replacements are processed last,
///                  so that no other face changes.
void draw_attachments(const AttachmentDraw& draw, const std::vector<int>& groups,
                      std::vector<FacePlan>& crowd, const std::vector<FacePlan>& rejected = {});

}  // namespace crowdface
