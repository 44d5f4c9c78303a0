// SPDX-License-Identifier: Apache-2.0
#include "crowdface/shapes/skin_crossings.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <utility>

#include "crowdface/core/smooth_step.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/shapes/smoothed_vectors.h"

namespace crowdface {
namespace {

// The search for intersections on a face tests only pairs of triangles that are close together on
// the template with the face's blend shape applied. There, the distance of the two triangles is at
// most kMaxTemplateGap, or kMaxFacingTemplateGap if they face each other. Both lengths are
// fractions of the skin's extent, about 430 mm.
constexpr double kMaxTemplateGap = 0.008, kMaxFacingTemplateGap = 0.02;
// number of rings of triangles to search around skin that may touch
constexpr int kRings = 2;
// Distances from intersections, measured at rest, as fractions of the skin's extent. Skin closer
// than kAveragedRadius gets the average of the neighbouring displacements; skin farther than
// kUnchangedRadius keeps its displacements.
constexpr double kAveragedRadius = 0.002, kUnchangedRadius = 0.005;
// size of the cells over which displacements are averaged, as a fraction of the skin's extent
constexpr double kCell = 0.003;
// growth of kAveragedRadius, kUnchangedRadius, kCell and kPushLength in each round, as a fraction
// of their values in the first round
constexpr double kGrowth = 0.08;
// arrange_as_template, which gives skin the template's front-to-back order, multiplies
// kAveragedRadius, kUnchangedRadius and kCell by this factor.
constexpr double kArrangeFactor = 0.7;
/// Averaging the displacements also changes the displacements of the lids. The vertical component
/// of this change is multiplied by kLidHeightFactor, so that the eye stays closed.
constexpr double kLidHeightFactor = 0.3;
// Fractions of the skin's extent. kPushLength: in each round, skin near intersections is pushed by
// this length. kPushRadius: a round pushes the skin whose distance from an intersection, on the
// face at rest, is at most this radius.
constexpr double kPushLength = 0.00015, kPushRadius = 0.004;
constexpr int kRounds = 30;
constexpr int kPatience = 6;  // rounds without improvement after which the repair of lids ends

using Pair = CrossingSearch::Pair;

std::vector<std::uint32_t> vertices_of(const std::vector<Pair>& pairs,
                                       const CrossingSearch& search) {
  std::vector<std::uint32_t> vertices;
  for (const Pair& pair : pairs) {
    for (const std::uint32_t place : pair) {
      const Triangle& corners = search.triangles()[place];
      vertices.insert(vertices.end(), corners.begin(), corners.end());
    }
  }
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

Index crossing_triangles(const std::vector<Pair>& pairs) {
  std::vector<std::uint32_t> triangles;
  for (const Pair& pair : pairs) triangles.insert(triangles.end(), pair.begin(), pair.end());
  std::ranges::sort(triangles);
  return std::unique(triangles.begin(), triangles.end()) - triangles.begin();
}

}  // namespace

/// Removes the self-intersections of the skin from one shape of one face.
class SkinCrossings::Repair {
 public:
  Repair(const SkinCrossings& skin, const Face& face, const SearchedSkin& searched_skin,
         Positions& mesh, Displacements& shape)
      : skin_(skin),
        face_(face),
        axes_(moved_axes(skin.axes_, face.face_motion)),
        searched_skin_(searched_skin),
        mesh_(mesh),
        shape_(shape) {
    shape_.add_to(mesh_);
    boxes_ = searched_skin_.search.make_boxes(mesh_);
    look();
  }
  ~Repair() {
    for (const std::uint32_t v : shape_.vertices) mesh_.row(v) = face_.rest.row(v);
  }
  Repair(const Repair&) = delete;
  Repair& operator=(const Repair&) = delete;

  Index crossing() const { return crossing_triangles(pairs_); }

  /// First pushes the lids apart. If intersections remain, starts again and gives the lids the
  /// relative positions that they have on the template.
  void remove_crossings(const ExtraCost& extra_cost) {
    if (pairs_.empty()) return;
    const Positions start = shape_.moves;
    remove_crossings(extra_cost, searched_skin_.brings_distant_skin_together
                                     ? &Repair::arrange_as_template
                                     : &Repair::push_lids);
    if (!searched_skin_.lid_sides.empty() && best_ > 0) {
      shape_.moves = start;
      changed_.assign(changed_.size(), true);
      search_again({});
      remove_crossings(extra_cost, &Repair::arrange_as_template);
    }
    shape_.moves = std::move(best_moves_);
    pairs_ = std::move(best_pairs_);
  }

 private:
  using HandleLids = void (Repair::*)(const std::vector<Pair>& lids, double grown);

