// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/planned.h"

#include <algorithm>
#include <system_error>

#include "crowdface/core/file.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/text.h"
#include "crowdface/core/version.h"
#include "crowdface/io/shallow_json.h"

namespace crowdface {
namespace {

/// Of all that a plan follows from.
Digest key_of(const Job& job, const CrowdDirectory& directory) {
  Hasher hasher;
  hasher.add(kVersion).add(config_in_folder(job.config, directory)).add(job.settings);
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

}  // namespace

void mark_planned(const Job& job, const CrowdDirectory& directory) {
  nlohmann::ordered_json files = nlohmann::ordered_json::array();
  for (const std::filesystem::path& file :
       {directory.plan(), directory.table(), directory.founders(), directory.rejected(),
        directory.casting()}) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) continue;
    const FileDigest content = hash_file(file);
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
  const MappedFile file(directory.plan());
  const std::string_view plan = file.bytes();
  if (planned.files.empty() || planned.files.front().content.digest != hash_bytes(plan)) {
    return std::nullopt;
  }
  std::size_t place = 0;
  for (std::size_t begin = 0; begin < plan.size(); ++place) {
    const std::size_t end = std::min(plan.find('\n', begin), plan.size());
    if (shard.owns(place)) {
      throw_if_interrupted();
      planned.faces.push_back(parse_recipe(plan.substr(begin, end - begin), job.names,
                                           concat(directory.plan().string(), ":", place + 1))
                                  .face);
    }
    begin = end + 1;
  }
  return planned;
}

}  // namespace crowdface
