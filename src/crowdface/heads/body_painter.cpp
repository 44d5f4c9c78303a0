// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/body_painter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "crowdface/core/error.h"
#include "crowdface/heads/image_values.h"
#include "crowdface/io/image.h"
#include "crowdface/mesh/all_columns.h"
#include "crowdface/texture/paint_picture.h"
#include "crowdface/texture/surface_statistics.h"

namespace crowdface {
namespace {

/// Texture coordinates that give each polygon its own square of the image; the squares form rows.
struct SquareLayout {
  /// side of the square that each polygon has in the texture, in texels
  static constexpr int kTexels = 4;
  int per_row;

  explicit SquareLayout(Index polygons)
      : per_row(static_cast<int>(std::ceil(std::sqrt(static_cast<double>(polygons))))) {}
  int side() const { return kTexels * per_row; }
  Eigen::RowVector2d place(Index polygon, std::size_t corner, std::size_t corners) const {
    // Each polygon has its own square of kTexels × kTexels texels in the texture. The texture
    // coordinates of the polygon's corners lie on a circle around the square's centre. With this
    // radius (in texels), the corners of a quad are the centres of the square's four corner texels,
    // so interpolation reads no texel outside the square.
    constexpr double kRadius = 1.5 * std::numbers::sqrt2;
    const double angle =
        2 * std::numbers::pi * (static_cast<double>(corner) + 0.5) / static_cast<double>(corners);
    const Index row = polygon / per_row, column = polygon % per_row;
    const Eigen::RowVector2d middle(static_cast<double>(column) + 0.5,
                                    static_cast<double>(row) + 0.5);
    return (kTexels * middle + kRadius * Eigen::RowVector2d(std::cos(angle), std::sin(angle))) /
           side();
  }
};

void lay_out(const SquareLayout& squares, Topology& topology, TextureCoordinates& uvs) {
  topology.corner_uvs.clear();
  uvs.resize(topology.corner_count(), 2);
  for (Index f = 0; f < topology.face_count(); ++f) {
    const std::size_t corners = topology.face(f).size();
    for (std::size_t c = 0; c < corners; ++c) {
      const auto row = static_cast<std::uint32_t>(topology.corner_uvs.size());
      uvs.row(row) = squares.place(f, c, corners);
      topology.corner_uvs.push_back(row);
    }
  }
}

std::shared_ptr<const TextureMap> white_map(int side) {
  TextureMap map{side, side, {}};
  map.planes.assign(3 * map.texel_count(), StoredValue{0});
  return std::make_shared<const TextureMap>(std::move(map));
}

std::shared_ptr<const TextureMap> read_texture_map(const std::filesystem::path& file) {
  const Image image = read_image(file, {.allows_jpeg = true});
  return std::make_shared<const TextureMap>(
      make_texture_map(image.width, image.height, linear_light_of(image)));
}

/// A layout with one image, which holds all polygons that have texture coordinates.
TextureLayout one_picture(const Topology& topology, const TextureMap& map) {
  TextureLayout layout;
  layout.pictures = {{map.width, map.height}};
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto uvs = topology.face_uvs(f);
    layout.picture_of_polygon.push_back(std::ranges::find(uvs, kNoIndex) == uvs.end() ? 0
                                                                                      : kNoIndex);
    layout.tile_of_polygon.push_back({0, 0});
  }
  return layout;
}

/// The low frequencies of a map's optical densities at the vertices of a rim: one row of 3 channels
/// for each vertex.
OpticalDensities coarse_at(const Rim& rim, const Topology& topology, const Positions& positions,
                           const SurfaceTexels& texels,
                           const std::shared_ptr<const TextureMap>& map) {
  const ChebyshevFilter filter(
      SmoothingOperator(build_adjacency(topology), Boundary::kFree, OperatorKind::kLazy),
      positions);
  const SurfaceStatistics statistics = surface_statistics(filter, {texels}, {{map}}, {});
  return statistics.coarse_values.front()(rim, kAllColumns).cast<double>();
}

}  // namespace

BodyPainter::BodyPainter(const HeadsOnBody& neck, double falloff_mm,
                         const std::filesystem::path& texture)
    : heads_on_body_(neck),
      topology_(neck.body->file.topology),
      uvs_(neck.body->file.uvs),
      body_optical_densities_(OpticalDensities::Zero(static_cast<Index>(neck.body_rim.size()), 3)),
      neck_bend_for_colours_(topology_, build_adjacency(topology_), neck.body->file.positions,
                             neck.body_rim, falloff_mm / neck.mm_per_unit) {
  if (texture.empty()) {
    const SquareLayout squares(topology_.face_count());
    lay_out(squares, topology_, uvs_);
    map_ = white_map(squares.side());
  } else {
    if (topology_.corner_uvs.empty()) {
      refuse_file(neck.body->file.path, "expected texture coordinates for neck.body_texture");
    }
    map_ = read_texture_map(texture);
  }
  texels_ =
      std::make_unique<const SurfaceTexels>(topology_, uvs_, one_picture(topology_, *map_), 0);
  if (texture.empty()) return;
  body_optical_densities_ =
      coarse_at(neck.body_rim, topology_, neck.body->file.positions, *texels_, map_);
}

BlendedPicture BodyPainter::paint(const OpticalDensities& ring_densities) const {
  const Positions difference = ring_densities - body_optical_densities_;
  const Eigen::RowVector3d mean = difference.colwise().mean();
  Positions added = mean.replicate(topology_.vertex_count, 1);
  const Positions faded = neck_bend_for_colours_.bend(difference.rowwise() - mean);
  for (std::size_t i = 0; i < neck_bend_for_colours_.vertices().size(); ++i) {
    added.row(neck_bend_for_colours_.vertices()[i]) += faded.row(static_cast<Index>(i));
  }
  for (std::size_t i = 0; i < heads_on_body_.body_rim.size(); ++i) {
    added.row(heads_on_body_.body_rim[i]) = difference.row(static_cast<Index>(i));
  }
  VertexFactorsOfImage fields;
  fields.heads = {0};
  fields.resize(texels_->vertices().size());
  float* out = fields.values.data();
  for (const std::uint32_t vertex : texels_->vertices()) {
    for (Index c = 0; c < 3; ++c) *out++ = static_cast<float>(added(vertex, c));
    *out++ = 1;
  }
  return paint_picture(*texels_, map_->coding, {map_}, fields);
}

}  // namespace crowdface
