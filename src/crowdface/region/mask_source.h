// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "crowdface/io/image.h"

namespace crowdface {

/// Where a mask's pixels come from: one picture, or with <UDIM> in its path a set of tiles. Nothing
/// is read until it is asked for, so that tiles which no texture coordinate touches may be missing.
class MaskSource {
 public:
  /// \param path  may hold <UDIM> (once or more), which stands for a tile's number.
  explicit MaskSource(std::string path);
  /// A picture already in memory; `name` stands for it in messages.
  MaskSource(std::string name, Image image);

  const std::string& path() const { return path_; }
  /// Whether it is a set of UDIM tiles.
  bool tiled() const;
  /// The file that holds a tile, or the one picture.
  std::string file_of(int tile) const;
  /// Reads a tile, or the one picture. \throws as read_image; InvalidInput, naming the pixel, if a
  /// value (of a channel that is not alpha) is negative.
  Image read(int tile) const;

 private:
  std::string path_;
  std::optional<Image> image_;
};

/// Channels of an image that hold masks: all but alpha, in order.
std::vector<int> mask_channels(const Image& image);

}  // namespace crowdface
