// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/tile_renderer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include <Eigen/Geometry>

#include "crowdface/render/camera_hit.h"
#include "crowdface/render/perpendicular.h"
#include "crowdface/render/skin_specular.h"
#include "crowdface/render/visibility_filter.h"

namespace crowdface {
namespace {

using Vector = Eigen::Vector3f;

// Lengths are in camera space: half the side of the image is 1.
constexpr float kSkyReach = 0.55F;  // reach of ambient occlusion
// Rays towards the key light start at this distance from CameraHit::ray_origin, along the normal of
// the hit surface. The distance softens the edges of shadows, as light that enters skin does.
constexpr float kShadowRayOffset = 0.012F;
// Fraction of the sky's light that even occluded hair receives, because hair scatters light.
constexpr float kScattered = 0.2F;
constexpr float kThrough = 0.8F;  // fraction of light that a thin surface transmits

constexpr std::size_t kHitsPerShadowRay = 2;  // in pixels whose hits differ

constexpr float kSameNormal = 0.985F;  // cosine of 10 degrees
constexpr float kReliefNormal = 0.9F;  // cosine of 26 degrees
constexpr float kSameAlbedo = 0.03F;

/// Maps a point of the unit disc to an offset perpendicular to `axis`.
Vector disc_offset(const Vector& axis, const Eigen::Vector2f& disc) {
  const auto [s, t] = tangent_basis(axis);
  return disc.x() * s + disc.y() * t;
}

/// The strongest difference among the samples of a pixel and its neighbours. kNone: none; kRelief:
/// only in normals; kEdge: in surface or colour.
enum class PixelVariation : std::uint8_t { kNone, kRelief, kEdge };

/// Storage for PointVisibility of a row of points: one list of values for each field.
class PointLists {
 public:
  void resize(std::size_t count) {
    capacity_ = std::max(capacity_, count + kMaxLanes);
    numbers_.resize(PointVisibility::kFields * capacity_);
  }
  float* field_values(int field) {
    return numbers_.data() + static_cast<std::size_t>(field) * capacity_;
  }
  PointVisibility lights() const {
    PointVisibility lights;
    for (std::size_t f = 0; f < lights.field_values.size(); ++f)
      lights.field_values[f] = numbers_.data() + f * capacity_;
    return lights;
  }

