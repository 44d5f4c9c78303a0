// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/face_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <optional>
#include <span>
#include <utility>

#include <Eigen/Geometry>

#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"
#include "crowdface/mesh/all_columns.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/mesh/winding.h"
#include "crowdface/preview/reduced_mesh.h"
#include "crowdface/render/camera_space.h"
#include "crowdface/render/eyeballs.h"
#include "crowdface/render/ray_scene.h"
#include "crowdface/render/sampling_pattern.h"
#include "crowdface/render/screen_quads.h"
#include "crowdface/render/shading.h"
#include "crowdface/render/skin_specular.h"
#include "crowdface/render/tile_renderer.h"

namespace crowdface {

namespace {

/// Distance of ray origins from the surface, in camera space (half the side of the image is 1).
/// Used instead of kRayClearance if the mesh that occludes light is reduced, so that rays start
/// outside the reduced surface.
constexpr float kReducedClearance = 2e-3F;

/// Memory for rendering one face. This memory can be large, so it is reused for the next face.
struct Workspace {
  std::vector<float> points;
  CameraNormals normals;
  ScreenQuads rasterizer;
  std::vector<float> occluder_points;
  std::unique_ptr<RayScene> occluders;
};

/// Stores idle workspaces. One thread at a time uses a workspace. Every workspace builds its
/// ray-tracing tree for the average face, so that a face has the same pixels in every workspace.
class WorkspacePool {
 public:
  std::unique_ptr<Workspace> take() {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) return std::make_unique<Workspace>();
    std::unique_ptr<Workspace> workspace = std::move(idle_.back());
    idle_.pop_back();
    return workspace;
  }
  void give_back(std::unique_ptr<Workspace> workspace) {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(workspace));
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<Workspace>> idle_;
};

/// The geometry that occludes light.
struct Occluders {
  /// indices of the face mesh's vertices that the occluding geometry uses; empty: all vertices
  std::vector<std::uint32_t> vertices;
  /// the quads that occlude light, as indices into `vertices`; empty: all quads of the mesh
  std::vector<Quad> quads;
  /// x, y, z of each occluding vertex in the average face. If empty, there is no average face, and
  /// the renderer builds a new scene for each face.
  std::vector<float> average_positions;
};

/// Largest number of occluding triangles. Reducing a larger mesh removes only detail far smaller
/// than a pixel.
constexpr std::size_t kMaxOccluders = 100'000;

Occluders occluders_of(const std::vector<Quad>& quads, const Positions& average_positions) {
  Occluders occluders;
  const auto points = [](const Positions& positions) {
    return std::vector<float>(positions.data(), positions.data() + positions.size());
  };
  if (quads.size() <= kMaxOccluders) {
    occluders.average_positions = points(average_positions);
    return occluders;
  }
  std::vector<Triangle> triangles;
  for (const Quad& quad : quads) {
    triangles.push_back({quad[0], quad[1], quad[2]});
    if (quad[2] != quad[3]) triangles.push_back({quad[0], quad[2], quad[3]});
  }
  ReducedMesh reduced = reduce_mesh(triangles, average_positions, kMaxOccluders);
  occluders.vertices = std::move(reduced.vertices);
  occluders.quads = quads_of(reduced.triangles);
  occluders.average_positions = points(average_positions(occluders.vertices, kAllColumns));
  return occluders;
}

}  // namespace

struct FaceRenderer::PreparedMesh {
  Topology topology;
  NormalFans fans;
  RenderOptions options;
  Sampling sampling;
  std::vector<Quad> quads;
  std::vector<SurfaceKind> quad_kinds;
  /// for each quad: its linear colour, or nothing if the quad has the default colour of its kind;
  /// the list is empty if all quads have default colours
  std::vector<std::optional<LinearRgb>> quad_colours;
  /// texture coordinates of each quad; empty if the mesh has none
  std::vector<TexturedQuad> quad_uvs;
  Eyeballs eyeballs;
  RayDevice device;
  Occluders occluders;
  WorkspacePool workspaces;
  /// result of winding_sign for the average face, which holds for all faces; empty without
  /// average face
  std::optional<float> winding;

