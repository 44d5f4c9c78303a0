// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "crowdface/core/units.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/render/camera.h"

namespace crowdface {

// Camera space: x right, y up, z towards the camera, origin at the point that the camera looks at.
// One unit is half the side of the image, measured in the plane z = 0, so that tolerances do not
// depend on the unit of the files.

/// Transforms positions to camera space: x, y, z of each vertex. \throws InvalidInput if a position
/// is not finite.
std::vector<float> to_camera_space(const Positions& positions, const Camera& camera);
/// Writes positions in camera space to existing memory.
void to_camera_space(const Positions& positions, const Camera& camera, std::vector<float>& points);

/// Transforms an axis of the file to a unit vector in camera space.
Eigen::Vector3f to_camera_space(const Camera& camera, Axis axis);

/// Returns the vertex normals times `sign`: #V unit vectors in camera space.
/// \param fans    polygons around each vertex of the topology.
/// \param points  positions from to_camera_space.
std::vector<Eigen::Vector3f> camera_normals(const Topology& topology, const NormalFans& fans,
                                            const std::vector<float>& points, float sign);

/// Memory for computing vertex normals, reused from one head to the next.
struct CameraNormals {
  /// for each polygon: its normal times twice its area
  std::vector<Eigen::Vector3f> area_vectors;
  std::vector<Eigen::Vector3f> normals;  ///< the vertex normals, #V

  /// Sets `normals` to the result of camera_normals.
  void compute(const Topology& topology, const NormalFans& fans, const std::vector<float>& points,
               float sign);
};

}  // namespace crowdface
