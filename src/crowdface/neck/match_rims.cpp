// SPDX-License-Identifier: Apache-2.0
#include "crowdface/neck/match_rims.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/mesh/alignment.h"
#include "crowdface/mesh/all_columns.h"

namespace crowdface {
namespace {

using Eigen::Vector3d;

// A body's rim matches the heads' rim only if they differ by at most these limits: the ratio of
// their radii (kMaxScale), and the angle of the rotation from one rim to the other
// (kMaxTurnDegrees). The rims of different people differ less; rims in different units, poses or
// positions differ more.
constexpr double kMaxScale = 1.3;
constexpr double kMaxTurnDegrees = 12;
constexpr double kRoundingMm = 0.01;

double length_of(const Rim& rim, const Positions& positions) {
  double sum = 0;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    sum += (row3(positions, rim[i]) - row3(positions, rim[(i + 1) % rim.size()])).norm();
  }
  return sum;
}

Vector3d centroid(const Positions& points) {
  Vector3d sum = Vector3d::Zero();
  for (Index i = 0; i < points.rows(); ++i) sum += row3(points, i);
  return sum / static_cast<double>(points.rows());
}

Positions centred(const Positions& points) {
  return points.rowwise() - centroid(points).transpose();
}

double square_sum(const Positions& rows) {
  double sum = 0;
  for (Index i = 0; i < rows.size(); ++i) sum += rows.data()[i] * rows.data()[i];
  return sum;
}

double root_mean_square(const Positions& rows) {
  return std::sqrt(square_sum(rows) / static_cast<double>(rows.rows()));
}

/// The rigid motion that best maps one rim to another rim.
struct RigidFit {
  double degrees = 0;  ///< rotation angle of the motion
  double rms_mm = 0;   ///< rms distance of corresponding vertices of both rims after the motion
};

RigidFit rigid_fit(const Positions& from, const Positions& to) {
  const Similarity motion = fit_similarity(from, to, ScaleFit::kRigid);
  return {motion.angle_degrees(), root_mean_square(to - motion.apply(from))};
}

/// The vertices of `rim` from index `shift` on, forwards or backwards.
Rim shifted(const Rim& rim, std::size_t shift, bool forwards) {
  Rim result;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const std::size_t step = forwards ? i : rim.size() - i;
    result.push_back(rim[(shift + step) % rim.size()]);
  }
  return result;
}

/// Root mean square, over `points`, of the distance from a point to the nearest point of `others`.
double nearest_rms(const Positions& points, const Positions& others) {
  double sum = 0;
  for (Index i = 0; i < points.rows(); ++i) {
    double nearest = std::numeric_limits<double>::max();
    for (Index k = 0; k < others.rows(); ++k) {
      nearest = std::min(nearest, (row3(points, i) - row3(others, k)).squaredNorm());
    }
    sum += nearest;
  }
  return std::sqrt(sum / static_cast<double>(points.rows()));
}

std::string mm_text(double mm) {
  return concat(format_fixed(mm, 1), " mm");
}

/// The vertices of a body's rim in one order, and how well they fit the heads' rim.
struct OrderedRim {
  Rim order;
  /// sum of squared distances between corresponding vertices, before any motion
  double square_sum = 0;
  RigidFit fit;
};

/// Returns a text that says why two matched rims do not belong together; empty if the rims belong
/// together.
/// \param fit  the rigid fit of the rims, in the order of the match
std::string fault_of(const Positions& head, const Positions& body, const RigidFit& fit,
                     double max_distance_mm) {
  const Positions from = centred(head), to = centred(body);
  const double radius = root_mean_square(from), found = root_mean_square(to);
  const double off = (centroid(body) - centroid(head)).norm();
  if (!(found < kMaxScale * radius && radius < kMaxScale * found)) {
    return concat("is ", format_fixed(found / radius, 2), " times as large and ", mm_text(off),
                  " off: its radius is ", mm_text(found), ", that of the heads' rim ",
                  mm_text(radius), " (scaled, in another unit, or at another end of the body?)");
  }
  if (off > max_distance_mm) return concat("lies elsewhere, ", mm_text(off), " off the heads' rim");
  if (fit.degrees > kMaxTurnDegrees) {
    return concat("is turned by ", format_fixed(fit.degrees, 0), " degrees, ",
                  mm_text(2 * radius * std::sin(fit.degrees * std::numbers::pi / 360)),
                  " along the heads' rim");
  }
  if (fit.rms_mm <= max_distance_mm / 3) return {};
  if (nearest_rms(from, to) < fit.rms_mm / 2) {
    return concat("has its vertices in another order: one after the other they lie ",
                  mm_text(fit.rms_mm), " (rms) off those of the heads' rim");
  }
  return concat("has another form: its vertices lie ", mm_text(fit.rms_mm),
                " (rms) off those of the heads' rim");
}

/// Returns the order of a body's rim vertices with the best rigid fit to the heads' rim.
/// \param orders  all orders of one direction around the rim, followed by all orders of the
///                opposite direction, if any
/// \param first_direction_count  number of orders in the first direction
const OrderedRim& best_rigid_fit(const std::vector<OrderedRim>& orders,
                                 std::size_t first_direction_count) {
  // A rim whose left and right halves are equal also fits in the wrong direction, after a rotation
  // that turns the rim upside down. So compare the best fits of both directions. If the larger
  // error is at most kMaxErrorRatio times the smaller error, choose the direction with the smaller
  // rotation.
  constexpr double kMaxErrorRatio = 1.2;
  const std::span all(orders);
  const auto rms_mm = [](const OrderedRim& one) { return one.fit.rms_mm; };
  const OrderedRim* best = &*std::ranges::min_element(all.first(first_direction_count), {}, rms_mm);
  if (all.size() == first_direction_count) return *best;
  const OrderedRim* other =
      &*std::ranges::min_element(all.subspan(first_direction_count), {}, rms_mm);
  if (other->fit.rms_mm < best->fit.rms_mm) std::swap(best, other);
  const bool alike = other->fit.rms_mm <= kMaxErrorRatio * best->fit.rms_mm + kRoundingMm;
  return alike && other->fit.degrees < best->fit.degrees ? *other : *best;
}

