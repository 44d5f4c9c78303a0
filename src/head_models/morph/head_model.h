// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/io/obj_scan.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Sex and age of a head.
struct HeadPerson {
  bool is_male = false;  ///< whether the person is male; false: female
  double age_years = 0;
};

/// A generator of random heads of one topology; each head is a weighted sum of morph targets.
/// Lengths are in centimetres, +Y is up, heads face +Z.
class HeadModel {
 public:
  virtual ~HeadModel() = default;
  /// Returns the model's average head.
  virtual const Mesh& neutral() const = 0;
  /// Returns the materials as ranges of polygons, sorted by first polygon; may be empty.
  virtual const std::vector<MaterialRange>& materials() const = 0;
  /// Returns the vertices, #V by 3, of head number `index` of a seed, bit-identical on every
  /// machine.
  virtual Positions positions(std::uint64_t seed, std::uint64_t index) const = 0;
  /// Returns sex and age of head number `index` of a seed; nothing if the model does not define
  /// sex and age.
  virtual std::optional<HeadPerson> person(std::uint64_t seed, std::uint64_t index) const = 0;
};

/// Heights (y coordinates) of the eyes and of the mouth in the neutral head.
struct FeatureHeights {
  /// Y coordinates in centimetres; in a MakeHumanMesh, in decimetres.
  double eye_height = 0, mouth_height = 0;
};

/// Returns the vertices of all polygons whose material's name contains one of the words, ascending.
std::vector<std::uint32_t> vertices_of_material(const Topology& topology,
                                                const std::vector<MaterialRange>& materials,
                                                const std::vector<std::string>& words);

/// Returns the mean of some rows of `positions`. Adds them in the order of their indices in `rows`.
/// \throws InvalidInput if `rows` is empty.
Eigen::RowVector3d mean_of(const Positions& positions, const std::vector<std::uint32_t>& rows);

}  // namespace crowdface
