// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/tile_renderer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include <Eigen/Geometry>

#include "crowdface/render/perpendicular.h"

namespace crowdface {
namespace {

using Vector = Eigen::Vector3f;

// Lengths are in half the side of the image, so that these hold for any unit.
constexpr float kSkyReach = 0.55F;    // how far ambient occlusion looks
constexpr float kClearance = 2e-4F;   // rays start this far above the surface
constexpr float kThickness = 0.012F;  // how deep light soaks in: softens where shadows begin

/// Shares of a primitive's four vertices in a point on it.
Eigen::Vector4f shares(const Quad& quad, float u, float v) {
  if (quad[2] == quad[3]) return {1 - u - v, u, v, 0};
  return {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
}

/// The texture's colour, if there is one.
std::optional<Light> texture_albedo(const Stage& stage, std::uint32_t primitive,
                                    const Eigen::Vector4f& weights) {
  if (stage.coat == nullptr || stage.uvs.empty()) return std::nullopt;
  const TexturedQuad& quad = stage.uvs[primitive];
  if (quad.face == TextureCoat::kNone) return std::nullopt;
  const std::uint32_t texture = stage.coat->of_face[quad.face];
  if (texture == TextureCoat::kNone) return std::nullopt;
  Eigen::Vector2f uv = Eigen::Vector2f::Zero();
  for (int c = 0; c < 4; ++c) uv += weights[c] * quad.uvs[static_cast<std::size_t>(c)];
  return colour_at(*stage.coat->textures[texture], uv);
}

Light own_albedo(const Stage& stage, std::uint32_t primitive, const Eigen::Vector4f& weights,
                 const Vector& point) {
  if (const auto colour = texture_albedo(stage, primitive, weights)) return *colour;
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
  std::uint32_t sample;   ///< of the pixel: which of its rays this was
  bool asks_key = false;  ///< whether the key light could reach it at all
};

Meeting meet(const Stage& stage, const RayHit& hit, const Vector& direction, std::size_t sample) {
  const Quad& quad = stage.quads[hit.primitive];
  const Eigen::Vector4f weights = shares(quad, hit.u, hit.v);
  Meeting meeting;
  meeting.sample = static_cast<std::uint32_t>(sample);
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
                               : own_albedo(stage, hit.primitive, weights, meeting.point);
  // The side that is seen is told by the vertices' normals, which winding() has turned outwards.
  const Vector geometric = hit.normal.dot(normal) < 0 ? Vector(-hit.normal) : hit.normal;
  meeting.surface.inside = geometric.dot(direction) > 0;
  const float side = meeting.surface.inside ? -1.0F : 1.0F;
  meeting.surface.normal = side * normal.normalized();
  meeting.surface.to_eye = -direction.normalized();
  meeting.asks_key = faces_key(meeting.surface);
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

/// What a pixel shows, for its neighbours to compare with what they show.
struct Summary {
  Vector point = Vector::Zero();   ///< mean
  Vector normal = Vector::Zero();  ///< mean of unit normals: shorter than 1 where they differ
  float key = 0, sky = 0;          ///< means
  float asked_key = 0, seen = 0;   ///< how many samples these are of
};

/// One square of the image, and a rim of pixels around it that lend what they know of their lights.
class Tile {
 public:
  Tile(const Stage& stage, const SamplingPattern& pattern, int left, int top, int size)
      : stage_(stage),
        pattern_(pattern),
        size_(size),
        left_(left),
        top_(top),
        right_(std::min(left + kTile, size)),
        bottom_(std::min(top + kTile, size)),
        outer_left_(std::max(left - 1, 0)),
        outer_top_(std::max(top - 1, 0)),
        outer_right_(std::min(right_ + 1, size)),
        outer_bottom_(std::min(bottom_ + 1, size)) {}

  void render(Rgb8Image& image) {
    look();
    ask_key();
    ask_sky();
    summarize();
    for (int y = top_; y < bottom_; ++y) {
      for (int x = left_; x < right_; ++x) {
        const auto pixel = to_srgb8(light_at(x, y));
        std::copy(pixel.begin(), pixel.end(), image.at(x, y));
      }
    }
  }

 private:
  struct Pixel {
    std::uint32_t first = 0, end = 0;  ///< of its meetings
    Light backdrop = Light::Zero();    ///< of its samples that met nothing
    Summary summary = {};
  };

  Pixel& pixel(int x, int y) {
    const int width = outer_right_ - outer_left_;
    return pixels_[static_cast<std::size_t>((y - outer_top_) * width + x - outer_left_)];
  }

  template <class Body>
  void for_each_pixel(const Body& body) {
    for (int y = outer_top_; y < outer_bottom_; ++y) {
      for (int x = outer_left_; x < outer_right_; ++x) body(x, y, pixel(x, y));
    }
  }

  Eigen::Vector2f place(int x, int y, std::size_t sample) const {
    const Eigen::Vector2f corner(static_cast<float>(x), static_cast<float>(y));
    return (corner + pattern_.places[sample]) / static_cast<float>(size_);
  }

  /// What the camera's rays meet.
  void look() {
    pixels_.resize(static_cast<std::size_t>(outer_right_ - outer_left_) *
                   static_cast<std::size_t>(outer_bottom_ - outer_top_));
    for_each_pixel([&](int x, int y, Pixel& pixel) {
      pixel.first = static_cast<std::uint32_t>(meetings_.size());
      for (std::size_t s = 0; s < pattern_.places.size(); ++s) {
        const Eigen::Vector2f at = place(x, y, s);
        const Vector direction = Vector(2 * at.x() - 1, 1 - 2 * at.y(), 0) - stage_.viewer;
        if (const auto hit = stage_.scene.nearest_hit({stage_.viewer, direction})) {
          meetings_.push_back(meet(stage_, *hit, direction, s));
        } else {
          pixel.backdrop += background(at.y());
        }
      }
      pixel.end = static_cast<std::uint32_t>(meetings_.size());
    });
  }

  std::span<Meeting> meetings_of(const Pixel& pixel) {
    return std::span(meetings_).subspan(pixel.first, pixel.end - pixel.first);
  }

  /// Whether the key light reaches the points that face it.
  void ask_key() {
    const Vector key = key_direction();
    for_each_pixel([&](int x, int y, const Pixel& pixel) {
      const Turned turned(key, pixel_turn(x, y));
      for (Meeting& meeting : meetings_of(pixel)) {
        meeting.surface.key = 0;
        if (!meeting.asks_key) continue;
        const Vector direction = key + kKeyRadius * turned(pattern_.lamp[meeting.sample]);
        const Vector start = meeting.start + kThickness * meeting.surface.normal;
        const bool lit = !stage_.scene.occluded({start, direction.normalized()});
        meeting.surface.key = lit ? 1.0F : 0.0F;
      }
    });
  }

  /// Share of the sky that each point sees, weighted by the cosine.
  void ask_sky() {
    const std::size_t rays = pattern_.sky.size() / pattern_.places.size();
    if (rays == 0) return;  // all of it
    for_each_pixel([&](int x, int y, const Pixel& pixel) {
      const Eigen::Vector2f turn = pixel_turn(x, y);
      for (Meeting& meeting : meetings_of(pixel)) {
        const Vector& normal = meeting.surface.normal;
        const Turned turned(normal, turn);
        float open = 0;
        for (std::size_t r = 0; r < rays; ++r) {
          const Eigen::Vector2f& disc = pattern_.sky[meeting.sample * rays + r];
          const float height = std::sqrt(std::max(0.0F, 1 - disc.squaredNorm()));
          const Vector direction = turned(disc) + height * normal;
          if (!stage_.scene.occluded({meeting.start, direction, 0, kSkyReach})) open += 1;
        }
        meeting.surface.sky = open / static_cast<float>(rays);
      }
    });
  }

  void summarize() {
    for (Pixel& pixel : pixels_) {
      Summary& summary = pixel.summary;
      for (const Meeting& meeting : meetings_of(pixel)) {
        summary.point += meeting.point;
        summary.normal += meeting.surface.normal;
        summary.sky += meeting.surface.sky;
        summary.seen += 1;
        if (!meeting.asks_key) continue;
        summary.key += meeting.surface.key;
        summary.asked_key += 1;
      }
      if (summary.seen == 0) continue;
      summary.point /= summary.seen;
      summary.normal /= summary.seen;
      summary.sky /= summary.seen;
      summary.key /= std::max(summary.asked_key, 1.0F);
    }
  }

  /// How far a pixel shows the surface of a meeting: 0 elsewhere, 1 right beside it.
  float likeness(const Meeting& meeting, const Summary& other) const {
    const Vector& normal = meeting.surface.normal;
    const float facing = std::clamp((normal.dot(other.normal) - 0.7F) / 0.25F, 0.0F, 1.0F);
    if (facing == 0) return 0;
    const float step = 2 / static_cast<float>(size_);  // one pixel
    const float height = std::abs((other.point - meeting.point).dot(normal)) / step;
    return facing * std::clamp(2 - height, 0.0F, 1.0F);
  }

  /// The point with the lights that it and the pixels around have found.
  ShadePoint with_shared_lights(const Meeting& meeting, int x, int y) {
    float key = meeting.surface.key, key_weight = meeting.asks_key ? 1.0F : 0.0F;
    float sky = meeting.surface.sky, sky_weight = 1;
    for (int j = std::max(y - 1, outer_top_); j < std::min(y + 2, outer_bottom_); ++j) {
      for (int i = std::max(x - 1, outer_left_); i < std::min(x + 2, outer_right_); ++i) {
        const Summary& other = pixel(i, j).summary;
        if (other.seen == 0) continue;
        const float weight = likeness(meeting, other);
        sky += weight * other.seen * other.sky;
        sky_weight += weight * other.seen;
        if (!meeting.asks_key) continue;
        key += weight * other.asked_key * other.key;
        key_weight += weight * other.asked_key;
      }
    }
    ShadePoint surface = meeting.surface;
    surface.sky = sky / sky_weight;
    if (meeting.asks_key) surface.key = key / key_weight;
    return surface;
  }

  /// The mean of a pixel's samples.
  Light light_at(int x, int y) {
    Pixel& at = pixel(x, y);
    Light sum = at.backdrop;
    for (const Meeting& meeting : meetings_of(at)) sum += shade(with_shared_lights(meeting, x, y));
    return sum / static_cast<float>(pattern_.places.size());
  }

  const Stage& stage_;
  const SamplingPattern& pattern_;
  int size_;
  int left_, top_, right_, bottom_;
  int outer_left_, outer_top_, outer_right_, outer_bottom_;
  std::vector<Pixel> pixels_;
  std::vector<Meeting> meetings_;
};

}  // namespace

void render_tile(const Stage& stage, const SamplingPattern& pattern, int left, int top,
                 Rgb8Image& image) {
  Tile(stage, pattern, left, top, image.width).render(image);
}

}  // namespace crowdface
