// SPDX-License-Identifier: Apache-2.0
#include "crowdface/mesh/subdivision.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace crowdface {
namespace {

/// The edges of all polygons. Each edge occurs once; edges are sorted by their end vertices.
struct Edges {
  /// #E: ends of each edge, first < second
  std::vector<std::pair<std::uint32_t, std::uint32_t>> ends;
  /// For each corner, the edge to the next corner of its polygon.
  std::vector<std::uint32_t> corner_edges;
  std::vector<std::uint32_t> faces;  ///< #E: number of polygons at each edge
};

/// Finds the edges of all polygons; an edge joins two indices of successive corners.
/// \param indices  the vertex or the texture coordinate of each corner.
Edges find_edges(const Topology& topology, const std::vector<std::uint32_t>& indices) {
  struct Side {
    std::uint32_t first, second, corner;
  };
  std::vector<Side> sides;
  sides.reserve(indices.size());
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto [begin, end] = topology.corners(f);
    for (auto c = begin; c < end; ++c) {
      const auto [low, high] = std::minmax(indices[c], indices[c + 1 == end ? begin : c + 1]);
      sides.push_back({low, high, c});
    }
  }
  std::ranges::sort(sides, [](const Side& a, const Side& b) {
    return std::tie(a.first, a.second, a.corner) < std::tie(b.first, b.second, b.corner);
  });
  Edges edges;
  edges.corner_edges.resize(indices.size());
  for (const Side& side : sides) {
    if (edges.ends.empty() || edges.ends.back() != std::pair(side.first, side.second)) {
      edges.ends.emplace_back(side.first, side.second);
      edges.faces.push_back(0);
    }
    edges.corner_edges[side.corner] = static_cast<std::uint32_t>(edges.ends.size() - 1);
    ++edges.faces.back();
  }
  return edges;
}

/// The corners of the new quads. A quad lists the old corner, the new point on the edge to the next
/// corner, the face point (the new point of the polygon), and the new point on the edge from the
/// previous corner.
std::vector<std::uint32_t> split_corners(const Topology& topology,
                                         const std::vector<std::uint32_t>& indices,
                                         const Edges& edges, std::size_t index_count) {
  std::vector<std::uint32_t> out;
  out.reserve(4 * indices.size());
  const auto first_edge = static_cast<std::uint32_t>(index_count);
  const auto first_face = static_cast<std::uint32_t>(index_count + edges.ends.size());
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto [begin, end] = topology.corners(f);
    for (auto c = begin; c < end; ++c) {
      const auto before = edges.corner_edges[c == begin ? end - 1 : c - 1];
      out.push_back(indices[c]);
      out.push_back(first_edge + edges.corner_edges[c]);
      out.push_back(first_face + static_cast<std::uint32_t>(f));
      out.push_back(first_edge + before);
    }
  }
  return out;
}

template <class Rows>
Rows face_means(const Topology& topology, const std::vector<std::uint32_t>& indices,
                const Rows& rows) {
  Rows means = Rows::Zero(topology.face_count(), rows.cols());
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto [begin, end] = topology.corners(f);
    for (auto c = begin; c < end; ++c) means.row(f) += rows.row(indices[c]);
    means.row(f) /= end - begin;
  }
  return means;
}

/// New positions of the old vertices. Sums the face points of the polygons and the midpoints of the
/// edges at each vertex, then applies one formula per vertex.
Positions move_vertices(const Mesh& mesh, const Edges& edges, const Positions& faces) {
  const Index n = mesh.topology.vertex_count;
  Positions face_sum = Positions::Zero(n, 3), edge_sum = face_sum, rim_sum = face_sum;
  std::vector<std::uint32_t> face_count(static_cast<std::size_t>(n)), edge_count = face_count,
                                                                      rim_count = face_count;
  for (Index f = 0; f < mesh.topology.face_count(); ++f) {
    for (const std::uint32_t v : mesh.topology.face(f)) {
      face_sum.row(v) += faces.row(f);
      ++face_count[v];
    }
  }
  for (std::size_t e = 0; e < edges.ends.size(); ++e) {
    const auto [a, b] = edges.ends[e];
    for (const auto& [at, other] : {std::pair(a, b), std::pair(b, a)}) {
      edge_sum.row(at) += (mesh.positions.row(at) + mesh.positions.row(other)) / 2;
      ++edge_count[at];
      if (edges.faces[e] == 2) continue;
      rim_sum.row(at) += mesh.positions.row(other);
      ++rim_count[at];
    }
  }
  Positions moved = mesh.positions;
  for (Index v = 0; v < n; ++v) {
    const auto i = static_cast<std::size_t>(v);
    if (rim_count[i] == 2) {
      // Boundary vertex: subdivision mask (1, 6, 1) / 8 of cubic B-spline curves.
      moved.row(v) = (6 * mesh.positions.row(v) + rim_sum.row(v)) / 8;
    } else if (rim_count[i] == 0 && face_count[i] > 0) {
      // Interior vertex V with k edges: (F + 2 E + (k - 3) V) / k, where F is the mean of the face
      // points and E the mean of the edge midpoints. All other vertices stay in place.
      const double k = edge_count[i];
      moved.row(v) = (face_sum.row(v) / face_count[i] + 2 * edge_sum.row(v) / k +
                      (k - 3) * mesh.positions.row(v)) /
                     k;
    }
  }
  return moved;
}