 private:
  std::size_t capacity_ = 0;
  std::vector<float> numbers_;
};

/// Stores the position, the normal and the numbers of rays of a hit in `lists`.
/// \param at     index at which to store the values
/// \param lists  a PointLists or a PixelVisibility
template <class Lists>
void put(const CameraHit& hit, std::size_t at, Lists& lists) {
  for (int c = 0; c < 3; ++c) {
    lists.field_values(PointVisibility::kPoint + c)[at] = hit.point[c];
    lists.field_values(PointVisibility::kNormal + c)[at] = hit.surface.normal[c];
  }
  lists.field_values(PointVisibility::kKeyVisible)[at] = hit.key_visibility.unblocked_rays;
  lists.field_values(PointVisibility::kKeyTraced)[at] = hit.key_visibility.traced_rays;
  lists.field_values(PointVisibility::kSkyVisible)[at] = hit.sky_visibility.unblocked_rays;
  lists.field_values(PointVisibility::kSkyTraced)[at] = hit.sky_visibility.traced_rays;
}

/// Averages the positions, normals and albedos of hits, and adds up their numbers of rays. If the
/// normals differ, the mean normal is shorter than 1.
CameraHit mean_of(std::span<const CameraHit> camera_hits) {
  CameraHit mean = camera_hits.front();
  for (const CameraHit& other : camera_hits.subspan(1)) {
    mean.point += other.point;
    mean.surface.normal += other.surface.normal;
    mean.surface.albedo += other.surface.albedo;
    mean.key_visibility.add(other.key_visibility, 1);
    mean.sky_visibility.add(other.sky_visibility, 1);
  }
  const auto count = static_cast<float>(camera_hits.size());
  mean.point /= count;
  mean.surface.normal /= count;
  mean.surface.albedo /= count;
  return mean;
}

/// The visible fractions of the key light and of the sky at some surface points.
struct VisibleFractions {
  std::vector<float> key, sky;
};

/// Memory of a thread, some megabytes, reused from tile to tile.
struct TileMemory {
  std::vector<Ray> rays;
  std::vector<std::optional<RayHit>> hits;
  std::vector<CameraHit> camera_hits;
  std::vector<CameraHit*> hit_of_ray;
  PixelVisibility pixels;
  PointLists points;
  std::vector<CameraHit> mean_hits;  ///< for each pixel of a row: mean of the pixel's hits
  VisibleFractions row_shares, shares;
  ShadeBatch batch;
};

TileMemory& tile_memory() {
  thread_local TileMemory memory;
  return memory;
}

/// One square of the image with a rim of two pixels. The pixels of the square also use the results
/// of the shadow rays from the inner ring of the rim. The outer ring of the rim is used only to
/// detect edges in the inner ring.
class Tile {
 public:
  Tile(const HeadScene& scene, const Sampling& sampling, int left, int top, int size)
      : scene_(scene),
        sampling_(sampling),
        size_(size),
        left_(left),
        top_(top),
        right_(std::min(left + kSquareSide, size)),
        bottom_(std::min(top + kSquareSide, size)),
        rim_left_(std::max(left - 1, 0)),
        rim_top_(std::max(top - 1, 0)),
        rim_right_(std::min(right_ + 1, size)),
        rim_bottom_(std::min(bottom_ + 1, size)),
        outer_{std::max(left - kRimWidth, 0), std::max(top - kRimWidth, 0),
               std::min(right_ + kRimWidth, size), std::min(bottom_ + kRimWidth, size)},
        pixels_(outer_.count()),
        memory_(tile_memory()) {
    camera_hits_.clear();
  }

  void render(Rgb8Image& image) {
    // If a pixel may show attachments, trace a few samples in it, because attachments may be
    // transparent. In every other pixel, trace one sample.
    trace_camera_rays([&](int x, int y, const Pixel&) {
      return may_have_attachments(x, y) ? &sampling_.coarse_samples : &sampling_.centre_sample;
    });
    // Trace more samples in pixels that differ from their neighbours.
    if (sampling_.fine_samples.count() > 1) {
      for (int y = rim_top_; y < rim_bottom_; ++y) {
        for (int x = rim_left_; x < rim_right_; ++x) pixel(x, y).change = variation_at(x, y);
      }
      trace_camera_rays([&](int x, int y, const Pixel& pixel) -> const PixelSamples* {
        if (pixel.change == PixelVariation::kEdge) return &sampling_.fine_samples;
        const bool asks = pixel.change == PixelVariation::kRelief && !may_have_attachments(x, y);
        return asks ? &sampling_.coarse_samples : nullptr;
      });
    }
    // Trace shadow rays towards the key light and towards the sky.
    trace_key_rays();
    if (scene_.ambient_occlusion) trace_sky_rays();
    // Compute the mean of each pixel's hits. Then shade the pixels, with shadow rays averaged over
    // neighbouring pixels.
    store_pixel_means();
    for (int y = top_; y < bottom_; ++y) shade_row(y, image);
  }

 private:
  struct Pixel {
    std::uint32_t first = 0, end = 0;  ///< range of the pixel's hits in `camera_hits_`
    std::uint32_t missed = 0;          ///< number of samples without a hit
    PixelVariation change = PixelVariation::kNone;
    /// sum of the background colours at samples without a hit
    LinearRgb backdrop = LinearRgb::Zero();
  };

  Pixel& pixel(int x, int y) { return pixels_[outer_.index(x, y)]; }
  bool may_have_attachments(int x, int y) const {
    return scene_.attachments != nullptr && scene_.attachments->may_cover(x, y);
  }

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

