// SPDX-License-Identifier: Apache-2.0
// Encodes meshes in each file format. A factory function per format makes one encoder for each
// level of detail. docs/architecture.md lists the files to change for a new format.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/config/config.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/io/encoded_file.h"
#include "crowdface/io/mesh_format.h"
#include "crowdface/run/mesh_level.h"

namespace crowdface {

/// The value of a FaceMesh member such as `normals` if the mesh lacks these positions.
inline const Positions kNoPositions;
/// The value of FaceMesh::colours if the mesh has no vertex colours.
inline const ColourRows kNoColours;

/// The mesh of a face with all data that a file may contain. The mesh is at rest or in a blend
/// shape, and whole or reduced to a level of detail.
struct FaceMesh {
  std::string id;            ///< "market_0001", at a level of detail "market_0001_LOD1"
  std::string display_name;  ///< the name of the mesh in messages
  Index target = 0;          ///< index of the head that the face is built on
  const Positions* positions = &kNoPositions;  ///< vertex positions, #V by 3
  /// vertex normals, #V by 3; no rows if no encoder needs normals
  const Positions* normals = &kNoPositions;
  std::span<const Displacements> moves = {};  ///< displacements of each blend shape, or none
  std::span<const PlacedAttachment> placed_attachments = {};  ///< the face's attachments
  const ColourRows* colours = &kNoColours;  ///< #V vertex colours; no rows if there are none
  /// positions of the named points (PointCarrier) on this face; no rows in a reduced mesh
  const Positions* points = &kNoPositions;
  const Positions* joints = &kNoPositions;  ///< positions of the rig's joints
  /// content of each image file of the face's blended textures; empty if there are none
  std::span<const std::string_view> images = {};
  std::span<const std::string> image_names = {};  ///< paths of the images, relative to the mesh
  /// name of the face's material file; empty: the target head's file
  std::string material_file = {};
  /// for an attachment: name of its colour, from colour_label; empty: the attachment has no tint
  std::string colour_label = {};
};

/// The data from which encoders are made. These data must outlive the encoders and the encoded
/// files.
struct MeshSource {
  const Config& config;
  const Inputs& inputs;
  std::span<const MeshLevel> levels;    ///< the whole mesh, then each level of detail
  std::span<const Index> target_heads;  ///< targets of all faces that will be encoded
  /// Relative path from the folder of a mesh to the folder of files that all meshes share (such as
  /// material files), for example ".."; empty: same folder.
  std::string shared_folder;
};
/// Whether the mesh file of a head has normals.
inline bool has_normals(const Inputs& inputs, Index head) {
  return !inputs.head_files[static_cast<std::size_t>(head)].corner_normals.empty();
}

/// Whether each face gets a separate texture for this attachment. True only for the body (which is
/// also an attachment), if `neck.body_texture` is set.
bool has_own_texture(const MeshSource& source, const Attachment& item);

/// Encodes faces in one format at one level of detail. Thread-safe.
struct MeshEncoder {
  /// Encodes a face at this level of detail. The encoded file refers to this encoder and to the
  /// data of `face`. \throws InvalidInput if positions are not finite.
  std::function<EncodedFile(const FaceMesh& face)> encode;
  /// In bytes: memory of the encoder, and maximum memory for encoding one face.
  std::size_t memory_bytes = 0, encoding_memory_bytes = 0;
};
/// One encoder for each level of detail for which files of the format are written.
using MeshEncoders = std::vector<MeshEncoder>;

/// Makes an encoder.
/// \param format_data  the part of a file that is equal for all faces, converted for one format
/// \param encode       returns the encoded file, given `format_data` and a face
template <class FormatData, class Encode>
MeshEncoder make_encoder(std::shared_ptr<const FormatData> format_data, const Encode& encode) {
  return {[=](const FaceMesh& face) { return encode(*format_data, face); },
          format_data->memory_bytes(), format_data->encoding_memory_bytes()};
}

/// Makes the encoders of a format.
/// \throws InvalidInput if the format cannot store the mesh of `source`.
MeshEncoders make_mesh_encoders(MeshFormat format, const MeshSource& source);

/// Additional files of one format, shared by all faces of a crowd.
struct SharedFiles {
  std::string ledger_item;  ///< name of the ledger entry that records these files
  Digest key;               ///< hash of everything that determines the files
  /// whether the faces' mesh files refer to the shared files
  bool is_referenced_by_meshes = false;
  /// Writes the shared files below the folder of meshes. \return the paths of the written files.
  std::function<std::vector<std::filesystem::path>(const std::filesystem::path& folder)> write;
};
/// The shared files of a format; nothing if the format needs none.
std::optional<SharedFiles> shared_files(MeshFormat format, const Config& config,
                                        const Inputs& inputs);

/// Returns an encoder of an attachment's separate OBJ files. The file of the whole attachment keeps
/// the text of the original file, with new positions and a new path to the materials. The file of a
/// reduced attachment is a plain OBJ file.
/// \param item, level  must outlive the encoder; null `level`: the whole attachment
/// \param shared       see MeshSource::shared_folder
MeshEncoder obj_attachment(const Attachment& item, const DetailLevel* level,
                           const std::string& shared);

/// Numbers of elements (vertices, polygons and so on) in a face's files, for estimates of file
/// sizes.
struct MeshSize {
  std::uint64_t vertex_count = 0, polygon_count = 0, corner_count = 0, uv_count = 0;
  std::uint64_t displacement_count = 0;  ///< number of displacements in all shapes
  std::uint64_t obj_bytes = 0;           ///< size of a head's OBJ file, in bytes
  std::uint64_t shape_count = 0;
};
/// Approximate total size, in bytes, of a face's files in these formats.
std::uint64_t estimate_mesh_bytes(const Inputs& inputs, std::span<const MeshFormat> formats);

// Each of these functions makes the encoders of one format. make_mesh_encoders calls them.
MeshEncoders obj_encoders(const MeshSource& source);
MeshEncoders ply_encoders(const MeshSource& source);
MeshEncoders glb_encoders(const MeshSource& source);
MeshEncoders npy_encoders(const MeshSource& source);
MeshEncoders usd_encoders(const MeshSource& source);

}  // namespace crowdface
