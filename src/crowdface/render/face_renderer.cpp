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

#include "crowdface/core/error.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/render/camera_space.h"
#include "crowdface/render/eyeballs.h"
#include "crowdface/render/perpendicular.h"
#include "crowdface/render/ray_scene.h"
#include "crowdface/render/sampling_pattern.h"
#include "crowdface/render/shading.h"

namespace crowdface {

namespace {

/// Scenes that are used again and again, each by one thread at a time. All have the same tree, that
/// of the typical face, so that it does not matter which face gets which.
class ScenePool {
 public:
  /// \param typical  empty: scenes are built for once.
  void start(const RayDevice& device, const std::vector<Quad>& quads, std::vector<float> typical) {
    device_ = &device;
    quads_ = &quads;
    typical_ = std::move(typical);
  }

  std::unique_ptr<RayScene> take(std::vector<float> points) {
    if (typical_.empty()) return std::make_unique<RayScene>(*device_, std::move(points), *quads_);
    std::unique_ptr<RayScene> scene = take_idle();
    if (scene == nullptr) {
      scene = std::make_unique<RayScene>(*device_, typical_, *quads_, RayScene::Tree::kForMoves);
    }
    scene->move_points(std::move(points));
    return scene;
  }

  void give_back(std::unique_ptr<RayScene> scene) {
    if (typical_.empty()) return;
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(scene));
  }

 private:
  std::unique_ptr<RayScene> take_idle() {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) return nullptr;
    std::unique_ptr<RayScene> scene = std::move(idle_.back());
    idle_.pop_back();
    return scene;
  }

  const RayDevice* device_ = nullptr;
  const std::vector<Quad>* quads_ = nullptr;
  std::vector<float> typical_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<RayScene>> idle_;
};

}  // namespace

struct FaceRenderer::Prepared {
  Topology topology;
  NormalFans fans;
  RenderOptions options;
  SamplingPattern pattern;
  std::vector<Quad> quads;
  std::vector<SurfaceKind> quad_kinds;
  std::vector<std::optional<Light>> quad_paints;  ///< linear; or empty
  Eyeballs eyeballs;
  RayDevice device;
  ScenePool scenes;
  std::optional<float> winding;  ///< of the typical face, which all others share

  Prepared(const Topology& mesh, const RenderOptions& choice)
      : topology(mesh),
        fans(mesh),
        options(choice),
        pattern(choice.samples_per_side, choice.occlusion_rays) {}
};