  /// Traces camera rays and stores their hits in the pixels.
  /// \param samples_of  returns the sample positions for a pixel, or null to keep the pixel's
  /// earlier samples
  template <class SamplesOf>
  void trace_camera_rays(const SamplesOf& samples_of) {
    std::vector<const PixelSamples*> places;
    std::vector<Ray>& rays = memory_.rays;
    rays.clear();
    std::vector<std::size_t> rays_near_attachments;
    for_each_pixel([&](int x, int y, const Pixel& pixel) {
      places.push_back(samples_of(x, y, pixel));
      if (places.back() == nullptr) return;
      std::uint32_t number = 0;
      for (const Eigen::Vector2f& place : places.back()->positions()) {
        const Eigen::Vector2f at = on_image(x, y, place);
        if (may_have_attachments(x, y)) rays_near_attachments.push_back(rays.size());
        rays.push_back({scene_.viewer_position,
                        Vector(2 * at.x() - 1, 1 - 2 * at.y(), 0) - scene_.viewer_position});
        rays.back().opacity_seed = (2 * number++ + 1) * 32768U / places.back()->count();
      }
    });
    std::vector<std::optional<RayHit>>& hits = memory_.hits;
    scene_.rasterizer.nearest_hits({left_ / kSquareSide, top_ / kSquareSide}, outer_, places, hits);
    // Find attachments in front of the face.
    std::vector<std::optional<RayHit>> attachments;
    if (!rays_near_attachments.empty()) {
      std::vector<Ray> limited;
      for (const std::size_t r : rays_near_attachments) {
        limited.push_back(rays[r]);
        if (hits[r]) limited.back().max_distance = hits[r]->distance;
      }
      const auto found = scene_.attachments->scene().nearest_hits(limited);
      attachments.resize(rays.size());
      for (std::size_t i = 0; i < found.size(); ++i)
        attachments[rays_near_attachments[i]] = found[i];
    }
    std::size_t ray = 0;
    auto at = places.begin();
    for_each_pixel([&](int x, int y, Pixel& pixel) {
      const PixelSamples* const looked = *at++;
      if (looked == nullptr) return;
      pixel.first = static_cast<std::uint32_t>(camera_hits_.size());
      pixel.missed = 0;
      pixel.backdrop = LinearRgb::Zero();
      for (const Eigen::Vector2f& place : looked->positions()) {
        prefetch_hits(scene_, hits, ray);
        if (!attachments.empty() && attachments[ray]) {
          camera_hits_.push_back(attachment_hit(scene_, *attachments[ray], rays[ray].direction));
        } else if (hits[ray]) {
          camera_hits_.push_back(camera_hit(scene_, *hits[ray], rays[ray].direction));
        } else {
          pixel.backdrop += background_colour(on_image(x, y, place).y());
          ++pixel.missed;
        }
        ++ray;
      }
      pixel.end = static_cast<std::uint32_t>(camera_hits_.size());
    });
  }

  std::span<CameraHit> hits_of(const Pixel& pixel) {
    return std::span(camera_hits_).subspan(pixel.first, pixel.end - pixel.first);
  }

  /// How the samples of a pixel differ from each other and from the four neighbouring pixels.
  PixelVariation variation_at(int x, int y) {
    const Pixel& at = pixel(x, y);
    const std::span<const CameraHit> camera_hits = hits_of(at);
    if (!camera_hits.empty() && at.missed > 0) return PixelVariation::kEdge;
    PixelVariation most = PixelVariation::kNone;
    for (const CameraHit& other : camera_hits)
      most = std::max(most, change(camera_hits.front(), other));
    if (may_have_attachments(x, y)) return most;  // the pixel's own samples suffice
    for (const auto& [i, j] : {std::pair(x - 1, y), {x + 1, y}, {x, y - 1}, {x, y + 1}}) {
      if (i < outer_.left || i >= outer_.right || j < outer_.top || j >= outer_.bottom) continue;
      const std::span<const CameraHit> beside = hits_of(pixel(i, j));
      if (beside.empty() != camera_hits.empty()) return PixelVariation::kEdge;
      if (!beside.empty()) most = std::max(most, change(camera_hits.front(), beside.front()));
    }
    return most;
  }

