// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdlib>

#include "crowdface/core/error.h"
#include "crowdface/io/image.h"

#include "fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const crowdface::fuzz::InputFile file(data, size);
  crowdface::ImageLimits limits;
  limits.max_values = 1 << 20;  // what is larger is refused the same way, only later
  try {
    const crowdface::Image image = crowdface::read_image(file.path(), limits);
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        for (int c = 0; c < image.channels; ++c) {
          if (!std::isfinite(image.at(x, y, c))) std::abort();
        }
      }
    }
  } catch (const crowdface::Error&) {
  }
  return 0;
}
