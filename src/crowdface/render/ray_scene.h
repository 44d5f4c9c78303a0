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

namespace crowdface {

/// The ray tracer (Embree), started once and shared by any number of scenes and threads.
class RayDevice {
 public:
  RayDevice();
  ~RayDevice();
  RayDevice(const RayDevice&) = delete;
  RayDevice& operator=(const RayDevice&) = delete;
  struct State;
  const State& state() const { return *state_; }

 private:
  std::unique_ptr<State> state_;
};

struct Ray {
  Eigen::Vector3f origin;
  Eigen::Vector3f direction;
  float nearest = 0;
  float furthest = 1e30F;
  /// Its place among the rays of a pixel, from 0 to 65535: what is there in part lets pass so many of
  /// them, always the same.
  std::uint32_t lot = 0;
};

struct RayHit {
  std::uint32_t primitive;  ///< row of the scene's quads
  float u, v;               ///< over a quad bilinear, over a triangle barycentric
  float distance;           ///< in lengths of the ray's direction
  Eigen::Vector3f normal;   ///< of the surface, outward by winding, not of unit length
};

/// Four vertices a primitive; a triangle names its last vertex twice.
using Quad = std::array<std::uint32_t, 4>;

/// How much of a primitive there is at a point of it: 0 a hole, 1 all.
using Opacity = std::function<float(std::uint32_t primitive, float u, float v)>;

/// Quads that rays can be shot at, from any thread.
class RayScene {
 public:
  /// How the tree over the quads is built: well, or so that move_points is quick. Then a ray may slip between quads, and
  /// only `occluded` answers.
  enum class Tree { kForOnce, kForMoves };

  /// \param points  x, y, z of each vertex. Kept by the scene.
  /// \param quads   must outlive the scene; every entry < points.size() / 3.
  RayScene(const RayDevice& device, std::vector<float> points, const std::vector<Quad>& quads,
           Tree tree = Tree::kForOnce);
  /// Quads with holes. \param opacity  asked by any thread, for as long as the scene lives.
  RayScene(const RayDevice& device, std::vector<float> points, const std::vector<Quad>& quads,
           Opacity opacity);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  /// Puts the vertices elsewhere and keeps the tree, in which only sizes change: at 1.2 million
  /// vertices a fifteenth of the time of building it, and rays are as quick if the new points lie
  /// about as the first did. The tree is that of the first points whatever came between.
  /// \param points  as many as before; gets the memory of those before.
  void move_points(std::vector<float>& points);

  /// What each ray meets first, if anything. Rays that stand beside each other in the list are traced together,
  /// which is quick if they run alike.
  std::vector<std::optional<RayHit>> nearest_hits(std::span<const Ray> rays) const;
  /// Whether each ray meets anything.
  std::vector<bool> occluded(std::span<const Ray> rays) const;
  Eigen::Vector3f point(std::uint32_t vertex) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace crowdface
