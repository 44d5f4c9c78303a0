// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/read_heads.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/log.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/progress.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/cache_folder.h"
#include "crowdface/heads/seen_files.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

bool by_digest(const Digest& a, const Digest& b) {
  return std::pair(a.high, a.low) < std::pair(b.high, b.low);
}

/// The meshes of the heads read so far, each once.
class MeshShelf {
 public:
  explicit MeshShelf(const fs::path& cache) : cache_(cache) {}

  /// \return null if neither we nor the cache have it. \throws InvalidInput of the cache's entry.
  std::shared_ptr<HeadMesh> find(const Digest& digest) {
    const std::lock_guard lock(mutex_);
    const auto known = meshes_.find(digest);
    if (known != meshes_.end()) return known->second;
    auto kept = find_mesh(cache_, digest);
    if (!kept) return nullptr;
    return meshes_[digest] = std::make_shared<HeadMesh>(std::move(*kept));
  }

  /// Whether nobody has asked this of a text's mesh: then it is the caller's to read it.
  bool is_first(const Digest& outline) {
    const std::lock_guard lock(mutex_);
    return of_outline_.emplace(outline, Known()).second;
  }
  /// \param outline  of the text that the mesh was read from
  void put(const Digest& outline, HeadMesh mesh, HeadFile& head) {
    head.mesh_digest = mesh.digest();
    const std::lock_guard lock(mutex_);
    auto& place = meshes_[head.mesh_digest];
    if (!place) place = std::make_shared<HeadMesh>(std::move(mesh));
    head.mesh = place;
    of_outline_[outline] = {head.mesh_digest, place};
  }
  /// The mesh that was read from another text with this outline; nothing if there is none.
  void take(const Digest& outline, HeadFile& head) {
    const std::lock_guard lock(mutex_);
    const Known& known = of_outline_[outline];
    head.mesh_digest = known.digest;
    head.mesh = known.mesh;
  }

 private:
  struct Known {
    Digest digest;
    std::shared_ptr<HeadMesh> mesh;
  };

  const fs::path& cache_;
  std::mutex mutex_;
  std::map<Digest, std::shared_ptr<HeadMesh>, decltype(&by_digest)> meshes_{by_digest};
  std::map<Digest, Known, decltype(&by_digest)> of_outline_{by_digest};
};

bool fits(const ObjFile& head, const HeadMesh& mesh) {
  const Index faces = mesh.topology.face_count();
  const auto within = [&](const std::vector<MaterialRange>& ranges) {
    return ranges.empty() || (ranges.front().first_face >= 0 && ranges.back().first_face <= faces);
  };
  return head.positions.rows() == mesh.topology.vertex_count && within(head.materials) &&
         within(head.groups);
}

bool is_worth_keeping(const ObjFile& file) {
  return file.file.bytes().size() >= kLeastKeptBytes;
}

/// Fills in what the cache knows of a head. \return false if it does not.
bool read_from_cache(HeadFile& head, const fs::path& cache, MeshShelf& shelf) {
  try {
    const auto mesh = find_head(cache, head.text, head.file);
    if (!mesh) return false;
    head.mesh_digest = *mesh;
    head.mesh = shelf.find(*mesh);
    if (!head.mesh || fits(head.file, *head.mesh)) return head.mesh != nullptr;
    refuse_file(head.file.path, "its cache entry is damaged (it is of another mesh)");
  } catch (const RecoverableError& error) {
    log_warning(concat(error.what(), "; it is made anew"));
    return false;
  }
}

/// A head that is being read.
struct HeadReading {
  HeadFile head;
  ObjOutline outline;
};

void read_with_mesh(HeadReading& reading, MeshShelf& shelf) {
  ObjFile& file = reading.head.file;
  file = read_obj(fs::path(file.path), std::move(file.file), reading.outline);
  HeadMesh mesh{std::exchange(file.topology, {}), std::move(file.uvs),
                std::exchange(file.corner_normals, {})};
  file.uvs.resize(0, 2);
  shelf.put(reading.outline.mesh, std::move(mesh), reading.head);
}

