// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "crowdface/cast/face_judge.h"
#include "crowdface/cast/nearest_face_search.h"
#include "crowdface/editor/draw_faces.h"
#include "crowdface/editor/mesh_faults.h"
#include "crowdface/editor/texture_atlas.h"
#include "crowdface/heads/cache_folder.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/preview/preview_mesh.h"
#include "crowdface/run/casting.h"
#include "crowdface/run/face_builder.h"
#include "crowdface/run/pipeline.h"

namespace crowdface {

/// \param config_or_crowd  a config, or a crowd's folder. If it is a folder, loads the config in
///                         it; the job's output goes to this folder.
Job load_edited_job(const std::filesystem::path& config_or_crowd, ConfigOverrides overrides,
                    const CacheFolder& cache);

/// Distances, measurements and warnings that the editor shows with a face.
struct FaceMeasures {
  Index nearest_head = 0;  ///< index of the nearest input head
  double nearest_head_mm = 0;
  /// Distance to this head with the face as built. nearest_head_mm is the smaller of this and the
  /// distance with all extrapolation factors 1.
  double nearest_head_as_built_mm = 0;
  /// The nearest face of the crowd other than the face itself and the face it was opened from.
  std::optional<std::size_t> nearest_face;
  double nearest_face_mm = 0;
  /// A measurement of the face, in its unit, and how much larger it is than the heads' mean.
  struct Trait {
    std::size_t trait = 0;  ///< index into measurements()
    double value = 0, above_mean = 0;
    double low = 0, high = 0;  ///< smallest and largest value of the heads
  };
  std::vector<Trait> traits;  ///< all measurements that are available on these heads
  /// One sentence for each limit of the config that the face violates.
  std::vector<std::string> warnings;
};

/// A job that the user edits by hand: heads ready for blending, the existing crowd, and the data
/// that the page shows of both. Its const members are thread-safe.
class EditSession {
 public:
  /// \param cache             the folder of prepared heads
  /// \param preview_vertices  approximate upper limit for the vertices of the preview
  EditSession(Job job, const CacheFolder& cache, std::size_t preview_vertices);
  EditSession(const EditSession&) = delete;
  EditSession& operator=(const EditSession&) = delete;

  const Job& job() const { return job_; }
  const CastingOptions& casting() const { return casting_; }
  const std::vector<FacePlan>* crowd() const { return crowd_ ? &*crowd_ : nullptr; }
  const PreviewMesh& preview() const { return preview_; }
  /// The heads' textures, in the layout of the preview's texture coordinates.
  const TextureAtlas& textures() const { return textures_; }

  /// Describes the job for the page, which loads this first.
  nlohmann::ordered_json description() const;
  /// Triangles, colours, masks and texture coordinates of the preview, as a BinaryAnswer.
  std::string mesh() const;
  /// How much light reaches the preview's vertices on the mean head: the square root of the visible
  /// fraction of the sky, as a BinaryAnswer. Waits for the computation.
  std::string light() const;
  /// A BinaryAnswer with a head's positions at the preview's vertices, the head's fields, and the
  /// functions of these fields.
  std::string head(Index head) const;

  /// The masks for blending; zero at components that are not skin.
  const RegionWeights& masks() const { return builder_.regions(); }
  /// Replaces the masks for blending. Distances, warnings and sampled faces still use the config's
  /// masks. Call this only while no other thread builds faces or reads masks.
  void use_masks(const RegionWeights& masks);

  /// All vertex positions of a face, as a saved mesh has them. Fast if the face differs from the
  /// previous face in few regions.
  Positions build(const Recipe& recipe) const;
  /// Measures a face from its recipe, without its mesh; therefore does not check gaps between
  /// parts.
  /// \param opened  id of the crowd's face from which the edit began, or empty
  FaceMeasures measure(const FacePlan& recipe, const std::string& opened = "") const;
  /// \param face  result of `build`
  FaceMeasures measure(const FacePlan& recipe, const Positions& face,
                       const std::string& opened = "") const;
  /// See MeshFaults. \param face  result of `build`
  std::vector<std::string> mesh_faults(const Recipe& recipe, const Positions& face) const {
    return faults_.faults_of(recipe, face);
  }
  /// Root mean square distance between two faces, in mm.
  double distance_mm(const FacePlan& one, const FacePlan& other) const;
  /// Returns the face with weights changed so that a measurement comes as near to `wanted` as the
  /// heads allow; see steer_trait.
  /// \param locked  parts that do not change, as in SampleRequest
  /// \throws UsageError if the measurement is not available, or weights cannot be given.
  FacePlan steer(FacePlan face, const std::string& trait, double wanted,
                 const std::vector<std::size_t>& locked) const;
  /// See sample_faces.
  std::vector<FacePlan> sample_faces(const SampleRequest& request) const;
  /// Unit normals of the full-resolution mesh at the preview's vertices, #preview by 3.
  std::vector<float> normals(const Positions& face) const;
  /// Roughness of a face at the preview's vertices, in 255ths; empty if there is no roughness map.
  std::vector<std::uint8_t> roughness(const TextureSet& texture_set) const;
  /// Positions at the preview's vertices, #preview by 3.
  std::vector<float> points(const Positions& face) const;

 private:
  /// The data for comparing and judging faces. Computing it takes about a second, so a separate
  /// thread does it while the page loads.
  struct JudgingData {
    std::unique_ptr<const CastingSpace> space;
    FaceJudge judge;
    NearestFaceSearch crowd;
    std::unique_ptr<const FaceTraits> traits;  ///< null if no measurement is available
    std::unique_ptr<const TraitRules> rules;
  };
  JudgingData judging() const;
  NearestFaceSearch::NearestFace nearest_other_face(const FaceSpace::Point& point,
                                                    const FacePlan& recipe,
                                                    const std::string& opened) const;
  nlohmann::ordered_json regions_json() const;
  FacePlan first_face() const;
  std::vector<HeadLevels> preview_levels() const;

  Job job_;
  TextureAtlas textures_;
  /// Reduces the mesh on another thread while the following members are constructed.
  std::future<PreviewMesh> preview_future_;
  std::optional<std::vector<FacePlan>> crowd_;
  Prepared prepared_;
  std::optional<Prepared> fitted_;  ///< set for `levels: exact`: fields for the preview only
  FaceBuilder builder_;
  MeshFaults faults_;
  mutable std::mutex previous_face_mutex_;
  mutable FaceBuilder::PreviousFace previous_face_;
  std::shared_future<JudgingData> judging_;
  CastingOptions casting_;
  PreviewMesh preview_;
  VertexFaces vertex_faces_;
  /// The visible fraction of the sky at the preview's vertices; takes about a second to compute.
  std::shared_future<std::vector<float>> sky_shares_;
};

}  // namespace crowdface
