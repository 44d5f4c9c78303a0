// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/mesh_judge.h"

#include <algorithm>
#include <iterator>
#include <memory>

#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/core/units.h"
#include "crowdface/heads/named_parts.h"
#include "crowdface/pictures/surfaces.h"

namespace crowdface {
namespace {

/// Returns the fifteen directions from which defects of a mesh are looked for: all combinations of
/// five horizontal angles (from the left over the front to the right) and three heights (from
/// below, level, from above).
ViewSetup viewing_directions(const Config& config) {
  const HeadAxes axes = head_axes(config);
  ViewSetup view_setup{{}, mm_per(config.faces.units)};
  for (const double aside : {-1.5, -0.6, 0.0, 0.6, 1.5}) {
    for (const double above : {-0.45, 0.0, 0.45}) {
      view_setup.directions.emplace_back(axes.front + aside * axes.side() + above * axes.up);
    }
  }
  return view_setup;
}

}  // namespace

bool skin_is_judged(const Config& config, const Inputs& inputs) {
  constexpr Index kMaxFaces = 200'000;  // polygons; larger meshes would dominate the run time
  const BelievabilityOptions& believability = *config.believability;
  using MeshChecks = BelievabilityOptions::MeshChecks;
  return believability.check && believability.meshes != MeshChecks::kNone &&
         (believability.meshes != MeshChecks::kAuto ||
          inputs.head_set.topology.face_count() <= kMaxFaces);
}

SkinCheck skin_check(const Config& config, const Inputs& inputs, const std::set<Index>& targets) {
  return {inputs.head_set.topology, inputs.skin_components, inputs.head_set.heads, targets,
          viewing_directions(config)};
}

ProtrudingPartsCheck protruding_parts_check(const Config& config, const Inputs& inputs) {
  const std::vector<SurfaceKind> kinds = surfaces_of(config, inputs).kinds;
  std::set<std::uint32_t> seen;  // components with at least one polygon that renders show
  for (std::size_t f = 0; f < kinds.size(); ++f) {
    if (kinds[f] == SurfaceKind::kHidden) continue;
    seen.insert(inputs.skin_components
                    .component_of_vertex[inputs.head_set.topology.face(static_cast<Index>(f))[0]]);
  }
  std::vector<std::uint32_t> components;
  for (const Part& part : inputs.parts.parts) {
    if (part.is_eyeball) continue;
    std::ranges::copy_if(part.components, std::back_inserter(components),
                         [&](std::uint32_t of) { return kinds.empty() || seen.contains(of); });
  }
  return {inputs.head_set.topology, inputs.skin_components, components, mean_head(inputs.head_set),
          viewing_directions(config)};
}

bool casting_builds_candidate_meshes(const Config& config) {
  return config.believability->check &&
         config.believability->meshes == BelievabilityOptions::MeshChecks::kJudge;
}

MeshDefectFinder mesh_defect_finder(const Config& config, const Inputs& inputs,
                                    const FaceBuilder& builder) {
  std::set<Index> targets;
  for (std::size_t h = 0; h < inputs.head_set.heads.size(); ++h)
    targets.insert(static_cast<Index>(h));
  const auto check = std::make_shared<SkinCheck>(skin_check(config, inputs, targets));
  return [&builder, check](const Recipe& recipe) {
    return builder.defects(*check, recipe, builder.build(recipe));
  };
}

std::vector<std::string> mesh_warnings(const BelievabilityOptions& limits,
                                       const std::vector<FacePlan>& crowd,
                                       const std::vector<FaceResult>& results) {
  std::vector<std::string> beyond;
  for (std::size_t i = 0; i < crowd.size(); ++i) {
    if (!results[i].skin_defects) continue;
    if (exceeded_limit(limits, *results[i].skin_defects)) beyond.push_back(crowd[i].id);
  }
  if (beyond.empty()) return {};
  constexpr std::size_t kNamed = 8;
  const std::size_t count = beyond.size();
  if (count > kNamed) {
    beyond.resize(kNamed);
    beyond.emplace_back("…");
  }
  const std::string warning =
      concat(count, count == 1 ? " face exceeds" : " faces exceed",
             " a limit of believability on the whole mesh, although not at the sampled points: ",
             join(beyond),
             "; report.json shows by how much; reject them with a review, or avoid them with "
             "\"believability: {meshes: judge}\"");
  log_warning(warning);
  return {warning};
}

}  // namespace crowdface