  PixelVariation change(const CameraHit& one, const CameraHit& other) const {
    const ShadePoint &here = one.surface, &there = other.surface;
    const float height = (other.point - one.point).dot(here.normal);
    const float cosine = there.normal.dot(here.normal);
    if (there.kind != here.kind || there.is_back != here.is_back || cosine < kReliefNormal ||
        std::abs(height) > pixel_side() ||
        (there.albedo - here.albedo).abs().maxCoeff() > kSameAlbedo) {
      return PixelVariation::kEdge;
    }
    return cosine < kSameNormal ? PixelVariation::kRelief : PixelVariation::kNone;
  }

  float pixel_side() const { return 2 / static_cast<float>(size_); }

  /// Calls `body(hit, disc, opacity_seed)` for each shadow ray to trace. `disc` is a point of the
  /// unit disc, which determines the ray's direction. All rays with the same `disc` follow one
  /// another, so that consecutive rays mostly have similar directions.
  ///
  /// A pixel with PixelVariation::kNone gets `directions.rays_per_pixel()` rays, which start at
  /// different hits of the pixel. Any other pixel gets at least this number of rays, and at least
  /// one ray for every kHitsPerShadowRay hits. Some hits get no ray; filter_visibility gives these
  /// hits the visibility of similar points nearby.
  template <class Body>
  void for_each_shadow_ray(const InterleavedDisc& directions, const Body& body) {
    constexpr std::uint32_t kGoldenRatio16 =
        40503;  // spreads the numbers of consecutive rays evenly
    const std::size_t rays = directions.rays_per_pixel();
    std::uint32_t number = 0;
    for (int shift_y = 0; shift_y < kInterleavePeriod; ++shift_y) {
      for (int shift_x = 0; shift_x < kInterleavePeriod; ++shift_x) {
        for (std::size_t k = 0; k < rays; ++k) {
          const Eigen::Vector2f& disc =
              directions.point(rim_left_ + shift_x, rim_top_ + shift_y, static_cast<int>(k));
          const auto opacity_seed = static_cast<std::uint32_t>(number++ * kGoldenRatio16) & 0xffffU;
          for (int y = rim_top_ + shift_y; y < rim_bottom_; y += kInterleavePeriod) {
            for (int x = rim_left_ + shift_x; x < rim_right_; x += kInterleavePeriod) {
              const Pixel& at = pixel(x, y);
              const std::span<CameraHit> camera_hits = hits_of(at);
              if (camera_hits.empty()) continue;
              const std::size_t first = k % camera_hits.size();
              const std::size_t end =
                  at.change != PixelVariation::kNone ? camera_hits.size() : first + 1;
              for (std::size_t m = first; m < end; m += kHitsPerShadowRay * rays)
                body(camera_hits[m], disc, opacity_seed);
            }
          }
        }
      }
    }
  }

  /// Traces the shadow rays from all hits towards a light, and stores the rays in `memory_.rays`.
  /// \param light   member of CameraHit that belongs to the light: there, the function counts the
  ///                hit's rays and the rays that reached the light
  /// \param ray_of  function of a hit and a point of the unit disc: returns the ray that starts at
  ///                the hit, in the direction that the point determines; nothing if the light
  ///                cannot reach the hit
  /// \return for each ray: whether a surface blocks the ray
  template <class RayOf>
  std::vector<bool> trace_shadow_rays(const InterleavedDisc& directions,
                                      Visibility CameraHit::*light, const RayOf& ray_of) {
    std::vector<Ray>& rays = memory_.rays;
    std::vector<CameraHit*>& hit_of_ray = memory_.hit_of_ray;
    rays.clear();
    hit_of_ray.clear();
    for_each_shadow_ray(
        directions, [&](CameraHit& hit, const Eigen::Vector2f& disc, std::uint32_t opacity_seed) {
          const std::optional<Ray> ray = ray_of(hit, disc);
          if (!ray) return;
          rays.push_back(*ray);
          rays.back().opacity_seed = opacity_seed;
          hit_of_ray.push_back(&hit);
        });
    std::vector<bool> blocked = are_blocked(rays);
    for (std::size_t r = 0; r < rays.size(); ++r) {
      (hit_of_ray[r]->*light).add({blocked[r] ? 0.0F : 1.0F, 1}, 1);
    }
    return blocked;
  }

