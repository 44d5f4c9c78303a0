// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crowdface {

/// Parameters of a buffer view compressed with EXT_meshopt_compression.
struct MeshoptView {
  /// Number of elements in the view; number of bytes per element.
  std::size_t count = 0, stride = 0;
  std::string mode, filter;  ///< values of the extension, such as "TRIANGLES" and "OCTAHEDRAL"
};
/// Decompresses a meshopt buffer view.
/// \return nothing if the data is damaged, or if the data is too short to expand to the size that
/// the view declares.
std::optional<std::string> decode_meshopt(std::string_view bytes, const MeshoptView& view);

/// A decoded Draco mesh: triangles, and attributes in row-major order.
struct DracoMesh {
  std::size_t point_count = 0;  ///< number of vertices of the mesh
  /// The triangles' corners: three vertex indices per triangle.
  std::vector<std::uint32_t> corners;
  /// for each requested attribute, the values of all vertices
  std::vector<std::vector<double>> attributes;
};
/// A vertex attribute to decode.
struct DracoAttribute {
  std::uint32_t id = 0;             ///< Draco's unique id of the attribute
  std::size_t component_count = 0;  ///< how many numbers the attribute has per vertex
};
/// Decompresses a Draco mesh.
/// \return nothing if the bytes are damaged, an attribute is missing, or the mesh exceeds
/// `input_limits()`.
std::optional<DracoMesh> decode_draco(std::string_view bytes,
                                      const std::vector<DracoAttribute>& attributes);

}  // namespace crowdface
