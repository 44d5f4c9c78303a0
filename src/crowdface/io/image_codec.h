// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace crowdface {

/// The header of an image file.
struct ImageHeader {
  /// Size of the image in pixels; `depth` is the number of slices of a volume.
  int width = 0, height = 0, depth = 1, channels = 0;
  int x = 0, y = 0;  ///< upper left corner of the data window, in pixels
  /// Upper left corner and size of the display window, in pixels.
  int full_x = 0, full_y = 0, full_width = 0, full_height = 0;
  int tile_width = 0, tile_height = 0;  ///< size of a tile in pixels; 0: the image is not tiled
  int alpha_channel = -1;               ///< index of the alpha channel; −1: none
  /// For OpenEXR, one name per channel; empty for other formats.
  std::vector<std::string> channel_names;
  bool is_deep = false;  ///< whether a pixel may have several samples (OpenEXR)
  enum class ValueType { kBytes, kWords, kFloats, kOthers };
  /// Type of the values that `ImageCodec::read` returns: 8-bit integers (kBytes), 16-bit integers
  /// (kWords) or single precision (kFloats). kOthers: the program does not support the values.
  ValueType value_type = ValueType::kOthers;
  std::string type_name;  ///< name of the type that the values have in the file, for messages
};

/// Pixels to be encoded as a file.
struct ImageToEncode {
  enum class Form { kPng, kPng16, kJpeg, kExr };  ///< file format; kPng16 has 16 bits per value
  Form form = Form::kPng;
  int width = 0, height = 0, channels = 0;
  /// the pixels, row by row: floats for OpenEXR, 16-bit numbers for kPng16, otherwise bytes
  const void* pixels = nullptr;
};

/// Functions that decode and encode image files of some formats. The codec does not check limits;
/// image.cpp does. The struct consists of function pointers and has no virtual functions, because
/// OpenImageIO is behind a shared library and type identity across libraries is unreliable.
struct ImageCodec {
  /// Opens an image and reads its header.
  /// \param format  name of the reader in OpenImageIO.
  /// \param file  path of the file.
  /// \param bytes  content of the file; must outlive the opened image.
  /// \param header  receives the header.
  /// \return null if the image cannot be opened; `error` gives the reason.
  void* (*open)(const std::string& format, const std::string& file, std::string_view bytes,
                ImageHeader& header, std::string& error);
  /// Reads all pixels of an open image.
  /// \param pixels  buffer for all pixels, of the type given by `ImageHeader::value_type`.
  /// \param picture  an open image, as `open` returns it.
  /// \return whether the pixels could be read; if not, `error` gives the reason.
  bool (*read)(void* picture, void* pixels, std::string& error);
  /// Closes an open image.
  void (*close)(void* picture);
  /// Encodes an image as a file.
  /// \return false if encoding failed; `error` gives the reason.
  bool (*encode)(const ImageToEncode& picture, std::string& bytes, std::string& error);
};

/// The codec for PNG, the format that nearly every run uses. It uses libpng and does not need the
/// libraries that `image_codec` loads.
const ImageCodec& png_codec();

/// The codec for all formats except PNG, based on OpenImageIO. OpenImageIO depends on some 250
/// libraries, which need 0.2 s to load. The codec is therefore in a separate shared library
/// (openimageio_codec.cpp), which the first call loads. This shared library holds no state of the
/// program. Thread-safe.
/// \throws IoError if the library is missing from its installed place or cannot be loaded.
const ImageCodec& image_codec();

}  // namespace crowdface
