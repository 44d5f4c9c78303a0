// SPDX-License-Identifier: Apache-2.0
#include "support/reference_distance.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>

namespace crowdface::reference {
namespace {

using Matrix4 = std::array<std::array<double, 4>, 4>;

/// The largest root of each vertex' set, sets being joined by edges.
std::vector<std::size_t> parts_of(const Obj& mesh) {
  std::vector<std::size_t> part(mesh.vertices.size());
  std::iota(part.begin(), part.end(), std::size_t{0});
  const std::function<std::size_t(std::size_t)> root = [&](std::size_t v) {
    while (part[v] != v) v = part[v] = part[part[v]];
    return v;
  };
  for (const auto& face : mesh.faces) {
    for (const std::size_t v : face) part[root(v)] = root(face[0]);
  }
  for (std::size_t v = 0; v < part.size(); ++v) part[v] = root(v);
  return part;
}

/// The unit quaternion that belongs to the largest eigenvalue, by repeated squaring.
std::array<double, 4> main_direction(Matrix4 m) {
  double shift = 0;
  for (const auto& row : m) {
    double sum = 0;
    for (const double value : row) sum += std::abs(value);
    shift = std::max(shift, sum);
  }
  for (std::size_t i = 0; i < 4; ++i) m[i][i] += shift;
  for (int round = 0; round < 60; ++round) {
    Matrix4 square{};
    double largest = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        for (std::size_t k = 0; k < 4; ++k) square[i][j] += m[i][k] * m[k][j];
        largest = std::max(largest, std::abs(square[i][j]));
      }
    }
    for (auto& row : square) {
      for (double& value : row) value /= largest;
    }
    m = square;
  }
  std::size_t longest = 0;
  for (std::size_t j = 1; j < 4; ++j) {
    if (m[j][j] > m[longest][longest]) longest = j;
  }
  std::array<double, 4> q{};
  double length = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    q[i] = m[i][longest];
    length += q[i] * q[i];
  }
  for (double& value : q) value /= std::sqrt(length);
  return q;
}

Point centre(const std::vector<double>& weights, const Points& points) {
  Point sum = {0, 0, 0};
  double total = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    total += weights[i];
    for (std::size_t c = 0; c < 3; ++c) sum[c] += weights[i] * points[i][c];
  }
  for (double& value : sum) value /= total;
  return sum;
}

}  // namespace

std::vector<double> front_areas(const Obj& mesh, const std::vector<Points>& heads) {
  Points mean(mesh.vertices.size(), Point{0, 0, 0});
  for (const Points& head : heads) {
    for (std::size_t i = 0; i < mean.size(); ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        mean[i][c] += head[i][c] / static_cast<double>(heads.size());
      }
    }
  }
  const std::vector<std::size_t> part = parts_of(mesh);
  std::map<std::size_t, std::size_t> sizes;
  for (const std::size_t p : part) ++sizes[p];
  const std::size_t skin =
      std::max_element(sizes.begin(), sizes.end(), [](const auto& a, const auto& b) {
        return a.second < b.second;
      })->first;
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (std::size_t i = 0; i < mean.size(); ++i) {
    if (part[i] != skin) continue;
    low = std::min(low, mean[i][2]);
    high = std::max(high, mean[i][2]);
  }
  std::vector<double> areas(mean.size(), 0.0);
  for (const auto& face : mesh.faces) {
    // Newell: the sum of the cross products around the polygon.
    Point twice = {0, 0, 0};
    for (std::size_t c = 0; c < face.size(); ++c) {
      const Point& a = mean[face[c]];
      const Point& b = mean[face[(c + 1) % face.size()]];
      for (std::size_t d = 0; d < 3; ++d) {
        twice[d] += a[(d + 1) % 3] * b[(d + 2) % 3] - a[(d + 2) % 3] * b[(d + 1) % 3];
      }
    }
    const double area =
        std::sqrt(twice[0] * twice[0] + twice[1] * twice[1] + twice[2] * twice[2]) / 2;
    for (const std::size_t v : face) {
      if (part[v] == skin && mean[v][2] >= (low + high) / 2) {
        areas[v] += area / static_cast<double>(face.size());
      }
    }
  }
  return areas;
}

/// The rotation by Horn's quaternion (1987).
double distance_mm(const std::vector<double>& areas, const Points& a, const Points& b,
                   double factor) {
  const Point ca = centre(areas, a), cb = centre(areas, b);
  double s[3][3] = {};
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) {
        s[r][c] += areas[i] * (b[i][r] - cb[r]) * (a[i][c] - ca[c]);
      }
    }
  }
  const Matrix4 n = {
      {{s[0][0] + s[1][1] + s[2][2], s[1][2] - s[2][1], s[2][0] - s[0][2], s[0][1] - s[1][0]},
       {s[1][2] - s[2][1], s[0][0] - s[1][1] - s[2][2], s[0][1] + s[1][0], s[2][0] + s[0][2]},
       {s[2][0] - s[0][2], s[0][1] + s[1][0], -s[0][0] + s[1][1] - s[2][2], s[1][2] + s[2][1]},
       {s[0][1] - s[1][0], s[2][0] + s[0][2], s[1][2] + s[2][1], -s[0][0] - s[1][1] + s[2][2]}}};
  const auto [w, x, y, z] = main_direction(n);
  const double r[3][3] = {
      {w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
      {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
      {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}};
  double sum = 0, total = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    total += areas[i];
    for (std::size_t row = 0; row < 3; ++row) {
      double moved = ca[row];
      for (std::size_t c = 0; c < 3; ++c) moved += r[row][c] * (b[i][c] - cb[c]);
      sum += areas[i] * (a[i][row] - moved) * (a[i][row] - moved);
    }
  }
  return factor * std::sqrt(sum / total);
}

}  // namespace crowdface::reference
