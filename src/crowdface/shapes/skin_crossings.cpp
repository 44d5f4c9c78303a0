// SPDX-License-Identifier: Apache-2.0
#include "crowdface/shapes/skin_crossings.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>

#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/point_grid.h"

namespace crowdface {
namespace {

// Lengths are shares of the skin's extent, some 430 mm.
constexpr double kNear = 0.008;     // of skin that may meet
constexpr double kNearEdges = 1.6;  // the same, in edges
constexpr double kOfMove = 0.8;  // how much of what a shape moves skin may be otherwise on a face
constexpr double kOfDifference = 2;                    // and of what it moves it against other skin
constexpr int kRings = 2;                              // around that
constexpr double kEvened = 0.002, kNotEvened = 0.005;  // from crossings, at rest
constexpr double kCell = 0.003;                        // over which displacements are evened out
constexpr double kGrowth = 0.08;                       // of those, a round
/// Of what evens out how lids move up and down, so that they close still.
constexpr double kClosing = 0.3;
constexpr double kPush = 0.00015, kPushed = 0.004;  // a round; from crossings, at rest
constexpr int kRounds = 30, kForwardRounds = 12;
constexpr int kPatience =
    6;  // rounds in which nothing gets better, where another harm is looked at
constexpr double kMeets = 0.008;  // how near on the template is what may meet on a face

double square(double x) {
  return x * x;
}

std::vector<std::uint32_t> vertices_of(const std::vector<CrossingSearch::Pair>& pairs,
                                       const CrossingSearch& search) {
  std::vector<std::uint32_t> vertices;
  for (const CrossingSearch::Pair& pair : pairs) {
    for (const std::uint32_t place : pair) {
      const Triangle& corners = search.triangles()[place];
      vertices.insert(vertices.end(), corners.begin(), corners.end());
    }
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

Index crossing_triangles(const std::vector<CrossingSearch::Pair>& pairs) {
  std::set<std::uint32_t> triangles;
  for (const CrossingSearch::Pair& pair : pairs) triangles.insert(pair.begin(), pair.end());
  return static_cast<Index>(triangles.size());
}

/// Some places, and the box around them.
struct Surroundings {
  std::vector<Eigen::Vector3d> places;
  Eigen::Vector3d low = Eigen::Vector3d::Zero(), high = low;

  void add(const Eigen::Vector3d& place) {
    low = places.empty() ? place : Eigen::Vector3d(low.cwiseMin(place));
    high = places.empty() ? place : Eigen::Vector3d(high.cwiseMax(place));
    places.push_back(place);
  }
  /// Whether a point lies in the box grown by `reach`.
  bool have(const Eigen::Vector3d& point, double reach) const {
    return (point.array() > low.array() - reach).all() &&
           (point.array() < high.array() + reach).all();
  }
  /// To the nearest of them.
  double distance(const Eigen::Vector3d& point) const {
    double least = std::numeric_limits<double>::max();
    for (const Eigen::Vector3d& place : places) {
      const Eigen::Vector3d from = place - point;
      least = std::min(least, dot3(from, from));
    }
    return std::sqrt(least);
  }
};

/// Means of a field over the cells of a grid.
class CellMeans {
 public:
  CellMeans(const Eigen::Vector3d& low, const Eigen::Vector3d& high, double cell)
      : low_(low), cell_(cell) {
    for (int c = 0; c < 3; ++c) {
      nodes_a_side_[static_cast<std::size_t>(c)] =
          static_cast<std::size_t>((high[c] - low[c]) / cell) + 2;
    }
    number_.resize(nodes_a_side_[0] * nodes_a_side_[1] * nodes_a_side_[2], kNoIndex);
  }
  void add(const Eigen::Vector3d& place, const Eigen::Vector3d& value) {
    visit(place, [&](std::size_t at, double weight) {
      if (number_[at] == kNoIndex) {
        number_[at] = static_cast<std::uint32_t>(nodes_.size());
        nodes_.emplace_back();
      }
      Node& node = nodes_[number_[at]];
      node.sum += weight * value;
      node.weight += weight;
    });
  }
  /// At a place to which something was added.
  Eigen::Vector3d at(const Eigen::Vector3d& place) const {
    Node mean;
    visit(place, [&](std::size_t at, double weight) {
      const Node& node = nodes_[number_[at]];
      mean.sum += weight * node.sum;
      mean.weight += weight * node.weight;
    });
    return mean.sum / mean.weight;
  }

 private:
  struct Node {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double weight = 0;
  };

  template <class Use>
  void visit(const Eigen::Vector3d& place, const Use& use) const {
    std::array<std::size_t, 3> first;
    std::array<double, 3> t;
    for (std::size_t c = 0; c < 3; ++c) {
      const double x = (place[static_cast<Index>(c)] - low_[static_cast<Index>(c)]) / cell_;
      first[c] = static_cast<std::size_t>(x);
      t[c] = x - static_cast<double>(first[c]);
    }
    for (unsigned corner = 0; corner < 8; ++corner) {
      std::size_t node = 0;
      double weight = 1;
      for (std::size_t c = 3; c-- > 0;) {
        const std::size_t step = (corner >> c) & 1U;
        node = node * nodes_a_side_[c] + first[c] + step;
        weight *= step == 1 ? t[c] : 1 - t[c];
      }
      use(node, weight);
    }
  }

  Eigen::Vector3d low_;
  double cell_;
  std::array<std::size_t, 3> nodes_a_side_;
  std::vector<std::uint32_t> number_;  ///< of a node; most hear of nothing and have none
  std::vector<Node> nodes_;
};

}  // namespace

SkinCrossings::SkinCrossings(const Topology& topology, std::span<const std::uint32_t> skin,
                             double extent, const HeadAxes& axes)
    : extent_(extent),
      axes_(axes),
      skin_(skin.begin(), skin.end()),
      is_skin_(static_cast<std::size_t>(topology.vertex_count), false) {
  for (const std::uint32_t v : skin) is_skin_[v] = true;
  for (const Triangle& triangle : triangles_of(topology)) {
    if (is_skin_[triangle[0]] && is_skin_[triangle[1]] && is_skin_[triangle[2]]) {
      triangles_.push_back(triangle);
    }
  }
  around_ = grouped<std::uint32_t>(is_skin_.size(), [&](const auto& put) {
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      for (const std::uint32_t v : triangles_[t]) put(v, t);
    }
  });
}

SkinCrossings::Watched SkinCrossings::watch(const Positions& neutral, const Displacements& shape,
                                            std::vector<signed char> side) const {
  Watched watched{{}, {}, std::move(side), {}};
  for (std::uint32_t row = 0; row < shape.vertices.size(); ++row) {
    if (is_skin_[shape.vertices[row]]) watched.rows.push_back({row, shape.vertices[row]});
  }
  Positions mesh = neutral;
  shape.add_to(mesh);
  const Positions normals = vertex_normals(triangles_, mesh);
  const PointGrid grid(mesh, skin_);
  std::vector<bool> near(is_skin_.size(), false);
  for (const std::uint32_t v : shape.vertices) {
    if (!is_skin_[v]) continue;
    const Eigen::Vector3d at = row3(mesh, v), normal = row3(normals, v);
    const Eigen::Vector3d move = at - row3(neutral, v);
    double reach = kNear * extent_;
    for (const std::uint32_t t : around_.of(v)) {
      for (const std::uint32_t w : triangles_[t]) {
        reach = std::max(reach, kNearEdges * length3(row3(mesh, w) - at));
      }
    }
    for (const std::uint32_t w : grid.about(at, reach)) {
      if ((near[v] && near[w]) || dot3(row3(normals, w), normal) > 0) continue;
      const Eigen::Vector3d other = row3(mesh, w), other_move = other - row3(neutral, w);
      const double distance = length3(other - at);
      if (distance > reach || w == v) continue;
      const double may_differ = kOfMove * std::max(length3(move), length3(other_move)) +
                                kOfDifference * length3(move - other_move);
      if (may_differ >= distance) near[v] = near[w] = true;
    }
  }
  for (int ring = 0; ring < kRings; ++ring) {
    std::vector<bool> wider = near;
    for (const std::uint32_t v : skin_) {
      if (!near[v]) continue;
      for (const std::uint32_t t : around_.of(v)) {
        for (const std::uint32_t w : triangles_[t]) wider[w] = true;
      }
    }
    near = std::move(wider);
  }
  std::vector<Triangle> triangles;
  std::copy_if(triangles_.begin(), triangles_.end(), std::back_inserter(triangles),
               [&](const Triangle& t) { return near[t[0]] || near[t[1]] || near[t[2]]; });
  watched.excused.assign(triangles.size(), false);
  watched.search = CrossingSearch(std::move(triangles), mesh, kMeets * extent_);
  excuse(mesh, watched);
  return watched;
}

/// The same as in NewIntersections: those with a vertex at a triangle of a pair.
void SkinCrossings::excuse(const Positions& mesh, Watched& watched) const {
  const CrossingSearch& search = watched.search;
  std::vector<bool> there(is_skin_.size(), false);
  const auto known = [&](std::uint32_t t) { return watched.excused[t]; };
  for (const std::uint32_t v :
       vertices_of(search.crossing(mesh, search.boxes_of(mesh), known), search)) {
    there[v] = true;
  }
  for (std::size_t i = 0; i < watched.excused.size(); ++i) {
    const auto& [a, b, c] = search.triangles()[i];
    if (there[a] || there[b] || there[c]) watched.excused[i] = true;
  }
}

int SkinCrossings::side_of(const Watched& watched, std::uint32_t triangle) const {
  if (watched.side.empty()) return 0;
  for (const std::uint32_t v : watched.search.triangles()[triangle]) {
    if (watched.side[v] != 0) return watched.side[v];
  }
  return 0;
}

/// Lids: the upper one forward over the lower one, as pushed up it would open, and the lower one pushed back would go
/// into the eyeball. Where that does not help, both, as they lie at rest, if nothing says
/// that this does harm.
void SkinCrossings::push_apart(const std::vector<Pair>& pairs, const Watched& watched,
                               const Positions& rest, double by, Push how, Displacements& shape,
                               std::vector<bool>& changed) const {
  std::map<std::uint32_t, Eigen::Vector3d> wanted;
  for (const Pair& pair : pairs) {
    std::array<Eigen::Vector3d, 2> middle;
    for (std::size_t k = 0; k < 2; ++k) {
      const auto& [a, b, c] = watched.search.triangles()[pair[k]];
      middle[k] = row3(rest, a) + row3(rest, b) + row3(rest, c);
    }
    const double side = side_of(watched, pair[0]);
    Eigen::Vector3d over = unit3(unit3(middle[0] - middle[1]) + side * axes_.front);
    if (how == Push::kForward) over -= dot3(over, axes_.up) * axes_.up;
    over = unit3(over);
    for (std::size_t k = 0; k < 2; ++k) {
      for (const std::uint32_t v : watched.search.triangles()[pair[k]]) {
        if (how == Push::kForward && watched.side[v] < 0) continue;
        wanted.try_emplace(v, 0, 0, 0).first->second += k == 0 ? over : -over;
      }
    }
  }
  const double reach = kPushed * extent_;
  Surroundings around;
  for (auto& [v, push] : wanted) {
    push = unit3(push);
    around.add(row3(rest, v));
  }
  for (const Row& row : watched.rows) {
    const signed char side = watched.side[row.vertex];
    const Eigen::Vector3d here = row3(rest, row.vertex);
    if (side == 0 || !around.have(here, reach)) continue;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double weights = 0, most = 0;
    for (const auto& [v, push] : wanted) {
      if (watched.side[v] != side && v != row.vertex) continue;
      const double distance = length3(row3(rest, v) - here) / reach;
      if (distance >= 1) continue;
      const double weight = square(1 - square(distance));
      sum += weight * push;
      weights += weight;
      most = std::max(most, weight);
    }
    if (weights == 0) continue;
    shape.moves.row(row.row) += (by * most / weights * sum).transpose();
    changed[row.vertex] = true;
  }
}

void SkinCrossings::even_out(const std::vector<Pair>& pairs, const Watched& watched,
                             const Positions& rest, double grown, Displacements& shape,
                             std::vector<bool>& changed) const {
  const double cell = grown * kCell * extent_, whole = grown * kEvened * extent_,
               none = grown * kNotEvened * extent_;
  Surroundings crossing;
  for (const std::uint32_t v : vertices_of(pairs, watched.search)) crossing.add(row3(rest, v));
  CellMeans means(crossing.low.array() - (none + cell), crossing.high.array() + (none + cell),
                  cell);
  std::vector<Row> around;
  for (const Row& row : watched.rows) {
    const Eigen::Vector3d here = row3(rest, row.vertex);
    if (!crossing.have(here, none + cell)) continue;
    means.add(here, row3(shape.moves, row.row));
    around.push_back(row);
  }
  for (const Row& row : around) {
    const Eigen::Vector3d here = row3(rest, row.vertex);
    const double distance = crossing.distance(here);
    if (distance >= none) continue;
    const double t = std::clamp((none - distance) / (none - whole), 0.0, 1.0);
    const double share = t * t * (3 - 2 * t);
    const Eigen::Vector3d before = row3(shape.moves, row.row);
    Eigen::Vector3d by = share * (means.at(here) - before);
    if (!watched.side.empty() && watched.side[row.vertex] != 0) {
      by -= (1 - kClosing) * dot3(by, axes_.up) * axes_.up;
    }
    shape.moves.row(row.row) = (before + by).transpose();
    changed[row.vertex] = true;
  }
}

CrossingSearch SkinCrossings::watch_all(const Positions& neutral,
                                        std::span<const CrossingSearch* const> shapes) const {
  std::vector<Triangle> all;
  for (const CrossingSearch* shape : shapes) {
    all.insert(all.end(), shape->triangles().begin(), shape->triangles().end());
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return {std::move(all), neutral, kMeets * extent_};
}

std::vector<bool> SkinCrossings::crossing_at_rest(const Positions& rest,
                                                  const CrossingSearch& all) const {
  std::vector<bool> at(is_skin_.size(), false);
  const auto none = [](std::uint32_t) { return false; };
  for (const std::uint32_t v : vertices_of(all.crossing(rest, all.boxes_of(rest), none), all)) {
    at[v] = true;
  }
  return at;
}

Index SkinCrossings::mend(const Positions& rest, const std::vector<bool>& at_rest,
                          const Watched& watched, Positions& mesh, Displacements& shape,
                          const Harm& harm) const {
  const CrossingSearch& search = watched.search;
  if (search.triangles().empty()) return 0;
  const auto excused = [&](std::uint32_t t) {
    const auto& [a, b, c] = search.triangles()[t];
    return watched.excused[t] || at_rest[a] || at_rest[b] || at_rest[c];
  };
  shape.add_to(mesh);
  CrossingSearch::Boxes boxes = search.boxes_of(mesh);
  std::vector<Pair> pairs = search.crossing(mesh, boxes, excused);
  if (!watched.is_meant) take_apart(rest, watched, excused, boxes, pairs, mesh, shape, harm);
  for (const std::uint32_t v : shape.vertices) mesh.row(v) = rest.row(v);
  return crossing_triangles(pairs);
}

void SkinCrossings::take_apart(const Positions& rest, const Watched& watched,
                               const Excused& excused, CrossingSearch::Boxes& boxes,
                               std::vector<Pair>& pairs, Positions& mesh, Displacements& shape,
                               const Harm& harm) const {
  double grown = 1, best = HUGE_VAL;
  Positions best_moves;
  std::vector<Pair> best_pairs;
  int since_best = 0;
  const auto judge = [&] {
    const double bad = static_cast<double>(crossing_triangles(pairs)) + harm(shape.moves);
    ++since_best;
    if (bad >= best) return;
    best = bad;
    since_best = 0;
    best_moves = shape.moves;
    best_pairs = pairs;
  };
  for (int round = 0; round < kRounds && !pairs.empty(); ++round, grown += kGrowth) {
    if (harm) judge();
    if (since_best == kPatience) break;
    const auto are_lids = [&](const Pair& pair) {
      return side_of(watched, pair[0]) * side_of(watched, pair[1]) < 0;
    };
    std::vector<Pair> lids;
    std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(lids), are_lids);
    std::erase_if(pairs, are_lids);
    std::vector<bool> changed(is_skin_.size(), false);
    if (!lids.empty()) {
      push_apart(lids, watched, rest, grown * kPush * extent_,
                 harm || round < kForwardRounds ? Push::kForward : Push::kApart, shape, changed);
    }
    if (!pairs.empty()) even_out(pairs, watched, rest, grown, shape, changed);
    for (const Row& row : watched.rows) {
      if (!changed[row.vertex]) continue;
      mesh.row(row.vertex) = rest.row(row.vertex) + shape.moves.row(row.row);
    }
    watched.search.renew(mesh, changed, boxes);
    pairs = watched.search.crossing(mesh, boxes, excused);
  }
  if (best == HUGE_VAL) return;
  judge();
  shape.moves = std::move(best_moves);
  pairs = std::move(best_pairs);
}

}  // namespace crowdface
