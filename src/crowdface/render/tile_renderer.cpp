// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/tile_renderer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include <Eigen/Geometry>

#include "crowdface/render/gleam.h"
#include "crowdface/render/perpendicular.h"

namespace crowdface {
namespace {

using Vector = Eigen::Vector3f;

// Lengths are in half the side of the image, so that these hold for any unit.
constexpr float kSkyReach = 0.55F;    // how far ambient occlusion looks
constexpr float kThickness = 0.012F;  // how deep light soaks in: softens where shadows begin
constexpr float kScattered = 0.2F;    // of the sky's light what hair hands on to where none arrives
constexpr float kThrough = 0.8F;      // of the light on its other side a thin surface lets through

constexpr float kSameNormal = 0.985F;  // cosine: 10 degrees
constexpr float kReliefNormal = 0.9F;  // 26 degrees
constexpr float kSameAlbedo = 0.03F;
// The pixels around a point count its own pixel in; this is for a point unlike all of them.
constexpr float kOwnWeight = 0.01F;

/// Which of a layer's pictures is on this quad, or kNone.
std::uint32_t texture_of(const Stage& stage, const TextureLayer& layer, std::uint32_t primitive) {
  if (stage.uvs.empty() || layer.of_face.empty()) return TextureLayer::kNone;
  const TexturedQuad& quad = stage.uvs[primitive];
  return quad.face == TextureLayer::kNone ? TextureLayer::kNone : layer.of_face[quad.face];
}

/// Which of the coat's colours.
std::uint32_t texture_of(const Stage& stage, std::uint32_t primitive) {
  return stage.coat == nullptr ? TextureLayer::kNone : texture_of(stage, *stage.coat, primitive);
}

/// What a picture of the layer has at a place of a quad that it is on.
Light texel_at(const Stage& stage, const TextureLayer& layer, std::uint32_t texture,
               std::uint32_t primitive, const Eigen::Vector4f& weights) {
  const TexturedQuad& quad = stage.uvs[primitive];
  Eigen::Vector2f uv = Eigen::Vector2f::Zero();
  for (int c = 0; c < 4; ++c) uv += weights[c] * quad.uvs[static_cast<std::size_t>(c)];
  return colour_at(*layer.textures[texture], uv);
}

Light own_albedo(const Stage& stage, std::uint32_t primitive, const Eigen::Vector4f& weights,
                 const Vector& point) {
  const std::uint32_t texture = texture_of(stage, primitive);
  if (texture != TextureCoat::kNone)
    return texel_at(stage, *stage.coat, texture, primitive, weights);
  if (!stage.paints.empty() && stage.paints[primitive]) return *stage.paints[primitive];
  const SurfaceKind kind = stage.kinds[primitive];
  if (kind != SurfaceKind::kEye) return albedo_of(kind);
  const std::uint32_t eye = stage.eyeballs.of_vertex[stage.quads[primitive][0]];
  return eye_albedo(stage.eyes[eye], stage.gaze, point);
}

/// How much of a light arrives, as found by rays towards it.
struct Openness {
  float open = 0;   ///< rays that reached it
  float asked = 0;  ///< of so many

