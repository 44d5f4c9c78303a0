// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/read_cache.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>

#include "crowdface/core/input_limits.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/cache_folder.h"

namespace crowdface {
namespace {

/// Raised when the reader, `read_obj`, makes something else of a text.
constexpr std::uint32_t kVersion = 1;

bool is_topology(const Topology& topology) {
  constexpr std::uint32_t kLeastCorners = 3;
  const auto& offsets = topology.face_offsets;
  if (offsets.empty() || offsets.front() != 0 || offsets.back() != topology.corner_vertices.size())
    return false;
  for (std::size_t f = 1; f < offsets.size(); ++f) {
    if (offsets[f] < offsets[f - 1] || offsets[f] - offsets[f - 1] < kLeastCorners) return false;
  }
  return all_below(topology.corner_vertices, static_cast<std::uint64_t>(topology.vertex_count));
}

/// Adds names, and from which face on each is in use, as three arrays.
void add_ranges(std::vector<EntryArray>& arrays, const std::string& name,
                const std::vector<MaterialRange>& ranges) {
  std::vector<std::uint64_t> faces, sizes;
  std::string names;
  for (const MaterialRange& range : ranges) {
    faces.push_back(static_cast<std::uint64_t>(range.first_face));
    sizes.push_back(range.name.size());
    names += range.name;
  }
  arrays.push_back(owned_array(name + " faces", std::move(faces)));
  arrays.push_back(owned_array(name + " sizes", std::move(sizes)));
  arrays.push_back(
      owned_array(name + " names", std::vector<std::uint8_t>(names.begin(), names.end())));
}

std::vector<MaterialRange> ranges_of(const CacheEntry& entry, const std::string& name) {
  const auto faces = entry.get<std::uint64_t>(name + " faces");
  const auto sizes = entry.get<std::uint64_t>(name + " sizes");
  auto names = entry.get<std::uint8_t>(name + " names");
  entry.require(faces.size() == sizes.size() && std::ranges::is_sorted(faces));
  std::vector<MaterialRange> ranges;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    entry.require(sizes[i] <= names.size());
    const auto own = names.first(sizes[i]);
    ranges.push_back({std::string(own.begin(), own.end()), static_cast<Index>(faces[i])});
    names = names.subspan(sizes[i]);
  }
  return ranges;
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

CacheKey read_key(const Digest& text) {
  // A text that one limit allows may be too large for another.
  const InputLimits& limits = input_limits();
  return {kReadKind,
          Hasher().add(kVersion).add(text).add(limits.vertices).add(limits.faces).digest()};
}

CacheKey mesh_key(const Digest& mesh) {
  return {"mesh", mesh};
}

Digest read_head(const CacheEntry& entry, ObjFile& head) {
  const auto [high, low] = entry.value<std::array<std::uint64_t, 2>>("mesh");
  head.positions = entry.matrix<Positions>("positions");
  head.material_libraries.clear();
  for (MaterialRange& library : ranges_of(entry, "libraries")) {
    head.material_libraries.push_back(std::move(library.name));
  }
  head.materials = ranges_of(entry, "materials");
  head.groups = ranges_of(entry, "groups");
  return {high, low};
}

HeadMesh read_mesh(const CacheEntry& entry, const Digest& mesh) {
  HeadMesh result;
  Topology& topology = result.topology;
  topology.vertex_count = static_cast<Index>(entry.value<std::uint64_t>("vertices"));
  topology.corner_vertices = entry.list<std::uint32_t>("corner vertices");
  topology.corner_uvs = entry.list<std::uint32_t>("corner uvs");
  topology.face_offsets = entry.list<std::uint32_t>("face offsets");
  result.corner_normals = entry.list<std::uint32_t>("corner normals");
  result.uvs = entry.matrix<TextureCoordinates>("uvs");
  for (const std::size_t corners : {topology.corner_uvs.size(), result.corner_normals.size()}) {
    entry.require(corners == 0 || corners == topology.corner_vertices.size());
  }
  entry.require(is_topology(topology) &&
                static_cast<std::uint64_t>(topology.face_count()) <= input_limits().faces &&
                are_rows(topology.corner_uvs, static_cast<std::uint64_t>(result.uvs.rows())) &&
                result.digest() == mesh);
  return result;
}

std::vector<EntryArray> arrays_of(const ObjFile& head, const Digest& mesh) {
  std::vector<EntryArray> arrays = {value_array("mesh", std::array{mesh.high, mesh.low}),
                                    array_of("positions", head.positions)};
  std::vector<MaterialRange> libraries;
  for (const std::string& library : head.material_libraries) libraries.push_back({library, 0});
  add_ranges(arrays, "libraries", libraries);
  add_ranges(arrays, "materials", head.materials);
  add_ranges(arrays, "groups", head.groups);
  return arrays;
}

std::vector<EntryArray> arrays_of(const HeadMesh& mesh) {
  const Topology& topology = mesh.topology;
  return {value_array("vertices", static_cast<std::uint64_t>(topology.vertex_count)),
          array_of("corner vertices", topology.corner_vertices),
          array_of("corner uvs", topology.corner_uvs),
          array_of("face offsets", topology.face_offsets),
          array_of("corner normals", mesh.corner_normals),
          array_of("uvs", mesh.uvs)};
}

}  // namespace crowdface
