// SPDX-License-Identifier: Apache-2.0
#include "crowdface/mesh/same_graph.h"

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include "crowdface/mesh/alignment.h"
#include "crowdface/mesh/disjoint_sets.h"

namespace crowdface {
namespace {

constexpr int kRounds = 12;  ///< number of rounds of Graph::refine, which computes vertex colours
/// largest number of corners of mesh b that are tried as the match of a seed
constexpr std::size_t kMaxCandidates = 256;
/// Largest number of steps of all traversals together, divided by the number of corners of mesh a.
constexpr std::size_t kMaxSteps = 64;

std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ x >> 30U) * 0xbf58476d1ce4e5b9U;
  x = (x ^ x >> 27U) * 0x94d049bb133111ebU;
  return x ^ x >> 31U;
}

/// A mesh and, for each corner, the opposite half-edge, for the traversal from polygon to polygon.
class Graph {
 public:
  explicit Graph(const Topology& topology)
      : topology_(topology), face_of_(static_cast<std::size_t>(topology.corner_count())) {
    for (Index f = 0; f < topology.face_count(); ++f) {
      const auto [begin, end] = topology.corners(f);
      for (std::uint32_t c = begin; c < end; ++c) face_of_[c] = static_cast<std::uint32_t>(f);
    }
    twins_.assign(face_of_.size(), kNoIndex);
    // The corner that starts each half-edge; kNoIndex if several polygons have the half-edge.
    std::unordered_map<std::uint64_t, std::uint32_t> starts;
    starts.reserve(face_of_.size());
    for (std::uint32_t c = 0; c < face_of_.size(); ++c) {
      const auto [start, is_new] = starts.emplace(edge(vertex(c), vertex(next(c))), c);
      if (!is_new) start->second = kNoIndex;
    }
    for (std::uint32_t c = 0; c < face_of_.size(); ++c) {
      const auto twin = starts.find(edge(vertex(next(c)), vertex(c)));
      if (twin == starts.end() || starts.at(edge(vertex(c), vertex(next(c)))) != c) continue;
      twins_[c] = twin->second;
    }
    refine();
  }

  const Topology& topology() const { return topology_; }
  std::uint32_t vertex(std::uint32_t corner) const { return topology_.corner_vertices[corner]; }
  std::uint32_t next(std::uint32_t corner) const {
    const auto [begin, end] = topology_.corners(face_of_[corner]);
    return corner + 1 == end ? begin : corner + 1;
  }
  /// Each corner starts a half-edge. Returns the corner that starts the opposite half-edge, or
  /// kNoIndex if there is none or if several polygons have the half-edge or the opposite one.
  std::uint32_t twin(std::uint32_t corner) const { return twins_[corner]; }
  std::uint32_t face_size(std::uint32_t corner) const {
    const auto [begin, end] = topology_.corners(face_of_[corner]);
    return end - begin;
  }
  std::uint32_t face(std::uint32_t corner) const { return face_of_[corner]; }
  /// The graph colour of each vertex, see `refine`. Matching vertices have equal colours.
  const std::vector<std::uint64_t>& colours() const { return colours_; }

 private:
  static std::uint64_t edge(std::uint32_t a, std::uint32_t b) {
    return std::uint64_t{a} << 32U | b;
  }

  /// Colour refinement (Weisfeiler-Leman): in each round, computes a new label ("colour") of each
  /// vertex from the labels of the vertices of the polygons around it. The result does not depend
  /// on the order of the polygons.
  void refine() {
    colours_.assign(static_cast<std::size_t>(topology_.vertex_count), 0);
    for (int round = 0; round < kRounds; ++round) {
      std::vector<std::uint64_t> sums(colours_.size(), mixed(static_cast<std::uint64_t>(round)));
      for (std::uint32_t c = 0; c < face_of_.size(); ++c) {
        // Compute a hash of the polygon, seen from this corner. It starts with the number of
        // corners and whether the edge is a border. Then it includes the graph colours (labels, not
        // RGB) of the polygon's other vertices, in order.
        std::uint64_t seen = face_size(c) + (twins_[c] == kNoIndex ? 1000U : 0U);
        std::uint32_t at = c;
        for (std::uint32_t k = face_size(c); k > 1; --k) {
          at = next(at);
          seen = mixed(seen ^ colours_[vertex(at)]);
        }
        sums[vertex(c)] += mixed(seen);
      }
      for (std::size_t v = 0; v < colours_.size(); ++v) colours_[v] = mixed(colours_[v] ^ sums[v]);
    }
  }

  const Topology& topology_;
  std::vector<std::uint32_t> face_of_, twins_;
  std::vector<std::uint64_t> colours_;
};

