// SPDX-License-Identifier: Apache-2.0
#include "wrap/truth_scan.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <queue>

#include <Eigen/Geometry>

#include "crowdface/core/random.h"
#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/wrap/surface_tree.h"

namespace crowdface::testing {
namespace {

constexpr double kOpenness = 0.12;  // what sees less than this no scanner sees

Eigen::Vector3d normal3(const RandomKey& key) {
  return {random_normal(key, 0), random_normal(key, 1), random_normal(key, 2)};
}

/// What can be seen from outside: skin and eyeballs.
std::vector<Triangle> visible_triangles(const WrapTemplate& head) {
  std::vector<Triangle> solid = occluding_triangles(head);
  std::vector<std::uint32_t> all(static_cast<std::size_t>(head.positions.rows()));
  std::iota(all.begin(), all.end(), 0U);
  const std::vector<double> open = vertex_ambient_visibility(
      head.positions, vertex_normals(head.topology, head.positions), solid, all);
  std::erase_if(solid, [&](const Triangle& t) {
    return open[t[0]] < kOpenness || open[t[1]] < kOpenness || open[t[2]] < kOpenness;
  });
  return solid;
}

/// Splits the longest edges at random places until there are about so many triangles.
class Splitter {
 public:
  Splitter(Positions positions, std::vector<Triangle> triangles, std::uint64_t seed)
      : triangles_(std::move(triangles)), seed_(seed) {
    for (Index v = 0; v < positions.rows(); ++v) points_.push_back(positions.row(v).transpose());
  }

  Scan run(std::size_t wanted) {
    while (triangles_.size() < wanted) {
      if (!split_round(wanted)) break;
    }
    Scan scan{Positions(static_cast<Index>(points_.size()), 3), triangles_};
    for (std::size_t v = 0; v < points_.size(); ++v) {
      scan.positions.row(static_cast<Index>(v)) = points_[v].transpose();
    }
    return scan;
  }

 private:
  using Edge = std::pair<std::uint32_t, std::uint32_t>;

  double length(std::uint32_t a, std::uint32_t b) const { return (points_[a] - points_[b]).norm(); }

  /// Splits the longest edge of each triangle if it is long for a mesh of that many triangles, and
  /// with it that of the neighbour, so that no gap opens.
  bool split_round(std::size_t wanted) {
    double area = 0;
    for (const Triangle& t : triangles_) {
      area += (points_[t[1]] - points_[t[0]]).cross(points_[t[2]] - points_[t[0]]).norm() / 2;
    }
    const double most = 1.5 * std::sqrt(4 / std::sqrt(3.0) * area / static_cast<double>(wanted));
    std::map<Edge, std::uint32_t> middle;
    for (const Triangle& t : triangles_) {
      std::size_t k = 0;
      for (std::size_t i = 1; i < 3; ++i) {
        if (length(t[i], t[(i + 1) % 3]) > length(t[k], t[(k + 1) % 3])) k = i;
      }
      const Edge edge = std::minmax(t[k], t[(k + 1) % 3]);
      if (length(edge.first, edge.second) > most) middle.emplace(edge, 0);
    }
    if (middle.empty()) return false;
    for (auto& [edge, vertex] : middle) {
      vertex = static_cast<std::uint32_t>(points_.size());
      const double share = random_between({seed_, vertex, "truth/split"}, 0.35, 0.65);
      points_.emplace_back((1 - share) * points_[edge.first] + share * points_[edge.second]);
    }
    std::vector<Triangle> cut;
    for (const Triangle& t : triangles_) split(t, middle, cut);
    triangles_ = std::move(cut);
    return true;
  }

  static void split(const Triangle& t, const std::map<Edge, std::uint32_t>& middle,
                    std::vector<Triangle>& out) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto found = middle.find(std::minmax(t[k], t[(k + 1) % 3]));
      if (found == middle.end()) continue;
      split({t[k], found->second, t[(k + 2) % 3]}, middle, out);
      split({found->second, t[(k + 1) % 3], t[(k + 2) % 3]}, middle, out);
      return;
    }
    out.push_back(t);
  }

  std::vector<Eigen::Vector3d> points_;
  std::vector<Triangle> triangles_;
  std::uint64_t seed_;
};

/// Moves each vertex that is on no rim to some place of the triangles around it that leaves none of
/// them turned over: no vertex of the head is left where it was.
void scatter(Scan& scan, std::uint64_t seed) {
  const std::vector<bool> rim =
      build_adjacency(topology_of(scan.triangles, scan.positions.rows())).boundary;
  std::vector<std::vector<std::uint32_t>> around(rim.size());
  for (std::uint32_t t = 0; t < scan.triangles.size(); ++t) {
    for (const std::uint32_t v : scan.triangles[t]) around[v].push_back(t);
  }
  const auto area = [&](std::uint32_t t) {
    const Triangle& c = scan.triangles[t];
    const Eigen::Vector3d a = scan.positions.row(c[0]).transpose();
    return (row3(scan.positions, c[1]) - a).cross(row3(scan.positions, c[2]) - a);
  };
  for (std::uint32_t v = 0; v < around.size(); ++v) {
    if (rim[v] || around[v].empty()) continue;
    const RandomKey key{seed, v, "truth/scatter"};
    const auto choice =
        static_cast<std::size_t>(random_uniform(key) * static_cast<double>(around[v].size()));
    const Triangle& t = scan.triangles[around[v][choice]];
    const auto [a, b] = random_pair(key, 1);
    const Eigen::RowVector3d before = scan.positions.row(v);
    std::vector<Eigen::Vector3d> areas;
    for (const std::uint32_t n : around[v]) areas.push_back(area(n));
    const double share = 0.5 * a;
    Eigen::RowVector3d place = (1 - share) * before;
    std::size_t others = 0;
    for (const std::uint32_t corner : t) {
      if (corner == v) continue;
      place += share * (others++ == 0 ? b : 1 - b) * scan.positions.row(corner);
    }
    scan.positions.row(v) = place;
    for (std::size_t i = 0; i < areas.size(); ++i) {
      const Eigen::Vector3d now = area(around[v][i]);
      if (now.dot(areas[i]) < 0.5 * now.norm() * areas[i].norm() ||
          now.norm() < 0.1 * areas[i].norm()) {
        scan.positions.row(v) = before;
        break;
      }
    }
  }
}

