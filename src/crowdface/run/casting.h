// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "crowdface/cast/attachment_draw.h"
#include "crowdface/cast/cast_crowd.h"
#include "crowdface/cast/crowd_statistics.h"
#include "crowdface/run/pipeline.h"

namespace crowdface {

/// Where faces are compared and judged.
struct CastingSpace {
  FaceSpace space;
  ProxySkin skin;
};
/// \param cache  where the tables of the space are kept; empty: nowhere.
CastingSpace casting_space(const Config& config, const Inputs& inputs, const Prepared& prepared,
                           const std::filesystem::path& cache);

/// What casting is to do, from the config.
Casting casting_of(const Config& config, const Inputs& inputs,
                   const Eigen::MatrixXd& head_distances);

/// The distances of a crowd beside those of its heads.
struct CrowdDistances {
  Quartiles heads;                 ///< between input heads
  Quartiles crowd;                 ///< between faces of the crowd
  std::vector<Quartiles> regions;  ///< the same over each region, if there are several
  Quartiles to_nearest_head, to_nearest_face;
  double ratio = 0;  ///< of the medians, crowd to heads; 0 if there are none to compare
};

/// How alike a family is.
struct FamilyReport {
  std::string name;
  std::uint64_t members = 0;
  Quartiles within;             ///< between members
  Quartiles to_founder;         ///< of each member
  double nearest_other_mm = 0;  ///< from any member to anyone else; 0 if there is nobody
  double silhouette = 0;
  std::optional<double> strangers_nearer;  ///< with parents: than one of them to a child, a share
};

/// A crowd cast: where the heads stand on the plane, and its faces.
struct Cast {
  std::vector<PlanePoint> anchors;  ///< #heads
  std::vector<CastFace> crowd;      ///< with their nearest neighbours
  std::vector<int> kinds;           ///< group of each sampled face, or −1
  Rejections rejections;
  CrowdDistances distances;
  std::vector<FamilyReport> families;
  std::vector<CastFace> founders;  ///< hidden heads of families, who are not in the crowd
  std::vector<CastFace> rejected;  ///< by reviews
  std::vector<FaceSpace::Point>
      points;  ///< of each face of the crowd; none if there are neither sheets nor groups
};

/// What may sit on the faces of a config's crowd.
AttachmentDraw attachment_draw(const Config& config);

/// Casts the crowd.
/// \param defects  what is wrong with a candidate's whole mesh; none: meshes are not judged.
/// \param cache    as of casting_space.
/// \throws Unsatisfiable if the constraints cannot be met: which one binds, how far it went, and what
/// would help.
Cast cast(const Config& config, const Inputs& inputs, const Prepared& prepared,
          const MeshDefects& defects, const std::filesystem::path& cache);

}  // namespace crowdface