  void trace_key_rays() {
    const Vector key = key_light_direction();
    trace_shadow_rays(sampling_.key_light_directions, &CameraHit::key_visibility,
                      [&](const CameraHit& hit, const Eigen::Vector2f& disc) -> std::optional<Ray> {
                        if (!hit.can_receive_key_light) return std::nullopt;
                        const Vector start = hit.ray_origin + kShadowRayOffset * hit.surface.normal;
                        return Ray{start, key + kKeyLightRadius * disc_offset(key, disc)};
                      });
  }

  /// Traces cosine-weighted rays towards the sky.
  void trace_sky_rays() {
    const std::vector<bool> blocked = trace_shadow_rays(
        sampling_.sky_directions, &CameraHit::sky_visibility,
        [](const CameraHit& hit, const Eigen::Vector2f& disc) -> std::optional<Ray> {
          const Vector& normal = hit.surface.normal;
          const float height = std::sqrt(std::max(0.0F, 1 - disc.squaredNorm()));
          return Ray{hit.ray_origin, disc_offset(normal, disc) + height * normal, 0, kSkyReach};
        });
    add_light_through(memory_.rays, memory_.hit_of_ray, blocked);
  }

  /// Adds the light of the sky that attachments transmit, for example thin hair that is lit from
  /// behind. For each blocked sky ray from an attachment, traces the mirrored ray on the other side
  /// of the surface. If the mirrored ray is not blocked, adds the fraction kThrough of a ray.
  void add_light_through(const std::vector<Ray>& rays, const std::vector<CameraHit*>& hit_of_ray,
                         const std::vector<bool>& blocked) {
    std::vector<Ray> behind;
    std::vector<CameraHit*> thin;
    for (std::size_t r = 0; r < rays.size(); ++r) {
      const CameraHit& hit = *hit_of_ray[r];
      if (!blocked[r] || hit.surface.kind != SurfaceKind::kAttachment) continue;
      const Vector across = (hit.ray_origin - hit.point).normalized();
      behind.push_back(rays[r]);
      behind.back().origin = 2 * hit.point - hit.ray_origin;
      behind.back().direction -= 2 * rays[r].direction.dot(across) * across;
      thin.push_back(hit_of_ray[r]);
    }
    const std::vector<bool> dark = are_blocked(behind);
    for (std::size_t r = 0; r < behind.size(); ++r) {
      if (!dark[r]) thin[r]->sky_visibility.unblocked_rays += kThrough;
    }
  }

  std::vector<bool> are_blocked(const std::vector<Ray>& rays) const {
    std::vector<bool> blocked = scene_.occluders.occluded(rays);
    if (scene_.attachments == nullptr) return blocked;
    std::vector<Ray> free;
    for (std::size_t r = 0; r < rays.size(); ++r) {
      if (!blocked[r]) free.push_back(rays[r]);
    }
    const std::vector<bool> by_attachments = scene_.attachments->scene().occluded(free);
    auto next = by_attachments.begin();
    for (std::size_t r = 0; r < rays.size(); ++r) {
      if (!blocked[r]) blocked[r] = *next++;
    }
    return blocked;
  }

  static bool has_uniform_samples(const Pixel& pixel) {
    return pixel.change == PixelVariation::kNone && pixel.first < pixel.end;
  }

  std::size_t visibility_index(int x, int y) const {
    return PixelVisibility::index(x - left_, y - top_);
  }

  void store_pixel_means() {
    memory_.pixels.clear();
    for (int y = rim_top_; y < rim_bottom_; ++y) {
      for (int x = rim_left_; x < rim_right_; ++x) {
        const std::span<const CameraHit> camera_hits = hits_of(pixel(x, y));
        if (!camera_hits.empty()) put(mean_of(camera_hits), visibility_index(x, y), memory_.pixels);
      }
    }
  }