class Matcher {
 public:
  Matcher(const Graph& a, const Positions& at_a, const Graph& b, const Positions& at_b)
      : a_(a),
        b_(b),
        at_a_(at_a),
        at_b_(at_b),
        placed_(at_b.rowwise() + (at_a.colwise().mean() - at_b.colwise().mean())),
        steps_left_(kMaxSteps * a.topology().corner_vertices.size()) {}

  std::optional<std::vector<std::uint32_t>> match() {
    const auto count = static_cast<std::size_t>(a_.topology().vertex_count);
    std::vector<std::uint64_t> of_a = a_.colours(), of_b = b_.colours();
    std::ranges::sort(of_a);
    std::ranges::sort(of_b);
    if (of_a != of_b) return std::nullopt;
    to_b_.assign(count, kNoIndex);
    to_a_.assign(count, kNoIndex);
    corners_at_b_ = compressed_rows<std::uint32_t>(count, [&](const auto& put) {
      for (std::uint32_t c = 0; c < b_.topology().corner_vertices.size(); ++c) put(b_.vertex(c), c);
    });
    for (std::uint32_t v = 0; v < count; ++v) with_colour_[b_.colours()[v]].push_back(v);
    for (const std::uint32_t seed : seeds()) {
      if (!match_from(seed)) return std::nullopt;
    }
    if (!match_loose()) return std::nullopt;
    return std::move(to_b_);
  }

 private:
  /// Matched vertices of a and b.
  using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

  /// One start corner for each edge-connected set of polygons; larger sets come first. The start
  /// corner's vertex has the rarest Weisfeiler-Leman colour (a hash of the graph around the vertex)
  /// in the set, because only few vertices can match such a vertex.
  std::vector<std::uint32_t> seeds() const {
    const Topology& topology = a_.topology();
    DisjointSets groups(static_cast<std::size_t>(topology.face_count()));
    for (std::uint32_t c = 0; c < topology.corner_vertices.size(); ++c) {
      if (a_.twin(c) != kNoIndex) groups.join(a_.face(c), a_.face(a_.twin(c)));
    }
    struct Component {
      std::size_t corners = 0, rarity = std::numeric_limits<std::size_t>::max();
      std::uint32_t seed = kNoIndex;
    };
    std::vector<Component> components(static_cast<std::size_t>(topology.face_count()));
    for (std::uint32_t c = 0; c < topology.corner_vertices.size(); ++c) {
      Component& component = components[groups.root(a_.face(c))];
      ++component.corners;
      const std::size_t rarity = with_colour_.at(a_.colours()[a_.vertex(c)]).size();
      if (rarity < component.rarity) component = {component.corners, rarity, c};
    }
    std::erase_if(components, [](const Component& one) { return one.seed == kNoIndex; });
    std::ranges::stable_sort(components, std::greater(), &Component::corners);
    std::vector<std::uint32_t> seeds;
    for (const Component& component : components) seeds.push_back(component.seed);
    return seeds;
  }

  /// Matches the component of a seed with a component of b. Starts from every corner of b whose
  /// vertex has the same graph colour (see `colours`) as the seed's vertex, and keeps the match
  /// with the smallest distances between matched vertices.
  /// \return whether there is a match.
  bool match_from(std::uint32_t seed) {
    // The vertex of b that an earlier call matched with the seed's vertex; kNoIndex if the seed's
    // vertex is unmatched. (Components that share only a vertex are matched one after the other.)
    const std::uint32_t known = to_b_[a_.vertex(seed)];
    double best = std::numeric_limits<double>::infinity();
    std::optional<Pairs> nearest;
    std::size_t tried = 0;
    for (const std::uint32_t candidate : with_colour_.at(a_.colours()[a_.vertex(seed)])) {
      if (known != kNoIndex ? candidate != known : to_a_[candidate] != kNoIndex) continue;
      for (const std::uint32_t corner : corners_at_b_.items_of(candidate)) {
        if (++tried > kMaxCandidates) break;
        auto pairs = walk(seed, corner);
        if (!pairs) continue;
        const double distance = distance_of(*pairs);
        if (distance < best) {
          best = distance;
          nearest = std::move(pairs);
        }
      }
    }
    if (!nearest) return false;
    for (const auto& [in_a, in_b] : *nearest) {
      to_b_[in_a] = in_b;
      to_a_[in_b] = in_a;
    }
    if (!is_aligned_) align(*nearest);
    return true;
  }

