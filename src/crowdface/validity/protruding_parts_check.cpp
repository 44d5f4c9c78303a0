// SPDX-License-Identifier: Apache-2.0
#include "crowdface/validity/protruding_parts_check.h"

#include <numeric>
#include <set>
#include <utility>

#include "crowdface/validity/visible_share.h"

namespace crowdface {

ProtrudingPartsCheck::ProtrudingPartsCheck(const Topology& topology, const Components& components,
                                           std::span<const std::uint32_t> parts,
                                           const Positions& mean, ViewSetup view_setup)
    : triangles_(triangles_of(topology, components, components.largest())),
      skin_count_(static_cast<std::uint32_t>(triangles_.size())),
      view_setup_(std::move(view_setup)) {
  for (const std::uint32_t part : parts) {
    const std::vector<Triangle> more = triangles_of(topology, components, part);
    triangles_.insert(triangles_.end(), more.begin(), more.end());
  }
  tree_ = TriangleTree(triangles_, mean);
}

double ProtrudingPartsCheck::exposed_mm2(const Positions& positions) const {
  if (triangles_.size() == skin_count_) return 0;
  const TriangleScene scene(triangles_, tree_, positions, ray_margin(positions));
  std::set<std::uint32_t> through;  // triangles of parts that pass through the skin
  for (const auto& [a, b] : scene.intersecting_pairs()) {
    if (a < skin_count_ && b >= skin_count_) through.insert(b);
  }
  std::vector<std::size_t> viewers(view_setup_.directions.size());
  std::iota(viewers.begin(), viewers.end(), 0);
  std::vector<std::uint32_t> last_occluders(viewers.size(), kNoIndex);
  double exposed = 0;
  for (const std::uint32_t t : through) {
    const double share =
        visible_share(scene, corners_of(positions, triangles_[t]), t, view_setup_.mm_per_unit,
                      view_setup_.directions, viewers, last_occluders);
    exposed += 0.5 * share * area_vector(positions, triangles_[t]).norm();
  }
  return exposed * view_setup_.mm_per_unit * view_setup_.mm_per_unit;
}

}  // namespace crowdface
