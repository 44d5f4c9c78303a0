// SPDX-License-Identifier: Apache-2.0
#include "crowdface/shapes/shape_transfer.h"

#include <algorithm>
#include <iterator>

#include "crowdface/core/parallel.h"
#include "crowdface/core/selection.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/eye_socket.h"
#include "crowdface/parts/point_grid.h"
#include "crowdface/shapes/frame_field.h"
#include "crowdface/shapes/lid_closure.h"

namespace crowdface {
namespace {

/// Vertices of an eyeball or a jaw that tell where all of it is.
constexpr std::size_t kMostFitted = 500;
/// How far from an eyeball's centre its lids' skin may be, as a share of its radius.
constexpr double kEyeSkin = 3;

/// A rigid part of the template.
struct RigidPart {
  std::vector<std::uint32_t> vertices;
  std::vector<std::uint32_t> fitted;  ///< some of them
  std::vector<double> ones;           ///< #fitted
  Eigen::Vector3d middle;             ///< of an eyeball: its centre
};

struct Eye {
  std::size_t part;  ///< of the rigid ones
  TemplateEye of_template;
  std::vector<BallMap> balls;  ///< #heads
};

/// A rigid part in a shape.
struct PartMove {
  std::size_t part;
  RigidMotion motion;                  ///< of the part, on the template
  std::vector<std::uint32_t> rows;     ///< of the shape
  std::vector<Eigen::Vector3d> rests;  ///< #rows: of the moves, beside that motion
};

/// A vertex of a bound part that goes along with lids.
struct Hanging {
  std::uint32_t row;
  std::array<std::uint32_t, 3> rows;  ///< of the skin it hangs on, or kNoIndex
  std::array<double, 3> shares;
};

struct ShapeState {
  std::vector<std::uint32_t> used;  ///< #rows: numbers among the used vertices
  std::vector<PartMove> parts;
  std::vector<LidClosure> lids;  ///< of the eyes
  std::vector<Hanging> hanging;
};

std::uint32_t place_in(std::span<const std::uint32_t> sorted, std::uint32_t value) {
  const auto at = std::lower_bound(sorted.begin(), sorted.end(), value);
  if (at == sorted.end() || *at != value) return kNoIndex;
  return static_cast<std::uint32_t>(at - sorted.begin());
}

std::vector<std::uint32_t> used_vertices(const ShapeSet& set) {
  std::vector<std::uint32_t> used;
  for (const Shape& shape : set.shapes) {
    std::vector<std::uint32_t> both;
    std::set_union(used.begin(), used.end(), shape.moves.vertices.begin(),
                   shape.moves.vertices.end(), std::back_inserter(both));
    used = std::move(both);
  }
  return used;
}

}  // namespace

struct ShapeTransfer::State {
  const FaceSet& faces;
  const ShapeSet& set;
  HeadAxes axes;
  FacesAround around;
  std::vector<std::uint32_t> skin;  ///< ascending
  std::vector<RigidPart> rigid;
  std::vector<Eye> eyes;
  std::vector<std::uint32_t> used;  ///< vertices that some shape moves
  FrameField field;
  std::vector<ShapeState> shapes;

