// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// A format that faces are written in. Each has a row in the table of mesh_format.cpp and a row in the
/// table of run/mesh_encoder.cpp; the program does not compile without them.
enum class MeshFormat {
  kObj,     ///< the target's own file with other positions
  kPly,     ///< binary
  kGlb,     ///< binary glTF 2.0
  kPoints,  ///< positions alone, .npy
  kUsd,     ///< a layer of USD as text, .usda
};
inline constexpr std::size_t kMeshFormats = 5;

/// Where the files of a face have something that is not the mesh.
enum class Beside {
  kNowhere,
  kInside,   ///< in the face's own file
  kOneFile,  ///< in one more file of the same format
  kOwnFiles,  ///< in files of their own: a file for each shape, an OBJ file for each attachment, pictures
};

/// Which normals an encoder asks for.
enum class FileNormals {
  kNone,
  kOnLevels,    ///< only on levels of detail: the whole mesh takes them from the target's file
  kLikeTarget,  ///< if the target's file has normals
  kAlways,
};

/// What a format is like: all that the program must know of a format to plan, name, read and check files.
struct MeshFormatTraits {
  MeshFormat format;
  std::string_view name;        ///< the word in the config: "points"
  std::string_view extension;   ///< ".npy"
  std::string_view report_key;  ///< of the face's own file in report.json
  bool has_faces;  ///< written on levels of detail, too: readable without the common topology
  bool has_material_file;  ///< names an MTL file
  FileNormals normals;
  Beside shapes, attachments, textures;
  /// Reads the positions of a face's file back; null: the format does not keep the order of the vertices.
  /// \throws InvalidInput if another program wrote the file.
  Positions (*read)(const std::filesystem::path& file, Index vertices);
};

const MeshFormatTraits& traits_of(MeshFormat format);
/// Whether files name the textures of attachments, which then lie beside the meshes.
inline bool names_attachment_textures(const MeshFormatTraits& format) {
  return format.attachments == Beside::kOwnFiles ||
         (format.attachments == Beside::kInside && format.textures == Beside::kOwnFiles);
}
/// All of them, in the order in which they are named.
const std::vector<MeshFormat>& all_mesh_formats();
/// Whether a format among these is so. \param is  of MeshFormatTraits.
template <class Formats, class Is>
bool any_format(const Formats& formats, const Is& is) {
  for (const MeshFormat format : formats) {
    if (is(traits_of(format))) return true;
  }
  return false;
}
/// The word of the config: "points".
inline std::string_view name_of(MeshFormat format) {
  return traits_of(format).name;
}
/// ".npy".
inline std::string_view extension_of(MeshFormat format) {
  return traits_of(format).extension;
}
/// ".obj, .ply, .glb, .npy or .usda", for messages.
std::string list_of_extensions();
/// The format that a file's name asks for by its ending, in any case; nothing if it is another.
std::optional<MeshFormat> mesh_format_of(const std::filesystem::path& file);

}  // namespace crowdface
