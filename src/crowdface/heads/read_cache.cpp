// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/read_cache.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <utility>

#include "crowdface/core/input_limits.h"
#include "crowdface/heads/cached.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// Version of the cache entries of read heads. Increase the version if `read_obj` changes its
/// result for the same text.
constexpr std::uint32_t kVersion = 2;

bool is_topology(const Topology& topology) {
  constexpr std::uint32_t kMinCorners = 3;
  const auto& offsets = topology.face_offsets;
  if (offsets.empty() || offsets.front() != 0 || offsets.back() != topology.corner_vertices.size())
    return false;
  for (std::size_t f = 1; f < offsets.size(); ++f) {
    if (offsets[f] < offsets[f - 1] || offsets[f] - offsets[f - 1] < kMinCorners) return false;
  }
  return all_below(topology.corner_vertices, static_cast<std::uint64_t>(topology.vertex_count));
}

/// Names of material libraries, materials or groups, and the first polygon that has each name.
struct StoredNames {
  std::vector<std::uint64_t> faces, sizes;
  std::vector<std::uint8_t> names;

  void add(const std::string& name, Index face) {
    faces.push_back(static_cast<std::uint64_t>(face));
    sizes.push_back(name.size());
    names.insert(names.end(), name.begin(), name.end());
  }
  bool are_sound() const {
    std::size_t left = names.size();
    for (const std::uint64_t size : sizes) {
      if (size > left) return false;
      left -= size;
    }
    return faces.size() == sizes.size() && std::ranges::is_sorted(faces);
  }
  std::vector<MaterialRange> ranges() const {
    std::vector<MaterialRange> result;
    auto begin = names.begin();
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      const auto end = begin + static_cast<std::ptrdiff_t>(sizes[i]);
      result.push_back({std::string(begin, end), static_cast<Index>(faces[i])});
      begin = end;
    }
    return result;
  }
};

struct StoredHead {
  Digest mesh;
  Positions positions;
  StoredNames libraries, materials, groups;
};

constexpr auto kHeadArrays = [](auto& arrays, auto& head) {
  const auto names = [&](const std::string& of, auto& kept) {
    arrays(of + " faces", kept.faces);
    arrays(of + " sizes", kept.sizes);
    arrays(of + " names", kept.names);
  };
  arrays("mesh", head.mesh);
  arrays("positions", head.positions);
  names("libraries", head.libraries);
  names("materials", head.materials);
  names("groups", head.groups);
};

constexpr auto kMeshArrays = [](auto& arrays, auto& mesh) {
  arrays("vertices", mesh.topology.vertex_count);
  arrays("corner vertices", mesh.topology.corner_vertices);
  arrays("corner uvs", mesh.topology.corner_uvs);
  arrays("face offsets", mesh.topology.face_offsets);
  arrays("corner normals", mesh.corner_normals);
  arrays("uvs", mesh.uvs);
};

bool is_mesh(const HeadMesh& mesh) {
  const Topology& topology = mesh.topology;
  const auto has_all_or_none = [&](const std::vector<std::uint32_t>& rows) {
    return rows.empty() || rows.size() == topology.corner_vertices.size();
  };
  return is_topology(topology) &&
         static_cast<std::uint64_t>(topology.face_count()) <= input_limits().faces &&
         has_all_or_none(topology.corner_uvs) && has_all_or_none(mesh.corner_normals) &&
         are_indices(topology.corner_uvs, static_cast<std::uint64_t>(mesh.uvs.rows()));
}

CacheKey mesh_key(const Digest& mesh_digest) {
  return {"mesh", mesh_digest};
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

CacheKey key_of_read_head(const Digest& text_digest) {
  // The key contains the limits, because the cache may hold a file that exceeds the current limits.
  const InputLimits& limits = input_limits();
  return {kReadKind,
          Hasher().add(kVersion).add(text_digest).add(limits.vertices).add(limits.faces).digest()};
}

std::optional<Digest> fill_head_from_cache(const CacheFolder& cache, const Digest& text_digest,
                                           ObjFile& head) {
  auto kept = find_cached<StoredHead>(cache, key_of_read_head(text_digest), kHeadArrays,
                                      [](const StoredHead& found, const CacheEntry&) {
                                        return found.libraries.are_sound() &&
                                               found.materials.are_sound() &&
                                               found.groups.are_sound();
                                      });
  if (!kept) return std::nullopt;
  head.positions = std::move(kept->positions);
  head.material_libraries.clear();
  for (MaterialRange& library : kept->libraries.ranges()) {
    head.material_libraries.push_back(std::move(library.name));
  }
  head.materials = kept->materials.ranges();
  head.groups = kept->groups.ranges();
  return kept->mesh;
}

std::optional<HeadMesh> find_mesh(const CacheFolder& cache, const Digest& mesh_digest) {
  return find_cached<HeadMesh>(cache, mesh_key(mesh_digest), kMeshArrays,
                               [&](const HeadMesh& found, const CacheEntry&) {
                                 return is_mesh(found) && found.digest() == mesh_digest;
                               });
}

void cache_head(const fs::path& cache, const Digest& text_digest, const Digest& mesh_digest,
                const ObjFile& head) {
  StoredHead kept{mesh_digest, head.positions, {}, {}, {}};
  for (const std::string& library : head.material_libraries) kept.libraries.add(library, 0);
  for (const MaterialRange& range : head.materials)
    kept.materials.add(range.name, range.first_face);
  for (const MaterialRange& range : head.groups) kept.groups.add(range.name, range.first_face);
  write_entry(cache, key_of_read_head(text_digest), arrays_of(kept, kHeadArrays));
}

void cache_mesh(const fs::path& cache, const HeadMesh& mesh) {
  write_entry(cache, mesh_key(mesh.digest()), arrays_of(mesh, kMeshArrays));
}

}  // namespace crowdface
