// SPDX-License-Identifier: Apache-2.0
// Synthetic heads that blink, smile and look aside.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/rigid_motion.h"
#include "crowdface/shapes/shape_transfer.h"
#include "head_models/synth/synthetic_head.h"

namespace crowdface::testing {

using Eigen::Vector3d;

inline constexpr double kExtent = 43;

/// Heads of one topology, and what they consist of.
struct Heads {
  HeadSet faces;
  Adjacency adjacency;
  Components components;
  PartList parts;

  explicit Heads(HeadSet set)
      : faces(std::move(set)),
        adjacency(build_adjacency(faces.topology)),
        components(find_components(adjacency)),
        parts(find_parts(faces.topology, adjacency, components, mean_head(faces))) {}
  const Positions& operator[](std::size_t i) const { return faces.heads[i].positions; }
  std::vector<const Part*> eyes() const {
    std::vector<const Part*> eyes;
    for (const Part& part : parts.parts) {
      if (part.is_eyeball) eyes.push_back(&part);
    }
    return eyes;
  }
};

inline Heads synthetic_heads() {
  const SyntheticHeads synthetic(5000, SyntheticHeads::Parts::kEyesAndTeeth);
  HeadSet set{synthetic.topology(), synthetic.uvs(), {}};
  for (const std::uint64_t i : {0, 1, 2, 3, 4, 5}) {
    set.heads.push_back({"head" + std::to_string(i), synthetic.positions(5, i)});
  }
  return Heads(std::move(set));
}

inline bool is_skin(const Heads& heads, Index v) {
  return heads.components.component_of_vertex[static_cast<std::size_t>(v)] ==
         heads.components.largest();
}

/// An eye's centre and radius on a head: those on the mean head, carried there.
inline std::pair<Vector3d, double> ball_of(const Heads& heads, const Part& eye,
                                           const Positions& head) {
  const ComponentShape& ball = heads.parts.shapes[eye.ball_component];
  const RigidMotion motion = fit_rigid_motion(mean_head(heads.faces), head, eye.vertices,
                                              std::vector<double>(eye.vertices.size(), 1.0));
  return {motion.apply(ball.centre), motion.scale * ball.radius};
}

/// The rims of the lids in front of an eye: the highest vertex of the lower lid and the lowest of the
/// upper one in each of some columns.
struct Rims {
  std::vector<std::uint32_t> low, high;
};

inline Rims rims_of(const Heads& heads, const Part& eye, const Positions& head) {
  const auto [centre, radius] = ball_of(heads, eye, head);
  constexpr int kColumns = 9;
  Rims rims{std::vector<std::uint32_t>(kColumns, kNoIndex),
            std::vector<std::uint32_t>(kColumns, kNoIndex)};
  for (Index v = 0; v < head.rows(); ++v) {
    const Vector3d from = (row3(head, v) - centre) / radius;
    if (!is_skin(heads, v) || from.z() < 0.6 || std::abs(from.x()) > 0.7 || from.norm() > 1.6)
      continue;
    const auto column = static_cast<std::size_t>((from.x() + 0.7) / 1.4 * kColumns);
    const auto row = static_cast<std::uint32_t>(v);
    if (column >= kColumns) continue;
    std::uint32_t& low = rims.low[column];
    std::uint32_t& high = rims.high[column];
    if (from.y() < 0 && (low == kNoIndex || head(v, 1) > head(low, 1))) low = row;
    if (from.y() >= 0 && (high == kNoIndex || head(v, 1) < head(high, 1))) high = row;
  }
  for (std::size_t i = kColumns; i-- > 0;) {
    if (rims.low[i] != kNoIndex && rims.high[i] != kNoIndex) continue;
    rims.low.erase(rims.low.begin() + static_cast<std::ptrdiff_t>(i));
    rims.high.erase(rims.high.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return rims;
}

/// The upper lid comes down onto the lower one, around the eyeball.
inline Positions blinking(const Heads& heads, const Part& eye, const Positions& head) {
  const auto [centre, radius] = ball_of(heads, eye, head);
  const Rims rims = rims_of(heads, eye, head);
  Positions result = head;
  for (Index v = 0; v < head.rows(); ++v) {
    const Vector3d from = row3(head, v) - centre;
    if (!is_skin(heads, v) || from.z() < 0 || from.norm() > 2.5 * radius) continue;
    double weights = 0, low = 0, high = 0;
    for (std::size_t i = 0; i < rims.low.size(); ++i) {
      const double off = (head(v, 0) - (head(rims.low[i], 0) + head(rims.high[i], 0)) / 2) / radius;
      const double weight = std::exp(-60 * off * off) + 1e-9;
      weights += weight;
      low += weight * head(rims.low[i], 1);
      high += weight * head(rims.high[i], 1);
    }
    low /= weights;
    high /= weights;
    if (head(v, 1) < (low + high) / 2) continue;
    const double off = std::max(0.0, head(v, 1) - high) / radius;
    const double aside = std::max(0.0, std::abs(from.x()) - 0.7 * radius) / radius;
    const double share = std::exp(-off * off - 4 * aside * aside);
    const Vector3d down = from - Vector3d(0, share * (high - low), 0);
    result.row(v) = (centre + down * (from.norm() / down.norm())).transpose();
  }
  return result;
}

/// One corner of the mouth goes up.
inline Positions smiling(const Heads& heads, const Positions& head) {
  Positions result = head;
  for (Index v = 0; v < head.rows(); ++v) {
    if (!is_skin(heads, v)) continue;
    const Vector3d from = row3(head, v) - Vector3d(4, -4, 6);
    const double share = std::exp(-from.squaredNorm() / 6);
    if (share > 0.01) result.row(v) += share * Eigen::RowVector3d(0.5, 0.7, -0.2);
  }
  return result;
}

inline Positions with_gaze(const Heads& heads, const Part& eye, const Positions& head,
                           double angle) {
  const Vector3d centre = ball_of(heads, eye, head).first;
  Positions result = head;
  for (const std::uint32_t v : eye.vertices) {
    const Vector3d from = row3(head, v) - centre;
    result.row(v) =
        (centre + Vector3d(std::cos(angle) * from.x() + std::sin(angle) * from.z(), from.y(),
                           std::cos(angle) * from.z() - std::sin(angle) * from.x()))
            .transpose();
  }
  return result;
}

inline ShapeSet shapes_of(const Heads& heads, const Positions& neutral) {
  ShapeSet set{neutral, {}};
  const auto eyes = heads.eyes();
  const auto add = [&](const char* name, const Positions& mesh) {
    set.shapes.push_back(make_shape(name, neutral, mesh, kExtent));
  };
  add("blink", blinking(heads, *eyes.at(0), neutral));
  add("smile", smiling(heads, neutral));
  add("gaze", with_gaze(heads, *eyes.at(0), neutral, 0.3));
  add("nothing", neutral);
  return set;
}

}  // namespace crowdface::testing
