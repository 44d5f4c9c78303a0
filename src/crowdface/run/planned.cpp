// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/planned.h"

#include <span>
#include <utility>

#include "crowdface/cast/shares.h"
#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/result_versions.h"
#include "crowdface/core/text.h"
#include "crowdface/core/version.h"
#include "crowdface/crowd/crowd_table.h"
#include "crowdface/heads/heads_on_body.h"
#include "crowdface/io/shallow_json.h"

namespace crowdface {
namespace {

/// Hash of everything that a plan depends on.
Digest key_of(const Job& job, const CrowdDirectory& directory) {
  Hasher hasher;
  hasher.add(kVersion)
      .add(kPlanVersion)
      .add(plan_settings_yaml(job.config, directory.root))
      .add(job.settings);
  // The placement of heads on the body changes measurements, which the plan contains.
  if (job.inputs.heads_on_body) hasher.add(kNeckVersion).add(job.inputs.heads_on_body->digest);
  hasher.add_array(std::span(job.inputs.distance_weights));
  for (const std::string& review : job.config.review.texts) hasher.add(review);
  for (const auto& table : {job.config.population, job.config.quantile_table}) {
    for (const TraitTarget& target : table.targets) {
      hasher.add(target.trait).add(target.mean).add(target.deviation);
    }
  }
  if (!job.config.landmarks.empty()) hasher.add(read_file(job.config.landmarks));
  return hasher.digest();
}

/// Reads a shard's faces from the plan; parses lines in parallel.
std::vector<FacePlan> read_faces(const Job& job, const std::filesystem::path& plan,
                                 const Shard& shard) {
  constexpr std::size_t kAtOnce = 4096, kBlock = 16;
  std::vector<FacePlan> faces;
  faces.reserve(face_count(job.config) / shard.count + 1);
  std::vector<std::pair<std::size_t, std::string>> lines;
  const auto read = [&] {
    throw_if_interrupted();
    const std::size_t first = faces.size();
    faces.resize(first + lines.size());
    parallel_for_each(lines.size(), kBlock, [&](std::size_t i) {
      const auto& [number, line] = lines[i];
      faces[first + i] = parse_plan_line(line, job.names, concat(plan.string(), ":", number)).face;
    });
    lines.clear();
  };
  std::size_t number = 0;
  read_lines(plan, [&](std::string_view line, bool) {
    if (shard.owns(number++)) lines.emplace_back(number, line);
    if (lines.size() == kAtOnce) read();
  });
  read();
  return faces;
}

/// Removes the report if the plan changes, because a report marks the folder as complete.
void remove_report_of_other_plan(const CrowdDirectory& directory, const TextPieces& plan) {
  if (!path_exists(directory.report()) || has_content(directory.plan(), digest_of(plan))) return;
  remove_if_exists(directory.report());
}

}  // namespace

HeadTagsAndAttachmentKinds head_tags_and_attachment_kinds(const Config& config) {
  HeadTagsAndAttachmentKinds facts{config.faces.tags, {}};
  for (const Config::Attachment& item : config.attachments.items)
    facts.attachment_kinds.push_back(item.kind);
  return facts;
}

void write_plan(const Job& job, const CrowdDirectory& directory, const CrowdPlan& crowd_plan,
                const nlohmann::ordered_json& casting,
                const std::vector<Eigen::Array3d>& neck_colours, const WriteFile& write) {
  const TextPieces plan = annotated_plan_text(crowd_plan.crowd, job.names, job.settings,
                                              head_tags_and_attachment_kinds(job.config));
  remove_report_of_other_plan(directory, plan);
  nlohmann::ordered_json files = nlohmann::ordered_json::array();
  const auto write_and_mark = [&](const std::filesystem::path& path, const TextPieces& text) {
    files.push_back(file_to_json({directory.relative(path), write(path, text)}));
  };
  write_and_mark(directory.plan(), plan);
  write(directory.table(), table_text(crowd_plan.crowd, job.names, neck_colours,
                                      head_tags_and_attachment_kinds(job.config)));
  if (!crowd_plan.founders.empty()) {
    write_and_mark(directory.founders(), plan_text(crowd_plan.founders, job.names, job.settings));
  }
  if (!crowd_plan.rejected.empty()) {
    write_and_mark(directory.rejected(), plan_text(crowd_plan.rejected, job.names, job.settings));
  }
  write_and_mark(directory.casting(), [&](const TextSink& take) { take(casting.dump(2) + "\n"); });
  const nlohmann::ordered_json mark = {{"job", key_of(job, directory).hex()}, {"files", files}};
  write_file(directory.plan_marker(), mark.dump() + "\n");
}

std::optional<PlannedFaces> read_planned_faces(const Job& job, const CrowdDirectory& directory,
                                               const Shard& shard) {
  if (!is_file(directory.plan_marker()) || !is_file(directory.plan())) return std::nullopt;
  const auto mark = parse_shallow_json(read_file(directory.plan_marker()));
  if (!mark.is_object() || !mark.contains("files")) return std::nullopt;
  const auto files = files_from_json(mark["files"]);
  if (!files || files->empty() ||
      mark.value("job", nlohmann::ordered_json()) != key_of(job, directory).hex()) {
    return std::nullopt;
  }
  // A shard checks only the first file, the plan, because the shard does not read the other files.
  // `gather` checks all files.
  for (const LedgerEntry::File& file :
       std::span(*files).first(shard.is_whole_crowd() ? files->size() : 1)) {
    if (!has_content(directory.root / file.name, file.content)) return std::nullopt;
  }
  return PlannedFaces{read_faces(job, directory.plan(), shard), *files};
}

std::vector<FacePlan> read_founders(const Job& job, const CrowdDirectory& directory) {
  std::vector<FacePlan> founders;
  if (!path_exists(directory.founders())) return founders;
  for (PlanLine& line : read_plan(directory.founders(), job.names)) {
    founders.push_back(std::move(line.face));
    founders.back().family = founders.back().family.value_or(founders.back().id);
  }
  return founders;
}

CrowdPlan restore_crowd_plan(const Job& job, const CrowdDirectory& directory,
                             const PreparedHeads& prepared, std::vector<FacePlan> crowd,
                             const std::filesystem::path& cache) {
  const FaceSpace space = casting_space(job.config, job.inputs, prepared, cache).face_space;
  const CastingOptions casting = casting_options(job.config, job.inputs, space.head_distances());
  CrowdPlan crowd_plan;
  crowd_plan.anchors = casting.anchors;
  crowd_plan.crowd = std::move(crowd);
  crowd_plan.group_of_face = schedule_groups(casting.groups, casting.count);
  crowd_plan.founders = read_founders(job, directory);
  if (job.config.output.contact_sheet) {
    crowd_plan.points.resize(crowd_plan.crowd.size());
    constexpr std::size_t kBlock = 64;
    parallel_for_each(crowd_plan.crowd.size(), kBlock, [&](std::size_t i) {
      crowd_plan.points[i] = space.point(crowd_plan.crowd[i].recipe);
    });
  }
  return crowd_plan;
}

}  // namespace crowdface
