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
/// A shape is corrective (see find_prerequisites) if, applied alone, it makes the lips overlap by
/// more than this length: a fraction of the skin's extent, about 5 mm.
constexpr double kCorrectiveOverlap = 0.012;

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
                                                           const GapPreserver& gap_preserver,
                                                           double extent) {
  const auto through_in = [&](std::initializer_list<std::size_t> shapes) {
    Positions mesh = shape_set.neutral;
    for (const std::size_t s : shapes) shape_set.shapes[s].moves.add_to(mesh);
    return gap_preserver.max_overlap(mesh);
  };
  const std::size_t count = shape_set.shapes.size();
  std::vector<double> through(count);
  parallel_for_each(count, [&](std::size_t s) { through[s] = through_in({s}); });
  std::vector<std::optional<std::size_t>> prerequisites(count);
  for (std::size_t s = 0; s < count; ++s) {
    if (through[s] <= kCorrectiveOverlap * extent) continue;
    double least = through[s] / 2;
    for (std::size_t other = 0; other < count; ++other) {
      if (through[other] > kCorrectiveOverlap * extent) continue;
      const double both = through_in({s, other});
      if (both >= least) continue;
      least = both;
      prerequisites[s] = other;
    }
  }
  return prerequisites;
}

PreparedShapes::PreparedShapes(const HeadSet& all_heads, const Adjacency& adjacency,
                               const PartList& parts, const HeadAxes& head_axes,
                               const ShapeSet& all_shapes, const RegionWeights& regions)
    : head_set(all_heads),
      shape_set(all_shapes),
      axes(head_axes),
      vertex_faces(head_set.topology),
      skin(skin_of(parts, vertex_faces)),
      moved_vertices(all_moved_vertices(shape_set)),
      gap_preserver(head_set, adjacency, skin),
      extent(extent_of(shape_set.neutral, skin)),
      crossings(head_set.topology, skin, extent, axes) {
  const Positions mean = mean_head(head_set);
  for (const Part& part : parts.parts) {
    if (part.part_class != PartClass::kRigid) continue;
    add_part(part, parts, mean);
    if (part.is_eyeball) add_eye(part, parts.shapes[part.ball_component], mean);
  }
  find_inner_vertices(parts);
  frame_field = FrameField(shape_set.neutral, skin, extent, moved_vertices);
  if (!shape_set.head_shapes.empty()) look_up_regions(regions);
  shapes.resize(shape_set.shapes.size());
  const auto prerequisites = find_prerequisites(shape_set, gap_preserver, extent);
  parallel_for_each(shapes.size(), [&](std::size_t s) {
    shapes[s].prerequisite = prerequisites[s];
    prepare_shape(shape_set.shapes[s].moves, adjacency, shapes[s]);
  });
  std::vector<const CrossingSearch*> searches;
  for (const PreparedShape& shape : shapes) searches.push_back(&shape.searched_skin.search);
  resting_face_search = crossings.merge_searches(shape_set.neutral, searches);
  add_data_of_sets();
}

void PreparedShapes::add_part(const Part& part, const PartList& parts, const Positions& mean) {
  RigidPart bound{
      part.vertices, evenly_spaced_items(part.vertices, kMaxFitted), {}, Eigen::Vector3d::Zero()};
  bound.equal_weights.assign(bound.fitted_vertices.size(), 1.0);
  if (part.is_eyeball) {
    const RigidMotion motion =
        fit_rigid_motion(mean, shape_set.neutral, bound.fitted_vertices, bound.equal_weights);
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
        fit_rigid_motion(mean, head, bound.fitted_vertices, bound.equal_weights);
    return BallRadii(head_set.topology, vertex_faces, head, part.ball_vertices,
                     motion.apply(ball.centre), motion.scale * ball.radius, axes);
  };
  PreparedEye eye{rigid_parts.size() - 1, {map_in(shape_set.neutral), {}, {}}, {}};
  eye.balls.resize(head_set.heads.size());
  parallel_for_each(head_set.heads.size(),
                    [&](std::size_t h) { eye.balls[h] = map_in(head_set.heads[h].positions); });
  const BallRadii& here = eye.template_eye.ball;
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
        const BallRadii& ball = eye.template_eye.ball;
        return (row3(shape_set.neutral, v) - ball.centre()).norm() < kEyeSkin * ball.radius();
      });
    });
  }
}

