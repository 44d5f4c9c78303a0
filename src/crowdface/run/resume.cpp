// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/resume.h"

#include <algorithm>
#include <utility>

#include "crowdface/core/append_file.h"
#include "crowdface/core/error.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/run/mesh_encoder.h"

namespace crowdface {

namespace fs = std::filesystem;

FaceProgress find_done_faces(const FaceLedger& ledger, const std::vector<FacePlan>& crowd,
                             const Shard& shard, const std::function<void()>& on_checked_face) {
  FaceProgress so_far;
  so_far.faces.resize(crowd.size());
  std::vector<char> missing(crowd.size(), 0);
  parallel_for_each(crowd.size(), [&](std::size_t i) {
    throw_if_interrupted();
    if (!shard.owns(i)) return;
    if (auto result = ledger.recorded_result(crowd[i])) {
      so_far.faces[i] = std::move(*result);
    } else {
      missing[i] = 1;
    }
    if (on_checked_face) on_checked_face();
  });
  for (std::size_t i = 0; i < crowd.size(); ++i) {
    if (shard.owns(i)) ++so_far.shard_face_count;
    if (missing[i] != 0) so_far.missing_faces.push_back(i);
  }
  return so_far;
}

void require_all_faces(const CrowdDirectory& directory, const std::vector<FacePlan>& crowd,
                       const std::vector<std::size_t>& missing_faces) {
  if (missing_faces.empty()) return;
  constexpr std::size_t kNamed = 8;
  std::vector<std::string> names;
  for (const std::size_t i : missing_faces) {
    if (names.size() == kNamed) {
      names.emplace_back("…");
      break;
    }
    names.push_back(concat(crowd[i].id, " (number ", i + 1, " of the plan)"));
  }
  throw MissingInput(concat(directory.root.string(), ": ", missing_faces.size(), " of ",
                            crowd.size(), " faces are missing or altered: ", join(names),
                            "; run their shards again, or generate without --shard"));
}

void write_shared_files(const Config& config, const Inputs& inputs, const CrowdDirectory& directory,
                        Ledger& ledger) {
  for (const MeshFormat format : config.output.meshes) {
    const auto shared = shared_files(format, config, inputs);
    if (!shared || ledger.find_verified(shared->ledger_item, shared->key)) continue;
    std::vector<std::string> names;
    for (const fs::path& file : shared->write(directory.meshes())) {
      names.push_back(directory.relative(file));
    }
    ledger.record(shared->ledger_item, shared->key, names);
  }
}

std::vector<fs::path> relevant_ledgers(const CrowdDirectory& directory, const Shard& shard) {
  std::vector<fs::path> ledgers = directory.ledgers();
  if (shard.is_whole_crowd()) return ledgers;
  const std::string same_count = concat("of", shard.count, ".jsonl");
  std::erase_if(ledgers, [&](const fs::path& path) {
    return path != directory.ledger(shard) && path.filename().string().ends_with(same_count);
  });
  return ledgers;
}

void remove_shard_files(const CrowdDirectory& directory) {
  for (const fs::path& path : directory.progress_files()) remove_if_exists(path);
  remove_if_exists(directory.plan_marker());
}

void gather_logs(const CrowdDirectory& directory) {
  for (const fs::path& log : directory.shard_logs()) {
    AppendFile(directory.log()).append(read_file(log));
    remove_if_exists(log);
  }
}

}  // namespace crowdface
