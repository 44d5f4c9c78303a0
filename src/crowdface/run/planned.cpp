// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/planned.h"

#include <algorithm>
#include <span>
#include <system_error>
#include <utility>

#include "crowdface/cast/quotas.h"
#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/core/version.h"
#include "crowdface/io/shallow_json.h"
#include "crowdface/run/casting_report.h"
#include "crowdface/run/resume.h"

namespace crowdface {
namespace {

/// Of all that a plan follows from.
Digest key_of(const Job& job, const CrowdDirectory& directory) {
  Hasher hasher;
  hasher.add(kVersion).add(config_in_folder(job.config, directory)).add(job.settings);
  hasher.add_array(std::span(job.inputs.distance_mask));
  for (const std::string& review : job.config.review.texts) hasher.add(review);
  return hasher.digest();
}

std::optional<std::string> text_at(const nlohmann::ordered_json& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_string()) return std::nullopt;
  return found->get<std::string>();
}

/// Those that the mark names, the plan first; none if it is not whole.
std::vector<LedgerEntry::File> files_of(const nlohmann::ordered_json& mark) {
  std::vector<LedgerEntry::File> files;
  const auto list = mark.find("files");
  if (list == mark.end() || !list->is_array()) return {};
  for (const auto& json : *list) {
    if (!json.is_object()) return {};
    const auto name = text_at(json, "file"), hash = text_at(json, "hash");
    const auto digest = hash ? parse_digest(*hash) : std::nullopt;
    const auto bytes = json.find("bytes");
    if (!name || !digest || bytes == json.end() || !bytes->is_number_unsigned()) return {};
    files.push_back({*name, {bytes->get<std::uint64_t>(), *digest}});
  }
  return files;
}

/// The faces that a shard has in the plan, read by several threads.
std::vector<CastFace> read_faces(const Job& job, const std::filesystem::path& plan,
                                 const Shard& shard) {
  constexpr std::size_t kAtOnce = 4096, kBlock = 16;
  std::vector<CastFace> faces;
  faces.reserve(face_count(job.config) / shard.count + 1);
  std::vector<std::pair<std::size_t, std::string>> lines;
  const auto read = [&] {
    throw_if_interrupted();
    const std::size_t first = faces.size();
    faces.resize(first + lines.size());
    parallel_for_each(lines.size(), kBlock, [&](std::size_t i) {
      const auto& [number, line] = lines[i];
      faces[first + i] = parse_recipe(line, job.names, concat(plan.string(), ":", number)).face;
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

/// Of a file that this run has just written. \throws IoError if it is gone.
FileDigest hash_own_file(const std::filesystem::path& file) {
  try {
    return hash_file(file);
  } catch (const MissingInput&) {
    throw IoError(concat(file.string(),
                         ": was removed while the run was at work; run the same command again"));
  }
}

}  // namespace

void write_plan(
    const Job& job, const CrowdDirectory& directory, const Cast& cast,
    const nlohmann::ordered_json& casting,
    const std::function<void(const std::filesystem::path& path, const TextPieces& text)>& write) {
  const auto write_whole = [&](const std::filesystem::path& path, const std::string& bytes) {
    write(path, [&](const TakePiece& take) { take(bytes); });
  };
  const TextPieces plan = plan_text(job, cast.crowd);
  remove_report_of_other_plan(directory, plan);
  write(directory.plan(), plan);
  write(directory.table(), table_text(cast.crowd, job.names));
  if (!cast.founders.empty()) {
    write_whole(directory.founders(), format_founders(job, cast.founders));
  }
  if (!cast.rejected.empty()) write(directory.rejected(), plan_text(job, cast.rejected));
  write_whole(directory.casting(), casting.dump(2) + "\n");
}

void mark_planned(const Job& job, const CrowdDirectory& directory) {
  nlohmann::ordered_json files = nlohmann::ordered_json::array();
  for (const std::filesystem::path& file :
       {directory.plan(), directory.table(), directory.founders(), directory.rejected(),
        directory.casting()}) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) continue;
    const FileDigest content = hash_own_file(file);
    files.push_back({{"file", directory.relative(file)},
                     {"bytes", content.bytes},
                     {"hash", content.digest.hex()}});
  }
  const nlohmann::ordered_json mark = {{"job", key_of(job, directory).hex()}, {"files", files}};
  write_file(directory.planned(), mark.dump() + "\n");
}

std::optional<PlannedFaces> planned_faces(const Job& job, const CrowdDirectory& directory,
                                          const Shard& shard) {
  std::error_code ignored;
  for (const std::filesystem::path& file : {directory.planned(), directory.plan()}) {
    if (!std::filesystem::is_regular_file(file, ignored)) return std::nullopt;
  }
  const auto mark = parse_shallow_json(read_file(directory.planned()));
  if (!mark.is_object() || text_at(mark, "job") != key_of(job, directory).hex()) {
    return std::nullopt;
  }
  PlannedFaces planned;
  planned.files = files_of(mark);
  // What a shard does not read it leaves to those who gather.
  const std::size_t read = shard.whole() ? planned.files.size() : 1;
  if (planned.files.empty() ||
      !std::all_of(
          planned.files.begin(), planned.files.begin() + static_cast<std::ptrdiff_t>(read),
          [&](const auto& file) { return holds(directory.root / file.name, file.content); })) {
    return std::nullopt;
  }
  planned.faces = read_faces(job, directory.plan(), shard);
  return planned;
}

Cast cast_as_planned(const Job& job, const CrowdDirectory& directory, const Prepared& prepared,
                     std::vector<CastFace> crowd) {
  const FaceSpace space = casting_space(job.config, job.inputs, prepared).space;
  const Casting casting = casting_of(job.config, job.inputs, space.head_distances());
  Cast cast;
  cast.anchors = casting.anchors;
  cast.crowd = std::move(crowd);
  cast.kinds = schedule_kinds(casting, casting.count);
  cast.founders = read_founders(job, directory);
  if (job.config.output.contact_sheet) {
    cast.points.resize(cast.crowd.size());
    constexpr std::size_t kBlock = 64;
    parallel_for_each(cast.crowd.size(), kBlock,
                      [&](std::size_t i) { cast.points[i] = space.point(cast.crowd[i].recipe); });
  }
  return cast;
}

}  // namespace crowdface
