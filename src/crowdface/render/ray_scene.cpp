// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/ray_scene.h"

#include <utility>

#include <embree3/rtcore.h>

#include "crowdface/core/error.h"
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
  std::vector<float> points;
  RTCScene scene;
};

RayScene::RayScene(const RayDevice& device, std::vector<float> points,
                   const std::vector<Quad>& quads)
    : state_(std::make_unique<State>(State{std::move(points), nullptr})) {
  const RTCDevice embree = device.state().device;
  const std::size_t vertices = state_->points.size() / 3;
  state_->points.push_back(0);  // Embree reads 16 bytes at the last vertex
  RTCScene scene = rtcNewScene(embree);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);  // no pinholes along edges
  if (!quads.empty()) {
    RTCGeometry geometry = rtcNewGeometry(embree, RTC_GEOMETRY_TYPE_QUAD);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               state_->points.data(), 0, 3 * sizeof(float), vertices);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, quads.data(),
                               0, sizeof(Quad), quads.size());
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(scene);
  state_->scene = scene;
  if (const RTCError error = rtcGetDeviceError(embree); error != RTC_ERROR_NONE) {
    rtcReleaseScene(scene);
    fail("cannot build its scene", error);
  }
}
RayScene::~RayScene() {
  rtcReleaseScene(state_->scene);
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
