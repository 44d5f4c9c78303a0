// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/resume.h"

#include <algorithm>
#include <span>
#include <utility>

#include "crowdface/core/append_file.h"
#include "crowdface/core/contains.h"
#include "crowdface/core/error.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/io/npy.h"
#include "crowdface/run/glb_form.h"

namespace crowdface {

namespace fs = std::filesystem;

namespace {

void write_shared_arrays(const Inputs& inputs, const CrowdDirectory& directory, Ledger& ledger) {
  constexpr const char* kItem = "topology";
  const TextureCoordinates& uvs = inputs.faces.uvs;
  Hasher key;
  key.add(inputs.topology_digest)
      .add_array(std::span(inputs.faces.topology.corner_uvs))
      .add_array(std::span(uvs.data(), static_cast<std::size_t>(uvs.size())));
  std::vector<std::string> shapes;
  for (const Shape& shape : inputs.shapes.shapes) shapes.push_back(shape.name);
  for (const std::string& shape : shapes) key.add(shape);
  if (ledger.proven(kItem, key.digest())) return;
  std::vector<std::string> names;
  for (const fs::path& file :
       write_topology_arrays(inputs.faces.topology, uvs, shapes, directory.topology())) {
    names.push_back(directory.relative(file));
  }
  ledger.record(kItem, key.digest(), names);
}

/// The eyes' iris, for files that do not bring it along.
void write_iris(const Config& config, const Inputs& inputs, const CrowdDirectory& directory,
                Ledger& ledger) {
  constexpr const char* kItem = "iris";
  const GlbOptions options = glb_options(config, inputs);
  if (!options.overlay) return;
  const Digest key = Hasher().add(options.overlay->png).digest();
  if (ledger.proven(kItem, key)) return;
  const fs::path file = directory.meshes() / GlbOverlay::kFile;
  make_directories(file.parent_path());
  write_file(file, options.overlay->png);
  ledger.record(kItem, key, std::vector{directory.relative(file)});
}

}  // namespace

FacesSoFar find_done_faces(const FaceLedger& ledger, const std::vector<CastFace>& crowd,
                           const Shard& shard, const std::function<void()>& asked) {
  FacesSoFar so_far;
  so_far.faces.resize(crowd.size());
  std::vector<char> missing(crowd.size(), 0);
  parallel_for_each(crowd.size(), [&](std::size_t i) {
    throw_if_interrupted();
    if (!shard.owns(i)) return;
    if (auto result = ledger.done(crowd[i])) {
      so_far.faces[i] = std::move(*result);
    } else {
      missing[i] = 1;
    }
    if (asked) asked();
  });
  for (std::size_t i = 0; i < crowd.size(); ++i) {
    if (shard.owns(i)) ++so_far.owned;
    if (missing[i] != 0) so_far.todo.push_back(i);
  }
  return so_far;
}

void refuse_missing_faces(const CrowdDirectory& directory, const std::vector<CastFace>& crowd,
                          const std::vector<std::size_t>& todo) {
  if (todo.empty()) return;
  constexpr std::size_t kNamed = 8;
  std::vector<std::string> names;
  for (const std::size_t i : todo) {
    if (names.size() == kNamed) {
      names.emplace_back("…");
      break;
    }
    names.push_back(concat(crowd[i].id, " (number ", i + 1, " of the plan)"));
  }
  throw MissingInput(concat(directory.root.string(), ": ", todo.size(), " of ", crowd.size(),
                            " faces are missing or altered: ", join(names),
                            "; run their shards again, or generate without --shard"));
}

void write_shared_files(const Config& config, const Inputs& inputs, const CrowdDirectory& directory,
                        Ledger& ledger) {
  const std::vector<MeshFormat>& formats = config.output.meshes;
  if (contains(formats, MeshFormat::kPoints)) write_shared_arrays(inputs, directory, ledger);
  if (contains(formats, MeshFormat::kUsd)) write_iris(config, inputs, directory, ledger);
}

std::vector<fs::path> ledgers_that_matter(const CrowdDirectory& directory, const Shard& shard) {
  std::vector<fs::path> ledgers = directory.ledgers();
  if (shard.whole()) return ledgers;
  const std::string same_count = concat("of", shard.count, ".jsonl");
  std::erase_if(ledgers, [&](const fs::path& path) {
    return path != directory.ledger(shard) && path.filename().string().ends_with(same_count);
  });
  return ledgers;
}

void remove_notes_of_shards(const CrowdDirectory& directory) {
  for (const fs::path& path : directory.all_progress()) remove_if_there(path);
  remove_if_there(directory.planned());
}

void gather_logs(const CrowdDirectory& directory) {
  for (const fs::path& log : directory.shard_logs()) {
    AppendFile(directory.log()).append(read_file(log));
    remove_if_there(log);
  }
}

}  // namespace crowdface
