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
#include "crowdface/editor/mesh_faults.h"
#include "crowdface/editor/sample_faces.h"
#include "crowdface/editor/texture_atlas.h"
#include "crowdface/heads/cache_folder.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/preview/preview_mesh.h"
#include "crowdface/run/casting.h"
#include "crowdface/run/face_builder.h"
#include "crowdface/run/job.h"

namespace crowdface {

/// Loads the job that the user edits.
/// \param config_or_crowd  a config file or the folder of a crowd. For a folder, loads the
///                         config.yaml in the folder, and the job writes its output into the
///                         folder.
Job load_edited_job(const std::filesystem::path& config_or_crowd, ConfigOverrides overrides,
                    const CacheFolder& cache);

/// The distances, measurements and warnings that the editor shows for a face.
struct FaceMeasures {
  Index nearest_head = 0;  ///< index of the nearest input head
  /// Distance from the measured face to `nearest_head`. This is the smaller of two distances: with
  /// the recipe's extrapolation factors, and with all extrapolation factors set to 1.
  double nearest_head_distance_mm = 0;
  /// distance of the finished face, with the extrapolation factors of its recipe, to `nearest_head`
  double nearest_head_distance_with_extrapolation_mm = 0;
  /// Index of the crowd's face that is nearest to the measured face. Ignores the measured face
  /// itself and the face from which the user began the edit.
  std::optional<std::size_t> nearest_face;
  double nearest_face_distance_mm = 0;  ///< distance to `nearest_face`
  /// A measurement of the face.
  struct Trait {
    std::size_t trait = 0;            ///< index into measurements()
    double value = 0;                 ///< value on the face, in the unit of the measurement
    double difference_from_mean = 0;  ///< `value` minus the mean of the heads' values
    double low = 0, high = 0;         ///< the heads' smallest and largest value of this measurement
  };
  std::vector<Trait> traits;  ///< all measurements that are available on these heads
  /// One sentence for each limit of the config that the face violates.
  std::vector<std::string> warnings;
};

/// A job that the user edits on the page: prepared heads, the existing crowd, and the data that the
/// page shows. Const member functions are thread-safe.
class EditSession {
 public:
  /// \param cache             the folder of prepared heads
  /// \param preview_vertices  approximate maximum number of vertices of the preview mesh
  EditSession(Job job, const CacheFolder& cache, std::size_t preview_vertices);
  EditSession(const EditSession&) = delete;
  EditSession& operator=(const EditSession&) = delete;

  const Job& job() const { return job_; }
  const CastingOptions& casting() const { return casting_; }
  /// The faces of the plan in the job's output folder; null if there is no plan or if the plan was
  /// made with other settings.
  const std::vector<FacePlan>* crowd() const { return crowd_ ? &*crowd_ : nullptr; }
  /// The mesh that the page shows. It has fewer triangles than the mesh of a face.
  const PreviewMesh& preview() const { return preview_; }
  /// The atlas with the heads' textures. The preview's texture coordinates refer to this atlas.
  const TextureAtlas& textures() const { return textures_; }

  /// A description of the job as JSON, which the page loads before all other data.
  nlohmann::ordered_json description() const;
  /// Triangles, colours, masks and texture coordinates of the preview, as a BinaryAnswer.
  std::string mesh_answer() const;
  /// Ambient light at the preview's vertices, computed on the mean head: for each vertex, the
  /// square root of the visible fraction of the sky. Returns a BinaryAnswer. Waits until the
  /// computation is finished.
  std::string ambient_light_answer() const;
  /// A BinaryAnswer with a head's positions at the preview's vertices, the head's vector fields,
  /// and the values of the level functions of these fields (see HeadSmoothing).
  std::string head_answer(Index head) const;

  /// The region masks for blending; zero at vertices of components that are not skin.
  const RegionWeights& masks() const { return builder_.regions(); }
  /// Replaces the region masks for blending. Distances, warnings and sampled faces still use the
  /// masks of the config. Call this only while no other thread builds faces or reads masks.
  void use_masks(const RegionWeights& masks);