  void add(const Openness& other, float weight) {
    open += weight * other.open;
    asked += weight * other.asked;
  }
};

/// A point of the surface that a camera ray has met.
struct Meeting {
  Vector point;
  Vector start;  ///< where rays to the lights begin
  ShadePoint surface;
  float skin_lightness = 0;  ///< of the picture on it, or 0
  bool asks_key = false;     ///< whether the key light could reach it at all
  Openness key, sky;
};

/// A normal that does not look away from the viewer: at the edge of a coarse ear the normals of vertices
/// may, though the face between them is seen.
Vector towards(const Vector& viewer, const Vector& normal) {
  const float away = std::min(0.0F, normal.dot(viewer));
  return (normal - away * viewer).normalized();
}

/// A unit normal that leans as slopes say, which are along the texture's axes on this quad.
Vector leaning(const Stage& stage, std::uint32_t primitive, const Vector& normal,
               const Light& slopes) {
  const Quad& quad = stage.quads[primitive];
  const TexturedQuad& textured = stage.uvs[primitive];
  // The triangle at the first corner, which tells where the picture's axes run on all of the quad.
  const std::size_t last = quad[2] == quad[3] ? 2 : 3;
  const Vector origin = stage.point(quad[0]);
  const Vector one = stage.point(quad[1]) - origin;
  const Vector other = stage.point(quad[last]) - origin;
  const Eigen::Vector2f uv_one = textured.uvs[1] - textured.uvs[0];
  const Eigen::Vector2f uv_other = textured.uvs[last] - textured.uvs[0];
  const float area = uv_one.x() * uv_other.y() - uv_other.x() * uv_one.y();
  if (area == 0) return normal;
  const float sign = area > 0 ? 1.0F : -1.0F;
  const auto along = [&](const Vector& axis) -> Vector {
    const Vector flat = axis - axis.dot(normal) * normal;
    const float length = flat.norm();
    return length > 0 ? Vector(sign / length * flat) : Vector(Vector::Zero());
  };
  return (normal + slopes[0] * along(uv_other.y() * one - uv_one.y() * other) +
          slopes[1] * along(uv_one.x() * other - uv_other.x() * one))
      .normalized();
}

/// What a coat says of how the surface reflects.
void finish(const Stage& stage, std::uint32_t primitive, const Eigen::Vector4f& weights,
            Vector& normal, ShadePoint& surface) {
  if (stage.coat == nullptr || surface.inside) return;
  const TextureLayer& slopes = stage.coat->slopes;
  const TextureLayer& roughness = stage.coat->roughness;
  if (const auto at = texture_of(stage, slopes, primitive); at != TextureLayer::kNone) {
    normal = leaning(stage, primitive, normal, texel_at(stage, slopes, at, primitive, weights));
  }
  if (const auto at = texture_of(stage, roughness, primitive); at != TextureLayer::kNone) {
    surface.roughness = texel_at(stage, roughness, at, primitive, weights)[0];
  }
}

Meeting meet(const Stage& stage, const RayHit& hit, const Vector& direction) {
  const Quad& quad = stage.quads[hit.primitive];
  const Eigen::Vector4f weights = quad_shares(quad, hit.u, hit.v);
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
                               : own_albedo(stage, hit.primitive, weights, meeting.point);
  const std::uint32_t texture = texture_of(stage, hit.primitive);
  if (texture != TextureCoat::kNone && meeting.surface.kind == SurfaceKind::kSkin)
    meeting.skin_lightness = stage.skin_lightness[texture];
  const Vector geometric = stage.winding * hit.normal;
  meeting.surface.inside = geometric.dot(direction) > 0;
  const float side = meeting.surface.inside ? -1.0F : 1.0F;
  meeting.surface.to_eye = -direction.normalized();
  normal.normalize();
  finish(stage, hit.primitive, weights, normal, meeting.surface);
  meeting.surface.normal = towards(meeting.surface.to_eye, side * normal);
  meeting.asks_key = faces_key(meeting.surface);
  // Rays start above the facets, on the smooth surface that the normals speak of, lest facets show
  // where light grazes them (Hanika 2021, "Hacking the shadow terminator").
  // At a sharp edge a vertex's normal may look away from the face: such a lift would lead below it.
  Vector lift = Vector::Zero();
  for (int c = 0; c < 4; ++c) {
    const std::uint32_t vertex = quad[static_cast<std::size_t>(c)];
    const Vector n = side * stage.normals[vertex];
    if (n.dot(side * geometric) <= 0) continue;
    lift -= weights[c] * std::min(0.0F, (meeting.point - stage.point(vertex)).dot(n)) * n;
  }
  meeting.start = meeting.point + lift + stage.clearance * side * geometric.normalized();
  return meeting;
}

/// Asks memory for what `meet` will want of the hits that come soon: on a large mesh it lies in no cache.
void fetch_ahead(const Stage& stage, std::span<const std::optional<RayHit>> hits,
                 std::size_t here) {
  constexpr std::size_t kQuads = 24, kCorners = 12;
  if (here + kQuads < hits.size() && hits[here + kQuads]) {
    const std::uint32_t primitive = hits[here + kQuads]->primitive;
    __builtin_prefetch(&stage.quads[primitive]);
    __builtin_prefetch(&stage.kinds[primitive]);
  }
  if (here + kCorners < hits.size() && hits[here + kCorners]) {
    for (const std::uint32_t vertex : stage.quads[hits[here + kCorners]->primitive]) {
      __builtin_prefetch(&stage.normals[vertex]);
      __builtin_prefetch(stage.points.data() + std::size_t{3} * vertex);
    }
  }
}

/// The same of what the face wears, which looks alike from both sides.
Meeting meet_worn(const WornStage& worn, const Vector& viewer, const RayHit& hit,
                  const Vector& direction) {
  const WornStage::Place place = worn.at(hit);
  Meeting meeting;
  meeting.point = viewer + hit.distance * direction;
  meeting.surface.kind = SurfaceKind::kWorn;
  meeting.surface.albedo = place.colour;
  const Vector geometric = (hit.normal.dot(direction) > 0 ? -1.0F : 1.0F) * hit.normal.normalized();
  const Vector normal = (place.normal.dot(geometric) < 0 ? -1.0F : 1.0F) * place.normal;
  meeting.surface.inside = false;
  meeting.surface.to_eye = -direction.normalized();
  meeting.surface.normal =
      towards(meeting.surface.to_eye, normal.norm() > 0 ? normal.normalized() : geometric);
  meeting.asks_key = faces_key(meeting.surface);
  meeting.start = meeting.point + kRayClearance * geometric;
  return meeting;
}

/// A direction given as a point of the disc around `axis`.
Vector around(const Vector& axis, const Eigen::Vector2f& disc) {
  const auto [s, t] = perpendicular(axis);
  return disc.x() * s + disc.y() * t;
}

/// How the samples of a pixel, or a pixel and those beside it, differ: not, in how one surface lies, or in what they
/// show.
enum class Change : std::uint8_t { kNone, kRelief, kEdge };

/// What a pixel shows, for itself and its neighbours.
struct Summary {
  Vector point = Vector::Zero();   ///< mean
  Vector normal = Vector::Zero();  ///< mean of unit normals: shorter than 1 where they differ
  Light albedo = Light::Zero();    ///< mean
  Openness key, sky;               ///< of all its points
  bool empty = true;
};

/// An empty list of this thread's, with the memory that it had before: of a megabyte, which would be made anew for every
/// tile. For one user at a time.
template <class Item>
std::vector<Item>& emptied() {
  thread_local std::vector<Item> list;
  list.clear();
  return list;
}

/// One square of the image; a rim of pixels around it that lend what they know of their lights, and one more that tells
/// where these change.
class Tile {
 public:
  Tile(const Stage& stage, const Sampling& sampling, int left, int top, int size)
      : stage_(stage),
        sampling_(sampling),
        size_(size),
        left_(left),
        top_(top),
        right_(std::min(left + kSquare, size)),
        bottom_(std::min(top + kSquare, size)),
        rim_left_(std::max(left - 1, 0)),
        rim_top_(std::max(top - 1, 0)),
        rim_right_(std::min(right_ + 1, size)),
        rim_bottom_(std::min(bottom_ + 1, size)),
        outer_{std::max(left - kRim, 0), std::max(top - kRim, 0), std::min(right_ + kRim, size),
               std::min(bottom_ + kRim, size)},
        pixels_(outer_.count()) {}

