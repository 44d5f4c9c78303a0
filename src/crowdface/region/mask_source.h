// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "crowdface/io/image.h"

namespace crowdface {

/// The smallest accepted value of a mask. Negative values down to this limit count as 0: resizing
/// an image can produce such values (down to −0.18 with a Lanczos filter), and so can rounding
/// errors.
inline constexpr double kMinMaskValue = -0.2;

/// The source of a mask's pixels. It is one image or, if the path contains <UDIM>, a set of UDIM
/// tiles. Reads an image only on request, so tiles in which no texture coordinate lies may be
/// missing.
class MaskSource {
 public:
  /// \param path  may contain <UDIM> (one or more times), which stands for a tile's number.
  explicit MaskSource(std::string path);
  /// An image in memory.
  /// \param name  used in messages instead of a path.
  MaskSource(std::string name, Image image);

  const std::string& path() const { return path_; }
  /// Whether the mask is a set of UDIM tiles.
  bool is_tiled() const;
  /// The path of a tile, or of the single image.
  std::string tile_path(int tile) const;
  /// Reads a tile, or the single image.
  /// \throws InvalidInput naming the pixel, if a value outside the alpha channel is below
  ///         kMinMaskValue; also throws the errors of read_image.
  Image read(int tile) const;

 private:
  std::string path_;
  std::optional<Image> image_;  ///< only for an image that was in memory from the start
};

/// The indices of the channels of an image that hold masks: all channels except alpha, in order.
std::vector<int> mask_channel_indices(const Image& image);

}  // namespace crowdface
