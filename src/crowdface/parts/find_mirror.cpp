// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/find_mirror.h"

#include <algorithm>
#include <cmath>
#include <compare>

#include <Eigen/Geometry>

#include "crowdface/core/parallel.h"
#include "crowdface/core/selection.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/component_shape.h"
#include "crowdface/parts/face_walk.h"
#include "crowdface/parts/find_mirror_plane.h"
#include "crowdface/parts/surface_point.h"

namespace crowdface {
namespace {

/// A coordinate plane is preferred if its error is at most this factor times the error of the best
/// plane.
constexpr double kCoordinatePlaneFactor = 1.05;
/// Largest number of seeds of a component. A seed is a vertex at which a walk over the polygons of
/// the component and of the mirrored component starts.
constexpr std::size_t kMaxMirrorSeeds = 24;
/// A walk with an error below this fraction of the component's extent is accepted without further
/// walks. On a sphere, many walks are about equally good.
constexpr double kAcceptedError = 0.01;
// Lengths are fractions of the skin's extent, about 43 cm.

// largest distance of a vertex's partner from the mirror image of the vertex, as a fraction of the
// skin's extent
constexpr double kMatchReach = 0.01;
/// A walk (see MirroredWalk) pairs the vertices of two components. Its error is the root mean
/// square distance of the pairs after mirroring. The error may be at most the larger of two limits:
/// kWalkShare of the component's extent, and kWalkReach of the skin's extent.
constexpr double kWalkShare = 0.05, kWalkReach = 0.0025;
// largest difference between the bounding boxes of two matched components, as a fraction of the
// skin's extent
constexpr double kBoxReach = 0.03;
/// Two vertices may be matched by nearness if the distance between one vertex and the mirror image
/// of the other is at most this fraction of the local edge length.
constexpr double kNearness = 0.05;

/// The upper limit for a sum is multiplied by this factor, to allow for rounding errors of the sum.
constexpr double kRoundingFactor = 1 + 1e-9;

using Vertices = std::vector<std::uint32_t>;

using Box = Eigen::AlignedBox3d;

/// Returns, for each component, the component that matches its mirror image; kNoIndex if no
/// component is within `reach` of the mirror image. First pairs components with equally many
/// vertices, the nearest pairs first, so that each layer of lashes finds its counterpart. Then
/// matches each remaining component with the component nearest to its mirror image.
/// \param reach  largest difference between the bounding boxes of the mirror image and of its match
Vertices component_partners(const Positions& mean, const std::vector<Vertices>& components,
                            const MirrorPlane& plane, double reach) {
  std::vector<Box> boxes, images;
  for (const Vertices& vertices : components) {
    boxes.push_back(bounding_box(mean, vertices));
    Box& image = images.emplace_back();
    for (const std::uint32_t v : vertices) image.extend(plane.mirrored(row3(mean, v)));
  }
  struct Pair {
    bool unlike;
    double difference;
    std::uint32_t one, other;
    auto operator<=>(const Pair&) const = default;  // NOLINT(modernize-use-nullptr)
  };
  std::vector<Pair> pairs;
  for (std::uint32_t one = 0; one < components.size(); ++one) {
    for (std::uint32_t other = 0; other < components.size(); ++other) {
      const double difference =
          std::max((boxes[other].min() - images[one].min()).cwiseAbs().maxCoeff(),
                   (boxes[other].max() - images[one].max()).cwiseAbs().maxCoeff());
      if (difference > reach) continue;
      pairs.push_back({components[one].size() != components[other].size(), difference, one, other});
    }
  }
  std::sort(pairs.begin(), pairs.end());
  Vertices partners(components.size(), kNoIndex);
  for (const Pair& pair : pairs) {
    if (partners[pair.one] != kNoIndex) continue;
    if (pair.unlike) {
      partners[pair.one] = pair.other;
    } else if (partners[pair.other] == kNoIndex) {
      partners[pair.one] = pair.other;
      partners[pair.other] = pair.one;
    }
  }
  return partners;
}

/// Finds the mirror partners of a component's vertices, on another component or on the same
/// component.
class PartnerFinder {
 public:
  PartnerFinder(const Topology& topology, const VertexFaces& around, const Positions& mean,
                const MirrorPlane& plane, double extent)
      : topology_(topology),
        vertex_faces_(around),
        mean_(mean),
        plane_(plane),
        extent_(extent),
        walk_(topology, around) {}

