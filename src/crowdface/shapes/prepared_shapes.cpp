// SPDX-License-Identifier: Apache-2.0
#include "crowdface/shapes/prepared_shapes.h"

#include <algorithm>
#include <initializer_list>
#include <iterator>

#include "crowdface/core/parallel.h"
#include "crowdface/core/selection.h"
#include "crowdface/mesh/all_columns.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/component_shape.h"
#include "crowdface/parts/eye_socket.h"
#include "crowdface/parts/point_grid.h"
#include "crowdface/parts/surface_point.h"

namespace crowdface {
namespace {

/// The motion of an eyeball or jaw is fitted to at most this number of its vertices.
constexpr std::size_t kMaxFitted = 500;
/// Skin belongs to an eye if its distance from the eyeball's centre is at most this many radii.
constexpr double kEyeSkin = 3;
/// A shape is corrective (see find_prerequisites) if its lips overlap by more than this length, as
/// a fraction of the skin's extent; about 5 mm.
constexpr double kFarThrough = 0.012;

std::vector<std::uint32_t> all_moved_vertices(const ShapeSet& shape_set) {
  std::vector<std::uint32_t> used;
  for (const Shape& shape : shape_set.shapes) {
    std::vector<std::uint32_t> both;
    std::set_union(used.begin(), used.end(), shape.moves.vertices.begin(),
                   shape.moves.vertices.end(), std::back_inserter(both));
    used = std::move(both);
  }
  return used;
}

/// Returns a head's displacements, one row for each vertex of the mean shape; zero for vertices
/// that do not move on this head.
Positions rows_in(const std::vector<std::uint32_t>& vertices, const OwnShape& shape) {
  Positions rows = Positions::Zero(static_cast<Index>(vertices.size()), 3);
  for (std::size_t i = 0; i < shape.vertices.size(); ++i) {
    rows.row(index_in_list(vertices, shape.vertices[i])) =
        shape.moves.row(static_cast<Index>(i)).cast<double>();
  }
  return rows;
}

}  // namespace

std::vector<std::optional<std::size_t>> find_prerequisites(const ShapeSet& shape_set,
                                                           const GapPreserver& contacts,
                                                           double extent) {
  const auto through_in = [&](std::initializer_list<std::size_t> shapes) {
    Positions mesh = shape_set.neutral;
    for (const std::size_t s : shapes) shape_set.shapes[s].moves.add_to(mesh);
    return contacts.max_overlap(mesh);
  };
  const std::size_t count = shape_set.shapes.size();
  std::vector<double> through(count);
  parallel_for_each(count, [&](std::size_t s) { through[s] = through_in({s}); });
  std::vector<std::optional<std::size_t>> prerequisites(count);
  for (std::size_t s = 0; s < count; ++s) {
    if (through[s] <= kFarThrough * extent) continue;
    double least = through[s] / 2;
    for (std::size_t other = 0; other < count; ++other) {
      if (through[other] > kFarThrough * extent) continue;
      const double both = through_in({s, other});
      if (both >= least) continue;
      least = both;
      prerequisites[s] = other;
    }
  }
  return prerequisites;
}

PreparedShapes::PreparedShapes(const HeadSet& all_faces, const Adjacency& adjacency,
                               const PartList& parts, const HeadAxes& head_axes,
                               const ShapeSet& shape_set, const RegionWeights& regions)
    : faces(all_faces),
      shape_set(shape_set),
      axes(head_axes),
      vertex_faces(faces.topology),
      skin(skin_of(parts, vertex_faces)),
      moved_vertices(all_moved_vertices(shape_set)),
      contacts(faces, adjacency, skin),
      extent(extent_of(shape_set.neutral, skin)),
      crossings(faces.topology, skin, extent, axes) {
  const Positions mean = mean_head(faces);
  for (const Part& part : parts.parts) {
    if (part.part_class != PartClass::kRigid) continue;
    add_part(part, parts, mean);
    if (part.is_eyeball) add_eye(part, parts.shapes[part.ball_component], mean);
  }
  find_inner_vertices(parts);
  frame_field = FrameField(shape_set.neutral, skin, extent, moved_vertices);
  if (!shape_set.head_shapes.empty()) look_up_regions(regions);
  shapes.resize(shape_set.shapes.size());
  const auto prerequisites = find_prerequisites(shape_set, contacts, extent);
  parallel_for_each(shapes.size(), [&](std::size_t s) {
    shapes[s].prerequisite = prerequisites[s];
    prepare_shape(shape_set.shapes[s].moves, adjacency, shapes[s]);
  });
  std::vector<const CrossingSearch*> searches;
  for (const PreparedShape& shape : shapes) searches.push_back(&shape.searched_skin.search);
  rest_search = crossings.merge_searches(shape_set.neutral, searches);
  add_sets();
}

void PreparedShapes::add_part(const Part& part, const PartList& parts, const Positions& mean) {
  RigidPart bound{
      part.vertices, evenly_spaced_items(part.vertices, kMaxFitted), {}, Eigen::Vector3d::Zero()};
  bound.unit_weights.assign(bound.fitted_vertices.size(), 1.0);
  if (part.is_eyeball) {
    const RigidMotion motion =
        fit_rigid_motion(mean, shape_set.neutral, bound.fitted_vertices, bound.unit_weights);
    bound.centre = motion.apply(parts.shapes[part.ball_component].centre);
  } else {
    bound.centre = centre_of(shape_set.neutral, part.vertices);
  }
  rigid_parts.push_back(std::move(bound));
}

void PreparedShapes::add_eye(const Part& part, const ComponentShape& ball, const Positions& mean) {
  const RigidPart& bound = rigid_parts.back();
  const auto map_in = [&](const Positions& head) {
    const RigidMotion motion =
        fit_rigid_motion(mean, head, bound.fitted_vertices, bound.unit_weights);
    return BallMap(faces.topology, vertex_faces, head, part.surface, motion.apply(ball.centre),
                   motion.scale * ball.radius, axes);
  };
  PreparedEye eye{rigid_parts.size() - 1, {map_in(shape_set.neutral), {}, {}}, {}};
  eye.balls.resize(faces.heads.size());
  parallel_for_each(faces.heads.size(),
                    [&](std::size_t h) { eye.balls[h] = map_in(faces.heads[h].positions); });
  const BallMap& here = eye.template_eye.ball;
  eye.template_eye.lids = find_lids(shape_set.neutral, PointGrid(shape_set.neutral, part.vertices),
                                    here.centre(), here.radius(), axes, skin);
  for (const std::uint32_t v : skin) {
    if ((row3(shape_set.neutral, v) - here.centre()).norm() < kEyeSkin * here.radius()) {
      eye.template_eye.skin_vertices.push_back(v);
    }
  }
  eyes.push_back(std::move(eye));
}

void PreparedShapes::find_inner_vertices(const PartList& parts) {
  for (const Part& part : parts.parts) {
    if (part.is_eyeball) continue;
    std::ranges::copy_if(part.vertices, std::back_inserter(inner_vertices), [&](std::uint32_t v) {
      return std::ranges::none_of(eyes, [&](const PreparedEye& eye) {
        const BallMap& ball = eye.template_eye.ball;
        return (row3(shape_set.neutral, v) - ball.centre()).norm() < kEyeSkin * ball.radius();
      });
    });
  }
}

/// Looks up the region weights of skin and parts. Masks do not cover lashes and eyeballs, so these
/// get the weights of the nearest skin.
void PreparedShapes::look_up_regions(const RegionWeights& regions) {
  const PointGrid grid(shape_set.neutral, skin);
  const auto nearest = [&](std::uint32_t v) {
    return std::ranges::binary_search(skin, v) ? v
                                               : grid.nearest(row3(shape_set.neutral, v)).vertex;
  };
  alpha.resize(static_cast<Index>(moved_vertices.size()), regions.alpha.cols());
  parallel_for_each(moved_vertices.size(), [&](std::size_t i) {
    alpha.row(static_cast<Index>(i)) = regions.alpha.row(nearest(moved_vertices[i]));
  });
  contact_alpha = regions.alpha(contacts.contact_vertices(), kAllColumns);
  for (const RigidPart& part : rigid_parts) {
    std::vector<double> mean(static_cast<std::size_t>(regions.alpha.cols()), 0.0);
    for (const std::uint32_t v : part.fitted_vertices) {
      const std::uint32_t at = nearest(v);
      for (std::size_t k = 0; k < mean.size(); ++k) {
        mean[k] += regions.alpha(at, static_cast<Index>(k)) /
                   static_cast<double>(part.fitted_vertices.size());
      }
    }
    rigid_part_weights.push_back(std::move(mean));
  }
}

void PreparedShapes::prepare_shape(const Displacements& moves, const Adjacency& adjacency,
                                   PreparedShape& state) const {
  for (const std::uint32_t v : moves.vertices)
    state.vertex_indices.push_back(index_in_list(moved_vertices, v));
  for (std::size_t p = 0; p < rigid_parts.size(); ++p) {
    PartMove part{p, {}, {}, {}};
    for (const std::uint32_t v : rigid_parts[p].vertices) {
      const std::uint32_t row = index_in_list(moves.vertices, v);
      if (row == kNoIndex) continue;
      part.rows.push_back(row);
      part.vertices.push_back(v);
    }
    if (!part.rows.empty()) state.parts.push_back(std::move(part));
  }
  prepare_lids(moves, adjacency, state);
  state.moves_contacts = contacts.is_affected_by(moves.vertices);
  state.searched_skin = find_searched_skin(moves, state);
  Positions shaped = shape_set.neutral;
  if (state.prerequisite) shape_set.shapes[*state.prerequisite].moves.add_to(shaped);
  moves.add_to(shaped);
  state.skin_over_parts =
      SkinOverParts(shaped, crossings.mesh(), inner_vertices, moves.vertices, axes, extent);
}

SkinCrossings::SearchedSkin PreparedShapes::find_searched_skin(const Displacements& moves,
                                                               const PreparedShape& state) const {
  std::vector<signed char> side;
  for (std::size_t e = 0; e < eyes.size(); ++e) {
    if (!state.lids[e].lids.closes_lids()) continue;
    side.resize(static_cast<std::size_t>(shape_set.neutral.rows()), 0);
    mark_lid_sides(eyes[e].template_eye, shape_set.neutral, side);
  }
  if (!state.prerequisite)
    return crossings.find_searched_skin(shape_set.neutral, moves, std::move(side));
  Positions rest = shape_set.neutral;
  shape_set.shapes[*state.prerequisite].moves.add_to(rest);
  SkinCrossings::SearchedSkin found = crossings.find_searched_skin(rest, moves, std::move(side));
  found.joins_distant_skin = true;
  return found;
}

void PreparedShapes::prepare_lids(const Displacements& moves, const Adjacency& adjacency,
                                  PreparedShape& state) const {
  std::vector<bool> fitted(moves.vertices.size(), false);
  for (const PreparedEye& eye : eyes) {
    LidClosure lids(eye.template_eye, adjacency, shape_set.neutral, moves, axes);
    for (const std::uint32_t row : lids.adjustable_rows()) fitted[row] = true;
    state.lids.push_back({std::move(lids), {}});
  }
  std::vector<bool> is_free(static_cast<std::size_t>(shape_set.neutral.rows()), true);
  for (const std::uint32_t v : skin) is_free[v] = false;
  for (const RigidPart& part : rigid_parts) {
    for (const std::uint32_t v : part.vertices) is_free[v] = false;
  }
  std::vector<std::uint32_t> lid_skin;
  for (const PreparedEye& eye : eyes) {
    lid_skin.insert(lid_skin.end(), eye.template_eye.skin_vertices.begin(),
                    eye.template_eye.skin_vertices.end());
  }
  if (lid_skin.empty()) return;
  const PointGrid grid(shape_set.neutral, lid_skin);
  const double reach = eyes.front().template_eye.ball.radius();
  for (std::uint32_t row = 0; row < moves.vertices.size(); ++row) {
    const std::uint32_t v = moves.vertices[row];
    if (!is_free[v]) continue;
    const Eigen::Vector3d point = row3(shape_set.neutral, v);
    const auto nearest = grid.nearest(point, reach);
    if (nearest.vertex == kNoIndex) continue;
    const SurfacePoint place = nearest_point_around(faces.topology, vertex_faces, shape_set.neutral,
                                                    nearest.vertex, point);
    LidFollower follower{row, {}, place.shares};
    bool any = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t corner = index_in_list(moves.vertices, place.corners[k]);
      follower.rows[k] = corner != kNoIndex && fitted[corner] ? corner : kNoIndex;
      any = any || follower.rows[k] != kNoIndex;
    }
    if (any) state.lid_followers.push_back(follower);
  }
}

