// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/ray_scene.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/require.h"
#include "crowdface/core/text.h"

// CMake sets CROWDFACE_EMBREE to the major version found: Embree 3 (Debian 12) or Embree 4
// (Debian 13, Ubuntu 24.04, Fedora).
#if CROWDFACE_EMBREE == 4
#include <embree4/rtcore.h>
#elif CROWDFACE_EMBREE == 3
#include <embree3/rtcore.h>
#else
#error "crowdface works with Embree 3 and Embree 4"
#endif

namespace crowdface {
namespace {

[[noreturn]] void fail(const char* what, RTCError error) {
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw IoError("the ray tracer has too little memory");
  throw Error(ExitCode::kBug, concat("the ray tracer ", what, ": error ", static_cast<int>(error)));
}

/// Number of rays in a packet. Packets of 16 rays are not faster, even with AVX-512.
constexpr std::size_t kPacketRays = 8;

/// Finds the first hit of each ray of a packet. The rays of a packet have similar directions.
/// \param valid  -1 for lanes with a ray, 0 for other lanes; aligned to 64 bytes.
/// \param query  rays with empty hits; the function writes the distances and hits.
void intersect(const int* valid, RTCScene scene, RTCRayHit8& query) {
#if CROWDFACE_EMBREE == 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcIntersect8(valid, scene, &query, &arguments);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect8(valid, scene, &context, &query);
#endif
}

/// Finds out which rays are blocked: sets `tfar` of each ray that hits a surface to -infinity.
void find_blocked_rays(const int* valid, RTCScene scene, RTCRay8& rays) {
#if CROWDFACE_EMBREE == 4
  rtcOccluded8(valid, scene, &rays, nullptr);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded8(valid, scene, &context, &rays);
#endif
}

/// Copies rays to an Embree packet.
/// \param valid  result: -1 for lanes with a ray, 0 for other lanes.
void fill(std::span<const Ray> rays, RTCRay8& packet, std::array<int, kPacketRays>& valid) {
  valid.fill(0);
  // Without native support for this packet width, Embree reads all lanes. So fill unused lanes with
  // valid numbers and an empty interval.
  packet = {};
  std::fill_n(packet.tnear, kPacketRays, std::numeric_limits<float>::infinity());
  std::fill_n(packet.tfar, kPacketRays, -std::numeric_limits<float>::infinity());
  for (std::size_t r = 0; r < rays.size(); ++r) {
    const Ray& ray = rays[r];
    valid[r] = -1;
    packet.org_x[r] = ray.origin.x();
    packet.org_y[r] = ray.origin.y();
    packet.org_z[r] = ray.origin.z();
    packet.dir_x[r] = ray.direction.x();
    packet.dir_y[r] = ray.direction.y();
    packet.dir_z[r] = ray.direction.z();
    packet.tnear[r] = ray.min_distance;
    packet.tfar[r] = ray.max_distance;
    packet.time[r] = 0;
    packet.mask[r] = ~0U;
    packet.id[r] = ray.opacity_seed;
    packet.flags[r] = 0;
  }
}

/// Splits each quad into two triangles as Embree does; quads that are triangles stay whole.
std::vector<Triangle> split(const std::vector<Quad>& quads) {
  std::vector<Triangle> triangles;
  triangles.reserve(2 * quads.size());
  for (const Quad& quad : quads) {
    triangles.push_back({quad[0], quad[1], quad[3]});
    if (quad[2] != quad[3]) triangles.push_back({quad[2], quad[3], quad[1]});
  }
  return triangles;
}

/// Embree filter for stochastic transparency (see Ray::opacity_seed): rejects a hit with
/// probability 1 − opacity. Hashing the primitive's index makes surfaces behind each other reject
/// different rays.
void reject_transparent_hits(const RTCFilterFunctionNArguments* met) {
  const Opacity& opacity = *static_cast<const Opacity*>(met->geometryUserPtr);
  for (unsigned int i = 0; i < met->N; ++i) {
    if (met->valid[i] != -1) continue;
    const std::uint32_t primitive = RTCHitN_primID(met->hit, met->N, i);
    const float there =
        opacity(primitive, RTCHitN_u(met->hit, met->N, i), RTCHitN_v(met->hit, met->N, i));
    const std::uint32_t opacity_seed =
        (RTCRayN_id(met->ray, met->N, i) + primitive * 40503U) & 0xffffU;
    if ((static_cast<float>(opacity_seed) + 0.5F) / 65536.0F >= there) met->valid[i] = 0;
  }
}

/// Splits rays into packets of kPacketRays consecutive rays; the last packet may be smaller. Calls
/// `body(first, packet)` for each packet, where `first` is the index of the packet's first ray.
template <class Body>
void for_each_packet(std::span<const Ray> rays, const Body& body) {
  for (std::size_t first = 0; first < rays.size(); first += kPacketRays) {
    body(first, rays.subspan(first, std::min(kPacketRays, rays.size() - first)));
  }
}

}  // namespace

struct RayDevice::State {
  RTCDevice device;
};

RayDevice::RayDevice() : state_(std::make_unique<State>(State{rtcNewDevice(nullptr)})) {
  if (state_->device == nullptr) fail("does not start", rtcGetDeviceError(nullptr));
}
RayDevice::~RayDevice() {
  rtcReleaseDevice(state_->device);
}

struct RayScene::State {
  RTCDevice device;
  std::vector<float> points;
  std::vector<Triangle> triangles;  ///< triangles of the split quads; used only with kMovable
  RTCScene scene = nullptr;
  RTCGeometry geometry = nullptr;  ///< the quads, as Embree's geometry; null if there are no quads
  Opacity opacity;  ///< opacity at each point of the quads; empty: all quads are opaque

