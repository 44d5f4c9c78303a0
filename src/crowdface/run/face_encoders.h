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

#include "crowdface/cast/face_plan.h"
#include "crowdface/config/config.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/io/encoded_file.h"
#include "crowdface/io/mesh_format.h"
#include "crowdface/mesh/displacements.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/pictures/crowd_renders.h"
#include "crowdface/run/attachments_in_format.h"
#include "crowdface/run/face_texture_encoder.h"
#include "crowdface/run/mesh_encoder.h"
#include "crowdface/run/mesh_level.h"
#include "crowdface/shapes/point_carrier.h"

namespace crowdface {

class FaceEncoders;

/// A blended face and everything that its files contain.
struct FinishedFace {
  FinishedFace(const FacePlan& planned, const Positions& blended)
      : face(planned), positions(blended) {}

  const FacePlan& face;        ///< recipe and attachments of the face
  const Positions& positions;  ///< #V by 3, the blended positions
  /// displacements of each blend shape of the face; empty if no output shows blend shapes
  std::vector<Displacements> moves;
  /// for each blend shape: number of intersecting skin triangles, see FaceShapes::shapes_of_face
  std::vector<Index> skin_intersections;
  /// the attachments of the face and, if files contain the body, the body
  std::vector<PlacedAttachment> placed_attachments;
  ColourRows colours;  ///< #V vertex colours; no rows if there are none
  /// The face's blended textures, encoded as image files; empty if no output file uses them. With
  /// `neck.body_texture`, the last texture belongs to the body.
  std::shared_ptr<FaceTextureEncoder::Encoded> textures =
      std::make_shared<FaceTextureEncoder::Encoded>();
  std::optional<BlendedPicture> body_texture;  ///< texture of the body; empty if nothing shows it
  /// images of the face and its gallery script; empty if the face is not rendered
  std::optional<FacePictures> pictures;

  /// the object that encodes the mesh files of the face; null if no mesh files are written
  const FaceEncoders* encoders = nullptr;
  // FaceEncoders::prepare computes the following members.
  Positions normals;  ///< #V vertex normals; no rows if no file contains normals
  Positions points;   ///< positions of the named points (PointCarrier) on this face
  Positions joints;   ///< positions of the rig's joints
  /// content of each image file of the face's textures, see FaceMesh::images
  std::vector<std::string_view> images;
  /// for each element of `images`: path of the image file, see FaceMesh::image_names
  std::vector<std::string> image_names;
  /// The data of the face at one level of detail. An element of `meshes` refers to these data.
  struct ReducedMesh {
    Positions positions, normals;
    ColourRows colours;
    /// for each blend shape: displacements of the vertices of the reduced mesh
    std::vector<Displacements> moves;
    std::vector<PlacedAttachment> placed_attachments;
  };
  std::deque<ReducedMesh> reduced_meshes;  ///< one per level of detail
  /// the whole mesh, then one mesh per level of detail; these meshes refer to the members above
  std::vector<FaceMesh> meshes;
};

/// Index of a blend shape of the face; without a value: the face at rest.
using ShapeNumber = std::optional<std::size_t>;

/// Encodes the mesh files of a crowd's faces. Holds the data that are equal for all faces.
/// Thread-safe.
class FaceEncoders {
 public:
  /// \param config, inputs  must outlive this object and all files that this object encodes.
  /// \param formats  mesh formats of the faces
  /// \param crowd    all faces that may be written
  /// \param shared   see MeshSource::shared_folder
  /// \throws InvalidInput if a format cannot store the mesh of these faces.
  FaceEncoders(const Config& config, const Inputs& inputs, std::vector<MeshFormat> formats,
               std::span<const FacePlan> crowd, const std::string& shared = {});

  /// Whether any file contains blend shapes.
  bool holds_shapes() const;
  /// Whether blended textures are written, either inside mesh files or as separate files.
  bool holds_textures() const { return texture_encoder_ && !formats_.empty(); }
  /// The encoder of blended textures. \pre the faces have blended textures
  const FaceTextureEncoder& textures() const { return *texture_encoder_; }

  /// Whether GLB and USD files contain the body, as an attachment of each face.
  bool holds_body() const { return config_.neck.write_body; }
  /// The body, as an attachment for the files of a face. The result refers to `face`.
  PlacedAttachment placed_body(const FinishedFace& face) const;

  /// Computes the data that several files of a face need, such as the mesh at each level of detail,
  /// and stores these data in `face`. The stored data refer to other members of `face`, so `face`
  /// must not move in memory afterwards.
  void prepare(FinishedFace& face) const;

  // The following functions require that `prepare` has been called for the face.
  /// Encodes the face's mesh at a level of detail, at rest or in a blend shape.
  EncodedFile mesh(const FinishedFace& face, MeshFormat format, std::size_t level,
                   ShapeNumber shape) const;
  /// Encodes an attachment as a separate OBJ file.
  EncodedFile attachment(const FinishedFace& face, const std::string& name, std::size_t level,
                         ShapeNumber shape) const;
  /// Encodes the points that follow the face, as JSON.
  EncodedFile points(const FinishedFace& face) const;

  /// Memory of this object, in bytes.
  std::size_t memory_bytes() const;
  /// Maximum memory of one face's encoded files, in bytes.
  std::size_t encoding_memory_bytes() const;

 private:
  /// Whether files of this format have vertex normals at this level of detail.
  bool needs_normals(MeshFormat format, std::size_t level, Index target) const;
  /// Computes the vertex normals of a face. The vertices of the neck ring get fixed normals, which
  /// are equal for all faces.
  Positions normals_of(const Positions& positions) const;
  /// Returns the mesh of a face at a level of detail. Stores the reduced data, to which the result
  /// refers, in `face.reduced_meshes`.
  FaceMesh mesh_at_level(std::size_t level, FinishedFace& face) const;

  const Config& config_;
  const Inputs& inputs_;
  std::vector<MeshFormat> formats_;  ///< mesh formats of the faces
  std::vector<MeshLevel> levels_;    ///< the whole mesh, then the levels of detail
  /// for each format: one encoder for each of `levels_`
  std::map<MeshFormat, MeshEncoders> encoders_;
  /// for each level of detail, the encoders of the attachments' separate OBJ files; empty if no
  /// format needs such files
  std::vector<AttachmentsInFormat<MeshEncoder>> attachments_;
  /// encodes the faces' blended textures; empty if faces have none
  std::optional<FaceTextureEncoder> texture_encoder_;
  /// The objects that move the named points (`points_`) and the joints of the rig (`joints_`) with
  /// a face. `points_` is empty if the inputs have no named points; `joints_` is empty if no file
  /// has a rig.
  std::optional<PointCarrier> points_, joints_;
  /// the polygons around each vertex, for vertex normals; empty if no format needs normals
  std::optional<NormalFans> fans_;
};

/// Returns the blend shapes for which an attachment has separate files: none if the attachment is
/// rigid; otherwise the same blend shapes for which faces have separate files.
std::span<const Shape> shapes_in_files(const Attachment& item, std::span<const MeshFormat> formats,
                                       const Inputs& inputs);

}  // namespace crowdface
