// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/expression_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
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
constexpr std::size_t kMaxItems = 20'000;  ///< largest number of edges or vertices measured per box

/// A box around a facial feature. Lengths are multiples of the distance from mouth to eyes.
struct Box {
  double height;      ///< height of the centre above the mouth
  double up, across;  ///< half extents
};
constexpr Box kMouth = {0, 0.45, 0.6}, kEyes = {1, 0.25, 0.75};
constexpr double kDepth = 0.6;  ///< depth of a box behind its foremost point

std::vector<Index> vertices_in(const Box& box, const FaceMarks& marks, const HeadShape& head,
                               const HeadAxes& axes) {
  const double face = marks.eye_to_mouth();
  std::vector<Index> inside;
  double foremost = -std::numeric_limits<double>::max();
  for (Index v = 0; v < head.positions.rows(); ++v) {
    if (!head.is_skin[static_cast<std::size_t>(v)]) continue;
    const Eigen::Vector3d place = row3(head.positions, v);
    const double above = place.dot(axes.up) - marks.mouth_height - box.height * face;
    const double aside = place.dot(axes.side()) - marks.symmetry_offset;
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

/// A part of the face on all heads, each after a similarity fit of the part to `middle`.
struct AlignedPart {
  Positions middle;              ///< #vertices by 3, the vertex-wise median of all heads
  std::vector<Positions> heads;  ///< #heads, each #vertices by 3
};

AlignedPart align(const HeadSet& head_set, const Positions& middle,
                  const std::vector<Index>& vertices) {
  AlignedPart part{middle(vertices, kAllColumns), std::vector<Positions>(head_set.heads.size())};
  parallel_for_each(part.heads.size(), [&](std::size_t h) {
    const Positions own = head_set.heads[h].positions(vertices, kAllColumns);
    part.heads[h] = fit_similarity(own, part.middle, ScaleFit::kUniform).apply(own);
  });
  return part;
}

/// An edge of the mesh: two indices into the vertices of a part, ascending.
using Edge = std::array<Index, 2>;

std::vector<Edge> edges_between(const Topology& topology, const std::vector<Index>& vertices) {
  std::vector<Index> index_in_part(static_cast<std::size_t>(topology.vertex_count), -1);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    index_in_part[static_cast<std::size_t>(vertices[i])] = static_cast<Index>(i);
  }
  std::vector<Edge> edges;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const std::span<const std::uint32_t> polygon = topology.face(f);
    for (std::size_t c = 0; c < polygon.size(); ++c) {
      const Index a = index_in_part[polygon[c]],
                  b = index_in_part[polygon[(c + 1) % polygon.size()]];
      // Each edge inside the skin belongs to two polygons, which list its ends in opposite order.
      // Thus only one of these polygons has a < b.
      if (a >= 0 && a < b) edges.push_back({a, b});
    }
  }
  return edges;
}

double mean_length(const Positions& positions, const std::vector<Edge>& edges) {
  double sum = 0;
  for (const auto& [a, b] : edges) sum += (positions.row(a) - positions.row(b)).norm();
  return sum / static_cast<double>(edges.size());
}

/// Applies `times` smoothing steps. A step replaces each row by the average of the row and the mean
/// of its neighbours.
void smooth(Positions& rows, const std::vector<Edge>& edges, int times) {
  Eigen::VectorXd neighbours = Eigen::VectorXd::Zero(rows.rows());
  for (const auto& [a, b] : edges) {
    neighbours[a] += 1;
    neighbours[b] += 1;
  }
  for (int i = 0; i < times; ++i) {
    Positions sum = Positions::Zero(rows.rows(), 3);
    for (const auto& [a, b] : edges) {
      sum.row(a) += rows.row(b);
      sum.row(b) += rows.row(a);
    }
    for (Index v = 0; v < rows.rows(); ++v) {
      if (neighbours[v] > 0) rows.row(v) = 0.5 * (rows.row(v) + sum.row(v) / neighbours[v]);
    }
  }
}

/// Differences between each head and the other heads: #heads by #items, not negative.
using Differences = Eigen::MatrixXd;

/// Measures how far the edges are stretched or compressed: |log(length / length on the median)|.
/// Another person's proportions change lengths over wide areas; the similarity fit removes most of
/// this change. A smile, a pursed or an open mouth stretches only the skin near the mouth.
/// \param mm  millimetres per file unit
Differences edge_strains(AlignedPart part, const std::vector<Edge>& edges, double mm) {
  // Displacements of dense meshes are smoothed over kPatchMm. Otherwise pores and the noise of a
  // scan change the lengths of short edges more than an expression does.
  constexpr double kPatchMm = 2;
  const double ratio = kPatchMm / (mm * mean_length(part.middle, edges));
  const int times = static_cast<int>(std::clamp(ratio * ratio - 1, 0.0, 60.0));
  const std::vector<Edge> measured = evenly_spaced_items(edges, kMaxItems);
  Differences strains(part.heads.size(), measured.size());
  parallel_for_each(part.heads.size(), [&](std::size_t h) {
    Positions& head = part.heads[h];
    head -= part.middle;
    smooth(head, edges, times);
    head += part.middle;
    for (std::size_t e = 0; e < measured.size(); ++e) {
      const auto& [a, b] = measured[e];
      const double length = (head.row(a) - head.row(b)).norm();
      const double middle = (part.middle.row(a) - part.middle.row(b)).norm();
      strains(static_cast<Index>(h), static_cast<Index>(e)) =
          length > 0 && middle > 0 ? std::abs(std::log(length / middle)) : 0;
    }
  });
  return strains;
}

