// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "crowdface/cast/face_space.h"
#include "crowdface/cast/neighbour.h"

namespace crowdface {

/// Faces that can be asked for those that look most like one of them, and taken out one by one: a k-d
/// tree (Friedman, Bentley & Finkel 1977) over the leading coordinates. Answers are exact: those of
/// FaceSpace::distance over all faces, of equally near ones the first.
class LikenessTree {
 public:
  /// \param points  must outlive this object.
  explicit LikenessTree(const std::vector<FaceSpace::Point>& points);

  /// Takes a face out.
  void remove(std::size_t face);
  /// The nearest others that are left, nearest first.
  std::vector<Neighbour> nearest(std::size_t face, std::size_t count) const;

 private:
  static constexpr Index kBoxDimensions = 8;
  using Leading = std::array<float, kBoxDimensions>;

  struct Box {
    Leading low{}, high{};
  };
  struct Node {
    Box as_built, unit;
    std::uint32_t first = 0, left = 0;  ///< where its faces stand, and how many are left
    std::int32_t parent = -1;
    std::array<std::int32_t, 2> children = {-1, -1};  ///< −1: a leaf
  };
  struct Search;

  std::int32_t build(std::uint32_t begin, std::uint32_t end, std::int32_t parent);
  Box box_of(std::uint32_t begin, std::uint32_t end,
             Eigen::VectorXf FaceSpace::Point::*variant) const;
  float squared_distance(const Box& box, const Eigen::VectorXf& point) const;
  void search(std::int32_t at, Search& search) const;

  const std::vector<FaceSpace::Point>& points_;
  Index box_dimensions_;
  std::vector<std::uint32_t> faces_;  ///< leaf by leaf; in each those that are left come first
  std::vector<std::int32_t> leaf_;    ///< #faces, where each is
  std::vector<Node> nodes_;
};

}  // namespace crowdface
