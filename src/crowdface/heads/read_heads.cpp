// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/read_heads.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/file_descriptor.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/log.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/progress.h"
#include "crowdface/core/scratch_folder.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/cached.h"
#include "crowdface/heads/common_mesh.h"
#include "crowdface/heads/file_fingerprint.h"
#include "crowdface/io/mesh_as_obj.h"
#include "crowdface/io/mesh_textures.h"
#include "crowdface/io/obj_colours.h"
#include "crowdface/io/outward_polygons.h"
#include "crowdface/io/read_mesh.h"
#include "crowdface/mesh/all_columns.h"
#include "crowdface/mesh/winding.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

bool by_digest(const Digest& a, const Digest& b) {
  return std::pair(a.high, a.low) < std::pair(b.high, b.low);
}

/// Meshes of the heads read so far; heads with equal meshes share one object. Thread-safe.
class SharedMeshes {
 public:
  SharedMeshes(const CacheFolder& cache, Winding winding) : cache_(cache), winding_(winding) {}
  Winding winding() const { return winding_; }

  /// \return the mesh from memory or the cache; null if neither memory nor cache has the mesh.
  std::shared_ptr<HeadMesh> find(const Digest& digest) {
    const std::lock_guard lock(mutex_);
    const auto known = meshes_.find(digest);
    if (known != meshes_.end()) return known->second;
    auto kept = find_mesh(cache_, digest);
    if (!kept) return nullptr;
    return meshes_[digest] = std::make_shared<HeadMesh>(std::move(*kept));
  }

  /// Returns true for the first caller with this hash. This caller must then read the mesh.
  /// \param summary  hash of the text that describes the mesh
  bool is_first(const Digest& summary) {
    const std::lock_guard lock(mutex_);
    return of_summary_.emplace(summary, Known()).second;
  }
  /// Stores the mesh that was read from a head's file, and sets the head's mesh to it.
  /// \param summary  hash of the text that describes the mesh
  void put(const Digest& summary, HeadMesh mesh, HeadFile& head) {
    head.mesh_digest = mesh.digest();
    const std::lock_guard lock(mutex_);
    auto& place = meshes_[head.mesh_digest];
    if (!place) place = std::make_shared<HeadMesh>(std::move(mesh));
    head.mesh = place;
    if (!head.file.is_mended) of_summary_[summary] = {head.mesh_digest, place};
  }
  /// Sets the head's mesh to the mesh that was read from another file with the same `summary`. Sets
  /// the mesh to null if there is no such mesh, or if the other file had to be repaired.
  /// \param summary  hash of the text that describes the mesh
  void reuse_mesh(const Digest& summary, HeadFile& head) {
    const std::lock_guard lock(mutex_);
    const Known& known = of_summary_[summary];
    head.mesh_digest = known.digest;
    head.mesh = known.mesh;
  }

 private:
  struct Known {
    Digest digest;
    std::shared_ptr<HeadMesh> mesh;
  };

  const CacheFolder& cache_;
  Winding winding_;
  std::mutex mutex_;
  std::map<Digest, std::shared_ptr<HeadMesh>, decltype(&by_digest)> meshes_{by_digest};
  std::map<Digest, Known, decltype(&by_digest)> of_summary_{by_digest};
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
  return file.notes.empty() && !file.is_mended && file.file.bytes().size() >= kMinCachedBytes;
}

/// Turns the polygons of mirrored heads back to the winding in the file, so that the alignment
/// check reports these heads. A head counts as mirrored if reading has reversed its polygons, and
/// if its polygons in the file equal the polygons of another head.
void restore_mirrored(std::vector<std::optional<HeadFile>>& files) {
  for (std::optional<HeadFile>& head : files) {
    if (!head || !head->mesh || !head->file.has_reversed_faces) continue;
    Topology as_read = head->mesh->topology;
    reverse_faces(as_read);
    const auto other = std::ranges::find_if(files, [&](const auto& file) {
      return file && file->mesh && first_difference(file->mesh->topology, as_read).empty();
    });
    if (other == files.end()) continue;
    head->file.has_reversed_faces = false;
    replace_mesh(*head, **other, obj_colours(head->file.file.bytes(), head->file.positions.rows()));
  }
}

