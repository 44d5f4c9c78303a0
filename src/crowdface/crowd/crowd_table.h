// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "crowdface/cast/face_plan.h"
#include "crowdface/cast/plan_names.h"
#include "crowdface/cast/typical_head.h"
#include "crowdface/core/hash.h"
#include "crowdface/core/text_pieces.h"

namespace crowdface {

/// The argument `neck_colours` of table_text for heads without colours at the neck.
inline const std::vector<Eigen::Array3d> kNoNeckColours;

/// Tags of heads and kinds of attachments, for the columns of the table that describe the person.
struct HeadTagsAndAttachmentKinds {
  HeadTags head_tags;                         ///< the tags of each head; or empty
  std::vector<std::string> attachment_kinds;  ///< the kind of each attachment; or empty
};

/// The text of crowd.csv: the crowd as a flat table (RFC 4180) for spreadsheets, one line for each
/// face. The table is computed from the plan and the heads alone, so every run over a whole crowd
/// can write the table. All arguments except `facts` must outlive the text.
/// \param neck_colours  one per face: colour, in linear light, of the skin above the ring of
///                      vertices at the neck; or empty
TextPieces table_text(const std::vector<FacePlan>& crowd, const PlanNames& names,
                      const std::vector<Eigen::Array3d>& neck_colours = kNoNeckColours,
                      const HeadTagsAndAttachmentKinds& facts = {});

/// Returns the text of plan.jsonl: the result of plan_text with additional keys for each face. Adds
/// `sex` and `tags` if the heads have tags. Adds `family_role` for parents and children; other
/// members of a family have only the key `family`. `crowd` and `names` must outlive the text.
TextPieces annotated_plan_text(const std::vector<FacePlan>& crowd, const PlanNames& names,
                               const Digest& settings, const HeadTagsAndAttachmentKinds& facts);

/// Converts a colour in linear light to sRGB text such as "#C89F8A".
std::string srgb_hex(const Eigen::Array3d& linear_colour);

}  // namespace crowdface
