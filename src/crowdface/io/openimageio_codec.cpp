// SPDX-License-Identifier: Apache-2.0
// The OpenImageIO codec in its own shared library; see image_codec.h.
#include <algorithm>
#include <exception>
#include <memory>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "crowdface/io/image_codec.h"

namespace crowdface {
namespace {

struct Picture {
  explicit Picture(std::string_view bytes) : memory(bytes.data(), bytes.size()) {}
  OIIO::Filesystem::IOMemReader memory;
  std::unique_ptr<OIIO::ImageInput> input;
};

using ValueType = ImageHeader::ValueType;
using Form = ImageToEncode::Form;

ValueType kind_of_values(const OIIO::TypeDesc& type) {
  if (type.basetype == OIIO::TypeDesc::UINT8) return ValueType::kBytes;
  if (type.basetype == OIIO::TypeDesc::UINT16) return ValueType::kWords;
  return type.is_floating_point() ? ValueType::kFloats : ValueType::kOthers;
}

OIIO::TypeDesc type_of(ValueType values) {
  if (values == ValueType::kBytes) return OIIO::TypeDesc::UINT8;
  return values == ValueType::kWords ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::FLOAT;
}

ImageHeader facts_of(const OIIO::ImageSpec& spec) {
  ImageHeader header;
  header.width = spec.width;
  header.height = spec.height;
  header.depth = spec.depth;
  header.channels = spec.nchannels;
  header.x = spec.x;
  header.y = spec.y;
  header.full_x = spec.full_x;
  header.full_y = spec.full_y;
  header.full_width = spec.full_width;
  header.full_height = spec.full_height;
  header.tile_width = spec.tile_width;
  header.tile_height = spec.tile_height;
  header.alpha_channel = std::min(spec.alpha_channel, spec.nchannels - 1);  // GIF: one too many
  header.is_deep = spec.deep;
  header.value_type = kind_of_values(spec.format);
  header.type_name = spec.format.c_str();
  return header;
}

/// Pass the mapped bytes to the decoder. A decoder that reads the file itself would report a
/// failing disk as a damaged file.
void* open(const std::string& format, const std::string& file, std::string_view bytes,
           ImageHeader& header, std::string& error) {
  auto picture = std::make_unique<Picture>(bytes);
  picture->input = OIIO::ImageInput::create(format);
  OIIO::ImageInput* input = picture->input.get();
  if (input == nullptr) {
    error = "this build cannot read " + format + ": " + OIIO::geterror();
    return nullptr;
  }
  OIIO::ImageSpec wish, spec;
  wish.attribute("oiio:UnassociatedAlpha", 1);  // keeps colours where alpha is 0
  input->threads(1);
  if (!input->set_ioproxy(&picture->memory)) {
    error = "this build cannot read " + format + " from memory";
    return nullptr;
  }
  try {
    if (!input->open(file, spec, wish)) {
      error = "cannot be read as " + format + ": " + input->geterror();
      return nullptr;
    }
  } catch (const std::exception& failure) {  // some decoders let exceptions of the library out
    error = "cannot be read as " + format + ": " + failure.what();
    return nullptr;
  }
  header = facts_of(spec);
  // In other formats than OpenEXR the order of channels is fixed and their names do not matter.
  if (format == "openexr") header.channel_names = spec.channelnames;
  return picture.release();
}

/// Whether to decode an image row by row. The strips of a TIFF are read row by row, because a
/// decoder that reads several strips at once does not report damage of a single strip. Exception:
/// for a TIFF with separate planes, the decoder reports damage, and reading row by row would decode
/// the rows again for each plane.
bool reads_rows(const OIIO::ImageInput& input, const OIIO::ImageSpec& spec) {
  return std::string_view(input.format_name()) == "tiff" && spec.tile_width == 0 &&
         spec.get_string_attribute("planarconfig") != "separate";
}

bool read(void* picture, void* pixels, std::string& error) try {
  OIIO::ImageInput& input = *static_cast<Picture*>(picture)->input;
  const OIIO::ImageSpec& spec = input.spec();
  const OIIO::TypeDesc type = type_of(kind_of_values(spec.format));
  bool read = true;
  if (reads_rows(input, spec)) {
    const std::size_t row = static_cast<std::size_t>(spec.width) *
                            static_cast<std::size_t>(spec.nchannels) * type.size();
    for (int y = 0; read && y < spec.height; ++y) {
      read = input.read_scanline(spec.y + y, 0, type,
                                 static_cast<char*>(pixels) + row * static_cast<std::size_t>(y));
    }
  } else {
    read = input.read_image(0, 0, 0, -1, type, pixels);
  }
  // For some kinds of damage the decoder returns success but sets its error flag.
  read = read && !input.has_error();
  if (!read) error = input.geterror();
  return read;
} catch (const std::exception& failure) {
  error = failure.what();
  return false;
}

void close(void* picture) {
  delete static_cast<Picture*>(picture);
}

/// Sets the value type and attributes of an image to be encoded.
/// \return name of the writer in OpenImageIO.
const char* set_attributes(Form form, OIIO::ImageSpec& spec) {
  if (form == Form::kExr) {
    spec.set_format(OIIO::TypeDesc::HALF);
    spec.attribute("compression", "zip");
    spec.attribute("oiio:ColorSpace", "linear");
    // A constant date, because the writer would otherwise store the current time.
    spec.attribute("DateTime", "2000:01:01 00:00:00");
    return "openexr";
  }
  spec.attribute("compression", "jpeg:92");
  spec.attribute("jpeg:subsampling", "4:4:4");
  return "jpeg";
}

bool encode(const ImageToEncode& picture, std::string& bytes, std::string& error) {
  OIIO::ImageSpec spec(picture.width, picture.height, picture.channels, OIIO::TypeDesc::UINT8);
  const std::string format = set_attributes(picture.form, spec);
  const OIIO::TypeDesc type =
      picture.form == Form::kExr ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc(spec.format);
  std::vector<unsigned char> written;
  OIIO::Filesystem::IOVecOutput memory(written);
  const auto output = OIIO::ImageOutput::create(format);
  if (!output) {
    error = OIIO::geterror();
    return false;
  }
  output->set_ioproxy(&memory);
  if (!output->open("memory." + format, spec) || !output->write_image(type, picture.pixels) ||
      !output->close()) {
    error = output->geterror();
    return false;
  }
  bytes.assign(written.begin(), written.end());
  return true;
}

}  // namespace
}  // namespace crowdface

extern "C" __attribute__((visibility("default"))) const crowdface::ImageCodec*
crowdface_image_codec() {
  static const crowdface::ImageCodec codec = {crowdface::open, crowdface::read, crowdface::close,
                                              crowdface::encode};
  return &codec;
}