  void render(Rgb8Image& image) {
    const PixelPlaces& first = stage_.worn != nullptr ? sampling_.coarse : sampling_.middle;
    look([&](const Pixel&) { return &first; });
    if (sampling_.fine.count() > 1) {
      for (int y = rim_top_; y < rim_bottom_; ++y) {
        for (int x = rim_left_; x < rim_right_; ++x) pixel(x, y).change = change_at(x, y);
      }
      look([&](const Pixel& pixel) -> const PixelPlaces* {
        if (pixel.change == Change::kEdge) return &sampling_.fine;
        const bool asks = pixel.change == Change::kRelief && &first != &sampling_.coarse;
        return asks ? &sampling_.coarse : nullptr;
      });
    }
    ask_key();
    if (stage_.occlusion) ask_sky();
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
    std::uint32_t missed = 0;          ///< how many of its samples met nothing
    Change change = Change::kNone;
    Light backdrop = Light::Zero();  ///< of its samples that met nothing
    Summary summary = {};
  };

  Pixel& pixel(int x, int y) { return pixels_[outer_.index(x, y)]; }

  template <class Body>
  void for_each_pixel(const Body& body) {
    for (int y = outer_.top; y < outer_.bottom; ++y) {
      for (int x = outer_.left; x < outer_.right; ++x) body(x, y, pixel(x, y));
    }
  }

  Eigen::Vector2f on_image(int x, int y, const Eigen::Vector2f& place) const {
    const Eigen::Vector2f corner(static_cast<float>(x), static_cast<float>(y));
    return (corner + place) / static_cast<float>(size_);
  }

