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
  /// \param crowd  all faces, in the order of the plan. Faces that do not have the colour of a
  ///               parent or of their family share the fractions of `hair_colours`.
  HairDraw(HairOptions options, const std::vector<FacePlan>& crowd);

  /// \param head  the head whose tags the face has.
  HairColour of(const FacePlan& face, Index head);

 private:
  std::string entry_of(const FacePlan& face) const;
  std::optional<HairColour> asked(const FacePlan& face);
  std::optional<HairColour> inherited(const FacePlan& face, const std::string& person) const;
  std::optional<HairColour> colour_of_parent(const std::string& parent) const;
  HairColour colour_of_tags(Index head, const std::string& purpose) const;
  double grey_of(const FacePlan& face, Index head, const std::string& purpose) const;

  HairOptions draw_;
  /// by face: its entry in `hair_colours`, and its index among the faces of this entry
  std::map<std::string, std::pair<std::string, std::uint64_t>> places_;
  std::map<std::string, std::uint64_t> sizes_;  ///< number of places of each entry
  /// by entry: index of the named colour of each place, or −1
  std::map<std::string, std::vector<int>> schedules_;
  std::map<std::string, HairColour> known_;     ///< colours without the grey of age, by face
  std::map<std::string, HairColour> families_;  ///< of families without parents
};

}  // namespace crowdface
