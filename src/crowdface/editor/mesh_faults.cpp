// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/mesh_faults.h"

#include "crowdface/cast/face_judge.h"
#include "crowdface/run/mesh_judge.h"

namespace crowdface {

std::shared_ptr<const MeshFaults::TargetFaults> MeshFaults::target_faults(Index head) const {
  const std::lock_guard lock(mutex_);
  if (!protruding_parts_check_)
    protruding_parts_check_.emplace(protruding_parts_check(job_.config, job_.inputs));
  std::shared_ptr<const TargetFaults>& target = target_faults_[head];
  if (!target) {
    const Positions& positions =
        job_.inputs.head_set.heads[static_cast<std::size_t>(head)].positions;
    target = std::make_shared<const TargetFaults>(
        TargetFaults{skin_check(job_.config, job_.inputs, {head}),
                     protruding_parts_check_->exposed_mm2(positions)});
  }
  return target;
}

std::vector<std::string> MeshFaults::faults_of(const Recipe& recipe, const Positions& face) const {
  if (!skin_is_judged(job_.config, job_.inputs)) return {};
  const BelievabilityOptions& limits = *job_.config.believability;
  const std::shared_ptr<const TargetFaults> target = this->target_faults(recipe.target);
  const SkinDefects defects = builder_.defects(target->skin_check, recipe, face);
  std::vector<std::string> faults;
  if (protruding_parts_check_->exposed_mm2(face) - target->exposed_parts_mm2 >
      limits.max_exposed_mm2) {
    faults.emplace_back("gums, teeth or other parts stand out of the skin");
  }
  if (defects.exposed_back_face_mm2 > limits.max_exposed_mm2) {
    faults.push_back(describe_violation(RejectionReason::kExposed, *job_.config.diversity, limits));
  }
  const auto why = exceeded_limit(limits, defects);
  if (why && *why != RejectionReason::kExposed) {
    faults.push_back(describe_violation(*why, *job_.config.diversity, limits));
  }
  return faults;
}

}  // namespace crowdface
