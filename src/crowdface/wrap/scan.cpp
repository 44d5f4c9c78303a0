// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/scan.h"

#include <algorithm>
#include <numeric>

#include "crowdface/parts/grouping.h"
#include "crowdface/parts/vector3.h"

namespace crowdface {
namespace {

Eigen::Vector3d area_vector(const Positions& positions, const Triangle& t) {
  const Eigen::Vector3d a = positions.row(t[0]).transpose();
  return cross3(positions.row(t[1]).transpose() - a, positions.row(t[2]).transpose() - a);
}

bool degenerate(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

}  // namespace

std::vector<Triangle> triangles_of(const Topology& topology) {
  std::vector<Triangle> triangles;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto face = topology.face(f);
    for (std::size_t c = 1; c + 1 < face.size(); ++c) {
      triangles.push_back({face[0], face[c], face[c + 1]});
    }
  }
  return triangles;
}

Positions scan_normals(const Scan& scan) {
  Positions normals = Positions::Zero(scan.positions.rows(), 3);
  for (const Triangle& t : scan.triangles) {
    const Eigen::RowVector3d area = area_vector(scan.positions, t).transpose();
    for (const std::uint32_t v : t) normals.row(v) += area;
  }
  for (Index v = 0; v < normals.rows(); ++v) {
    normals.row(v) = unit3(normals.row(v).transpose()).transpose();
  }
  return normals;
}

std::vector<bool> rim_vertices(const std::vector<Triangle>& triangles, Index vertex_count) {
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  std::vector<Edge> edges;
  edges.reserve(3 * triangles.size());
  for (const Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      edges.push_back(std::minmax(t[k], t[(k + 1) % 3]));
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<bool> rim(static_cast<std::size_t>(vertex_count), false);
  for (std::size_t i = 0, next = 0; i < edges.size(); i = next) {
    while (next < edges.size() && edges[next] == edges[i]) ++next;
    if (next - i == 1) rim[edges[i].first] = rim[edges[i].second] = true;
  }
  return rim;
}

Scan without_small_pieces(const Scan& scan, double least_share) {
  Grouping groups(static_cast<std::size_t>(scan.positions.rows()));
  for (const Triangle& t : scan.triangles) {
    groups.join(t[0], t[1]);
    groups.join(t[1], t[2]);
  }
  std::vector<double> area(static_cast<std::size_t>(scan.positions.rows()), 0.0);
  for (const Triangle& t : scan.triangles) {
    area[groups.root(t[0])] += length3(area_vector(scan.positions, t));
  }
  const double least =
      area.empty() ? 0 : least_share * *std::max_element(area.begin(), area.end());
  Scan kept{scan.positions, {}};
  for (const Triangle& t : scan.triangles) {
    if (!degenerate(t) && area[groups.root(t[0])] >= least) kept.triangles.push_back(t);
  }
  return kept;
}

void weld(Scan& scan) {
  std::vector<std::uint32_t> order(static_cast<std::size_t>(scan.positions.rows()));
  std::iota(order.begin(), order.end(), 0U);
  const auto place = [&](std::uint32_t v) {
    return std::array{scan.positions(v, 0), scan.positions(v, 1), scan.positions(v, 2)};
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const auto x = place(a), y = place(b);
    return x < y || (x == y && a < b);
  });
  std::vector<std::uint32_t> first(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    first[order[i]] =
        i > 0 && place(order[i]) == place(order[i - 1]) ? first[order[i - 1]] : order[i];
  }
  for (Triangle& t : scan.triangles) {
    for (std::uint32_t& v : t) v = first[v];
  }
}

}  // namespace crowdface
