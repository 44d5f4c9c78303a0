// SPDX-License-Identifier: Apache-2.0
#include "support/reference.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>
#include <stdexcept>

namespace crowdface::reference {
namespace {

Point operator+(const Point& a, const Point& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Point operator-(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Point operator*(double s, const Point& a) {
  return {s * a[0], s * a[1], s * a[2]};
}

/// "7/3/9" and the like, also counted from the end; no texture coordinate: nothing.
std::pair<std::size_t, std::optional<std::size_t>> corner(const std::string& text,
                                                          std::size_t vertices, std::size_t uvs) {
  const auto index = [](const std::string& number, std::size_t count) {
    const long value = std::stol(number);
    return value > 0 ? static_cast<std::size_t>(value - 1)
                     : count - static_cast<std::size_t>(-value);
  };
  const std::size_t slash = text.find('/');
  const std::size_t v = index(text.substr(0, slash), vertices);
  if (slash == text.npos) return {v, std::nullopt};
  const std::size_t second = text.find('/', slash + 1);
  const std::string uv = text.substr(slash + 1, second == text.npos ? second : second - slash - 1);
  if (uv.empty()) return {v, std::nullopt};
  return {v, index(uv, uvs)};
}

/// One channel, bilinear between texel centres, clamped at the edge; row 0 is at v = 1.
double sample(const Picture& picture, double u, double v, std::size_t channel) {
  const double x = u * static_cast<double>(picture.width) - 0.5;
  const double y = (1 - v) * static_cast<double>(picture.height) - 0.5;
  const auto texel = [&](double column, double row) {
    const double c = std::clamp(column, 0.0, static_cast<double>(picture.width) - 1);
    const double r = std::clamp(row, 0.0, static_cast<double>(picture.height) - 1);
    const std::size_t at =
        static_cast<std::size_t>(r) * picture.width + static_cast<std::size_t>(c);
    return picture.values.at(at * picture.channels + channel);
  };
  const double left = std::floor(x), above = std::floor(y);
  const double fx = x - left, fy = y - above;
  return (1 - fy) * ((1 - fx) * texel(left, above) + fx * texel(left + 1, above)) +
         fy * ((1 - fx) * texel(left, above + 1) + fx * texel(left + 1, above + 1));
}

/// The tile along one axis: ⌊c⌋, or where c is whole that of the polygon's middle.
double tile_of(double coordinate, double middle) {
  return coordinate == std::floor(coordinate)
             ? std::min(std::max(std::floor(middle), coordinate - 1), coordinate)
             : std::floor(coordinate);
}

using Smoothed = std::function<Points(const std::string& head, std::uint64_t level)>;

/// Eq. 7; `smoothed` gives x^L or what stands for it.
Points blend_with(const Heads& heads, const nlohmann::json& line, const Smoothed& smoothed) {
  const auto target = line.at("target").get<std::string>();
  const nlohmann::json mixture = line.value("mixture", nlohmann::json{{target, 1.0}});
  Points result(heads.positions.at(target).size(), Point{0, 0, 0});
  for (std::size_t k = 0; k < heads.regions.size(); ++k) {
    const nlohmann::json& region = line.at("regions").at(heads.regions[k]);
    const auto level = region.at("iterations").get<std::uint64_t>();
    Points face(result.size(), Point{0, 0, 0});
    for (const auto& [name, share] : mixture.items()) {  // B^L, of a mixture Σ τ_h B_h^L
      const Points flat = smoothed(name, level);
      for (std::size_t i = 0; i < face.size(); ++i) {
        face[i] = face[i] + share.get<double>() * flat[i];
      }
    }
    std::vector<nlohmann::json> bands = {region};  // the finer ones in the order of their names
    if (region.contains("bands")) {
      for (const auto& [name, band] : region.at("bands").items()) bands.push_back(band);
    }
    for (std::size_t b = 0; b < bands.size(); ++b) {
      const auto begin = bands[b].at("iterations").get<std::uint64_t>();
      const auto e = bands[b].at("extrapolation").get<double>();
      for (const auto& [name, weight] : bands[b].at("weights").items()) {
        const Points fine = b + 1 < bands.size()
                                ? smoothed(name, bands[b + 1].at("iterations").get<std::uint64_t>())
                                : heads.positions.at(name);
        const Points coarse = smoothed(name, begin);  // C^L
        for (std::size_t i = 0; i < face.size(); ++i) {
          face[i] = face[i] + e * weight.get<double>() * (fine[i] - coarse[i]);
        }
      }
    }
    for (std::size_t i = 0; i < face.size(); ++i) {
      result[i] = result[i] + heads.alpha[i][k] * face[i];
    }
  }
  return result;
}

/// Solves the 4 by 4 normal equations of the fit by elimination with pivots.
std::array<Point, 4> solve(std::array<std::array<long double, 4>, 4> a,
                           std::array<std::array<long double, 3>, 4> b) {
  for (std::size_t p = 0; p < 4; ++p) {
    std::size_t pivot = p;
    for (std::size_t r = p; r < 4; ++r) {
      if (std::abs(a[r][p]) > std::abs(a[pivot][p])) pivot = r;
    }
    std::swap(a[p], a[pivot]);
    std::swap(b[p], b[pivot]);
    for (std::size_t r = 0; r < 4; ++r) {
      if (r == p) continue;
      const long double factor = a[r][p] / a[p][p];
      for (std::size_t c = 0; c < 4; ++c) a[r][c] -= factor * a[p][c];
      for (std::size_t c = 0; c < 3; ++c) b[r][c] -= factor * b[p][c];
    }
  }
  std::array<Point, 4> x{};
  for (std::size_t p = 0; p < 4; ++p) {
    for (std::size_t c = 0; c < 3; ++c) x[p][c] = static_cast<double>(b[p][c] / a[p][p]);
  }
  return x;
}

}  // namespace

Obj read_obj(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot open " + path.string());
  Obj mesh;
  std::string line;
  while (std::getline(file, line)) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "v") {
      Point& p = mesh.vertices.emplace_back();
      words >> p[0] >> p[1] >> p[2];
    } else if (word == "vt") {
      auto& t = mesh.uvs.emplace_back();
      words >> t[0] >> t[1];
    } else if (word == "f") {
      auto& face = mesh.faces.emplace_back();
      auto& uvs = mesh.face_uvs.emplace_back();
      while (words >> word) {
        const auto [v, t] = corner(word, mesh.vertices.size(), mesh.uvs.size());
        face.push_back(v);
        uvs.push_back(t);
      }
    }
  }
  return mesh;
}

Filter make_filter(const Obj& mesh, bool fixed_boundary, bool lazy) {
  std::vector<std::set<std::size_t>> rings(mesh.vertices.size());
  // A face that runs along an edge both ways, as around a slit, is on both sides of it.
  std::map<std::pair<std::size_t, std::size_t>, int> sides_of_edge;
  for (const auto& face : mesh.faces) {
    for (std::size_t c = 0; c < face.size(); ++c) {
      const std::size_t a = face[c], b = face[(c + 1) % face.size()];
      if (a == b) continue;
      rings[a].insert(b);
      rings[b].insert(a);
      ++sides_of_edge[{std::min(a, b), std::max(a, b)}];
    }
  }
  Filter filter;
  filter.lazy = lazy;
  for (const auto& ring : rings) {
    filter.rings.emplace_back(ring.begin(), ring.end());
    filter.stays.push_back(ring.empty());
  }
  if (fixed_boundary) {
    for (const auto& [edge, sides] : sides_of_edge) {
      if (sides == 1) filter.stays[edge.first] = filter.stays[edge.second] = true;
    }
  }
  return filter;
}

Points smooth(const Filter& filter, Points x, std::uint64_t level) {
  Points next = x;
  for (std::uint64_t l = 0; l < level; ++l) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (filter.stays[i]) continue;
      Point sum = {0, 0, 0};
      for (const std::size_t j : filter.rings[i]) sum = sum + x[j];
      next[i] = (1.0 / static_cast<double>(filter.rings[i].size())) * sum;  // Eq. 1
      if (filter.lazy) next[i] = 0.5 * (x[i] + next[i]);
    }
    std::swap(x, next);
  }
  return x;
}

