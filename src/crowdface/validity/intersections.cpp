// SPDX-License-Identifier: Apache-2.0
#include "crowdface/validity/intersections.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <mutex>

#include <embree3/rtcore.h>

#include "crowdface/core/error.h"
#include "crowdface/core/hand_over.h"
#include "crowdface/core/text.h"

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

/// What Embree's callbacks are handed.
struct Query {
  const std::vector<Triangle>& triangles;
  const Positions& positions;
  double margin;
  const std::vector<bool>& left_out;
  std::mutex lock = {};
  std::vector<TrianglePair> found = {};
  HandOver before = {}, after = {};
};

void bounds_of(const RTCBoundsFunctionArguments* arguments) {
  auto& query = *static_cast<Query*>(arguments->geometryUserPtr);
  query.before.take();
  if (query.left_out[arguments->primID]) {  // an empty box meets no other
    constexpr float kEnd = std::numeric_limits<float>::infinity();
    *arguments->bounds_o = {kEnd, kEnd, kEnd, 0, -kEnd, -kEnd, -kEnd, 0};
    query.after.give();
    return;
  }
  const Triangle& t = query.triangles[arguments->primID];
  float low[3], high[3];
  for (int c = 0; c < 3; ++c) {
    const double a = query.positions(t[0], c), b = query.positions(t[1], c);
    const double d = query.positions(t[2], c);
    low[c] = static_cast<float>(std::min({a, b, d}) - query.margin);
    high[c] = static_cast<float>(std::max({a, b, d}) + query.margin);
    // Never smaller than the box in double precision.
    low[c] -= 1e-6F * std::abs(low[c]);
    high[c] += 1e-6F * std::abs(high[c]);
  }
  *arguments->bounds_o = {low[0], low[1], low[2], 0, high[0], high[1], high[2], 0};
  query.after.give();
}

void keep_pairs(void* user, RTCCollision* collisions, unsigned int count) {
  auto& query = *static_cast<Query*>(user);
  query.before.take();
  std::vector<TrianglePair> kept;
  for (unsigned int i = 0; i < count; ++i) {
    const std::uint32_t a = collisions[i].primID0, b = collisions[i].primID1;
    if (a >= b || share_vertex(query.triangles[a], query.triangles[b])) continue;
    kept.emplace_back(a, b);
  }
  if (!kept.empty()) {  // most are neighbours
    const std::lock_guard<std::mutex> guard(query.lock);
    query.found.insert(query.found.end(), kept.begin(), kept.end());
  }
  query.after.give();
}

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
    left_out.push_back(std::any_of(triangle.begin(), triangle.end(), [&](std::uint32_t vertex) {
      return around[vertex] > kMostAround;
    }));
  }
  return left_out;
}

}  // namespace

std::vector<TrianglePair> near_pairs(const std::vector<Triangle>& triangles,
                                     const Positions& positions, double margin) {
  if (triangles.empty()) return {};
  const std::vector<bool> left_out = around_hubs(triangles, positions.rows());
  Query query{triangles, positions, margin, left_out};
  const Device device(rtcNewDevice(nullptr));
  if (!device) throw IoError("Embree could not be started; is there too little memory?");
  const Scene scene(rtcNewScene(device.get()));
  RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned int>(triangles.size()));
  rtcSetGeometryUserData(geometry, &query);
  rtcSetGeometryBoundsFunction(geometry, bounds_of, nullptr);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  query.before.give();
  rtcCommitScene(scene.get());
  rtcCollide(scene.get(), scene.get(), keep_pairs, &query);
  query.after.take();
  if (const RTCError error = rtcGetDeviceError(device.get()); error != RTC_ERROR_NONE) {
    if (error == RTC_ERROR_OUT_OF_MEMORY) throw IoError("Embree has too little memory");
    throw Error(ExitCode::kBug, concat("Embree failed with error ", static_cast<int>(error)));
  }
  std::sort(query.found.begin(), query.found.end());
  query.found.erase(std::unique(query.found.begin(), query.found.end()), query.found.end());
  return std::move(query.found);
}

std::vector<TrianglePair> intersecting(const std::vector<Triangle>& triangles,
                                       const Positions& positions,
                                       const std::vector<TrianglePair>& pairs) {
  std::vector<TrianglePair> found;
  std::copy_if(
      pairs.begin(), pairs.end(), std::back_inserter(found), [&](const TrianglePair& pair) {
        return triangles_intersect(positions, triangles[pair.first], triangles[pair.second]);
      });
  return found;
}

NewIntersections::NewIntersections(const std::vector<Triangle>& triangles, Index vertex_count,
                                   const std::vector<TrianglePair>& target_pairs)
    : excused_(triangles.size(), false) {
  std::vector<bool> there(static_cast<std::size_t>(vertex_count), false);
  const auto mark = [&](std::uint32_t triangle) {
    for (const std::uint32_t vertex : triangles[triangle]) there[vertex] = true;
  };
  for (const auto& [a, b] : target_pairs) {
    mark(a);
    mark(b);
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    excused_[t] = std::any_of(triangles[t].begin(), triangles[t].end(),
                              [&](std::uint32_t vertex) { return there[vertex]; });
  }
}

Index NewIntersections::count(const std::vector<TrianglePair>& face_pairs) const {
  std::vector<std::uint32_t> taking_part;
  for (const auto& [a, b] : face_pairs) {
    if (excused_[a] && excused_[b]) continue;
    taking_part.push_back(a);
    taking_part.push_back(b);
  }
  std::sort(taking_part.begin(), taking_part.end());
  return std::unique(taking_part.begin(), taking_part.end()) - taking_part.begin();
}

}  // namespace crowdface
