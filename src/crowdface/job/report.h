// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "crowdface/core/file.h"
#include "crowdface/job/casting.h"
#include "crowdface/job/mesh_writers.h"
#include "crowdface/validity/skin_check.h"

namespace crowdface {

/// What one face's files are.
struct FaceFiles {
  std::vector<MeshFile> meshes;
  std::optional<FileDigest> picture;  ///< if it was rendered
  std::optional<FileDigest> gallery;  ///< what the gallery shows of it, if there is one
  std::optional<SkinDefects> skin;    ///< against the target's, if it was judged
};

/// report.json: what was asked and what was reached, versions and hashes of all inputs. Holds no
/// time and no machine: the same inputs give the same bytes.
std::string format_report(const Job& job, const Prepared& prepared, const Cast& cast,
                          const std::vector<FaceFiles>& files, std::size_t sheets,
                          const std::vector<std::string>& warnings);

/// How long each stage took, in the order it ran.
using StageSeconds = std::vector<std::pair<std::string, double>>;

/// How long threads were busy with each stage of making faces, in seconds; together more than the
/// time it took, as stages overlap and several threads work.
struct StageBusy {
  double blend = 0, encode = 0, write = 0, render = 0, check = 0;
};

/// timings.json: times and machine, which may differ from run to run.
std::string format_timings(const StageSeconds& stages, const StageBusy& busy, std::size_t faces,
                           std::size_t heads_from_cache);

}  // namespace crowdface