  /// What the camera's rays meet in each pixel.
  /// \param places_of  where they go in a pixel, or null: what is known of it stays
  template <class PlacesOf>
  void look(const PlacesOf& places_of) {
    std::vector<const PixelPlaces*> places;
    std::vector<Ray>& rays = emptied<Ray>();
    for_each_pixel([&](int x, int y, const Pixel& pixel) {
      places.push_back(places_of(pixel));
      if (places.back() == nullptr) return;
      std::uint32_t number = 0;
      for (const Eigen::Vector2f& place : places.back()->list()) {
        const Eigen::Vector2f at = on_image(x, y, place);
        rays.push_back({stage_.viewer, Vector(2 * at.x() - 1, 1 - 2 * at.y(), 0) - stage_.viewer});
        rays.back().lot = (2 * number++ + 1) * 32768U / places.back()->count();
      }
    });
    std::vector<std::optional<RayHit>>& hits = emptied<std::optional<RayHit>>();
    stage_.screen.nearest_hits({left_ / kSquare, top_ / kSquare}, outer_, places, hits);
    std::vector<std::optional<RayHit>> worn(rays.size());
    if (stage_.worn != nullptr) {
      for (std::size_t r = 0; r < rays.size(); ++r) {
        if (hits[r]) rays[r].furthest = hits[r]->distance;
      }
      worn = stage_.worn->scene().nearest_hits(rays);
    }
    std::size_t ray = 0;
    auto at = places.begin();
    for_each_pixel([&](int x, int y, Pixel& pixel) {
      const PixelPlaces* const looked = *at++;
      if (looked == nullptr) return;
      pixel.first = static_cast<std::uint32_t>(meetings_.size());
      pixel.missed = 0;
      pixel.backdrop = Light::Zero();
      for (const Eigen::Vector2f& place : looked->list()) {
        fetch_ahead(stage_, hits, ray);
        if (worn[ray]) {
          meetings_.push_back(
              meet_worn(*stage_.worn, stage_.viewer, *worn[ray], rays[ray].direction));
        } else if (hits[ray]) {
          meetings_.push_back(meet(stage_, *hits[ray], rays[ray].direction));
        } else {
          pixel.backdrop += background(on_image(x, y, place).y());
          ++pixel.missed;
        }
        ++ray;
      }
      pixel.end = static_cast<std::uint32_t>(meetings_.size());
    });
  }

  std::span<Meeting> meetings_of(const Pixel& pixel) {
    return std::span(meetings_).subspan(pixel.first, pixel.end - pixel.first);
  }

  /// Whether a pixel and those beside it show more than one smooth piece of surface in one colour.
  Change change_at(int x, int y) {
    const Pixel& at = pixel(x, y);
    const std::span<const Meeting> meetings = meetings_of(at);
    if (!meetings.empty() && at.missed > 0) return Change::kEdge;
    Change most = Change::kNone;
    for (const Meeting& other : meetings) most = std::max(most, change(meetings.front(), other));
    if (stage_.worn != nullptr) return most;  // its samples tell
    for (const auto& [i, j] : {std::pair(x - 1, y), {x + 1, y}, {x, y - 1}, {x, y + 1}}) {
      if (i < outer_.left || i >= outer_.right || j < outer_.top || j >= outer_.bottom) continue;
      const std::span<const Meeting> beside = meetings_of(pixel(i, j));
      if (beside.empty() != meetings.empty()) return Change::kEdge;
      if (!beside.empty()) most = std::max(most, change(meetings.front(), beside.front()));
    }
    return most;
  }

  Change change(const Meeting& one, const Meeting& other) const {
    const ShadePoint &here = one.surface, &there = other.surface;
    const float height = (other.point - one.point).dot(here.normal);
    const float cosine = there.normal.dot(here.normal);
    if (there.kind != here.kind || there.inside != here.inside || cosine < kReliefNormal ||
        std::abs(height) > pixel_side() ||
        (there.albedo - here.albedo).abs().maxCoeff() > kSameAlbedo) {
      return Change::kEdge;
    }
    return cosine < kSameNormal ? Change::kRelief : Change::kNone;
  }

  float pixel_side() const { return 2 / static_cast<float>(size_); }

