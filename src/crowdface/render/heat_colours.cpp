// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/heat_colours.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "crowdface/core/text.h"
#include "crowdface/render/text_label.h"

namespace crowdface {
namespace {

// The colours from low to high values. Lightness rises up to yellow and falls after yellow. So even
// in greyscale, the order of the values on each side of yellow stays visible.
constexpr std::array<std::array<float, 3>, 6> kStops = {{{0.16F, 0.22F, 0.56F},
                                                         {0.13F, 0.48F, 0.72F},
                                                         {0.35F, 0.72F, 0.66F},
                                                         {0.93F, 0.89F, 0.55F},
                                                         {0.93F, 0.53F, 0.25F},
                                                         {0.66F, 0.10F, 0.14F}}};

std::uint8_t to_byte(float value) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0F, 1.0F)));
}

}  // namespace

Eigen::Vector3f heat_colour(double scale_position) {
  const double at = std::clamp(scale_position, 0.0, 1.0) * (kStops.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
  const auto t = static_cast<float>(at - static_cast<double>(low));
  Eigen::Vector3f colour;
  for (Eigen::Index c = 0; c < 3; ++c) {
    const auto i = static_cast<std::size_t>(c);
    colour[c] = (1 - t) * kStops[low][i] + t * kStops[low + 1][i];
  }
  return colour;
}

VertexColours heat_colours(const Eigen::Ref<const Eigen::VectorXd>& mm, double max_mm) {
  VertexColours colours(mm.size(), 3);
  for (Eigen::Index i = 0; i < mm.size(); ++i) {
    colours.row(i) = heat_colour(mm[i] / max_mm).transpose();
  }
  return colours;
}

std::vector<double> scale_ticks(double most) {
  const double tenth = std::pow(10.0, std::floor(std::log10(most)));
  double step = tenth;
  for (const double factor : {0.1, 0.2, 0.25, 0.5, 1.0, 2.0}) {
    step = factor * tenth;
    if (most / step < 5 + 1e-9) break;
  }
  std::vector<double> ticks;
  // Round to a millionth, so that 3 · 0.2 gives exactly 0.6.
  for (int i = 0; i * step <= most * (1 + 1e-9); ++i) {
    ticks.push_back(std::round(i * step * 1e6) / 1e6);
  }
  return ticks;
}

Rgb8Image heat_scale(double max_mm, const std::string& title, int width_px, int height_px,
                     std::array<std::uint8_t, 3> background) {
  Rgb8Image image(width_px, height_px, background);
  const int left = width_px / 3;
  const int bar_width = width_px - left - std::max(24, width_px / 12);
  const int bar_height = std::max(6, height_px * 3 / 10);
  const int bar_top = height_px / 8;
  for (int x = 0; x < bar_width; ++x) {
    const Eigen::Vector3f colour = heat_colour((x + 0.5) / bar_width);
    for (int y = bar_top; y < bar_top + bar_height; ++y) {
      for (int c = 0; c < 3; ++c) image.at(left + x, y)[c] = to_byte(colour[c]);
    }
  }
  LabelStyle style;
  style.background_colour = background;
  style.text_px = std::max(10, height_px * 3 / 10);
  const std::vector<double> ticks = scale_ticks(max_mm);
  const int tick_width = bar_width / std::max(1, static_cast<int>(ticks.size()));
  const int tick_top = bar_top + bar_height;
  for (const double tick : ticks) {
    const bool last = tick == ticks.back();
    const std::string text = concat(format_number(tick), last ? " mm" : "");
    const int middle = left + static_cast<int>(tick / max_mm * bar_width);
    const int from = std::clamp(middle - tick_width / 2, 0, width_px - tick_width);
    image.paste(label_strip(text, tick_width, height_px - tick_top, style), from, tick_top);
  }
  style.align = TextAlign::kLeft;
  image.paste(label_strip(title, left - std::max(8, tick_width / 2), height_px, style), 0, 0);
  return image;
}

}  // namespace crowdface
