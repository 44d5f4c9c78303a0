// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "crowdface/validity/intersections.h"

namespace crowdface {

/// What is wrong with a face's skin against that of its target.
struct SkinDefects {
  LocalDefects local;
  Index new_intersections = 0;
};

/// Judges whole meshes of one topology against their targets. What depends on a target alone is
/// found once, when it is asked for first; any thread may ask.
class SkinCheck {
 public:
  /// \param heads  the targets, #V by 3 each; must outlive this.
  SkinCheck(const Topology& topology, const Components& components,
            const std::vector<Head>& heads);
  ~SkinCheck();
  SkinCheck(const SkinCheck&) = delete;
  SkinCheck& operator=(const SkinCheck&) = delete;

  SkinDefects compare(const Positions& positions, Index target, double least_area_share) const;

 private:
  struct Target;
  const Target& target(Index head) const;

  const std::vector<Head>& heads_;
  std::vector<Triangle> triangles_;
  mutable std::vector<std::unique_ptr<Target>> targets_;
};

}  // namespace crowdface
