// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/load_transferred.h"
#include "crowdface/io/gltf_rig.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/component_shape.h"
#include "crowdface/parts/point_grid.h"

namespace crowdface {
namespace {

/// Maximum distance between a vertex of the rig and the same vertex of the template, as a fraction
/// of the template's extent: 0.1 mm on a head.
constexpr double kSame = 2e-4;
constexpr double kMmPerMetre = 1000;

/// The transform from the axes and unit of the rig file (the axes of glTF or of the exporting
/// program) to the heads' axes and unit.
struct Frame {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  double scale = 1;

  Eigen::Vector3d place(const Eigen::Vector3d& p) const { return scale * direction(p); }
  Eigen::Vector3d direction(const Eigen::Vector3d& d) const {
    return d.x() * turn.col(0) + d.y() * turn.col(1) + d.z() * turn.col(2);
  }
};

Frame from_gltf(const Config::Faces& faces) {
  const Eigen::Vector3d up = unit_vector(faces.up), front = unit_vector(faces.front);
  Frame frame;
  frame.turn.col(0) = up.cross(front);
  frame.turn.col(1) = up;
  frame.turn.col(2) = front;
  frame.scale = kMmPerMetre / mm_per(faces.units);
  return frame;
}

Positions in_frame(const Frame& frame, const Positions& points) {
  Positions placed(points.rows(), 3);
  for (Index p = 0; p < points.rows(); ++p) {
    placed.row(p) = frame.place(row3(points, p)).transpose();
  }
  return placed;
}

/// For each vertex of the heads, the matching vertex of the rig.
struct Match {
  std::vector<std::uint32_t> points;
  std::size_t missing = 0;
  double farthest = 0;  ///< largest distance between an unmatched vertex and its nearest rig vertex
};

Match match_by_id(const GltfRig& rig, Index vertices) {
  Match match{std::vector<std::uint32_t>(static_cast<std::size_t>(vertices), kNoIndex)};
  for (std::uint32_t p = 0; p < rig.vertex_ids.size(); ++p) {
    const std::uint32_t id = rig.vertex_ids[p];
    if (id < match.points.size() && match.points[id] == kNoIndex) match.points[id] = p;
  }
  match.missing =
      static_cast<std::size_t>(std::count(match.points.begin(), match.points.end(), kNoIndex));
  return match;
}

Match match_by_place(const PointGrid& grid, const Positions& mesh, double reach) {
  Match match;
  for (Index v = 0; v < mesh.rows(); ++v) {
    const PointGrid::NearestVertex nearest = grid.nearest(row3(mesh, v));
    match.points.push_back(nearest.vertex);
    if (nearest.distance <= reach) continue;
    ++match.missing;
    match.farthest = std::max(match.farthest, nearest.distance);
  }
  return match;
}

/// The rig's mesh in the heads' coordinate frame, matched to the heads' vertices.
struct Fit {
  Frame frame;
  Match match;
  Positions mesh;  ///< #V by 3: the rig's mesh at rest, in the heads' frame and vertex order
};

Fit fit_by_id(const GltfRig& rig, const Config& config, const Inputs& inputs) {
  Fit fit{from_gltf(config.faces), match_by_id(rig, inputs.head_set.topology.vertex_count), {}};
  if (fit.match.missing > 0) {
    refuse_file(config.rig,
                concat("its _VERTEX_ID lacks ", fit.match.missing, " of the ",
                       inputs.head_set.topology.vertex_count,
                       " vertices of the heads; does the file contain the whole mesh?"));
  }
  fit.mesh.resize(inputs.head_set.topology.vertex_count, 3);
  for (Index v = 0; v < fit.mesh.rows(); ++v) {
    const std::uint32_t point = fit.match.points[static_cast<std::size_t>(v)];
    fit.mesh.row(v) = fit.frame.place(row3(rig.positions, point)).transpose();
  }
  return fit;
}

Fit fit_by_place(const GltfRig& rig, const Config& config, const Inputs& inputs) {
  std::vector<const Positions*> meshes;
  if (config.shapes.heads_directory.empty() && !config.shapes.neutral.empty()) {
    meshes.push_back(&inputs.shapes.neutral);
  }
  for (const Head& head : inputs.head_set.heads) meshes.push_back(&head.positions);
  std::vector<std::uint32_t> all(static_cast<std::size_t>(rig.positions.rows()));
  std::iota(all.begin(), all.end(), 0U);
  std::vector<std::uint32_t> vertices(
      static_cast<std::size_t>(inputs.head_set.topology.vertex_count));
  std::iota(vertices.begin(), vertices.end(), 0U);
  Fit best;
  for (const Frame& frame : {from_gltf(config.faces), Frame()}) {
    const Positions points = in_frame(frame, rig.positions);
    const PointGrid grid(points, all);
    for (const Positions* mesh : meshes) {
      Match match = match_by_place(grid, *mesh, kSame * extent_of(*mesh, vertices));
      if (best.mesh.rows() > 0 && match.missing >= best.match.missing) continue;
      best = {frame, std::move(match), *mesh};
      if (best.match.missing == 0) return best;
    }
  }
  refuse_file(config.rig,
              concat(best.match.missing, " of the ", best.mesh.rows(),
                     " vertices of the heads match no vertex of its meshes (one is ",
                     format_fixed(best.match.farthest * mm_per(config.faces.units), 1),
                     " mm off); expected the rig of the shapes' template or of a head, at rest"));
}

/// \throws InvalidInput unless the rig's mesh is about as large as the heads and close to them.
void require_near_heads(const Fit& fit, const Config& config, const Inputs& inputs) {
  constexpr double kMaxTimes = 2, kMaxOff = 10;
  const auto size_of = [](const Positions& mesh) {
    return (mesh.colwise().maxCoeff() - mesh.colwise().minCoeff()).norm();
  };
  const Positions& head = inputs.head_set.heads.front().positions;
  const double heads = size_of(head), size = size_of(fit.mesh);
  const double off = (fit.mesh.colwise().mean() - head.colwise().mean()).norm();
  if (size <= kMaxTimes * heads && heads <= kMaxTimes * size && off <= kMaxOff * heads) return;
  const double mm = mm_per(config.faces.units);
  refuse_file(config.rig, concat("in its rest pose, its mesh is ", format_fixed(size * mm, 1),
                                 " mm across and ", format_fixed(off * mm, 1),
                                 " mm off the heads, which are ", format_fixed(heads * mm, 1),
                                 " mm across; expected the rig of a head at rest (inverse bind "
                                 "matrices and joints define the place of the mesh)"));
}

/// A joint's axes in the heads' frame.
/// \throws InvalidInput if the axes have different lengths (non-uniform scale), are not orthogonal,
///         or are mirrored.
Eigen::Matrix3d joint_axes(const GltfRig::Joint& joint, const Frame& frame, const Config& config) {
  constexpr double kAlike = 1e-3;
  Eigen::Matrix3d axes;
  std::array<double, 3> lengths;
  for (Index c = 0; c < 3; ++c) {
    const Eigen::Vector3d axis = frame.direction(joint.rest_transform.col(c).head<3>());
    lengths[static_cast<std::size_t>(c)] = axis.norm();
    axes.col(c) = axis.normalized();
  }
  const auto [least, most] = std::minmax_element(lengths.begin(), lengths.end());
  const double turned = axes.col(0).cross(axes.col(1)).dot(axes.col(2));
  if (!(*least > 0) || *most > (1 + kAlike) * *least || std::abs(turned - 1) > kAlike) {
    refuse_file(config.rig, concat("the joint ", quoted(joint.name),
                                   " is scaled non-uniformly, mirrored or sheared; expected a rig "
                                   "with its scale applied"));
  }
  return axes;
}

Rig bind(const GltfRig& file, Fit fit, const Config& config) {
  Rig rig;
  const auto count = static_cast<Index>(file.joints.size());
  Positions places(count, 3);
  for (std::size_t j = 0; j < file.joints.size(); ++j) {
    const GltfRig::Joint& joint = file.joints[j];
    rig.skin.joints.push_back({joint.name, joint.parent, joint_axes(joint, fit.frame, config)});
    rig.points.names.push_back(joint.name);
    places.row(static_cast<Index>(j)) =
        fit.frame.place(joint.rest_transform.col(3).head<3>()).transpose();
  }
  for (const std::uint32_t point : fit.match.points) {
    rig.skin.influences.add_group(file.influences.items_of(point));
  }
  rig.points.positions = {std::move(places)};
  rig.points.meshes = {std::move(fit.mesh)};
  return rig;
}

Digest digest_of_rig(const Rig& rig) {
  Hasher hasher;
  for (const GlbJoint& joint : rig.skin.joints) {
    hasher.add(joint.name).add(joint.parent);
    hasher.add_array(numbers_of(joint.rotation));
  }
  for (const Influence& one : rig.skin.influences.items) {
    hasher.add(one.joint).add(static_cast<double>(one.weight));
  }
  hasher.add_array(std::span(rig.skin.influences.offsets));
  hasher.add_array(numbers_of(rig.points.positions.front()));
  return hasher.add_array(numbers_of(rig.points.meshes.front())).digest();
}

}  // namespace

void load_rig(const Config& config, Inputs& inputs, Problems& problems) {
  if (config.rig.empty()) return;
  try {
    constexpr std::size_t kMaxJoints = 65535;
    const GltfRig file = read_gltf_rig(config.rig);
    if (file.joints.size() > kMaxJoints) {
      refuse_file(config.rig,
                  concat("expected at most ", kMaxJoints, " joints, found ", file.joints.size()));
    }
    Fit fit = file.vertex_ids.empty() ? fit_by_place(file, config, inputs)
                                      : fit_by_id(file, config, inputs);
    require_near_heads(fit, config, inputs);
    inputs.rig = bind(file, std::move(fit), config);
    inputs.rig.digest = digest_of_rig(inputs.rig);
  } catch (const RecoverableError& error) {
    problems.add(error);
  }
}

}  // namespace crowdface
