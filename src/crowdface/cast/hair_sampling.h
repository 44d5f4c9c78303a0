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

/// The parameters of HairChooser. Its members have the same meaning as in AttachmentOptions.
struct HairOptions {
  std::uint64_t seed = 1;
  HeadTags tags;                        ///< the tags of each head
  std::vector<std::string> head_names;  ///< names of the heads; some parents of families are heads
  std::map<std::string, std::map<std::string, double>> hair_colours;
  std::set<std::string> twin_families;
};

/// Chooses the hair colours of faces, in the order of the plan; see choose_attachments. The colour
/// of a face does not depend on the faces after it.
class HairChooser {
 public:
  /// \param crowd  all faces, in the order of the plan. The fractions of `hair_colours` refer only
  ///               to faces that inherit no colour from a parent or the family.
  HairChooser(HairOptions options, const std::vector<FacePlan>& crowd);

  /// Returns the hair colour of a face.
  ///
  /// \param head  the face's typical head.
  HairColour colour_of(const FacePlan& face, Index head);

 private:
  std::string hair_colours_key_of(const FacePlan& face) const;
  std::optional<HairColour> scheduled_colour(const FacePlan& face);
  std::optional<HairColour> inherited_colour(const FacePlan& face, const std::string& person) const;
  std::optional<HairColour> colour_of_parent(const std::string& parent) const;
  HairColour colour_of_tags(Index head, const std::string& purpose) const;
  double grey_fraction(const FacePlan& face, Index head, const std::string& purpose) const;

  HairOptions options_;
  /// by face: the key of the entry in `hair_colours` that applies to the face, and the face's index
  /// among the faces of this entry
  std::map<std::string, std::pair<std::string, std::uint64_t>> entry_indices_;
  std::map<std::string, std::uint64_t> entry_sizes_;  ///< by entry: how many faces use the entry
  /// by entry: for each face that uses the entry, the index of the face's colour in the entry, or
  /// −1
  std::map<std::string, std::vector<int>> schedules_;
  /// hair colours without the grey of age, by face
  std::map<std::string, HairColour> base_colours_;
  std::map<std::string, HairColour> family_colours_;  ///< hair colours of families, by family
};

}  // namespace crowdface
