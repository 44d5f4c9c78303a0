// SPDX-License-Identifier: Apache-2.0
#include "crowdface/bake/scan_bake.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "crowdface/core/parallel.h"
#include "crowdface/mesh/edge_distances.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/texture/fill_uncovered.h"
#include "crowdface/texture/optical_density.h"
#include "crowdface/wrap/elastic_solve.h"

namespace crowdface {
namespace {

constexpr Index kVertexBlock = 256;
constexpr int kTexelRows = 8;
/// Largest distance between a texel on the wrapped skin and the point of the scan that gives the
/// texel its colour.
constexpr double kMaxDistanceMm = 3;
/// Within this distance of the edge of the scan's data, the scan's colours fade out.
constexpr double kFeatherMm = 3;
/// At the rim of a hole in the scan, the tones of scan and template may differ. The difference
/// continues into the hole if it extends over at least this length of skin. Smaller differences
/// fade in the hole.
constexpr double kMinToneSizeMm = 8;
constexpr int kMaxSamples = 4;

/// Smooth function of `value`: 0 up to `low`, 1 from `high` on.
double smooth_step(double low, double high, double value) {
  const double t = std::clamp((value - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

Eigen::Vector3d density_of(const Eigen::Array3f& light) {
  return {static_cast<double>(density_of_light(light[0])),
          static_cast<double>(density_of_light(light[1])),
          static_cast<double>(density_of_light(light[2]))};
}

/// Two unit vectors perpendicular to a unit vector and to each other.
std::pair<Eigen::Vector3d, Eigen::Vector3d> tangents_of(const Eigen::Vector3d& normal) {
  const Eigen::Vector3d one = normal.unitOrthogonal();
  return {one, normal.cross(one)};
}

/// The nine real spherical harmonics of degrees 0, 1 and 2 in one direction, without their constant
/// factors.
using Harmonics = Eigen::Matrix<double, 9, 1>;
Harmonics harmonics_of(const Eigen::Vector3d& n) {
  Harmonics values;
  values << 1, n.x(), n.y(), n.z(), n.x() * n.y(), n.y() * n.z(), n.z() * n.x(),
      n.x() * n.x() - n.y() * n.y(), 3 * n.z() * n.z() - 1;
  return values;
}

/// Mean distance between neighbouring vertices of a scan, in mm, estimated from the mean area of
/// its triangles.
double spacing_of(const Scan& scan) {
  const double count = static_cast<double>(scan.triangles.size());
  constexpr std::size_t kBlock = 65536;
  const double area = parallel_sum(scan.triangles.size(), kBlock, [&](auto begin, auto end) {
    double sum = 0;
    for (auto t = begin; t < end; ++t) {
      sum += area_vector(scan.positions, scan.triangles[static_cast<std::size_t>(t)]).norm();
    }
    return sum;
  });
  return std::sqrt(area / std::max(count, 1.0));
}

}  // namespace

ScanBake::ScanBake(const BakeTemplate& bake_template, const Positions& wrapped,
                   const ScanSurface& surface, const ScanColours& colours,
                   const BakeOptions& options)
    : template_(bake_template),
      surface_(surface),
      colours_(colours),
      positions_(bake_template.wrap_template().skin.rows_of(wrapped)),
      normals_(vertex_normals_or_zero(bake_template.wrap_template().skin.triangles, positions_)),
      scan_spacing_mm_(spacing_of(surface.scan())) {
  OpticalDensities densities = OpticalDensities::Zero(positions_.rows(), 3);
  const std::vector<double> confidence = measure_scan_optical_densities(densities);
  compute_hole_fade_weights(confidence);
  if (options.removes_shading) {
    estimate_shading(confidence, densities);
    densities -= shading_densities_;
  }
  for (Index v = 0; v < densities.rows(); ++v) {
    const auto& place = template_.picture_vertices()[static_cast<std::size_t>(v)];
    if (place.picture == kNoIndex) continue;
    const double side = place.uv_per_mm * mean_edge_length(v);
    densities.row(v) -=
        template_optical_density(place.picture, place.uv, {side, 0}, {0, -side}).transpose();
  }
  compute_tone_differences(confidence, densities);
}

double ScanBake::mean_edge_length(Index vertex) const {
  const auto around = template_.wrap_template().skin.adjacency.items_of(vertex);
  double sum = 0;
  for (const std::uint32_t n : around) sum += (positions_.row(n) - positions_.row(vertex)).norm();
  return around.empty() ? 0 : sum / static_cast<double>(around.size());
}

ScanBake::ScanPoint ScanBake::find_scan_point(const SkinPoint& skin_point,
                                              std::uint32_t guess) const {
  ScanPoint seen;
  ScanSurface::ClosestPoint place = surface_.nearest(skin_point.position, skin_point.normal,
                                                     kMinNormalCosine, kMaxDistanceMm, guess);
  if (place.triangle == kNoIndex) return seen;
  // Approximate the point at which the skin point's normal hits the scan. Start with the scan's
  // closest point to the skin point. If this point is farther away than kCloseMm, project it onto
  // the normal, and take the scan's closest point to the projection.
  constexpr double kCloseMm = 0.01;
  if (place.distance > kCloseMm) {
    const double height = (place.point - skin_point.position).dot(skin_point.normal);
    const auto along =
        surface_.nearest(skin_point.position + height * skin_point.normal, skin_point.normal,
                         kMinNormalCosine, kMaxDistanceMm, place.triangle);
    if (along.triangle != kNoIndex) place = along;
  }
  seen.area.triangle = place.triangle;
  seen.area.barycentric =
      nearest_on_triangle(surface_.scan().positions, surface_.scan().triangles[place.triangle],
                          place.point)
          .barycentric;
  if (!place.is_found) return seen;
  const double distance = (place.point - skin_point.position).norm();
  seen.confidence =
      (1 - smooth_step(0.6 * kMaxDistanceMm, kMaxDistanceMm, distance)) *
      smooth_step(kMinNormalCosine, kMinNormalCosine + 0.15, place.normal.dot(skin_point.normal)) *
      smooth_step(0.5 * kVisibleSkinThreshold, 1.5 * kVisibleSkinThreshold,
                  skin_point.ambient_visibility);
  return seen;
}

std::optional<Eigen::Vector3d> ScanBake::mean_optical_density(const ScanArea& area) const {
  const auto light = colours_.mean_at(surface_.scan(), area);
  if (!light) return std::nullopt;
  return density_of(*light);
}

Eigen::Vector3d ScanBake::template_optical_density(std::size_t picture, const Eigen::Vector2d& uv,
                                                   const Eigen::Vector2d& to_right_texel,
                                                   const Eigen::Vector2d& to_lower_texel) const {
  const FilteredTexture* texture = template_.texture(picture);
  if (texture == nullptr) return Eigen::Vector3d::Zero();
  return density_of(texture->mean_at(uv, to_right_texel, to_lower_texel));
}

std::vector<double> ScanBake::measure_scan_optical_densities(
    OpticalDensities& optical_densities) const {
  const SkinMesh& skin = template_.wrap_template().skin;
  std::vector<double> confidence(skin.vertices.size(), 0.0);
  parallel_blocks(positions_.rows(), kVertexBlock, [&](Index begin, Index end) {
    std::uint32_t guess = kNoIndex;
    for (Index v = begin; v < end; ++v) {
      const auto row = static_cast<std::size_t>(v);
      const Eigen::Vector3d normal = row3(normals_, v);
      if (normal.isZero()) continue;
      ScanPoint seen =
          find_scan_point({row3(positions_, v), normal, skin.ambient_visibility[row]}, guess);
      guess = seen.area.triangle;
      if (seen.confidence == 0) continue;
      const auto [one, other] = tangents_of(normal);
      seen.area.to_right_texel = mean_edge_length(v) * one;
      seen.area.to_lower_texel = mean_edge_length(v) * other;
      const auto density = mean_optical_density(seen.area);
      if (!density) continue;
      optical_densities.row(v) = density->transpose();
      confidence[row] = seen.confidence;
    }
  });
  return confidence;
}

/// The weight of a skin vertex is 0 at visible vertices that the scan does not cover. With the
/// distance to the nearest such vertex, the weight rises to 1 at kFeatherMm.
void ScanBake::compute_hole_fade_weights(const std::vector<double>& confidence) {
  constexpr double kNone = 0.5;
  const SkinMesh& skin = template_.wrap_template().skin;
  std::vector<std::uint32_t> without;
  for (std::uint32_t v = 0; v < confidence.size(); ++v) {
    if (confidence[v] < kNone && skin.ambient_visibility[v] > kUnfoldedSkinThreshold)
      without.push_back(v);
  }
  EdgeDistances distances(skin.adjacency, positions_);
  distances.search(without, kFeatherMm);
  hole_fade_weights_.assign(confidence.size(), 1.0);
  for (const std::uint32_t v : distances.reached()) {
    hole_fade_weights_[v] = smooth_step(0, kFeatherMm, distances.distance(v));
  }
}

/// Fits spherical harmonics of the normals to the optical densities, averaged over red, green and
/// blue (Ramamoorthi & Hanrahan 2001: distant light on a convex surface). Iteratively reweighted
/// least squares gives lips, brows and hair small weights.
void ScanBake::estimate_shading(const std::vector<double>& confidence,
                                const OpticalDensities& densities) {
  constexpr int kRounds = 10;
  const SkinMesh& skin = template_.wrap_template().skin;
  const Eigen::VectorXd areas = vertex_areas(skin.triangles, positions_);
  const Eigen::VectorXd mean = densities.rowwise().mean();
  std::vector<Harmonics> basis;
  std::vector<double> given;
  for (Index v = 0; v < positions_.rows(); ++v) {
    const auto row = static_cast<std::size_t>(v);
    basis.push_back(harmonics_of(row3(normals_, v)));
    given.push_back(skin.ambient_visibility[row] > kUnfoldedSkinThreshold
                        ? areas(v) * confidence[row] * hole_fade_weights_[row]
                        : 0);
  }
  Harmonics fit = Harmonics::Zero(), middle = Harmonics::Zero();
  double scale = 0;  // residual scale of the weights; 0: no reweighting (first round)
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix<double, 9, 9> matrix = 1e-9 * Eigen::Matrix<double, 9, 9>::Identity();
    Harmonics right = Harmonics::Zero();
    double total = 0, off = 0;
    middle.setZero();
    for (std::size_t v = 0; v < basis.size(); ++v) {
      if (given[v] == 0) continue;
      const double residual = mean(static_cast<Index>(v)) - basis[v].dot(fit);
      const double share = scale > 0 ? residual / scale : 0;
      const double weight = given[v] / ((1 + share * share) * (1 + share * share));
      matrix += weight * basis[v] * basis[v].transpose();
      right += weight * mean(static_cast<Index>(v)) * basis[v];
      middle += weight * basis[v];
      total += weight;
    }
    if (total == 0) break;
    middle /= total;
    fit = matrix.ldlt().solve(right);
    for (std::size_t v = 0; v < basis.size(); ++v) {
      off += given[v] * std::abs(mean(static_cast<Index>(v)) - basis[v].dot(fit));
    }
    double all = 0;
    for (const double weight : given) all += weight;
    scale = 2 * off / all;
  }
  shading_densities_.resize(positions_.rows(), 3);
  for (Index v = 0; v < positions_.rows(); ++v) {
    shading_densities_.row(v).setConstant((basis[static_cast<std::size_t>(v)] - middle).dot(fit));
  }
}

void ScanBake::compute_tone_differences(const std::vector<double>& confidence,
                                        const OpticalDensities& differences) {
  const WrapTemplate& wrap_template = template_.wrap_template();
  // If the template has a reduced skin (few vertices), compute the tone differences between scan
  // and template on the reduced skin.
  std::vector<std::uint32_t> rows(wrap_template.skin.vertices.size());
  for (std::uint32_t v = 0; v < rows.size(); ++v) rows[v] = v;
  const std::vector<std::uint32_t>& used =
      wrap_template.reduced_skin ? wrap_template.reduced_skin->mesh.vertices : rows;
  const std::vector<Triangle>& triangles = wrap_template.reduced_skin
                                               ? wrap_template.reduced_skin->mesh.triangles
                                               : wrap_template.skin.triangles;
  const auto count = static_cast<Index>(used.size());
  Positions places(count, 3);
  for (Index v = 0; v < count; ++v)
    places.row(v) = positions_.row(used[static_cast<std::size_t>(v)]);
  const Eigen::VectorXd areas = vertex_areas(triangles, places);
  DataTerms data(count);
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  double total = 0;
  for (std::uint32_t v = 0; v < used.size(); ++v) {
    const std::uint32_t row = used[v];
    const double weight = areas(v) * confidence[row] * hole_fade_weights_[row];
    if (weight == 0) continue;
    data.add(v, Eigen::Vector3d::UnitZ(), 0, weight, row3(differences, row));
    sum += weight * differences.row(row);
    total += weight;
  }
  const Eigen::RowVector3d mean = total > 0 ? Eigen::RowVector3d(sum / total) : sum;
  OpticalDensities tone = mean.replicate(count, 1);
  const SparseMatrix stiffness = -kMinToneSizeMm * kMinToneSizeMm * laplacian(triangles, places);
  ElasticSolver(stiffness, areas).solve(data, {.max_steps = 300, .tolerance = 1e-6}, tone);
  tone_differences_ = wrap_template.reduced_skin
                          ? wrap_template.reduced_skin->interpolate(tone, wrap_template.skin)
                          : tone;
}

ScanBake::Colour ScanBake::colour_of(const Texel& texel, std::size_t picture, int x, int y,
                                     std::uint32_t& guess) const {
  const SurfaceTexels::Triangle& triangle = *texel.triangle;
  const std::vector<double>& ambient_visibility = template_.wrap_template().skin.ambient_visibility;
  const auto mix = [&](const OpticalDensities& values, const std::array<double, 3>& barycentric) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < 3; ++k) sum += barycentric[k] * row3(values, texel.rows[k]);
    return sum;
  };
  const auto barycentric_at = [&](double column, double row) -> std::array<double, 3> {
    const double b = triangle.second_barycentric[0] + column * triangle.second_barycentric[1] +
                     row * triangle.second_barycentric[2];
    const double c = triangle.third_barycentric[0] + column * triangle.third_barycentric[1] +
                     row * triangle.third_barycentric[2];
    return {1 - b - c, b, c};
  };
  const std::array<double, 3> middle = barycentric_at(x, y);
  Eigen::Vector3d scan = Eigen::Vector3d::Zero();
  double trust = 0, open = 0, found = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    trust += middle[k] * hole_fade_weights_[texel.rows[k]];
    open += middle[k] * ambient_visibility[texel.rows[k]];
  }
  // Textures are filtered over the area of the texel; vertex colours are sampled at several points
  // of this area.
  const double side = std::max(texel.to_right_texel.norm(), texel.to_lower_texel.norm());
  const int samples =
      colours_.has_vertex_colours()
          ? std::clamp(static_cast<int>(std::lround(side / scan_spacing_mm_)), 1, kMaxSamples)
          : 1;
  for (int j = 0; j < samples && trust > 0; ++j) {
    for (int i = 0; i < samples; ++i) {
      const auto barycentric =
          barycentric_at(x + (i + 0.5) / samples - 0.5, y + (j + 0.5) / samples - 0.5);
      ScanPoint seen = find_scan_point(
          {mix(positions_, barycentric), mix(normals_, barycentric).normalized(), open}, guess);
      guess = seen.area.triangle;
      if (seen.confidence == 0) continue;
      seen.area.to_right_texel = texel.to_right_texel / samples;
      seen.area.to_lower_texel = texel.to_lower_texel / samples;
      const auto density = mean_optical_density(seen.area);
      if (!density) continue;
      scan += seen.confidence * *density;
      found += seen.confidence;
    }
  }
  Colour colour;
  const double share = trust * found / (samples * samples);
  if (share < 1) {
    const double width = template_.texels(picture).width(),
                 height = template_.texels(picture).height();
    colour.density = (1 - share) *
                     (mix(tone_differences_, middle) +
                      template_optical_density(picture, {(x + 0.5) / width, 1 - (y + 0.5) / height},
                                               {1 / width, 0}, {0, -1 / height}));
  }
  if (share > 0) {
    scan /= found;
    if (shading_densities_.rows() > 0) scan -= mix(shading_densities_, middle);
    colour.density += share * scan;
  }
  colour.share_without_scan = 1 - share;
  return colour;
}

