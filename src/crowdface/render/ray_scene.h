// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "crowdface/mesh/topology.h"
#include "crowdface/mesh/triangles.h"

namespace crowdface {

/// An Embree device, shared by any number of scenes and threads.
class RayDevice {
 public:
  RayDevice();
  ~RayDevice();
  RayDevice(const RayDevice&) = delete;
  RayDevice& operator=(const RayDevice&) = delete;
  struct State;  // the Embree device, which only ray_scene.cpp knows
  const State& state() const { return *state_; }

 private:
  std::unique_ptr<State> state_;
};

/// The points origin + t · direction with min_distance ≤ t ≤ max_distance.
struct Ray {
  Eigen::Vector3f origin;
  Eigen::Vector3f direction;   ///< need not have length 1
  float min_distance = 0;      ///< as a multiple of the length of `direction`
  float max_distance = 1e30F;  ///< as a multiple of the length of `direction`
  /// Seed in 0 … 65535 for stochastic transparency: the seed decides whether the ray passes a
  /// surface. A surface with opacity α lets the rays of a fraction 1−α of all seeds pass. The seeds
  /// of a pixel's rays are evenly spread.
  std::uint32_t opacity_seed = 0;
};

/// The point where a ray hits a quad.
struct RayHit {
  std::uint32_t primitive;  ///< index of the hit quad in the scene's list of quads
  float u, v;               ///< position on the quad, see bilinear_weights (attachment_mesh.h)
  float distance;           ///< as a multiple of the length of the ray's direction
  Eigen::Vector3f normal;   ///< geometric normal by the right-hand rule, any length
};

/// Vertices of a quad; a triangle repeats its last vertex.
using Quad = std::array<std::uint32_t, 4>;
/// Converts each triangle to one quad, which repeats the triangle's last vertex.
std::vector<Quad> quads_of(const std::vector<Triangle>& triangles);
/// Returns x, y, z of each vertex relative to `middle`. Rays are traced in single precision, and a
/// mesh may lie far from the origin.
std::vector<float> points_around(const Positions& positions, const Eigen::Vector3d& middle);

/// Opacity at a point of a primitive, from 0 (hole) to 1.
using Opacity = std::function<float(std::uint32_t primitive, float u, float v)>;

/// Quads for ray queries. Queries are thread-safe; set_points is not.
class RayScene {
 public:
  /// kStatic: a tree of high quality. kMovable: a tree that set_points can refit quickly; a ray may
  /// pass between two adjacent quads, and `nearest_hits` is not available.
  enum class Tree { kStatic, kMovable };

  /// \param points  x, y, z of each vertex; the scene keeps them.
  /// \param quads    must outlive the scene; vertex indices below points.size() / 3.
  /// \param opacity  called from any thread while the scene lives; empty: all quads are opaque.
  RayScene(const RayDevice& device, std::vector<float> points, const std::vector<Quad>& quads,
           Tree tree = Tree::kStatic, Opacity opacity = {});
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  /// Sets new positions of all vertices and refits the tree. At 1.2 million vertices, refitting
  /// takes a fifteenth of the time of building the tree. Tracing stays as fast as with the first
  /// points if the new points resemble the first points. The structure of the tree depends only on
  /// the first points, not on earlier calls.
  /// \param points  as many points as before. On return, holds the buffer of the previous points,
  ///   for reuse.
  void set_points(std::vector<float>& points);

  /// The first hit of each ray, if any. Consecutive rays are traced together, which is fast if
  /// their directions are similar. Not available with kMovable.
  std::vector<std::optional<RayHit>> nearest_hits(std::span<const Ray> rays) const;
  /// Whether each ray hits any surface.
  std::vector<bool> occluded(std::span<const Ray> rays) const;
  /// Position of a vertex.
  Eigen::Vector3f point(std::uint32_t vertex) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace crowdface
