// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include <nlohmann/json.hpp>

#include "crowdface/io/glb_options.h"
#include "crowdface/io/gltf_codes.h"

namespace crowdface {

/// \param overlay  which of the file's images that is.
nlohmann::ordered_json material_json(const GlbMaterial& material, std::size_t overlay);
/// The node of a face, without a name: unit and axes. With a rig it is the joints', and the mesh has its own.
nlohmann::ordered_json node_json(const GlbOptions& options);

/// Adds arrays to a glTF buffer, one view each, and describes them.
class GlbBuffer {
 public:
  explicit GlbBuffer(nlohmann::ordered_json& scene);
  /// \return which view it is.
  std::size_t add_view(std::size_t size, int target = 0);
  /// Four divides where the next view begins. \return how many bytes that takes.
  std::size_t pad();
  /// \param offset  bytes from where the last view begins.
  /// \return which accessor it is.
  std::size_t add_accessor(int component, const char* type, std::size_t count,
                           std::size_t offset = 0);
  /// Of vectors that are zero but for some. \return which accessor it is.
  std::size_t add_sparse(std::size_t count, std::size_t some, std::size_t indices,
                         std::size_t values);
  /// Of vectors that are all zero. \return which accessor it is.
  std::size_t add_zeros(std::size_t count);
  void finish();

 private:
  nlohmann::ordered_json& scene_;
  std::size_t size_ = 0;
};

}  // namespace crowdface