  State(const RayDevice::State& embree, std::vector<float> first)
      : device(embree.device), points(std::move(first)) {}
  ~State() {
    if (geometry != nullptr) rtcReleaseGeometry(geometry);
    if (scene != nullptr) rtcReleaseScene(scene);
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void commit_points() {
    if (geometry != nullptr) {
      rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                 points.data(), 0, 3 * sizeof(float), points.size() / 3);
      rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0);
      rtcCommitGeometry(geometry);
    }
    rtcCommitScene(scene);
    const RTCError error = rtcGetDeviceError(device);
    if (error != RTC_ERROR_NONE) fail("cannot build its scene", error);
  }
};

std::vector<Quad> quads_of(const std::vector<Triangle>& triangles) {
  std::vector<Quad> quads;
  quads.reserve(triangles.size());
  for (const Triangle& t : triangles) quads.push_back({t[0], t[1], t[2], t[2]});
  return quads;
}

std::vector<float> points_around(const Positions& positions, const Eigen::Vector3d& middle) {
  std::vector<float> points;
  points.reserve(static_cast<std::size_t>(positions.size()));
  for (Index v = 0; v < positions.rows(); ++v) {
    for (int c = 0; c < 3; ++c) points.push_back(static_cast<float>(positions(v, c) - middle[c]));
  }
  return points;
}