  void add_part(const Part& part, const PartList& parts, const Positions& mean);
  void add_eye(const Part& part, const ComponentShape& ball, const Positions& mean);
  ShapeState bind(const Displacements& moves, const Adjacency& adjacency) const;
  void bind_lids(const Displacements& moves, const Adjacency& adjacency, ShapeState& state) const;
  Displacements carry(std::size_t shape, std::size_t target, const Positions& face,
                      const FrameField::Frames& frames,
                      std::span<const Eigen::Matrix3d> maps) const;
  void carry_part(const PartMove& part, const Displacements& shape, const Positions& face,
                  const FrameField::Frames& frames, const Eigen::Matrix3d& map,
                  Positions& moves) const;
};

void ShapeTransfer::State::add_part(const Part& part, const PartList& parts,
                                    const Positions& mean) {
  RigidPart bound{part.vertices, some_of(part.vertices, kMostFitted), {}, Eigen::Vector3d::Zero()};
  bound.ones.assign(bound.fitted.size(), 1.0);
  if (part.eyeball) {
    const RigidMotion motion = fit_rigid_motion(mean, set.neutral, bound.fitted, bound.ones);
    bound.middle = motion.apply(parts.shapes[part.ball].centre);
  } else {
    for (const std::uint32_t v : part.vertices) bound.middle += row3(set.neutral, v);
    bound.middle /= static_cast<double>(part.vertices.size());
  }
  rigid.push_back(std::move(bound));
}

void ShapeTransfer::State::add_eye(const Part& part, const ComponentShape& ball,
                                   const Positions& mean) {
  const RigidPart& bound = rigid.back();
  const auto map_in = [&](const Positions& head) {
    const RigidMotion motion = fit_rigid_motion(mean, head, bound.fitted, bound.ones);
    return BallMap(faces.topology, around, head, part.surface, motion.apply(ball.centre),
                   motion.scale * ball.radius, axes);
  };
  Eye eye{rigid.size() - 1, {map_in(set.neutral), {}, {}}, {}};
  eye.balls.resize(faces.heads.size());
  parallel_for_each(faces.heads.size(),
                    [&](std::size_t h) { eye.balls[h] = map_in(faces.heads[h].positions); });
  const BallMap& here = eye.of_template.ball;
  eye.of_template.lids = find_lids(set.neutral, PointGrid(set.neutral, part.vertices),
                                   here.centre(), here.radius(), axes, skin);
  for (const std::uint32_t v : skin) {
    if (length3(row3(set.neutral, v) - here.centre()) < kEyeSkin * here.radius()) {
      eye.of_template.skin.push_back(v);
    }
  }
  eyes.push_back(std::move(eye));
}

ShapeTransfer::ShapeTransfer(const FaceSet& faces, const Adjacency& adjacency,
                             const PartList& parts, const HeadAxes& axes, const ShapeSet& shapes) {
  auto state = std::make_unique<State>(
      State{faces, shapes, axes, FacesAround(faces.topology), {}, {}, {}, {}, {}, {}});
  std::vector<bool> is_skin(static_cast<std::size_t>(faces.topology.vertex_count), true);
  for (const Part& part : parts.parts) {
    for (const std::uint32_t v : part.vertices) is_skin[v] = false;
  }
  for (std::uint32_t v = 0; v < is_skin.size(); ++v) {
    if (is_skin[v] && !state->around.of(v).empty()) state->skin.push_back(v);
  }
  const Positions mean = mean_head(faces);
  for (const Part& part : parts.parts) {
    if (part.part_class != PartClass::kRigid) continue;
    state->add_part(part, parts, mean);
    if (part.eyeball) state->add_eye(part, parts.shapes[part.ball], mean);
  }
  state->used = used_vertices(shapes);
  state->field =
      FrameField(shapes.neutral, state->skin, extent_of(shapes.neutral, state->skin), state->used);
  state->shapes.resize(shapes.shapes.size());
  parallel_for_each(shapes.shapes.size(), [&](std::size_t s) {
    state->shapes[s] = state->bind(shapes.shapes[s].moves, adjacency);
  });
  state_ = std::move(state);
}

ShapeTransfer::~ShapeTransfer() = default;

ShapeState ShapeTransfer::State::bind(const Displacements& moves,
                                      const Adjacency& adjacency) const {
  ShapeState state;
  for (const std::uint32_t v : moves.vertices) state.used.push_back(place_in(used, v));
  Positions shape = set.neutral;
  moves.add_to(shape);
  for (std::size_t p = 0; p < rigid.size(); ++p) {
    PartMove part{p, {}, {}, {}};
    for (const std::uint32_t v : rigid[p].vertices) {
      const std::uint32_t row = place_in(moves.vertices, v);
      if (row != kNoIndex) part.rows.push_back(row);
    }
    if (part.rows.empty()) continue;
    part.motion = fit_rigid_motion(set.neutral, shape, rigid[p].fitted, rigid[p].ones);
    for (const std::uint32_t row : part.rows) {
      const std::uint32_t v = moves.vertices[row];
      part.rests.push_back(row3(shape, v) - part.motion.apply(row3(set.neutral, v)));
    }
    state.parts.push_back(std::move(part));
  }
  bind_lids(moves, adjacency, state);
  return state;
}

void ShapeTransfer::State::bind_lids(const Displacements& moves, const Adjacency& adjacency,
                                     ShapeState& state) const {
  std::vector<bool> fitted(moves.vertices.size(), false);
  for (const Eye& eye : eyes) {
    LidClosure lids(eye.of_template, adjacency, set.neutral, moves, axes);
    for (const std::uint32_t row : lids.rows()) fitted[row] = true;
    state.lids.push_back(std::move(lids));
  }
  std::vector<bool> is_free(static_cast<std::size_t>(set.neutral.rows()), true);
  for (const std::uint32_t v : skin) is_free[v] = false;
  for (const RigidPart& part : rigid) {
    for (const std::uint32_t v : part.vertices) is_free[v] = false;
  }
  std::vector<std::uint32_t> lid_skin;
  for (const Eye& eye : eyes) {
    lid_skin.insert(lid_skin.end(), eye.of_template.skin.begin(), eye.of_template.skin.end());
  }
  if (lid_skin.empty()) return;
  const PointGrid grid(set.neutral, lid_skin);
  const double reach = eyes.front().of_template.ball.radius();
  for (std::uint32_t row = 0; row < moves.vertices.size(); ++row) {
    const std::uint32_t v = moves.vertices[row];
    if (!is_free[v]) continue;
    const Eigen::Vector3d point = row3(set.neutral, v);
    const auto nearest = grid.nearest(point, reach);
    if (nearest.vertex == kNoIndex) continue;
    const SurfacePoint place =
        nearest_around(faces.topology, around, set.neutral, nearest.vertex, point);
    Hanging hanging{row, {}, place.shares};
    bool any = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t corner = place_in(moves.vertices, place.corners[k]);
      hanging.rows[k] = corner != kNoIndex && fitted[corner] ? corner : kNoIndex;
      any = any || hanging.rows[k] != kNoIndex;
    }
    if (any) state.hanging.push_back(hanging);
  }
}

