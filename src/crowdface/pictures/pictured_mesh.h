// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "crowdface/config/config.h"
#include "crowdface/heads/face_textures.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/pictures/vertex_roughness.h"
#include "crowdface/render/surface_kind.h"
#include "crowdface/render/texture.h"
#include "crowdface/render/vertex_colours.h"

namespace crowdface {

/// The mesh that rendered images show: the mesh of the crowd's faces or, if `neck.show_body` is
/// set, a joint mesh of face and body. The boundary of the body at the neck is joined to the
/// boundary (ring) of the face, so that face and body have the same normals there. The body is cut
/// at the chest. Vertices and polygons of the face come first.
class PicturedMesh {
 public:
  /// Height of the part of the body that images of faces show below the heads, as a fraction of the
  /// heads' height.
  static constexpr double kShoulderHeight = 0.1;

  /// \param inputs    must outlive this object.
  /// \param textures  provide the body's texture; null: the body is not shown.
  PicturedMesh(const Config& config, const Inputs& inputs, const FaceTextures* textures);

  bool has_body() const { return body_.has_value(); }
  const Topology& topology() const { return body_ ? body_->topology : inputs_.head_set.topology; }
  const TextureCoordinates& uvs() const { return body_ ? body_->uvs : inputs_.head_set.uvs; }
  /// The kind of surface of each polygon; all polygons of the body are skin.
  Surfaces surfaces() const;
  /// The vertex positions of the body; no rows if the body is not shown.
  Positions body_points() const { return body_ ? body_->points : Positions(0, 3); }

  /// Returns the lowest body point that images of faces must show.
  /// \pre has_body()
  Eigen::Vector3d lowest_shown_point() const;

  /// Appends the body's vertex positions to the face's vertex positions.
  /// \pre has_body()
  Positions add_body(const Positions& face) const;
  /// Adds the body's texture to the face's textures. The body gets the mean roughness of the face
  /// at the neck ring.
  /// \param body    texture of the body, or null
  /// \param max_px  maximum side length of the body's texture, in texels
  /// \pre has_body()
  TextureSet add_body(TextureSet textures, const BlendedPicture* body, int max_px) const;
  /// Adds the colours of the body's vertices, taken from the body's texture `body`, to the colours
  /// of the face's vertices. If `body` is null, the body is grey.
  /// \pre has_body()
  VertexColours add_body(const VertexColours& face, const BlendedPicture* body) const;

 private:
  /// The body, joined to the mesh of the face.
  struct Body {
    Topology topology;       ///< polygons of the face, then polygons of the body
    TextureCoordinates uvs;  ///< texture coordinates of the face, then those of the body
    /// positions of the body's vertices, except those of the neck ring, which are the face's
    /// vertices
    Positions points;
    /// for each vertex in `points`: a row of `uvs`, the texture coordinates of one polygon corner
    /// at this vertex; kNoIndex if the body has no texture
    std::vector<std::uint32_t> uv_rows;
    /// positions of the neck ring's polygon corners in the face's textures
    std::vector<TexturePoint> ring_texture_points;
  };
  const Config& config_;
  const Inputs& inputs_;
  std::optional<Body> body_;
};

/// A face as images show it: alone or with the body.
class PicturedFace {
 public:
  /// The arguments must outlive this object. \param textures, colours, body  may be null
  PicturedFace(const PicturedMesh& mesh, const Positions& positions,
               const TextureSet* textures = nullptr, const VertexColours* colours = nullptr,
               const BlendedPicture* body = nullptr, int max_px = 0)
      : positions_(&positions), textures_(textures), colours_(colours) {
    if (!mesh.has_body()) return;
    positions_ = &positions_with_body_.emplace(mesh.add_body(positions));
    if (textures != nullptr) {
      textures_ = &textures_with_body_.emplace(mesh.add_body(*textures, body, max_px));
    }
    if (colours != nullptr) colours_ = &colours_with_body_.emplace(mesh.add_body(*colours, body));
  }
  PicturedFace(const PicturedFace&) = delete;
  PicturedFace& operator=(const PicturedFace&) = delete;

  const Positions& positions() const { return *positions_; }
  const TextureSet* textures() const { return textures_; }
  const VertexColours* colours() const { return colours_; }

 private:
  const Positions* positions_;
  const TextureSet* textures_;
  const VertexColours* colours_;
  std::optional<Positions> positions_with_body_;
  std::optional<TextureSet> textures_with_body_;
  std::optional<VertexColours> colours_with_body_;
};

}  // namespace crowdface
