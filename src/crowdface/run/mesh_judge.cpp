// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/mesh_judge.h"

#include <set>
#include <span>
#include <utility>

#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/run/face_builder.h"

namespace crowdface {
namespace {

SkinCheck check_against(const Job& job, const std::set<Index>& targets) {
  const Inputs& inputs = job.inputs;
  return {inputs.faces.topology, inputs.skin, inputs.faces.heads, targets};
}

}  // namespace

bool skin_is_judged(const Job& job) {
  constexpr Index kMostFaces = 200'000;  // polygons; beyond that it would rule the time of a run
  const BelievabilityOptions& believability = job.config.believability;
  using Meshes = BelievabilityOptions::Meshes;
  return believability.check && believability.meshes != Meshes::kNone &&
         (believability.meshes != Meshes::kAuto ||
          job.inputs.faces.topology.face_count() <= kMostFaces);
}

std::unique_ptr<SkinCheck> skin_check(const Job& job, const std::vector<CastFace>& crowd) {
  if (!skin_is_judged(job)) return nullptr;
  std::set<Index> targets;
  for (const CastFace& face : crowd) targets.insert(face.recipe.target);
  return std::make_unique<SkinCheck>(check_against(job, targets));
}

MeshDefects mesh_defects(const Job& job, const Prepared& prepared) {
  const BelievabilityOptions& believability = job.config.believability;
  if (!believability.check || believability.meshes != BelievabilityOptions::Meshes::kJudge) {
    return {};
  }
  std::set<Index> targets;
  for (std::size_t h = 0; h < job.names.heads.size(); ++h) targets.insert(static_cast<Index>(h));
  const auto builder = std::make_shared<FaceBuilder>(job, prepared);
  const auto check = std::make_shared<SkinCheck>(check_against(job, targets));
  return [builder, check](const Recipe& recipe) {
    const Recipe* one = &recipe;
    Positions face;
    builder->build(std::span(&one, 1), std::span(&face, 1));
    return check->compare(face, recipe.target);
  };
}

std::vector<std::string> judge_meshes(const Job& job, const std::vector<CastFace>& crowd,
                                      const std::vector<FaceFiles>& files) {
  const BelievabilityOptions& limits = job.config.believability;
  std::vector<std::string> beyond;
  for (std::size_t i = 0; i < crowd.size(); ++i) {
    if (!files[i].skin) continue;
    if (limit_passed(limits, *files[i].skin)) beyond.push_back(crowd[i].id);
  }
  if (beyond.empty()) return {};
  constexpr std::size_t kNamed = 8;
  const std::size_t count = beyond.size();
  if (count > kNamed) {
    beyond.resize(kNamed);
    beyond.emplace_back("…");
  }
  const std::string warning = concat(
      count, count == 1 ? " face goes" : " faces go",
      " beyond a limit of believability on the whole mesh, though not at the samples: ",
      join(beyond),
      "; report.json says by how much; a review can reject them, and \"believability: {meshes: "
      "judge}\" casts none");
  log_warning(warning);
  return {warning};
}

}  // namespace crowdface
