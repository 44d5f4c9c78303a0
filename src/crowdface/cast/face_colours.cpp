// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/face_colours.h"

#include <algorithm>
#include <map>

#include "crowdface/core/contains.h"
#include "crowdface/core/random.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

constexpr double kMaxSecondWeight = 0.5;

class ColourChooser {
 public:
  explicit ColourChooser(const ColourOptions& draw) : draw_(draw) {
    for (const auto& all : draw.tags) {
      std::vector<std::string> compared = all;
      std::erase_if(compared, [&](const std::string& tag) {
        return draw.tags_to_match && !contains(*draw.tags_to_match, tag);
      });
      std::ranges::sort(compared);
      compared_tags_.push_back(std::move(compared));
    }
  }

  /// Returns whether two heads have the same tags. Compares only the tags that
  /// ColourOptions::tags_to_match lists.
  bool have_equal_tags(Index a, Index b) const {
    return compared_tags_.empty() || compared_tags_[static_cast<std::size_t>(a)] ==
                                         compared_tags_[static_cast<std::size_t>(b)];
  }

  /// Returns random colours for a face: the weights of one or two heads whose colours are mixed.
  /// These heads are chosen at random among the heads with the same tags as the head `typical` (see
  /// have_equal_tags).
  ///
  /// \param typical  the face's typical head.
  ///
  /// \param who  text that makes the random numbers of each face or family different.
  std::vector<SourceWeight> drawn(Index typical, std::uint64_t index, std::uint32_t attempt,
                                  const std::string& who) const {
    std::vector<Index> heads;
    for (Index h = 0; h < static_cast<Index>(draw_.head_names.size()); ++h) {
      if (have_equal_tags(h, typical)) heads.push_back(h);
    }
    const std::string purpose = concat("colours/", who);
    const RandomKey key = {draw_.seed, index, purpose, attempt};
    // Chooses one of the remaining heads by a random number u, and removes it from `heads`.
    const auto draw_head = [&](double u) {
      const auto at = static_cast<std::size_t>(u * static_cast<double>(heads.size()));
      const Index head = heads[std::min(at, heads.size() - 1)];
      std::erase(heads, head);
      return head;
    };
    const auto [first, second] = random_pair(key);
    std::vector<SourceWeight> colours = {{draw_head(first), 1}};
    if (!heads.empty()) {
      const double share = kMaxSecondWeight * random_pair(key, 1)[0];
      colours.push_back({draw_head(second), share});
      colours.front().weight = 1 - share;
    }
    return normalized_weights(std::move(colours));
  }

 private:
  const ColourOptions& draw_;
  /// for each head, the tags that `have_equal_tags` compares, sorted
  std::vector<std::vector<std::string>> compared_tags_;
};

/// Maps the id of each parent to the colours that its children inherit.
class ParentColours {
 public:
  ParentColours(const std::vector<std::string>& heads, const std::vector<FacePlan>& crowd)
      : heads_(heads) {
    for (const FacePlan& face : crowd) {
      for (const std::string& name : face.parents) known_[name];
    }
  }
  void record(const FacePlan& face) {
    const auto found = known_.find(face.id);
    if (found != known_.end()) found->second = face.recipe.colours;
  }
  std::vector<SourceWeight> colours_of(const std::string& name) const {
    const std::vector<SourceWeight>& of_face = known_.at(name);
    const auto head = std::ranges::find(heads_, name);
    if (!of_face.empty() || head == heads_.end()) return of_face;
    return {{head - heads_.begin(), 1}};
  }

 private:
  const std::vector<std::string>& heads_;
  std::map<std::string, std::vector<SourceWeight>> known_;
};

}  // namespace

void choose_colours(const ColourOptions& draw, std::vector<FacePlan>& crowd) {
  const ColourChooser drawing(draw);
  ParentColours parents(draw.head_names, crowd);
  for (FacePlan& face : crowd) {
    const Index typical = typical_head(face.recipe, draw.tags);
    std::vector<SourceWeight>& colours = face.recipe.colours;
    if (!colours.empty()) {  // colours that the recipe specifies
      parents.record(face);
      continue;
    }
    std::map<Index, double> inherited;
    for (const std::string& name : face.parents) {
      for (const SourceWeight& one : parents.colours_of(name)) {
        if (drawing.have_equal_tags(one.head, typical)) inherited[one.head] += one.weight;
      }
    }
    if (!inherited.empty()) {
      for (const auto& [head, weight] : inherited) colours.push_back({head, weight});
      colours = normalized_weights(std::move(colours));
    } else if (face.family) {
      colours = drawing.drawn(typical, 0, 0, concat("family/", *face.family));
    } else if (face.index) {
      colours = drawing.drawn(typical, *face.index, face.notes.attempt, "");
    } else {
      colours = drawing.drawn(typical, 0, 0, face.id);
    }
    parents.record(face);
  }
}

}  // namespace crowdface