  /// Traverses both meshes from the corner `from_a` of a and the corner `from_b` of b.
  /// \return the pairs of matching vertices; nothing if a and b differ on the way.
  std::optional<Pairs> walk(std::uint32_t from_a, std::uint32_t from_b) {
    Pairs pairs, open = {{from_a, from_b}};
    std::vector<std::uint32_t> faces;
    seen_.resize(static_cast<std::size_t>(a_.topology().face_count()), false);
    bool fits = true;
    const auto pair = [&](std::uint32_t v, std::uint32_t w) {
      if (to_b_[v] == w && to_a_[w] == v) return true;
      if (to_b_[v] != kNoIndex || to_a_[w] != kNoIndex || a_.colours()[v] != b_.colours()[w])
        return false;
      to_b_[v] = w;
      to_a_[w] = v;
      pairs.emplace_back(v, w);
      return true;
    };
    // Walk over a and b at the same time: from each pair of corresponding polygons, cross
    // corresponding edges to the next pair.
    while (fits && !open.empty()) {
      auto [c, d] = open.back();
      open.pop_back();
      if (seen_[a_.face(c)]) continue;
      seen_[a_.face(c)] = true;
      faces.push_back(a_.face(c));
      const std::uint32_t size = a_.face_size(c);
      fits = size == b_.face_size(d) && steps_left_ > size;
      steps_left_ -= std::min<std::size_t>(steps_left_, size);
      for (std::uint32_t k = 0; fits && k < size; ++k, c = a_.next(c), d = b_.next(d)) {
        const std::uint32_t e = a_.twin(c), g = b_.twin(d);
        fits = pair(a_.vertex(c), b_.vertex(d)) && (e == kNoIndex) == (g == kNoIndex);
        if (fits && e != kNoIndex) open.emplace_back(e, g);
      }
    }
    // Undo all marks of this traversal, because match_from tries further traversals and compares
    // their results.
    for (const std::uint32_t f : faces) seen_[f] = false;
    for (const auto& [v, w] : pairs) {
      to_b_[v] = kNoIndex;
      to_a_[w] = kNoIndex;
    }
    if (!fits) return std::nullopt;
    return pairs;
  }

  double distance_of(const Pairs& pairs) const {
    double sum = 0;
    for (const auto& [v, w] : pairs) sum += (at_a_.row(v) - placed_.row(w)).squaredNorm();
    return sum;
  }

  /// Moves mesh b rigidly so that its matched vertices lie as close as possible to their partners
  /// in mesh a.
  void align(const Pairs& pairs) {
    Positions from(static_cast<Index>(pairs.size()), 3), to(static_cast<Index>(pairs.size()), 3);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      to.row(static_cast<Index>(i)) = at_a_.row(pairs[i].first);
      from.row(static_cast<Index>(i)) = at_b_.row(pairs[i].second);
    }
    is_aligned_ = true;
    placed_ = fit_similarity(from, to, ScaleFit::kRigid).apply(at_b_);
  }

  /// Matches the vertices that belong to no polygon: the first unmatched vertex of a with the first
  /// unmatched vertex of b, the second with the second, and so on.
  /// \return false if b has too few unmatched vertices, or if one of the matched vertices of
  /// b belongs to a polygon.
  bool match_loose() {
    std::uint32_t w = 0;
    for (std::uint32_t& in_b : to_b_) {
      if (in_b != kNoIndex) continue;
      while (w < to_a_.size() && to_a_[w] != kNoIndex) ++w;
      if (w == to_a_.size() || !corners_at_b_.items_of(w).empty()) return false;
      in_b = w++;
    }
    return true;
  }

  const Graph &a_, &b_;
  const Positions &at_a_, &at_b_;
  Positions placed_;  ///< vertices of b, moved into the coordinate frame of a
  /// Whether placed_ is already aligned by the matches of the first component. While false, only
  /// the centres of the two meshes coincide.
  bool is_aligned_ = false;
  std::size_t steps_left_;
  std::vector<std::uint32_t> to_b_, to_a_;
  CompressedRows<std::uint32_t> corners_at_b_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> with_colour_;
  std::vector<bool> seen_;  ///< for each polygon of mesh `a`: whether the traversal has visited it
};

using Triangle = std::array<std::uint32_t, 3>;

/// The triangle x, y, z, beginning with its smallest vertex.
Triangle triangle_of(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  Triangle triangle = {x, y, z};
  std::rotate(triangle.begin(), std::ranges::min_element(triangle), triangle.end());
  return triangle;
}

using HalfEdge = std::pair<std::uint32_t, std::uint32_t>;
using Triangles = std::vector<Triangle>;