void PreparedShapes::look_up_regions(const RegionWeights& regions) {
  const PointGrid grid(shape_set.neutral, skin);
  const auto nearest = [&](std::uint32_t v) {
    return std::ranges::binary_search(skin, v) ? v
                                               : grid.nearest(row3(shape_set.neutral, v)).vertex;
  };
  vertex_region_weights.resize(static_cast<Index>(moved_vertices.size()), regions.alpha.cols());
  parallel_for_each(moved_vertices.size(), [&](std::size_t i) {
    vertex_region_weights.row(static_cast<Index>(i)) =
        regions.alpha.row(nearest(moved_vertices[i]));
  });
  gap_region_weights = regions.alpha(gap_preserver.contact_vertices(), kAllColumns);
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
                                   PreparedShape& prepared) const {
  for (const std::uint32_t v : moves.vertices)
    prepared.vertex_indices.push_back(index_in_list(moved_vertices, v));
  for (std::size_t p = 0; p < rigid_parts.size(); ++p) {
    PreparedPart part{p, {}, {}, {}};
    for (const std::uint32_t v : rigid_parts[p].vertices) {
      const std::uint32_t row = index_in_list(moves.vertices, v);
      if (row == kNoIndex) continue;
      part.displacement_rows.push_back(row);
      part.moved_vertices.push_back(v);
    }
    if (!part.moved_vertices.empty()) prepared.parts.push_back(std::move(part));
  }
  prepare_lids(moves, adjacency, prepared);
  prepared.moves_gaps = gap_preserver.is_affected_by(moves.vertices);
  prepared.searched_skin = find_searched_skin(moves, prepared);
  Positions shaped = shape_set.neutral;
  if (prepared.prerequisite) shape_set.shapes[*prepared.prerequisite].moves.add_to(shaped);
  moves.add_to(shaped);
  prepared.skin_over_parts =
      SkinOverParts(shaped, crossings.mesh(), inner_vertices, moves.vertices, axes, extent);
}

SkinCrossings::SearchedSkin PreparedShapes::find_searched_skin(
    const Displacements& moves, const PreparedShape& prepared) const {
  std::vector<signed char> side;
  for (std::size_t e = 0; e < eyes.size(); ++e) {
    if (!prepared.lids[e].lids.closes_lids()) continue;
    side.resize(static_cast<std::size_t>(shape_set.neutral.rows()), 0);
    mark_lid_sides(eyes[e].template_eye, shape_set.neutral, side);
  }
  if (!prepared.prerequisite)
    return crossings.find_searched_skin(shape_set.neutral, moves, std::move(side));
  Positions rest = shape_set.neutral;
  shape_set.shapes[*prepared.prerequisite].moves.add_to(rest);
  SkinCrossings::SearchedSkin found = crossings.find_searched_skin(rest, moves, std::move(side));
  found.brings_distant_skin_together = true;
  return found;
}

void PreparedShapes::prepare_lids(const Displacements& moves, const Adjacency& adjacency,
                                  PreparedShape& prepared) const {
  std::vector<bool> fitted(moves.vertices.size(), false);
  for (const PreparedEye& eye : eyes) {
    LidClosure lids(eye.template_eye, adjacency, shape_set.neutral, moves, axes);
    for (const std::uint32_t row : lids.adjustable_rows()) fitted[row] = true;
    prepared.lids.push_back({std::move(lids), {}});
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
    const SurfacePoint place = nearest_point_around(head_set.topology, vertex_faces,
                                                    shape_set.neutral, nearest.vertex, point);
    LidFollower follower{row, {}, place.barycentric};
    bool any = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t corner = index_in_list(moves.vertices, place.corners[k]);
      follower.corner_rows[k] = corner != kNoIndex && fitted[corner] ? corner : kNoIndex;
      any = any || follower.corner_rows[k] != kNoIndex;
    }
    if (any) prepared.lid_followers.push_back(follower);
  }
}

PreparedShapes::FaceFrames PreparedShapes::make_face_frames(const Positions& face) const {
  FaceFrames face_frames{
      face, frame_field.frames(face), std::vector<Eigen::Matrix3d>(moved_vertices.size()),
      gap_preserver.measure_gaps(face), crossings.crossing_at_rest(face, resting_face_search)};
  for (std::size_t i = 0; i < moved_vertices.size(); ++i)
    face_frames.maps[i] = frame_field.map_at(i, face_frames.frames);
  return face_frames;
}

