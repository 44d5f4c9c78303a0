// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "crowdface/io/glb_container.h"
#include "crowdface/io/glb_options.h"
#include "crowdface/io/split_vertices.h"
#include "crowdface/mesh/displacements.h"

namespace crowdface {

/// In single precision.
nlohmann::ordered_json vector_json(const Eigen::RowVector3d& vector);

/// \param overlay  which of the file's images that is.
nlohmann::ordered_json material_json(const GlbMaterial& material, std::size_t overlay);

/// The node of a face, without a name: unit and axes. With a rig it is the joints', and the mesh has its own.
nlohmann::ordered_json node_json(const GlbOptions& options);

/// Adds a picture and the texture that shows it. \param view  that holds it.
void add_image(nlohmann::ordered_json& scene, std::size_t view, const std::string& type);

/// Gives a mesh its morph targets. \param first  the accessor of the first one's moves; others follow.
void set_targets(nlohmann::ordered_json& mesh, std::size_t first,
                 const std::vector<std::string>& names);

/// Adds arrays to a glTF buffer, one view each, and describes them.
class GlbBuffer {
 public:
  /// \param size  of the buffer so far.
  GlbBuffer(nlohmann::ordered_json& scene, std::size_t size) : scene_(scene), size_(size) {}

  std::size_t size() const { return size_; }

  /// \return which view it is.
  std::size_t add_view(std::size_t size, int target = 0);

  /// Four divides where the next view begins. \return how many bytes that takes.
  std::size_t pad();

  /// \param offset  bytes from where the last view begins.
  /// \return which accessor it is.
  std::size_t add_accessor(int component, const char* type, std::size_t count,
                           std::size_t offset = 0);

  /// Of vectors that are all zero.
  void add_zeros(std::size_t count);
  /// In the last accessor some are not. \param indices, values  which views hold them.
  void make_sparse(std::size_t some, std::size_t indices, std::size_t values);

  /// Says how long the buffer is.
  void finish();

 private:
  nlohmann::ordered_json& scene_;
  std::size_t size_;
};

/// Two numbers a vertex of the file. \param uvs  v upwards as in OBJ.
std::string texture_coordinates(const SplitVertices& split, const TextureCoordinates& uvs);

/// A morph target in files whose vertices are split at seams.
struct GlbTargetRows {
  std::vector<std::uint32_t> rows;      ///< of the target's moves, one after the other
  std::vector<std::uint32_t> vertices;  ///< #rows, of the file, ascending
  bool whole = false;                   ///< it moves every vertex of the mesh
};

/// \param vertices  that it moves
/// \param split     the original vertex of each of the file
/// \param count     of the original vertices
GlbTargetRows target_rows(std::span<const std::uint32_t> vertices,
                          std::span<const std::uint32_t> split, Index count);

/// The least and largest moves of a target; zero is among them unless it is whole.
std::pair<Eigen::RowVector3d, Eigen::RowVector3d> target_bounds(const Displacements& moves,
                                                                bool whole);

}  // namespace crowdface
