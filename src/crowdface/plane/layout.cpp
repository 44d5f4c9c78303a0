// SPDX-License-Identifier: Apache-2.0
#include "crowdface/plane/layout.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>

#include "crowdface/core/require.h"

namespace crowdface {
namespace {

using Eigen::Index;

/// Rounds to 10⁻⁹. (Results of different C libraries differ by far less than this, so the rounded
/// values are the same.)
double rounded(double value) {
  const double result = std::round(value * 1e9) / 1e9;
  return result == 0 ? 0.0 : result;  // plans must not contain a negative zero
}

double cross(const PlanePoint& o, const PlanePoint& a, const PlanePoint& b) {
  return (a.x() - o.x()) * (b.y() - o.y()) - (a.y() - o.y()) * (b.x() - o.x());
}

}  // namespace

std::vector<PlanePoint> circle_layout(Index head_count) {
  std::vector<PlanePoint> anchors;
  for (Index i = 0; i < head_count; ++i) {
    const double angle =
        2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(head_count);
    anchors.emplace_back(rounded(std::cos(angle)), rounded(std::sin(angle)));
  }
  return anchors;
}

std::vector<PlanePoint> grid_layout(Index head_count) {
  Index columns = 1;
  while (columns * columns < head_count) ++columns;
  const Index rows = (head_count + columns - 1) / columns;
  const double step = columns > 1 ? 2.0 / static_cast<double>(columns - 1) : 0.0;
  std::vector<PlanePoint> anchors;
  for (Index i = 0; i < head_count; ++i) {
    const Index row = i / columns;
    const Index in_row = std::min(columns, head_count - row * columns);
    const double x = static_cast<double>(i % columns) - 0.5 * static_cast<double>(in_row - 1);
    const double y = 0.5 * static_cast<double>(rows - 1) - static_cast<double>(row);
    anchors.emplace_back(rounded(x * step), rounded(y * step));
  }
  return anchors;
}

std::vector<PlanePoint> similarity_layout(const Eigen::MatrixXd& distances) {
  const Index n = distances.rows();
  require(distances.cols() == n, "similarity layout: ", n, " by ", distances.cols(), " distances");
  // Double centring of the squared distances gives the Gram matrix of points with these distances.
  const Eigen::MatrixXd squared = distances.array().square();
  const Eigen::VectorXd row_means = squared.rowwise().mean();
  const double mean = row_means.mean();
  Eigen::MatrixXd gram(n, n);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      gram(i, j) = -0.5 * (squared(i, j) - row_means(i) - row_means(j) + mean);
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram);
  Eigen::MatrixXd points = Eigen::MatrixXd::Zero(n, 2);
  for (Index c = 0; c < std::min<Index>(2, n); ++c) {
    // take the largest eigenvalues first (Eigen sorts eigenvalues in ascending order)
    const Index k = n - 1 - c;
    Eigen::VectorXd direction = solver.eigenvectors().col(k);
    // The sign of an eigenvector is arbitrary. Make its largest entry positive, so that the head
    // with this entry lies to the right (or at the top).
    Index largest = 0;
    direction.cwiseAbs().maxCoeff(&largest);
    if (direction(largest) < 0) direction = -direction;
    points.col(c) = direction * std::sqrt(std::max(0.0, solver.eigenvalues()(k)));
  }
  const double radius = points.rowwise().norm().maxCoeff();
  if (radius > 0) points /= radius;
  std::vector<PlanePoint> anchors;
  for (Index i = 0; i < n; ++i) anchors.emplace_back(rounded(points(i, 0)), rounded(points(i, 1)));
  return anchors;
}

std::vector<PlanePoint> convex_hull(std::vector<PlanePoint> points) {
  const auto before = [](const PlanePoint& a, const PlanePoint& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  };
  std::ranges::sort(points, before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  // Monotone chain (Andrew 1979): first the lower half of the hull, then the upper half.
  std::vector<PlanePoint> hull;
  const auto extend = [&](const PlanePoint& p, std::size_t fixed) {
    while (hull.size() >= fixed + 2 && cross(hull[hull.size() - 2], hull.back(), p) <= 0) {
      hull.pop_back();
    }
    hull.push_back(p);
  };
  for (const PlanePoint& p : points) extend(p, 0);
  const std::size_t lower = hull.size() - 1;
  for (auto p = points.rbegin() + 1; p != points.rend(); ++p) extend(*p, lower);
  hull.pop_back();  // the last point is the first point again
  return hull;
}

PlanePoint sample_polygon(const std::vector<PlanePoint>& polygon, double pick, double a, double b) {
  require(!polygon.empty(), "a point in a polygon without corners");
  if (polygon.size() == 1) return polygon[0];
  if (polygon.size() == 2) return polygon[0] + a * (polygon[1] - polygon[0]);
  double total = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    total += cross(polygon[0], polygon[i], polygon[i + 1]);
  }
  // The polygon is divided into a fan of triangles. Find the triangle in which the cumulative area
  // reaches the fraction `pick` of the polygon's area.
  std::size_t triangle = 1;
  double left = pick * total;
  for (; triangle + 2 < polygon.size(); ++triangle) {
    const double area = cross(polygon[0], polygon[triangle], polygon[triangle + 1]);
    if (left < area) break;
    left -= area;
  }
  if (a + b > 1) {  // (a, b) is in the other half of the unit square: reflect it into the triangle
    a = 1 - a;
    b = 1 - b;
  }
  return polygon[0] + a * (polygon[triangle] - polygon[0]) +
         b * (polygon[triangle + 1] - polygon[0]);
}

}  // namespace crowdface
