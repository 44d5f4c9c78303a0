// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "crowdface/cast/face_plan.h"
#include "crowdface/cast/hair_colour.h"
#include "crowdface/cast/typical_head.h"

namespace crowdface {

/// The parameters of HairChooser. The members have the same meaning as the members of
/// AttachmentOptions.
struct HairOptions {
  std::uint64_t seed = 1;  ///< seed of the crowd's random numbers
  HeadTags tags;           ///< the tags of each head
  /// names of the heads; used to find a parent of a face if this parent is a head
  std::vector<std::string> head_names;
  /// for each group: the fraction of the faces that have each named hair colour
  std::map<std::string, std::map<std::string, double>> hair_colours;
  std::set<std::string> twin_families;  ///< names of the families whose members are twins
};

/// Chooses the hair colours of faces, in the order of the plan; see choose_attachments. The colour
/// of a face does not depend on the faces after it.
class HairChooser {
 public:
  /// \param crowd  all faces, in the order of the plan. The fractions of `hair_colours` refer only
  ///               to faces that inherit no colour from a parent or from their family.
  HairChooser(HairOptions options, const std::vector<FacePlan>& crowd);

  /// Returns the hair colour of a face.
  ///
  /// \param head  the face's typical head.
  HairColour colour_of(const FacePlan& face, Index head);

 private:
  /// Returns the key of `hair_colours` (a group's name or "") that applies to a face.
  std::string key_in_hair_colours(const FacePlan& face) const;
  /// Returns the colour that `hair_colours` gives the face; nothing if it gives the face no colour.
  /// The colours are distributed so that, among the faces with the same key in `entries_of_faces_`,
  /// each colour has the fraction that the config specifies. If a face looks grey, its colour is
  /// not visible. Then the next face to which `hair_colours` gives no colour, and which does not
  /// look grey, gets the hidden colour.
  std::optional<HairColour> configured_colour(const FacePlan& face, bool is_grey);
  /// Returns the hair colour that a face inherits from its parents or shares with its family.
  std::optional<HairColour> inherited_colour(const FacePlan& face, const std::string& person) const;
  /// Returns a parent's hair colour without the grey of age; nothing if the parent is unknown.
  std::optional<HairColour> colour_of_parent(const std::string& parent) const;
  /// Returns the hair colour that the head's tags name. If the tags name no colour, returns a
  /// random colour; colours that are frequent in the world are more likely.
  HairColour colour_of_tags(Index head, const std::string& random_number_purpose) const;
  /// Returns the mean age, from 0 (young) to 1 (old), of the heads that a face is blended from. The
  /// ages of the heads are estimated from the heads' tags. In the mean, the target of the recipe (a
  /// head or a mixture of heads) has a weight of three quarters, and the heads that lend the finest
  /// detail together have one quarter.
  double mean_age_of_heads(const Recipe& recipe) const;
  /// Returns the apparent age of a face, from 0 (young) to 1 (old).
  double apparent_age(const FacePlan& face) const;
  /// Returns the fraction of grey hair at the face's age.
  double grey_fraction(const FacePlan& face, const std::string& random_number_purpose) const;

  HairOptions options_;
  /// The entry of HairOptions::hair_colours that applies to a face.
  struct EntryOfFace {
    std::string key;               ///< key of the entry in `hair_colours`
    std::uint64_t face_index = 0;  ///< index of the face among the faces with this key
  };
  /// Maps the id of a face to the entry of `hair_colours` that applies to this face. Contains only
  /// the faces that inherit no colour.
  std::map<std::string, EntryOfFace> entries_of_faces_;
  /// maps a key of `hair_colours` to the number of faces in `entries_of_faces_` with this key
  std::map<std::string, std::uint64_t> entry_sizes_;
  /// Maps a key of `hair_colours` to one element for each face in `entries_of_faces_` with this
  /// key. The element is the index of the face's colour among the colours in `hair_colours` at this
  /// key, or −1 if `hair_colours` gives the face no colour.
  std::map<std::string, std::vector<int>> colour_indices_;
  /// Maps a key of `hair_colours` to the hidden colours of the faces with this key: the colours
  /// that `hair_colours` gave to faces that look grey, and that no later face has got yet (see
  /// configured_colour). A colour is given by its index among the colours in `hair_colours` at this
  /// key.
  std::map<std::string, std::deque<int>> hidden_colours_;
  /// Maps the id of a face to the index of the face's colour. The index refers to the colours in
  /// `hair_colours` at the face's key. It is −1 if `hair_colours` gives the face no colour.
  std::map<std::string, int> colour_of_faces_;
  /// maps the id of a face to its hair colour without the grey of age
  std::map<std::string, HairColour> base_colours_;
  std::map<std::string, HairColour> family_colours_;  ///< maps a family's name to its hair colour
};

}  // namespace crowdface
