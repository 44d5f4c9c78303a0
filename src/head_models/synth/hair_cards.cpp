// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/hair_cards.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "crowdface/core/random.h"
#include "crowdface/core/smooth_step.h"
#include "head_models/synth/hair_form.h"
#include "head_models/synth/hair_picture.h"
#include "head_models/synth/layout.h"
#include "head_models/synth/mean_head.h"
#include "head_models/synth/noise.h"

namespace crowdface::synth {
namespace {

using Eigen::Vector3d;

constexpr int kPieces = 9, kPiecesOfShort = 6, kPiecesOfCurl = 4;  // quads along a card
constexpr double kRootSpacing = 0.73;                              // distance between roots, cm
constexpr double kSparseRoots = 0.15;  // additional distance between hidden roots, relative
constexpr double kCardWidth = 1.05;    // cm
constexpr double kSinks = 0.06;        // cm per cm: how fast combed hair approaches the head
constexpr double kHalfWave = 2.6;      // half the wavelength of curly locks, cm
constexpr int kWispLayer = 1;          // layer of combed hair: single strands above the locks
constexpr double kWispFraction = 0.2;  // fraction of the roots that have a card in this layer

struct Root {
  Vector3d place, normal;
  double inside = 0;  ///< distance of the root from the hairline, cm
};

/// Returns the roots of hair cards, spread over the scalp with a minimum distance. Long hair hides
/// the roots far from the hairline, so these roots are farther apart. Moves roots near a parting to
/// the line of the parting.
std::vector<Root> roots_on_scalp(const HairCut& cut) {
  const double least = cut.layers > 1 ? 0.1 : cut.has_fringe() ? 0.5 : 0.3;
  std::vector<Root> roots;
  for (const LatticePoint& lattice_point : make_layout(24'000).lattice_points) {
    const SkinPoint skin = mean_skin_with_sockets(lattice_point);
    const Vector3d& p = skin.position;
    const bool at_nape = cut.layers > 1 && p.y() < 0;  // keep curls off the neck
    if (skin.relief_weight < 0.5) continue;
    const double inside = distance_inside_hair(cut, p), from_parting = p.x() - cut.parting_x;
    if (inside < (at_nape ? 2 : least)) continue;
    const bool at_parting = cut.has_parting() && std::abs(from_parting) < 0.5 && p.z() > -4;
    const double hidden = cut.is_long() ? smooth_step(0.5, 3, inside) : 0;
    const double spacing = kRootSpacing * (1 + (at_parting ? 0 : kSparseRoots * hidden));
    const bool near = std::ranges::any_of(roots, [&](const Root& other) {
      return (other.place - p).squaredNorm() < spacing * spacing;
    });
    if (near) continue;
    roots.push_back({p, skin.normal, inside});
    if (at_parting) roots.back().place.x() = cut.parting_x + std::copysign(0.12, from_parting);
  }
  return roots;
}

/// The points of a card's centre line and, at each of these points, the unit vector across the
/// card.
struct Card {
  std::vector<Vector3d> middle, across;
};

/// Makes the hair cards of one haircut.
class HairCardBuilder {
 public:
  explicit HairCardBuilder(const HairCut& cut)
      : cut_(cut),
        locks_(mix(7, 1, 5), 1.6),
        pieces_(cut.is_long() ? kPieces : kPiecesOfShort),
        hides_ears_(cut.is_long() && !cut.is_tied) {}

  Card grow(const Root& root, std::uint64_t number, int layer) const {
    return cut_.layers > 1 ? random_curl(root, number, layer) : comb(root, number, layer);
  }

 private:
  /// Traces a lock from its root: the lock first follows the combing direction on the head, then
  /// hangs down.
  Card comb(const Root& root, std::uint64_t number, int layer) const {
    const auto unit = [&](const char* purpose) { return random_uniform({17, number, purpose}); };
    const double top = smooth_step(3, 8, root.place.y());
    const double lift =
        layer == kWispLayer ? 0.14 + 0.36 * unit("level") : 0.06 + 0.16 * unit("level");
    const double length = (cut_.side_length + top * (cut_.top_length - cut_.side_length)) *
                          (0.85 + 0.3 * unit("length"));
    const double hem = cut_.hem_y - 1.2 * unit("hem");
    const double fringe = cut_.fringe_y + 0.5 * (unit("hem") - 0.5),
                 twist = 0.25 * (unit("twist") - 0.5);
    const Vector3d way = combing_direction(cut_, root.place);
    // Shift the root, so that roots do not form a straight line along the hairline.
    Vector3d p = root.place - (0.45 * unit("root") - 0.1) * way;
    double rest = hair_stand_off(cut_, p);
    p += (rest + 0.02 - head_distance(p, hides_ears_)) * head_distance_gradient(p, hides_ears_);
    Vector3d direction = (0.1 * root.normal + way).normalized();
    const double curl = cut_.is_curly ? cut_.wave_amplitude : 0;
    const double phase = 2 * locks_.at(0.4 * root.place) + 0.5 * unit("phase");
    double grown = 0;
    Card card;
    for (int i = 0;; ++i) {
      const Vector3d normal = head_distance_gradient(p, hides_ears_);
      const Vector3d across = (direction.cross(normal) + twist * normal).normalized();
      const double turn = phase + grown / kHalfWave;
      card.middle.emplace_back(p + curl * smooth_step(0, 4, grown) *
                                       (smooth_wave(turn) * across +
                                        (1 + smooth_wave(turn + 0.5)) * direction.cross(across)));
      card.across.push_back(across);
      if (i == pieces_ || (i > 1 && cut_off(p, hem, fringe))) return resampled(card);
      // Pieces near the root are short, because they follow the curvature of the head.
      const double t = static_cast<double>(i + 1) / pieces_, before = grown;
      grown = along(t) * length;
      const double step = grown - before;
      const double held = cut_.is_tied ? smooth_step(-3, -6, p.z()) : 1;
      const double falls = held * smooth_step(0.5, 5, grown);
      const double hangs = falls * smooth_step(1, -3, p.y());
      const double combed = (0.95 - 0.7 * falls) * (1 - hangs);
      // Make hanging locks less sideways; otherwise single locks would stick out.
      direction.x() *= 1 - 0.6 * hangs;
      direction += combed * combing_direction(cut_, p) + 0.75 * falls * Vector3d(0, -1, 0);
      Vector3d next = p + step * direction.normalized();
      const double swing = cut_.wave_amplitude * smooth_step(0, 0.4, t);
      next += swing * Vector3d(locks_.at(next), 0, locks_.at(next + Vector3d(0, 0, 9)));
      next = beside_face(next, fringe);
      // A lock lies on other hair, so its distance from the head (`rest`) must not jump. Above the
      // height of the ears, `rest` decreases slowly along the lock. Lower down, `rest` never
      // decreases.
      rest =
          std::max(rest - kSinks * step * smooth_step(3, 6, next.y()), hair_stand_off(cut_, next));
      next = moved_off_head(next, rest + lift * smooth_step(0, 2, grown));
      // Over the face, the lock ends at the lower edge of the fringe; elsewhere, at the lower edge
      // of the haircut.
      const double limit = over_face(next) ? fringe : hem;
      if (i > 0 && next.y() < limit && p.y() > limit)
        next = p + (p.y() - limit + 1e-3) / (p.y() - next.y()) * (next - p);
      direction = (next - p).normalized();
      p = next;
    }
  }

  /// Moves a point to the distance `off` from the head. Where hair hangs freely, a point that is
  /// already farther away than `off` is moved only part of the way.
  Vector3d moved_off_head(Vector3d p, double off) const {
    for (int k = 0; k < 2; ++k) {
      const double missing = off + 0.05 - head_distance(p, hides_ears_);
      const double hangs = cut_.is_tied ? smooth_step(-4, -9, p.y()) : smooth_step(2.5, -1, p.y());
      const double held = missing > 0 ? 1 : 1 - hangs * (1 - 0.5 * smooth_step(-7, 1, p.y()));
      p += held * std::max(missing, -2.0) * head_distance_gradient(p, hides_ears_);
    }
    return p;
  }

  bool over_face(const Vector3d& p) const {
    return cut_.has_fringe() && p.z() > 2.5 && std::abs(p.x()) < 6.3;
  }
  bool cut_off(const Vector3d& p, double hem, double fringe) const {
    return p.y() < (over_face(p) ? fringe : hem);
  }

  /// Returns a short curl in a random direction; `layer` sets its height above the scalp.
  Card random_curl(const Root& root, std::uint64_t number, int layer) const {
    const auto unit = [&](const char* purpose) { return random_uniform({17, number, purpose}); };
    const double top = smooth_step(1, 7, root.place.y());
    const double level = 0.3 + 0.7 * (layer + 0.2 + 0.8 * unit("level")) / cut_.layers;
    const double length = (cut_.side_length + top * (cut_.top_length - cut_.side_length)) *
                          (0.8 + 0.4 * unit("length"));
    const Vector3d any(unit("x") - 0.5, unit("y") - 0.5, unit("z") - 0.5);
    const Vector3d other(unit("a") - 0.5, unit("b") - 0.5, unit("c") - 0.5);
    Vector3d p = root.place + level * (0.45 + 0.35 * top) * cut_.volume_factor * root.normal;
    Vector3d direction = (any.normalized() + 0.6 * root.normal).normalized();
    const Vector3d axis = direction.cross(other).normalized();
    Card card;
    for (int i = 0; i <= kPiecesOfCurl; ++i) {
      card.middle.push_back(p);
      card.across.push_back(axis);
      // Each piece turns by about 35° around the axis.
      direction = (0.82 * direction + 0.57 * axis.cross(direction)).normalized();
      p += length / kPiecesOfCurl * direction;
      const double missing = 0.15 - head_distance(p);
      if (missing > 0) p += missing * head_distance_gradient(p);
    }
    return card;
  }

  /// Maps a fraction t of the lock's pieces, counted from the root, to a fraction of the lock's
  /// length.
  static double along(double t) { return t * (0.3 + 0.7 * t); }

  /// If a point of a lock lies in front of the face, moves the point sideways to the edge of the
  /// face. Does not move the points of a fringe.
  static Vector3d beside_face(Vector3d p, double fringe) {
    const double wide = 5.5 * smooth_step(0.5, 4, p.z()) * smooth_step(6.2, 1.5, p.y());
    if (fringe < HairCut::kNoFringe && p.y() > fringe) return p;
    if (std::abs(p.x()) < wide) p.x() = p.x() < 0 ? -wide : wide;
    return p;
  }

  /// Resamples a card to `pieces_` pieces, at evenly spaced fractional indices of the card's
  /// points.
  Card resampled(const Card& card) const {
    Card even;
    const auto last = static_cast<double>(card.middle.size() - 1);
    for (int i = 0; i <= pieces_; ++i) {
      const double place = i * last / pieces_;
      const auto k = static_cast<std::size_t>(std::min(std::floor(place), last - 1));
      const double t = place - static_cast<double>(k);
      even.middle.emplace_back((1 - t) * card.middle[k] + t * card.middle[k + 1]);
      even.across.emplace_back(((1 - t) * card.across[k] + t * card.across[k + 1]).normalized());
    }
    return even;
  }

  const HairCut& cut_;
  SmoothNoise locks_;
  int pieces_;
  bool hides_ears_;
};

void add_card(const Card& card, double width, int strip, bool turned, HairMesh& hair) {
  const auto first = static_cast<std::uint32_t>(hair.points.size());
  const auto pieces = static_cast<std::uint32_t>(card.middle.size() - 1);
  for (std::size_t i = 0; i <= pieces; ++i) {
    const double t = static_cast<double>(i) / pieces;
    const double half = width / 2 * (0.6 + 0.4 * smooth_step(0, 0.25, t)) * (1 - 0.35 * t * t);
    for (const double side : {-1.0, 1.0}) {
      hair.points.emplace_back(card.middle[i] + side * half * card.across[i]);
      hair.uvs.emplace_back((strip + 0.5 + (turned ? -side : side) * 0.49) / kTextureStripCount,
                            0.998 - 0.996 * t);
    }
  }
  for (std::uint32_t i = 0; i < pieces; ++i) {
    const std::uint32_t a = first + 2 * i;
    const std::array<std::uint32_t, 4> quad = {a, a + 1, a + 3, a + 2};
    hair.topology.add_face(quad, quad);
  }
}

}  // namespace

void add_hair_cards(const HairCut& cut, HairMesh& hair) {
  const std::vector<Root> roots = roots_on_scalp(cut);
  const bool combed = cut.layers == 1;
  const double width = combed && !cut.is_curly ? kCardWidth : 0.7 * kCardWidth;
  const HairCardBuilder grower(cut);
  for (std::size_t r = 0; r < roots.size(); ++r) {
    for (int layer = 0; layer < (combed ? kWispLayer + 1 : cut.layers); ++layer) {
      const std::uint64_t number = r * 16 + static_cast<std::uint64_t>(layer);
      const auto unit = [&](const char* purpose) { return random_uniform({17, number, purpose}); };
      const bool is_wisp = combed && layer == kWispLayer;
      if (is_wisp && unit("wisp") > kWispFraction) continue;
      // Some cards get the texture strip with sparse hair (`is_thin`). In combed hair, these are
      // cards near the hairline above the forehead; in curly hair, the cards of the outermost
      // layer. Exception: in long hair, cards beside the cheeks are not sparse, because skin would
      // show through.
      const bool shows_skin = cut.is_long() && roots[r].place.y() < 4;
      const bool is_thin = combed ? !shows_skin && roots[r].inside < 0.3 + 0.7 * unit("hairline")
                                  : layer + 1 == cut.layers;
      const int strip = is_wisp   ? kWispStrip
                        : is_thin ? kThinStrip
                                  : static_cast<int>(kThinStrip * unit("strip"));
      add_card(grower.grow(roots[r], number, layer), width, strip, unit("turned") < 0.5, hair);
    }
  }
}

Mesh head_of_hair(const HairCut& cut) {
  HairMesh hair;
  add_hair_cap(cut, hair);
  add_hair_cards(cut, hair);
  return std::move(hair).to_mesh();
}

}  // namespace crowdface::synth
