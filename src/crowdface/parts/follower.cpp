// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/follower.h"

#include <algorithm>
#include <cmath>

#include "crowdface/core/parallel.h"
#include "crowdface/core/selection.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/parts/anchors.h"
#include "crowdface/parts/contact.h"
#include "crowdface/parts/rigid_motion.h"
#include "crowdface/parts/socket.h"

namespace crowdface {
namespace {

/// Distance up to which skin belongs to the socket of a rigid part. kEyeReach: for an eyeball, as a
/// fraction of its radius (about 12 mm). kSocketReach: for other parts, as a fraction of the skin's
/// extent (about 43 cm).
constexpr double kEyeReach = 1, kSocketReach = 0.03;
/// The socket of a part is the skin near the part's vertices. If the part has more vertices than
/// this number, a subset of this size is used to find the socket.
constexpr std::size_t kMaxSocketVertices = 4000;
/// Fractions of the skin's extent. kContactReach: largest distance at which skin and part are
/// tested for contact. kContactMargin: smallest clearance that is kept.
constexpr double kContactReach = 0.01, kContactMargin = 0.0005;
/// Largest distance at which gums follow a tooth, as a fraction of the skin's extent.
constexpr double kToothReach = 0.01;

/// Returns the area of each vertex (#V): the vertex's share of the areas of the polygons that
/// contain it.
std::vector<double> vertex_areas(const Topology& topology, const Positions& positions) {
  const Positions vectors = face_area_vectors(topology, positions);
  std::vector<double> areas(static_cast<std::size_t>(topology.vertex_count), 0.0);
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto face = topology.face(f);
    const double x = vectors(f, 0), y = vectors(f, 1), z = vectors(f, 2);
    const double area = std::sqrt(x * x + y * y + z * z) / 2;
    for (const std::uint32_t v : face) areas[v] += area / static_cast<double>(face.size());
  }
  return areas;
}

/// Returns whether the given vertices have exactly the same positions in `before` and `after`.
bool have_same_positions(const Positions& before, const Positions& after,
                         std::span<const std::uint32_t> vertices) {
  return std::ranges::all_of(vertices,
                             [&](std::uint32_t v) { return before.row(v) == after.row(v); });
}

struct RigidPart {
  std::vector<std::uint32_t> vertices;
  /// weights for fit_rigid_motion: 1 for each vertex of the part
  std::vector<double> equal_weights;
  Socket socket;
  bool is_eyeball = false;
  EyeSocket eye;        ///< used if the part is an eyeball
  PartContact contact;  ///< used if the part is not an eyeball
};

/// The mean head and its skin, to which parts are bound.
struct SkinOfMean {
  const HeadSet& heads;
  const VertexFaces& around;
  const HeadAxes& axes;
  const Positions& mean;
  std::vector<double> areas;            ///< area of each vertex, #V
  std::vector<std::uint32_t> vertices;  ///< vertices that belong to a polygon but to no part
  PointGrid grid;                       ///< grid of `vertices`
  double extent;                        ///< diagonal of the bounding box of the largest component
};

/// Returns the skin around a rigid part. The reach doubles until there is enough skin, so that a
/// part far from the skin follows the nearest skin.
Socket socket_of(const Part& part, double reach, const SkinOfMean& skin) {
  // A subset of the part's vertices is enough: the distance between skin and part may be imprecise
  // by the spacing of the vertices.
  const PointGrid rough_grid(skin.mean, evenly_spaced_items(part.vertices, kMaxSocketVertices));
  Socket socket;
  for (int tries = 0; tries < 8 && socket.vertices.size() < 12; ++tries, reach *= 2) {
    socket = find_socket(skin.mean, rough_grid, skin.vertices, skin.areas, reach);
  }
  return socket;
}

EyeSocket bind_eye(const Part& part, const ComponentShape& ball, const SkinOfMean& skin) {
  const std::vector<double> equal_weights(part.vertices.size(), 1.0);
  std::vector<BallRadii> maps(skin.heads.heads.size());
  parallel_for_each(maps.size(), [&](std::size_t i) {
    const Positions& head = skin.heads.heads[i].positions;
    const RigidMotion motion = fit_rigid_motion(skin.mean, head, part.vertices, equal_weights);
    maps[i] = BallRadii(skin.heads.topology, skin.around, head, part.ball_vertices,
                        motion.apply(ball.centre), motion.scale * ball.radius, skin.axes);
  });
  return {find_lids(skin.mean, PointGrid(skin.mean, part.vertices), ball.centre, ball.radius,
                    skin.axes, skin.vertices),
          std::move(maps), skin.heads.heads};
}

RigidPart bind_rigid(const Part& part, const PartList& parts, const SkinOfMean& skin) {
  RigidPart bound;
  bound.vertices = part.vertices;
  bound.equal_weights.assign(part.vertices.size(), 1.0);
  bound.is_eyeball = part.is_eyeball;
  if (!part.is_eyeball) {
    bound.socket = socket_of(part, kSocketReach * skin.extent, skin);
    bound.contact =
        PartContact(skin.heads.topology, skin.around, skin.mean, skin.grid, skin.vertices,
                    part.vertices, kContactReach * skin.extent, skin.heads.heads);
    return bound;
  }
  const ComponentShape& ball = parts.shapes[part.ball_component];
  bound.socket = socket_of(part, kEyeReach * ball.radius, skin);
  bound.eye = bind_eye(part, ball, skin);
  return bound;
}

}  // namespace

