// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "crowdface/cast/attachment_sampling.h"
#include "crowdface/cast/cast_crowd.h"
#include "crowdface/cast/crowd_statistics.h"
#include "crowdface/heads/face_attachments.h"
#include "crowdface/run/face_builder.h"
#include "crowdface/run/job.h"
#include "crowdface/run/trait_reports.h"

namespace crowdface {

/// The vector space in which casting compares faces, and the coarse skin mesh on which casting
/// checks faces for defects.
struct CastingSpace {
  FaceSpace face_space;  ///< the vector space
  ProxySkin proxy_skin;  ///< the coarse skin mesh
};
/// Computes the casting space of a config.
/// \param cache  folder that caches the precomputed tables of the space; empty: no cache
CastingSpace casting_space(const Config& config, const Inputs& inputs,
                           const PreparedHeads& prepared, const std::filesystem::path& cache);

/// Converts the config to casting options.
/// \param head_distances  #heads by #heads: distance between each pair of heads
CastingOptions casting_options(const Config& config, const Inputs& inputs,
                               const Eigen::MatrixXd& head_distances);

/// Distances, in millimetres, between the faces of a crowd and, for comparison, between the input
/// heads.
struct CrowdDistances {
  Quartiles between_heads;  ///< distances between input heads
  Quartiles between_faces;  ///< distances between faces of the crowd
  /// for each region: distances between the faces, measured in this region only. Empty if there is
  /// only one region.
  std::vector<Quartiles> between_faces_by_region;
  /// distances from each face to the nearest head, and to the nearest face that was cast earlier
  Quartiles to_nearest_head, to_nearest_face;
  /// median of `between_faces` divided by the median of `between_heads`; 0 if there are no heads to
  /// compare
  double face_to_head_median_ratio = 0;
};

/// Statistics of one family: how similar the members are to each other, to the founder, to their
/// parents and to other faces.
struct FamilyReport {
  std::string name;
  std::uint64_t member_count = 0;
  Quartiles member_distances;   ///< distances between the members of the family
  Quartiles founder_distances;  ///< distances from the members to the founder
  /// smallest distance from a member to a face outside the family; 0 if there is no such face
  double nearest_outsider_mm = 0;
  /// how clearly the members differ from all other faces, see mean_silhouette_coefficient
  double silhouette_coefficient = 0;
  /// Strangers are random faces, sampled with the settings of the family's group. For each child
  /// and each of its parents, casting computes the fraction of strangers that are nearer to the
  /// child than the parent is. This is the largest of these fractions; empty if the family has no
  /// parents.
  std::optional<double> fraction_of_strangers_nearer_than_parent;
};

/// The result of casting: the faces of a crowd, and the heads' positions on the weight plane. The
/// position of a face's region on this plane determines the weights of the heads in the region.
struct CrowdPlan {
  std::vector<PlanePoint> anchors;  ///< #heads: position of each head on the weight plane
  std::vector<FacePlan> crowd;  ///< the faces, each with its nearest head and nearest earlier face
  std::vector<int> group_of_face;  ///< one per sampled face: index of its group, or −1
  RejectionCounts rejections;      ///< how often each constraint rejected a candidate face
  CrowdDistances distances;
  std::vector<FamilyReport> families;  ///< one report per family
  std::vector<TraitReport> traits;     ///< reports on the measurements that the config names
  std::vector<FacePlan> founders;  ///< founders of families: hidden faces, not part of the crowd
  std::vector<FacePlan> rejected;  ///< faces that reviews rejected
  /// the point of each face in the casting space; empty if the config has neither contact sheets
  /// nor groups
  std::vector<FaceSpace::Point> points;
};

/// Converts the config to options for choosing the attachments of a crowd.
AttachmentOptions attachment_options(const Config& config);

/// Chooses the recipes of all faces ("casts" the crowd).
/// \param builder      returns the builder of the job's faces; called only if casting builds meshes
/// \param attachments  places haircuts on faces, to measure how much of the irises they cover
/// \param cache        see casting_space
/// \throws Unsatisfiable if the constraints cannot be met; the message names the constraint that
///     prevented more faces, the number of faces that were cast, and a change that would help.
CrowdPlan plan_crowd(const Config& config, const Inputs& inputs, const PreparedHeads& prepared,
                     const std::function<const FaceBuilder&()>& builder,
                     FaceAttachments& attachments, const std::filesystem::path& cache);

}  // namespace crowdface
