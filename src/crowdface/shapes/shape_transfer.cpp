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
#include "crowdface/shapes/kept_contacts.h"
#include "crowdface/shapes/lid_closure.h"
#include "crowdface/shapes/rigid_turn.h"
#include "crowdface/shapes/skin_crossings.h"

namespace crowdface {
namespace {

/// Vertices of an eyeball or a jaw that tell where all of it is.
constexpr std::size_t kMostFitted = 500;
/// How far from an eyeball's centre its lids' skin may be, as a share of its radius.
constexpr double kEyeSkin = 3;
/// A shape that takes lips through each other by more than this share of the skin's extent, some 5 mm, is made
/// to be added to another; its crossings are meant.
constexpr double kMeant = 0.012;

struct Eye {
  std::size_t part;  ///< of the rigid ones
  TemplateEye of_template;
  std::vector<BallMap> balls;  ///< #heads
};

/// A rigid part in a shape.
struct PartMove {
  std::size_t part;
  std::vector<std::uint32_t> rows, vertices;
  std::vector<RigidTurn> turns;  ///< #sets
};

/// The lids of an eye in a shape.
struct LidMove {
  LidClosure lids;
  std::vector<LidClosure::Goals> goals;  ///< #sets
};

/// A vertex of a bound part that goes along with lids.
struct Hanging {
  std::uint32_t row;
  std::array<std::uint32_t, 3> rows;  ///< of the skin it hangs on, or kNoIndex
  std::array<double, 3> shares;
};

struct ShapeState {
  std::vector<std::uint32_t> used;  ///< #rows: numbers among the used vertices
  std::vector<SingleRows> of_head;  ///< #heads by #rows, as on the mean head; empty: one set
  std::vector<PartMove> parts;
  std::vector<LidMove> lids;  ///< of the eyes
  std::vector<Hanging> hanging;
  SkinCrossings::Watched watched;
  bool moves_contacts = false;
  std::vector<std::vector<double>> widening;  ///< #sets, if it does: of the gaps between lips
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

/// A head's displacements as rows of the whole set's.
Positions rows_in(const std::vector<std::uint32_t>& vertices, const OwnShape& shape) {
  Positions rows = Positions::Zero(static_cast<Index>(vertices.size()), 3);
  for (std::size_t i = 0; i < shape.vertices.size(); ++i) {
    rows.row(place_in(vertices, shape.vertices[i])) =
        shape.moves.row(static_cast<Index>(i)).cast<double>();
  }
  return rows;
}

std::vector<std::uint32_t> skin_of(const FaceSet& faces, const PartList& parts,
                                   const FacesAround& around) {
  std::vector<bool> is_skin(static_cast<std::size_t>(faces.topology.vertex_count), true);
  for (const Part& part : parts.parts) {
    for (const std::uint32_t v : part.vertices) is_skin[v] = false;
  }
  std::vector<std::uint32_t> skin;
  for (std::uint32_t v = 0; v < is_skin.size(); ++v) {
    if (is_skin[v] && !around.of(v).empty()) skin.push_back(v);
  }
  return skin;
}

}  // namespace

struct ShapeTransfer::State {
  const FaceSet& faces;
  const ShapeSet& set;
  HeadAxes axes;
  FacesAround around;
  std::vector<std::uint32_t> skin;  ///< ascending
  std::vector<RigidPart> rigid;
  std::vector<std::vector<double>> rigid_alpha;  ///< #rigid by #regions, of the skin at them
  std::vector<Eye> eyes;
  std::vector<std::uint32_t> used;  ///< vertices that some shape moves
  RegionWeights::Alpha alpha;       ///< #used by #regions: of the skin nearest to them
  KeptContacts contacts;
  RegionWeights::Alpha contact_alpha;  ///< #contacts by #regions
  FrameField field;
  double extent = 0;  ///< of the template's skin
  SkinCrossings crossings;
  CrossingSearch watched;  ///< of any shape
  std::vector<ShapeState> shapes;

