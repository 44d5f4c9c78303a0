// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/ray_scene.h"

#include <utility>

#include <embree3/rtcore.h>

#include "crowdface/core/error.h"
#include "crowdface/core/require.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

[[noreturn]] void fail(const char* what, RTCError error) {
  throw Error(ExitCode::kBug, concat("the ray tracer ", what, ": error ", static_cast<int>(error)));
}

RTCRay to_embree(const Ray& ray) {
  RTCRay out;
  out.org_x = ray.origin.x();
  out.org_y = ray.origin.y();
  out.org_z = ray.origin.z();
  out.dir_x = ray.direction.x();
  out.dir_y = ray.direction.y();
  out.dir_z = ray.direction.z();
  out.tnear = ray.nearest;
  out.tfar = ray.furthest;
  out.time = 0;
  out.mask = ~0U;
  out.id = 0;
  out.flags = 0;
  return out;
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
  RTCScene scene = nullptr;
  RTCGeometry geometry = nullptr;  ///< none if there are no quads

  State(RTCDevice embree, std::vector<float> first) : device(embree), points(std::move(first)) {}
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

RayScene::RayScene(const RayDevice& device, std::vector<float> points,
                   const std::vector<Quad>& quads, Tree tree)
    : state_(std::make_unique<State>(device.state().device, std::move(points))) {
  State& state = *state_;
  state.points.push_back(0);  // Embree reads 16 bytes at the last vertex
  state.scene = rtcNewScene(state.device);
  const bool moves = tree == Tree::kForMoves;
  // Robust: no pinholes along edges.
  rtcSetSceneFlags(state.scene,
                   moves ? RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_DYNAMIC : RTC_SCENE_FLAG_ROBUST);
  // Embree refits a geometry's tree only in scenes of low quality, which differ from others in what
  // joins the trees of several geometries; there is one.
  if (moves) rtcSetSceneBuildQuality(state.scene, RTC_BUILD_QUALITY_LOW);
  if (!quads.empty()) {
    state.geometry = rtcNewGeometry(state.device, RTC_GEOMETRY_TYPE_QUAD);
    if (moves) rtcSetGeometryBuildQuality(state.geometry, RTC_BUILD_QUALITY_REFIT);
    rtcSetSharedGeometryBuffer(state.geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4,
                               quads.data(), 0, sizeof(Quad), quads.size());
    rtcAttachGeometry(state.scene, state.geometry);
  }
  state.commit_points();
}
RayScene::~RayScene() = default;

void RayScene::move_points(std::vector<float> points) {
  require(points.size() + 1 == state_->points.size(), "ray scene: ", points.size() / 3,
          " points in place of ", state_->points.size() / 3);
  state_->points = std::move(points);
  state_->points.push_back(0);
  state_->commit_points();
}

std::optional<RayHit> RayScene::nearest_hit(const Ray& ray) const {
  RTCRayHit query;
  query.ray = to_embree(ray);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(state_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return RayHit{query.hit.primID,
                query.hit.u,
                query.hit.v,
                query.ray.tfar,
                {query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z}};
}

bool RayScene::occluded(const Ray& ray) const {
  RTCRay query = to_embree(ray);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(state_->scene, &context, &query);
  return query.tfar < 0;
}

Eigen::Vector3f RayScene::point(std::uint32_t vertex) const {
  const float* p = state_->points.data() + std::size_t{3} * vertex;
  return {p[0], p[1], p[2]};
}

}  // namespace crowdface
