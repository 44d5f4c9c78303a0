// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/core/compressed_rows.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/parts/rigid_motion.h"

namespace crowdface {

/// The local rotation and stretch from the template's skin to a face's skin, as a smooth field of
/// linear maps. The maps are fitted at nodes a few centimetres apart: each map is the least-squares
/// fit from the template's vertices around the node to the same vertices of the face. The maps are
/// interpolated between the nodes. A flat patch of skin does not determine a map, so each fit also
/// includes, with a small weight, the similarity transform of the whole skin. The constructor
/// computes everything that depends on the template only.
class FrameField {
 public:
  FrameField() = default;
  /// \param neutral  Template at rest, #V by 3; must outlive this object.
  /// \param skin     Vertices of the skin, ascending; at least three.
  /// \param extent   Diagonal of the skin's bounding box.
  /// \param vertices  Indices of the vertices that need a map, ascending.
  FrameField(const Positions& neutral, std::span<const std::uint32_t> skin, double extent,
             std::span<const std::uint32_t> vertices);

  /// The motion and the linear maps that were fitted to one face (a head). `map_at` interpolates
  /// the linear map at a vertex from these data.
  struct Frames {
    RigidMotion face_motion;                 ///< motion from the template to the face
    std::vector<Eigen::Matrix3d> node_maps;  ///< linear map at each node
  };
  /// Fits the linear maps at all nodes to a face, #V by 3.
  Frames frames(const Positions& face) const;
  /// Returns the linear map at the vertex `vertices[i]`. If the face is the template rotated,
  /// translated and scaled, the map is this rotation and scale, up to rounding.
  Eigen::Matrix3d map_at(std::size_t i, const Frames& frames) const;

 private:
  /// A vertex of the skin around a node; the map of the node is fitted to such vertices.
  struct Sample {
    std::uint32_t vertex;
    Eigen::Vector3d weight_vector;  ///< the vector w in the sum Σ d·wᵀ, see Node
  };
  /// The map of a node is the matrix Σ d·wᵀ + R·W:
  ///
  /// - Σ d·wᵀ, a sum over the samples, is the fit to the skin around the node: d is the sample's
  ///   position on the face, relative to the node's vertex; w is Sample::weight_vector.
  /// - R is the rotation and scale of the whole skin. R·W determines the map in directions in which
  ///   the samples do not extend.
  struct Node {
    Eigen::Vector3d centre;  ///< position of the node's vertex on the template
    std::uint32_t vertex;
    std::vector<Sample> samples;  ///< the vertices to which the map of the node is fitted
    /// the matrix W in the formula of the node's map, Σ d·wᵀ + R·W (see Node)
    Eigen::Matrix3d similarity_weight_matrix;
  };
  /// The weight of a node's linear map (see Node) in the linear map of a vertex.
  struct NodeWeight {
    std::uint32_t node;
    double weight;  ///< the weights of all nodes for one vertex sum to one
  };

  /// Makes the node at a vertex.
  ///
  /// \param patch   Vertices of the skin around the node.
  /// \param radius  Distance from the node at which the weights of these vertices reach 0.
  static Node node_at(const Positions& neutral, std::span<const std::uint32_t> patch, double radius,
                      std::uint32_t vertex);

  const Positions* neutral_ = nullptr;  ///< template at rest, #V by 3
  /// vertices of the skin that determine the similarity transform of the whole skin
  std::vector<std::uint32_t> sampled_skin_;
  /// weights for fit_rigid_motion: 1 for each of sampled_skin_
  std::vector<double> equal_weights_;
  std::vector<Node> nodes_;  ///< the nodes, which are a few centimetres apart on the template
  /// for each vertex: the nodes whose maps are interpolated there, with weights
  CompressedRows<NodeWeight> node_weights_;
};

/// Returns the inverse of an invertible 3 by 3 matrix, computed from cofactors.
Eigen::Matrix3d inverse3(const Eigen::Matrix3d& m);

}  // namespace crowdface
