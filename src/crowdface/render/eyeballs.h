// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "crowdface/mesh/topology.h"
#include "crowdface/render/shading.h"
#include "crowdface/render/surface_kind.h"

namespace crowdface {

/// The eyeballs of a mesh: connected components of the polygons of kind kEye. On eyeballs without a
/// texture, the renderer paints an iris that looks straight ahead.
struct Eyeballs {
  static constexpr std::uint32_t kNone = 0xffffffffU;  ///< value in eyeball_of_vertex: no eyeball
  /// for each vertex: index of the eyeball that the vertex belongs to, or kNone; empty if there are
  /// no eyeballs
  std::vector<std::uint32_t> eyeball_of_vertex;
  std::uint32_t count = 0;  ///< number of eyeballs
};

/// Finds the eyeballs of a mesh. \param kinds  the kind of each polygon; or empty.
Eyeballs find_eyeballs(const Topology& topology, const std::vector<SurfaceKind>& kinds);

/// radius of the pupil (in dim light), as a fraction of the eyeball's radius
inline constexpr float kPupilRadius = 0.17F;
/// radius of the iris, as a fraction of the eyeball's radius
inline constexpr float kIrisRadius = 0.42F;
/// half the width of the blurred edges of pupil and iris, as a fraction of the eyeball's radius
inline constexpr float kIrisSoftness = 0.025F;

/// Position and size of an eyeball in one head.
struct EyeballSphere {
  Eigen::Vector3f centre;
  /// half the larger of the eyeball's extents along two axes perpendicular to the gaze
  float radius = 0;
};

/// Returns position and size of each eyeball.
/// \param points  x, y, z of each vertex.
/// \param gaze    direction in which the eyes look, a unit vector.
std::vector<EyeballSphere> eyeball_spheres(const Eyeballs& eyeballs,
                                           const std::vector<float>& points,
                                           const Eigen::Vector3f& gaze);

/// Albedo at a point of the eyeball's surface: white, iris or pupil.
LinearRgb eye_albedo(const EyeballSphere& eye, const Eigen::Vector3f& gaze,
                     const Eigen::Vector3f& point);

}  // namespace crowdface