  /// Matches vertices by walking over the polygons of both components.
  ///
  /// \return  Nothing if the components do not match.
  std::optional<std::vector<MirroredPair>> match_by_walk(const Vertices& here,
                                                         const Vertices& there) {
    if (here.size() != there.size() || here.size() < 3) return std::nullopt;
    const PointGrid grid(mean_, there);
    struct Seed {
      double distance;
      std::uint32_t vertex, partner;
    };
    // Collect seeds: the vertices for which the distance from the mirror image to the nearest
    // vertex is smallest.
    std::vector<Seed> seeds;
    for (const std::uint32_t v : evenly_spaced_items(here, 20 * kMaxMirrorSeeds)) {
      const auto near = grid.nearest(image(v));
      seeds.push_back({near.distance, v, near.vertex});
    }
    std::ranges::stable_sort(seeds, {}, &Seed::distance);
    seeds.resize(std::min(seeds.size(), kMaxMirrorSeeds));
    const double extent = bounding_box(mean_, here).sizes().maxCoeff();
    std::optional<std::vector<MirroredPair>> best;
    double best_rms = std::max(kWalkShare * extent, kWalkReach * extent_);
    for (const Seed& seed : seeds) {
      // Start a walk at each polygon edge that begins at the seed.
      for (const std::uint32_t f : vertex_faces_.items_of(seed.vertex)) {
        const auto face = topology_.face(f);
        const auto corner = std::ranges::find(face, seed.vertex);
        const std::uint32_t to = corner + 1 == face.end() ? face.front() : *(corner + 1);
        const std::uint32_t partner_of_to = grid.nearest(image(to)).vertex;
        // The walk ends as soon as the sum of its squared distances shows that an earlier walk is
        // better.
        const double most =
            kRoundingFactor * best_rms * best_rms * static_cast<double>(here.size());
        double squares = 0;
        auto pairs = walk_.walk_from(
            {seed.vertex, to}, {partner_of_to, seed.partner}, [&](const MirroredPair& pair) {
              const Eigen::Vector3d off = image(pair.vertex) - row3(mean_, pair.partner);
              squares += off.squaredNorm();
              return squares <= most;
            });
        if (!pairs || pairs->size() != here.size()) continue;
        const double rms = std::sqrt(squares / static_cast<double>(here.size()));
        if (rms > best_rms) continue;
        best_rms = rms;
        best = std::move(pairs);
        if (rms <= kAcceptedError * extent) return best;
      }
    }
    return best;
  }

  /// Matches each vertex of `here` separately with the point of `there` that is nearest to the
  /// vertex's mirror image.
  void match_by_nearness(const Vertices& here, const Vertices& there, FoundMirror& found) const {
    const PointGrid grid_there(mean_, there), grid_here(mean_, here);
    const double reach = kMatchReach * extent_;
    std::vector<double> distances(here.size());
    parallel_for_each(here.size(), [&](std::size_t i) {
      const std::uint32_t v = here[i];
      const Eigen::Vector3d point = image(v);
      const auto near = grid_there.nearest(point);
      const bool agreed = near.distance <= kNearness * edge_length(near.vertex) &&
                          grid_here.nearest(image(near.vertex)).vertex == v;
      if (agreed || vertex_faces_.items_of(near.vertex).empty()) {
        set_partner(found.map, v, near.vertex);
        distances[i] = near.distance;
        return;
      }
      const SurfacePoint place =
          nearest_point_from(topology_, vertex_faces_, mean_, near.vertex, point);
      found.map.corners[v] = place.corners;
      found.map.barycentric[v] = place.barycentric;
      if (place.barycentric[0] == 1) mark_unpaired(found.map, v);
      distances[i] = place.distance;
    });
    for (std::size_t i = 0; i < here.size(); ++i) {
      if (distances[i] > reach) found.map.unpaired_vertices.push_back(here[i]);
    }
  }

  static void set_partner(MirrorMap& map, std::uint32_t vertex, std::uint32_t partner) {
    map.corners[vertex] = {partner, partner, partner};
    map.barycentric[vertex] = {1, 0, 0};
  }
  /// Marks a vertex as having no mutual partner: the stored mirror point does not change, but
  /// MirrorMap::has_mirror_vertex becomes false.
  static void mark_unpaired(MirrorMap& map, std::uint32_t vertex) {
    std::swap(map.corners[vertex][0], map.corners[vertex][1]);
    map.barycentric[vertex] = {0, 1, 0};
  }

 private:
  Eigen::Vector3d image(std::uint32_t vertex) const { return plane_.mirrored(row3(mean_, vertex)); }

  double edge_length(std::uint32_t vertex) const {
    double sum = 0, count = 0;
    for (const std::uint32_t f : vertex_faces_.items_of(vertex)) {
      const auto face = topology_.face(f);
      for (std::size_t c = 0; c < face.size(); ++c) {
        sum += (row3(mean_, face[c]) - row3(mean_, face[(c + 1) % face.size()])).norm();
        ++count;
      }
    }
    return count > 0 ? sum / count : 0;
  }

