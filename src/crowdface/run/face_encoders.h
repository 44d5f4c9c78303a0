// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/cast/cast_face.h"
#include "crowdface/config/config.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/io/encoded_file.h"
#include "crowdface/io/mesh_format.h"
#include "crowdface/mesh/displacements.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/pictures/crowd_renders.h"
#include "crowdface/run/attachment_forms.h"
#include "crowdface/run/mesh_encoder.h"
#include "crowdface/run/mesh_level.h"
#include "crowdface/run/own_textures.h"
#include "crowdface/shapes/point_carrier.h"

namespace crowdface {

class FaceEncoders;

/// A face that is blended, and all that its files hold.
struct FinishedFace {
  FinishedFace(const CastFace& planned, const Positions& blended)
      : face(planned), positions(blended) {}

  const CastFace& face;
  const Positions& positions;
  std::vector<Displacements> moves;  ///< in each shape; none where nothing shows shapes
  std::vector<Index> crossing;       ///< see FaceShapes::of_face
  std::vector<WornAttachment> worn;
  ColourRows colours;  ///< #V; no rows: it has none at vertices
  /// The face's own textures, encoded as image files; empty if no output file uses them.
  std::shared_ptr<OwnTextures::Encoded> textures = std::make_shared<OwnTextures::Encoded>();
  std::optional<FacePictures> pictures;  ///< none: it is not shown

  const FaceEncoders* encoders = nullptr;  ///< null: it has no files of meshes
  /// What `encoders` have found for its files.
  Positions normals, points, joints;
  std::vector<std::string_view> images;
  std::vector<std::string> image_names;
  struct Reduced {
    Positions positions, normals;
    ColourRows colours;
    std::vector<Displacements> moves;
    std::vector<WornAttachment> worn;
  };
  std::deque<Reduced> reduced;   ///< #levels of detail
  std::vector<FaceMesh> meshes;  ///< the whole mesh, then those on levels; refer to the above
};

/// A shape of a face, by number; none: the face at rest.
using ShapeNumber = std::optional<std::size_t>;

/// What all faces of a crowd share in their files, made once. Any thread may encode.
class FaceEncoders {
 public:
  /// \param config, inputs  must outlive this object and all that it encodes.
  /// \param formats  of the faces. \param crowd  all faces that may be written.
  /// \param shared   as MeshSource has it
  /// \throws InvalidInput if a format cannot hold such a mesh.
  FaceEncoders(const Config& config, const Inputs& inputs, std::vector<MeshFormat> formats,
               std::span<const CastFace> crowd, const std::string& shared = {});

  /// Whether files have shapes, and whether faces' own textures stand in files or beside them.
  bool holds_shapes() const;
  bool holds_textures() const { return own_ && !formats_.empty(); }
  const OwnTextures& textures() const { return *own_; }

  /// Computes what all files of a face share: the face at each level of detail. The results refer to `face`, which must
  /// not move in memory afterwards.
  void prepare(FinishedFace& face) const;

  // Of a prepared face:
  EncodedFile mesh(const FinishedFace& face, MeshFormat format, std::size_t level,
                   ShapeNumber shape) const;
  /// An attachment in an OBJ file of its own.
  EncodedFile attachment(const FinishedFace& face, const std::string& name, std::size_t level,
                         ShapeNumber shape) const;
  /// The points that follow the face, as JSON.
  EncodedFile points(const FinishedFace& face) const;

  /// What this object itself takes, and what the files of one face take at most.
  std::size_t memory_bytes() const;
  std::size_t encode_bytes() const;

 private:
  /// Whether files of the format have vertex normals on the level.
  bool needs_normals(MeshFormat format, std::size_t level, Index target) const;
  FaceMesh mesh_on(std::size_t level, FinishedFace& face) const;

  const Config& config_;
  const Inputs& inputs_;
  std::vector<MeshFormat> formats_;
  std::vector<MeshLevel> levels_;
  std::map<MeshFormat, MeshEncoders> encoders_;
  std::vector<AttachmentForms<MeshEncoder>> attachments_;  ///< #levels; none: they have no files
  std::optional<OwnTextures> own_;               ///< none: faces have no textures of their own
  std::optional<PointCarrier> points_, joints_;  ///< if there are any
  std::optional<NormalFans> fans_;               ///< of the vertices, if a format needs normals
};

/// The shapes that an attachment has files of: those that the faces have files of, if the attachment bends.
std::span<const Shape> shapes_in_files(const Attachment& item, std::span<const MeshFormat> formats,
                                       const Inputs& inputs);

}  // namespace crowdface