Eigen::Matrix3d PreparedShapes::mean_map_of_part(const PreparedPart& part,
                                                 const PreparedShape& prepared,
                                                 std::span<const Eigen::Matrix3d> maps) const {
  Eigen::Matrix3d map = Eigen::Matrix3d::Zero();
  for (const std::uint32_t row : part.displacement_rows) map += maps[prepared.vertex_indices[row]];
  return map / static_cast<double>(part.displacement_rows.size());
}

void PreparedShapes::add_data_of_sets() {
  const std::size_t heads = shape_set.head_shapes.size();
  for (std::size_t h = 0; h < std::max<std::size_t>(heads, 1); ++h) {
    const FaceFrames face_frames =
        make_face_frames(heads > 0 ? head_set.heads[h].positions : shape_set.neutral);
    std::vector<FaceEye> face_eyes;
    for (const auto& [part, eye, balls] : eyes) {
      face_eyes.push_back(
          make_face_eye(eye, heads > 0 ? balls[h] : eye.ball, {}, face_frames.mesh));
    }
    parallel_for_each(shapes.size(), [&](std::size_t s) {
      const Displacements own = shape_of_set(h, s);
      Positions rest = face_frames.mesh;
      if (const auto& other = shapes[s].prerequisite) shape_of_set(h, *other).add_to(rest);
      add_data_of_set(face_frames, rest, own, face_eyes, shapes[s]);
      if (heads > 0)
        shapes[s].head_moves.push_back(normalised_moves(face_frames, shapes[s], own.moves));
    });
  }
}

Displacements PreparedShapes::shape_of_set(std::size_t set, std::size_t shape) const {
  const Displacements& all = shape_set.shapes[shape].moves;
  if (shape_set.head_shapes.empty()) return all;
  return {all.vertices, rows_in(all.vertices, shape_set.head_shapes[set][shape])};
}

void PreparedShapes::add_data_of_set(const FaceFrames& face_frames, const Positions& rest,
                                     const Displacements& shape, std::span<const FaceEye> face_eyes,
                                     PreparedShape& prepared) const {
  const Positions& moves = shape.moves;
  const RigidMotion& face_motion = face_frames.frames.face_motion;
  for (PreparedPart& part : prepared.parts) {
    const RigidPart& bound = rigid_parts[part.part];
    const Eigen::Matrix3d map = mean_map_of_part(part, prepared, face_frames.maps);
    const PlacedPart placed(bound, shape_set.neutral, face_frames.mesh, face_motion, map);
    part.motions.push_back(
        find_part_motion(bound, placed, part.moved_vertices, part.displacement_rows, moves));
  }
  for (std::size_t e = 0; e < eyes.size(); ++e) {
    PreparedLids& move = prepared.lids[e];
    if (move.lids.empty()) continue;
    move.targets.push_back(
        move.lids.measure_targets(face_frames.mesh, face_eyes[e], face_motion, moves));
  }
  Positions moved = rest;
  shape.add_to(moved);
  if (!shape_set.head_shapes.empty() && !prepared.searched_skin.search.triangles().empty()) {
    crossings.allow_intersections_of(moved, prepared.searched_skin);
  }
  if (!prepared.moves_gaps) return;
  std::vector<double>& gap_changes =
      prepared.gap_changes.emplace_back(gap_preserver.measure_gaps(moved));
  for (std::size_t p = 0; p < gap_changes.size(); ++p) {
    gap_changes[p] = (gap_changes[p] - face_frames.gaps[p]) / face_motion.scale;
  }
}

FloatPositions PreparedShapes::normalised_moves(const FaceFrames& face_frames,
                                                const PreparedShape& prepared,
                                                const Positions& moves) const {
  FloatPositions rows(moves.rows(), 3);
  for (Index i = 0; i < moves.rows(); ++i) {
    const Eigen::Matrix3d& map =
        face_frames.maps[prepared.vertex_indices[static_cast<std::size_t>(i)]];
    rows.row(i) = multiply3(inverse3(map), row3(moves, i)).cast<float>().transpose();
  }
  return rows;
}

}  // namespace crowdface
