// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "crowdface/cast/cast_crowd.h"
#include "crowdface/cast/face_space.h"
#include "crowdface/job/config.h"
#include "crowdface/job/config_reader.h"
#include "crowdface/job/inputs.h"
#include "crowdface/job/plan_file.h"
#include "crowdface/job/prepare.h"

namespace crowdface {

/// A config with everything it names, read and checked.
struct Job {
  Config config;
  Inputs inputs;
  SmoothingOperator smoothing;
  PlanNames names;
  Digest settings;  ///< see settings_digest
};

/// Reads config, heads and masks. Every problem is added.
/// \return nothing if there is any problem.
std::optional<Job> load_job(const std::filesystem::path& config_file,
                            const ConfigOverrides& overrides, Problems& problems);
/// \throws Error with all problems.
Job load_job(const std::filesystem::path& config_file, const ConfigOverrides& overrides);

/// A crowd cast: where the heads stand on the plane, and one recipe a face.
struct Cast {
  std::vector<PlanePoint> anchors;  ///< #heads
  Eigen::MatrixXd head_distances;   ///< #heads by #heads, mm
  std::vector<Recipe> crowd;        ///< with their nearest neighbours
};
Cast cast(const Job& job, const Prepared& prepared);

/// The plan as it stands in plan.jsonl.
std::string format_plan(const Job& job, const std::vector<Recipe>& crowd);

}  // namespace crowdface
