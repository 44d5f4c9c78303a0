// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/hair_picture.h"

#include <algorithm>
#include <cmath>

#include "crowdface/core/random.h"
#include "crowdface/core/smooth_step.h"
#include "head_models/synth/noise.h"

namespace crowdface::synth {
namespace {

constexpr std::size_t kStrands = 56;  // strands per strip
constexpr double kWaves = 8;          // minimum number of half waves of a curly strand
constexpr double kSwing = 0.075;      // amplitude of these waves, in units of a strip's width

struct Strand {
  std::uint64_t clump = 0;  ///< number of the strand's clump, unique among all strips
  double place = 0;         ///< horizontal position of the root, in units of a strip's width
  double middle = 0;  ///< horizontal position of the clump's middle, in units of a strip's width
  double half = 0;    ///< half the strand's width, in units of a strip's width
  double start = 0;   ///< where the strand starts, as a fraction of the card's length
  double end = 1;     ///< where the strand ends, as a fraction of the card's length
  double light = 1;   ///< brightness of the strand relative to the hair colour
  double bend = 0;    ///< amplitude of the strand's own bends, in units of a strip's width
  /// Curly hair: number of half waves along the whole strand, and the phase of the wave at the
  /// root, in half waves.
  double waves = 0, phase = 0;
};

/// Draws the strands of all strips at random. The strands of a clump have similar brightness and
/// gather towards their tips.
std::vector<Strand> draw_strands(bool curly) {
  const std::uint64_t clumps = curly ? 4 : 8;  // per strip
  std::vector<Strand> strands;
  for (std::uint64_t s = 0; s < kTextureStripCount * kStrands; ++s) {
    const std::uint64_t strip = s / kStrands,
                        clump = strip * clumps + s % kStrands * clumps / kStrands;
    const auto unit = [&](const char* purpose) { return random_uniform({29, s, purpose}); };
    const auto of_clump = [&](const char* purpose) { return random_uniform({30, clump, purpose}); };
    const bool is_wisp = strip == kWispStrip, is_cap = strip == kCardStripCount;
    if ((is_wisp && s % 6 != 0) || (strip == kThinStrip && s % 2 != 0)) continue;
    const double within = static_cast<double>(s % kStrands) + unit("place");
    const double place = 0.08 + 0.84 * within / kStrands, edge = (2 * place - 1) * (2 * place - 1);
    Strand strand;
    strand.clump = clump;
    strand.place = static_cast<double>(strip) + place;
    strand.middle = (static_cast<double>(clump) + 0.5) / static_cast<double>(clumps);
    strand.half = is_wisp ? 0.011 : 0.016 * (0.7 + 0.6 * unit("half"));
    // At the left and right edge, a card shows short single strands.
    strand.start = (0.01 + (strip < kThinStrip ? 0.04 : 0.12) * edge) * unit("start");
    strand.end = 0.86 + 0.14 * of_clump("end") - (0.08 + 0.22 * edge) * unit("end");
    if (is_cap) strand.end = 0.5 + 0.28 * unit("end");
    strand.light = (curly ? 0.9 + 0.2 * of_clump("light") : 0.78 + 0.44 * of_clump("light")) *
                   (0.72 + 0.56 * unit("light"));
    strand.waves = kWaves * (1 + of_clump("waves"));
    strand.bend = is_wisp ? 0.12 : is_cap ? 0.1 : 0.02;
    strand.phase = 2 * of_clump("phase") + 0.35 * unit("phase");
    strands.push_back(strand);
  }
  return strands;
}

}  // namespace

std::vector<std::uint8_t> hair_picture(int size, const ScreenColour& colour, bool curly) {
  const std::vector<Strand> strands = draw_strands(curly);
  const SmoothNoise bends(mix(3, curly ? 1 : 0, 8), 0.3);
  const auto side = static_cast<std::size_t>(size);
  std::vector<std::uint8_t> bytes(4 * side * side);
  for (std::size_t y = 0; y < side; ++y) {
    const double t = (static_cast<double>(y) + 0.5) / size;
    const auto u_of = [&](std::size_t x) {
      return (static_cast<double>(x) + 0.5) / size * kTextureStripCount;
    };
    std::vector<double> lights(side, 0.65), covers(side, 0);
    // Composite the strands; each strand is darker at its edges.
    for (std::size_t s = 0; s < strands.size(); ++s) {
      const Strand& strand = strands[s];
      if (t >= strand.end) continue;
      const bool is_cap = strand.place >= kCardStripCount;
      const double gathered = is_cap ? 0 : 0.5 * smooth_step(0.2, 1, t / strand.end);
      double middle = strand.place + gathered * (strand.middle - strand.place);
      middle += 0.05 * bends.at({0.6 * static_cast<double>(strand.clump), t, 0}) +
                strand.bend * bends.at({0.6 * static_cast<double>(s), t, 5});
      double light = strand.light * (is_cap ? 0.55 : 1);  // the cap lies in the shade of the cards
      if (curly) {
        const double phase = strand.waves * t + strand.phase;
        middle += kSwing * smooth_wave(phase);
        light *= 1 + 0.22 * smooth_wave(phase + 0.5);  // one half of each winding lies in shade
      }
      // A strand becomes thinner towards its tip (`half`), and fades in at its root (`grown`).
      const double half = strand.half * (1 - 0.7 * smooth_step(0.5, 1, t / strand.end));
      const double grown = is_cap ? smooth_step(strand.end, strand.end - 0.15, t)
                                  : smooth_step(strand.start, strand.start + 0.025, t);
      const double first = std::max(0.0, (middle - 1.2 * half) * size / kTextureStripCount);
      for (auto x = static_cast<std::size_t>(first); x < side && u_of(x) < middle + 1.2 * half;
           ++x) {
        const double across = std::abs(u_of(x) - middle) / half;
        const double inside = grown * smooth_step(1.2, 0.7, across);
        lights[x] += inside * (light * (1 - 0.25 * std::min(1.0, across * across)) - lights[x]);
        covers[x] = std::max(covers[x], inside);
      }
    }
    for (std::size_t x = 0; x < side; ++x) {
      const bool is_cap = u_of(x) >= kCardStripCount;
      const double light = lights[x] * (is_cap ? 1 : 0.65 + 0.35 * smooth_step(0, 0.3, t));
      // The cap shows single hairs near the hairline. Farther from the hairline, the cap is opaque.
      if (is_cap) {
        const double frayed = t + 0.08 * bends.at({10 * u_of(x), 0, 9});
        covers[x] = std::max(covers[x], smooth_step(0.77, 0.47, frayed));
      }
      std::uint8_t* texel = &bytes[4 * (y * side + x)];
      for (Eigen::Index c = 0; c < 3; ++c)
        texel[c] = to_byte(std::clamp(colour[c] * light, 0.0, 1.0));
      texel[3] = to_byte(covers[x]);
    }
  }
  return bytes;
}

}  // namespace crowdface::synth