/// Reads all but the mesh if another head has the same, which may not be there yet.
HeadReading begin_reading(const fs::path& path, const fs::path& cache, MeshShelf& shelf) {
  HeadReading reading;
  HeadFile& head = reading.head;
  head.file.path = path;
  const SeenFile seen(cache, path);
  head.file.file = MappedFile(path);
  head.text = seen.digest() ? *seen.digest() : hash_bytes(head.file.file.bytes());
  head.is_kept =
      !cache.empty() && is_worth_keeping(head.file) && read_from_cache(head, cache, shelf);
  if (head.is_kept) {
    seen.remember(head.text);
    return reading;
  }
  reading.outline = outline_obj(head.file.file.bytes());
  if (shelf.is_first(reading.outline.mesh)) {
    read_with_mesh(reading, shelf);
  } else {
    head.file = read_obj_beside(path, std::move(head.file.file), reading.outline);
    head.mesh = nullptr;
  }
  return reading;
}

/// Gives a head its mesh when that of the first that has the same is there, or could not be read.
void end_reading(HeadReading& reading, MeshShelf& shelf) {
  if (reading.head.mesh) return;
  shelf.take(reading.outline.mesh, reading.head);
  if (!reading.head.mesh) read_with_mesh(reading, shelf);
}

}  // namespace

std::vector<std::optional<HeadFile>> read_mesh_files(const std::vector<fs::path>& paths,
                                                     std::string_view what, const fs::path& cache,
                                                     Problems& problems) {
  std::vector<std::optional<HeadFile>> files(paths.size());
  std::vector<std::optional<Error>> errors(paths.size());
  MeshShelf shelf(cache);
  Progress progress(concat("reading ", what), paths.size());
  std::vector<HeadReading> readings(paths.size());
  const auto for_each_sound = [&](const auto& read) {
    parallel_for_each(paths.size(), [&](std::size_t i) {
      throw_if_interrupted();
      if (errors[i]) return;
      try {
        read(i);
      } catch (const RecoverableError& error) {
        errors[i] = error;
      }
    });
  };
  for_each_sound([&](std::size_t i) {
    readings[i] = begin_reading(paths[i], cache, shelf);
    progress.step();
  });
  for_each_sound([&](std::size_t i) {
    end_reading(readings[i], shelf);
    files[i] = std::move(readings[i].head);
  });
  for (const auto& error : errors) {
    if (error) problems.add(*error);
  }
  return files;
}

std::vector<HeadFile> read_heads(const std::vector<fs::path>& paths, const fs::path& cache,
                                 Problems& problems) {
  std::vector<HeadFile> read;
  std::size_t kept = 0;
  for (std::optional<HeadFile>& head : read_mesh_files(paths, "heads", cache, problems)) {
    if (!head) continue;
    kept += head->is_kept ? 1U : 0U;
    read.push_back(std::move(*head));
  }
  if (kept > 0)
    log_info(concat(kept, " of ", paths.size(), " heads came from the cache as they were read"));
  return read;
}

Positions read_positions(const fs::path& file, const Topology& topology, std::string_view others) {
  ObjFile mesh = read_obj(file);
  const std::string difference = first_difference(topology, mesh.topology);
  if (difference.empty()) return std::move(mesh.positions);
  refuse_file(file, concat("not the same mesh as ", others, ": ", difference));
}

void keep_heads(const std::vector<HeadFile>& heads, const fs::path& cache) {
  if (cache.empty()) return;
  try {
    std::vector<Digest> meshes;
    std::vector<const HeadFile*> lacking;
    for (const HeadFile& head : heads) {
      if (head.is_kept || !is_worth_keeping(head.file)) continue;
      lacking.push_back(&head);
      if (std::ranges::find(meshes, head.mesh_digest) != meshes.end()) continue;
      meshes.push_back(head.mesh_digest);
      keep_mesh(cache, *head.mesh);
    }
    parallel_for_each(lacking.size(), [&](std::size_t i) {
      keep_head(cache, lacking[i]->text, lacking[i]->mesh_digest, lacking[i]->file);
    });
  } catch (const RecoverableError& error) {
    log_warning(concat("heads that were read cannot be kept: ", error.what()));
  }
}

}  // namespace crowdface