/// Adds a note to each head whose polygons are still reversed after restore_mirrored.
void note_reversed_polygons(std::vector<std::optional<HeadFile>>& files) {
  for (std::optional<HeadFile>& head : files) {
    if (head && head->file.has_reversed_faces) head->file.notes.emplace_back(kReversedFacesNote);
  }
}

/// Logs the readers' notes on files; identical notes are merged.
void log_notes(const std::vector<std::optional<HeadFile>>& files) {
  std::vector<std::pair<std::string, std::vector<std::string>>> notes;
  for (const std::optional<HeadFile>& head : files) {
    if (!head) continue;
    for (const std::string& note : head->file.notes) {
      auto place = std::ranges::find(notes, note, [](const auto& known) { return known.first; });
      if (place == notes.end()) place = notes.insert(notes.end(), {note, {}});
      place->second.push_back(head->file.path.string());
    }
  }
  for (auto& [note, paths] : notes) {
    constexpr std::size_t kNamed = 3;
    const std::size_t more = paths.size() - std::min(paths.size(), kNamed);
    paths.resize(std::min(paths.size(), kNamed));
    log_warning(concat(join(paths), more > 0 ? concat(" and ", more, " more") : "", ": ", note));
  }
}

/// Fills in a head and its mesh from the cache.
/// \param shared  supplies the mesh if another head has the same mesh.
/// \return false if the cache does not have the head or its mesh.
bool read_from_cache(HeadFile& head, const CacheFolder& cache, SharedMeshes& shared) {
  const auto mesh = fill_head_from_cache(cache, head.text_digest, head.file);
  if (!mesh) return false;
  head.mesh_digest = *mesh;
  head.mesh = shared.find(*mesh);
  if (!head.mesh || fits(head.file, *head.mesh)) return head.mesh != nullptr;
  warn_of_unusable_entry(InvalidInput(
      concat(head.file.path.string(), ": its cache entry is damaged (it is of another mesh)")));
  return false;
}

/// A head that is being read.
struct HeadReading {
  HeadFile head;
  ObjSummary summary;        ///< line counts and hash of the text; only for OBJ files
  fs::path unnamed_texture;  ///< see find_unnamed_texture; empty if there is none
};

/// Moves data from `read` into the head of `reading` and into the head's mesh.
void store_mesh(HeadReading& reading, ObjFile read, SharedMeshes& shared) {
  ObjFile& file = reading.head.file;
  file =
      shared.winding() == Winding::kOutward ? with_outward_faces(std::move(read)) : std::move(read);
  HeadMesh mesh{std::exchange(file.topology, {}), std::move(file.uvs),
                std::exchange(file.corner_normals, {})};
  file.uvs.resize(0, 2);
  shared.put(reading.summary.mesh_digest, std::move(mesh), reading.head);
}

void read_with_mesh(HeadReading& reading, SharedMeshes& shared) {
  ObjFile& file = reading.head.file;
  store_mesh(reading, read_obj(fs::path(file.path), std::move(file.file), reading.summary), shared);
}

/// A temporary folder outside the cache. It is removed when the program ends.
const fs::path& scratch_folder() {
  static const ScratchFolder scratch;
  return scratch.path();
}

/// Writes the textures of a mesh as image files, and a material file that names them. Afterwards,
/// the head can be treated like a head from an OBJ file. The files are written into a folder of the
/// cache, or into a scratch folder if the cache cannot be written.
/// \return the head's new ObjFile::material_base, and the name of the material file in that folder;
///         empty if there are no textures
std::pair<fs::path, std::string> store_textures(const HeadFile& head, const CacheFolder& cache,
                                                const FileMesh& mesh) {
  if (mesh.textures.empty()) return {};
  Hasher hasher;
  hasher.add(head.text_digest);
  for (const MeshTexture& texture : mesh.textures) hasher.add(texture.bytes);
  const CacheKey key{"textures", hasher.digest()};
  const fs::path stem = head.file.path.stem();
  const auto keep_in = [&](const fs::path& place) -> std::pair<fs::path, std::string> {
    const fs::path folder = cache_entry(place, key);
    std::string library = stem.string() + ".mtl";
    if (!path_exists(folder / library)) library = write_mesh_textures(mesh, folder, stem.string());
    return {folder / stem, std::move(library)};
  };
  if (cache.path.empty()) return keep_in(scratch_folder());
  try {
    return keep_in(cache);
  } catch (const RecoverableError& error) {
    log_warning(concat("textures cannot be stored in the cache: ", error.what()));
    return keep_in(scratch_folder());
  }
}

