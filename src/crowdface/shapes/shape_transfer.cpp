// SPDX-License-Identifier: Apache-2.0
#include "crowdface/shapes/shape_transfer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "crowdface/mesh/vector3.h"
#include "crowdface/shapes/prepared_shapes.h"

namespace crowdface {
namespace {

/// Largest number of repair rounds. Another round follows only if the previous round moved
/// lids into an eyeball or opened lids.
constexpr int kMaxRepairs = 3;
/// Cost of a gap of one eyeball radius between lids that should be closed. The unit is the cost of
/// one intersecting triangle. The cost is high because a gap is visible, but an intersection of
/// closed lids is not.
constexpr double kOpenLidsCost = 1000;

using FaceFrames = PreparedShapes::FaceFrames;

std::vector<FaceEye> placed_eyes(const PreparedShapes& prepared, std::size_t target,
                                 const Positions& face) {
  std::vector<FaceEye> there;
  for (const auto& [number, eye, balls] : prepared.eyes) {
    const RigidPart& part = prepared.rigid_parts[number];
    const RigidMotion motion = fit_rigid_motion(prepared.head_set.heads[target].positions, face,
                                                part.fitted_vertices, part.equal_weights);
    there.push_back(make_face_eye(eye, balls[target], motion, face));
  }
  return there;
}

/// Computes one shape of a face.
class FaceShape {
 public:
  /// \param rest  The mesh to which the shape is added: the face at rest, or the face in the
  ///              prerequisite shape.
  /// \param mesh  Equal to `rest`; modified during the call and restored.
  FaceShape(const PreparedShapes& prepared, std::size_t number, std::span<const FaceEye> face_eyes,
            const FaceFrames& face_frames, const RegionShares& shares, const Positions& rest,
            Positions& mesh)
      : prepared_(prepared),
        shape_(prepared.shapes[number]),
        face_eyes_(face_eyes),
        face_frames_(face_frames),
        shares_(shares),
        rest_(rest),
        mesh_(mesh),
        result_{prepared.shape_set.shapes[number].moves.vertices,
                Positions(static_cast<Index>(shape_.vertex_indices.size()), 3)} {
    if (has_own_sets()) {
      move_skin(mean_own_moves());
    } else {
      move_skin(prepared.shape_set.shapes[number].moves.moves);
    }
    move_parts();
    const Positions uncorrected_skin = skin_of_followers();
    fit_lids();
    if (shape_.moves_gaps) correct_gaps();
    shape_.skin_over_parts.keep_in_front(rest_, face_frames_.frames.face_motion,
                                         shape_.searched_skin.skin_displacements, mesh_, result_);
    remove_crossings();
    move_lid_followers(uncorrected_skin);
  }

  Displacements moves() && { return std::move(result_); }
  /// Returns the number of triangles that still intersect other triangles.
  Index crossing() const { return crossing_; }

 private:
  bool has_own_sets() const { return !shape_.head_moves.empty(); }
  ShapeSetShares shares_of_part(std::size_t part) const {
    return has_own_sets() ? shape_set_weights_at(prepared_.rigid_part_weights[part], shares_)
                          : ShapeSetShares{{0, 1}};
  }
  Positions mean_own_moves() const;
  void move_skin(const Positions& moves);
  void move_parts();
  Positions skin_of_followers() const;
  void fit_lids();
  void correct_gaps();
  void remove_crossings();
  bool keep_lids_out();
  bool closes_lids() const;
  double largest_open_gap_of_lids(const Positions& moves) const;
  void close_lids();
  void move_lid_followers(const Positions& uncorrected_skin);

