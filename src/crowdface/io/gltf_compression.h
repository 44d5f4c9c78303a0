// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crowdface {

/// What EXT_meshopt_compression says of a view.
struct MeshoptView {
  std::size_t count = 0, stride = 0;
  std::string mode, filter;
};
/// Decompresses a meshopt buffer view.
/// \return nothing if the data are damaged or the view declares a larger size than the data can expand to
std::optional<std::string> decode_meshopt(std::string_view bytes, const MeshoptView& view);

/// A mesh of Draco: triangles, and attributes by their ids, row after row.
struct DracoMesh {
  std::size_t points = 0;
  std::vector<std::uint32_t> corners;
  std::vector<std::vector<double>> attributes;  ///< as many as were asked for
};
struct DracoAttribute {
  std::uint32_t id = 0;
  std::size_t width = 0;
};
/// Nothing if the bytes are damaged or lack an attribute.
std::optional<DracoMesh> decode_draco(std::string_view bytes,
                                      const std::vector<DracoAttribute>& attributes);

}  // namespace crowdface