PreparedShapes::FaceFrames PreparedShapes::make_face_frames(const Positions& face) const {
  FaceFrames face_frames{
      face, frame_field.frames(face), std::vector<Eigen::Matrix3d>(moved_vertices.size()),
      contacts.measure_gaps(face), crossings.crossing_at_rest(face, rest_search)};
  for (std::size_t i = 0; i < moved_vertices.size(); ++i)
    face_frames.maps[i] = frame_field.map_at(i, face_frames.frames);
  return face_frames;
}

Eigen::Matrix3d PreparedShapes::mean_map(const PartMove& part, const PreparedShape& state,
                                         std::span<const Eigen::Matrix3d> maps) const {
  Eigen::Matrix3d map = Eigen::Matrix3d::Zero();
  for (const std::uint32_t row : part.rows) map += maps[state.vertex_indices[row]];
  return map / static_cast<double>(part.rows.size());
}

/// Measures how each set of shapes moves parts and lids, and normalises the heads' own shapes by
/// removing the local rotation and stretch of each head.
void PreparedShapes::add_sets() {
  const std::size_t heads = shape_set.head_shapes.size();
  for (std::size_t h = 0; h < std::max<std::size_t>(heads, 1); ++h) {
    const FaceFrames face_frames =
        make_face_frames(heads > 0 ? faces.heads[h].positions : shape_set.neutral);
    std::vector<FaceEye> face_eyes;
    for (const auto& [part, eye, balls] : eyes) {
      face_eyes.push_back(
          make_face_eye(eye, heads > 0 ? balls[h] : eye.ball, {}, face_frames.mesh));
    }
    parallel_for_each(shapes.size(), [&](std::size_t s) {
      const Displacements own = shape_of_set(h, s);
      Positions rest = face_frames.mesh;
      if (const auto& other = shapes[s].prerequisite) shape_of_set(h, *other).add_to(rest);
      add_set(face_frames, rest, own, face_eyes, shapes[s]);
      if (heads > 0)
        shapes[s].head_moves.push_back(normalised_moves(face_frames, shapes[s], own.moves));
    });
  }
}