  /// Calls `body(meeting, disc, lot)` for each direction in which a meeting asks for lights, in the order of
  /// directions: rays that run alike are sent one after the other. A pixel that shows one thing asks as often as
  /// there are light rays; where it changes, each of its meetings asks.
  template <class Body>
  void for_each_ask(const Body& body) {
    constexpr std::uint32_t kGoldenLot = 40503;  // lots of rays in a row are evenly spread
    const auto rays = static_cast<std::size_t>(sampling_.light_rays);
    std::uint32_t number = 0;
    for (int shift_y = 0; shift_y < kInterleave; ++shift_y) {
      for (int shift_x = 0; shift_x < kInterleave; ++shift_x) {
        for (std::size_t k = 0; k < rays; ++k) {
          const Eigen::Vector2f& disc =
              sampling_.lights.point(rim_left_ + shift_x, rim_top_ + shift_y, static_cast<int>(k));
          const auto lot = static_cast<std::uint32_t>(number++ * kGoldenLot) & 0xffffU;
          for (int y = rim_top_ + shift_y; y < rim_bottom_; y += kInterleave) {
            for (int x = rim_left_ + shift_x; x < rim_right_; x += kInterleave) {
              const Pixel& at = pixel(x, y);
              const std::span<Meeting> meetings = meetings_of(at);
              if (meetings.empty()) continue;
              const std::size_t first = k % meetings.size();
              const std::size_t end = at.change != Change::kNone ? meetings.size() : first + 1;
              for (std::size_t m = first; m < end; m += rays) body(meetings[m], disc, lot);
            }
          }
        }
      }
    }
  }

  void ask_key() {
    const Vector key = key_direction();
    std::vector<Ray>& rays = emptied<Ray>();
    std::vector<Openness*>& asking = emptied<Openness*>();
    for_each_ask([&](Meeting& meeting, const Eigen::Vector2f& disc, std::uint32_t lot) {
      if (!meeting.asks_key) return;
      const Vector start = meeting.start + kThickness * meeting.surface.normal;
      rays.push_back({start, key + kKeyRadius * around(key, disc)});
      rays.back().lot = lot;
      asking.push_back(&meeting.key);
    });
    trace(rays, asking);
  }

  /// Directions are cosine-weighted.
  void ask_sky() {
    std::vector<Ray>& rays = emptied<Ray>();
    std::vector<Meeting*>& asking = emptied<Meeting*>();
    for_each_ask([&](Meeting& meeting, const Eigen::Vector2f& disc, std::uint32_t lot) {
      const Vector& normal = meeting.surface.normal;
      const float height = std::sqrt(std::max(0.0F, 1 - disc.squaredNorm()));
      rays.push_back({meeting.start, around(normal, disc) + height * normal, 0, kSkyReach});
      rays.back().lot = lot;
      asking.push_back(&meeting);
    });
    const std::vector<bool> blocked = are_blocked(rays);
    for (std::size_t r = 0; r < rays.size(); ++r)
      asking[r]->sky.add({blocked[r] ? 0.0F : 1.0F, 1}, 1);
    add_light_through(rays, asking, blocked);
  }

  /// What is thin and lies in the dark on the side that is seen, such as the inside of a lock at the edge of a
  /// head of hair, gets some of the light that falls on its other side.
  void add_light_through(const std::vector<Ray>& rays, const std::vector<Meeting*>& asking,
                         const std::vector<bool>& blocked) {
    std::vector<Ray> behind;
    std::vector<Meeting*> thin;
    for (std::size_t r = 0; r < rays.size(); ++r) {
      const Meeting& meeting = *asking[r];
      if (!blocked[r] || meeting.surface.kind != SurfaceKind::kWorn) continue;
      const Vector across = (meeting.start - meeting.point).normalized();
      behind.push_back(rays[r]);
      behind.back().origin = 2 * meeting.point - meeting.start;
      behind.back().direction -= 2 * rays[r].direction.dot(across) * across;
      thin.push_back(asking[r]);
    }
    const std::vector<bool> dark = are_blocked(behind);
    for (std::size_t r = 0; r < behind.size(); ++r) {
      if (!dark[r]) thin[r]->sky.open += kThrough;
    }
  }

  void trace(const std::vector<Ray>& rays, const std::vector<Openness*>& asking) {
    const std::vector<bool> blocked = are_blocked(rays);
    for (std::size_t r = 0; r < rays.size(); ++r) {
      asking[r]->add({blocked[r] ? 0.0F : 1.0F, 1}, 1);
    }
  }

