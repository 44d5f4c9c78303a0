// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pictures/pictured_mesh.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "crowdface/heads/heads_on_body.h"
#include "crowdface/mesh/all_columns.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/pictures/cut_mesh.h"
#include "crowdface/pictures/surfaces.h"

namespace crowdface {
namespace {

/// The body is shown up to this distance from the middle of the neck ring, as a fraction of the
/// height of the heads.
constexpr double kChest = 0.85;

/// Returns, for each vertex of the body, the signed distance from the cut at the chest. Images do
/// not show vertices with negative distances.
std::vector<double> above_chest(const Config& config, const Inputs& inputs, const Positions& body) {
  const Eigen::VectorXd heights = inputs.mean_head * unit_vector(config.faces.up);
  const Eigen::RowVector3d middle = inputs.heads_on_body->seam.positions.colwise().mean();
  const double reach = kChest * (heights.maxCoeff() - heights.minCoeff());
  std::vector<double> above;
  for (Index v = 0; v < body.rows(); ++v) above.push_back(reach - (body.row(v) - middle).norm());
  return above;
}

/// Returns, for each polygon corner at a vertex of the neck ring, the corner's texture position.
std::vector<TexturePoint> texture_points_at(const Rim& rim, const HeadSet& head_set) {
  std::vector<TexturePoint> places;
  const VertexFaces around(head_set.topology);
  for (const std::uint32_t vertex : rim) {
    for (const std::uint32_t face : around.items_of(vertex)) {
      const auto corners = head_set.topology.face(face), uvs = head_set.topology.face_uvs(face);
      for (std::size_t c = 0; c < uvs.size(); ++c) {
        if (corners[c] != vertex || uvs[c] == kNoIndex) continue;
        places.push_back({face, head_set.uvs.row(uvs[c]).transpose().cast<float>()});
      }
    }
  }
  return places;
}

}  // namespace

PicturedMesh::PicturedMesh(const Config& config, const Inputs& inputs, const FaceTextures* textures)
    : config_(config), inputs_(inputs) {
  if (textures == nullptr || !config.neck.show_body) return;
  const HeadsOnBody& neck = *inputs.heads_on_body;
  const BodyPainter* painter = textures->body_painter();
  const Positions& positions = neck.body->file.positions;
  const Mesh whole{painter != nullptr ? painter->topology() : neck.body->file.topology, positions,
                   painter != nullptr ? painter->uvs() : TextureCoordinates(0, 2)};
  const Mesh bust = cut_mesh(whole, above_chest(config, inputs, positions));
  Body body{inputs.head_set.topology, inputs.head_set.uvs, Positions(0, 3), {}, {}};
  const auto uv_rows = static_cast<std::uint32_t>(body.uvs.rows());
  if (painter != nullptr) {
    body.uvs.conservativeResize(body.uvs.rows() + bust.uvs.rows(), Eigen::NoChange);
    body.uvs.bottomRows(bust.uvs.rows()) = bust.uvs;
    if (body.topology.corner_uvs.empty()) {
      body.topology.corner_uvs.assign(body.topology.corner_vertices.size(), kNoIndex);
    }
  }
  // In the joined mesh, the body shares the vertices of the face's neck ring. The other vertices of
  // the body follow after all vertices of the face.
  std::vector<std::uint32_t> number(static_cast<std::size_t>(bust.positions.rows()), kNoIndex),
      rows;
  for (std::size_t i = 0; i < neck.body_rim.size(); ++i) {
    number[neck.body_rim[i]] = neck.seam.rim[i];
  }
  const auto first = static_cast<std::uint32_t>(body.topology.vertex_count);
  const bool with_uvs = !body.topology.corner_uvs.empty();
  for (Index f = 0; f < bust.topology.face_count(); ++f) {
    const auto face = bust.topology.face(f);
    std::vector<std::uint32_t> corners, uvs;
    for (std::size_t c = 0; c < face.size(); ++c) {
      std::uint32_t& to = number[face[c]];
      const std::uint32_t uv = painter != nullptr ? bust.topology.face_uvs(f)[c] : kNoIndex;
      uvs.push_back(uv == kNoIndex ? kNoIndex : uv_rows + uv);
      if (to == kNoIndex) {
        to = first + static_cast<std::uint32_t>(rows.size());
        rows.push_back(face[c]);
        body.uv_rows.push_back(uvs.back());
      }
      corners.push_back(to);
    }
    body.topology.add_face(corners, with_uvs ? uvs : std::vector<std::uint32_t>());
  }
  body.points = bust.positions(rows, kAllColumns);
  body.ring_texture_points = texture_points_at(neck.seam.rim, inputs.head_set);
  body.topology.vertex_count += body.points.rows();
  body_.emplace(std::move(body));
}

Surfaces PicturedMesh::surfaces() const {
  Surfaces surfaces = surfaces_of(config_, inputs_);
  if (!body_) return surfaces;
  const auto polygons = static_cast<std::size_t>(body_->topology.face_count());
  surfaces.kinds.resize(polygons, SurfaceKind::kSkin);
  if (!surfaces.polygon_colours.empty()) surfaces.polygon_colours.resize(polygons);
  if (surfaces.uvs.rows() > 0) surfaces.uvs = body_->uvs;
  return surfaces;
}

Eigen::Vector3d PicturedMesh::lowest_shown_point() const {
  const Eigen::Vector3d up = unit_vector(config_.faces.up);
  const Eigen::VectorXd heights = inputs_.mean_head * up;
  const Eigen::Vector3d middle = inputs_.heads_on_body->seam.positions.colwise().mean().transpose();
  const double low = heights.minCoeff(),
               lowest = low - kShoulderHeight * (heights.maxCoeff() - low);
  return middle + (lowest - middle.dot(up)) * up;
}

Positions PicturedMesh::add_body(const Positions& face) const {
  Positions joined(face.rows() + body_->points.rows(), 3);
  joined << face, body_->points;
  return joined;
}

TextureSet PicturedMesh::add_body(TextureSet textures, const BlendedPicture* body,
                                  int max_px) const {
  const auto polygons = static_cast<std::size_t>(body_->topology.face_count());
  const auto faces = static_cast<std::size_t>(inputs_.head_set.topology.face_count());
  textures.texture_of_polygon.resize(faces, TextureSet::kNone);
  textures.texture_of_polygon.resize(
      polygons,
      body == nullptr ? TextureSet::kNone : static_cast<std::uint32_t>(textures.textures.size()));
  if (body != nullptr) {
    textures.textures.push_back(std::make_shared<const Texture>(texture_of(*body, max_px)));
  }
  if (!textures.slopes.texture_of_polygon.empty()) {
    textures.slopes.texture_of_polygon.resize(polygons, TextureLayer::kNone);
  }
  TextureLayer& roughness = textures.roughness;
  if (roughness.texture_of_polygon.empty()) return textures;
  float sum = 0, count = 0;
  for (const TexturePoint& place : body_->ring_texture_points) {
    if (const auto rough = roughness_at(textures, place)) {
      sum += *rough;
      count += 1;
    }
  }
  const bool known = count > 0 && body != nullptr;
  roughness.texture_of_polygon.resize(
      polygons,
      known ? static_cast<std::uint32_t>(roughness.textures.size()) : TextureLayer::kNone);
  if (known) {
    roughness.textures.push_back(
        std::make_shared<const Texture>(Texture{1, 1, {LinearRgb::Constant(sum / count)}}));
  }
  return textures;
}

VertexColours PicturedMesh::add_body(const VertexColours& face, const BlendedPicture* body) const {
  const float grey = to_srgb(albedo_of(SurfaceKind::kSkin))[1];
  VertexColours joined = VertexColours::Constant(face.rows() + body_->points.rows(), 3, grey);
  joined.topRows(face.rows()) = face;
  if (body == nullptr) return joined;
  const Texture texture = texture_of(*body, std::max(body->width, body->height));
  for (std::size_t i = 0; i < body_->uv_rows.size(); ++i) {
    if (body_->uv_rows[i] == kNoIndex) continue;
    const Eigen::Vector2f uv = body_->uvs.row(body_->uv_rows[i]).transpose().cast<float>();
    joined.row(face.rows() + static_cast<Index>(i)) =
        to_srgb(colour_at(texture, uv)).matrix().transpose();
  }
  return joined;
}

}  // namespace crowdface