  const PreparedShapes& prepared_;
  const PreparedShape& shape_;
  std::span<const FaceEye> face_eyes_;
  const FaceFrames& face_frames_;
  const RegionShares& shares_;
  const Positions& rest_;
  Positions& mesh_;
  Displacements result_;
  /// for each eye of the face: the targets of its lids
  std::vector<LidClosure::LidTargets> targets_;
  Index crossing_ = 0;
};

/// Returns the weighted mean of the heads' own displacements. The heads' weights at a vertex depend
/// on the region weights of this vertex.
Positions FaceShape::mean_own_moves() const {
  Positions moves = Positions::Zero(result_.moves.rows(), 3);
  for (std::size_t k = 0; k < shares_.size(); ++k) {
    for (const ShapeSetShare& of_set : shares_[k]) {
      const FloatPositions& own = shape_.head_moves[of_set.set];
      for (Index i = 0; i < moves.rows(); ++i) {
        const double part = prepared_.vertex_region_weights(
            shape_.vertex_indices[static_cast<std::size_t>(i)], static_cast<Index>(k));
        if (part == 0) continue;
        const double share = part * of_set.blend_weight;
        for (Index c = 0; c < 3; ++c) moves(i, c) += share * static_cast<double>(own(i, c));
      }
    }
  }
  return moves;
}

void FaceShape::move_skin(const Positions& moves) {
  for (std::size_t i = 0; i < shape_.vertex_indices.size(); ++i) {
    const auto row = static_cast<Index>(i);
    result_.moves.row(row) =
        multiply3(face_frames_.maps[shape_.vertex_indices[i]], row3(moves, row)).transpose();
  }
}

void FaceShape::move_parts() {
  for (const PreparedPart& part : shape_.parts) {
    const Eigen::Matrix3d map = prepared_.mean_map_of_part(part, shape_, face_frames_.maps);
    const PlacedPart placed(prepared_.rigid_parts[part.part], prepared_.shape_set.neutral,
                            face_frames_.mesh, face_frames_.frames.face_motion, map);
    transfer_part_motion(mean_part_motion(part.motions, shares_of_part(part.part)), placed,
                         part.moved_vertices, part.displacement_rows, result_.moves);
  }
}

/// Returns the current displacements of the skin that lashes follow. The result has 3 ·
/// #lid_followers rows, one for each corner of each follower's skin triangle.
Positions FaceShape::skin_of_followers() const {
  Positions rows(static_cast<Index>(3 * shape_.lid_followers.size()), 3);
  Index next = 0;
  for (const LidFollower& follower : shape_.lid_followers) {
    for (const std::uint32_t on : follower.corner_rows) {
      if (on != kNoIndex) rows.row(next) = result_.moves.row(on);
      ++next;
    }
  }
  return rows;
}

void FaceShape::fit_lids() {
  targets_.resize(prepared_.eyes.size());
  for (std::size_t e = 0; e < targets_.size(); ++e) {
    const PreparedLids& move = shape_.lids[e];
    if (move.lids.empty()) continue;
    targets_[e] = LidClosure::mean_targets(move.targets, shares_of_part(prepared_.eyes[e].part));
    move.lids.fit_lids(face_frames_.mesh, face_eyes_[e], face_frames_.frames.face_motion,
                       targets_[e], result_.moves);
  }
}

/// Corrects the gaps between lips. If the shape hardly changes a gap on the template, the gap
/// changes equally little on the face. If the shape closes lips that its prerequisite opens, all
/// gaps change as on the template.
void FaceShape::correct_gaps() {
  // Compute the wanted change of each gap: the weighted mean of the changes that this blend shape
  // makes in the heads' shape sets.
  std::vector<double> gap_changes(shape_.gap_changes.front().size(), 0.0);
  for (std::size_t p = 0; p < gap_changes.size(); ++p) {
    ShapeSetShares here = {{0, 1}};
    if (has_own_sets()) {
      const auto& weights = prepared_.gap_region_weights;
      here = shape_set_weights_at(
          {&weights(static_cast<Index>(p), 0), static_cast<std::size_t>(weights.cols())}, shares_);
    }
    for (const ShapeSetShare& of_set : here) {
      gap_changes[p] += of_set.blend_weight * face_frames_.frames.face_motion.scale *
                        shape_.gap_changes[of_set.set][p];
    }
  }
  // Apply the displacements to the mesh, adjust the gaps of this mesh, and convert the adjusted
  // mesh back to displacements.
  result_.add_to(mesh_);
  const auto how = shape_.prerequisite ? GapPreserver::GapSelection::kAll
                                       : GapPreserver::GapSelection::kNearlyUnchanged;
  prepared_.gap_preserver.adjust(face_frames_.gaps, gap_changes, how, mesh_);
  for (std::size_t i = 0; i < result_.vertices.size(); ++i) {
    const std::uint32_t v = result_.vertices[i];
    auto move = result_.moves.row(static_cast<Index>(i));
    const Eigen::RowVector3d before = rest_.row(v) + move;
    move += mesh_.row(v) - before;
  }
  for (const std::uint32_t v : result_.vertices) mesh_.row(v) = rest_.row(v);
  for (const std::uint32_t v : prepared_.gap_preserver.movable_vertices())
    mesh_.row(v) = rest_.row(v);
}

/// Alternates between repairing intersections and closing lids, because each step may undo the
/// other step. Keeps the result of the best round.
void FaceShape::remove_crossings() {
  SkinCrossings::ExtraCost extra_cost;
  if (closes_lids())
    extra_cost = [&](const Positions& moves) {
      return kOpenLidsCost * largest_open_gap_of_lids(moves);
    };
  const SkinCrossings::Face face{rest_, face_frames_.crosses_at_rest,
                                 face_frames_.frames.face_motion};
  double best = HUGE_VAL;
  Positions kept;
  for (int round = 0; round < kMaxRepairs; ++round) {
    if (round > 0) close_lids();
    Index crossing =
        prepared_.crossings.repair(face, shape_.searched_skin, mesh_, result_, extra_cost);
    const bool are_out = keep_lids_out();
    if (extra_cost)
      crossing = prepared_.crossings.count_intersecting(face, shape_.searched_skin, result_, mesh_);
    const double open = extra_cost ? extra_cost(result_.moves) : 0;
    const double bad = static_cast<double>(crossing) + open;
    if (bad < best) {
      best = bad;
      kept = result_.moves;
      crossing_ = crossing;
    }
    if (are_out && open == 0) break;
  }
  result_.moves = std::move(kept);
}

bool FaceShape::closes_lids() const {
  return std::ranges::any_of(shape_.lids,
                             [](const PreparedLids& move) { return move.lids.closes_lids(); });
}

double FaceShape::largest_open_gap_of_lids(const Positions& moves) const {
  double open = 0;
  for (std::size_t e = 0; e < targets_.size(); ++e) {
    const LidClosure& lids = shape_.lids[e].lids;
    if (!lids.closes_lids()) continue;
    open = std::max(open, lids.largest_open_gap(face_frames_.mesh, face_frames_.frames.face_motion,
                                                targets_[e], moves));
  }
  return open;
}

void FaceShape::close_lids() {
  for (std::size_t e = 0; e < targets_.size(); ++e) {
    const LidClosure& lids = shape_.lids[e].lids;
    if (!lids.closes_lids()) continue;
    lids.restore_closure(face_frames_.mesh, face_frames_.frames.face_motion, targets_[e],
                         result_.moves);
  }
}

/// Moves the lids of all eyes out of the eyeballs. \return false if any lid was noticeably inside
/// an eyeball, see LidClosure::move_out_of_eyeball.
bool FaceShape::keep_lids_out() {
  bool are_out = true;
  for (std::size_t e = 0; e < targets_.size(); ++e) {
    const LidClosure& lids = shape_.lids[e].lids;
    if (lids.empty()) continue;
    const bool is_out =
        lids.move_out_of_eyeball(face_frames_.mesh, face_eyes_[e], face_frames_.frames.face_motion,
                                 targets_[e], result_.moves);
    are_out = are_out && is_out;
  }
  return are_out;
}

/// Moves each lash by the correction of the lid skin to which the lash is bound.
/// \param uncorrected_skin  displacements of the lid skin before the correction, from
///   skin_of_followers.
void FaceShape::move_lid_followers(const Positions& uncorrected_skin) {
  Index next = 0;
  for (const LidFollower& follower : shape_.lid_followers) {
    for (std::size_t k = 0; k < 3; ++k, ++next) {
      const std::uint32_t on = follower.corner_rows[k];
      if (on == kNoIndex) continue;
      result_.moves.row(follower.row) +=
          follower.barycentric[k] * (result_.moves.row(on) - uncorrected_skin.row(next));
    }
  }
}

}  // namespace

ShapeTransfer::ShapeTransfer(const HeadSet& head_set, const Adjacency& adjacency,
                             const PartList& parts, const HeadAxes& axes, const ShapeSet& shapes,
                             const RegionWeights& regions)
    : prepared_(
          std::make_unique<PreparedShapes>(head_set, adjacency, parts, axes, shapes, regions)) {}

ShapeTransfer::~ShapeTransfer() = default;

std::vector<Displacements> ShapeTransfer::transfer_to_face(Index target, const Positions& face,
                                                           std::span<const RegionShares> shares,
                                                           std::vector<Index>* crossing) const {
  const FaceFrames face_frames = prepared_->make_face_frames(face);
  const auto face_eyes = placed_eyes(*prepared_, static_cast<std::size_t>(target), face);
  const RegionShares none;
  std::vector<Displacements> shapes(prepared_->shapes.size());
  if (crossing != nullptr) crossing->assign(shapes.size(), 0);
  const auto carry_one = [&](std::size_t s, const Positions& rest, Positions& mesh) {
    FaceShape shape(*prepared_, s, face_eyes, face_frames, s < shares.size() ? shares[s] : none,
                    rest, mesh);
    if (crossing != nullptr) (*crossing)[s] = shape.crossing();
    shapes[s] = std::move(shape).moves();
  };
  Positions mesh = face;
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    if (!prerequisite_of(s)) carry_one(s, face, mesh);
  }
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    if (!prerequisite_of(s)) continue;
    shapes[*prerequisite_of(s)].add_to(mesh);
    const Positions rest = mesh;
    carry_one(s, rest, mesh);
    mesh = face;
  }
  return shapes;
}

std::optional<std::size_t> ShapeTransfer::prerequisite_of(std::size_t shape) const {
  return prepared_->shapes[shape].prerequisite;
}

std::size_t ShapeTransfer::memory_bytes() const {
  std::size_t bytes =
      static_cast<std::size_t>(prepared_->vertex_region_weights.size()) * sizeof(double);
  for (const PreparedShape& shape : prepared_->shapes) {
    for (const FloatPositions& rows : shape.head_moves) {
      bytes += static_cast<std::size_t>(rows.size()) * sizeof(float);
    }
  }
  return bytes;
}

}  // namespace crowdface
