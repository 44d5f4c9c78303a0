// SPDX-License-Identifier: Apache-2.0
#pragma once

// One interface for Embree 3 (Debian 12) and Embree 4 (Debian 13, Ubuntu 24.04, Fedora). CMake sets
// CROWDFACE_EMBREE to the major version found.
#if CROWDFACE_EMBREE == 4
#include <embree4/rtcore.h>
#elif CROWDFACE_EMBREE == 3
#include <embree3/rtcore.h>
#else
#error "crowdface works with Embree 3 and Embree 4"
#endif

namespace crowdface::embree {

/// kCoherent: the rays of a packet have similar directions, so that Embree can trace them faster.
enum class RayCoherence { kIncoherent, kCoherent };

#if CROWDFACE_EMBREE == 4

/// The default arguments of rtcIntersect, with the flag for coherent rays if `coherence` says so.
inline RTCIntersectArguments intersect_arguments(RayCoherence coherence) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  if (coherence == RayCoherence::kCoherent) arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  return arguments;
}

/// Finds the first hit of each ray of a packet.
/// \param valid  -1 for lanes with a ray, 0 for other lanes; aligned to 64 bytes.
/// \param query  Rays with empty hits; the function writes the distances and hits.
inline void intersect(const int* valid, RTCScene scene, RayCoherence coherence, RTCRayHit8& query) {
  RTCIntersectArguments arguments = intersect_arguments(coherence);
  rtcIntersect8(valid, scene, &query, &arguments);
}
/// Finds the first hit of each ray of a packet of 16 rays.
inline void intersect(const int* valid, RTCScene scene, RayCoherence coherence,
                      RTCRayHit16& query) {
  RTCIntersectArguments arguments = intersect_arguments(coherence);
  rtcIntersect16(valid, scene, &query, &arguments);
}

/// Finds out which rays are blocked: sets `tfar` of each ray that hits a surface to -infinity.
inline void occluded(const int* valid, RTCScene scene, RTCRay8& rays) {
  rtcOccluded8(valid, scene, &rays, nullptr);
}
/// Sets `tfar` of each ray that hits a surface to -infinity, for a packet of 16 rays.
inline void occluded(const int* valid, RTCScene scene, RTCRay16& rays) {
  rtcOccluded16(valid, scene, &rays, nullptr);
}

#else

/// The default context of rtcIntersect, with the flag for coherent rays if `coherence` says so.
inline RTCIntersectContext intersect_context(RayCoherence coherence) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  if (coherence == RayCoherence::kCoherent) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

// See the functions of the same names for Embree 4, above.
inline void intersect(const int* valid, RTCScene scene, RayCoherence coherence, RTCRayHit8& query) {
  RTCIntersectContext context = intersect_context(coherence);
  rtcIntersect8(valid, scene, &context, &query);
}
inline void intersect(const int* valid, RTCScene scene, RayCoherence coherence,
                      RTCRayHit16& query) {
  RTCIntersectContext context = intersect_context(coherence);
  rtcIntersect16(valid, scene, &context, &query);
}

inline void occluded(const int* valid, RTCScene scene, RTCRay8& rays) {
  RTCIntersectContext context = intersect_context(RayCoherence::kIncoherent);
  rtcOccluded8(valid, scene, &context, &rays);
}
inline void occluded(const int* valid, RTCScene scene, RTCRay16& rays) {
  RTCIntersectContext context = intersect_context(RayCoherence::kIncoherent);
  rtcOccluded16(valid, scene, &context, &rays);
}

#endif

}  // namespace crowdface::embree
