// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/core/units.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

struct FileMesh;

/// An output format. Each format has an entry in the table of mesh_format.cpp and an entry in the
/// table of run/mesh_encoder.cpp. If an entry is missing or incomplete, compilation fails. No other
/// code lists the formats.
enum class MeshFormat {
  kObj,     ///< the text of the target head's OBJ file with new positions
  kPly,     ///< binary PLY
  kGlb,     ///< binary glTF 2.0
  kPoints,  ///< a NumPy file (.npy) with only the positions
  kUsd,     ///< a USD text layer, .usda
  kEnd,     ///< not a format; its value is the number of formats
};
/// Number of formats.
inline constexpr std::size_t kMeshFormatCount = static_cast<std::size_t>(MeshFormat::kEnd);

/// Where a format stores a kind of data: shapes, attachments or textures.
enum class DataStorage {
  kNowhere,  ///< the format does not store this kind of data
  kInside,   ///< the file of the face stores the data
  /// one additional file per face, of the same format, stores all data of this kind
  kOneFile,
  /// each shape and each texture has a file of its own; each attachment has an OBJ file of its own
  kOwnFiles,
};

/// For which meshes the caller must compute normals and pass them to an encoder.
enum class FileNormals {
  kNone,  ///< the encoder needs normals for no mesh
  /// The encoder needs normals for levels of detail; it computes the normals of full meshes itself.
  kReducedLevels,
  /// If the file of the target head has normals, the encoder needs normals for all meshes.
  /// Otherwise, the encoder needs normals for no mesh.
  kLikeTarget,
  kAlways,  ///< the encoder needs normals for all meshes
};

/// Properties of a format. The program needs them to plan, name, read and check files of the
/// format.
struct MeshFormatTraits {
  MeshFormat format;
  std::string_view name;        ///< name in the config, such as "points"
  std::string_view extension;   ///< file extension, such as ".npy"
  std::string_view report_key;  ///< key of the face's file in report.json
  /// whether the file stores polygons, without which there are no levels of detail
  bool has_polygons;
  bool has_material_file;  ///< whether the file refers to an MTL file
  FileNormals normals;     ///< for which meshes the encoder must be given normals
  /// Where the format stores shapes, attachments, and textures.
  DataStorage shapes, attachments, textures;
  /// Function that reads the positions from the file of one face. Null if the format does not keep
  /// the vertex order.
  /// \throws InvalidInput if another program wrote the file.
  Positions (*read)(const std::filesystem::path& file, Index vertices);
  /// Function that converts a mesh, read from a file of any format, to a file of this format.
  /// \throws CannotCreate, IoError
  void (*write)(const FileMesh& mesh, LengthUnit unit, const std::filesystem::path& file);
};

/// The properties of a format.
const MeshFormatTraits& traits_of(MeshFormat format);
/// Whether a face file of this format refers to the texture files of attachments by file name. If
/// so, these texture files are stored beside the meshes.
inline bool refers_to_attachment_textures(const MeshFormatTraits& format) {
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
/// The format's name in the config, such as "points".
inline std::string_view name_of(MeshFormat format) {
  return traits_of(format).name;
}
/// The format's file extension, such as ".npy".
inline std::string_view extension_of(MeshFormat format) {
  return traits_of(format).extension;
}
/// The text ".obj, .ply, .glb, .npy or .usda", for messages.
std::string list_of_extensions();
/// The format of a file by its extension, ignoring case; nothing if unknown.
std::optional<MeshFormat> mesh_format_of(const std::filesystem::path& file);

}  // namespace crowdface
