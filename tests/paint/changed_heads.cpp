// SPDX-License-Identifier: Apache-2.0
#include "paint/changed_heads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include <Eigen/Geometry>

#include "crowdface/core/text.h"
#include "crowdface/mesh/triangles.h"

namespace crowdface::testing {
namespace {

/// A changed copy of a head.
struct Changed {
  std::string what;
  Topology topology;
  HeadShape head;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
};

/// Vertices of each cell of a grid become one.
/// \param cell_at  the size of cells about a place
template <class CellAt>
Changed thinned(const char* what, const Topology& topology, const HeadShape& head,
                const CellAt& cell_at) {
  std::map<std::array<int, 3>, std::uint32_t> cells;
  std::vector<std::uint32_t> place;
  std::vector<Eigen::RowVector3d> sums;
  std::vector<double> counts;
  Changed result{what, {}, {}};
  for (Index v = 0; v < head.positions.rows(); ++v) {
    const Eigen::RowVector3d p = head.positions.row(v);
    const double cell = cell_at(p);
    const std::array<int, 3> key = {static_cast<int>(std::floor(p.x() / cell)) +
                                        (head.is_skin[static_cast<std::size_t>(v)] ? 0 : 1000),
                                    static_cast<int>(std::floor(p.y() / cell)),
                                    static_cast<int>(std::floor(p.z() / cell))};
    const auto at = cells.try_emplace(key, static_cast<std::uint32_t>(cells.size())).first->second;
    place.push_back(at);
    if (at == sums.size()) {
      sums.emplace_back(0, 0, 0);
      counts.push_back(0);
      result.head.is_skin.push_back(head.is_skin[static_cast<std::size_t>(v)]);
    }
    sums[at] += p;
    ++counts[at];
  }
  result.head.positions.resize(static_cast<Index>(sums.size()), 3);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    result.head.positions.row(static_cast<Index>(i)) = sums[i] / counts[i];
  }
  std::vector<Triangle> triangles;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto face = topology.face(f);
    for (std::size_t c = 2; c < face.size(); ++c) {
      const Triangle t = {place[face[0]], place[face[c - 1]], place[face[c]]};
      if (t[0] != t[1] && t[1] != t[2] && t[0] != t[2]) triangles.push_back(t);
    }
  }
  result.topology = topology_of(triangles, result.head.positions.rows());
  return result;
}

/// The faces of a head that `keep` wants, by their middle.
template <class Keep>
Changed cut(const char* what, const Topology& topology, const HeadShape& head, const Keep& keep) {
  std::vector<Triangle> triangles;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto face = topology.face(f);
    for (std::size_t c = 2; c < face.size(); ++c) {
      const Triangle t = {face[0], face[c - 1], face[c]};
      const Eigen::Vector3d middle =
          (head.positions.row(t[0]) + head.positions.row(t[1]) + head.positions.row(t[2]))
              .transpose() /
          3;
      if (keep(middle)) triangles.push_back(t);
    }
  }
  return {what, topology_of(triangles, head.positions.rows()), head};
}

/// Each triangle becomes four.
Changed refined(const Topology& topology, const HeadShape& head) {
  std::vector<Eigen::RowVector3d> middles;
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> of_edge;
  Changed result{"refined", {}, head};
  const auto middle_of_edge = [&](std::uint32_t a, std::uint32_t b) {
    const auto next = static_cast<std::uint32_t>(head.is_skin.size() + middles.size());
    const auto [place, is_new] = of_edge.try_emplace({std::min(a, b), std::max(a, b)}, next);
    if (is_new) {
      middles.emplace_back((head.positions.row(a) + head.positions.row(b)) / 2);
      result.head.is_skin.push_back(head.is_skin[a]);
    }
    return place->second;
  };
  std::vector<Triangle> triangles;
  for (const Triangle& t : triangles_of(topology)) {
    const std::uint32_t ab = middle_of_edge(t[0], t[1]), bc = middle_of_edge(t[1], t[2]),
                        ca = middle_of_edge(t[2], t[0]);
    triangles.insert(triangles.end(),
                     {{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}});
  }
  result.head.positions.conservativeResize(static_cast<Index>(result.head.is_skin.size()), 3);
  for (std::size_t m = 0; m < middles.size(); ++m) {
    result.head.positions.row(static_cast<Index>(head.is_skin.size() + m)) = middles[m];
  }
  result.topology = topology_of(triangles, result.head.positions.rows());
  return result;
}