  PreparedMesh(const Topology& mesh, const RenderOptions& choice)
      : topology(mesh),
        fans(mesh),
        options(choice),
        sampling(choice.samples_per_side, choice.key_light_rays, choice.sky_rays) {}

  /// Updates the workspace's scene of occluders from `workspace.points`.
  void update_occluders(Workspace& workspace) const {
    std::vector<float>& points = workspace.occluder_points;
    if (occluders.vertices.empty()) {
      points = workspace.points;
    } else {
      points.resize(3 * occluders.vertices.size());
      for (std::size_t i = 0; i < occluders.vertices.size(); ++i) {
        std::copy_n(workspace.points.data() + std::size_t{3} * occluders.vertices[i], 3,
                    points.data() + 3 * i);
      }
    }
    if (occluders.average_positions.empty()) {
      workspace.occluders = std::make_unique<RayScene>(device, std::move(points), quads);
      return;
    }
    if (workspace.occluders == nullptr) {
      workspace.occluders = std::make_unique<RayScene>(
          device, occluders.average_positions, occluders.vertices.empty() ? quads : occluders.quads,
          RayScene::Tree::kMovable);
    }
    workspace.occluders->set_points(points);
  }
};

namespace {

void add_fan(std::span<const std::uint32_t> face, std::vector<Quad>& quads) {
  if (face.size() == 4) return quads.push_back({face[0], face[1], face[2], face[3]});
  for (std::size_t c = 1; c + 1 < face.size(); ++c) {
    quads.push_back({face[0], face[c], face[c + 1], face[c + 1]});
  }
}

/// Splits the texture coordinates of a polygon into quads, as add_fan splits the polygon's
/// vertices.
void add_coordinates(const Topology& topology, const TextureCoordinates& uvs, Index face,
                     std::vector<TexturedQuad>& quads) {
  if (uvs.rows() == 0 || topology.corner_uvs.empty()) return;
  std::vector<Quad> fan;
  add_fan(topology.face_uvs(face), fan);
  for (const Quad& quad : fan) {
    TexturedQuad textured{static_cast<std::uint32_t>(face), {}};
    for (std::size_t c = 0; c < 4; ++c) {
      // If a corner of the polygon has no texture coordinates, the polygon gets no texture.
      if (quad[c] == kNoIndex) textured.face = TextureSet::kNone;
      if (quad[c] != kNoIndex) textured.uvs[c] = uvs.row(quad[c]).transpose().cast<float>();
    }
    quads.push_back(textured);
  }
}

void check_size(const Topology& topology, const Positions& positions) {
  require(positions.rows() == topology.vertex_count, "render: ", positions.rows(), " positions, ",
          topology.vertex_count, " vertices");
}

void check(const Topology& topology, const RenderOptions& options, const Surfaces& surfaces) {
  require(options.size_px >= 1 && options.size_px <= 16384, "render: ", options.size_px, " pixels");
  require(options.samples_per_side >= 1 && options.samples_per_side <= 16 &&
              options.key_light_rays >= 1 && options.key_light_rays <= 256 &&
              options.sky_rays >= 1 && options.sky_rays <= 256,
          "render: ", options.samples_per_side, " samples a side, ", options.key_light_rays,
          " and ", options.sky_rays, " rays to the lights");
  for (const std::size_t found : {surfaces.kinds.size(), surfaces.polygon_colours.size()}) {
    require(found == 0 || static_cast<Index>(found) == topology.face_count(), "render: ", found,
            " surfaces, ", topology.face_count(), " faces");
  }
}

}  // namespace

