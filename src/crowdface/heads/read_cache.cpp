// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/read_cache.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "crowdface/core/input_limits.h"
#include "crowdface/heads/cache_folder.h"
#include "crowdface/heads/seen_files.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// Raised when the reader, `read_obj`, makes something else of a text.
constexpr std::uint32_t kVersion = 1;

/// The first 64 bytes of an entry, little-endian.
struct ReadHeader {
  char magic[8] = {'C', 'F', 'R', 'E', 'A', 'D', '\r', '\n'};
  std::uint64_t version = kVersion;
  Digest text, mesh;
  std::uint64_t vertices = 0;
  std::uint64_t reserved = 0;
};
static_assert(sizeof(ReadHeader) == 64);

struct MeshHeader {
  char magic[8] = {'C', 'F', 'M', 'E', 'S', 'H', '\r', '\n'};
  std::uint64_t version = kVersion;
  Digest mesh;
  std::uint64_t vertices = 0, faces = 0, corners = 0;
  std::uint64_t uvs = 0;
  std::uint64_t uv_corners = 0, normal_corners = 0;  ///< `corners`, or 0
  std::uint64_t reserved[6] = {};
};
static_assert(sizeof(MeshHeader) == 128);

/// Takes an entry's content apart from its beginning on.
class Content {
 public:
  Content(fs::path path, MappedEntry entry) : path_(std::move(path)), entry_(std::move(entry)) {}

  void take(void* to, std::size_t size) {
    if (size > entry_.content.size()) throw bad_entry(path_, "of the wrong size");
    if (size > 0) std::memcpy(to, entry_.content.data(), size);
    entry_.content.remove_prefix(size);
  }
  template <class T>
  T take() {
    T value;
    take(&value, sizeof value);
    return value;
  }
  /// \param count  as the entry says, which may be any number.
  template <class T>
  std::vector<T> take_list(std::uint64_t count) {
    require_room(count, sizeof(T));
    std::vector<T> list(count);
    take(list.data(), count * sizeof(T));
    return list;
  }
  template <class Rows>
  Rows take_rows(std::uint64_t count) {
    require_room(count, Rows::ColsAtCompileTime * sizeof(double));
    Rows rows(static_cast<Index>(count), Rows::ColsAtCompileTime);
    take(rows.data(), static_cast<std::size_t>(rows.size()) * sizeof(double));
    require(are_coordinates({rows.data(), static_cast<std::size_t>(rows.size())}));
    return rows;
  }
  /// Names, and from which face on each is in use.
  std::vector<MaterialRange> take_ranges() {
    std::vector<MaterialRange> ranges;
    for (auto left = take<std::uint64_t>(); left > 0; --left) {
      const auto first_face = take<std::uint64_t>(), size = take<std::uint64_t>();
      require_room(size, 1);
      ranges.push_back({std::string(size, '\0'), static_cast<Index>(first_face)});
      take(ranges.back().name.data(), size);
      require(ranges.size() < 2 || ranges.rbegin()[1].first_face <= ranges.back().first_face);
    }
    return ranges;
  }
  /// A checksum tells damage from what was written, not what was written from anything else.
  void require(bool holds) const {
    if (!holds) throw bad_entry(path_, "damaged (it holds numbers that no head has)");
  }
  void require_same(bool same) const {
    if (!same) throw bad_entry(path_, "of another version or for other data");
  }
  const Digest& sum() const { return entry_.sum; }
  void end() const {
    if (!entry_.content.empty()) throw bad_entry(path_, "of the wrong size");
    if (entry_.file->was_cut()) throw bad_entry(path_, "being cut");
  }

 private:
  void require_room(std::uint64_t count, std::size_t size) const {
    if (count > entry_.content.size() / size) throw bad_entry(path_, "of the wrong size");
  }

  fs::path path_;
  MappedEntry entry_;
};

std::optional<Content> find(const fs::path& path, const SeenFile& seen) {
  auto entry = map_entry(path, seen.digest());
  if (!entry) return std::nullopt;
  return Content(path, std::move(*entry));
}

template <class Header>
bool has_head_of(const Header& found, const Header& expected) {
  return std::equal(found.magic, found.magic + sizeof found.magic, expected.magic) &&
         found.version == expected.version && found.mesh == expected.mesh;
}

bool is_topology(const Topology& topology) {
  constexpr std::uint32_t kLeastCorners = 3;
  const auto& offsets = topology.face_offsets;
  if (offsets.front() != 0 || offsets.back() != topology.corner_vertices.size()) return false;
  for (std::size_t f = 1; f < offsets.size(); ++f) {
    if (offsets[f] < offsets[f - 1] || offsets[f] - offsets[f - 1] < kLeastCorners) return false;
  }
  return all_below(topology.corner_vertices, static_cast<std::uint64_t>(topology.vertex_count));
}

template <class Rows>
std::string_view bytes_of_rows(const Rows& rows) {
  return bytes_of(rows.data(), static_cast<std::size_t>(rows.size()) * sizeof(double));
}

