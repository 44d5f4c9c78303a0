// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace crowdface {

/// What a picture's header says.
struct PictureFacts {
  int width = 0, height = 0, depth = 1, channels = 0;
  int x = 0, y = 0;                                             ///< where the pixels begin
  int full_x = 0, full_y = 0, full_width = 0, full_height = 0;  ///< the display window
  int tile_width = 0, tile_height = 0;                          ///< 0: no tiles
  int alpha_channel = -1;
  std::vector<std::string> channel_names;  ///< if the format has any
  bool deep = false;
  enum class Values { kBytes, kWords, kFloats, kOthers };
  Values values = Values::kOthers;  ///< as they are read: 8 or 16 bits, or single precision
  std::string type;                 ///< of a value in the file, for messages
};

/// Pixels of ours that become a file.
struct PictureToEncode {
  enum class Form { kPng, kStoredPng, kWordPng, kJpeg, kExr };
  Form form = Form::kPng;
  int width = 0, height = 0, channels = 0;
  const void* pixels =
      nullptr;  ///< row by row; of an OpenEXR floats, of a word PNG 16 bits, else bytes
};

/// Reads and writes files of some formats; checks no limits: image.cpp does. Functions, and none of them
/// virtual: OpenImageIO's stand in a shared library, and two libraries do not agree on what a type is.
struct ImageCodec {
  /// \param format  the name of a reader in OpenImageIO. \param bytes  of the file; they outlive the picture.
  /// \return null if the picture cannot be opened; `error` says why.
  void* (*open)(const std::string& format, const std::string& file, std::string_view bytes,
                PictureFacts& facts, std::string& error);
  /// \param pixels  room for all of them, of the type that the facts say.
  /// \return whether they could be read.
  bool (*read)(void* picture, void* pixels, std::string& error);
  void (*close)(void* picture);
  bool (*encode)(const PictureToEncode& picture, std::string& bytes, std::string& error);
};

/// What OpenImageIO does for us: all formats but PNG. It brings some 250 libraries, which take 0.2 s to load. So
/// it stands in a shared library of its own (openimageio_codec.cpp), which holds no state of ours.
/// Opened the first time. Any thread may ask.
/// \throws IoError if it is not where it was installed, or cannot be loaded.
const ImageCodec& image_codec();

}  // namespace crowdface
