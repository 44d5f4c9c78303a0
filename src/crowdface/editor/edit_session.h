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
#include "crowdface/cast/face_point_index.h"
#include "crowdface/editor/draw_faces.h"
#include "crowdface/editor/texture_atlas.h"
#include "crowdface/heads/cache_folder.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/preview/preview_mesh.h"
#include "crowdface/run/casting.h"
#include "crowdface/run/face_builder.h"
#include "crowdface/run/pipeline.h"

namespace crowdface {

/// \param given  a config, or a crowd's folder: the config in it, whose faces go there.
Job load_edited_job(const std::filesystem::path& given, ConfigOverrides overrides,
                    const CacheFolder& cache);

/// What an editor says about a face beside its shape.
struct FaceMeasures {
  Index head = 0;  ///< the input head nearest to it
  double head_mm = 0;
  std::optional<std::size_t> face;  ///< the nearest of the crowd, itself left out
  double face_mm = 0;
  std::vector<std::string> warnings;  ///< limits of the config that it goes beyond, a sentence each
};

/// A job that is edited by hand: heads ready to be blended, the crowd that there is, and what the page
/// shows of both. All may be asked from several threads at once.
class EditSession {
 public:
  /// \param cache             the folder of prepared heads
  /// \param preview_vertices  about how many the page shows at most
  EditSession(Job job, const CacheFolder& cache, std::size_t preview_vertices);
  EditSession(const EditSession&) = delete;
  EditSession& operator=(const EditSession&) = delete;

  const Job& job() const { return job_; }
  const Casting& casting() const { return casting_; }
  const std::vector<CastFace>* crowd() const { return crowd_ ? &*crowd_ : nullptr; }
  const PreviewMesh& preview() const { return preview_; }
  /// The heads' textures as the preview's coordinates show them.
  const TextureAtlas& textures() const { return textures_; }

  /// What the page has to know before anything else.
  nlohmann::ordered_json description() const;
  /// Triangles, colours, masks and texture coordinates of the preview, as a BinaryAnswer.
  std::string mesh() const;
  /// The positions of a head at the preview's vertices, its fields and their functions, likewise.
  std::string head(Index head) const;

  /// The masks that faces are blended with: zero at parts that are no skin.
  const RegionWeights& masks() const { return builder_.regions(); }
  /// Faces are blended with other masks from now on; distances, warnings and what is drawn go by the
  /// config's. Not while another thread builds or reads masks.
  void use_masks(const RegionWeights& masks);

  /// Every point of a face, as it would be saved. Quick where the face before it differs in few regions.
  Positions build(const Recipe& recipe) const;
  /// Takes no mesh, and tells no gaps between parts.
  FaceMeasures measure(const CastFace& recipe) const;
  /// \param face  what `build` gave
  FaceMeasures measure(const CastFace& recipe, const Positions& face) const;
  /// See draw_faces.
  std::vector<CastFace> draw(const DrawRequest& request) const;
  /// Unit normals of the whole mesh at the preview's vertices, #preview by 3.
  std::vector<float> normals(const Positions& face) const;
  /// Positions at the preview's vertices, #preview by 3.
  std::vector<float> points(const Positions& face) const;

 private:
  /// What faces are compared and judged in; takes a second, so that the page need not wait for it.
  struct Judging {
    std::unique_ptr<const CastingSpace> where;
    FaceJudge judge;
    FacePointIndex crowd;
  };
  Judging judging() const;
  nlohmann::ordered_json regions_json() const;
  CastFace first_face() const;
  std::vector<HeadLevels> preview_levels() const;

  Job job_;
  TextureAtlas textures_;
  std::future<PreviewMesh> reducing_;  ///< beside what follows
  std::optional<std::vector<CastFace>> crowd_;
  Prepared prepared_;
  std::optional<Prepared> fitted_;  ///< `levels: exact`: fields for the preview alone
  FaceBuilder builder_;
  mutable std::mutex kept_mutex_;
  mutable FaceBuilder::Kept kept_;
  std::shared_future<Judging> judging_;
  Casting casting_;
  PreviewMesh preview_;
  FacesAround around_;
};

}  // namespace crowdface