namespace {

using Vector = Eigen::Vector3f;

// Lengths are in half the side of the image, so that these hold for any unit.
constexpr float kSkyReach = 0.55F;    // how far ambient occlusion looks
constexpr float kClearance = 2e-4F;   // rays start this far above the surface
constexpr float kThickness = 0.012F;  // how deep light soaks in: softens where shadows begin
constexpr int kTile = 16;

/// A head as the camera sees it: x right, y up, z towards the camera, target at the origin, half
/// the image's side as unit.
struct Stage {
  const RayScene& scene;
  std::vector<Vector> normals;  ///< #V
  const VertexColours* colours;
  const std::vector<Quad>& quads;
  const std::vector<SurfaceKind>& kinds;
  const std::vector<std::optional<Light>>& paints;
  const Eyeballs& eyeballs;
  std::vector<PlacedEye> eyes;
  Vector gaze;
  Vector viewer;
};

/// Shares of a primitive's four vertices in a point on it.
Eigen::Vector4f shares(const Quad& quad, float u, float v) {
  if (quad[2] == quad[3]) return {1 - u - v, u, v, 0};
  return {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
}

Light own_albedo(const Stage& stage, std::uint32_t primitive, const Vector& point) {
  if (!stage.paints.empty() && stage.paints[primitive]) return *stage.paints[primitive];
  const SurfaceKind kind = stage.kinds[primitive];
  if (kind != SurfaceKind::kEye) return albedo_of(kind);
  const std::uint32_t eye = stage.eyeballs.of_vertex[stage.quads[primitive][0]];
  return eye_albedo(stage.eyes[eye], stage.gaze, point);
}

/// A point of the surface that a camera ray has met.
struct Meeting {
  Vector point;
  Vector start;  ///< where rays to the lights begin
  ShadePoint surface;
};

Meeting meet(const Stage& stage, const RayHit& hit, const Vector& direction) {
  const Quad& quad = stage.quads[hit.primitive];
  const Eigen::Vector4f weights = shares(quad, hit.u, hit.v);
  Meeting meeting;
  meeting.point = stage.viewer + hit.distance * direction;
  meeting.surface.kind = stage.kinds[hit.primitive];
  Vector normal = Vector::Zero();
  Vector colour = Vector::Zero();
  for (int c = 0; c < 4; ++c) {
    const std::uint32_t vertex = quad[static_cast<std::size_t>(c)];
    normal += weights[c] * stage.normals[vertex];
    if (stage.colours != nullptr) colour += weights[c] * stage.colours->row(vertex).transpose();
  }
  meeting.surface.albedo = stage.colours != nullptr
                               ? from_srgb(colour.array())
                               : own_albedo(stage, hit.primitive, meeting.point);
  // The side that is seen is told by the vertices' normals, which winding() has turned outwards.
  const Vector geometric = hit.normal.dot(normal) < 0 ? Vector(-hit.normal) : hit.normal;
  meeting.surface.inside = geometric.dot(direction) > 0;
  const float side = meeting.surface.inside ? -1.0F : 1.0F;
  meeting.surface.normal = side * normal.normalized();
  meeting.surface.to_eye = -direction.normalized();
  // Rays start above the facets, on the smooth surface that the normals speak of, lest facets show
  // where light grazes them (Hanika 2021, "Hacking the shadow terminator").
  Vector lift = Vector::Zero();
  for (int c = 0; c < 4; ++c) {
    const std::uint32_t vertex = quad[static_cast<std::size_t>(c)];
    const Vector n = side * stage.normals[vertex];
    lift -= weights[c] * std::min(0.0F, (meeting.point - stage.scene.point(vertex)).dot(n)) * n;
  }
  meeting.start = meeting.point + lift + kClearance * side * geometric.normalized();
  return meeting;
}

/// A direction given as a point of the disc around `axis`, turned by the pixel's angle.
struct Turned {
  Vector s, t;
  Turned(const Vector& axis, const Eigen::Vector2f& turn) {
    const auto [a, b] = perpendicular(axis);
    s = turn.x() * a + turn.y() * b;
    t = turn.x() * b - turn.y() * a;
  }
  Vector operator()(const Eigen::Vector2f& disc) const { return disc.x() * s + disc.y() * t; }
};

/// Share of the sky seen from a point, weighted by the cosine.
float sky_share(const RayScene& scene, const Meeting& meeting,
                std::span<const Eigen::Vector2f> discs, const Eigen::Vector2f& turn) {
  if (discs.empty()) return 1;
  const Turned turned(meeting.surface.normal, turn);
  float open = 0;
  for (const Eigen::Vector2f& disc : discs) {
    const float height = std::sqrt(std::max(0.0F, 1 - disc.squaredNorm()));
    const Vector direction = turned(disc) + height * meeting.surface.normal;
    if (!scene.occluded({meeting.start, direction, 0, kSkyReach})) open += 1;
  }
  return open / static_cast<float>(discs.size());
}

bool key_reaches(const RayScene& scene, const Meeting& meeting, const Eigen::Vector2f& disc,
                 const Eigen::Vector2f& turn) {
  const Vector key = key_direction();
  const Vector direction = (key + kKeyRadius * Turned(key, turn)(disc)).normalized();
  const Vector start = meeting.start + kThickness * meeting.surface.normal;
  return !scene.occluded({start, direction, 0, 1e30F});
}

/// Light along one ray through the image at `place`, a fraction of its side.
Light trace(const Stage& stage, const SamplingPattern& pattern, std::size_t sample,
            const Eigen::Vector2f& place, const Eigen::Vector2f& turn) {
  const Vector direction = Vector(2 * place.x() - 1, 1 - 2 * place.y(), 0) - stage.viewer;
  const auto hit = stage.scene.nearest_hit({stage.viewer, direction});
  if (!hit) return background(place.y());
  Meeting meeting = meet(stage, *hit, direction);
  const std::size_t rays = pattern.sky.size() / pattern.places.size();
  const std::span discs(pattern.sky.data() + sample * rays, rays);
  meeting.surface.sky = sky_share(stage.scene, meeting, discs, turn);
  const bool lit =
      faces_key(meeting.surface) && key_reaches(stage.scene, meeting, pattern.lamp[sample], turn);
  meeting.surface.key = lit ? 1.0F : 0.0F;
  return shade(meeting.surface);
}

void render_tile(const Stage& stage, const SamplingPattern& pattern, int left, int top,
                 Rgb8Image& image) {
  const std::size_t samples = pattern.places.size();
  for (int y = top; y < std::min(top + kTile, image.height); ++y) {
    for (int x = left; x < std::min(left + kTile, image.width); ++x) {
      const Eigen::Vector2f corner(static_cast<float>(x), static_cast<float>(y));
      const Eigen::Vector2f turn = pixel_turn(x, y);
      Light sum = Light::Zero();
      for (std::size_t s = 0; s < samples; ++s) {
        const Eigen::Vector2f place =
            (corner + pattern.places[s]) / static_cast<float>(image.width);
        sum += trace(stage, pattern, s, place, turn);
      }
      const auto pixel = to_srgb8(sum / static_cast<float>(samples));
      std::copy(pixel.begin(), pixel.end(), image.at(x, y));
    }
  }
}

void add_fan(std::span<const std::uint32_t> face, std::vector<Quad>& quads) {
  if (face.size() == 4) return quads.push_back({face[0], face[1], face[2], face[3]});
  for (std::size_t c = 1; c + 1 < face.size(); ++c) {
    quads.push_back({face[0], face[c], face[c + 1], face[c + 1]});
  }
}

void check_size(const Topology& topology, const Positions& positions) {
  if (positions.rows() != topology.vertex_count) {
    throw InvalidInput(concat("expected ", topology.vertex_count, " vertices to render, found ",
                              positions.rows()));
  }
}

/// Whatever the camera: it turns a tree and makes it larger, but another tree is none the better.
std::vector<float> unscaled(const Positions& positions) {
  std::vector<float> points(static_cast<std::size_t>(positions.size()));
  std::transform(positions.data(), positions.data() + positions.size(), points.begin(),
                 [](double value) { return static_cast<float>(value); });
  return points;
}

void check(const Topology& topology, const RenderOptions& options, const Surfaces& surfaces) {
  if (options.size_px < 1 || options.size_px > 16384) {
    throw InvalidInput(concat("a render is 1 to 16384 pixels wide, found ", options.size_px));
  }
  if (options.samples_per_side < 1 || options.samples_per_side > 16 || options.occlusion_rays < 0 ||
      options.occlusion_rays > 256) {
    throw InvalidInput(concat("a render takes 1 to 16 samples a side and 0 to 256 occlusion rays, ",
                              "found ", options.samples_per_side, " and ", options.occlusion_rays));
  }
  for (const std::size_t found : {surfaces.kinds.size(), surfaces.paints.size()}) {
    if (found == 0 || static_cast<Index>(found) == topology.face_count()) continue;
    throw InvalidInput(
        concat("expected a surface for each of ", topology.face_count(), " faces, found ", found));
  }
}

}  // namespace

FaceRenderer::FaceRenderer(const Topology& topology, const RenderOptions& options,
                           const Surfaces& surfaces, const Positions* typical) {
  check(topology, options, surfaces);
  const std::vector<SurfaceKind>& kinds = surfaces.kinds;
  if (typical != nullptr) check_size(topology, *typical);
  prepared_ = std::make_unique<Prepared>(topology, options);
  if (typical != nullptr) prepared_->winding = winding(topology, *typical);
  prepared_->eyeballs = find_eyeballs(topology, kinds);
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto kind = kinds.empty() ? SurfaceKind::kSkin : kinds[static_cast<std::size_t>(f)];
    if (kind == SurfaceKind::kHidden) continue;
    add_fan(topology.face(f), prepared_->quads);
    prepared_->quad_kinds.resize(prepared_->quads.size(), kind);
    if (surfaces.paints.empty()) continue;
    const auto& paint = surfaces.paints[static_cast<std::size_t>(f)];
    prepared_->quad_paints.resize(prepared_->quads.size(),
                                  paint ? std::optional<Light>(from_srgb(*paint)) : std::nullopt);
  }
  prepared_->scenes.start(prepared_->device, prepared_->quads,
                          typical == nullptr ? std::vector<float>() : unscaled(*typical));
}
FaceRenderer::~FaceRenderer() = default;
FaceRenderer::FaceRenderer(FaceRenderer&&) noexcept = default;
FaceRenderer& FaceRenderer::operator=(FaceRenderer&&) noexcept = default;

