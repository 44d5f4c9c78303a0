// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/mesh_format.h"

#include <string>

#include "crowdface/core/text.h"

namespace crowdface {

namespace {

struct Known {
  std::string_view name, extension;
};
constexpr Known kKnown[] = {
    {"obj", ".obj"}, {"ply", ".ply"}, {"glb", ".glb"}, {"points", ".npy"}, {"usd", ".usda"}};

}  // namespace

const std::vector<MeshFormat>& all_mesh_formats() {
  static const std::vector<MeshFormat> all = {MeshFormat::kObj, MeshFormat::kPly, MeshFormat::kGlb,
                                              MeshFormat::kPoints, MeshFormat::kUsd};
  return all;
}

std::string_view name_of(MeshFormat format) {
  return kKnown[static_cast<std::size_t>(format)].name;
}

std::string_view extension_of(MeshFormat format) {
  return kKnown[static_cast<std::size_t>(format)].extension;
}

std::optional<MeshFormat> mesh_format_of(const std::filesystem::path& file) {
  const std::string extension = lower_case(file.extension().string());
  for (const MeshFormat format : all_mesh_formats()) {
    if (extension == extension_of(format)) return format;
  }
  return std::nullopt;
}

}  // namespace crowdface