std::vector<Changed> changes_of(const Topology& topology, const HeadShape& head) {
  std::vector<Changed> all;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double degrees : {-30.0, -15.0, -2.0, 2.0, 15.0, 30.0}) {
      Changed turned{concat("turned by ", degrees, "° about axis ", axis), topology, head};
      turned.turn = Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Eigen::Vector3d::Unit(axis))
                        .toRotationMatrix();
      turned.head.positions = head.positions * turned.turn.transpose();
      all.push_back(std::move(turned));
    }
  }
  // A fine face, a coarse skull and neck, as in trackers' meshes.
  all.push_back(thinned("thinned unevenly", topology, head, [](const Eigen::RowVector3d& p) {
    return p.z() > 3 && p.y() > -9 && p.y() < 6 ? 0.5 : 2.0;
  }));
  for (double cell = 0.2;; cell *= 1.1) {
    Changed few = thinned("thinned to a twentieth", topology, head,
                          [&](const Eigen::RowVector3d&) { return cell; });
    if (20 * few.head.positions.rows() > head.positions.rows()) continue;
    all.push_back(std::move(few));
    break;
  }
  all.push_back(refined(topology, head));
  Changed noisy{"with noise", topology, head};
  std::mt19937 random(1);
  std::normal_distribution<double> mm(0, 0.05);
  for (double& x : noisy.head.positions.reshaped()) x += mm(random);
  all.push_back(std::move(noisy));
  all.push_back(cut("with holes", topology, head, [](const Eigen::Vector3d& p) {
    return std::cos(1.9 * p.x()) * std::cos(1.9 * p.y()) < 0.9;
  }));
  all.push_back(cut("without skull", topology, head,
                    [](const Eigen::Vector3d& p) { return p.z() > 2 && p.y() < 7; }));
  for (Changed& one : all) one.head.eyeball_centres.clear();
  return all;
}

/// The foremost point of the skin at a height near the middle of the face.
Eigen::Vector3d place_at(const Positions& samples, double height) {
  constexpr double kAsideCm = 0.4, kBesideCm = 0.15;
  double front = 0;
  for (Index i = 0; i < samples.rows(); ++i) {
    if (std::abs(samples(i, 0)) < kAsideCm && std::abs(samples(i, 1) - height) < kBesideCm) {
      front = std::max(front, samples(i, 2));
    }
  }
  return {0, height, front};
}

}  // namespace

std::vector<MarkError> mark_errors(const Topology& topology, const HeadShape& head) {
  constexpr Index kDense = 400'000;
  std::vector<MarkError> errors;
  const auto before = find_face_marks(topology, {head.positions, head.is_skin, {}}, {});
  if (!before) return errors;
  const Positions samples = sample_skin(topology, head.positions, head.is_skin, kDense);
  for (const Changed& one : changes_of(topology, head)) {
    const auto marks = find_face_marks(one.topology, one.head, {});
    const auto add = [&](const char* mark, double FaceMarks::*height) {
      MarkError error{one.what, mark, marks.has_value()};
      if (marks) {
        const Eigen::Vector3d place = one.turn * place_at(samples, *before.*height);
        error.mm = 10 * std::abs(*marks.*height - place.dot(marks->axes.up));
      }
      errors.push_back(error);
    };
    add("tip", &FaceMarks::tip_height);
    add("eyes", &FaceMarks::eyes_height);
    add("mouth", &FaceMarks::mouth_height);
  }
  return errors;
}

bool put_at_origin(const Topology& topology, HeadShape& head) {
  constexpr double kCmPerMm = 0.1, kInFrontCm = 7;
  const auto face = find_face(topology, head, {});
  if (!face) return false;
  head.positions.rowwise() -= Eigen::RowVector3d(face->eye_midpoint.transpose());
  head.positions *= kCmPerMm / face->scale;
  head.positions.col(2).array() += kInFrontCm;
  head.eyeball_centres.clear();
  return true;
}

}  // namespace crowdface::testing
