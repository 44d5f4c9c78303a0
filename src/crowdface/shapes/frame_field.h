// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/core/grouped.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/parts/rigid_motion.h"

namespace crowdface {

/// How a face's skin is turned and stretched against a template's, smoothly: at places some
/// centimetres apart the linear map that carries the template's skin around the place nearest to
/// the face's, in the least-squares sense, and between them a mean of those. What a patch of skin
/// leaves open, being flat, is taken from the similarity of the whole skin. All that depends on the
/// template alone is computed once.
class FrameField {
 public:
  FrameField() = default;
  /// \param neutral  of the template
  /// \param skin     its skin's vertices, ascending, at least three
  /// \param extent   diagonal of the skin's box
  /// \param used     vertices at which frames are asked for, ascending
  FrameField(const Positions& neutral, std::span<const std::uint32_t> skin, double extent,
             std::span<const std::uint32_t> used);

  struct Frames {
    RigidMotion whole;                      ///< from the template to the face
    std::vector<Eigen::Matrix3d> of_place;  ///< #places
  };
  Frames frames(const Positions& face) const;
  /// The map at the vertex `used[i]`. A face that is the template turned, moved and scaled gives that
  /// turn and scale, up to rounding.
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
    Eigen::Matrix3d rest;  ///< times the map of the whole: what the samples leave open
  };
  struct Share {
    std::uint32_t place;
    double weight;  ///< those of a vertex add up to one
  };

  static Place place_at(const Positions& neutral, std::span<const std::uint32_t> patch,
                        double reach, std::uint32_t vertex);

  const Positions* neutral_ = nullptr;
  std::vector<std::uint32_t> some_skin_;
  std::vector<double> ones_;  ///< #some_skin
  std::vector<Place> places_;
  Grouped<Share> shares_;  ///< #used
};

/// The inverse of a matrix that has one, by cofactors.
Eigen::Matrix3d inverse3(const Eigen::Matrix3d& m);

}  // namespace crowdface
