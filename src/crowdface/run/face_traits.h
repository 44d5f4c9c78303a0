// SPDX-License-Identifier: Apache-2.0
// Measures the faces of a config from their recipes.
#pragma once

#include <memory>
#include <vector>

#include "crowdface/cast/face_measurer.h"
#include "crowdface/cast/face_plan.h"
#include "crowdface/heads/prepare.h"
#include "crowdface/run/face_builder.h"
#include "crowdface/run/head_traits.h"

namespace crowdface {

/// Measures selected traits of a face. Computes only the positions of the landmarks that these
/// traits need.
class FaceTraits {
 public:
  /// \param traits  indices of the measurements; all of these must be available on the heads
  /// \param config, inputs, prepared  must outlive this object
  FaceTraits(const Config& config, const Inputs& inputs, const PreparedHeads& prepared,
             const HeadLandmarks& landmarks, std::vector<std::size_t> traits);
  FaceTraits(const FaceTraits&) = delete;
  FaceTraits& operator=(const FaceTraits&) = delete;

  /// The object with which casting estimates the landmarks and measurements of candidate faces.
  const FaceMeasurer& measurer() const { return *measurer_; }
  /// The measured traits, as indices into measurements().
  const std::vector<std::size_t>& trait_indices() const { return trait_indices_; }
  /// The value of each of trait_indices() on the mesh that is written for the recipe.
  std::vector<double> values(const Recipe& recipe) const;

 private:
  /// Which mesh of a face is measured: the written mesh, which is moved onto the body and bent at
  /// the neck (kBent), or the mesh before it is moved and bent (kAsBlended). Casting measures
  /// kAsBlended, so that recipes do not depend on the body.
  enum class NeckState { kBent, kAsBlended };
  /// Computes the positions of the landmarks on a mesh of the recipe's face: on the written mesh,
  /// or on the mesh before it is moved and bent. `neck` selects the mesh.
  Positions exact_landmarks(const Recipe& recipe, NeckState neck) const;
  /// Replaces the positions of the vertices `landmark_vertices_` by their positions on the mirrored
  /// face.
  void mirror_landmark_vertices(Positions& face) const;

  std::vector<std::size_t> trait_indices_;  ///< indices into measurements()
  HeadLandmarks landmarks_;                 ///< the landmarks that the traits need
  FaceBuilder builder_;  ///< corrects the contacts (such as lips) and the pose of a face
  double mm_per_unit_;   ///< millimetres per unit of the mesh files
  /// mirrors faces; null unless the config asks for mirrored faces
  std::shared_ptr<const MirrorMap> mirror_;
  /// the heads placed on a common body; null unless the config has `neck`
  std::shared_ptr<const HeadsOnBody> heads_on_body_;
  /// the vertices of the landmarks and, if there is a neck, of the ring of vertices at the neck
  std::vector<std::uint32_t> landmark_vertices_;
  /// the vertices on which the exact landmark positions depend, ascending; `heads_` holds the
  /// heads' data at these vertices
  FaceSamples samples_;
  HeadsAtSamples heads_;                  ///< the heads' data at the vertices `samples_`
  Index vertex_count_;                    ///< number of vertices of a head
  std::optional<FaceMeasurer> measurer_;  ///< estimates the landmarks of candidate faces
};

/// Returns an object that measures the traits that the config names; null if the config names none.
/// \throws UsageError if one of these traits is not available on the heads.
std::unique_ptr<const FaceTraits> face_traits_of_config(const Config& config, const Inputs& inputs,
                                                        const PreparedHeads& prepared);

/// Returns an object that measures all traits that are available on the heads; null if no trait is
/// available.
/// \throws UsageError if the config names a trait that is not available.
std::unique_ptr<const FaceTraits> available_face_traits(const Config& config, const Inputs& inputs,
                                                        const PreparedHeads& prepared);

/// Records the values of all traits in the faces of a crowd.
void measure_faces(const FaceTraits& traits, std::vector<FacePlan>& crowd);

}  // namespace crowdface
