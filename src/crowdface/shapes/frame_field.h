// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/core/compressed_rows.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/parts/rigid_motion.h"

namespace crowdface {

/// The local rotation and stretch of a face's skin relative to the template's, as a smooth field of
/// linear maps. The maps are fitted at nodes a few centimetres apart: each map is the least-squares
/// fit from the template's skin around the node to the face's. Between nodes the maps are
/// interpolated. A flat patch of skin does not determine a map, so each fit also includes, with a
/// small weight, the similarity of the whole skin. The constructor computes everything that depends
/// on the template only.
class FrameField {
 public:
  FrameField() = default;
  /// \param neutral  Template at rest, #V by 3; must outlive this object.
  /// \param skin     Vertices of the skin, ascending; at least three.
  /// \param extent   Diagonal of the skin's bounding box.
  /// \param used     Vertices at which maps are needed, ascending.
  FrameField(const Positions& neutral, std::span<const std::uint32_t> skin, double extent,
             std::span<const std::uint32_t> used);

  struct Frames {
    RigidMotion whole;                      ///< motion from the template to the face
    std::vector<Eigen::Matrix3d> at_place;  ///< #nodes: linear map at each node
  };
  Frames frames(const Positions& face) const;
  /// Returns the map at the vertex `used[i]`. If the face is the template rotated, translated and
  /// scaled, the map is this rotation and scale, up to rounding.
  Eigen::Matrix3d at(std::size_t i, const Frames& frames) const;

 private:
  struct Sample {
    std::uint32_t vertex;
    Eigen::Vector3d weight;
  };
  struct Place {
    Eigen::Vector3d middle;
    std::uint32_t vertex;
    std::vector<Sample> samples;
    /// factor on the whole skin's map, which fills directions that the samples do not determine
    Eigen::Matrix3d rest;
  };
  struct Share {
    std::uint32_t place;
    double weight;  ///< weights of a vertex sum to one
  };

  static Place place_at(const Positions& neutral, std::span<const std::uint32_t> patch,
                        double reach, std::uint32_t vertex);

  const Positions* neutral_ = nullptr;
  std::vector<std::uint32_t> some_skin_;
  std::vector<double> ones_;  ///< #some_skin_
  std::vector<Place> places_;
  /// #used: the nodes between which each vertex interpolates, with weights
  CompressedRows<Share> shares_;
};

/// Inverts a regular 3 by 3 matrix by cofactors.
Eigen::Matrix3d inverse3(const Eigen::Matrix3d& m);

}  // namespace crowdface