/// For each head, the distances between its vertices and the same vertices of the median head, in
/// millimetres.
Differences vertex_distances(const AlignedPart& part, double mm) {
  std::vector<Index> rows(static_cast<std::size_t>(part.middle.rows()));
  std::iota(rows.begin(), rows.end(), Index{0});
  rows = evenly_spaced_items(rows, kMaxItems);
  Differences distances(part.heads.size(), rows.size());
  for (std::size_t h = 0; h < part.heads.size(); ++h) {
    distances.row(static_cast<Index>(h)) =
        mm * (part.heads[h] - part.middle)(rows, kAllColumns).rowwise().norm().transpose();
  }
  return distances;
}

/// Limits beyond which a head counts as different from the other heads.
struct OutlierLimits {
  /// A head's difference is this quantile of the differences of its edges or vertices.
  double quantile;
  /// added to the denominator of each relative difference, so that a tiny difference is not an
  /// outlier where all heads are almost equal; in the unit of the differences
  double min_difference;
  double min_score;              ///< smallest score of an outlier
  double min_score_over_median;  ///< smallest ratio of an outlier's score to the median score
};
constexpr OutlierLimits kMouthStrain = {0.7, 0.2, 0.57, 1.5};
// Closed lids move far and stretch the skin. Eyes of another size or depth move far
// but stretch the skin little.
constexpr OutlierLimits kEyeDistance = {0.98, 0.5, 2.7, 1.5}, kEyeStrain = {0.9, 0.2, 0.72, 1};

double quantile(const Eigen::VectorXd& values, double share) {
  const auto rank = static_cast<std::size_t>(share * static_cast<double>(values.size()));
  return nth_smallest({values.begin(), values.end()}, rank);
}

/// A head that differs from the others.
struct Outlier {
  std::size_t head;
  double difference;  ///< quantile of the head's differences
  double usual;       ///< median of `difference` over all heads
};

/// Finds the heads whose differences are large compared with those of the other heads at the same
/// places.
std::vector<Outlier> outliers(const Differences& differences, const OutlierLimits& limits) {
  const Index count = differences.rows();
  const Eigen::RowVectorXd squares = differences.colwise().squaredNorm();
  std::vector<double> scores(static_cast<std::size_t>(count)), plain(scores);
  for (Index h = 0; h < count; ++h) {
    const Eigen::RowVectorXd own = differences.row(h);
    const Eigen::RowVectorXd others =
        ((squares - own.cwiseAbs2()).cwiseMax(0) / static_cast<double>(count - 1)).cwiseSqrt();
    const Eigen::RowVectorXd relative = own.array() / (others.array() + limits.min_difference);
    scores[static_cast<std::size_t>(h)] = quantile(relative.transpose(), limits.quantile);
    plain[static_cast<std::size_t>(h)] = quantile(own.transpose(), limits.quantile);
  }
  const double usual_score = median(scores), usual = median(plain);
  std::vector<Outlier> found;
  for (std::size_t h = 0; h < scores.size(); ++h) {
    if (scores[h] < limits.min_score || scores[h] < limits.min_score_over_median * usual_score) {
      continue;
    }
    found.push_back({h, plain[h], usual});
  }
  return found;
}

}  // namespace

std::vector<std::string> odd_expression_warnings(const HeadSet& head_set,
                                                 const std::vector<bool>& skin,
                                                 const HeadAxes& axes, double mm) {
  if (head_set.heads.size() < kMinHeads) return {};
  const HeadShape head{middle_head(head_set), skin, {}};
  const auto marks = find_face_marks(head_set.topology, head, axes);
  if (!marks) return {};
  std::vector<std::string> warnings;
  const auto warn = [&](std::size_t h, const std::string& difference) {
    warnings.push_back(
        concat(head_set.heads[h].name, ": ", difference,
               ": is its expression neutral? Faces built from this head take over its expression"));
  };
  const std::vector<Index> mouth = vertices_in(kMouth, *marks, head, axes);
  const std::vector<Edge> edges = edges_between(head_set.topology, mouth);
  if (mouth.size() >= kMinVertices && !edges.empty()) {
    const AlignedPart part = align(head_set, head.positions, mouth);
    for (const auto& [h, strain, usual] : outliers(edge_strains(part, edges, mm), kMouthStrain)) {
      warn(h, concat("the skin around its mouth is stretched or compressed by ",
                     format_fixed(100 * strain, 0),
                     " % compared with the median of all heads, the "
                     "others' by ",
                     format_fixed(100 * usual, 0), " %"));
    }
  }
  const std::vector<Index> eyes = vertices_in(kEyes, *marks, head, axes);
  const std::vector<Edge> eye_edges = edges_between(head_set.topology, eyes);
  if (eyes.size() >= kMinVertices && !eye_edges.empty()) {
    const AlignedPart part = align(head_set, head.positions, eyes);
    const std::vector<Outlier> stretched = outliers(edge_strains(part, eye_edges, mm), kEyeStrain);
    for (const auto& [h, distance, usual] : outliers(vertex_distances(part, mm), kEyeDistance)) {
      if (std::ranges::find(stretched, h, &Outlier::head) == stretched.end()) continue;
      warn(h,
           concat("its lids are up to ", format_fixed(distance, 1),
                  " mm from the median of all heads, the others' ", format_fixed(usual, 1), " mm"));
    }
  }
  return warnings;
}

}  // namespace crowdface
