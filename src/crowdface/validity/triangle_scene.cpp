// SPDX-License-Identifier: Apache-2.0
#include "crowdface/validity/triangle_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include <embree3/rtcore.h>

#include "crowdface/core/error.h"
#include "crowdface/core/hand_over.h"
#include "crowdface/core/text.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/validity/triangles.h"

namespace crowdface {
namespace {

struct DeviceRelease {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, DeviceRelease>;
using Scene = std::unique_ptr<std::remove_pointer_t<RTCScene>, SceneRelease>;

/// Triangles at a vertex of very many: all their boxes overlap, and of 60,000 the pairs took a minute and a
/// half for each face.
std::vector<bool> around_hubs(const std::vector<Triangle>& triangles, Index vertex_count) {
  constexpr std::uint32_t kMostAround = 1000;
  std::vector<std::uint32_t> around(static_cast<std::size_t>(vertex_count), 0);
  for (const Triangle& triangle : triangles) {
    for (const std::uint32_t vertex : triangle) ++around[vertex];
  }
  std::vector<bool> left_out;
  for (const Triangle& triangle : triangles) {
    left_out.push_back(std::ranges::any_of(
        triangle, [&](std::uint32_t vertex) { return around[vertex] > kMostAround; }));
  }
  return left_out;
}

/// What the callbacks are handed that Embree calls while it builds and asks the tree.
struct Geometry {
  const std::vector<Triangle>& triangles;
  const Positions& positions;
  double margin;
  std::vector<bool> left_out;
  HandOver before = {}, after = {};
};

void bounds_of(const RTCBoundsFunctionArguments* arguments) {
  auto& geometry = *static_cast<Geometry*>(arguments->geometryUserPtr);
  geometry.before.take();
  if (geometry.left_out[arguments->primID]) {  // an empty box meets no other
    constexpr float kEnd = std::numeric_limits<float>::infinity();
    *arguments->bounds_o = {kEnd, kEnd, kEnd, 0, -kEnd, -kEnd, -kEnd, 0};
    geometry.after.give();
    return;
  }
  const Triangle& t = geometry.triangles[arguments->primID];
  float low[3], high[3];
  for (int c = 0; c < 3; ++c) {
    const double a = geometry.positions(t[0], c), b = geometry.positions(t[1], c);
    const double d = geometry.positions(t[2], c);
    low[c] = static_cast<float>(std::min({a, b, d}) - geometry.margin);
    high[c] = static_cast<float>(std::max({a, b, d}) + geometry.margin);
    // Never smaller than the box in double precision.
    low[c] -= 1e-6F * std::abs(low[c]);
    high[c] += 1e-6F * std::abs(high[c]);
  }
  *arguments->bounds_o = {low[0], low[1], low[2], 0, high[0], high[1], high[2], 0};
  geometry.after.give();
}

/// Pairs as they are found, by several threads.
struct Collector {
  Geometry& geometry;
  std::mutex lock = {};
  std::vector<TrianglePair> found = {};
};

void keep_pairs(void* user, RTCCollision* collisions, unsigned int count) {
  auto& collector = *static_cast<Collector*>(user);
  collector.geometry.before.take();
  std::vector<TrianglePair> kept;
  for (unsigned int i = 0; i < count; ++i) {
    const std::uint32_t a = collisions[i].primID0, b = collisions[i].primID1;
    const auto& triangles = collector.geometry.triangles;
    if (a >= b || share_vertex(triangles[a], triangles[b])) continue;
    kept.emplace_back(a, b);
  }
  if (!kept.empty()) {  // most are neighbours
    const std::lock_guard<std::mutex> guard(collector.lock);
    collector.found.insert(collector.found.end(), kept.begin(), kept.end());
  }
  collector.geometry.after.give();
}

/// A ray in double precision behind Embree's own.
struct RayContext {
  RTCIntersectContext embree;
  const Eigen::Vector3d& origin;
  const Eigen::Vector3d& direction;
  std::uint32_t start;
};

/// Möller & Trumbore 1997, "Fast, minimum storage ray/triangle intersection".
bool meets_triangle(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                    const Positions& positions, const Triangle& triangle) {
  const Eigen::Vector3d a = row3(positions, triangle[0]);
  const Eigen::Vector3d ab = row3(positions, triangle[1]) - a;
  const Eigen::Vector3d ac = row3(positions, triangle[2]) - a;
  const Eigen::Vector3d p = cross3(direction, ac);
  const double determinant = dot3(ab, p);
  if (determinant == 0) return false;
  const Eigen::Vector3d from_a = origin - a;
  const double u = dot3(from_a, p) / determinant;
  if (u < 0 || u > 1) return false;
  const Eigen::Vector3d q = cross3(from_a, ab);
  const double v = dot3(direction, q) / determinant;
  return v >= 0 && u + v <= 1 && dot3(ac, q) / determinant > 0;
}

void test_ray(const RTCOccludedFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  const auto& geometry = *static_cast<const Geometry*>(arguments->geometryUserPtr);
  const auto& context = *reinterpret_cast<const RayContext*>(arguments->context);
  if (arguments->primID == context.start) return;
  if (meets_triangle(context.origin, context.direction, geometry.positions,
                     geometry.triangles[arguments->primID])) {
    RTCRayN_tfar(arguments->ray, 1, 0) = -std::numeric_limits<float>::infinity();
  }
}

}  // namespace

struct TriangleScene::Embree {
  Geometry geometry;
  Device device;
  Scene scene;

