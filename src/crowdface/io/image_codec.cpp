// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/image_codec.h"

#include "crowdface/io/project_library.h"

namespace crowdface {

const ImageCodec& image_codec() {
  using Function = const ImageCodec*();
  static const ImageCodec& codec = *reinterpret_cast<Function*>(load_library_function(
      "libcrowdface_images.so", "crowdface_image_codec", "images need (OpenImageIO)",
      "images can be neither read nor written"))();
  return codec;
}

}  // namespace crowdface
