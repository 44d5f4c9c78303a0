// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "crowdface/core/text_pieces.h"
#include "crowdface/run/casting.h"
#include "crowdface/run/face_files.h"
#include "crowdface/run/job.h"

namespace crowdface {

/// Returns the text of report.json: constraints and results, versions, and hashes of all inputs.
/// The file contains no times and no machine names, so that the same inputs give the same bytes.
/// The arguments must outlive the text.
/// \param casting  content of casting.json
/// \param faces    results, one per face of the crowd
/// \param lists    lists the files of each face
/// \param neck_colours  see table_text
TextPieces report_text(const Job& job, const PreparedHeads& prepared, const CrowdPlan& crowd_plan,
                       const nlohmann::ordered_json& casting, const FaceFileLists& lists,
                       const std::vector<FaceResult>& faces,
                       const std::vector<Eigen::Array3d>& neck_colours, std::size_t sheets,
                       const std::vector<std::string>& warnings);

/// Reads a report.json but skips the list of faces, which may have a million entries.
/// \return a value for which `is_discarded()` is true if the file is not a valid report.
nlohmann::ordered_json read_report_summary(const std::filesystem::path& file);

/// Hashes of all inputs that determine the faces, except heads and masks. Each hash comes with the
/// key under which report.json stores it.
std::vector<std::pair<std::string, Digest>> digests_without_heads_and_masks(const Inputs& inputs);

/// Duration of each stage in seconds, in execution order.
using StageSeconds = std::vector<std::pair<std::string, double>>;

/// Time that all threads together spent on each stage of making faces, in seconds. It exceeds the
/// elapsed time, because several threads work at the same time.
struct StageTimes {
  std::atomic<double> blend_seconds = 0, encode_seconds = 0, write_seconds = 0, render_seconds = 0,
                      check_seconds = 0;
};

/// Measures its own lifetime and adds this duration to the time of a stage.
class StageTimer {
 public:
  explicit StageTimer(std::atomic<double>& stage_seconds) : stage_seconds_(stage_seconds) {}
  ~StageTimer() {
    const std::chrono::duration<double> lifetime = std::chrono::steady_clock::now() - start_;
    stage_seconds_ += lifetime.count();
  }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  /// total time of the stage, in seconds; the destructor increases it
  std::atomic<double>& stage_seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Returns the text of timings.json: the durations of the stages and the number of threads. These
/// values may differ between runs.
std::string format_timings(const StageSeconds& stages, const StageTimes& busy, std::size_t faces,
                           std::size_t heads_from_cache);

}  // namespace crowdface
