// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/changed_faces.h"

#include <algorithm>
#include <utility>

#include "crowdface/cast/ageing.h"
#include "crowdface/cast/draw_recipe.h"
#include "crowdface/core/contains.h"
#include "crowdface/texture/texture_blender.h"

namespace crowdface {
namespace {

/// Puts the named attachments on a face. Removes each attachment of the face that has the same kind
/// as a named attachment, or that must not be worn together with a named attachment (`excludes`).
/// If `names` is empty, removes all attachments.
void replace_attachments(const Config& config, const std::vector<std::string>& names,
                         FacePlan& face) {
  const std::vector<Config::Attachment>& items = config.attachments.items;
  std::vector<std::string> worn;
  for (const Config::Attachment& item : items) {
    const auto is_in_its_place = [&](const Config::Attachment& other) {
      const auto excludes = [](const Config::Attachment& a, const Config::Attachment& b) {
        return contains(a.excludes, b.name) || contains(a.excludes, b.kind);
      };
      return contains(names, other.name) &&
             (other.kind == item.kind || excludes(other, item) || excludes(item, other));
    };
    const bool stays = !names.empty() && contains(face.attachments, item.name) &&
                       std::ranges::none_of(items, is_in_its_place);
    if (stays || contains(names, item.name)) worn.push_back(item.name);
  }
  face.attachments = std::move(worn);
}

/// Removes attachments from a face. \param words  kinds and names of attachments.
void remove_attachments(const Config& config, const std::vector<std::string>& words,
                        FacePlan& face) {
  for (const Config::Attachment& item : config.attachments.items) {
    if (contains(words, item.name) || contains(words, item.kind)) {
      std::erase(face.attachments, item.name);
    }
  }
}

class ChangedLooks {
 public:
  /// \param crowd  all faces before any change.
  ChangedLooks(const Config& config, const CastingOptions& casting,
               const AttachmentOptions& attachments, const ColourOptions& colours,
               const std::vector<int>& groups, const std::vector<FacePlan>& crowd)
      : config_(config),
        casting_(casting),
        attachments_(attachments),
        colours_(colours),
        groups_(groups),
        crowd_(crowd) {}

  FacePlan of(const ChangedFace& changed, const FacePlan& before) const {
    FacePlan face = changed.face;
    face.notes = before.notes;
    if (!changed.is_other_person) {
      face.recipe.colours = before.recipe.colours;
      face.attachments = before.attachments;
      face.hair = before.hair;
      if (before.hair && face.age != before.age) {
        FacePlan aged = before;
        aged.age = face.age;
        aged.age_years = face.age_years;
        face.hair->grey_fraction = with_attachments(aged).hair->grey_fraction;
      }
    } else {
      face = with_attachments(with_colours(face));
      if (changed.variant_of) {
        const FacePlan other = look_of(*changed.variant_of);
        face.recipe.colours = other.recipe.colours;
        if (face.recipe.colours.empty()) set_aged_skin(other, face);
        face.hair = other.hair;
      }
    }
    for (const AppliedChange& applied : changed.changes) {
      const FaceChange& change = applied.change;
      if (change.attachments) replace_attachments(config_, *change.attachments, face);
      remove_attachments(config_, change.removed_attachments, face);
      if (!change.colours.empty()) face.recipe.colours = normalized_source_weights(change.colours);
      if (change.hair) face.hair = rounded_colour(*hair_colour_named(*change.hair));
    }
    return face;
  }

 private:
  /// Gives `face` the skin that `other` would have at the age of `face`.
  void set_aged_skin(FacePlan other, FacePlan& face) const {
    if (config_.textures.blend != TextureBlend::kAuto) return;  // the face has the same target
    for (RegionRecipe& region : other.recipe.regions) {  // skin ages like the finest band of detail
      if (region.colours.empty()) continue;
      band_of(region, band_count(region) - 1).weights = std::exchange(region.colours, {});
    }
    if (other.age != face.age) {
      undo_age(other, casting_);
      apply_age(other, {face.age.value_or(0)}, casting_);
    }
    const auto weights = colour_weights(other.recipe, config_.faces.names.size());
    for (std::size_t k = 0; k < weights.size(); ++k) {
      std::vector<SourceWeight>& colours = face.recipe.regions[k].colours;
      for (std::size_t h = 0; h < weights[k].size(); ++h) {
        if (weights[k][h] > 0) colours.push_back({static_cast<Index>(h), weights[k][h]});
      }
    }
  }

  FacePlan with_colours(const FacePlan& face) const {
    std::vector<FacePlan> alone = {face};
    if (config_.textures.colours == ColourWeights::kSampled) {
      choose_colours(colours_, alone);
    }
    return alone.front();
  }

  FacePlan with_attachments(FacePlan face) const {
    if (!config_.attachments.items.empty())
      choose_attachments_of_changed_face(attachments_, groups_, crowd_, face);
    return face;
  }

  /// Returns the changed face with its colours and attachments. If a later review made casting
  /// sample this face again, the crowd has no colours and attachments for the earlier version of
  /// the face. In this case, this function chooses new colours and attachments.
  FacePlan look_of(const ChangedFace& changed) const {
    const FacePlan& face = changed.face;
    const auto now = std::ranges::find(crowd_, face.id, &FacePlan::id);
    const bool is_same = now != crowd_.end() && now->notes.attempt == face.notes.attempt;
    return of(changed, is_same ? *now : with_attachments(with_colours(face)));
  }

  const Config& config_;
  const CastingOptions& casting_;
  const AttachmentOptions& attachments_;
  const ColourOptions& colours_;
  const std::vector<int>& groups_;
  const std::vector<FacePlan>& crowd_;
};

}  // namespace

void replace_changed_faces(const Config& config, const CastingOptions& casting,
                           const AttachmentOptions& attachments, const ColourOptions& colours,
                           const std::vector<int>& groups,
                           const std::map<std::size_t, ChangedFace>& changed,
                           std::vector<FacePlan>& crowd) {
  if (changed.empty()) return;
  const std::vector<FacePlan> cast = crowd;
  const ChangedLooks looks(config, casting, attachments, colours, groups, cast);
  for (const auto& [face, change] : changed) crowd[face] = looks.of(change, cast[face]);
}

}  // namespace crowdface