void append_number(std::string& bytes, std::uint64_t number) {
  bytes += bytes_of(&number, sizeof number);
}

void append_ranges(std::string& bytes, const std::vector<MaterialRange>& ranges) {
  append_number(bytes, ranges.size());
  for (const MaterialRange& range : ranges) {
    append_number(bytes, static_cast<std::uint64_t>(range.first_face));
    append_number(bytes, range.name.size());
    bytes += range.name;
  }
}

}  // namespace

Digest HeadMesh::digest() const {
  return Hasher()
      .add(topology.vertex_count)
      .add_array(std::span(topology.corner_vertices))
      .add_array(std::span(topology.corner_uvs))
      .add_array(std::span(topology.face_offsets))
      .add_array(std::span<const double>(uvs.data(), static_cast<std::size_t>(uvs.size())))
      .add_array(std::span(corner_normals))
      .digest();
}

fs::path head_entry(const fs::path& cache, const Digest& text) {
  // A text that one limit allows may be too large for another.
  const InputLimits& limits = input_limits();
  const Digest key = Hasher().add(text).add(limits.vertices).add(limits.faces).digest();
  return cache_entry(cache, key, kReadEnding);
}

fs::path mesh_entry(const fs::path& cache, const Digest& mesh) {
  return cache_entry(cache, mesh, kMeshEnding);
}

std::optional<Digest> find_head(const CacheFolder& cache, const Digest& text, ObjFile& head) {
  const fs::path path = head_entry(cache, text);
  const SeenFile seen(cache, path);
  auto content = find(path, seen);
  if (!content) return std::nullopt;
  const auto header = content->take<ReadHeader>();
  const ReadHeader expected{.text = text, .mesh = header.mesh};
  content->require_same(has_head_of(header, expected) && header.text == text);
  head.material_libraries.clear();
  head.positions = content->take_rows<Positions>(header.vertices);
  for (MaterialRange& library : content->take_ranges()) {
    head.material_libraries.push_back(std::move(library.name));
  }
  head.materials = content->take_ranges();
  head.groups = content->take_ranges();
  content->end();
  seen.remember(content->sum());
  return header.mesh;
}

std::optional<HeadMesh> find_mesh(const CacheFolder& cache, const Digest& mesh) {
  const fs::path path = mesh_entry(cache, mesh);
  const SeenFile seen(cache, path);
  auto content = find(path, seen);
  if (!content) return std::nullopt;
  const auto header = content->take<MeshHeader>();
  content->require_same(has_head_of(header, MeshHeader{.mesh = mesh}));
  content->require(header.faces <= input_limits().faces);
  HeadMesh result;
  Topology& topology = result.topology;
  topology.vertex_count = static_cast<Index>(header.vertices);
  topology.corner_vertices = content->take_list<std::uint32_t>(header.corners);
  topology.corner_uvs = content->take_list<std::uint32_t>(header.uv_corners);
  topology.face_offsets = content->take_list<std::uint32_t>(header.faces + 1);
  result.corner_normals = content->take_list<std::uint32_t>(header.normal_corners);
  result.uvs = content->take_rows<TextureCoordinates>(header.uvs);
  for (const std::uint64_t corners : {header.uv_corners, header.normal_corners}) {
    content->require(corners == 0 || corners == header.corners);
  }
  content->require(is_topology(topology) && are_rows(topology.corner_uvs, header.uvs));
  content->end();
  content->require_same(result.digest() == mesh);
  seen.remember(content->sum());
  return result;
}

void keep_head(const fs::path& cache, const Digest& text, const Digest& mesh, const ObjFile& head) {
  const ReadHeader header{
      .text = text, .mesh = mesh, .vertices = static_cast<std::uint64_t>(head.positions.rows())};
  std::string names;
  std::vector<MaterialRange> libraries;
  for (const std::string& library : head.material_libraries) libraries.push_back({library, 0});
  append_ranges(names, libraries);
  append_ranges(names, head.materials);
  append_ranges(names, head.groups);
  write_entry(head_entry(cache, text),
              {bytes_of(&header, sizeof header), bytes_of_rows(head.positions), names});
}

void keep_mesh(const fs::path& cache, const HeadMesh& mesh) {
  const Topology& topology = mesh.topology;
  const MeshHeader header{.mesh = mesh.digest(),
                          .vertices = static_cast<std::uint64_t>(topology.vertex_count),
                          .faces = static_cast<std::uint64_t>(topology.face_count()),
                          .corners = topology.corner_vertices.size(),
                          .uvs = static_cast<std::uint64_t>(mesh.uvs.rows()),
                          .uv_corners = topology.corner_uvs.size(),
                          .normal_corners = mesh.corner_normals.size()};
  write_entry(mesh_entry(cache, header.mesh),
              {bytes_of(&header, sizeof header), bytes_of(std::span(topology.corner_vertices)),
               bytes_of(std::span(topology.corner_uvs)), bytes_of(std::span(topology.face_offsets)),
               bytes_of(std::span(mesh.corner_normals)), bytes_of_rows(mesh.uvs)});
}

}  // namespace crowdface
