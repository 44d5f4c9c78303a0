// SPDX-License-Identifier: Apache-2.0
#include "crowdface/shapes/frame_field.h"

#include <algorithm>
#include <limits>

#include <Eigen/Geometry>

#include "crowdface/core/parallel.h"
#include "crowdface/core/selection.h"
#include "crowdface/core/smooth_step.h"
#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

// Lengths are fractions of the skin's extent, about 43 cm.
constexpr double kSpacing = 0.06;   // spacing of the nodes
constexpr double kInfluence = 0.1;  // radius of a node's influence
constexpr double kPatch = 0.1;      // radius of the patch that determines a node's map
/// A node's linear map is fitted to the patch of skin around the node. The fit also includes the
/// similarity transform of the whole skin, with a small weight. The weight is this fraction of the
/// patch's scatter (sum of squared distances from the patch's mean).
constexpr double kRegularisation = 0.02;
/// Maximum numbers of vertices: kMaxSkin in the fit of the whole skin, kMaxCandidates among which
/// nodes are chosen, kMaxPatch in the patch around a node.
constexpr std::size_t kMaxSkin = 4000, kMaxCandidates = 20000, kMaxPatch = 400;

/// Farthest-point sampling. Repeatedly adds the vertex that is farthest from the chosen vertices,
/// until every vertex is within `spacing` of a chosen vertex.
std::vector<std::uint32_t> farthest_points(const Positions& positions,
                                           std::span<const std::uint32_t> vertices,
                                           double spacing) {
  std::vector<double> nearest(vertices.size(), std::numeric_limits<double>::max());
  std::vector<std::uint32_t> chosen;
  for (std::size_t next = 0; nearest[next] > spacing;) {
    chosen.push_back(vertices[next]);
    const Eigen::Vector3d here = row3(positions, vertices[next]);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      nearest[i] = std::min(nearest[i], (row3(positions, vertices[i]) - here).norm());
    }
    next = static_cast<std::size_t>(std::ranges::max_element(nearest) - nearest.begin());
  }
  return chosen;
}

}  // namespace

Eigen::Matrix3d inverse3(const Eigen::Matrix3d& m) {
  const Eigen::Vector3d a = m.row(0).transpose(), b = m.row(1).transpose(),
                        c = m.row(2).transpose();
  const Eigen::Vector3d bc = b.cross(c), ca = c.cross(a), ab = a.cross(b);
  Eigen::Matrix3d inverse;
  inverse.col(0) = bc;
  inverse.col(1) = ca;
  inverse.col(2) = ab;
  return inverse / a.dot(bc);
}

FrameField::FrameField(const Positions& neutral, std::span<const std::uint32_t> skin, double extent,
                       std::span<const std::uint32_t> used)
    : neutral_(&neutral),
      sampled_skin_(evenly_spaced_items(skin, kMaxSkin)),
      equal_weights_(sampled_skin_.size(), 1.0) {
  const auto chosen =
      farthest_points(neutral, evenly_spaced_items(skin, kMaxCandidates), kSpacing * extent);
  nodes_.resize(chosen.size());
  parallel_for_each(chosen.size(), [&](std::size_t p) {
    const Eigen::Vector3d middle = row3(neutral, chosen[p]);
    std::vector<std::uint32_t> patch;
    for (const std::uint32_t v : skin) {
      if ((row3(neutral, v) - middle).norm() < kPatch * extent) patch.push_back(v);
    }
    nodes_[p] = node_at(neutral, evenly_spaced_items(patch, kMaxPatch), kPatch * extent, chosen[p]);
  });
  for (const std::uint32_t v : used) {
    std::vector<NodeWeight> shares;
    NodeWeight nearest{0, std::numeric_limits<double>::max()};
    double sum = 0;
    for (std::uint32_t p = 0; p < nodes_.size(); ++p) {
      const double distance = (row3(neutral, v) - nodes_[p].centre).norm();
      if (distance < nearest.weight) nearest = {p, distance};
      const double weight = biweight(std::min(1.0, distance / (kInfluence * extent)));
      if (weight > 0) shares.push_back({p, weight});
      sum += weight;
    }
    if (shares.empty()) shares.push_back({nearest.node, sum = 1});
    for (NodeWeight& share : shares) share.weight /= sum;
    node_weights_.add_group(shares);
  }
}

FrameField::Node FrameField::node_at(const Positions& neutral, std::span<const std::uint32_t> patch,
                                     double radius, std::uint32_t vertex) {
  Node node{row3(neutral, vertex), vertex, {}, {}};
  std::vector<double> weights;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double sum = 0;
  for (const std::uint32_t v : patch) {
    const Eigen::Vector3d from = row3(neutral, v) - node.centre;
    weights.push_back(biweight(std::min(1.0, from.norm() / radius)));
    mean += weights.back() * from;
    sum += weights.back();
  }
  mean /= sum;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < patch.size(); ++i) {
    const Eigen::Vector3d from = row3(neutral, patch[i]) - node.centre - mean;
    const Eigen::Vector3d weighted = weights[i] * from;
    spread += weighted * from.transpose();
  }
  // Regularise the fit towards the similarity transform of the whole skin, in proportion to the
  // patch's scatter.
  const double whole = kRegularisation * (spread(0, 0) + spread(1, 1) + spread(2, 2));
  if (!(whole > 0)) {
    node.similarity_weight_matrix = Eigen::Matrix3d::Identity();
    return node;
  }
  for (Index i = 0; i < 3; ++i) spread(i, i) += whole;
  const Eigen::Matrix3d inverse = inverse3(spread);
  node.similarity_weight_matrix = whole * inverse;
  for (std::size_t i = 0; i < patch.size(); ++i) {
    const Eigen::Vector3d from = row3(neutral, patch[i]) - node.centre - mean;
    node.samples.push_back({patch[i], weights[i] * multiply3(inverse, from)});
  }
  return node;
}

FrameField::Frames FrameField::frames(const Positions& face) const {
  Frames frames{fit_rigid_motion(*neutral_, face, sampled_skin_, equal_weights_), {}};
  frames.node_maps.resize(nodes_.size());
  for (std::size_t p = 0; p < nodes_.size(); ++p) {
    const Node& node = nodes_[p];
    Eigen::Matrix3d& map = frames.node_maps[p];
    for (Index c = 0; c < 3; ++c)
      map.col(c) = frames.face_motion.apply_to_direction(node.similarity_weight_matrix.col(c));
    // Use positions relative to the node's vertex, so that rounding does not depend on where the
    // face lies in space.
    const Eigen::Vector3d origin = row3(face, node.vertex);
    for (const Sample& sample : node.samples) {
      const Eigen::Vector3d from = row3(face, sample.vertex) - origin;
      map += from * sample.weight_vector.transpose();
    }
  }
  return frames;
}

Eigen::Matrix3d FrameField::map_at(std::size_t i, const Frames& frames) const {
  Eigen::Matrix3d map = Eigen::Matrix3d::Zero();
  for (const NodeWeight& share : node_weights_.items_of(i))
    map += share.weight * frames.node_maps[share.node];
  return map;
}

}  // namespace crowdface
