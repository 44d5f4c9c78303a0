// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/hair_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "crowdface/core/random.h"
#include "crowdface/core/smooth_step.h"
#include "head_models/synth/noise.h"

namespace crowdface::synth {
namespace {

constexpr std::size_t kStrands = 30;          // strands per strip
constexpr double kAcross = 1.9, kDown = 1.5;  // noise frequencies of curls on the cap's strip

/// The last strip of the texture is for the cap, the mesh on the scalp under the hair cards. From
/// v = 1 down to this fraction of its length, the strip shows strands without gaps; the remaining
/// part shows single hair roots.
constexpr double kCapClosed = 0.5;

struct Strand {
  double place = 0;  ///< horizontal position, in units of a strip's width
  double half = 0;   ///< half the strand's width, in units of a strip's width
  double start = 0;  ///< start as a fraction of the card's length
  double end = 1;    ///< end as a fraction of the card's length
  double light = 1;  ///< brightness relative to the hair colour
};

std::vector<Strand> draw_strands() {
  std::vector<Strand> strands;
  for (std::uint64_t s = 0; s < kTextureStripCount * kStrands; ++s) {
    const auto unit = [&](const char* purpose) { return random_uniform({29, s, purpose}); };
    const std::uint64_t strip = s / kStrands;
    const auto within = static_cast<double>(s % kStrands);
    strands.push_back(
        {static_cast<double>(strip) + 0.07 + 0.86 * (within + 0.2 + 0.6 * unit("place")) / kStrands,
         0.03 * (0.7 + 0.6 * unit("half")), 0.12 * unit("start"), 0.7 + 0.3 * unit("end"),
         0.78 + 0.46 * unit("light")});
  }
  return strands;
}

}  // namespace

std::vector<std::uint8_t> hair_picture(int size, const ScreenColour& colour, bool curly) {
  const std::vector<Strand> strands = draw_strands();
  const SmoothNoise bends(mix(3, curly ? 1 : 0, 8), curly ? 0.09 : 0.3);
  const double swing = curly ? 0.1 : 0.05;
  const SmoothNoise clumps(mix(3, 1, 9), 0.11), roots(mix(3, 1, 10), 0.02);
  const auto side = static_cast<std::size_t>(size);
  std::vector<std::uint8_t> bytes(4 * side * side);
  for (std::size_t y = 0; y < side; ++y) {
    // Centre of each strand in this row.
    const double t = (static_cast<double>(y) + 0.5) / size;
    std::array<double, kTextureStripCount * kStrands> middles{};
    for (std::size_t s = 0; s < middles.size(); ++s)
      middles[s] = strands[s].place + swing * bends.at({0.6 * static_cast<double>(s), t, 0});
    for (std::size_t x = 0; x < side; ++x) {
      const double u = (static_cast<double>(x) + 0.5) / size * kTextureStripCount;
      const auto strip = static_cast<std::size_t>(u);
      const bool below = strip >= kCardStripCount;
      // The hair cap ends in single hair roots that become sparse, because a hard edge would look
      // like a wig.
      const double root = below ? roots.at({u, t, 0}) : 0;
      double cover = below ? smooth_step(1, 0.45, t + 0.05 * root) : 0;
      double light = below ? 0.8 : 0.7;
      if (below && curly) {  // short, darker curls
        const double clump = clumps.at({kAcross * u, kDown * t, 0});
        light = 0.62 + 0.5 * clump + 0.2 * root;
      } else if (below && t > kCapClosed) {
        light += 0.12 * root;
      } else {
        // Composite the strands of this strip; each strand is darker at its edges.
        for (std::size_t s = strip * kStrands; s < (strip + 1) * kStrands; ++s) {
          const Strand& strand = strands[s];
          const double away = std::abs(u - middles[s]);
          if (away > 1.2 * strand.half || t >= strand.end) continue;
          const double half = strand.half * (1 - 0.8 * smooth_step(0.45, 1, t / strand.end));
          const double across = away / half;
          // At the start of a strand, the hair is thin and becomes visible gradually.
          const double grown = below ? 1 : smooth_step(strand.start, strand.start + 0.07, t);
          const double inside = grown * smooth_step(1.2, 0.7, across);
          if (inside <= 0) continue;
          light += inside * (strand.light * (1 - 0.25 * std::min(1.0, across * across)) - light);
          cover = std::max(cover, inside);
        }
      }
      if (!below) light *= 0.7 + 0.3 * smooth_step(0, 0.35, t);  // darken the roots
      std::uint8_t* texel = &bytes[4 * (y * side + x)];
      for (Eigen::Index c = 0; c < 3; ++c)
        texel[c] = to_byte(std::clamp(colour[c] * light, 0.0, 1.0));
      texel[3] = to_byte(cover);
    }
  }
  return bytes;
}

}  // namespace crowdface::synth
