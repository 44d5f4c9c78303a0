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
  std::size_t count = 0, stride = 0;
  std::string mode, filter;
};
/// Decompresses a meshopt buffer view.
/// \return nothing if the data is damaged, or if the data is too short to expand to the size that
/// the view declares.
std::optional<std::string> decode_meshopt(std::string_view bytes, const MeshoptView& view);

/// A decoded Draco mesh: triangles, and attributes in row-major order.
struct DracoMesh {
  std::size_t point_count = 0;
  std::vector<std::uint32_t> corners;
  std::vector<std::vector<double>> attributes;  ///< one for each requested attribute
};
struct DracoAttribute {
  std::uint32_t id = 0;
  std::size_t component_count = 0;
};
/// Decompresses a Draco mesh.
/// \param attributes  for each attribute to decode: its id and its number of components.
/// \return nothing if the bytes are damaged or one of the attributes is missing.
std::optional<DracoMesh> decode_draco(std::string_view bytes,
                                      const std::vector<DracoAttribute>& attributes);

}  // namespace crowdface