  /// Calls filter_visibility to compute the visible fractions of the key light and of the sky at
  /// `count` points.
  /// \param x, y         if `consecutive`: pixel of the first point; otherwise: pixel that contains
  ///                     all points
  /// \param consecutive  true: the points lie in consecutive pixels of a row, one point per pixel
  void share(const PointLists& points, std::size_t count, int x, int y, bool consecutive,
             VisibleFractions& shares) {
    shares.key.resize(count + kMaxLanes);
    shares.sky.resize(count + kMaxLanes);
    filter_visibility(points.lights(), count, memory_.pixels, visibility_index(x, y), consecutive,
                      pixel_side(), shares.key.data(), shares.sky.data());
  }

  void add_to_batch(const CameraHit& hit, const VisibleFractions& shares, std::size_t i) {
    ShadePoint surface = hit.surface;
    surface.key_visibility = shares.key[i];
    surface.sky_visibility = shares.sky[i];
    if (surface.kind == SurfaceKind::kAttachment)
      surface.sky_visibility = std::max(surface.sky_visibility, kScattered);
    memory_.batch.add(surface, skin_specular_factor(surface.albedo, hit.skin_lightness));
  }

  /// For a pixel whose samples differ: adds each sample to the batch for shading.
  void add_each(std::span<const CameraHit> camera_hits, int x, int y) {
    memory_.points.resize(camera_hits.size());
    for (std::size_t m = 0; m < camera_hits.size(); ++m) put(camera_hits[m], m, memory_.points);
    share(memory_.points, camera_hits.size(), x, y, false, memory_.shares);
    for (std::size_t m = 0; m < camera_hits.size(); ++m)
      add_to_batch(camera_hits[m], memory_.shares, m);
  }

  void shade_row(int y, Rgb8Image& image) {
    const auto width = static_cast<std::size_t>(right_ - left_);
    std::vector<CameraHit>& mean_hits = memory_.mean_hits;
    mean_hits.resize(width);
    memory_.points.resize(width);
    for (std::size_t i = 0; i < width; ++i) {
      const Pixel& at = pixel(left_ + static_cast<int>(i), y);
      if (!has_uniform_samples(at)) continue;
      mean_hits[i] = mean_of(hits_of(at));
      mean_hits[i].surface.normal.normalize();
      put(mean_hits[i], i, memory_.points);
    }
    share(memory_.points, width, left_, y, true, memory_.row_shares);
    memory_.batch.clear();
    for (std::size_t i = 0; i < width; ++i) {
      const int x = left_ + static_cast<int>(i);
      const Pixel& at = pixel(x, y);
      if (has_uniform_samples(at)) {
        add_to_batch(mean_hits[i], memory_.row_shares, i);
      } else {
        add_each(hits_of(at), x, y);
      }
    }
    memory_.batch.shade();
    std::size_t next = 0;
    for (int x = left_; x < right_; ++x) {
      const Pixel& at = pixel(x, y);
      LinearRgb light = at.backdrop;  // sum, divided below by the number of samples
      if (has_uniform_samples(at)) {
        light = memory_.batch.radiance(next++);
      } else {
        for (std::uint32_t m = at.first; m < at.end; ++m) light += memory_.batch.radiance(next++);
        light /= static_cast<float>(at.end - at.first + at.missed);
      }
      const auto bytes = to_srgb8(light);
      std::copy(bytes.begin(), bytes.end(), image.at(x, y));
    }
  }

  const HeadScene& scene_;
  const Sampling& sampling_;
  int size_;
  int left_, top_, right_, bottom_;
  int rim_left_, rim_top_, rim_right_, rim_bottom_;
  PixelRectangle outer_;
  std::vector<Pixel> pixels_;
  TileMemory& memory_;
  std::vector<CameraHit>& camera_hits_ = memory_.camera_hits;
};

}  // namespace

void render_tile(const HeadScene& scene, const Sampling& sampling, int left, int top,
                 Rgb8Image& image) {
  Tile(scene, sampling, left, top, image.width).render(image);
}

}  // namespace crowdface
