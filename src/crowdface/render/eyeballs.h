// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "crowdface/mesh/topology.h"
#include "crowdface/render/shading.h"
#include "crowdface/render/surface_kind.h"

namespace crowdface {

/// The eyeballs of a mesh: connected faces of kind kEye. Without textures an eye is blank, so an
/// iris is painted where it looks straight ahead.
struct Eyeballs {
  static constexpr std::uint32_t kNone = 0xffffffffU;
  std::vector<std::uint32_t> of_vertex;  ///< #V, the eyeball or kNone; empty if there is none
  std::uint32_t count = 0;
};

/// \param kinds  one a face, or empty.
Eyeballs find_eyeballs(const Topology& topology, const std::vector<SurfaceKind>& kinds);

/// Radii as shares of the eyeball's, about a human eye's in dim light, and how far their edges are
/// blurred to either side.
inline constexpr float kPupilRadius = 0.17F;
inline constexpr float kIrisRadius = 0.42F;
inline constexpr float kIrisSoftness = 0.025F;

/// One eyeball where it stands in a given head.
struct PlacedEye {
  Eigen::Vector3f centre;
  float radius = 0;  ///< across the gaze
};

/// \param points  x, y, z of each vertex.
/// \param gaze    unit; where the eyes look.
std::vector<PlacedEye> place_eyes(const Eyeballs& eyeballs, const std::vector<float>& points,
                                  const Eigen::Vector3f& gaze);

/// What an eyeball reflects at a point of its surface: white, iris or pupil.
Light eye_albedo(const PlacedEye& eye, const Eigen::Vector3f& gaze, const Eigen::Vector3f& point);

}  // namespace crowdface
