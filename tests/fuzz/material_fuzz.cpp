// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>
#include <filesystem>

#include "crowdface/core/error.h"
#include "crowdface/io/material_files.h"

#include "fuzz/input_file.h"
#include "fuzz/job_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const crowdface::fuzz::JobFolder folder("material");
  static const auto picture = folder.write("heads/skin.1001.png", "");
  folder.write("heads/skin.mtl", crowdface::fuzz::text_of(data, size));
  const auto mesh = picture.parent_path() / "ann.obj";
  try {
    const auto files = crowdface::find_material_files(mesh, {"skin.mtl"});
    for (const auto& file : files.files) {
      // Nothing outside the mesh's folder is copied.
      if (file.destination.is_absolute() || *file.destination.begin() == "..") std::abort();
    }
    crowdface::find_textures(mesh, {"skin.mtl"});
    for (const auto& material : files.surface_materials) {
      if (!(material.opacity >= 0 && material.opacity <= 1)) std::abort();
      for (const float part : material.colour.value_or(std::array<float, 3>{})) {
        if (!(part >= 0 && part <= 1)) std::abort();
      }
    }
  } catch (const crowdface::Error&) {
  }
  return 0;
}
