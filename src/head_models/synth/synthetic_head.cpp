// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/synthetic_head.h"

#include <algorithm>
#include <cmath>

#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"
#include "crowdface/core/smooth_step.h"
#include "crowdface/mesh/all_columns.h"
#include "head_models/synth/bust.h"
#include "head_models/synth/complexion.h"
#include "head_models/synth/hair.h"
#include "head_models/synth/layout.h"
#include "head_models/synth/relief.h"
#include "head_models/synth/unwrap.h"

namespace crowdface {
namespace {

constexpr Index kMin = 5000, kMax = 1200000;
constexpr std::size_t kVerticesPerBlock = 1024;

}  // namespace

SyntheticHeads::SyntheticHeads(Index vertices, Parts parts, Scalp scalp) : scalp_(scalp) {
  require(vertices >= kMin && vertices <= kMax, "synthetic heads of ", vertices, " vertices");
  // The smallest layout has 5,000 vertices and edges of 5 mm.
  const auto edge_of = [](Index count) {
    return 0.5 * std::sqrt(5000.0 / static_cast<double>(count));
  };
  Index skin = vertices;
  if (parts == Parts::kEyesAndTeeth) {
    loose_.emplace(edge_of(vertices));
    skin -= loose_->vertex_count();
  }
  synth::Layout layout = synth::make_layout(skin);
  topology_ = std::move(layout.topology);
  uvs_ = std::move(layout.uvs);
  mean_.resize(layout.lattice_points.size());
  parallel_for_each(mean_.size(), kVerticesPerBlock, [&](std::size_t i) {
    const synth::LatticePoint& lattice_point = layout.lattice_points[i];
    mean_[i] =
        loose_ ? synth::mean_skin_with_sockets(lattice_point) : synth::mean_skin(lattice_point);
  });
  for (std::uint32_t v = 0; v < layout.lattice_points.size(); ++v) {
    const synth::LatticePoint& lattice_point = layout.lattice_points[v];
    if (lattice_point.patch != synth::SkinPatch::kStrip) continue;
    if (lattice_point.b == synth::row_distance(synth::kRows - 1)) rim_.push_back(v);
  }
  edge_cm_ = edge_of(topology_.vertex_count);
  if (loose_) loose_->append_to(topology_, uvs_);
}

std::vector<SyntheticHeads::Piece> SyntheticHeads::pieces() const {
  std::vector<Piece> pieces = {{"skin", 0}};
  if (!loose_) return pieces;
  using synth::LoosePiece;
  const Index first = topology_.face_count() - loose_->face_count();
  const auto add = [&](const char* name, LoosePiece piece) {
    pieces.push_back({name, first + loose_->first_face(piece)});
  };
  add("eyeball_left", LoosePiece::kLeftEye);
  add("eyeball_right", LoosePiece::kRightEye);
  add("teeth_upper", LoosePiece::kUpperTeeth);
  add("teeth_lower", LoosePiece::kLowerTeeth);
  return pieces;
}

Positions SyntheticHeads::positions(std::uint64_t seed, std::uint64_t index) const {
  const synth::Identity identity(seed, index);
  const synth::Relief relief(identity, edge_cm_);
  const synth::Hair hair(seed, index, scalp_ != Scalp::kShorn);
  const bool haired = scalp_ != Scalp::kBare;
  const double most = scalp_ == Scalp::kShorn ? 0.2 : 10;  // cm
  Positions out(topology_.vertex_count, 3);
  parallel_for_each(mean_.size(), kVerticesPerBlock, [&](std::size_t i) {
    const synth::SkinPoint& mean = mean_[i];
    double height = relief.height(mean);
    if (haired && mean.relief_weight > 0.5) height += std::min(most, hair.thickness(mean.position));
    const Eigen::Vector3d fine = mean.position + height * mean.normal;
    out.row(static_cast<Index>(i)) = identity.deform(fine).transpose();
  });
  if (loose_) {
    out.bottomRows(loose_->vertex_count()) = loose_->positions(identity);
  }
  return out;
}

Positions SyntheticHeads::average() const {
  Positions out(topology_.vertex_count, 3);
  for (std::size_t i = 0; i < mean_.size(); ++i)
    out.row(static_cast<Index>(i)) = mean_[i].position.transpose();
  if (loose_) {
    out.bottomRows(loose_->vertex_count()) = loose_->positions(synth::Identity::average());
  }
  return out;
}

Mesh SyntheticHeads::body() const {
  return synth::bust_below(average()(rim_, kAllColumns));
}

std::vector<std::uint8_t> synthetic_region_mask(int size) {
  require(size >= 1, "a mask of ", size, " pixels");
  using synth::row_distance;
  using synth::strip_v;
  // One transition between regions lies at the height of the eyes, the other between nose and lips.
  // Both are wide: if two adjacent regions of a face come from different heads, a narrow transition
  // would be visible as a ridge.
  const double brow = strip_v(row_distance(2)), under_eye = strip_v(row_distance(3));
  const double nose = strip_v(row_distance(5)), lips = strip_v(row_distance(6));
  const double eye = (brow + under_eye) / 2, half = 0.55 * (brow - under_eye);
  const double upper = eye + 0.3 * (brow - under_eye), lower = (nose + lips) / 2;
  std::vector<std::uint8_t> out;
  for (int row = 0; row < size; ++row) {
    const double v = 1 - (row + 0.5) / size;
    for (int column = 0; column < size; ++column) {
      // The texture areas of the eyeballs belong to the region of the eyes.
      const Eigen::RowVector2d place((column + 0.5) / size, v);
      const double at = synth::eyeball_disc_point(place).norm() < 1.1 ? eye : v;
      const auto top = synth::to_byte(smooth_step(upper - half, upper + half, at));
      const auto bottom = synth::to_byte(smooth_step(lower + half, lower - half, at));
      out.push_back(top);
      out.push_back(static_cast<std::uint8_t>(255 - top - bottom));
      out.push_back(bottom);
    }
  }
  return out;
}

}  // namespace crowdface