FaceRenderer::FaceRenderer(const Topology& topology, const RenderOptions& options,
                           const Surfaces& surfaces, const Positions* average_face) {
  check(topology, options, surfaces);
  const std::vector<SurfaceKind>& kinds = surfaces.kinds;
  if (average_face != nullptr) check_size(topology, *average_face);
  prepared_ = std::make_unique<PreparedMesh>(topology, options);
  if (average_face != nullptr) prepared_->winding = winding_sign(topology, *average_face);
  prepared_->eyeballs = find_eyeballs(topology, kinds);
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto kind = kinds.empty() ? SurfaceKind::kSkin : kinds[static_cast<std::size_t>(f)];
    if (kind == SurfaceKind::kHidden) continue;
    add_fan(topology.face(f), prepared_->quads);
    add_coordinates(topology, surfaces.uvs, f, prepared_->quad_uvs);
    prepared_->quad_kinds.resize(prepared_->quads.size(), kind);
    if (surfaces.polygon_colours.empty()) continue;
    const auto& paint = surfaces.polygon_colours[static_cast<std::size_t>(f)];
    prepared_->quad_colours.resize(
        prepared_->quads.size(),
        paint ? std::optional<LinearRgb>(from_srgb(*paint)) : std::nullopt);
  }
  if (average_face == nullptr) return;
  // Choose the occluders once for all cameras: a camera only rotates and scales the points.
  prepared_->occluders = occluders_of(prepared_->quads, *average_face);
}
FaceRenderer::~FaceRenderer() = default;

Rgb8Image FaceRenderer::render(const Positions& positions, const Camera& camera,
                               const VertexColours* colours, const TextureSet* texture_set,
                               std::span<const AttachmentMesh> attachments) const {
  const Topology& topology = prepared_->topology;
  check_size(topology, positions);
  require(colours == nullptr || colours->rows() == topology.vertex_count,
          "render: the number of colours differs from the number of vertices");
  require(texture_set == nullptr ||
              static_cast<Index>(texture_set->texture_of_polygon.size()) == topology.face_count(),
          "render: the number of texture indices differs from the number of polygons");
  std::unique_ptr<Workspace> workspace = prepared_->workspaces.take();
  to_camera_space(positions, camera, workspace->points);
  const Eigen::Vector3f gaze = to_camera_space(camera, prepared_->options.front);
  std::vector<EyeballSphere> eyes = eyeball_spheres(prepared_->eyeballs, workspace->points, gaze);
  // If the constructor got an average face, all faces have the winding of the average face.
  const float sign = prepared_->winding ? *prepared_->winding : winding_sign(topology, positions);
  workspace->normals.compute(topology, prepared_->fans, workspace->points, sign);
  const auto distance = static_cast<float>(1 / camera.tan_half_fov);
  workspace->rasterizer.project(workspace->points, prepared_->quads, distance,
                                prepared_->options.size_px);
  prepared_->update_occluders(*workspace);
  std::optional<AttachmentScene> attachment_scene;
  if (!attachments.empty()) {
    attachment_scene.emplace(prepared_->device, attachments, camera, prepared_->options.size_px);
  }
  std::vector<float> skin_lightnesses;
  if (texture_set != nullptr) {
    for (const auto& texture : texture_set->textures)
      skin_lightnesses.push_back(skin_lightness(*texture));
  }
  const HeadScene scene{workspace->points,
                        workspace->rasterizer,
                        *workspace->occluders,
                        prepared_->occluders.vertices.empty() ? kRayClearance : kReducedClearance,
                        workspace->normals.normals,
                        sign,
                        colours,
                        prepared_->quads,
                        prepared_->quad_kinds,
                        prepared_->quad_colours,
                        prepared_->quad_uvs,
                        texture_set,
                        std::move(skin_lightnesses),
                        prepared_->eyeballs,
                        std::move(eyes),
                        gaze,
                        attachment_scene ? &*attachment_scene : nullptr,
                        prepared_->options.ambient_occlusion,
                        Eigen::Vector3f(0, 0, distance)};
  const int size = prepared_->options.size_px;
  const int tiles = (size + kSquareSide - 1) / kSquareSide;
  Rgb8Image image(size, size);
  parallel_for_each(std::ptrdiff_t{tiles} * tiles, [&](std::ptrdiff_t tile) {
    render_tile(scene, prepared_->sampling, static_cast<int>(tile % tiles) * kSquareSide,
                static_cast<int>(tile / tiles) * kSquareSide, image);
  });
  prepared_->workspaces.give_back(std::move(workspace));
  return image;
}

}  // namespace crowdface