Positions edge_points(const Mesh& mesh, const Edges& edges, const Positions& faces) {
  const auto count = static_cast<Index>(edges.ends.size());
  Positions of_faces = Positions::Zero(count, 3), points(count, 3);
  for (Index f = 0; f < mesh.topology.face_count(); ++f) {
    const auto [begin, end] = mesh.topology.corners(f);
    for (auto c = begin; c < end; ++c) of_faces.row(edges.corner_edges[c]) += faces.row(f);
  }
  for (Index e = 0; e < count; ++e) {
    const auto [a, b] = edges.ends[static_cast<std::size_t>(e)];
    const Eigen::RowVector3d ends = mesh.positions.row(a) + mesh.positions.row(b);
    // The new vertex of an interior edge is the mean of the edge's two ends and the two adjacent
    // face points. The new vertex of a boundary edge is the midpoint.
    const bool inside = edges.faces[static_cast<std::size_t>(e)] == 2;
    points.row(e) =
        inside ? Eigen::RowVector3d((ends + of_faces.row(e)) / 4) : Eigen::RowVector3d(ends / 2);
  }
  return points;
}

template <class Rows>
Rows stacked(const Rows& a, const Rows& b, const Rows& c) {
  Rows out(a.rows() + b.rows() + c.rows(), a.cols());
  out << a, b, c;
  return out;
}

TextureCoordinates split_uvs(const Topology& topology, const TextureCoordinates& uvs,
                             const Edges& edges) {
  TextureCoordinates middles(static_cast<Index>(edges.ends.size()), 2);
  for (Index e = 0; e < middles.rows(); ++e) {
    const auto [a, b] = edges.ends[static_cast<std::size_t>(e)];
    middles.row(e) = (uvs.row(a) + uvs.row(b)) / 2;
  }
  return stacked(uvs, middles, face_means(topology, topology.corner_uvs, uvs));
}

}  // namespace

Mesh subdivide(const Mesh& mesh) {
  const Topology& old = mesh.topology;
  const Edges edges = find_edges(old, old.corner_vertices);
  const Positions faces = face_means(old, old.corner_vertices, mesh.positions);
  Mesh out;
  out.positions =
      stacked(move_vertices(mesh, edges, faces), edge_points(mesh, edges, faces), faces);
  Topology& topology = out.topology;
  topology.vertex_count = out.positions.rows();
  topology.corner_vertices =
      split_corners(old, old.corner_vertices, edges, static_cast<std::size_t>(old.vertex_count));
  topology.face_offsets.clear();
  for (std::uint32_t c = 0; c <= topology.corner_vertices.size(); c += 4) {
    topology.face_offsets.push_back(c);
  }
  const bool all_have_uvs = !old.corner_uvs.empty() &&
                            std::ranges::find(old.corner_uvs, kNoIndex) == old.corner_uvs.end();
  if (!all_have_uvs) return out;
  const Edges uv_edges = find_edges(old, old.corner_uvs);
  topology.corner_uvs =
      split_corners(old, old.corner_uvs, uv_edges, static_cast<std::size_t>(mesh.uvs.rows()));
  out.uvs = split_uvs(old, mesh.uvs, uv_edges);
  return out;
}

int subdivision_rounds(const Topology& topology, Index wanted_vertices) {
  // A round of subdivision adds one vertex for each edge and one for each polygon, and turns every
  // quad into four quads.
  double vertices = static_cast<double>(topology.vertex_count);
  double faces = static_cast<double>(topology.face_count());
  double edges = static_cast<double>(find_edges(topology, topology.corner_vertices).ends.size());
  double corners = static_cast<double>(topology.corner_count());
  const auto wanted = static_cast<double>(wanted_vertices);
  int rounds = 0;
  for (; rounds < 8; ++rounds) {
    const double next = vertices + edges + faces;
    if (next / wanted >= wanted / vertices) break;
    vertices = next;
    edges = 2 * edges + corners;
    faces = corners;
    corners *= 4;
  }
  return rounds;
}

}  // namespace crowdface
