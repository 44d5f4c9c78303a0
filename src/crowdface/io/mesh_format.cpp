// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/mesh_format.h"

#include <array>

#include "crowdface/core/text.h"
#include "crowdface/io/glb_template.h"
#include "crowdface/io/npy.h"
#include "crowdface/io/obj_file.h"
#include "crowdface/io/ply_template.h"
#include "crowdface/io/usda_template.h"

namespace crowdface {

namespace {

namespace fs = std::filesystem;

// One entry per format. An entry lists the values of the members of MeshFormatTraits in order.
constexpr std::array<MeshFormatTraits, kMeshFormatCount> kTraits = {
    {{MeshFormat::kObj, "obj", ".obj", "mesh", true, true, FileNormals::kReducedLevels,
      DataStorage::kOwnFiles, DataStorage::kOwnFiles, DataStorage::kOwnFiles,
      [](const fs::path& file, Index) { return read_obj(file).positions; }},
     {MeshFormat::kPly, "ply", ".ply", "ply", true, false, FileNormals::kLikeTarget,
      DataStorage::kNowhere, DataStorage::kOwnFiles, DataStorage::kNowhere,
      [](const fs::path& file, Index) { return read_ply_positions(file); }},
     {MeshFormat::kGlb, "glb", ".glb", "glb", true, false, FileNormals::kAlways,
      DataStorage::kInside, DataStorage::kInside, DataStorage::kInside, read_glb_positions},
     {MeshFormat::kPoints, "points", ".npy", "points", false, false, FileNormals::kNone,
      DataStorage::kOneFile, DataStorage::kNowhere, DataStorage::kNowhere,
      [](const fs::path& file, Index) { return read_npy(file); }},
     {MeshFormat::kUsd, "usd", ".usda", "usd", true, false, FileNormals::kAlways,
      DataStorage::kInside, DataStorage::kInside, DataStorage::kOwnFiles, read_usda_positions}}};

constexpr bool rows_are_in_order() {
  for (std::size_t f = 0; f < kTraits.size(); ++f) {
    if (kTraits[f].format != static_cast<MeshFormat>(f) || kTraits[f].name.empty()) return false;
  }
  return true;
}
static_assert(rows_are_in_order(), "every MeshFormat has its row, in the order of the enumeration");

}  // namespace

const MeshFormatTraits& traits_of(MeshFormat format) {
  return kTraits[static_cast<std::size_t>(format)];
}

const std::vector<MeshFormat>& all_mesh_formats() {
  static const std::vector<MeshFormat> all = [] {
    std::vector<MeshFormat> formats;
    for (const MeshFormatTraits& traits : kTraits) formats.push_back(traits.format);
    return formats;
  }();
  return all;
}

std::string list_of_extensions() {
  std::string list;
  for (const MeshFormatTraits& traits : kTraits) {
    const bool is_last = traits.format == kTraits.back().format;
    list += concat(list.empty() ? "" : is_last ? " or " : ", ", traits.extension);
  }
  return list;
}

std::optional<MeshFormat> mesh_format_of(const fs::path& file) {
  const std::string extension = lower_case(file.extension().string());
  for (const MeshFormatTraits& traits : kTraits) {
    if (extension == traits.extension) return traits.format;
  }
  return std::nullopt;
}

}  // namespace crowdface
