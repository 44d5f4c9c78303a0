// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/core/units.h"
#include "crowdface/mesh/adjacency.h"

namespace crowdface {

/// The part of the head that distances between faces compare.
enum class ComparedArea {
  kFront,  ///< distances compare the front half of the skin
  kSkin,   ///< distances compare the whole skin, including the back of the head and the neck
};

/// Returns the weight that each vertex has in distances between faces. The weight is the surface
/// area around the vertex on the mean head; the area of each polygon is divided equally among its
/// corners. Vertices outside the part `area` of the head have weight zero. The skin is the largest
/// component, so eyeballs, teeth and lashes have weight zero.
///
/// \param mask  factors on the weights, one per vertex; or empty.
std::vector<double> compared_vertex_areas(const Topology& topology, const Components& components,
                                          const Positions& mean, ComparedArea area, Axis front,
                                          const std::vector<double>& mask = {});

/// Returns the distance between two faces whose meshes have the same topology: the root mean square
/// distance over all vertices, after the second face is aligned rigidly with the first. The
/// distance has the unit of the positions.
///
/// \param areas  #V, weights of the vertices; not all zero.
/// \throws BrokenPrecondition if the sizes differ.
/// \throws InvalidInput if there are fewer than 3 vertices.
double face_distance(const Positions& a, const Positions& b, const std::vector<double>& areas);

}  // namespace crowdface
