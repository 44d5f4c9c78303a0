// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "crowdface/io/glb_container.h"
#include "crowdface/io/glb_options.h"
#include "crowdface/io/split_vertices.h"
#include "crowdface/mesh/displacements.h"

namespace crowdface {

/// A JSON array of the vector's components, rounded to single precision.
nlohmann::ordered_json vector_json(const Eigen::RowVector3d& vector);
/// Sets the properties `min` and `max` of an accessor of positions.
void set_bounds(nlohmann::ordered_json& accessor, const Positions& positions);

/// The glTF description of a material.
/// \param overlay_texture  index of the glTF texture that contains the image `GlbOptions::overlay`,
///                         such as an iris; used only if `material.uses_overlay`.
nlohmann::ordered_json material_json(const GlbMaterial& material, std::size_t overlay_texture);

/// The root node of a face, without a name. Its transform converts unit and axes. In a file with a
/// rig, this node is the parent of the joints, and the mesh has a separate node.
nlohmann::ordered_json root_node_json(const GlbOptions& options);

/// Adds an image and a texture that uses it.
/// \param view  index of the buffer view that holds the image.
void add_image(nlohmann::ordered_json& scene, std::size_t view, const std::string& name,
               const std::string& type);

/// The triangles of one material, in the order of the polygons, as indices of split vertices.
using GlbTriangles = std::vector<std::array<std::uint32_t, 3>>;
/// Groups the triangles by material.
/// \param polygon_materials  for each polygon, the index of its material; empty: all zero
std::vector<GlbTriangles> triangles_by_material(const SplitVertices& split,
                                                const std::vector<std::uint32_t>& polygon_materials,
                                                std::size_t material_count);

/// Adds morph targets to a mesh.
/// \param first  accessor of the first target's displacements; the accessors of further targets
///               follow.
void set_morph_targets(nlohmann::ordered_json& mesh, std::size_t first,
                       const std::vector<std::string>& names);

/// Writes one vector per split vertex (see `SplitVertices`) in binary: all rows of `rows`, and then
/// the rows of the vertices that were copied at seams, one row per copy.
/// \param rows  #V by 3, one vector per original vertex.
/// \param copied_vertices  for each copy, its original vertex.
void put_vectors(char* out, const Positions& rows, std::span<const std::uint32_t> copied_vertices);

/// Adds the buffer views and accessors of arrays to a glTF scene. The bytes of the arrays are
/// written elsewhere, in the same order.
class GlbBuffer {
 public:
  /// \param size  number of bytes that the buffer already has.
  GlbBuffer(nlohmann::ordered_json& scene, std::size_t size) : scene_(scene), size_(size) {}

  std::size_t size() const { return size_; }  ///< number of bytes in the buffer so far

  /// Adds a buffer view of `size` bytes at the end of the buffer.
  /// \param target  gltf::kArrayBuffer, gltf::kElementArrayBuffer, or 0 for other data.
  /// \return index of the new buffer view.
  std::size_t add_view(std::size_t size, int target = 0);

  /// Aligns the start of the next view to four bytes.
  /// \return number of padding bytes.
  std::size_t pad();

  /// Adds an accessor to the last buffer view.
  /// \param component  component type of the numbers, such as gltf::kFloat.
  /// \param type       type of an element, such as "VEC3".
  /// \param count      number of elements.
  /// \param offset     bytes from the start of the view.
  /// \return index of the new accessor.
  std::size_t add_accessor(int component, const char* type, std::size_t count,
                           std::size_t offset = 0);

  /// Adds an attribute of `count` vertices in a buffer view of its own.
  /// \param component, type  as for `add_accessor`.
  /// \return index of the new accessor.
  std::size_t add_attribute(int component, const char* type, std::size_t count);

  /// Adds one primitive and one material per group of triangles. Leaves out empty groups.
  /// \param index_counts  for each group, its number of vertex indices
  /// \param materials     one per group; empty: primitives without material
  /// \param overlay       accessor of the overlay's texture coordinates; nothing without an overlay
  /// \param overlay_texture  see `material_json`
  /// \return the primitives.
  nlohmann::ordered_json add_primitives(std::span<const std::size_t> index_counts,
                                        const nlohmann::ordered_json& attributes,
                                        std::span<const GlbMaterial> materials,
                                        std::optional<std::size_t> overlay = {},
                                        std::size_t overlay_texture = 0);

  /// Adds an accessor without data: `count` vectors that are zero.
  void add_zeros(std::size_t count);
  /// Makes the last accessor sparse, with `count` non-zero elements.
  /// \param indices, values  the buffer views that hold the elements' indices and values.
  void make_sparse(std::size_t count, std::size_t indices, std::size_t values);

  /// Writes the buffer's length to the scene.
  void finish();

 private:
  nlohmann::ordered_json& scene_;
  std::size_t size_;  ///< number of bytes in the buffer so far
};

/// The texture coordinates of all split vertices, in the binary form of the buffer: two numbers for
/// each vertex.
/// \param uvs  v upwards as in OBJ.
std::string encoded_texture_coordinates(const SplitVertices& split, const TextureCoordinates& uvs);

/// The split vertices that one glTF morph target moves, and their rows in the target's
/// displacements.
struct GlbMorphRows {
  /// one per moved split vertex: its row in the morph target's displacements
  std::vector<std::uint32_t> rows;
  std::vector<std::uint32_t> vertices;  ///< the moved split vertices, ascending
  /// whether the morph target moves every vertex of the mesh
  bool moves_all_vertices = false;
};

/// Finds the split vertices that a morph target moves.
/// \param vertices  original vertices that the morph target moves
/// \param split  for each split vertex, its original vertex
/// \param count  number of original vertices
GlbMorphRows morph_target_rows(std::span<const std::uint32_t> vertices,
                               std::span<const std::uint32_t> split, Index count);

/// Sets the minimum and maximum of a morph target's displacements. Vertices that the morph target
/// does not move have displacement zero.
void set_displacement_bounds(nlohmann::ordered_json& accessor, const Displacements& moves,
                             bool moves_all_vertices);

}  // namespace crowdface
