// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/common_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <string>
#include <utility>

#include "crowdface/core/log.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/io/mesh_as_obj.h"
#include "crowdface/io/obj_colours.h"
#include "crowdface/mesh/alignment.h"
#include "crowdface/mesh/all_columns.h"
#include "crowdface/mesh/disjoint_sets.h"
#include "crowdface/mesh/joined_borders.h"
#include "crowdface/mesh/same_graph.h"

namespace crowdface {
namespace {

using Vertices = std::vector<std::uint32_t>;

constexpr double kUvTolerance = 1e-4;

/// Distance below which two vertices have the same position.
double position_tolerance(const Positions& positions) {
  constexpr double kOfSize = 1e-6;
  return kOfSize * (positions.colwise().maxCoeff() - positions.colwise().minCoeff()).norm();
}

/// The range of texture coordinates at each vertex: minimum u and v, then maximum u and v. Two
/// heads with different texture layouts have different ranges.
std::vector<std::array<double, 4>> uv_bounds(const Topology& topology,
                                             const TextureCoordinates& uvs) {
  constexpr double kFar = std::numeric_limits<double>::max();
  std::vector<std::array<double, 4>> bounds(static_cast<std::size_t>(topology.vertex_count),
                                            {kFar, kFar, -kFar, -kFar});
  for (std::size_t c = 0; c < topology.corner_uvs.size(); ++c) {
    if (topology.corner_uvs[c] == kNoIndex) continue;
    std::array<double, 4>& of = bounds[topology.corner_vertices[c]];
    for (Index k = 0; k < 2; ++k) {
      const double uv = uvs(topology.corner_uvs[c], k);
      const auto at = static_cast<std::size_t>(k);
      of[at] = std::min(of[at], uv);
      of[at + 2] = std::max(of[at + 2], uv);
    }
  }
  return bounds;
}

/// Matches the vertices of two heads by their texture coordinates, and vertices with equal texture
/// coordinates by their positions. The polygons may be cut into triangles along different
/// diagonals.
std::optional<Vertices> match_vertices_by_uvs(const HeadFile& first, const Topology& found,
                                              const TextureCoordinates& uvs,
                                              const Positions& positions) {
  const Topology& expected = first.mesh->topology;
  if (uvs.rows() == 0 || first.mesh->uvs.rows() == 0) return std::nullopt;
  if (found.vertex_count != expected.vertex_count) return std::nullopt;
  const auto wanted = uv_bounds(expected, first.mesh->uvs), known = uv_bounds(found, uvs);
  Vertices by_u(known.size());
  std::iota(by_u.begin(), by_u.end(), 0U);
  const auto u_of = [&](std::uint32_t v) { return known[v][0]; };
  std::ranges::sort(by_u, {}, u_of);
  constexpr std::size_t kMaxAlike = 16;  // vertices with equal texture coordinates
  std::vector<Vertices> alike(wanted.size());
  Positions from, to;  // vertices with unique texture coordinates
  std::vector<std::array<std::uint32_t, 2>> unique;
  for (std::uint32_t v = 0; v < wanted.size(); ++v) {
    const auto& uv = wanted[v];
    for (auto at = std::ranges::lower_bound(by_u, uv[0] - kUvTolerance, {}, u_of);
         at != by_u.end() && u_of(*at) <= uv[0] + kUvTolerance; ++at) {
      const bool is_alike = std::ranges::equal(
          uv, known[*at], [](double x, double y) { return std::abs(x - y) <= kUvTolerance; });
      if (is_alike) alike[v].push_back(*at);
      if (alike[v].size() > kMaxAlike) return std::nullopt;
    }
    if (alike[v].empty()) return std::nullopt;
    if (alike[v].size() == 1) unique.push_back({v, alike[v][0]});
  }
  constexpr std::size_t kMinUnique = 4;
  if (unique.size() < kMinUnique) return std::nullopt;
  from.resize(std::ssize(unique), 3);
  to.resize(std::ssize(unique), 3);
  for (Index i = 0; i < from.rows(); ++i) {
    const auto& [in_first, in_found] = unique[static_cast<std::size_t>(i)];
    from.row(i) = positions.row(in_found);
    to.row(i) = first.file.positions.row(in_first);
  }
  const Positions placed = fit_similarity(from, to, ScaleFit::kUniform).apply(positions);
  Vertices vertices, expected_of_found(wanted.size(), kNoIndex);
  for (std::uint32_t v = 0; v < wanted.size(); ++v) {
    vertices.push_back(*std::ranges::min_element(alike[v], {}, [&](std::uint32_t w) {
      return (placed.row(w) - first.file.positions.row(v)).squaredNorm();
    }));
    if (std::exchange(expected_of_found[vertices[v]], v) != kNoIndex) return std::nullopt;
  }
  Topology renumbered = found;
  for (std::uint32_t& vertex : renumbered.corner_vertices) vertex = expected_of_found[vertex];
  if (!has_same_polygons(expected, renumbered)) return std::nullopt;
  return vertices;
}

/// Whether each pair of matching vertices of two meshes has the same texture coordinates. The
/// function compares the ranges of the corners' coordinates at both vertices (see uv_bounds). True
/// if one of the meshes has no texture coordinates.
/// \param vertices  the vertex of `found` for each vertex of `first`
bool has_same_uvs(const HeadMesh& first, const Topology& found, const TextureCoordinates& uvs,
                  const Vertices& vertices) {
  if (uvs.rows() == 0 || first.uvs.rows() == 0) return true;
  const auto expected = uv_bounds(first.topology, first.uvs), others = uv_bounds(found, uvs);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    for (std::size_t k = 0; k < 4; ++k) {
      if (!(std::abs(expected[v][k] - others[vertices[v]][k]) <= kUvTolerance) &&
          expected[v][k] != others[vertices[v]][k]) {
        return false;
      }
    }
  }
  return true;
}

bool has_same_corner_uvs(const HeadMesh& first, const HeadMesh& found) {
  if (found.uvs.rows() == 0 || first.uvs.rows() == 0) return true;
  const Vertices &expected = first.topology.corner_uvs, &others = found.topology.corner_uvs;
  for (std::size_t c = 0; c < expected.size(); ++c) {
    if (expected[c] == kNoIndex && others[c] == kNoIndex) continue;
    if (expected[c] == kNoIndex || others[c] == kNoIndex) return false;
    const auto off = first.uvs.row(expected[c]) - found.uvs.row(others[c]);
    if (!(off.cwiseAbs().maxCoeff() <= kUvTolerance)) return false;
  }
  return true;
}

/// The vertices of a head ("this head"), matched to the vertices of the first head.
struct VertexMatch {
  Vertices vertices;  ///< for each vertex of the first head: the matching vertex of this head
  /// whether the texture coordinates of this head differ from the first head's
  bool has_own_uvs = false;
};

/// Matches the vertices of `head` to the vertices of the first head: by their polygons, by the
/// graph of the edges, or by their texture coordinates. If `head` has more vertices than the first
/// head, the function joins the vertices of `head` at seams before. The polygons of `head` may be
/// the first head's polygons cut into triangles.
std::optional<VertexMatch> match_graphs(const HeadFile& first, const HeadFile& head) {
  const Topology& expected = first.mesh->topology;
  Topology found = head.mesh->topology;
  Positions positions = head.file.positions;
  Vertices copies;  // first copy of each joined vertex
  if (found.vertex_count > expected.vertex_count) {
    JoinedBorders by = joined_borders(found, positions);
    copies = std::move(by.first_copy_of_joined_vertex);
    if (std::ssize(copies) != expected.vertex_count) return std::nullopt;
    for (std::uint32_t& vertex : found.corner_vertices) vertex = by.joined_vertex_of_vertex[vertex];
    found.vertex_count = expected.vertex_count;
    positions = Positions(positions(copies, kAllColumns));
  }
  const Positions& there = first.file.positions;
  std::optional<Vertices> vertices;
  if (has_same_polygons(expected, found)) {
    vertices.emplace(static_cast<std::size_t>(expected.vertex_count));
    std::iota(vertices->begin(), vertices->end(), 0U);
  } else {
    vertices = match_graphs(expected, there, found, positions);
  }
  for (std::uint32_t around = 0; around < 2 && !vertices; ++around) {
    vertices = match_graphs(triangulated(expected, around), there, found, positions);
  }
  if (!vertices) vertices = match_vertices_by_uvs(first, found, head.mesh->uvs, positions);
  if (!vertices || !has_same_uvs(*first.mesh, found, head.mesh->uvs, *vertices)) {
    return std::nullopt;
  }
  for (std::uint32_t& vertex : *vertices) vertex = copies.empty() ? vertex : copies[vertex];
  return VertexMatch{std::move(*vertices)};
}

/// Matches the vertices of a head with another head's mesh. Returns nothing if the head can keep
/// its mesh, or if the meshes differ by more than an export can change.
std::optional<VertexMatch> match_vertices(const HeadFile& first, const HeadFile& head) {
  const Topology &expected = first.mesh->topology, &found = head.mesh->topology;
  if (first_difference(expected, found).empty()) {
    if (head.mesh->uvs.rows() > 0 || first.mesh->uvs.rows() == 0) return std::nullopt;
    Vertices same(static_cast<std::size_t>(expected.vertex_count));
    std::iota(same.begin(), same.end(), 0U);
    return VertexMatch{std::move(same)};
  }
  auto vertices = match_vertices_by_corners(expected, found, head.file.positions);
  if (!vertices) return match_graphs(first, head);
  return VertexMatch{std::move(*vertices), !has_same_corner_uvs(*first.mesh, *head.mesh)};
}

/// Gives a head the mesh of another head.
void adopt_mesh_of(const HeadFile& other, const VertexMatch& match, HeadFile& head) {
  const std::vector<std::uint32_t>& vertices = match.vertices;
  ColourRows colours = obj_colours(head.file.file.bytes(), head.file.positions.rows());
  if (colours.rows() > 0) colours = ColourRows(colours(vertices, kAllColumns));
  head.file.positions = Positions(head.file.positions(vertices, kAllColumns));
  if (!match.has_own_uvs) {
    replace_mesh(head, other, colours);
    return;
  }
  // Let the new mesh keep this head's own texture coordinates, so that the head checks report the
  // difference.
  HeadMesh mesh = *head.mesh;
  mesh.topology.corner_vertices = other.mesh->topology.corner_vertices;
  mesh.topology.vertex_count = other.mesh->topology.vertex_count;
  head.mesh_digest = mesh.digest();
  head.mesh = std::make_shared<HeadMesh>(std::move(mesh));
}

/// Whether, on a head, all polygon corners of the same set have the same position.
bool has_one_position(DisjointSets& sets, const HeadFile& head) {
  const Topology& topology = head.mesh->topology;
  const double near = position_tolerance(head.file.positions);
  for (std::uint32_t c = 0; c < topology.corner_vertices.size(); ++c) {
    const std::uint32_t vertex = topology.corner_vertices[c];
    const std::uint32_t other = topology.corner_vertices[sets.root(c)];
    if (vertex == other) continue;
    if (!((head.file.positions.row(vertex) - head.file.positions.row(other)).norm() <= near)) {
      return false;
    }
  }
  return true;
}

void join_corners_of_vertices(const Topology& topology, DisjointSets& sets) {
  Vertices first(static_cast<std::size_t>(topology.vertex_count), kNoIndex);
  for (std::uint32_t c = 0; c < topology.corner_vertices.size(); ++c) {
    std::uint32_t& corner = first[topology.corner_vertices[c]];
    if (corner == kNoIndex) corner = c;
    sets.join(corner, c);
  }
}

/// Number of vertices that have polygons.
Index used_vertex_count(const Topology& topology) {
  std::vector<bool> used(static_cast<std::size_t>(topology.vertex_count), false);
  for (const std::uint32_t vertex : topology.corner_vertices) used[vertex] = true;
  return std::ranges::count(used, true);
}

/// Makes a head with the polygons of `head`, in which corners with the same number in `vertices`
/// share a vertex. The result has no positions.
/// \param vertices  one number per corner; the function renumbers the vertices in the order of the
///                  corners
HeadFile with_vertices(const HeadFile& head, Vertices vertices) {
  std::map<std::uint32_t, std::uint32_t> numbers;
  for (std::uint32_t& vertex : vertices) {
    vertex = numbers.try_emplace(vertex, static_cast<std::uint32_t>(numbers.size())).first->second;
  }
  HeadFile made;
  made.file.path = head.file.path;
  made.file.materials = head.file.materials;
  made.mesh = std::make_shared<HeadMesh>(*head.mesh);
  made.mesh->topology.vertex_count = std::ssize(numbers);
  made.mesh->topology.corner_vertices = std::move(vertices);
  made.mesh_digest = made.mesh->digest();
  return made;
}

/// Finds the mesh in which no vertices are split, for heads whose files may contain one vertex
/// several times. Two polygon corners share a vertex of this mesh if they share a vertex in at
/// least one head and have equal positions in every head.
/// \param heads  heads with the same polygons, whose vertices the reader has not joined
/// \param made   receives a head with this mesh if none of `heads` has the mesh
/// \return one of `heads` that has this mesh, or else `made`
const HeadFile& find_whole_mesh(const std::vector<const HeadFile*>& heads, HeadFile& made) {
  DisjointSets sets(heads[0]->mesh->topology.corner_vertices.size());
  std::vector<const HeadFile*> united;
  for (const HeadFile* head : heads) {
    const auto has_mesh = [&](const HeadFile* other) { return other->mesh == head->mesh; };
    const bool is_known = std::ranges::any_of(united, has_mesh);
    DisjointSets joined = sets;
    if (!is_known) join_corners_of_vertices(head->mesh->topology, joined);
    const auto fits = [&](const HeadFile* other) { return has_one_position(joined, *other); };
    if (!fits(head) || (!is_known && !std::ranges::all_of(united, fits))) continue;
    sets = std::move(joined);
    united.push_back(head);
  }
  Vertices roots;
  for (std::uint32_t c = 0; c < heads[0]->mesh->topology.corner_vertices.size(); ++c) {
    roots.push_back(sets.root(c));
  }
  made = with_vertices(*heads[0], std::move(roots));
  for (const HeadFile* head : united) {
    if (used_vertex_count(head->mesh->topology) == made.mesh->topology.vertex_count) return *head;
  }
  return made;
}

/// Finds the common mesh of heads from formats whose reader joins all vertices at the same
/// position. If vertices touch in one head but are separate in another head, they are separate in
/// the common mesh: two corners share a vertex of it only if they have the same position in every
/// head. If the common mesh has over 2 % more vertices than the head with most vertices, the meshes
/// really differ; then the result is the first head.
/// \param heads  heads with the same polygons
/// \param made   receives the common mesh if no head has this mesh. This happens if each head joins
///               some vertices that are separate in another head.
/// \return a head with the common mesh, or the first head
const HeadFile& find_separate_mesh(const std::vector<const HeadFile*>& heads, HeadFile& made) {
  constexpr double kMaxTouching = 0.02;  // fraction of vertices; different meshes exceed it
  Vertices vertices = heads[0]->mesh->topology.corner_vertices;
  std::size_t count = 0;
  const HeadFile* most = heads[0];
  for (const HeadFile* head : heads) {
    // Skip a head with the first head's polygons but with other diagonals: its corners do not
    // correspond to the first head's corners.
    const bool has_first = head->mesh == heads[0]->mesh;
    if (!has_first && has_same_polygons(heads[0]->mesh->topology, head->mesh->topology)) continue;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> numbers;
    for (std::size_t c = 0; c < vertices.size(); ++c) {
      const std::pair key(vertices[c], head->mesh->topology.corner_vertices[c]);
      vertices[c] =
          numbers.try_emplace(key, static_cast<std::uint32_t>(numbers.size())).first->second;
    }
    count = numbers.size();
    if (head->mesh->topology.vertex_count > most->mesh->topology.vertex_count) most = head;
  }
  const auto known = static_cast<std::size_t>(most->mesh->topology.vertex_count);
  if (count <= known) return *most;
  if (static_cast<double>(count - known) > kMaxTouching * static_cast<double>(known)) {
    return *heads[0];
  }
  made = with_vertices(*heads[0], std::move(vertices));
  return made;
}

/// Returns the largest set of heads whose polygons have the same numbers of corners in the same
/// order. If several sets are equally large, returns the set with the lowest-numbered head. If some
/// of these heads have texture coordinates, the others are left out. A head with the most frequent
/// mesh comes first.
std::vector<const HeadFile*> heads_like_most(const std::vector<HeadFile>& heads) {
  std::vector<std::vector<const HeadFile*>> kinds;
  for (const HeadFile& head : heads) {
    const auto same = std::ranges::find_if(kinds, [&](const auto& kind) {
      return kind[0]->mesh->topology.face_offsets == head.mesh->topology.face_offsets;
    });
    if (same == kinds.end()) {
      kinds.push_back({&head});
    } else {
      same->push_back(&head);
    }
  }
  std::vector<const HeadFile*> most =
      *std::ranges::max_element(kinds, {}, [](const auto& kind) { return kind.size(); });
  const auto has_no_uvs = [](const HeadFile* head) { return head->mesh->uvs.rows() == 0; };
  if (!std::ranges::all_of(most, has_no_uvs)) std::erase_if(most, has_no_uvs);
  const auto frequency = [&](const HeadFile* head) {
    return std::ranges::count(most, head->mesh, [](const HeadFile* other) { return other->mesh; });
  };
  const auto usual = std::ranges::max_element(most, {}, frequency);
  std::rotate(most.begin(), usual, most.end());
  return most;
}

/// Finds the common mesh that `convert_to_common_mesh` gives to the heads.
/// \param made  receives the common mesh if no head has this mesh
/// \return a head that has the common mesh, or `made`
const HeadFile& find_common_mesh(const std::vector<HeadFile>& heads, HeadFile& made) {
  const auto has_first = [&](const HeadFile& head) { return head.mesh == heads[0].mesh; };
  if (std::ranges::all_of(heads, has_first)) return heads[0];
  std::vector<const HeadFile*> read, joined;
  for (const HeadFile* head : heads_like_most(heads)) {
    (head->has_joined_vertices ? joined : read).push_back(head);
  }
  return read.empty() ? find_separate_mesh(joined, made) : find_whole_mesh(read, made);
}

/// A message that says how the export of a head changed the vertices; empty if nothing changed.
std::string describe_vertex_change(const HeadFile& head, const Vertices& vertices) {
  const auto found = static_cast<std::size_t>(head.file.positions.rows());
  if (found > vertices.size()) {
    return concat(found - vertices.size(), " of its vertices are copies at seams; they are joined");
  }
  if (found < vertices.size()) {
    return concat(vertices.size() - found,
                  " of its vertices were joined where they touch; they are separated");
  }
  std::size_t moved = 0;
  for (std::size_t v = 0; v < vertices.size(); ++v) moved += vertices[v] != v ? 1U : 0U;
  if (moved == 0) return {};
  return concat(moved, " of its vertices are in another order; they were reordered");
}

}  // namespace

