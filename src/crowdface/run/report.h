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
#include "crowdface/run/pipeline.h"

namespace crowdface {

/// report.json: what was asked and what was reached, versions and hashes of all inputs. Holds no
/// time and no machine: the same inputs give the same bytes. All must outlive the text.
/// \param casting  what stands in casting.json
/// \param faces    what is known of each, and the lists of their files
TextPieces report_text(const Job& job, const Prepared& prepared, const Cast& cast,
                       const nlohmann::ordered_json& casting, const FaceFileLists& lists,
                       const std::vector<FaceResult>& faces, std::size_t sheets,
                       const std::vector<std::string>& warnings);

/// A report.json without its faces, which may be a million.
/// \return what `is_discarded()` if it is no report of ours.
nlohmann::ordered_json read_report_summary(const std::filesystem::path& file);

/// Hashes of what faces have from elsewhere than heads and masks, each by the name that report.json has.
std::vector<std::pair<std::string, Digest>> digests_beside_heads(const Inputs& inputs);

/// How long each stage took, in the order it ran.
using StageSeconds = std::vector<std::pair<std::string, double>>;

/// How long threads were busy with each stage of making faces, in seconds; together more than the
/// time it took, as stages overlap and several threads work.
struct StageBusy {
  std::atomic<double> blend = 0, encode = 0, write = 0, render = 0, check = 0;
};

/// Adds the time until its end to a stage.
class Busy {
 public:
  explicit Busy(std::atomic<double>& stage) : stage_(stage) {}
  ~Busy() {
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start_;
    stage_ += took.count();
  }
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;

 private:
  std::atomic<double>& stage_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// timings.json: times and machine, which may differ from run to run.
std::string format_timings(const StageSeconds& stages, const StageBusy& busy, std::size_t faces,
                           std::size_t heads_from_cache);

}  // namespace crowdface