std::vector<std::vector<double>> masks_at_vertices(const Obj& mesh, const std::vector<Mask>& masks,
                                                   std::size_t regions) {
  // A place is a texture coordinate and the tile it is looked up in.
  std::vector<std::set<std::array<double, 4>>> places(mesh.vertices.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto& uvs = mesh.face_uvs[f];
    std::array<double, 2> middle = {0, 0};
    for (const auto& t : uvs) {
      if (!t) throw std::runtime_error("a corner has no texture coordinate");
      for (std::size_t d = 0; d < 2; ++d) {
        middle[d] += mesh.uvs[*t][d] / static_cast<double>(uvs.size());
      }
    }
    for (std::size_t c = 0; c < uvs.size(); ++c) {
      const auto& [u, v] = mesh.uvs[*uvs[c]];
      places[mesh.faces[f][c]].insert({u, v, tile_of(u, middle[0]), tile_of(v, middle[1])});
    }
  }
  std::vector<std::vector<double>> alpha(mesh.vertices.size(), std::vector<double>(regions, 0.0));
  for (std::size_t i = 0; i < alpha.size(); ++i) {
    for (const auto& [u, v, tile_u, tile_v] : places[i]) {
      std::size_t region = 0;
      for (const Mask& mask : masks) {
        const bool tiled = mask.find(0) == mask.end();
        const Picture& picture =
            tiled ? mask.at(1001 + static_cast<int>(tile_u) + 10 * static_cast<int>(tile_v))
                  : mask.at(0);
        for (std::size_t c = 0; c < picture.channels && region < regions; ++c, ++region) {
          alpha[i][region] +=
              tiled ? sample(picture, u - tile_u, v - tile_v, c) : sample(picture, u, v, c);
        }
      }
    }
    double sum = 0;
    for (const double a : alpha[i]) sum += a;
    for (double& a : alpha[i]) a = sum > 0 ? a / sum : 0;
    if (!(sum > 0)) alpha[i][regions - 1] = 1;
  }
  return alpha;
}

