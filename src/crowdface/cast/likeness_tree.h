// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "crowdface/cast/face_space.h"
#include "crowdface/cast/neighbour.h"
#include "crowdface/cast/point_blocks.h"

namespace crowdface {

/// Faces that can be asked for those that look most like one of them, and taken out one by one: a k-d
/// tree (Friedman, Bentley & Finkel 1977) over the leading coordinates. Answers are exact: those of
/// FaceSpace::distance over all faces, of equally near ones the first.
class LikenessTree {
 public:
  /// \param points  must outlive this object.
  explicit LikenessTree(const std::vector<FaceSpace::Point>& points);

  /// All faces, those that look alike mostly side by side: so they are best asked for.
  std::span<const std::uint32_t> faces() const { return faces_; }
  /// Takes a face out.
  void remove(std::size_t face);
  bool has(std::size_t face) const;
  /// The nearest others that are left, nearest first.
  std::vector<Neighbour> nearest(std::size_t face, std::size_t count) const;

 private:
  static constexpr std::size_t kBoxDimensions = 8;
  static constexpr std::size_t kLeaf = 2 * PointBlocks::kLanes;

  /// Of the leading coordinates; those that points do not have are zero.
  struct Box {
    std::array<float, kBoxDimensions> low{}, high{};
    float squared_distance(const std::vector<float>& query) const;
  };
  /// The points of all faces, as built or with factors of 1, leaf by leaf.
  struct Variant {
    PointBlocks points;
    std::vector<Box> boxes;  ///< #nodes
  };
  struct Node {
    std::uint32_t begin = 0, end = 0, left = 0;  ///< places of its faces; how many are left
    std::int32_t parent = -1;
    std::array<std::int32_t, 2> children = {-1, -1};  ///< −1: a leaf
  };
  struct Search;

  std::int32_t build(std::uint32_t begin, std::uint32_t end, std::int32_t parent);
  Variant variant(Eigen::VectorXf FaceSpace::Point::*of) const;
  float squared_distance(std::int32_t node, const Search& search) const;
  void search_leaf(const Node& leaf, Search& search) const;
  void search(std::int32_t at, Search& search) const;

  const std::vector<FaceSpace::Point>& points_;
  std::vector<std::uint32_t> faces_;  ///< by their places, leaf by leaf
  std::vector<std::uint32_t> place_;  ///< of each face
  std::vector<bool> gone_;            ///< by their places
  std::vector<std::int32_t> leaf_;    ///< of each group of kLeaf places
  std::vector<Node> nodes_;
  std::vector<Variant> variants_;  ///< one, if all faces are as with factors of 1
};

}  // namespace crowdface