  void remove_crossings(const ExtraCost& extra_cost, HandleLids handle_lids) {
    const int patience = searched_skin_.lid_sides.empty() ? kRounds : kPatience;
    int since_best = 0;
    double grown = 1;
    for (int round = 0; round <= kRounds; ++round, grown += kGrowth) {
      since_best = is_best(extra_cost) ? 0 : since_best + 1;
      if (pairs_.empty() || since_best == patience || round == kRounds) return;
      const auto lids = std::stable_partition(pairs_.begin(), pairs_.end(), [&](const Pair& pair) {
        return !searched_skin_.brings_distant_skin_together &&
               side_of(pair[0]) * side_of(pair[1]) >= 0;
      });
      const std::vector<Pair> before = pairs_, meeting(lids, pairs_.end());
      pairs_.erase(lids, pairs_.end());
      changed_.assign(skin_.is_skin_.size(), false);
      if (!meeting.empty()) (this->*handle_lids)(meeting, grown);
      if (!pairs_.empty()) average_displacements(grown);
      search_again(before);
    }
  }

  /// Returns whether the current displacements cost less than the displacements of every earlier
  /// round. If so, stores the current displacements as the best.
  bool is_best(const ExtraCost& extra_cost) {
    const double bad =
        static_cast<double>(crossing()) + (extra_cost ? extra_cost(shape_.moves) : 0);
    if (bad >= best_) return false;
    best_ = bad;
    best_moves_ = shape_.moves;
    best_pairs_ = pairs_;
    return true;
  }

  bool may_intersect(std::uint32_t triangle) const {
    const auto& [a, b, c] = searched_skin_.search.triangles()[triangle];
    return searched_skin_.may_intersect[triangle] || face_.crosses_at_rest[a] ||
           face_.crosses_at_rest[b] || face_.crosses_at_rest[c];
  }
  void look() {
    pairs_ = searched_skin_.search.intersecting_pairs(
        mesh_, boxes_, [&](std::uint32_t t) { return may_intersect(t); });
  }
  /// Searches for intersections again after vertices have moved.
  ///
  /// \param before  Pairs that intersected before the move. A pair still intersects if none of its
  ///                vertices moved.
  void search_again(const std::vector<Pair>& before) {
    for (const DisplacementRow& row : searched_skin_.skin_displacements) {
      if (changed_[row.vertex]) mesh_.row(row.vertex) = place_of(row).transpose();
    }
    searched_skin_.search.update(mesh_, changed_, boxes_);
    look();
    const auto has_changed = [&](std::uint32_t triangle) {
      return std::ranges::any_of(searched_skin_.search.triangles()[triangle],
                                 [&](std::uint32_t v) { return changed_[v]; });
    };
    for (const Pair& pair : before) {
      if (!has_changed(pair[0]) && !has_changed(pair[1])) pairs_.push_back(pair);
    }
    std::ranges::sort(pairs_);
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
  }

  Eigen::Vector3d place_of(const DisplacementRow& row) const {
    return row3(face_.rest, row.vertex) + row3(shape_.moves, row.row);
  }
  signed char side(std::uint32_t vertex) const {
    return searched_skin_.lid_sides.empty() ? static_cast<signed char>(0)
                                            : searched_skin_.lid_sides[vertex];
  }
  int side_of(std::uint32_t triangle) const {
    for (const std::uint32_t v : searched_skin_.search.triangles()[triangle]) {
      if (side(v) != 0) return side(v);
    }
    return 0;
  }
  void move(const DisplacementRow& row, const Eigen::Vector3d& by) {
    shape_.moves.row(row.row) += by.transpose();
    changed_[row.vertex] = true;
  }

  /// Averages displacements around intersections, so that skin that is close together at rest also
  /// moves together.
  /// \param grown  ratio of this round's averaging radius to the first round's averaging radius, at
  ///               least 1.
  void average_displacements(double grown) {
    const double unit = grown * skin_.extent_;
    std::vector<Eigen::Vector3d> around;
    for (const std::uint32_t v : vertices_of(pairs_, searched_skin_.search)) {
      around.push_back(row3(face_.rest, v));
    }
    const SmoothedVectors field(std::move(around), unit * kCell, unit * kAveragedRadius,
                                unit * kUnchangedRadius);
    std::vector<SmoothedVectors::Sample> samples;
    for (std::uint32_t i = 0; i < searched_skin_.skin_displacements.size(); ++i) {
      const DisplacementRow& row = searched_skin_.skin_displacements[i];
      const Eigen::Vector3d here = row3(face_.rest, row.vertex);
      if (field.affects(here)) samples.push_back({i, here, row3(shape_.moves, row.row)});
    }
    const Eigen::Vector3d& up = axes_.up;
    for (auto [number, by] : field.changes(samples)) {
      const DisplacementRow& row = searched_skin_.skin_displacements[number];
      if (side(row.vertex) != 0) by -= (1 - kLidHeightFactor) * by.dot(up) * up;
      move(row, by);
    }
  }