  const Topology& topology_;
  const VertexFaces& vertex_faces_;
  const Positions& mean_;
  const MirrorPlane& plane_;
  double extent_;
  MirroredWalk walk_;
};

/// Returns the mean square distance of the mean head from its mirror image.
double mean_square_distance(const MirrorMap& map, const Positions& mean,
                            double* largest = nullptr) {
  const Positions image = mirrored(map, mean);
  double squares = 0, most = 0;
  for (Index v = 0; v < mean.rows(); ++v) {
    const Eigen::Vector3d off = row3(image, v) - row3(mean, v);
    squares += off.squaredNorm();
    most = std::max(most, off.norm());
  }
  if (largest != nullptr) *largest = most;
  return squares / static_cast<double>(mean.rows());
}

/// Returns the mirror plane that the pairs of partners determine. If the coordinate plane
/// perpendicular to the side axis (such as x = 0) fits nearly as well, returns the coordinate
/// plane.
MirrorPlane plane_of_partners(MirrorMap map, const Vertices& skin, const Positions& mean,
                              const Eigen::Vector3d& side) {
  PlaneFit fit;
  for (const std::uint32_t v : skin) {
    if (map.has_mirror_vertex(v)) fit.add(row3(mean, v), row3(mean, map.corners[v][0]));
  }
  if (fit.pair_count() * 2 >= skin.size()) map.plane = fit.plane(side);
  const double best = mean_square_distance(map, mean);
  const MirrorPlane fitted = map.plane;
  Index axis = 0;
  side.cwiseAbs().maxCoeff(&axis);
  map.plane = {Eigen::Vector3d::Unit(axis), 0};
  const bool as_good = std::sqrt(mean_square_distance(map, mean)) <=
                       kCoordinatePlaneFactor * std::sqrt(best) + 1e-12;
  return as_good ? map.plane : fitted;
}

/// Computes the offsets of the vertices without partner, so that mirroring nearly keeps the shape
/// of the mean head at these vertices. Mirroring alone would move such a vertex of the mean head by
/// a distance d. The offset moves the vertex back by d − `reach`; if d < `reach`, the offset is
/// zero. \param reach  a distance; the offsets decrease to zero at this distance, so that the surface
/// has no step between vertices with and without partner.
void set_unpaired_offsets(const Positions& mean, double reach, MirrorMap& map) {
  const Positions image = mirrored(map, mean);
  map.unpaired_offsets.resize(static_cast<Index>(map.unpaired_vertices.size()), 3);
  for (std::size_t i = 0; i < map.unpaired_vertices.size(); ++i) {
    const auto v = static_cast<Index>(map.unpaired_vertices[i]);
    const Eigen::Vector3d off = row3(mean, v) - row3(image, v);
    const double length = off.norm();
    const double share = length > reach ? 1 - reach / length : 0;
    map.unpaired_offsets.row(static_cast<Index>(i)) = (share * off).transpose();
  }
}

}  // namespace

double FoundMirror::partner_fraction() const {
  return static_cast<double>(paired_vertex_count + surface_mirrored_vertex_count) /
         static_cast<double>(map.corners.size());
}

FoundMirror find_mirror(const Topology& topology, const Components& components,
                        const Positions& mean, const Eigen::Vector3d& side) {
  const std::vector<Vertices> of_component = vertices_of_components(components);
  const Vertices& skin = of_component[components.largest()];
  FoundMirror found;
  MirrorMap& map = found.map;
  const VertexFaces around(topology);
  map.corners.resize(components.component_of_vertex.size());
  map.barycentric.resize(components.component_of_vertex.size());
  const Box box = bounding_box(mean, skin);
  const double extent = box.sizes().maxCoeff();
  // Find the mirror plane of the skin.
  map.plane = find_mirror_plane(topology, around, mean, skin,
                                {side, side.dot(0.5 * (box.min() + box.max()))});
  {
    PartnerFinder finder(topology, around, mean, map.plane, extent);
    // Match components, then the vertices of each pair of components.
    const Vertices partners = component_partners(mean, of_component, map.plane, kBoxReach * extent);
    for (std::size_t c = 0; c < of_component.size(); ++c) {
      const Vertices& here = of_component[c];
      if (partners[c] == kNoIndex) {
        for (const std::uint32_t v : here) PartnerFinder::set_partner(map, v, v);
        map.unpaired_vertices.insert(map.unpaired_vertices.end(), here.begin(), here.end());
        continue;
      }
      const Vertices& there = of_component[partners[c]];
      if (const auto pairs = finder.match_by_walk(here, there)) {
        for (const auto [vertex, partner] : *pairs)
          PartnerFinder::set_partner(map, vertex, partner);
      } else {
        finder.match_by_nearness(here, there, found);
      }
    }
  }
  for (std::uint32_t v = 0; v < map.corners.size(); ++v) {
    // Keep only mutual partners.
    const std::uint32_t partner = map.corners[v][0];
    const bool agreed = map.has_mirror_vertex(partner) && map.corners[partner][0] == v;
    if (map.has_mirror_vertex(v) && !agreed) PartnerFinder::mark_unpaired(map, v);
  }
  std::ranges::sort(map.unpaired_vertices);
  map.unpaired_offsets.setZero(static_cast<Index>(map.unpaired_vertices.size()), 3);
  // Improve the plane with the pairs of partners.
  map.plane = plane_of_partners(map, skin, mean, side);
  set_unpaired_offsets(mean, kMatchReach * extent, map);
  found.rms_distance = std::sqrt(mean_square_distance(map, mean, &found.max_distance));
  for (std::uint32_t v = 0; v < map.corners.size(); ++v) {
    if (std::ranges::binary_search(map.unpaired_vertices, v)) continue;
    ++(map.has_mirror_vertex(v) ? found.paired_vertex_count : found.surface_mirrored_vertex_count);
  }
  return found;
}

}  // namespace crowdface