struct PartFollower::State {
  const HeadSet& heads;
  VertexFaces around;
  PartShape shape;
  double extent;  ///< diagonal of the skin's bounding box
  std::vector<RigidPart> rigid;
  Anchors anchors;
  /// for each head: the result of Anchors::measure_offsets
  std::vector<std::vector<Eigen::Vector3d>> offsets;
  /// weights with which the vertices of bound parts (PartClass::kBound, such as gums) follow teeth
  PartWeights tooth_weights;

  struct PartMotion {
    bool still = true;  ///< whether the skin around the part has kept its positions
    RigidMotion skin;   ///< motion of the skin around the part
    RigidMotion part;   ///< motion of the part itself
  };
  PartMotion find_motion(const RigidPart& part, std::size_t target, const Positions& result) const;
  /// Gives all eyeballs of the head the same change of size.
  void equalize_eyeball_sizes(std::size_t target, const Positions& result,
                              std::vector<PartMotion>& found) const;
  void place(const RigidPart& part, std::size_t target, const PartMotion& found,
             Positions& result) const;
};

PartFollower::PartFollower(const HeadSet& heads, const PartList& parts, const HeadAxes& axes,
                           PartShape shape) {
  auto state =
      std::make_unique<State>(State{heads, VertexFaces(heads.topology), shape, 0, {}, {}, {}, {}});
  for (const ComponentShape& component : parts.shapes) {
    state->extent = std::max(state->extent, component.extent);
  }
  const Positions mean = mean_head(heads);
  const auto skin_rows = skin_of(parts, state->around);
  const SkinOfMean skin{heads,
                        state->around,
                        axes,
                        mean,
                        vertex_areas(heads.topology, mean),
                        skin_rows,
                        PointGrid(mean, skin_rows),
                        state->extent};

  std::vector<const Part*> rigid;
  std::vector<std::uint32_t> bound;
  for (const Part& part : parts.parts) {
    if (part.part_class == PartClass::kBound) {
      bound.insert(bound.end(), part.vertices.begin(), part.vertices.end());
    } else {
      rigid.push_back(&part);
    }
  }
  std::ranges::sort(bound);
  state->rigid.resize(rigid.size());
  parallel_for_each(rigid.size(),
                    [&](std::size_t p) { state->rigid[p] = bind_rigid(*rigid[p], parts, skin); });

  std::vector<std::span<const std::uint32_t>> teeth;
  for (const RigidPart& part : state->rigid) {
    if (!part.is_eyeball) teeth.emplace_back(part.vertices);
  }
  state->tooth_weights = PartWeights(mean, teeth, bound, kToothReach * state->extent);
  state->anchors = Anchors(heads.topology, state->around, mean, skin.grid, std::move(bound));
  state->offsets.resize(heads.heads.size());
  parallel_for_each(heads.heads.size(), [&](std::size_t i) {
    state->offsets[i] = state->anchors.measure_offsets(heads.heads[i].positions);
  });
  state_ = std::move(state);
}