  /// Gives the skin near the intersections the arrangement that the skin has on the "shaped
  /// template": the template with the blend shape applied. Each skin vertex has a difference: its
  /// position on the face minus its position on the shaped template. The function replaces each
  /// difference by the mean of the differences of vertices that are close together on the shaped
  /// template.
  void arrange_as_template(const std::vector<Pair>& meeting, double grown) {
    const double unit = kArrangeFactor * grown * skin_.extent_;
    const std::vector<std::uint32_t> crossing = vertices_of(meeting, searched_skin_.search);
    std::vector<Eigen::Vector3d> around;
    const auto shaped = [&](std::uint32_t i) { return row3(searched_skin_.shaped_positions, i); };
    for (std::uint32_t i = 0; i < searched_skin_.skin_displacements.size(); ++i) {
      if (std::ranges::binary_search(crossing, searched_skin_.skin_displacements[i].vertex)) {
        around.push_back(shaped(i));
      }
    }
    const SmoothedVectors field(std::move(around), unit * kCell, unit * kAveragedRadius,
                                unit * kUnchangedRadius);
    std::vector<SmoothedVectors::Sample> samples;
    for (std::uint32_t i = 0; i < searched_skin_.skin_displacements.size(); ++i) {
      const DisplacementRow& row = searched_skin_.skin_displacements[i];
      if (!searched_skin_.brings_distant_skin_together && side(row.vertex) == 0) continue;
      if (!field.affects(shaped(i))) continue;
      samples.push_back({i, shaped(i), place_of(row) - face_.face_motion.apply(shaped(i))});
    }
    for (const auto& [number, by] : field.changes(samples))
      move(searched_skin_.skin_displacements[number], by);
  }

  /// Pushes the upper lid forward over the lower lid. Pushing the upper lid up would open the eye,
  /// and pushing the lower lid back would move the lower lid into the eyeball.
  void push_lids(const std::vector<Pair>& lids, double grown) {
    const Eigen::Vector3d &up = axes_.up, &front = axes_.front;
    std::map<std::uint32_t, Eigen::Vector3d> wanted;
    for (const Pair& pair : lids) {
      std::array<Eigen::Vector3d, 2> middle;
      for (std::size_t k = 0; k < 2; ++k) {
        const auto& [a, b, c] = searched_skin_.search.triangles()[pair[k]];
        middle[k] = row3(face_.rest, a) + row3(face_.rest, b) + row3(face_.rest, c);
      }
      const double side_of_first = side_of(pair[0]);
      Eigen::Vector3d over = (middle[0] - middle[1]).normalized() + side_of_first * front;
      over = (over - over.dot(up) * up).normalized();
      for (std::size_t k = 0; k < 2; ++k) {
        for (const std::uint32_t v : searched_skin_.search.triangles()[pair[k]]) {
          if (side(v) < 0) continue;
          wanted.try_emplace(v, 0, 0, 0).first->second += k == 0 ? over : -over;
        }
      }
    }
    for (auto& [v, push] : wanted) push = push.normalized();
    const double reach = kPushRadius * skin_.extent_, by = grown * kPushLength * skin_.extent_;
    for (const DisplacementRow& row : searched_skin_.skin_displacements) {
      if (side(row.vertex) == 0) continue;
      const Eigen::Vector3d here = row3(face_.rest, row.vertex);
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      double weights = 0, most = 0;
      for (const auto& [v, push] : wanted) {
        if (side(v) != side(row.vertex) && v != row.vertex) continue;
        const double distance = (row3(face_.rest, v) - here).norm() / reach;
        if (distance >= 1) continue;
        const double weight = biweight(distance);
        sum += weight * push;
        weights += weight;
        most = std::max(most, weight);
      }
      if (weights > 0) move(row, by * most / weights * sum);
    }
  }

