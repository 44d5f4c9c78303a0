// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "crowdface/cast/cast_face.h"

namespace crowdface {

/// What may sit on a face.
struct AttachmentItem {
  std::string name, kind;
  std::vector<std::string> tags;      ///< only for faces whose target has all of these
  double share = 1;                   ///< against the others of its kind
  std::vector<std::string> excludes;  ///< names and kinds of what it does not go with
};

/// All that may sit on the faces of a crowd.
struct AttachmentDraw {
  std::uint64_t seed = 1;
  std::vector<AttachmentItem> items;
  std::map<std::string, double> none;          ///< by kind: the share of faces without one
  std::vector<std::vector<std::string>> tags;  ///< #heads
};

/// The attachments of a face, by name, in the order of the items: of each kind at most one, drawn by the
/// face's own index, or its id if it is not sampled, and by the kind, so that nothing else about the
/// crowd or the other kinds matters. Then each in turn takes away what it excludes.
std::vector<std::string> draw_attachments(const AttachmentDraw& draw, const CastFace& face);

}  // namespace crowdface