BakedPicture ScanBake::bake_picture(std::size_t picture) const {
  const SurfaceTexels& texels = template_.texels(picture);
  const int width = texels.width(), height = texels.height();
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  BakedPicture result{width, height, {}, {}, 0};
  result.srgb.resize(3 * count);
  result.mask_without_scan.resize(count);
  struct Sums {
    std::array<std::uint64_t, 3> srgb = {};
    std::uint64_t filled = 0;
  };
  std::vector<Sums> sums(static_cast<std::size_t>(height));
  const std::vector<std::uint8_t>& srgb8 = srgb8_by_density();
  parallel_blocks(height, kTexelRows, [&](int begin, int end) {
    std::uint32_t guess = kNoIndex;
    for (int y = begin; y < end; ++y) {
      const std::size_t row = static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
      Sums& sum = sums[static_cast<std::size_t>(y)];
      for (const SurfaceTexels::Span& span : texels.row(y)) {
        Texel texel;
        texel.triangle = &texels.triangle(span.triangle);
        bool is_skin = true;
        for (std::size_t k = 0; k < 3; ++k) {
          texel.rows[k] = template_.skin_rows()[texels.vertices()[texel.triangle->corners[k]]];
          is_skin = is_skin && texel.rows[k] != BakeTemplate::kNotSkin;
        }
        if (is_skin) {
          const Eigen::Vector3d first = row3(positions_, texel.rows[0]);
          const Eigen::Vector3d one = row3(positions_, texel.rows[1]) - first;
          const Eigen::Vector3d other = row3(positions_, texel.rows[2]) - first;
          texel.to_right_texel = texel.triangle->second_barycentric[1] * one +
                                 texel.triangle->third_barycentric[1] * other;
          texel.to_lower_texel = texel.triangle->second_barycentric[2] * one +
                                 texel.triangle->third_barycentric[2] * other;
        }
        for (int x = span.begin; x < span.end; ++x) {
          Colour colour;
          if (is_skin) {
            colour = colour_of(texel, picture, x, y, guess);
          } else {
            colour.density =
                template_optical_density(picture, {(x + 0.5) / width, 1 - (y + 0.5) / height},
                                         {1.0 / width, 0}, {0, -1.0 / height});
          }
          const std::size_t at = row + static_cast<std::size_t>(x);
          for (Index c = 0; c < 3; ++c) {
            const double density = std::clamp(colour.density[c] + 0.5, 0.0, double{kMaxDensity});
            const std::uint8_t byte = srgb8[static_cast<std::size_t>(density)];
            result.srgb[3 * at + static_cast<std::size_t>(c)] = byte;
            sum.srgb[static_cast<std::size_t>(c)] += byte;
          }
          result.mask_without_scan[at] =
              static_cast<std::uint8_t>(std::lround(255 * colour.share_without_scan));
          sum.filled += result.mask_without_scan[at];
        }
      }
    }
  });
  Sums all;
  for (const Sums& row : sums) {
    for (std::size_t c = 0; c < 3; ++c) all.srgb[c] += row.srgb[c];
    all.filled += row.filled;
  }
  const std::uint64_t covered = std::max<std::uint64_t>(1, texels.covered_texel_count());
  std::array<std::uint8_t, 3> fill = {};
  for (std::size_t c = 0; c < 3; ++c) fill[c] = static_cast<std::uint8_t>(all.srgb[c] / covered);
  fill_uncovered(texels, std::span<const std::uint8_t>(fill), result.srgb.data());
  const std::array<std::uint8_t, 1> none = {0};
  fill_uncovered(texels, std::span<const std::uint8_t>(none), result.mask_without_scan.data());
  result.share_without_scan =
      static_cast<double>(all.filled) / (255.0 * static_cast<double>(covered));
  return result;
}

}  // namespace crowdface