const RenderOptions& FaceRenderer::options() const {
  return prepared_->options;
}

Rgb8Image FaceRenderer::render(const Positions& positions, const Camera& camera,
                               const VertexColours* colours) const {
  const Topology& topology = prepared_->topology;
  check_size(topology, positions);
  if (colours != nullptr && colours->rows() != topology.vertex_count) {
    throw InvalidInput(
        concat("expected ", topology.vertex_count, " vertex colours, found ", colours->rows()));
  }
  std::vector<float> points = to_camera(positions, camera);
  const Vector gaze = to_camera(camera, prepared_->options.front);
  std::vector<PlacedEye> eyes = place_eyes(prepared_->eyeballs, points, gaze);
  std::unique_ptr<RayScene> scene = prepared_->scenes.take(std::move(points));
  // A crowd is wound like its heads: there is no need to find that out for every face.
  const float sign = prepared_->winding ? *prepared_->winding : winding(topology, positions);
  const Stage stage{*scene,
                    camera_normals(topology, prepared_->fans, positions, camera, sign),
                    colours,
                    prepared_->quads,
                    prepared_->quad_kinds,
                    prepared_->quad_paints,
                    prepared_->eyeballs,
                    std::move(eyes),
                    gaze,
                    Vector(0, 0, static_cast<float>(1 / camera.half_tangent))};
  const int size = prepared_->options.size_px;
  const int tiles = (size + kTile - 1) / kTile;
  Rgb8Image image(size, size);
  parallel_for_each(std::ptrdiff_t{tiles} * tiles, [&](std::ptrdiff_t tile) {
    render_tile(stage, prepared_->pattern, static_cast<int>(tile % tiles) * kTile,
                static_cast<int>(tile / tiles) * kTile, image);
  });
  prepared_->scenes.give_back(std::move(scene));
  return image;
}

}  // namespace crowdface