RayScene::RayScene(const RayDevice& device, std::vector<float> points,
                   const std::vector<Quad>& quads, Tree tree, Opacity opacity)
    : state_(std::make_unique<State>(device.state(), std::move(points))) {
  State& state = *state_;
  state.points.push_back(0);  // Embree reads 16 bytes at the last vertex
  state.scene = rtcNewScene(state.device);
  const bool moves = tree == Tree::kMovable;
  // Robust mode avoids gaps along edges, but takes longer. Do not use robust mode where gaps are
  // not visible: in scenes with kMovable, which are used only for shadows, and between partly
  // transparent quads.
  rtcSetSceneFlags(state.scene, moves     ? RTC_SCENE_FLAG_DYNAMIC
                                : opacity ? RTC_SCENE_FLAG_NONE
                                          : RTC_SCENE_FLAG_ROBUST);
  // Embree refits trees only in scenes of low build quality. The scene's quality affects only how
  // the trees of several geometries are joined, and this scene has one geometry.
  if (moves) rtcSetSceneBuildQuality(state.scene, RTC_BUILD_QUALITY_LOW);
  if (!quads.empty()) {
    state.geometry =
        rtcNewGeometry(state.device, moves ? RTC_GEOMETRY_TYPE_TRIANGLE : RTC_GEOMETRY_TYPE_QUAD);
    if (moves) {
      // Work around a bug of Embree 4.3: after refitting a tree of quads, rays miss the quads.
      // Trees of triangles are not affected.
      state.triangles = split(quads);
      rtcSetGeometryBuildQuality(state.geometry, RTC_BUILD_QUALITY_REFIT);
      rtcSetSharedGeometryBuffer(state.geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                 state.triangles.data(), 0, sizeof(Triangle),
                                 state.triangles.size());
    } else {
      rtcSetSharedGeometryBuffer(state.geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4,
                                 quads.data(), 0, sizeof(Quad), quads.size());
    }
    if (opacity) {
      state.opacity = std::move(opacity);
      rtcSetGeometryUserData(state.geometry, &state.opacity);
      rtcSetGeometryIntersectFilterFunction(state.geometry, reject_transparent_hits);
      rtcSetGeometryOccludedFilterFunction(state.geometry, reject_transparent_hits);
    }
    rtcAttachGeometry(state.scene, state.geometry);
  }
  state.commit_points();
}

RayScene::~RayScene() = default;

void RayScene::set_points(std::vector<float>& points) {
  require(points.size() + 1 == state_->points.size(), "ray scene: ", points.size() / 3,
          " points in place of ", state_->points.size() / 3);
  state_->points.swap(points);
  state_->points.push_back(0);
  state_->commit_points();
}

std::vector<std::optional<RayHit>> RayScene::nearest_hits(std::span<const Ray> rays) const {
  require(state_->triangles.empty(),
          "ray scene: nearest_hits is not available with Tree::kMovable");
  std::vector<std::optional<RayHit>> hits(rays.size());
  for_each_packet(rays, [&](std::size_t first, std::span<const Ray> some) {
    alignas(64) std::array<int, kPacketRays> valid;
    RTCRayHit8 query;
    fill(some, query.ray, valid);
    std::fill_n(query.hit.geomID, kPacketRays, RTC_INVALID_GEOMETRY_ID);
    std::fill_n(query.hit.instID[0], kPacketRays, RTC_INVALID_GEOMETRY_ID);
    intersect(valid.data(), state_->scene, query);
    for (std::size_t r = 0; r < some.size(); ++r) {
      const auto& hit = query.hit;
      if (hit.geomID[r] == RTC_INVALID_GEOMETRY_ID) continue;
      hits[first + r] = RayHit{hit.primID[r],
                               hit.u[r],
                               hit.v[r],
                               query.ray.tfar[r],
                               {hit.Ng_x[r], hit.Ng_y[r], hit.Ng_z[r]}};
    }
  });
  return hits;
}

std::vector<bool> RayScene::occluded(std::span<const Ray> rays) const {
  std::vector<bool> blocked(rays.size());
  for_each_packet(rays, [&](std::size_t first, std::span<const Ray> some) {
    alignas(64) std::array<int, kPacketRays> valid;
    RTCRay8 query;
    fill(some, query, valid);
    find_blocked_rays(valid.data(), state_->scene, query);
    for (std::size_t r = 0; r < some.size(); ++r) blocked[first + r] = query.tfar[r] < 0;
  });
  return blocked;
}

Eigen::Vector3f RayScene::point(std::uint32_t vertex) const {
  return Eigen::Map<const Eigen::Vector3f>(state_->points.data() + std::size_t{3} * vertex);
}

}  // namespace crowdface
