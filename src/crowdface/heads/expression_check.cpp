// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/expression_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "crowdface/core/parallel.h"
#include "crowdface/core/selection.h"
#include "crowdface/core/text.h"
#include "crowdface/mesh/alignment.h"
#include "crowdface/mesh/all_columns.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/paint/face_marks.h"

namespace crowdface {
namespace {

constexpr std::size_t kMinHeads = 4, kMinVertices = 50;
constexpr double kMinMm = 2, kMaxOfOthers = 3.2;
constexpr double kShare = 0.9;  ///< the compared deviation is this quantile over the vertices

/// A box around a facial feature. Lengths are multiples of the distance from mouth to eyes.
struct Box {
  const char* name;
  double height;      ///< height of the centre above the mouth
  double up, across;  ///< half extents
};
constexpr Box kBoxes[] = {{"mouth", 0, 0.4, 0.5}, {"eyes", 1, 0.25, 0.75}};
constexpr double kDepth = 0.6;  ///< depth of a box behind its foremost point

std::vector<Index> vertices_in(const Box& box, const FaceMarks& marks, const HeadShape& head,
                               const HeadAxes& axes) {
  const double face = marks.eye_to_mouth();
  std::vector<Index> inside;
  double foremost = -std::numeric_limits<double>::max();
  for (Index v = 0; v < head.positions.rows(); ++v) {
    if (!head.skin[static_cast<std::size_t>(v)]) continue;
    const Eigen::Vector3d place = row3(head.positions, v);
    const double above = place.dot(axes.up) - marks.mouth - box.height * face;
    const double aside = place.dot(axes.side()) - marks.middle;
    if (std::abs(above) > box.up * face || std::abs(aside) > box.across * face) continue;
    inside.push_back(v);
    foremost = std::max(foremost, place.dot(axes.front));
  }
  std::erase_if(inside, [&](Index v) {
    return row3(head.positions, v).dot(axes.front) < foremost - kDepth * face;
  });
  return inside;
}

double median(std::vector<double> values) {
  const std::size_t rank = values.size() / 2;
  return nth_smallest(std::move(values), rank);
}

/// The vertex-wise median of all heads. A single odd head hardly changes this median.
Positions middle_head(const HeadSet& head_set) {
  Positions middle(head_set.heads[0].positions.rows(), 3);
  parallel_for_each(static_cast<std::size_t>(middle.rows()), [&](std::size_t v) {
    for (Index c = 0; c < 3; ++c) {
      std::vector<double> values;
      for (const Head& head : head_set.heads) {
        values.push_back(head.positions(static_cast<Index>(v), c));
      }
      middle(static_cast<Index>(v), c) = median(std::move(values));
    }
  });
  return middle;
}

}  // namespace

std::vector<std::string> odd_expressions(const HeadSet& head_set, const std::vector<bool>& skin,
                                         const HeadAxes& axes, double mm) {
  if (head_set.heads.size() < kMinHeads) return {};
  const HeadShape head{middle_head(head_set), skin, {}};
  const auto marks = find_face_marks(head_set.topology, head, axes);
  if (!marks) return {};
  std::vector<std::string> warnings;
  for (const Box& box : kBoxes) {
    const std::vector<Index> vertices = vertices_in(box, *marks, head, axes);
    if (vertices.size() < kMinVertices) continue;
    const Positions middle = head.positions(vertices, kAllColumns);
    std::vector<double> off(head_set.heads.size());
    parallel_for_each(off.size(), [&](std::size_t h) {
      const Positions own = head_set.heads[h].positions(vertices, kAllColumns);
      const Positions moved = fit_similarity(own, middle, ScaleFit::kUniform).apply(own);
      std::vector<double> apart;
      for (Index i = 0; i < middle.rows(); ++i)
        apart.push_back((moved.row(i) - middle.row(i)).norm());
      const auto rank = static_cast<std::size_t>(kShare * static_cast<double>(apart.size()));
      off[h] = mm * nth_smallest(std::move(apart), rank);
    });
    const double usual = median(off);
    for (std::size_t h = 0; h < off.size(); ++h) {
      if (off[h] < kMinMm || off[h] < kMaxOfOthers * usual) continue;
      warnings.push_back(concat(
          head_set.heads[h].name, ": the shape of its ", box.name, " differs by ",
          format_fixed(off[h], 1), " mm from the median of all heads, the others by ",
          format_fixed(usual, 1),
          " mm: is its expression neutral? Faces built from this head take over its expression"));
    }
  }
  return warnings;
}

}  // namespace crowdface