  const SkinCrossings& skin_;
  const Face& face_;
  HeadAxes axes_;  ///< axes of the face
  const SearchedSkin& searched_skin_;
  Positions& mesh_;
  Displacements& shape_;
  CrossingSearch::Boxes boxes_;
  std::vector<Pair> pairs_;    ///< the pairs of skin triangles that intersect after the last change
  std::vector<bool> changed_;  ///< whether each vertex moved in this round
  double best_ = HUGE_VAL;
  Positions best_moves_;
  std::vector<Pair> best_pairs_;
};

SkinCrossings::SkinCrossings(const Topology& topology, std::span<const std::uint32_t> skin,
                             double extent, const HeadAxes& axes)
    : extent_(extent),
      axes_(axes),
      is_skin_(static_cast<std::size_t>(topology.vertex_count), false),
      skin_{{skin.begin(), skin.end()}, {}, {}} {
  for (const std::uint32_t v : skin) is_skin_[v] = true;
  for (const Triangle& triangle : triangles_of(topology)) {
    if (is_skin_[triangle[0]] && is_skin_[triangle[1]] && is_skin_[triangle[2]]) {
      skin_.triangles.push_back(triangle);
    }
  }
  skin_.vertex_triangles = VertexFaces(topology_of(skin_.triangles, topology.vertex_count));
}

SkinCrossings::SearchedSkin SkinCrossings::find_searched_skin(const Positions& neutral,
                                                              const Displacements& shape,
                                                              std::vector<signed char> side) const {
  Positions shaped = neutral;
  shape.add_to(shaped);
  SearchedSkin searched_skin{{}, {}, std::move(side), {}, {}};
  for (std::uint32_t row = 0; row < shape.vertices.size(); ++row) {
    if (is_skin_[shape.vertices[row]])
      searched_skin.skin_displacements.push_back({row, shape.vertices[row]});
  }
  searched_skin.shaped_positions.resize(static_cast<Index>(searched_skin.skin_displacements.size()),
                                        3);
  for (std::size_t i = 0; i < searched_skin.skin_displacements.size(); ++i) {
    searched_skin.shaped_positions.row(static_cast<Index>(i)) =
        shaped.row(searched_skin.skin_displacements[i].vertex);
  }
  // The search for intersections covers the skin that may touch other skin, and kRings rings of
  // triangles around this skin.
  std::vector<bool> meets = skin_that_may_touch(skin_, neutral, shaped, extent_);
  for (int ring = 0; ring < kRings; ++ring) {
    std::vector<bool> wider = meets;
    for (const Triangle& t : skin_.triangles) {
      if (!meets[t[0]] && !meets[t[1]] && !meets[t[2]]) continue;
      for (const std::uint32_t v : t) wider[v] = true;
    }
    meets = std::move(wider);
  }
  std::vector<Triangle> triangles;
  std::ranges::copy_if(skin_.triangles, std::back_inserter(triangles), [&](const Triangle& t) {
    return meets[t[0]] || meets[t[1]] || meets[t[2]];
  });
  searched_skin.may_intersect.assign(triangles.size(), false);
  searched_skin.search = CrossingSearch(std::move(triangles), shaped, kMaxTemplateGap * extent_,
                                        kMaxFacingTemplateGap * extent_);
  // Ignore the intersections that the template already has in this shape.
  allow_intersections_of(shaped, searched_skin);
  return searched_skin;
}

void SkinCrossings::allow_intersections_of(const Positions& mesh,
                                           SearchedSkin& searched_skin) const {
  const CrossingSearch& search = searched_skin.search;
  std::vector<bool> there(is_skin_.size(), false);
  const auto known = [&](std::uint32_t t) { return searched_skin.may_intersect[t]; };
  for (const std::uint32_t v :
       vertices_of(search.intersecting_pairs(mesh, search.make_boxes(mesh), known), search)) {
    there[v] = true;
  }
  for (std::size_t i = 0; i < searched_skin.may_intersect.size(); ++i) {
    const auto& [a, b, c] = search.triangles()[i];
    if (there[a] || there[b] || there[c]) searched_skin.may_intersect[i] = true;
  }
}

CrossingSearch SkinCrossings::merge_searches(const Positions& neutral,
                                             std::span<const CrossingSearch* const> shapes) const {
  std::vector<Triangle> all;
  for (const CrossingSearch* shape : shapes) {
    all.insert(all.end(), shape->triangles().begin(), shape->triangles().end());
  }
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return {std::move(all), neutral, kMaxTemplateGap * extent_, kMaxFacingTemplateGap * extent_};
}

std::vector<bool> SkinCrossings::crossing_at_rest(const Positions& rest,
                                                  const CrossingSearch& all) const {
  std::vector<bool> at(is_skin_.size(), false);
  const auto none = [](std::uint32_t) { return false; };
  for (const std::uint32_t v :
       vertices_of(all.intersecting_pairs(rest, all.make_boxes(rest), none), all)) {
    at[v] = true;
  }
  return at;
}

Index SkinCrossings::count_intersecting(const Face& face, const SearchedSkin& searched_skin,
                                        const Displacements& shape, Positions& mesh) const {
  Displacements same = shape;
  return Repair(*this, face, searched_skin, mesh, same).crossing();
}

Index SkinCrossings::repair(const Face& face, const SearchedSkin& searched_skin, Positions& mesh,
                            Displacements& shape, const ExtraCost& extra_cost) const {
  if (searched_skin.search.triangles().empty()) return 0;
  Repair repair(*this, face, searched_skin, mesh, shape);
  repair.remove_crossings(extra_cost);
  return repair.crossing();
}

}  // namespace crowdface