  /// All vertex positions of a face, equal to the positions in a saved mesh. Fast if the face
  /// differs in few regions from the face of the previous call.
  Positions build(const Recipe& recipe) const;
  /// Measures a face from the recipe, without building the mesh. Therefore does not check gaps,
  /// such as the gap between the lips.
  /// \param opened_id  id of the crowd's face from which the edit began, or empty
  FaceMeasures measure(const FacePlan& recipe, const std::string& opened_id = "") const;
  /// Measures a face like the other overload, but also checks, on the face's mesh, gaps between
  /// parts of the skin, such as the gap between the lips.
  /// \param face  all vertex positions of the face, from `build`
  FaceMeasures measure(const FacePlan& recipe, const Positions& face,
                       const std::string& opened_id = "") const;
  /// Finds visible faults in the whole mesh of a face; see MeshFaults.
  /// \param face  all vertex positions of the face, from `build`
  std::vector<std::string> mesh_faults(const Recipe& recipe, const Positions& face) const {
    return faults_.faults_of(recipe, face);
  }
  /// Root mean square distance between two faces, in mm.
  double distance_mm(const FacePlan& one, const FacePlan& other) const;
  /// Changes the weights with which a face is blended from the heads, so that the measurement
  /// `trait` comes as near to the value `wanted` as the heads allow; see steer_trait. Returns the
  /// changed face.
  /// \param locked_bands  bands of detail whose weights do not change, indexed as in
  ///                      SampleRequest::locked_bands
  /// \throws UsageError if the measurement is not available, or if the config has
  ///         Normalization::kPrinted. (With kPrinted, a face cannot have weights of its own: a
  ///         position on the weight plane determines the weights.)
  FacePlan steer(FacePlan face, const std::string& trait, double wanted,
                 const std::vector<std::size_t>& locked_bands) const;
  /// Samples random faces, from which the user chooses one. Calls the free function `sample_faces`
  /// of editor/sample_faces.h.
  std::vector<FacePlan> sample_faces(const SampleRequest& request) const;
  /// Unit normals of the full-resolution mesh at the preview's vertices: three numbers for each
  /// preview vertex.
  /// \param face  all vertex positions of the face, from `build`
  std::vector<float> preview_normals(const Positions& face) const;
  /// Roughness of a face at the preview's vertices, 0 … 255 for the range 0 … 1; empty if there is
  /// no roughness map.
  std::vector<std::uint8_t> preview_roughness(const TextureSet& texture_set) const;
  /// Positions of the preview's vertices on a face: three numbers for each preview vertex.
  /// \param face  all vertex positions of the face, from `build`
  std::vector<float> preview_points(const Positions& face) const;

 private:
  /// The data for comparing faces and checking them for defects. The computation takes about a
  /// second, so a separate thread computes these data while the page loads.
  struct JudgingData {
    std::unique_ptr<const CastingSpace> space;
    FaceJudge judge;
    NearestFaceSearch crowd_search;            ///< the faces of crowd(), in the same order
    std::unique_ptr<const FaceTraits> traits;  ///< null if no measurement is available
  };
  JudgingData make_judging_data() const;
  /// Finds the nearest face of the crowd, except the faces with the ids `recipe.id` and
  /// `opened_id`.
  /// \param opened_id  id of the crowd's face from which the edit began, or empty
  NearestFaceSearch::NearestFace nearest_other_face(const FaceSpace::Point& point,
                                                    const FacePlan& recipe,
                                                    const std::string& opened_id) const;
  /// The part of description() about the regions.
  nlohmann::ordered_json regions_json() const;
  /// The face that the page shows first: the first face of the crowd. If there is no crowd, all
  /// regions are at the first head's anchor.
  FacePlan first_face() const;
  /// Returns for each head the data from which the page computes the head's shape at any smoothing
  /// level: displacement fields and their level functions.
  std::vector<HeadSmoothing> preview_levels() const;

  Job job_;  ///< the config, the input heads with their textures, and the smoothing operator
  TextureAtlas textures_;
  /// The preview mesh. A separate thread computes the preview mesh while the following members are
  /// constructed.
  std::future<PreviewMesh> preview_future_;
  std::optional<std::vector<FacePlan>> crowd_;  ///< the faces of the existing plan; see crowd()
  PreparedHeads prepared_;                      ///< the heads, prepared for blending
  /// Set only with `levels: exact`: the heads prepared with `levels: basis`, because the page needs
  /// displacement fields.
  std::optional<PreparedHeads> preview_prepared_;
  FaceBuilder builder_;
  MeshFaults faults_;
  mutable std::mutex previous_face_mutex_;
  /// The face of the previous call of `build`. The next call recomputes only the parts of the face
  /// that differ from this face.
  mutable FaceBuilder::PreviousFace previous_face_;
  std::shared_future<JudgingData> judging_data_;
  CastingOptions casting_;  ///< inputs of casting, made from the config
  PreviewMesh preview_;
  VertexFaces vertex_faces_;  ///< for each vertex of the heads: the polygons at this vertex
  /// For each preview vertex: the visible fraction of the sky, for ambient occlusion. The
  /// computation takes about a second.
  std::shared_future<std::vector<float>> sky_visibility_;
};

}  // namespace crowdface
