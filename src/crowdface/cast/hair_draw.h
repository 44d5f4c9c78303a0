// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "crowdface/cast/face_plan.h"
#include "crowdface/cast/hair_colour.h"
#include "crowdface/cast/typical_head.h"

namespace crowdface {

/// What hair colours depend on; see AttachmentDraw.
struct HairOptions {
  std::uint64_t seed = 1;
  HeadTags tags;                   ///< #heads
  std::vector<std::string> heads;  ///< names of the heads, because parents may be heads
  std::map<std::string, std::map<std::string, double>> hair_colours;
  std::set<std::string> twins;
};

/// Draws the hair colours of faces, in the order of the plan; see draw_attachments. The colour of a
/// face does not depend on later faces.
class HairDraw {
 public:
  /// \param groups  group of each sampled face, see draw_attachments.
  HairDraw(HairOptions options, const std::vector<int>& groups);

  /// \param head  the head whose tags the face has.
  HairColour of(const FacePlan& face, Index head);

 private:
  const std::map<std::string, double>& shares_of(const FacePlan& face) const;
  std::optional<HairColour> asked(const FacePlan& face);
  std::optional<HairColour> inherited(const FacePlan& face, const std::string& person) const;
  std::optional<HairColour> colour_of_parent(const std::string& parent) const;
  HairColour colour_of_tags(Index head, const std::string& purpose) const;
  double grey_of(const FacePlan& face, Index head, const std::string& purpose) const;

  HairOptions draw_;
  /// for each sampled face: its group, and its index within the group
  std::vector<std::pair<int, std::uint64_t>> places_;
  std::map<int, std::uint64_t> sizes_;  ///< number of sampled faces in each group
  /// by group: index of the named colour of each of the group's sampled faces, or −1
  std::map<int, std::vector<int>> schedules_;
  std::map<std::string, HairColour> known_;     ///< colours without the grey of age, by face
  std::map<std::string, HairColour> families_;  ///< of families without parents
};

}  // namespace crowdface