Points blend(const Heads& heads, const nlohmann::json& line) {
  return blend_with(heads, line, [&](const std::string& head, std::uint64_t level) {
    return smooth(heads.filter, heads.positions.at(head), level);
  });
}

Cubics fit_cubics(const Filter& filter, const Points& x, std::uint64_t max_level) {
  std::set<std::uint64_t> levels;
  for (int j = 0; j <= 40; ++j) {
    levels.insert(static_cast<std::uint64_t>(
        std::llround(static_cast<double>(max_level) * (j / 40.0) * (j / 40.0))));
  }
  std::array<std::array<long double, 4>, 4> a{};
  std::vector<std::array<std::array<long double, 3>, 4>> b(x.size());
  Points smoothed = x;
  std::uint64_t reached = 0;
  for (const std::uint64_t level : levels) {
    smoothed = smooth(filter, smoothed, level - reached);
    reached = level;
    const auto t = static_cast<long double>(level) / static_cast<long double>(max_level);
    const std::array<long double, 4> powers = {1, t, t * t, t * t * t};
    for (std::size_t p = 0; p < 4; ++p) {
      for (std::size_t q = 0; q < 4; ++q) a[p][q] += powers[p] * powers[q];
      for (std::size_t i = 0; i < x.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) b[i][p][c] += powers[p] * (smoothed[i][c] - x[i][c]);
      }
    }
  }
  Cubics cubics;
  cubics.max_level = max_level;
  for (const auto& right_side : b) cubics.coefficients.push_back(solve(a, right_side));
  return cubics;
}

Points smooth(const Cubics& cubics, Points x, std::uint64_t level) {
  const double t = static_cast<double>(level) / static_cast<double>(cubics.max_level);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto& c = cubics.coefficients[i];
    x[i] = x[i] + c[0] + t * c[1] + t * t * c[2] + t * t * t * c[3];
  }
  return x;
}

Points blend(const Heads& heads, const std::map<std::string, Cubics>& cubics,
             const nlohmann::json& line) {
  return blend_with(heads, line, [&](const std::string& head, std::uint64_t level) {
    return smooth(cubics.at(head), heads.positions.at(head), level);
  });
}

std::map<std::string, double> weights_at_position(
    const std::vector<std::pair<std::string, std::array<double, 2>>>& anchors,
    const std::string& target, const std::vector<std::string>& sources, std::array<double, 2> m,
    bool printed, std::optional<std::size_t> most) {
  const auto has = [&](const std::string& name) {
    return std::find(sources.begin(), sources.end(), name) != sources.end();
  };
  std::vector<std::pair<std::string, double>> weights;
  bool on_an_anchor = false;
  for (const auto& [name, t] : anchors) {
    if (name != target && !has(name)) continue;
    const double squared = (m[0] - t[0]) * (m[0] - t[0]) + (m[1] - t[1]) * (m[1] - t[1]);
    if (squared == 0) on_an_anchor = true;
    weights.emplace_back(name, squared);
  }
  for (auto& [name, w] : weights) {
    w = on_an_anchor ? (w == 0 ? 1 : 0) : 1 / w;  // Eq. 4
  }
  std::stable_sort(weights.begin(), weights.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  double denominator = 0;  // Eq. 3, from i = 0
  // The target's own weight always stays and is not counted.
  const auto own = std::find_if(weights.begin(), weights.end(),
                                [&](const auto& entry) { return entry.first == target; });
  const std::pair<std::string, double> omega_0 = *own;
  weights.erase(own);
  if (most && weights.size() > *most) weights.resize(*most);
  if (printed) {
    denominator += omega_0.second;
  } else {
    weights.push_back(omega_0);
  }
  for (const auto& [name, w] : weights) denominator += w;
  std::map<std::string, double> result;
  for (const auto& [name, w] : weights) {
    if (w > 0) result[name] = w / denominator;
  }
  return result;
}

double largest_difference(const Points& a, const Points& b) {
  if (a.size() != b.size()) return HUGE_VAL;
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Point d = a[i] - b[i];
    const double distance = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    if (!(distance <= largest)) largest = distance;  // also if it is no number
  }
  return largest;
}

Points vertex_normals(const Obj& mesh, const Points& positions) {
  Points normals(positions.size(), Point{0, 0, 0});
  for (const auto& face : mesh.faces) {
    Point area = {0, 0, 0};
    for (std::size_t c = 0; c < face.size(); ++c) {
      const Point& a = positions[face[c]];
      const Point& b = positions[face[(c + 1) % face.size()]];
      area = area + Point{(a[1] - b[1]) * (a[2] + b[2]), (a[2] - b[2]) * (a[0] + b[0]),
                          (a[0] - b[0]) * (a[1] + b[1])};
    }
    for (const std::size_t v : face) normals[v] = normals[v] + area;
  }
  for (Point& n : normals) {
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    n = length > 0 ? (1 / length) * n : Point{0, 0, 1};
  }
  return normals;
}

}  // namespace crowdface::reference