PartFollower::~PartFollower() = default;

PartFollower::State::PartMotion PartFollower::State::find_motion(const RigidPart& part,
                                                                 std::size_t target,
                                                                 const Positions& result) const {
  const Positions& before = heads.heads[target].positions;
  PartMotion found;
  found.still = have_same_positions(before, result, part.socket.vertices) &&
                have_same_positions(before, result, part.eye.lids().vertices);
  if (found.still || part.socket.vertices.size() < 3) return found;
  found.skin = fit_rigid_motion(before, result, part.socket.vertices, part.socket.weights);
  found.part = part.is_eyeball ? part.eye.fit(target, found.skin, result)
                               : part.contact.keep_out_of_skin(before, found.skin, result,
                                                               kContactMargin * extent);
  return found;
}

void PartFollower::State::equalize_eyeball_sizes(std::size_t target, const Positions& result,
                                                 std::vector<PartMotion>& found) const {
  double sum = 0, count = 0;
  for (std::size_t p = 0; p < rigid.size(); ++p) {
    if (!rigid[p].is_eyeball) continue;
    if (found[p].still) return;  // an unmoved eyeball keeps its exact positions
    sum += found[p].part.scale;
    count += 1;
  }
  if (count < 2) return;
  parallel_for_each(rigid.size(), [&](std::size_t p) {
    if (!rigid[p].is_eyeball) return;
    const Eigen::Vector3d centre = found[p].part.apply(rigid[p].eye.centre(target));
    const double growth = sum / count / found[p].part.scale - 1;
    found[p].part = rigid[p].eye.fit_translation(
        target, found[p].skin, nudged(found[p].part, centre, {0, 0, 0}, {0, 0, 0}, growth), result);
  });
}

void PartFollower::State::place(const RigidPart& part, std::size_t target, const PartMotion& found,
                                Positions& result) const {
  const Positions& before = heads.heads[target].positions;
  if (shape == PartShape::kTarget) {
    for (const std::uint32_t v : part.vertices) {
      if (found.still) {
        result.row(v) = before.row(v);
      } else {
        result.row(v) = found.part.apply(before.row(v).transpose()).transpose();
      }
    }
    return;
  }
  // First move the blended part rigidly onto the target's part, so that only the shape of the
  // blended part is kept.
  const RigidMotion home = fit_rigid_motion(result, before, part.vertices, part.equal_weights);
  for (const std::uint32_t v : part.vertices) {
    result.row(v) = found.part.apply(home.apply(result.row(v).transpose())).transpose();
  }
}

void PartFollower::move_parts(Index target, Positions& result) const {
  const auto t = static_cast<std::size_t>(target);
  const Positions& before = state_->heads.heads[t].positions;
  // Parts can be processed in parallel: each reads only skin, and writes only its own vertices.
  std::vector<State::PartMotion> found(state_->rigid.size());
  std::vector<RigidMotion> motions;
  parallel_for_each(found.size(), [&](std::size_t p) {
    found[p] = state_->find_motion(state_->rigid[p], t, result);
  });
  state_->equalize_eyeball_sizes(t, result, found);
  parallel_for_each(found.size(),
                    [&](std::size_t p) { state_->place(state_->rigid[p], t, found[p], result); });
  for (std::size_t p = 0; p < found.size(); ++p) {
    if (!state_->rigid[p].is_eyeball) motions.push_back(found[p].part);
  }
  state_->anchors.place_vertices(before, state_->offsets[t], result);
  state_->tooth_weights.move_with_parts(before, motions, result);
}

}  // namespace crowdface
