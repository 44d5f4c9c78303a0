// SPDX-License-Identifier: Apache-2.0
#include "crowdface/paint/mask_painter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "crowdface/core/require.h"
#include "crowdface/core/smooth_step.h"
#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

using Alpha = RegionWeights::Alpha;

// Distances over which one call of `paint` smooths weights or grows a region, as fractions of the
// brush's radius. These distances do not depend on the resolution of the mesh.
constexpr double kSmoothDistance = 0.25, kGrowDistance = 0.125;
constexpr int kMaxRounds = 400;

/// A vertex under the brush, and the strength of the brush there.
struct BrushedVertex {
  std::uint32_t vertex;
  double strength;
};

/// Sets negative weights of a vertex to zero, and scales the weights so that their sum is one.
void scale_to_one(Alpha& alpha, Index row) {
  double sum = 0;
  for (Index k = 0; k < alpha.cols(); ++k) {
    alpha(row, k) = std::max(alpha(row, k), 0.0);
    sum += alpha(row, k);
  }
  for (Index k = 0; k < alpha.cols(); ++k) alpha(row, k) /= sum;
}

/// Sets the weight of one region at a vertex. The remaining weight goes to the other regions in
/// proportion to their weights. If all their weights are zero, the remaining weight goes to
/// `receiver`.
void set_weight(Alpha& alpha, Index row, Index region, double share, Index receiver) {
  const double others = 1 - alpha(row, region);
  if (others <= 0) {
    if (receiver == region) return;
    alpha(row, receiver) = 1 - share;
  } else {
    const double factor = (1 - share) / others;
    for (Index k = 0; k < alpha.cols(); ++k) alpha(row, k) *= factor;
  }
  alpha(row, region) = share;
  scale_to_one(alpha, row);
}

/// Returns the region other than `region` with the largest total weight at the touched vertices. If
/// several regions have the same total, returns the region with the lowest index.
Index receiver_of(const Alpha& alpha, const std::vector<BrushedVertex>& touched, Index region) {
  Index receiver = region;
  double most = -1;
  for (Index k = 0; k < alpha.cols(); ++k) {
    if (k == region) continue;
    double sum = 0;
    for (const BrushedVertex& t : touched) sum += alpha(t.vertex, k);
    if (sum <= most) continue;
    most = sum;
    receiver = k;
  }
  return receiver;
}

/// The vertices that share an edge with each vertex under the brush; one row for each entry of
/// `touched`.
CompressedRows<std::uint32_t> neighbours_of(const SurfaceDistance& surface,
                                            const std::vector<BrushedVertex>& touched) {
  CompressedRows<std::uint32_t> neighbours;
  for (const BrushedVertex& t : touched) neighbours.add_group(surface.adjacent_vertices(t.vertex));
  return neighbours;
}

double edge_length(const Positions& positions, const std::vector<BrushedVertex>& touched,
                   const CompressedRows<std::uint32_t>& neighbours) {
  double sum = 0;
  for (std::size_t i = 0; i < touched.size(); ++i) {
    for (const std::uint32_t n : neighbours.items_of(i)) {
      sum += (row3(positions, n) - row3(positions, touched[i].vertex)).norm();
    }
  }
  return neighbours.items.empty() ? 1 : sum / static_cast<double>(neighbours.items.size());
}

/// Returns the number of rounds of smoothing or growing: `edges` (a number of edge lengths) rounded
/// up and limited to 1 … kMaxRounds.
int rounds(double edges) {
  return static_cast<int>(std::clamp(std::ceil(edges), 1.0, double{kMaxRounds}));
}

/// Moves the weights at each touched vertex towards the mean weights of the vertex's neighbours.
void smooth_once(const std::vector<BrushedVertex>& touched,
                 const CompressedRows<std::uint32_t>& neighbours, Alpha& alpha) {
  Alpha next(static_cast<Index>(touched.size()), alpha.cols());
  for (std::size_t i = 0; i < touched.size(); ++i) {
    const auto& [v, strength] = touched[i];
    const auto around = neighbours.items_of(i);
    const double share = around.empty() ? 0 : strength / static_cast<double>(around.size());
    for (Index k = 0; k < alpha.cols(); ++k) {
      double value = alpha(v, k);
      for (const std::uint32_t n : around) value += share * (alpha(n, k) - alpha(v, k));
      next(static_cast<Index>(i), k) = value;
    }
  }
  for (std::size_t i = 0; i < touched.size(); ++i) {
    alpha.row(touched[i].vertex) = next.row(static_cast<Index>(i));
    scale_to_one(alpha, touched[i].vertex);
  }
}

/// Raises the region's weight at each touched vertex towards the largest weight at the vertex's
/// neighbours.
void grow_once(const std::vector<BrushedVertex>& touched,
               const CompressedRows<std::uint32_t>& neighbours, Index region, Alpha& alpha) {
  std::vector<double> share;
  for (std::size_t i = 0; i < touched.size(); ++i) {
    const auto& [v, strength] = touched[i];
    double most = alpha(v, region);
    for (const std::uint32_t n : neighbours.items_of(i)) most = std::max(most, alpha(n, region));
    share.push_back(alpha(v, region) + strength * (most - alpha(v, region)));
  }
  for (std::size_t i = 0; i < touched.size(); ++i) {
    set_weight(alpha, touched[i].vertex, region, share[i], region);
  }
}

}  // namespace