/// Reads a head from a file that is not an OBJ file. If the file has no polygons, the head gets a
/// mesh later, from give_polygons_to_point_clouds.
void read_other_format(HeadReading& reading, const CacheFolder& cache, SharedMeshes& shared) {
  ObjFile& file = reading.head.file;
  FileMesh mesh = read_mesh(file.path);
  reading.head.has_joined_vertices = join_split_vertices(mesh);
  if (mesh.topology.face_count() > 0) {
    auto [material_base, library] = store_textures(reading.head, cache, mesh);
    store_mesh(reading, convert_to_obj(std::move(mesh), fs::path(file.path), library), shared);
    file.material_base = std::move(material_base);
    return;
  }
  file.positions = std::move(mesh.positions);
  file.is_mended = true;
}

/// If an OBJ file names no material file, but an image or a material file lies beside the OBJ file,
/// adds an `mtllib` line to the text that was read. For an image, the line names the material file
/// that keep_unnamed_texture writes. The line replaces a first line that is a comment, so that
/// messages name the right lines.
void name_unnamed_texture(HeadReading& reading) {
  const HeadFile& head = reading.head;
  std::string_view text = head.file.file.bytes();
  reading.unnamed_texture = find_unnamed_texture(head.file.path, text);
  if (reading.unnamed_texture.empty()) return;
  const std::string library = is_material_file(reading.unnamed_texture)
                                  ? reading.unnamed_texture.filename().string()
                                  : head.file.path.stem().string() + ".mtl";
  if (text.starts_with('#')) text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  reading.head.file.file = MappedFile::from_text(concat("mtllib ", library, '\n', text));
}

/// Writes a material file for the image that name_unnamed_texture found beside the head's OBJ file.
void keep_unnamed_texture(HeadReading& reading, const CacheFolder& cache) {
  const fs::path& found = reading.unnamed_texture;
  if (found.empty()) return;
  ObjFile& file = reading.head.file;
  file.notes.push_back(concat("it names no material file; ", quoted(found.filename().string()),
                              " beside it is used"));
  if (is_material_file(found)) return;
  FileMesh mesh;
  mesh.materials = file.materials;
  mesh.textures = colour_textures(found, mesh.materials);
  file.material_base = store_textures(reading.head, cache, mesh).first;
}

/// Reads a head; skips the mesh if another head has the same mesh, even if that head is still being
/// read.
HeadReading begin_reading(const fs::path& path, const CacheFolder& cache, SharedMeshes& shared) {
  HeadReading reading;
  HeadFile& head = reading.head;
  head.file.path = path;
  const FileFingerprint seen(cache, path);
  head.file.file = MappedFile(path);
  head.text_digest = seen.digest() ? *seen.digest() : hash_bytes(head.file.file.bytes());
  if (is_obj(path)) {
    if (auto text = move_polypaint_to_vertices(head.file.file.bytes())) {
      head.file.file = MappedFile::from_text(std::move(*text));
    }
    name_unnamed_texture(reading);
  }
  head.is_cached = !cache.path.empty() && reading.unnamed_texture.empty() &&
                   is_worth_keeping(head.file) && read_from_cache(head, cache, shared);
  if (head.is_cached) {
    seen.remember(head.text_digest);
    return reading;
  }
  if (!is_obj(path)) {
    read_other_format(reading, cache, shared);
    return reading;
  }
  reading.summary = summarise_obj(head.file.file.bytes());
  if (shared.is_first(reading.summary.mesh_digest)) {
    read_with_mesh(reading, shared);
  } else {
    ObjFile file = read_obj_of_known_mesh(path, std::move(head.file.file), reading.summary);
    if (file.is_mended) {
      store_mesh(reading, std::move(file), shared);
    } else {
      head.file = std::move(file);
    }
  }
  return reading;
}

