// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "crowdface/core/units.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/render/camera.h"

namespace crowdface {

// A head as the camera sees it: x right, y up, z towards the camera, the target at the origin, and
// half the side of the image as unit, so that small distances mean the same in any unit of the
// files.

/// x, y, z of each vertex. \throws InvalidInput if a position is not finite.
std::vector<float> to_camera(const Positions& positions, const Camera& camera);
/// The same into memory that is there already.
void to_camera(const Positions& positions, const Camera& camera, std::vector<float>& points);

/// An axis of the file as a unit vector.
Eigen::Vector3f to_camera(const Camera& camera, Axis axis);

/// #V unit normals times `sign`, in single precision: for looking at.
/// \param fans    of the topology's vertices.
/// \param points  as to_camera gives them.
std::vector<Eigen::Vector3f> camera_normals(const Topology& topology, const NormalFans& fans,
                                            const std::vector<float>& points, float sign);

/// Normals, and the memory that finding them takes.
struct CameraNormals {
  std::vector<Eigen::Vector3f> areas;    ///< of the faces
  std::vector<Eigen::Vector3f> normals;  ///< #V

  void compute(const Topology& topology, const NormalFans& fans, const std::vector<float>& points,
               float sign);
};

}  // namespace crowdface
