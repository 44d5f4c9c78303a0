// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/heads/inputs.h"

namespace crowdface {

/// The pictures of a head's materials and UDIM tiles side by side in one, as a page shows one picture at
/// a time. Heads have theirs at the same places.
class TextureAtlas {
 public:
  /// \param inputs  must outlive this object
  explicit TextureAtlas(const Inputs& inputs);

  /// #uvs by 2: where the heads' texture coordinates lie in it.
  TextureCoordinates coordinates() const;
  bool has(Index head) const;
  /// A JPEG file; nothing if the head has no texture.
  std::optional<std::string> picture(Index head) const;

 private:
  const Inputs& inputs_;
  std::vector<std::uint32_t>
      cell_of_face_;  ///< or TextureCoat::kNone; empty: no head has a texture
  std::uint32_t cells_ = 0;
  int columns_ = 1, rows_ = 1, cell_px_ = 0;
};

}  // namespace crowdface
