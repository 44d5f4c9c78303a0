// SPDX-License-Identifier: Apache-2.0
#include "crowdface/synth/hair_cards.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "crowdface/core/random.h"
#include "crowdface/core/smooth_step.h"
#include "crowdface/synth/ear.h"
#include "crowdface/synth/hair.h"
#include "crowdface/synth/layout.h"
#include "crowdface/synth/mean_head.h"
#include "crowdface/synth/noise.h"
#include "crowdface/synth/sculpture.h"

namespace crowdface::synth {
namespace {

using Eigen::Vector3d;

constexpr int kMostPieces = 8;      // quads along a card
constexpr double kBetween = 0.66;   // centimetres from root to root
constexpr double kCardWidth = 1.1;  // centimetres
constexpr int kStrips = 4;          // side by side in the picture

/// From the average head's skin, the ears as lumps.
double head_distance(const Vector3d& p) {
  const Vector3d radii(1.0, 3.0, 2.0);
  const Vector3d q = (Vector3d(std::abs(p.x()), p.y(), p.z()) - ear_centre()).cwiseQuotient(radii);
  return std::min(skin_distance(p), (q.norm() - 1) * radii.x());
}

Vector3d away_from_head(const Vector3d& p) {
  return rise(head_distance, p, 1e-3).normalized();
}

struct Root {
  Vector3d place, normal;
};

/// Evenly over the scalp, none nearer to another than `between`.
std::vector<Root> roots_on_scalp(const HairCut& cut, double between) {
  std::vector<Root> roots;
  for (const Address& address : make_layout(24'000).addresses) {
    const SkinPoint skin = mean_skin_with_sockets(address);
    const Vector3d& p = skin.position;
    if (skin.relief < 0.5 || above_hairline(p, cut.female) < (cut.fringe < 99 ? 0.5 : 0.15))
      continue;
    const double top = smooth_step(3.5, 6.5, p.y() + 0.25 * std::max(0.0, p.z()));
    if (cut.sides <= 0 && top < 0.35) continue;
    const bool near = std::ranges::any_of(roots, [&](const Root& other) {
      return (other.place - p).squaredNorm() < between * between;
    });
    if (!near) roots.push_back({p, skin.normal});
  }
  return roots;
}

/// One card's middle line, and where across it is widest.
struct Card {
  std::vector<Vector3d> middle, across;
};

class Grower {
 public:
  explicit Grower(const HairCut& cut) : cut_(cut), locks_(mix(7, 1, 5), 1.6) {}

  Card grow(const Root& root, std::uint64_t number, int layer) const {
    return cut_.layers > 1 ? tangle(root, number, layer) : comb(root, number);
  }

 private:
  /// A lock that lies on the head, or hangs from it.
  Card comb(const Root& root, std::uint64_t number) const {
    const auto unit = [&](const char* purpose) { return random_unit({17, number, purpose}); };
    const double top = smooth_step(3, 8, root.place.y()), level = unit("level");
    const double length =
        (cut_.sides + top * (cut_.length - cut_.sides)) * (0.85 + 0.3 * unit("length"));
    const double hem = cut_.hem - 1.2 * unit("hem");
    const double fringe = cut_.fringe + 0.5 * (unit("hem") - 0.5),
                 twist = 0.35 * (unit("twist") - 0.5);
    // Roots lie below those beyond them, so that no parting is bare.
    const Vector3d way = combed(root.place);
    Vector3d p = root.place - 0.35 * way;
    p += (0.05 + 0.1 * level - head_distance(p)) * away_from_head(p);
    Vector3d direction = (0.25 * root.normal + way).normalized();
    Card card;
    for (int i = 0;; ++i) {
      const Vector3d normal = away_from_head(p);
      card.middle.push_back(p);
      card.across.push_back((direction.cross(normal) + twist * normal).normalized());
      const bool over_face =
          cut_.fringe < 99 && p.z() > 2.5 && std::abs(p.x()) < 6.3 && p.y() < fringe;
      if (i == kMostPieces || (i > 1 && (p.y() < hem || over_face))) return evened(card);
      // Short pieces where it leaves the head, whose curve they follow.
      const double t = static_cast<double>(i + 1) / kMostPieces, grown = along(t) * length;
      const double step = grown - along(static_cast<double>(i) / kMostPieces) * length;
      const double falls = smooth_step(0.5, 5, grown);
      direction += (0.95 - 0.7 * falls) * combed(p) + 0.75 * falls * Vector3d(0, -1, 0);
      Vector3d next = p + step * direction.normalized();
      const double swing = cut_.wave * smooth_step(0, 0.4, t);
      next += swing * Vector3d(locks_.at(next), 0, locks_.at(next + Vector3d(0, 0, 9)));
      next = beside_face(next, fringe);
      const double off =
          (0.25 + 0.75 * level) * cut_.volume * smooth_step(0, 3, grown) * (0.55 + 0.45 * top);
      for (int k = 0; k < 2; ++k) {
        const double missing = off + 0.12 - head_distance(next);
        // What lies on the head stays on it; what hangs leans towards it.
        const double held = missing > 0 ? 1 : 0.5 * smooth_step(-7, 1, next.y());
        next += held * std::max(missing, -2.0) * away_from_head(next);
      }
      direction = (next - p).normalized();
      p = next;
    }
  }

  /// A short curl in any direction, at one of the heights above the scalp.
  Card tangle(const Root& root, std::uint64_t number, int layer) const {
    const auto unit = [&](const char* purpose) { return random_unit({17, number, purpose}); };
    const double top = smooth_step(1, 7, root.place.y());
    const double level = (layer + 0.2 + 0.8 * unit("level")) / cut_.layers;
    const double length =
        (cut_.sides + top * (cut_.length - cut_.sides)) * (0.8 + 0.4 * unit("length"));
    const Vector3d any(unit("x") - 0.5, unit("y") - 0.5, unit("z") - 0.5);
    Vector3d p = root.place + level * (0.45 + 0.35 * top) * cut_.volume * root.normal;
    Vector3d direction = (any.normalized() + 0.2 * root.normal).normalized();
    const Vector3d across =
        (direction.cross(root.normal) + 1.2 * any.y() * root.normal).normalized();
    Card card;
    constexpr int kPieces = 4;
    for (int i = 0; i <= kPieces; ++i) {
      card.middle.push_back(p);
      card.across.push_back(across);
      direction += 0.6 * Vector3d(locks_.at(p), locks_.at(p + Vector3d(9, 0, 0)),
                                  locks_.at(p + Vector3d(0, 9, 0)));
      direction.normalize();
      p += length / kPieces * direction;
      const double missing = 0.15 - head_distance(p);
      if (missing > 0) p += missing * away_from_head(p);
    }
    return card;
  }

  /// How much of its length a lock has at piece t of all.
  static double along(double t) { return t * (0.3 + 0.7 * t); }

  /// Which way hair is combed here.
  Vector3d combed(const Vector3d& p) const {
    const double side = std::clamp((p.x() - cut_.parting) / 0.25, -1.0, 1.0);
    const bool ahead = cut_.fringe < 99 && p.z() > 1.5 && std::abs(p.x()) < 5.5;
    Vector3d way(cut_.sideways * side, -0.15, -cut_.back);
    if (ahead) way = Vector3d(0.1 * side, -0.3, 1.2);
    const Vector3d normal = away_from_head(p);
    way -= way.dot(normal) * normal;
    return way.norm() > 1e-6 ? Vector3d(way.normalized()) : way;
  }

  /// No lock hangs over the face.
  static Vector3d beside_face(Vector3d p, double fringe) {
    const double wide = 5.5 * smooth_step(0.5, 4, p.z()) * smooth_step(6.2, 1.5, p.y());
    if (fringe < 99 && p.y() > fringe) return p;
    if (std::abs(p.x()) < wide) p.x() = p.x() < 0 ? -wide : wide;
    return p;
  }

  /// The same line in pieces of one length.
  static Card evened(const Card& card) {
    Card even;
    const auto last = static_cast<double>(card.middle.size() - 1);
    for (int i = 0; i <= kMostPieces; ++i) {
      const double place = i * last / kMostPieces;
      const auto k = static_cast<std::size_t>(std::min(std::floor(place), last - 1));
      const double t = place - static_cast<double>(k);
      even.middle.emplace_back((1 - t) * card.middle[k] + t * card.middle[k + 1]);
      even.across.emplace_back(((1 - t) * card.across[k] + t * card.across[k + 1]).normalized());
    }
    return even;
  }

  const HairCut& cut_;
  SmoothNoise locks_;
};

void add_card(const Card& card, double width, int strip, bool turned, std::vector<Vector3d>& points,
              std::vector<Eigen::Vector2d>& uvs, Topology& topology) {
  const auto first = static_cast<std::uint32_t>(points.size());
  const auto pieces = static_cast<std::uint32_t>(card.middle.size() - 1);
  for (std::size_t i = 0; i <= pieces; ++i) {
    const double t = static_cast<double>(i) / pieces;
    const double half = width / 2 * (0.7 + 0.3 * smooth_step(0, 0.3, t)) * (1 - 0.35 * t * t);
    for (const double side : {-1.0, 1.0}) {
      points.emplace_back(card.middle[i] + side * half * card.across[i]);
      uvs.emplace_back((strip + 0.5 + (turned ? -side : side) * 0.49) / kStrips, 0.998 - 0.996 * t);
    }
  }
  for (std::uint32_t i = 0; i < pieces; ++i) {
    const std::uint32_t a = first + 2 * i;
    const std::array<std::uint32_t, 4> quad = {a, a + 1, a + 3, a + 2};
    topology.add_face(quad, quad);
  }
}

constexpr std::size_t kStrands = 13;  // a strip

struct Strand {
  double place = 0;  ///< across all strips, a strip is 1
  double half = 0;   ///< of its width
  double end = 1;    ///< of the card's length
  double light = 1;  ///< against the hair's colour
};

std::vector<Strand> draw_strands() {
  std::vector<Strand> strands;
  for (std::uint64_t s = 0; s < kStrips * kStrands; ++s) {
    const auto unit = [&](const char* purpose) { return random_unit({29, s, purpose}); };
    const std::uint64_t strip = s / kStrands;
    const auto within = static_cast<double>(s % kStrands);
    strands.push_back(
        {static_cast<double>(strip) + 0.07 + 0.86 * (within + 0.2 + 0.6 * unit("place")) / kStrands,
         0.062 * (0.7 + 0.6 * unit("half")), 0.72 + 0.28 * unit("end"),
         0.72 + 0.62 * unit("light")});
  }
  return strands;
}

}  // namespace

std::span<const HairCut> hair_cuts() {
  // clang-format off
  static const std::array cuts = {
      HairCut{.name = "long", .female = true, .parting = 0.4, .back = 0.35, .length = 30, .sides = 18, .hem = -17,
              .volume = 0.9, .wave = 0.05},
      HairCut{.name = "bob", .female = true, .parting = -2.2, .back = 0.2, .length = 19, .sides = 10, .hem = -8.5,
              .volume = 1.1, .wave = 0.06},
      HairCut{.name = "fringe", .female = true, .back = 0.3, .length = 24, .sides = 14, .hem = -12, .fringe = 3.4,
              .volume = 0.9, .wave = 0.05},
      HairCut{.name = "waves", .female = true, .curly = true, .parting = 1.5, .back = 0.3, .length = 26, .sides = 16,
              .hem = -14, .volume = 1.7, .wave = 0.35},
      HairCut{.name = "pixie", .female = true, .parting = 2.4, .back = 0.25, .length = 9, .sides = 4.5, .hem = -5,
              .wave = 0.08},
      HairCut{.name = "curls", .female = true, .curly = true, .length = 1.7, .sides = 1.6, .volume = 2.1, .layers = 5},
      HairCut{.name = "side_parting", .parting = -3.2, .back = 0.35, .length = 8.5, .sides = 2.6, .hem = 0.5,
              .volume = 0.9, .wave = 0.05},
      HairCut{.name = "swept_back", .sideways = 0.25, .back = 1, .length = 9, .sides = 3, .hem = 0, .wave = 0.05},
      HairCut{.name = "tousled", .parting = 1.5, .sideways = 0.6, .back = -0.3, .length = 4.5, .sides = 2, .hem = 1,
              .fringe = 5.6, .wave = 0.25},
      HairCut{.name = "short_curls", .curly = true, .length = 1.2, .sides = 0, .volume = 1.4, .layers = 3},
  };
  // clang-format on
  return cuts;
}

std::span<const HairColour> hair_colours() {
  static const std::array colours = {
      HairColour{"blond", from_bytes(170, 138, 96)},
      HairColour{"light_brown", from_bytes(120, 92, 66)},
      HairColour{"brown", from_bytes(80, 60, 47)},
      HairColour{"dark_brown", from_bytes(55, 42, 35)},
      HairColour{"black", from_bytes(32, 28, 27)},
      HairColour{"grey", from_bytes(112, 106, 101)},
      HairColour{"white", from_bytes(164, 161, 158)},
  };
  return colours;
}

const HairColour& nearest_hair_colour(const ScreenColour& colour) {
  const auto off = [&](const HairColour& other) { return (other.colour - colour).square().sum(); };
  return *std::ranges::min_element(hair_colours(), {}, off);
}

Mesh hair_cards(const HairCut& cut) {
  const std::vector<Root> roots = roots_on_scalp(cut, kBetween);
  const double width = cut.layers > 1 ? 0.55 * kCardWidth : kCardWidth;
  Mesh mesh;
  std::vector<Vector3d> points;
  std::vector<Eigen::Vector2d> uvs;
  const Grower grower(cut);
  for (std::size_t r = 0; r < roots.size(); ++r) {
    for (int layer = 0; layer < cut.layers; ++layer) {
      const std::uint64_t number = r * 16 + static_cast<std::uint64_t>(layer);
      const double strip = kStrips * random_unit({17, number, "strip"});
      const bool turned = random_unit({17, number, "turned"}) < 0.5;
      add_card(grower.grow(roots[r], number, layer), width, static_cast<int>(strip), turned, points,
               uvs, mesh.topology);
    }
  }
  mesh.topology.vertex_count = static_cast<Index>(points.size());
  mesh.positions.resize(mesh.topology.vertex_count, 3);
  mesh.uvs.resize(mesh.topology.vertex_count, 2);
  for (Index v = 0; v < mesh.topology.vertex_count; ++v) {
    mesh.positions.row(v) = points[static_cast<std::size_t>(v)].transpose();
    mesh.uvs.row(v) = uvs[static_cast<std::size_t>(v)].transpose();
  }
  return mesh;
}

std::vector<std::uint8_t> hair_picture(int size, const ScreenColour& colour, bool curly) {
  const std::vector<Strand> strands = draw_strands();
  const SmoothNoise bends(mix(3, curly ? 1 : 0, 8), curly ? 0.09 : 0.3);
  const double swing = curly ? 0.1 : 0.05;
  const auto side = static_cast<std::size_t>(size);
  std::vector<std::uint8_t> bytes(4 * side * side);
  for (std::size_t y = 0; y < side; ++y) {
    const double t = (static_cast<double>(y) + 0.5) / size;
    std::array<double, kStrips * kStrands> middles{};
    for (std::size_t s = 0; s < middles.size(); ++s)
      middles[s] = strands[s].place + swing * bends.at({0.6 * static_cast<double>(s), t, 0});
    for (std::size_t x = 0; x < side; ++x) {
      const double u = (static_cast<double>(x) + 0.5) / size * kStrips;
      const auto strip = static_cast<std::size_t>(u);
      double cover = 0, light = 0.7;
      for (std::size_t s = strip * kStrands; s < (strip + 1) * kStrands; ++s) {
        const Strand& strand = strands[s];
        const double half = strand.half * (1 - 0.8 * smooth_step(0.35, 1, t / strand.end));
        const double across = (u - middles[s]) / half;
        const double inside = t < strand.end ? smooth_step(1.2, 0.7, std::abs(across)) : 0.0;
        if (inside <= 0) continue;
        light += inside * (strand.light * (1 - 0.25 * std::min(1.0, across * across)) - light);
        cover = std::max(cover, inside);
      }
      light *= 0.7 + 0.3 * smooth_step(0, 0.35, t);  // roots lie in the shade of the rest
      std::uint8_t* texel = &bytes[4 * (y * side + x)];
      for (Eigen::Index c = 0; c < 3; ++c)
        texel[c] = to_byte(std::clamp(colour[c] * light, 0.0, 1.0));
      texel[3] = to_byte(cover);
    }
  }
  return bytes;
}

}  // namespace crowdface::synth