/// Text that lists the body's rims nearest to the heads' rim: for each, its number of vertices and
/// the distance of its centroid from the centroid of the heads' rim. \param rims nearest first
std::string list_of(const std::vector<RimMatch>& rims) {
  constexpr std::size_t kNamed = 6;
  std::vector<std::string> named;
  for (const RimMatch& one : rims) {
    if (named.size() == kNamed) break;
    named.push_back(
        concat(one.rim.size(), " vertices, ", mm_text(one.centroid_distance_mm), " off"));
  }
  const std::size_t more = rims.size() - named.size();
  return join(named, "; ") + (more > 0 ? concat("; and ", more, " more") : "");
}

}  // namespace

Rim lowest_rim(const std::vector<Rim>& rims, const Positions& positions, const Vector3d& up,
               double mm) {
  constexpr double kLong = 0.5, kSameHeightMm = 10;
  double longest = 0;
  for (const Rim& rim : rims) longest = std::max(longest, length_of(rim, positions));
  // The long rims, with the heights of their centroids.
  std::vector<std::pair<double, const Rim*>> long_rims;
  for (const Rim& rim : rims) {
    if (length_of(rim, positions) < kLong * longest) continue;
    long_rims.emplace_back(centroid(positions(rim, kAllColumns)).dot(up), &rim);
  }
  if (long_rims.empty()) {
    throw InvalidInput("the heads have no open rim; neck.rim can name the vertices of the seam");
  }
  std::ranges::stable_sort(long_rims, {}, &std::pair<double, const Rim*>::first);
  if (long_rims.size() > 1 && (long_rims[1].first - long_rims[0].first) * mm < kSameHeightMm) {
    throw InvalidInput(concat("the heads have two open rims at their lower end, of ",
                              long_rims[0].second->size(), " and ", long_rims[1].second->size(),
                              " vertices; neck.rim can name the vertices of the seam"));
  }
  return *long_rims.front().second;
}

RimMatch match_rims(const Positions& head_rim, const Rim& body_rim, const Positions& body_positions,
                    double max_distance_mm, RimOrder order) {
  // An order assigns the vertices of the body's rim to the vertices of the heads' rim. Order A has
  // the smallest distances between the unmoved rims. A may be wrong if the heads are rotated
  // relative to the body. Order B has the best rigid fit (see best_rigid_fit). Choose B if the RMS
  // distance of its rigid fit is less than kMuchBetter times the RMS distance of A's rigid fit.
  constexpr double kMuchBetter = 0.85;
  std::vector<OrderedRim> orders;
  const bool is_free = order == RimOrder::kFree;
  for (const bool forwards : {true, false}) {
    for (std::size_t shift = 0; shift < body_rim.size(); ++shift) {
      if (!is_free && !orders.empty()) continue;
      Rim vertices = shifted(body_rim, shift, forwards);
      const Positions points = body_positions(vertices, kAllColumns);
      const double sum = square_sum(points - head_rim);
      orders.push_back({std::move(vertices), sum, rigid_fit(head_rim, points)});
    }
  }
  const OrderedRim* best = &*std::ranges::min_element(orders, {}, &OrderedRim::square_sum);
  const OrderedRim& turned = best_rigid_fit(orders, is_free ? body_rim.size() : 1);
  if (turned.fit.rms_mm < kMuchBetter * best->fit.rms_mm - kRoundingMm) best = &turned;
  RimMatch match;
  match.rim = best->order;
  const Positions points = body_positions(match.rim, kAllColumns);
  match.centroid_distance_mm = (centroid(points) - centroid(head_rim)).norm();
  match.mismatch_reason = fault_of(head_rim, points, best->fit, max_distance_mm);
  return match;
}

Rim find_matching_rim(const Positions& head_rim, const std::vector<Rim>& body_rims,
                      const Positions& body_positions, double max_distance_mm, RimOrder order) {
  const auto count = static_cast<std::size_t>(head_rim.rows());
  std::vector<RimMatch> found, fitting;
  for (const Rim& rim : body_rims) {
    if (rim.size() == count) {
      found.push_back(match_rims(head_rim, rim, body_positions, max_distance_mm, order));
      if (found.back().mismatch_reason.empty()) fitting.push_back(found.back());
    } else {
      const Positions points = body_positions(rim, kAllColumns);
      found.push_back({rim, (centroid(points) - centroid(head_rim)).norm(), {}});
    }
  }
  if (fitting.size() == 1) return fitting.front().rim;
  const std::string expected =
      concat("expected an open rim of ", count, " vertices where the heads' neck ends, found ");
  if (found.empty()) throw InvalidInput(expected + "none");
  for (auto* matches : {&found, &fitting})
    std::ranges::sort(*matches, {}, &RimMatch::centroid_distance_mm);
  if (fitting.size() > 1) {
    throw InvalidInput(concat(expected, fitting.size(), " that fit, ",
                              mm_text(fitting[0].centroid_distance_mm), " and ",
                              mm_text(fitting[1].centroid_distance_mm), " off"));
  }
  if (!found.front().mismatch_reason.empty()) {
    throw InvalidInput(concat(expected, "one that ", found.front().mismatch_reason));
  }
  throw InvalidInput(concat(expected, "rims of ", list_of(found)));
}

}  // namespace crowdface