MaskPainter::MaskPainter(const Topology& topology, const Positions& positions,
                         const MirrorPlane& mirror, Alpha alpha)
    : mirror_(mirror), surface_(topology, positions), alpha_(std::move(alpha)) {
  require(alpha_.rows() == positions.rows() && alpha_.cols() >= 1, "paint: ", alpha_.rows(),
          " weights of ", positions.rows(), " vertices");
}

std::vector<std::uint32_t> MaskPainter::paint(Index region, const std::vector<SurfacePoint>& places,
                                              const Brush& brush, bool continues_stroke) {
  require(region >= 0 && region < alpha_.cols() && brush.radius > 0 && brush.strength >= 0 &&
              brush.strength <= 1 && brush.falloff >= 0 && brush.falloff <= 1,
          "paint: region ", region, ", radius ", brush.radius, ", strength ", brush.strength,
          ", falloff ", brush.falloff);
  std::vector<SurfacePoint> all = places;
  if (brush.paints_mirror_image) {
    for (const SurfacePoint& place : places) {
      all.push_back(surface_.nearest(mirror_.mirrored(place.position)));
    }
  }
  // The strength is constant in the core of the brush and decreases from there to the brush's rim.
  std::vector<BrushedVertex> touched;
  std::vector<std::uint32_t> rows;
  const double core = (1 - brush.falloff) * brush.radius;
  for (const auto& [vertex, distance] : surface_.vertices_within(all, brush.radius)) {
    const double soft = core < brush.radius ? smooth_step(brush.radius, core, distance) : 1;
    touched.push_back({vertex, brush.strength * soft});
    rows.push_back(vertex);
  }
  // Save the weights before the change, for undo.
  if (!continues_stroke || undo_steps_.empty()) undo_steps_.emplace_back();
  for (const std::uint32_t v : rows) undo_steps_.back().try_emplace(v, alpha_.row(v));
  switch (brush.mode) {
    case BrushMode::kAdd:
      for (const auto& [v, strength] : touched) {
        const double share = alpha_(v, region);
        set_weight(alpha_, v, region, share + strength * (1 - share), region);
      }
      break;
    case BrushMode::kErase: {
      const Index receiver = receiver_of(alpha_, touched, region);
      for (const auto& [v, strength] : touched) {
        set_weight(alpha_, v, region, (1 - strength) * alpha_(v, region), receiver);
      }
      break;
    }
    case BrushMode::kSmooth:
    case BrushMode::kGrow: {
      const auto neighbours = neighbours_of(surface_, touched);
      const double edge = edge_length(surface_.positions(), touched, neighbours);
      const double smooth = kSmoothDistance * brush.radius / std::max(edge, 1e-300);
      const double grow = kGrowDistance * brush.radius / std::max(edge, 1e-300);
      const bool smooths = brush.mode == BrushMode::kSmooth;
      // Each round grows the region by one edge. Smoothing acts like diffusion: n rounds smooth
      // over a distance of √n edges.
      for (int i = rounds(smooths ? smooth * smooth : grow); i > 0; --i) {
        if (smooths) {
          smooth_once(touched, neighbours, alpha_);
        } else {
          grow_once(touched, neighbours, region, alpha_);
        }
      }
      break;
    }
  }
  return rows;
}

MaskPainter::Alpha MaskPainter::alpha_without(Index region) const {
  const Index count = alpha_.cols();
  require(region >= 0 && region < count && count > 1, "paint: region ", region, " of ", count,
          " cannot be removed");
  Alpha rest(alpha_.rows(), count - 1);
  rest << alpha_.leftCols(region), alpha_.rightCols(count - 1 - region);
  std::vector<std::uint32_t> unassigned;
  for (Index v = 0; v < rest.rows(); ++v) {
    if (rest.row(v).sum() > 0) {
      scale_to_one(rest, v);
    } else {
      unassigned.push_back(static_cast<std::uint32_t>(v));
    }
  }
  // Vertices that belonged only to the removed region have no weights now. Give these vertices
  // weights, from the border of the removed region inwards.
  while (!unassigned.empty()) {
    std::vector<std::uint32_t> left;
    std::vector<std::pair<std::uint32_t, Eigen::RowVectorXd>> filled;
    for (const std::uint32_t v : unassigned) {
      Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(rest.cols());
      for (const std::uint32_t n : surface_.adjacent_vertices(v)) sum += rest.row(n);
      if (sum.sum() > 0) {
        filled.emplace_back(v, sum);
      } else {
        left.push_back(v);
      }
    }
    for (const auto& [v, sum] : filled) {
      rest.row(v) = sum;
      scale_to_one(rest, v);
    }
    if (left.size() == unassigned.size()) break;
    unassigned = std::move(left);
  }
  for (const std::uint32_t v : unassigned) rest(v, 0) = 1;
  return rest;
}

bool MaskPainter::undo() {
  if (undo_steps_.empty()) return false;
  for (const auto& [v, row] : undo_steps_.back()) alpha_.row(v) = row;
  undo_steps_.pop_back();
  return true;
}

}  // namespace crowdface
