// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/io/obj_scan.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// What a model tells of a head beside its shape.
struct HeadPerson {
  bool male = false;
  double years = 0;
};

/// Heads as sums of morph targets: one topology, any number of heads. Lengths in centimetres, +Y up,
/// looking along +Z.
class HeadModel {
 public:
  virtual ~HeadModel() = default;
  /// The model's own average head.
  virtual const Mesh& neutral() const = 0;
  /// Of the faces, ascending; may be empty.
  virtual const std::vector<MaterialRange>& materials() const = 0;
  /// Head number `index` of a seed: #V by 3. The same bits on every machine.
  virtual Positions positions(std::uint64_t seed, std::uint64_t index) const = 0;
  /// Nothing where the model does not know.
  virtual std::optional<HeadPerson> person(std::uint64_t seed, std::uint64_t index) const = 0;
};

/// Heights of eyes and mouth in the neutral head.
struct FaceHeights {
  double eyes = 0, mouth = 0;
};

/// Rows of the vertices that faces of materials with these words in their names use, ascending.
std::vector<std::uint32_t> vertices_of_material(const Topology& topology,
                                                const std::vector<MaterialRange>& materials,
                                                const std::vector<std::string>& words);

/// Mean of these rows, in their order. \throws InvalidInput if there is none.
Eigen::RowVector3d mean_of(const Positions& positions, const std::vector<std::uint32_t>& rows);

}  // namespace crowdface