/// The triangles of a mesh's polygons, sorted.
Triangles sorted_triangles(const Topology& topology) {
  const Topology triangles = triangulated(topology, 0);
  Triangles sorted;
  for (Index f = 0; f < triangles.face_count(); ++f) {
    const std::span<const std::uint32_t> face = triangles.face(f);
    sorted.push_back(triangle_of(face[0], face[1], face[2]));
  }
  std::ranges::sort(sorted);
  return sorted;
}

std::array<HalfEdge, 3> half_edges_of(const Triangle& t) {
  return {HalfEdge(t[0], t[1]), HalfEdge(t[1], t[2]), HalfEdge(t[2], t[0])};
}

HalfEdge edge_of(const HalfEdge& half_edge) {
  return std::minmax(half_edge.first, half_edge.second);
}

std::set<HalfEdge> edges_of(const Triangles& triangles) {
  std::set<HalfEdge> edges;
  for (const Triangle& triangle : triangles) {
    for (const HalfEdge& half_edge : half_edges_of(triangle)) edges.insert(edge_of(half_edge));
  }
  return edges;
}

/// The half-edges of `triangles` that lie on `kept` edges, sorted. All other edges are diagonals,
/// at which neighbouring triangles are joined to polygons.
/// \return nothing if a polygon has a hole, or a vertex that is not at its border.
std::optional<std::vector<HalfEdge>> polygon_borders(const Triangles& triangles,
                                                     const std::set<HalfEdge>& kept) {
  std::vector<HalfEdge> borders;
  DisjointSets polygons(triangles.size());
  std::map<HalfEdge, std::uint32_t> first_at_diagonal;
  std::map<HalfEdge, int> balance;  // of a diagonal: triangles on its left minus those on its right
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (const HalfEdge& half_edge : half_edges_of(triangles[t])) {
      const HalfEdge edge = edge_of(half_edge);
      if (kept.contains(edge)) {
        borders.push_back(half_edge);
      } else {
        polygons.join(t, first_at_diagonal.try_emplace(edge, t).first->second);
        balance[edge] += edge == half_edge ? 1 : -1;
      }
    }
  }
  // `surplus` counts, for each polygon, its border edges minus its triangles: 2 for a polygon
  // without a hole or an inner vertex, because a polygon of n corners has n - 2 triangles.
  std::vector<int> surplus(triangles.size(), 0);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (const HalfEdge& half_edge : half_edges_of(triangles[t])) {
      surplus[polygons.root(t)] += kept.contains(edge_of(half_edge)) ? 1 : 0;
    }
    --surplus[polygons.root(t)];
  }
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (polygons.root(t) == t && surplus[t] < 2) return std::nullopt;
  }
  if (std::ranges::any_of(balance, [](const auto& of) { return of.second != 0; })) {
    return std::nullopt;
  }
  std::ranges::sort(borders);
  return borders;
}

}  // namespace

bool has_same_polygons(const Topology& a, const Topology& b) {
  if (a.vertex_count != b.vertex_count) return false;
  const Triangles of_a = sorted_triangles(a), of_b = sorted_triangles(b);
  if (of_a.size() != of_b.size()) return false;
  Triangles only_a, only_b;
  std::ranges::set_difference(of_a, of_b, std::back_inserter(only_a));
  std::ranges::set_difference(of_b, of_a, std::back_inserter(only_b));
  const std::set<HalfEdge> edges_a = edges_of(only_a), edges_b = edges_of(only_b);
  std::set<HalfEdge> common;
  std::ranges::set_intersection(edges_a, edges_b, std::inserter(common, common.end()));
  const auto borders = polygon_borders(only_a, common);
  return borders && borders == polygon_borders(only_b, common);
}

std::optional<std::vector<std::uint32_t>> match_graphs(const Topology& expected,
                                                       const Positions& expected_positions,
                                                       const Topology& found,
                                                       const Positions& found_positions) {
  if (expected.vertex_count != found.vertex_count || expected.face_count() != found.face_count() ||
      expected.corner_count() != found.corner_count()) {
    return std::nullopt;
  }
  const Graph a(expected), b(found);
  return Matcher(a, expected_positions, b, found_positions).match();
}

Topology triangulated(const Topology& topology, std::uint32_t fan_corner) {
  Topology triangles;
  triangles.vertex_count = topology.vertex_count;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const std::span<const std::uint32_t> face = topology.face(f);
    const auto size = static_cast<std::uint32_t>(face.size());
    const std::uint32_t first = size == 4 ? fan_corner % size : 0;
    for (std::uint32_t c = 1; c + 1 < size; ++c) {
      triangles.add_face(
          std::array{face[first], face[(first + c) % size], face[(first + c + 1) % size]});
    }
  }
  return triangles;
}

}  // namespace crowdface