  /// An eyeball of a face, and how far the skin around it is from it at rest.
  struct PlacedEye {
    FaceEye eye;
    std::vector<double> rest_gaps;
  };
  /// A face, and how it is turned and stretched.
  struct Carrier {
    const Positions& mesh;
    FrameField::Frames frames;
    std::vector<Eigen::Matrix3d> maps;  ///< #used
    std::vector<double> gaps;           ///< #contacts
    std::vector<bool> at_rest;          ///< #V: at crossings of its skin
  };
  Carrier carrier_to(const Positions& face) const;
  PlacedEye placed(const Eye& eye, const FaceEye& there, const Positions& face) const {
    return {there, eye_gaps(eye.of_template, there, face)};
  }
  std::vector<PlacedEye> placed_eyes(std::size_t target, const Positions& face) const;

  void add_part(const Part& part, const PartList& parts, const Positions& mean);
  void add_eye(const Part& part, const ComponentShape& ball, const Positions& mean);
  void look_up_regions(const RegionWeights& regions);
  ShapeState bind(const Displacements& moves, const Adjacency& adjacency) const;
  void bind_lids(const Displacements& moves, const Adjacency& adjacency, ShapeState& state) const;
  SkinCrossings::Watched watch(const Displacements& moves, const ShapeState& state) const;
  void add_sets();
  void add_set(const Carrier& carrier, const Displacements& shape,
               std::span<const PlacedEye> at_eyes, ShapeState& state) const;
  void keep_contacts(const ShapeState& state, const Carrier& carrier, const RegionShares& shares,
                     Positions& mesh, Displacements& result) const;
  SingleRows undone(const Carrier& carrier, const ShapeState& state, const Positions& moves) const;
  Positions mixed_moves(std::size_t shape, const RegionShares& shares) const;
  Eigen::Matrix3d map_of(const PartMove& part, const ShapeState& state,
                         std::span<const Eigen::Matrix3d> maps) const;
  Displacements carry(std::size_t shape, std::span<const PlacedEye> at_eyes, const Carrier& carrier,
                      const RegionShares& shares, Positions& mesh, Index& crossing) const;
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
                             const PartList& parts, const HeadAxes& axes, const ShapeSet& shapes,
                             const RegionWeights& regions) {
  const FacesAround around(faces.topology);
  std::vector<std::uint32_t> skin = skin_of(faces, parts, around);
  KeptContacts contacts(faces, adjacency, skin);
  auto state = std::make_unique<State>(State{faces,
                                             shapes,
                                             axes,
                                             around,
                                             std::move(skin),
                                             {},
                                             {},
                                             {},
                                             {},
                                             {},
                                             std::move(contacts),
                                             {},
                                             {},
                                             0,
                                             {},
                                             {},
                                             {}});
  state->extent = extent_of(shapes.neutral, state->skin);
  state->crossings = SkinCrossings(faces.topology, state->skin, state->extent, axes);
  const Positions mean = mean_head(faces);
  for (const Part& part : parts.parts) {
    if (part.part_class != PartClass::kRigid) continue;
    state->add_part(part, parts, mean);
    if (part.eyeball) state->add_eye(part, parts.shapes[part.ball], mean);
  }
  state->used = used_vertices(shapes);
  state->field = FrameField(shapes.neutral, state->skin, state->extent, state->used);
  if (!shapes.of_head.empty()) state->look_up_regions(regions);
  state->shapes.resize(shapes.shapes.size());
  parallel_for_each(shapes.shapes.size(), [&](std::size_t s) {
    state->shapes[s] = state->bind(shapes.shapes[s].moves, adjacency);
  });
  std::vector<const CrossingSearch*> watched;
  for (const ShapeState& shape : state->shapes) watched.push_back(&shape.watched.search);
  state->watched = state->crossings.watch_all(shapes.neutral, watched);
  state->add_sets();
  state_ = std::move(state);
}

ShapeTransfer::~ShapeTransfer() = default;

/// Masks say nothing of lashes and eyeballs.
void ShapeTransfer::State::look_up_regions(const RegionWeights& regions) {
  const PointGrid grid(set.neutral, skin);
  const auto nearest = [&](std::uint32_t v) {
    return std::ranges::binary_search(skin, v) ? v : grid.nearest(row3(set.neutral, v)).vertex;
  };
  alpha.resize(static_cast<Index>(used.size()), regions.alpha.cols());
  parallel_for_each(used.size(), [&](std::size_t i) {
    alpha.row(static_cast<Index>(i)) = regions.alpha.row(nearest(used[i]));
  });
  const std::vector<std::uint32_t> at_contacts = contacts.vertices();
  contact_alpha.resize(static_cast<Index>(at_contacts.size()), regions.alpha.cols());
  for (std::size_t p = 0; p < at_contacts.size(); ++p) {
    contact_alpha.row(static_cast<Index>(p)) = regions.alpha.row(at_contacts[p]);
  }
  for (const RigidPart& part : rigid) {
    std::vector<double> mean(static_cast<std::size_t>(regions.alpha.cols()), 0.0);
    for (const std::uint32_t v : part.fitted) {
      const std::uint32_t at = nearest(v);
      for (std::size_t k = 0; k < mean.size(); ++k) {
        mean[k] +=
            regions.alpha(at, static_cast<Index>(k)) / static_cast<double>(part.fitted.size());
      }
    }
    rigid_alpha.push_back(std::move(mean));
  }
}

ShapeState ShapeTransfer::State::bind(const Displacements& moves,
                                      const Adjacency& adjacency) const {
  ShapeState state;
  for (const std::uint32_t v : moves.vertices) state.used.push_back(place_in(used, v));
  for (std::size_t p = 0; p < rigid.size(); ++p) {
    PartMove part{p, {}, {}, {}};
    for (const std::uint32_t v : rigid[p].vertices) {
      const std::uint32_t row = place_in(moves.vertices, v);
      if (row == kNoIndex) continue;
      part.rows.push_back(row);
      part.vertices.push_back(v);
    }
    if (!part.rows.empty()) state.parts.push_back(std::move(part));
  }
  bind_lids(moves, adjacency, state);
  state.moves_contacts = contacts.moved_by(moves.vertices);
  state.watched = watch(moves, state);
  return state;
}

SkinCrossings::Watched ShapeTransfer::State::watch(const Displacements& moves,
                                                   const ShapeState& state) const {
  Positions mesh = set.neutral;
  moves.add_to(mesh);
  const std::vector<double> gaps = contacts.gaps(mesh);
  const bool is_meant =
      std::ranges::any_of(gaps, [&](double gap) { return gap < -kMeant * extent; });
  std::vector<signed char> side;
  for (std::size_t e = 0; e < eyes.size(); ++e) {
    if (!state.lids[e].lids.closes()) continue;
    side.resize(static_cast<std::size_t>(mesh.rows()), 0);
    lid_sides(eyes[e].of_template, set.neutral, side);
  }
  SkinCrossings::Watched found = crossings.watch(set.neutral, moves, std::move(side));
  found.is_meant = is_meant;
  return found;
}

void ShapeTransfer::State::bind_lids(const Displacements& moves, const Adjacency& adjacency,
                                     ShapeState& state) const {
  std::vector<bool> fitted(moves.vertices.size(), false);
  for (const Eye& eye : eyes) {
    LidClosure lids(eye.of_template, adjacency, set.neutral, moves, axes);
    for (const std::uint32_t row : lids.rows()) fitted[row] = true;
    state.lids.push_back({std::move(lids), {}});
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

ShapeTransfer::State::Carrier ShapeTransfer::State::carrier_to(const Positions& face) const {
  Carrier carrier{face, field.frames(face), std::vector<Eigen::Matrix3d>(used.size()),
                  contacts.gaps(face), crossings.crossing_at_rest(face, watched)};
  for (std::size_t i = 0; i < used.size(); ++i) carrier.maps[i] = field.at(i, carrier.frames);
  return carrier;
}

std::vector<ShapeTransfer::State::PlacedEye> ShapeTransfer::State::placed_eyes(
    std::size_t target, const Positions& face) const {
  std::vector<PlacedEye> there;
  for (const Eye& eye : eyes) {
    const RigidPart& part = rigid[eye.part];
    const RigidMotion motion =
        fit_rigid_motion(faces.heads[target].positions, face, part.fitted, part.ones);
    there.push_back(placed(eye, {&eye.balls[target], motion}, face));
  }
  return there;
}

Eigen::Matrix3d ShapeTransfer::State::map_of(const PartMove& part, const ShapeState& state,
                                             std::span<const Eigen::Matrix3d> maps) const {
  Eigen::Matrix3d map = Eigen::Matrix3d::Zero();
  for (const std::uint32_t row : part.rows) map += maps[state.used[row]];
  return map / static_cast<double>(part.rows.size());
}

/// Finds what each set's shapes do to parts and lids, and takes out of the heads' own shapes how the heads
/// are turned and stretched.
void ShapeTransfer::State::add_sets() {
  const std::size_t heads = set.of_head.size();
  for (std::size_t h = 0; h < std::max<std::size_t>(heads, 1); ++h) {
    const Carrier carrier = carrier_to(heads > 0 ? faces.heads[h].positions : set.neutral);
    std::vector<PlacedEye> at_eyes;
    for (const Eye& eye : eyes) {
      const FaceEye there{heads > 0 ? &eye.balls[h] : &eye.of_template.ball, {}};
      at_eyes.push_back(placed(eye, there, carrier.mesh));
    }
    parallel_for_each(shapes.size(), [&](std::size_t s) {
      const Displacements& all = set.shapes[s].moves;
      if (heads == 0) return add_set(carrier, all, at_eyes, shapes[s]);
      const Positions own = rows_in(all.vertices, set.of_head[h][s]);
      add_set(carrier, {all.vertices, own}, at_eyes, shapes[s]);
      shapes[s].of_head.push_back(undone(carrier, shapes[s], own));
    });
  }
}

void ShapeTransfer::State::add_set(const Carrier& carrier, const Displacements& shape,
                                   std::span<const PlacedEye> at_eyes, ShapeState& state) const {
  const Positions& moves = shape.moves;
  const RigidMotion& whole = carrier.frames.whole;
  for (PartMove& part : state.parts) {
    const RigidPart& bound = rigid[part.part];
    const Eigen::Matrix3d map = map_of(part, state, carrier.maps);
    const PlacedPart placed(bound, set.neutral, carrier.mesh, whole, map);
    part.turns.push_back(find_turn(bound, placed, part.vertices, part.rows, moves));
  }
  for (std::size_t e = 0; e < eyes.size(); ++e) {
    LidMove& move = state.lids[e];
    if (move.lids.empty()) continue;
    const auto& [eye, rest_gaps] = at_eyes[e];
    move.goals.push_back(move.lids.goals(carrier.mesh, eye, rest_gaps, whole, moves));
  }
  Positions moved = carrier.mesh;
  shape.add_to(moved);
  if (!set.of_head.empty() && !state.watched.search.triangles().empty()) {
    crossings.excuse(moved, state.watched);
  }
  if (!state.moves_contacts) return;
  std::vector<double>& widening = state.widening.emplace_back(contacts.gaps(moved));
  for (std::size_t p = 0; p < widening.size(); ++p) {
    widening[p] = (widening[p] - carrier.gaps[p]) / whole.scale;
  }
}

/// Lips that the shape leaves closed stay closed.
void ShapeTransfer::State::keep_contacts(const ShapeState& state, const Carrier& carrier,
                                         const RegionShares& shares, Positions& mesh,
                                         Displacements& result) const {
  std::vector<double> widening(state.widening.front().size(), 0.0);
  for (std::size_t p = 0; p < widening.size(); ++p) {
    SetShares here = {{0, 1}};
    if (!state.of_head.empty()) {
      const Index at = static_cast<Index>(p);
      here = shares_at(
          std::span(&contact_alpha(at, 0), static_cast<std::size_t>(contact_alpha.cols())), shares);
    }
    for (const SetShare& of_set : here) {
      widening[p] += of_set.share * carrier.frames.whole.scale * state.widening[of_set.set][p];
    }
  }
  result.add_to(mesh);
  contacts.keep(carrier.gaps, widening, mesh);
  for (std::size_t i = 0; i < result.vertices.size(); ++i) {
    const std::uint32_t v = result.vertices[i];
    auto move = result.moves.row(static_cast<Index>(i));
    const Eigen::RowVector3d before = carrier.mesh.row(v) + move;
    move += mesh.row(v) - before;
  }
  for (const std::uint32_t v : result.vertices) mesh.row(v) = carrier.mesh.row(v);
  for (const std::uint32_t v : contacts.moved()) mesh.row(v) = carrier.mesh.row(v);
}

SingleRows ShapeTransfer::State::undone(const Carrier& carrier, const ShapeState& state,
                                        const Positions& moves) const {
  SingleRows rows(moves.rows(), 3);
  for (Index i = 0; i < moves.rows(); ++i) {
    const Eigen::Matrix3d& map = carrier.maps[state.used[static_cast<std::size_t>(i)]];
    rows.row(i) = apply3(inverse3(map), row3(moves, i)).cast<float>().transpose();
  }
  return rows;
}

Positions ShapeTransfer::State::mixed_moves(std::size_t number, const RegionShares& shares) const {
  const ShapeState& state = shapes[number];
  Positions moves = Positions::Zero(static_cast<Index>(state.used.size()), 3);
  for (std::size_t k = 0; k < shares.size(); ++k) {
    for (const SetShare& of_set : shares[k]) {
      const SingleRows& own = state.of_head[of_set.set];
      for (Index i = 0; i < moves.rows(); ++i) {
        const double part = alpha(state.used[static_cast<std::size_t>(i)], static_cast<Index>(k));
        if (part == 0) continue;
        const double share = part * of_set.share;
        for (Index c = 0; c < 3; ++c) moves(i, c) += share * static_cast<double>(own(i, c));
      }
    }
  }
  return moves;
}

/// \param mesh  the face at rest; changed while it works
Displacements ShapeTransfer::State::carry(std::size_t number, std::span<const PlacedEye> at_eyes,
                                          const Carrier& carrier, const RegionShares& shares,
                                          Positions& mesh, Index& crossing) const {
  const ShapeState& state = shapes[number];
  const SetShares one_set = {{0, 1}};
  const auto shares_of = [&](std::size_t part) {
    return state.of_head.empty() ? one_set : shares_at(rigid_alpha[part], shares);
  };
  Positions mixed;
  if (!state.of_head.empty()) mixed = mixed_moves(number, shares);
  const Positions& on_template = state.of_head.empty() ? set.shapes[number].moves.moves : mixed;
  Displacements result{set.shapes[number].moves.vertices, Positions(on_template.rows(), 3)};
  for (std::size_t i = 0; i < state.used.size(); ++i) {
    const auto row = static_cast<Index>(i);
    result.moves.row(row) = apply3(carrier.maps[state.used[i]], row3(on_template, row)).transpose();
  }
  const RigidMotion& whole = carrier.frames.whole;
  for (const PartMove& part : state.parts) {
    const Eigen::Matrix3d map = map_of(part, state, carrier.maps);
    const PlacedPart placed(rigid[part.part], set.neutral, carrier.mesh, whole, map);
    carry_turn(mean_turn(part.turns, shares_of(part.part)), placed, part.vertices, part.rows,
               result.moves);
  }
  Positions carried;
  if (!state.hanging.empty()) carried = result.moves;
  for (std::size_t e = 0; e < eyes.size(); ++e) {
    const LidMove& move = state.lids[e];
    if (move.lids.empty()) continue;
    const auto& [eye, rest_gaps] = at_eyes[e];
    move.lids.fit(carrier.mesh, eye, rest_gaps, whole,
                  LidClosure::mean(move.goals, shares_of(eyes[e].part)), result.moves);
  }
  if (state.moves_contacts) keep_contacts(state, carrier, shares, mesh, result);
  crossing = crossings.mend(carrier.mesh, carrier.at_rest, state.watched, mesh, result);
  for (const Hanging& hanging : state.hanging) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t on = hanging.rows[k];
      if (on == kNoIndex) continue;
      result.moves.row(hanging.row) += hanging.shares[k] * (result.moves.row(on) - carried.row(on));
    }
  }
  return result;
}

std::vector<Displacements> ShapeTransfer::carry(Index target, const Positions& face,
                                                std::span<const RegionShares> shares,
                                                std::vector<Index>* crossing) const {
  const State& state = *state_;
  const State::Carrier carrier = state.carrier_to(face);
  std::vector<Displacements> shapes;
  std::vector<Index> left(state.shapes.size());
  const auto at_eyes = state.placed_eyes(static_cast<std::size_t>(target), face);
  Positions mesh = face;
  for (std::size_t s = 0; s < state.shapes.size(); ++s) {
    shapes.push_back(state.carry(s, at_eyes, carrier,
                                 s < shares.size() ? shares[s] : RegionShares(), mesh, left[s]));
  }
  if (crossing != nullptr) *crossing = std::move(left);
  return shapes;
}

std::size_t ShapeTransfer::memory_bytes() const {
  std::size_t bytes = static_cast<std::size_t>(state_->alpha.size()) * sizeof(double);
  for (const ShapeState& state : state_->shapes) {
    for (const SingleRows& rows : state.of_head) {
      bytes += static_cast<std::size_t>(rows.size()) * sizeof(float);
    }
  }
  return bytes;
}

}  // namespace crowdface