  void throw_if_failed() const {
    const RTCError error = rtcGetDeviceError(device.get());
    if (error == RTC_ERROR_NONE) return;
    if (error == RTC_ERROR_OUT_OF_MEMORY) throw IoError("Embree has too little memory");
    throw Error(ExitCode::kBug, concat("Embree failed with error ", static_cast<int>(error)));
  }
};

TriangleScene::TriangleScene(const std::vector<Triangle>& triangles, const Positions& positions,
                             double margin)
    : embree_(std::make_unique<Embree>(
          Embree{{triangles, positions, margin, around_hubs(triangles, positions.rows())},
                 Device(rtcNewDevice(nullptr)),
                 nullptr})) {
  if (!embree_->device) {
    throw IoError("Embree could not be started; is there too little memory?");
  }
  embree_->scene.reset(rtcNewScene(embree_->device.get()));
  rtcSetSceneFlags(embree_->scene.get(), RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(embree_->device.get(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned int>(triangles.size()));
  rtcSetGeometryUserData(geometry, &embree_->geometry);
  rtcSetGeometryBoundsFunction(geometry, bounds_of, nullptr);
  rtcSetGeometryOccludedFunction(geometry, test_ray);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(embree_->scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  embree_->geometry.before.give();
  rtcCommitScene(embree_->scene.get());
  embree_->geometry.after.take();
  embree_->throw_if_failed();
}

TriangleScene::~TriangleScene() = default;

std::vector<TrianglePair> TriangleScene::near_pairs() const {
  Collector collector{embree_->geometry};
  embree_->geometry.before.give();
  rtcCollide(embree_->scene.get(), embree_->scene.get(), keep_pairs, &collector);
  embree_->geometry.after.take();
  embree_->throw_if_failed();
  std::ranges::sort(collector.found);
  collector.found.erase(std::unique(collector.found.begin(), collector.found.end()),
                        collector.found.end());
  return std::move(collector.found);
}

bool TriangleScene::meets(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                          std::uint32_t start) const {
  RayContext context{{}, origin, direction, start};
  rtcInitIntersectContext(&context.embree);
  RTCRay ray{};
  ray.org_x = static_cast<float>(origin.x());
  ray.org_y = static_cast<float>(origin.y());
  ray.org_z = static_cast<float>(origin.z());
  ray.dir_x = static_cast<float>(direction.x());
  ray.dir_y = static_cast<float>(direction.y());
  ray.dir_z = static_cast<float>(direction.z());
  ray.tfar = std::numeric_limits<float>::infinity();
  ray.mask = ~0U;
  rtcOccluded1(embree_->scene.get(), &context.embree, &ray);
  return ray.tfar < 0;
}

}  // namespace crowdface
