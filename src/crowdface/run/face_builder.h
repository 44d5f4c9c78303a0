// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <span>

#include "crowdface/blend/crowd_blender.h"
#include "crowdface/config/config.h"
#include "crowdface/heads/face_poses.h"
#include "crowdface/heads/prepare.h"
#include "crowdface/parts/follower.h"
#include "crowdface/parts/rigid_motion.h"
#include "crowdface/parts/skin_contacts.h"
#include "crowdface/validity/skin_check.h"

namespace crowdface {

/// Builds the mesh of a face from the face's recipe. Uses the smoothing levels that the config asks
/// for. One call with several recipes is faster than one call per recipe and gives the same bytes.
class FaceBuilder {
 public:
  /// \param config, inputs, prepared  must outlive the builder.
  FaceBuilder(const Config& config, const Inputs& inputs, const PreparedHeads& prepared);
  FaceBuilder(const FaceBuilder&) = delete;
  FaceBuilder& operator=(const FaceBuilder&) = delete;

  /// Builds the faces of several recipes.
  /// \param results  one matrix per recipe, #V by 3, in the units of the mesh files; reuses the
  ///                 memory of these matrices
  void build(std::span<const Recipe* const> recipes, std::span<Positions> results) const;
  /// Builds one face. \return #V by 3
  Positions build(const Recipe& recipe) const;

  /// The face that the previous call of `rebuild` built. The next call starts from this face.
  struct PreviousFace {
    std::optional<Recipe> recipe;  ///< recipe of this face; empty before the first call
    Positions blended_positions;   ///< positions of this face before the steps of `finish`, #V by 3
  };
  /// Gives the same result as `build` for one recipe, but is faster if the recipe differs in only a
  /// few regions from the recipe of the previous call.
  /// \param previous  the state that the previous call left; initially empty
  Positions rebuild(const Recipe& recipe, PreviousFace& previous) const;

  /// Replaces the region masks for blending, which are initially the masks of the inputs. Every
  /// PreviousFace becomes invalid.
  void use_masks(const Config& config, const RegionWeights& regions);

  /// The region masks for blending. Masks are zero at vertices of parts (eyes, teeth), because
  /// other steps determine the positions of these vertices.
  const RegionWeights& regions() const { return regions_; }

  /// Indices of the vertices whose positions `correct_contacts` reads; empty if it corrects no
  /// gaps.
  std::vector<std::uint32_t> contact_vertices() const;
  /// Corrects the gaps between the lips, and between other skin surfaces that almost touch. Call
  /// this before mirroring the face.
  /// \param face  #V by 3; only the rows of contact_vertices() need positions
  void correct_contacts(const Recipe& recipe, Positions& face) const;

  /// The rigid motion that moves a face onto a body (config section `neck`), applied before
  /// mirroring; nothing if the face stays in place.
  std::optional<RigidMotion> motion_to_body(const Recipe& recipe) const;

  /// Defects in the skin of a face, compared with the face's target head.
  /// \param face  #V by 3, built from `recipe`
  SkinDefects defects(const SkinCheck& check, const Recipe& recipe, const Positions& face) const;

  /// Compares the gaps of a face (between the lips, or between other skin surfaces that almost
  /// touch) with the same gaps of all heads. Returns the largest amount, in mm, by which a gap of
  /// the face exceeds the widest such gap among the heads; 0 if no gap is wider.
  /// \param face  #V by 3, built from `recipe`
  double gap_excess_mm(const Recipe& recipe, const Positions& face) const;

  /// Memory in bytes for building the given number of faces at once, including the memory for the
  /// resulting positions.
  std::uint64_t memory_bytes(std::size_t face_count) const;

 private:
  /// Applies the steps after blending: adjusts asymmetry, contacts, parts and pose, mirrors the
  /// face, and fits the ring of vertices at the neck.
  void finish(const Recipe& recipe, Positions& face) const;
  /// The map that mirrors faces; computed at the first call. Thread-safe.
  const MirrorMap& mirror() const;
  /// A contact is a pair of skin surfaces that almost touch, such as the lips. Returns, for each
  /// contact, the allowed range of the gap: the smallest range that contains the gap of the target
  /// head and, for each band, the weighted mean of the gaps of the source heads.
  /// If the recipe changes the asymmetry, include_mirrored_gap_ranges extends the ranges.
  std::vector<SkinContacts::Range> contact_ranges(const Recipe& recipe) const;
  /// Extends the gap range of each contact to include the gap range of the mirrored contact.
  void include_mirrored_gap_ranges(std::vector<SkinContacts::Range>& ranges) const;

  const Config& config_;
  const Inputs& inputs_;
  const PreparedHeads& prepared_;
  mutable std::once_flag mirror_once_;
  mutable std::shared_ptr<const MirrorMap> mirror_;  ///< null before the first call of `mirror`
  /// the region masks for blending
  RegionWeights regions_;
  /// blends the fitted smoothing levels; empty with `levels: exact`, which smooths for each face
  std::optional<CrowdBlender> blender_;
  /// rotates faces to the common pose of the heads; empty if all heads have this pose
  std::optional<FacePoses> poses_;
  /// corrects the gaps between skin surfaces that almost touch; always set after construction
  std::optional<SkinContacts> contacts_;
  /// #contacts by #regions: the region weights at each contact; each row sums to one
  std::vector<std::vector<double>> contact_masks_;
  /// whether the function `correct_contacts` corrects gaps between skin surfaces, or does nothing
  bool corrects_contacts_;
  double mm_per_unit_;  ///< millimetres per unit of the mesh files
  /// moves eyes, teeth and other parts with the skin; empty if there is only skin
  std::optional<PartFollower> follower_;
};

}  // namespace crowdface