/// Gives a head the mesh that was read for the first head with the same hash. If that first head
/// could not be read, reads the mesh from this head's file.
void finish_reading(HeadReading& reading, const CacheFolder& cache, SharedMeshes& shared) {
  if (!reading.head.mesh && !reading.head.file.is_mended) {
    shared.reuse_mesh(reading.summary.mesh_digest, reading.head);
    if (!reading.head.mesh) read_with_mesh(reading, shared);
  }
  keep_unnamed_texture(reading, cache);
}

/// Gives heads without polygons the polygons of the first mesh that has the same number of
/// vertices.
void give_polygons_to_point_clouds(std::vector<std::optional<HeadFile>>& files,
                                   std::vector<std::optional<Error>>& errors) {
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (!files[i] || files[i]->mesh) continue;
    const auto other = std::ranges::find_if(files, [&](const auto& file) {
      return file && file->mesh && file->file.positions.rows() == files[i]->file.positions.rows();
    });
    if (other != files.end()) {
      replace_mesh(*files[i], **other);
      continue;
    }
    errors[i] = InvalidInput(concat(
        files[i]->file.path.string(), ": expected a mesh, found ", files[i]->file.positions.rows(),
        " points and no face: add a mesh with the same number of vertices (OBJ), or faces.npy (n "
        "by 3 or 4) in the same folder"));
    files[i].reset();
  }
}

}  // namespace

std::vector<std::optional<HeadFile>> read_mesh_files(const std::vector<fs::path>& paths,
                                                     std::string_view what,
                                                     const CacheFolder& cache, Problems& problems,
                                                     Winding winding) {
  std::vector<std::optional<HeadFile>> files(paths.size());
  std::vector<std::optional<Error>> errors(paths.size());
  SharedMeshes shared(cache, winding);
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
    readings[i] = begin_reading(paths[i], cache, shared);
    progress.step();
  });
  for_each_sound([&](std::size_t i) {
    finish_reading(readings[i], cache, shared);
    files[i] = std::move(readings[i].head);
  });
  give_polygons_to_point_clouds(files, errors);
  for (const auto& error : errors) {
    if (error) problems.add(*error);
  }
  restore_mirrored(files);
  note_reversed_polygons(files);
  log_notes(files);
  return files;
}

std::vector<HeadFile> read_heads(const std::vector<fs::path>& paths, const CacheFolder& cache,
                                 Problems& problems) {
  std::vector<HeadFile> read;
  std::size_t kept = 0;
  for (std::optional<HeadFile>& head : read_mesh_files(paths, "heads", cache, problems)) {
    if (!head) continue;
    kept += head->is_cached ? 1U : 0U;
    read.push_back(std::move(*head));
  }
  if (!read.empty()) convert_to_common_mesh(read);
  if (kept > 0) log_info(concat(kept, " of ", paths.size(), " heads were read from the cache"));
  return read;
}

Positions read_positions(const fs::path& file, const Topology& topology,
                         std::string_view name_of_meshes) {
  ObjFile mesh = read_mesh_as_obj(file);
  const std::string difference = first_difference(topology, mesh.topology);
  if (difference.empty()) return std::move(mesh.positions);
  if (const auto vertices = match_vertices_by_corners(topology, mesh.topology, mesh.positions)) {
    return mesh.positions(*vertices, kAllColumns);
  }
  refuse_file(file, concat("not the same mesh as ", name_of_meshes, ": ", difference));
}

void cache_heads(const std::vector<HeadFile>& heads, const fs::path& cache) {
  if (cache.empty()) return;
  try {
    std::vector<Digest> meshes;
    std::vector<const HeadFile*> lacking;
    for (const HeadFile& head : heads) {
      if (head.is_cached || !is_worth_keeping(head.file)) continue;
      lacking.push_back(&head);
      if (std::ranges::find(meshes, head.mesh_digest) != meshes.end()) continue;
      meshes.push_back(head.mesh_digest);
      cache_mesh(cache, *head.mesh);
    }
    parallel_for_each(lacking.size(), [&](std::size_t i) {
      cache_head(cache, lacking[i]->text_digest, lacking[i]->mesh_digest, lacking[i]->file);
    });
  } catch (const RecoverableError& error) {
    log_warning(concat("heads cannot be stored in the cache: ", error.what()));
  }
}

}  // namespace crowdface
