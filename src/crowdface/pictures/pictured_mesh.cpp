// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pictures/pictured_mesh.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "crowdface/heads/heads_on_body.h"
#include "crowdface/mesh/all_columns.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/pictures/surfaces.h"

namespace crowdface {
namespace {

/// Farthest distance of the shown body from the middle of the ring, as a fraction of the height of
/// the heads.
constexpr double kChest = 0.85;

/// For each vertex of the body, whether it is near enough to the ring to appear in pictures.
std::vector<bool> above_chest(const Config& config, const Inputs& inputs, const Positions& body) {
  const Eigen::VectorXd heights = inputs.mean * unit_vector(config.faces.up);
  const Positions& ring = inputs.neck->seam.positions;
  const Eigen::RowVector3d middle = ring.colwise().mean();
  const double reach = kChest * (heights.maxCoeff() - heights.minCoeff());
  std::vector<bool> shown;
  for (Index v = 0; v < body.rows(); ++v) shown.push_back((body.row(v) - middle).norm() < reach);
  return shown;
}

}  // namespace

PicturedMesh::PicturedMesh(const Config& config, const Inputs& inputs, const FaceTextures* textures)
    : config_(config), inputs_(inputs) {
  if (textures == nullptr || !config.neck.show_body) return;
  const HeadsOnBody& neck = *inputs.neck;
  const BodyPainter* painter = textures->body();
  const Topology& topology = painter != nullptr ? painter->topology() : neck.body->file.topology;
  const Positions& positions = neck.body->file.positions;
  const std::vector<bool> shown = above_chest(config, inputs, positions);
  Body body{inputs.faces.topology, inputs.faces.uvs, Positions(0, 3), {}};
  const auto uv_rows = static_cast<std::uint32_t>(body.uvs.rows());
  if (painter != nullptr) {
    body.uvs.conservativeResize(body.uvs.rows() + painter->uvs().rows(), Eigen::NoChange);
    body.uvs.bottomRows(painter->uvs().rows()) = painter->uvs();
    if (body.topology.corner_uvs.empty()) {
      body.topology.corner_uvs.assign(body.topology.corner_vertices.size(), kNoIndex);
    }
  }
  // In the joined mesh, the body shares the vertices of the face's ring. Its other vertices are
  // numbered after all vertices of the face.
  std::vector<std::uint32_t> number(shown.size(), kNoIndex), rows;
  for (std::size_t i = 0; i < neck.body_rim.size(); ++i) {
    number[neck.body_rim[i]] = neck.seam.rim[i];
  }
  const auto first = static_cast<std::uint32_t>(body.topology.vertex_count);
  const bool with_uvs = !body.topology.corner_uvs.empty();
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto face = topology.face(f);
    if (!std::ranges::all_of(face, [&](std::uint32_t v) { return shown[v]; })) continue;
    std::vector<std::uint32_t> corners, uvs;
    for (std::size_t c = 0; c < face.size(); ++c) {
      std::uint32_t& to = number[face[c]];
      const std::uint32_t uv = painter != nullptr ? topology.face_uvs(f)[c] : kNoIndex;
      uvs.push_back(uv == kNoIndex ? kNoIndex : uv_rows + uv);
      if (to == kNoIndex) {
        to = first + static_cast<std::uint32_t>(rows.size());
        rows.push_back(face[c]);
        body.first_uv.push_back(uvs.back());
      }
      corners.push_back(to);
    }
    body.topology.add_face(corners, with_uvs ? uvs : std::vector<std::uint32_t>());
  }
  body.points = positions(rows, kAllColumns);
  body.topology.vertex_count += body.points.rows();
  body_.emplace(std::move(body));
}

Surfaces PicturedMesh::surfaces() const {
  Surfaces surfaces = surfaces_of(config_, inputs_);
  if (!body_) return surfaces;
  const auto polygons = static_cast<std::size_t>(body_->topology.face_count());
  surfaces.kinds.resize(polygons, SurfaceKind::kSkin);
  if (!surfaces.paints.empty()) surfaces.paints.resize(polygons);
  if (surfaces.uvs.rows() > 0) surfaces.uvs = body_->uvs;
  return surfaces;
}

Positions PicturedMesh::with_body(const Positions& face) const {
  Positions joined(face.rows() + body_->points.rows(), 3);
  joined << face, body_->points;
  return joined;
}

TextureSet PicturedMesh::with_body(TextureSet textures, const BlendedPicture* body,
                                   int max_px) const {
  const auto polygons = static_cast<std::size_t>(body_->topology.face_count());
  const auto faces = static_cast<std::size_t>(inputs_.faces.topology.face_count());
  textures.of_face.resize(faces, TextureSet::kNone);
  textures.of_face.resize(polygons, body == nullptr
                                        ? TextureSet::kNone
                                        : static_cast<std::uint32_t>(textures.textures.size()));
  if (body != nullptr) {
    textures.textures.push_back(std::make_shared<const Texture>(texture_of(*body, max_px)));
  }
  for (TextureLayer* layer : {&textures.slopes, &textures.roughness}) {
    if (!layer->of_face.empty()) layer->of_face.resize(polygons, TextureLayer::kNone);
  }
  return textures;
}

VertexColours PicturedMesh::with_body(const VertexColours& face, const BlendedPicture* body) const {
  const float grey = to_srgb(albedo_of(SurfaceKind::kSkin))[1];
  VertexColours joined = VertexColours::Constant(face.rows() + body_->points.rows(), 3, grey);
  joined.topRows(face.rows()) = face;
  if (body == nullptr) return joined;
  const Texture texture = texture_of(*body, std::max(body->width, body->height));
  for (std::size_t i = 0; i < body_->first_uv.size(); ++i) {
    if (body_->first_uv[i] == kNoIndex) continue;
    const Eigen::Vector2f uv = body_->uvs.row(body_->first_uv[i]).transpose().cast<float>();
    joined.row(face.rows() + static_cast<Index>(i)) =
        to_srgb(colour_at(texture, uv)).matrix().transpose();
  }
  return joined;
}

}  // namespace crowdface