Displacements PreparedShapes::shape_of_set(std::size_t number, std::size_t shape) const {
  const Displacements& all = shape_set.shapes[shape].moves;
  if (shape_set.head_shapes.empty()) return all;
  return {all.vertices, rows_in(all.vertices, shape_set.head_shapes[number][shape])};
}

void PreparedShapes::add_set(const FaceFrames& face_frames, const Positions& rest,
                             const Displacements& shape, std::span<const FaceEye> face_eyes,
                             PreparedShape& state) const {
  const Positions& moves = shape.moves;
  const RigidMotion& face_motion = face_frames.frames.face_motion;
  for (PartMove& part : state.parts) {
    const RigidPart& bound = rigid_parts[part.part];
    const Eigen::Matrix3d map = mean_map(part, state, face_frames.maps);
    const PlacedPart placed(bound, shape_set.neutral, face_frames.mesh, face_motion, map);
    part.turns.push_back(find_turn(bound, placed, part.vertices, part.rows, moves));
  }
  for (std::size_t e = 0; e < eyes.size(); ++e) {
    LidMove& move = state.lids[e];
    if (move.lids.empty()) continue;
    move.goals.push_back(
        move.lids.measure_goals(face_frames.mesh, face_eyes[e], face_motion, moves));
  }
  Positions moved = rest;
  shape.add_to(moved);
  if (!shape_set.head_shapes.empty() && !state.searched_skin.search.triangles().empty()) {
    crossings.mark_excused(moved, state.searched_skin);
  }
  if (!state.moves_contacts) return;
  std::vector<double>& gap_changes = state.gap_changes.emplace_back(contacts.measure_gaps(moved));
  for (std::size_t p = 0; p < gap_changes.size(); ++p) {
    gap_changes[p] = (gap_changes[p] - face_frames.gaps[p]) / face_motion.scale;
  }
}

SingleRows PreparedShapes::normalised_moves(const FaceFrames& face_frames,
                                            const PreparedShape& state,
                                            const Positions& moves) const {
  SingleRows rows(moves.rows(), 3);
  for (Index i = 0; i < moves.rows(); ++i) {
    const Eigen::Matrix3d& map =
        face_frames.maps[state.vertex_indices[static_cast<std::size_t>(i)]];
    rows.row(i) = multiply3(inverse3(map), row3(moves, i)).cast<float>().transpose();
  }
  return rows;
}

}  // namespace crowdface