  std::vector<bool> are_blocked(const std::vector<Ray>& rays) const {
    std::vector<bool> blocked = stage_.occluders.occluded(rays);
    if (stage_.worn == nullptr) return blocked;
    std::vector<Ray> free;
    for (std::size_t r = 0; r < rays.size(); ++r) {
      if (!blocked[r]) free.push_back(rays[r]);
    }
    const std::vector<bool> by_worn = stage_.worn->scene().occluded(free);
    auto next = by_worn.begin();
    for (std::size_t r = 0; r < rays.size(); ++r) {
      if (!blocked[r]) blocked[r] = *next++;
    }
    return blocked;
  }

  void summarize() {
    for (Pixel& pixel : pixels_) {
      Summary& summary = pixel.summary;
      const std::span<const Meeting> meetings = meetings_of(pixel);
      if (meetings.empty()) continue;
      for (const Meeting& meeting : meetings) {
        summary.point += meeting.point;
        summary.normal += meeting.surface.normal;
        summary.albedo += meeting.surface.albedo;
        summary.key.add(meeting.key, 1);
        summary.sky.add(meeting.sky, 1);
      }
      const auto count = static_cast<float>(meetings.size());
      summary.point /= count;
      summary.normal /= count;
      summary.albedo /= count;
      summary.empty = false;
    }
  }

  /// How far a pixel shows the surface of a point: 0 elsewhere, 1 right beside it.
  float likeness(const Meeting& meeting, const Summary& other) const {
    const Vector& normal = meeting.surface.normal;
    const float facing = std::clamp((normal.dot(other.normal) - 0.7F) / 0.25F, 0.0F, 1.0F);
    if (facing == 0) return 0;
    const float height = std::abs((other.point - meeting.point).dot(normal)) / pixel_side();
    return facing * std::clamp(2 - height, 0.0F, 1.0F);
  }

  /// The point with the lights that the pixels around it, and its own, have found.
  ShadePoint with_shared_lights(const Meeting& meeting, int x, int y) {
    Openness key, sky;
    key.add(meeting.key, kOwnWeight);
    sky.add(meeting.sky, kOwnWeight);
    for (int j = std::max(y - 1, rim_top_); j < std::min(y + 2, rim_bottom_); ++j) {
      for (int i = std::max(x - 1, rim_left_); i < std::min(x + 2, rim_right_); ++i) {
        const Summary& other = pixel(i, j).summary;
        if (other.empty) continue;
        const float weight = likeness(meeting, other);
        key.add(other.key, weight);
        sky.add(other.sky, weight);
      }
    }
    ShadePoint surface = meeting.surface;
    surface.key = key.asked > 0 ? key.open / key.asked : 0;
    surface.sky = sky.asked > 0 ? sky.open / sky.asked : 1;
    if (surface.kind == SurfaceKind::kWorn) surface.sky = std::max(surface.sky, kScattered);
    return surface;
  }

  Light shaded(const Meeting& meeting, int x, int y) {
    return shade(with_shared_lights(meeting, x, y),
                 skin_gleam(meeting.surface.albedo, meeting.skin_lightness));
  }

  /// The mean of a pixel's samples.
  Light light_at(int x, int y) {
    const Pixel& at = pixel(x, y);
    const std::span<const Meeting> meetings = meetings_of(at);
    if (!meetings.empty() && at.change == Change::kNone) return shaded(middle_of(at), x, y);
    Light sum = at.backdrop;
    for (const Meeting& meeting : meetings) sum += shaded(meeting, x, y);
    return sum / static_cast<float>(meetings.size() + at.missed);
  }

  /// The one point that stands for all of a pixel.
  Meeting middle_of(const Pixel& pixel) {
    Meeting middle = meetings_[pixel.first];
    middle.point = pixel.summary.point;
    middle.surface.normal = pixel.summary.normal.normalized();
    middle.surface.albedo = pixel.summary.albedo;
    middle.key = pixel.summary.key;
    middle.sky = pixel.summary.sky;
    return middle;
  }

  const Stage& stage_;
  const Sampling& sampling_;
  int size_;
  int left_, top_, right_, bottom_;
  int rim_left_, rim_top_, rim_right_, rim_bottom_;
  PixelRectangle outer_;
  std::vector<Pixel> pixels_;
  std::vector<Meeting>& meetings_ = emptied<Meeting>();
};

}  // namespace

void render_tile(const Stage& stage, const Sampling& sampling, int left, int top,
                 Rgb8Image& image) {
  Tile(stage, sampling, left, top, image.width).render(image);
}

}  // namespace crowdface
