// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/heads/inputs.h"

namespace crowdface {

/// All pictures of a head's materials and UDIM tiles, combined in one picture, because the page
/// shows a single picture at a time. The layout is the same for all heads.
class TextureAtlas {
 public:
  /// \param inputs  must outlive this object
  explicit TextureAtlas(const Inputs& inputs);

  /// Coordinates in the atlas of the heads' texture coordinates, #uvs by 2.
  TextureCoordinates coordinates() const;
  bool has(Index head) const;
  /// The atlas of a head as a JPEG file; nothing if the head has no texture.
  std::optional<std::string> picture(Index head) const;

 private:
  const Inputs& inputs_;
  std::vector<std::uint32_t> cell_of_face_;  ///< or TextureSet::kNone; empty: no head has textures
  std::uint32_t cells_ = 0;
  int columns_ = 1, rows_ = 1, cell_px_ = 0;
};

}  // namespace crowdface
