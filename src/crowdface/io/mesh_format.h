// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// An output format. Each format has a row in the table of mesh_format.cpp and in the table of
/// run/mesh_encoder.cpp; the compiler enforces both.
enum class MeshFormat {
  kObj,     ///< the text of the target's file with other positions
  kPly,     ///< binary
  kGlb,     ///< binary glTF 2.0
  kPoints,  ///< only positions, .npy
  kUsd,     ///< a USD text layer, .usda
};
inline constexpr std::size_t kMeshFormatCount = 5;

/// Where a format stores shapes, attachments or textures.
enum class DataStorage {
  kNowhere,
  kInside,    ///< stored in the face's own file
  kOneFile,   ///< stored together in one more file of the same format
  kOwnFiles,  ///< one file for each shape or texture, one OBJ file for each attachment
};

/// Which normals an encoder needs.
enum class FileNormals {
  kNone,
  kOnLevels,    ///< only for levels of detail; the full mesh has the normals of the target's file
  kLikeTarget,  ///< only if the target's file has normals
  kAlways,
};

/// Properties of a format, by which the program plans, names, reads and checks its files.
struct MeshFormatTraits {
  MeshFormat format;
  std::string_view name;        ///< name in the config: "points"
  std::string_view extension;   ///< ".npy"
  std::string_view report_key;  ///< key of the face's file in report.json
  bool has_faces;               ///< the file stores the faces, so levels of detail can be written
  bool has_material_file;       ///< the file names an MTL file
  FileNormals normals;
  DataStorage shapes, attachments, textures;
  /// Reads the positions of a face's file; null if the format does not keep the vertex order.
  /// \throws InvalidInput if another program wrote the file.
  Positions (*read)(const std::filesystem::path& file, Index vertices);
};

const MeshFormatTraits& traits_of(MeshFormat format);
/// Whether the face files name the textures of attachments, which are then stored beside the
/// meshes.
inline bool names_attachment_textures(const MeshFormatTraits& format) {
  return format.attachments == DataStorage::kOwnFiles ||
         (format.attachments == DataStorage::kInside && format.textures == DataStorage::kOwnFiles);
}
/// All formats, in the order in which messages list them.
const std::vector<MeshFormat>& all_mesh_formats();
/// Whether any of the formats satisfies a predicate.
/// \param predicate  called with the MeshFormatTraits of a format.
template <class Formats, class Predicate>
bool any_format(const Formats& formats, const Predicate& predicate) {
  for (const MeshFormat format : formats) {
    if (predicate(traits_of(format))) return true;
  }
  return false;
}
/// The format's name in the config: "points".
inline std::string_view name_of(MeshFormat format) {
  return traits_of(format).name;
}
/// The format's file extension: ".npy".
inline std::string_view extension_of(MeshFormat format) {
  return traits_of(format).extension;
}
/// ".obj, .ply, .glb, .npy or .usda", for messages.
std::string list_of_extensions();
/// The format of a file by its extension, ignoring case; nothing if unknown.
std::optional<MeshFormat> mesh_format_of(const std::filesystem::path& file);

}  // namespace crowdface
