// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "crowdface/config/config.h"
#include "crowdface/heads/face_textures.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/pictures/vertex_finish.h"
#include "crowdface/render/surface_kind.h"
#include "crowdface/render/texture.h"
#include "crowdface/render/vertex_colours.h"

namespace crowdface {

/// The mesh that pictures show: the faces' mesh or, with `neck.show_body`, a joint mesh of face and
/// body. The body's rim is joined to the ring of the face, so that both have the same normals
/// there. The body is cut at the chest. Vertices and polygons of the face come first.
class PicturedMesh {
 public:
  /// Height of the body in pictures of faces, below the heads, as a fraction of the heads' height.
  static constexpr double kShoulderHeight = 0.1;

  /// \param inputs    must outlive this object.
  /// \param textures  paint the body; null: the body is not shown.
  PicturedMesh(const Config& config, const Inputs& inputs, const FaceTextures* textures);

  bool has_body() const { return body_.has_value(); }
  const Topology& topology() const { return body_ ? body_->topology : inputs_.faces.topology; }
  const TextureCoordinates& uvs() const { return body_ ? body_->uvs : inputs_.faces.uvs; }
  /// The kinds of surfaces; the surfaces of the body are skin.
  Surfaces surfaces() const;
  /// The points of the body; no rows if it is not shown.
  Positions body_points() const { return body_ ? body_->points : Positions(0, 3); }

  /// A point at the lower edge of pictures that show the body. Requires has_body().
  Eigen::Vector3d lowest_shown() const;

  /// Adds the body to a face. Requires has_body().
  Positions with_body(const Positions& face) const;
  /// The body has the mean roughness of the face at the ring.
  /// \param body    texture of the body, or null
  /// \param max_px  maximum side length of that texture
  TextureSet with_body(TextureSet textures, const BlendedPicture* body, int max_px) const;
  VertexColours with_body(const VertexColours& face, const BlendedPicture* body) const;

 private:
  struct Body {
    Topology topology;                    ///< face and body
    TextureCoordinates uvs;               ///< face and body
    Positions points;                     ///< of the body, without its rim
    std::vector<std::uint32_t> first_uv;  ///< #points, a row of `uvs`; or kNoIndex
    std::vector<TexturePlace> ring;       ///< places on the face at the ring
  };
  const Config& config_;
  const Inputs& inputs_;
  std::optional<Body> body_;
};

/// A face as pictures show it: alone, or with the body.
class PicturedFace {
 public:
  /// The arguments must outlive this object. \param textures, colours, body  may be null
  PicturedFace(const PicturedMesh& mesh, const Positions& positions,
               const TextureSet* textures = nullptr, const VertexColours* colours = nullptr,
               const BlendedPicture* body = nullptr, int max_px = 0)
      : positions_(&positions), textures_(textures), colours_(colours) {
    if (!mesh.has_body()) return;
    positions_ = &joined_positions_.emplace(mesh.with_body(positions));
    if (textures != nullptr) {
      textures_ = &joined_textures_.emplace(mesh.with_body(*textures, body, max_px));
    }
    if (colours != nullptr) colours_ = &joined_colours_.emplace(mesh.with_body(*colours, body));
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
  std::optional<Positions> joined_positions_;
  std::optional<TextureSet> joined_textures_;
  std::optional<VertexColours> joined_colours_;
};

}  // namespace crowdface