void replace_mesh(HeadFile& head, const HeadFile& mesh_source, const ColourRows& colours) {
  FileMesh mesh;
  mesh.topology = mesh_source.mesh->topology;
  mesh.uvs = mesh_source.mesh->uvs;
  // If the head has several materials, only the file of `mesh_source` tells the material of each
  // polygon of the new mesh.
  mesh.materials =
      head.file.materials.size() == 1 ? head.file.materials : mesh_source.file.materials;
  mesh.positions = head.file.positions;
  mesh.colours = colour_fractions(colours);
  const std::vector<std::string>& libraries = head.file.material_libraries;
  ObjFile file = convert_to_obj(std::move(mesh), head.file.path,
                                libraries.empty() ? std::string() : libraries[0]);
  file.positions = std::move(head.file.positions);
  file.material_libraries = std::move(head.file.material_libraries);
  file.material_base = std::move(head.file.material_base);
  file.notes = std::move(head.file.notes);
  file.topology = {};
  file.uvs.resize(0, 2);
  head.file = std::move(file);
  head.mesh = mesh_source.mesh;
  head.mesh_digest = mesh_source.mesh_digest;
}

std::optional<std::vector<std::uint32_t>> match_vertices_by_corners(
    const Topology& expected, const Topology& found, const Positions& found_positions) {
  if (expected.face_offsets != found.face_offsets) return std::nullopt;
  const double near = position_tolerance(found_positions);
  Vertices vertices(static_cast<std::size_t>(expected.vertex_count), kNoIndex);
  std::vector<bool> has_corner(static_cast<std::size_t>(found.vertex_count), false);
  for (std::size_t c = 0; c < expected.corner_vertices.size(); ++c) {
    std::uint32_t& vertex = vertices[expected.corner_vertices[c]];
    const std::uint32_t other = found.corner_vertices[c];
    has_corner[other] = true;
    if (vertex == kNoIndex) vertex = other;
    if (vertex != other &&
        !((found_positions.row(vertex) - found_positions.row(other)).norm() <= near)) {
      return std::nullopt;
    }
  }
  // Vertices without a polygon cannot be matched by polygons. Match the n-th such vertex of one
  // mesh with the n-th such vertex of the other mesh.
  std::uint32_t isolated = 0;
  for (std::uint32_t& vertex : vertices) {
    if (vertex != kNoIndex) continue;
    while (isolated < has_corner.size() && has_corner[isolated]) ++isolated;
    if (isolated == has_corner.size()) return std::nullopt;
    vertex = isolated++;
  }
  while (isolated < has_corner.size() && has_corner[isolated]) ++isolated;
  if (isolated < has_corner.size()) return std::nullopt;
  return vertices;
}

void convert_to_common_mesh(std::vector<HeadFile>& heads) {
  HeadFile made;
  const HeadFile& common = find_common_mesh(heads, made);
  std::vector<std::string> changes(heads.size());
  parallel_for_each(heads.size(), [&](std::size_t h) {
    HeadFile& head = heads[h];
    if (head.mesh == common.mesh) return;
    const auto match = match_vertices(common, head);
    if (!match) return;
    changes[h] = describe_vertex_change(head, match->vertices);
    adopt_mesh_of(common, *match, head);
  });
  const std::string others = &common == &made ? "" : " as in " + common.file.path.string();
  for (std::size_t h = 0; h < heads.size(); ++h) {
    if (changes[h].empty()) continue;
    log_warning(concat(heads[h].file.path.string(), ": ", changes[h], others));
  }
}

}  // namespace crowdface