void cut_holes(Scan& scan, const TruthOptions& options) {
  for (int h = 0; h < options.holes; ++h) {
    const RandomKey key{options.seed, static_cast<std::uint64_t>(h), "truth/hole"};
    const auto t =
        static_cast<std::size_t>(random_uniform(key) * static_cast<double>(scan.triangles.size()));
    const Eigen::RowVector3d middle = scan.positions.row(scan.triangles[t][0]);
    const double radius = options.hole_radius_mm * (0.5 + random_uniform(key, 1));
    std::erase_if(scan.triangles, [&](const Triangle& corner) {
      return (scan.positions.row(corner[0]) - middle).norm() < radius;
    });
  }
}

/// Vertices that triangles use, in an order of chance; triangles likewise.
Scan shuffled(const Scan& scan, std::uint64_t seed) {
  std::vector<bool> used(static_cast<std::size_t>(scan.positions.rows()), false);
  for (const Triangle& t : scan.triangles) {
    for (const std::uint32_t v : t) used[v] = true;
  }
  std::vector<std::pair<double, std::uint32_t>> order;
  for (std::uint32_t v = 0; v < used.size(); ++v) {
    if (used[v]) order.emplace_back(random_uniform({seed, v, "truth/order"}), v);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::uint32_t> number(used.size(), 0);
  Scan result{Positions(static_cast<Index>(order.size()), 3), {}};
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    number[order[i].second] = i;
    result.positions.row(i) = scan.positions.row(order[i].second);
  }
  std::vector<std::pair<double, std::uint32_t>> faces;
  for (std::uint32_t t = 0; t < scan.triangles.size(); ++t) {
    faces.emplace_back(random_uniform({seed, t, "truth/faces"}), t);
  }
  std::sort(faces.begin(), faces.end());
  for (const auto& [chance, t] : faces) {
    const Triangle& c = scan.triangles[t];
    result.triangles.push_back({number[c[0]], number[c[1]], number[c[2]]});
  }
  return result;
}

/// Joins each further piece of the surface to the largest one by a triangle between the nearest
/// vertices.
void fuse(Scan& scan) {
  const Topology topology = topology_of(scan.triangles, scan.positions.rows());
  const Components pieces = find_components(build_adjacency(topology));
  const std::uint32_t largest = pieces.largest();
  std::map<std::uint32_t, std::pair<double, Triangle>> bridges;
  for (const Triangle& own : scan.triangles) {
    const std::uint32_t piece = pieces.component_of_vertex[own[0]];
    if (piece == largest) continue;
    for (const Triangle& other : scan.triangles) {
      if (pieces.component_of_vertex[other[0]] != largest) continue;
      const double distance =
          (scan.positions.row(own[0]) - scan.positions.row(other[0])).squaredNorm();
      const auto [known, added] = bridges.try_emplace(piece, 1e300, Triangle{});
      if (distance < known->second.first) {
        known->second = {distance, {own[0], own[1], other[0]}};
      }
    }
  }
  for (const auto& [piece, bridge] : bridges) scan.triangles.push_back(bridge.second);
}

Similarity random_pose(std::uint64_t seed) {
  const RandomKey key{seed, 0, "truth/pose"};
  const Eigen::Vector3d axis = normal3(key).normalized();
  Similarity pose;
  pose.rotation = Eigen::AngleAxisd(3 * random_uniform(key, 5), axis).toRotationMatrix();
  pose.translation = 700 * normal3({seed, 1, "truth/pose"});
  pose.scale = 0.01 + 4 * random_uniform(key, 6);
  return pose;
}

}  // namespace

TruthScan make_truth_scan(const WrapTemplate& head, const std::vector<WrapLandmark>& landmarks,
                          const TruthOptions& options) {
  TruthScan truth;
  if (options.moved) truth.pose = random_pose(options.seed);
  Scan scan =
      Splitter(head.positions, visible_triangles(head), options.seed).run(options.triangles);
  scatter(scan, options.seed);
  cut_holes(scan, options);
  if (options.fused) fuse(scan);
  scan = shuffled(scan, options.seed);
  const Positions normals = vertex_normals_or_zero(scan.triangles, scan.positions);
  for (Index v = 0; v < scan.positions.rows(); ++v) {
    const RandomKey key{options.seed, static_cast<std::uint64_t>(v), "truth/noise"};
    scan.positions.row(v) += options.noise_mm * random_normal(key) * normals.row(v);
  }
  truth.scan = {truth.pose.apply(scan.positions), scan.triangles};
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    truth.landmarks.push_back(landmarks[i]);
    const Positions place = head.positions.row(landmarks[i].vertex);
    const Eigen::Vector3d error =
        options.landmark_error_mm * normal3({options.seed, i, "truth/landmark"});
    truth.landmarks.back().scan_position =
        truth.pose.apply(Positions(place + error.transpose())).row(0).transpose();
  }
  return truth;
}

}  // namespace crowdface::testing
