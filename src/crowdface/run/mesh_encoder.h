// SPDX-License-Identifier: Apache-2.0
// How a format becomes files: an encoder for each level of detail, made by one factory. A new format is a row in
// io/mesh_format.cpp, an encoder beside obj_encoder.cpp and a row in mesh_encoder.cpp.
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

inline const Positions kNoRows;
inline const ColourRows kNoColours;

/// A face, at rest or in a shape, whole or on a level of detail, with all that a file may have of the face.
struct FaceMesh {
  std::string id;    ///< "market_0001", on a level "market_0001_LOD1"
  std::string what;  ///< names the mesh in messages
  Index target = 0;
  const Positions* positions = &kNoRows;      ///< #V by 3
  const Positions* normals = &kNoRows;        ///< #V by 3; none where no encoder needs them
  std::span<const Displacements> moves = {};  ///< #shapes, or none
  std::span<const WornAttachment> worn = {};  ///< what the face wears
  const ColourRows* colours = &kNoColours;    ///< #V; no rows: it has none at vertices
  const Positions* points = &kNoRows;         ///< that follow the face; none on levels of detail
  const Positions* joints = &kNoRows;         ///< of the rig
  std::span<const std::string_view> images = {};  ///< files of the face's own pictures, or none …
  std::span<const std::string> image_names = {};  ///< … and where they lie, from the mesh
  std::string material_file = {};                 ///< the face's own; empty: the target's
};

/// What encoders are made of. All must outlive the encoders and all that they encode.
struct MeshSource {
  const Config& config;
  const Inputs& inputs;
  std::span<const MeshLevel> levels;  ///< the whole mesh first
  std::span<const Index> targets;     ///< of all faces that will be encoded
  /// The way from a mesh to what all share, material files, say: ".."; empty: beside the mesh.
  std::string shared;
};
/// Whether a head's file has normals.
inline bool has_normals(const Inputs& inputs, Index head) {
  return !inputs.files[static_cast<std::size_t>(head)].corner_normals.empty();
}

/// Encodes faces in one format on one level of detail. Any thread may ask.
struct MeshEncoder {
  /// Of a face on this level. The file refers to the encoder and to what the face refers to.
  /// \throws InvalidInput if positions are not finite.
  std::function<EncodedFile(const FaceMesh& face)> encode;
  /// What the encoder itself takes, and what encoding one face takes at most.
  std::size_t memory_bytes = 0, encode_bytes = 0;
};
/// One for each level on which the format is written.
using MeshEncoders = std::vector<MeshEncoder>;

/// Encodes by a form that is filled in for each face. \param encode  called with the form and the face
template <class Form, class Encode>
MeshEncoder encoder_by(std::shared_ptr<const Form> form, const Encode& encode) {
  return {[=](const FaceMesh& face) { return encode(*form, face); }, form->memory_bytes(),
          form->encode_bytes()};
}

/// \throws InvalidInput if the format cannot hold such a mesh.
MeshEncoders make_mesh_encoders(MeshFormat format, const MeshSource& source);

/// Files that all faces of a crowd share beside their files in one format.
struct SharedFiles {
  std::string item;       ///< of the ledger
  Digest key;             ///< of all that determines them
  bool is_named = false;  ///< whether a face's file names them
  /// Writes them below the folder of meshes. \return the files.
  std::function<std::vector<std::filesystem::path>(const std::filesystem::path& folder)> write;
};
/// None if the format needs none.
std::optional<SharedFiles> shared_files(MeshFormat format, const Config& config,
                                        const Inputs& inputs);

/// An attachment in an OBJ file of its own: its own file with other positions and the place of its materials, on a
/// level of detail a plain one. \param item, level  must outlive the encoder; no level: whole.
/// \param shared  as MeshSource has it
MeshEncoder obj_attachment(const Attachment& item, const DetailLevel* level,
                           const std::string& shared);

/// How many numbers the files of a face have, for estimates.
struct MeshSize {
  std::uint64_t vertices = 0, faces = 0, corners = 0, uvs = 0;
  std::uint64_t moved = 0;      ///< displacements in all shapes
  std::uint64_t obj_bytes = 0;  ///< of a head's file
  std::uint64_t shapes = 0;
};
/// About how many bytes a face takes in these formats.
std::uint64_t estimate_mesh_bytes(const Inputs& inputs, std::span<const MeshFormat> formats);

/// The encoders of one format each, for the table.
MeshEncoders obj_encoders(const MeshSource& source);
MeshEncoders ply_encoders(const MeshSource& source);
MeshEncoders glb_encoders(const MeshSource& source);
MeshEncoders npy_encoders(const MeshSource& source);
MeshEncoders usd_encoders(const MeshSource& source);

}  // namespace crowdface