void ShapeTransfer::State::carry_part(const PartMove& part, const Displacements& shape,
                                      const Positions& face, const FrameField::Frames& frames,
                                      const Eigen::Matrix3d& map, Positions& moves) const {
  const RigidPart& bound = rigid[part.part];
  const RigidMotion home = fit_rigid_motion(set.neutral, face, bound.fitted, bound.ones);
  const Eigen::Vector3d middle = home.apply(bound.middle);
  const Eigen::Vector3d shift = apply3(map, part.motion.apply(bound.middle) - bound.middle);
  for (std::size_t i = 0; i < part.rows.size(); ++i) {
    const std::uint32_t row = part.rows[i];
    const Eigen::Vector3d arm = row3(face, shape.vertices[row]) - middle;
    // The template's turn, as the whole face is turned against it.
    const Eigen::Vector3d on_template =
        frames.whole.undo(frames.whole.to + arm) - frames.whole.from;
    const Eigen::Vector3d turned = frames.whole.turn(part.motion.turn(on_template));
    moves.row(row) = (turned - arm + shift + apply3(map, part.rests[i])).transpose();
  }
}

Displacements ShapeTransfer::State::carry(std::size_t number, std::size_t target,
                                          const Positions& face, const FrameField::Frames& frames,
                                          std::span<const Eigen::Matrix3d> maps) const {
  const Displacements& shape = set.shapes[number].moves;
  const ShapeState& state = shapes[number];
  Displacements result{shape.vertices, Positions(shape.moves.rows(), 3)};
  for (std::size_t i = 0; i < shape.vertices.size(); ++i) {
    const auto row = static_cast<Index>(i);
    result.moves.row(row) = apply3(maps[state.used[i]], row3(shape.moves, row)).transpose();
  }
  for (const PartMove& part : state.parts) {
    Eigen::Matrix3d map = Eigen::Matrix3d::Zero();
    for (const std::uint32_t row : part.rows) map += maps[state.used[row]];
    map /= static_cast<double>(part.rows.size());
    carry_part(part, shape, face, frames, map, result.moves);
  }
  const Positions carried = result.moves;
  for (std::size_t e = 0; e < eyes.size(); ++e) {
    if (state.lids[e].empty()) continue;
    const BallMap& ball = eyes[e].balls[target];
    const RigidPart& part = rigid[eyes[e].part];
    const FaceEye eye{
        &ball, fit_rigid_motion(faces.heads[target].positions, face, part.fitted, part.ones)};
    state.lids[e].fit(face, eye, frames.whole, result.moves);
  }
  for (const Hanging& hanging : state.hanging) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t on = hanging.rows[k];
      if (on == kNoIndex) continue;
      result.moves.row(hanging.row) += hanging.shares[k] * (result.moves.row(on) - carried.row(on));
    }
  }
  return result;
}

std::vector<Displacements> ShapeTransfer::carry(Index target, const Positions& face) const {
  const State& state = *state_;
  const FrameField::Frames frames = state.field.frames(face);
  std::vector<Eigen::Matrix3d> maps(state.used.size());
  for (std::size_t i = 0; i < maps.size(); ++i) maps[i] = state.field.at(i, frames);
  std::vector<Displacements> shapes;
  for (std::size_t s = 0; s < state.shapes.size(); ++s) {
    shapes.push_back(state.carry(s, static_cast<std::size_t>(target), face, frames, maps));
  }
  return shapes;
}

}  // namespace crowdface
