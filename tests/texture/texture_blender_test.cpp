// SPDX-License-Identifier: Apache-2.0
#include "crowdface/texture/texture_blender.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/parallel.h"
#include "crowdface/core/random.h"

#include "texture/two_charts.h"

namespace crowdface {
namespace {

using testing::TwoCharts;

constexpr int kSize = 512;

/// All heads lend the same, as target and as sources.
Recipe evenly(Index heads) {
  Recipe recipe;
  RegionRecipe region;
  for (Index h = 0; h < heads; ++h) {
    region.weights.push_back({h, 1.0 / static_cast<double>(heads)});
  }
  recipe.mixture = region.weights;
  recipe.regions = {region};
  return recipe;
}

Recipe alone(Index head, std::size_t regions = 1) {
  Recipe recipe;
  recipe.target = head;
  recipe.regions.assign(regions, {});
  for (RegionRecipe& region : recipe.regions) region.weights = {{head, 1}};
  return recipe;
}

/// Independent of each other from texel to texel and head to head, or in blocks of some texels.
float noise(std::uint64_t head, int column, int row, int block = 1) {
  const auto place = static_cast<std::uint64_t>(row / block * 4096 + column / block);
  return static_cast<float>(random_uniform({.seed = head + 1, .index = place})) - 0.5F;
}

/// Green densities of a picture; bytes know them to a step.
std::vector<double> densities(const std::vector<std::uint8_t>& srgb) {
  std::vector<double> values;
  for (std::size_t i = 1; i < srgb.size(); i += 3) values.push_back(density_by_srgb8()[srgb[i]]);
  return values;
}

/// How strongly values differ from the mean of those around them, in the inside of the first chart.
double contrast(const std::vector<double>& values, int around) {
  double squares = 0, count = 0;
  for (int y = 100; y < 400; ++y) {
    for (int x = 60; x < 200; ++x) {
      const auto at = [&](int i, int j) { return values[static_cast<std::size_t>(j * kSize + i)]; };
      double mean = 0, near = 0;
      for (int j = -around; j <= around; ++j) {
        for (int i = -around; i <= around; ++i) mean += at(x + i, y + j);
      }
      for (int j = -around / 4; j <= around / 4; ++j) {
        for (int i = -around / 4; i <= around / 4; ++i) near += at(x + i, y + j);
      }
      const double side = 2.0 * around + 1, inner = 2.0 * (around / 4) + 1;
      const double band = near / (inner * inner) - mean / (side * side);
      squares += band * band;
      count += 1;
    }
  }
  return std::sqrt(squares / count);
}

double contrast_of_heads(const TwoCharts& sheet, int around) {
  double sum = 0;
  for (const auto& map : sheet.textures.maps[0]) sum += contrast(densities(srgb8_of(*map)), around);
  return sum / static_cast<double>(sheet.textures.maps[0].size());
}

TEST(TextureBlender, AHeadAloneKeepsItsColoursToTheByte) {
  TwoCharts sheet(kSize);
  for (std::uint64_t h = 0; h < 3; ++h) {
    sheet.add_head([h](double x, double y, int column, int row) -> Eigen::Array3f {
      const auto slope = static_cast<float>(0.3 + 0.3 * x - 0.2 * y);
      return Eigen::Array3f(slope, 0.8F * slope, 0.5F * slope) * (1 + 0.8F * noise(h, column, row));
    });
  }
  const BlendedPicture picture = sheet.blender().blend(alone(1), 0);
  const std::vector<std::uint8_t> expected = srgb8_of(*sheet.textures.maps[0][1]);
  const SurfaceTexels texels = sheet.texels();
  for (int y = 0; y < kSize; ++y) {
    for (const SurfaceTexels::Span& span : texels.row(y)) {
      for (std::size_t i = 3 * (static_cast<std::size_t>(y) * kSize + span.begin);
           i < 3 * (static_cast<std::size_t>(y) * kSize + span.end); ++i) {
        ASSERT_EQ(picture.srgb[i], expected[i]) << y;
      }
    }
  }
}

TEST(TextureBlender, DetailThatDoesNotAgreeKeepsItsContrast) {
  for (const int block : {1, 4}) {
    TwoCharts sheet(kSize);
    for (std::uint64_t h = 0; h < 4; ++h) {
      sheet.add_head([=](double, double, int column, int row) -> Eigen::Array3f {
        return Eigen::Array3f::Constant(0.35F * (1 + 0.5F * noise(h, column, row, block)));
      });
    }
    const auto blended = densities(sheet.blender().blend(evenly(4), 0).srgb);
    std::vector<double> plain(blended.size(), 0.0);
    for (const auto& map : sheet.textures.maps[0]) {
      for (std::size_t i = 0; i < plain.size(); ++i) {
        plain[i] += map->planes[plain.size() + i] / 4.0;
      }
    }
    for (const int around : {2, 4, 8}) {
      const double of_heads = contrast_of_heads(sheet, around);
      EXPECT_LT(contrast(plain, around), 0.6 * of_heads) << "what a plain mean leaves";
      EXPECT_GT(contrast(blended, around), 0.9 * of_heads) << block << ' ' << around;
      EXPECT_LT(contrast(blended, around), 1.1 * of_heads) << block << ' ' << around;
    }
  }
}

// Where all heads have the same detail, as brows at the same place, more contrast would be too
// much.
TEST(TextureBlender, DetailThatAgreesIsNotMadeStronger) {
  TwoCharts sheet(kSize);
  for (std::uint64_t h = 0; h < 4; ++h) {
    sheet.add_head([h](double, double, int column, int row) -> Eigen::Array3f {
      const auto tone = static_cast<float>(0.2 + 0.1 * static_cast<double>(h));
      return Eigen::Array3f::Constant(tone * (1 + 0.5F * noise(9, column, row, 3)));
    });
  }
  const auto blended = densities(sheet.blender().blend(evenly(4), 0).srgb);
  EXPECT_NEAR(contrast(blended, 4) / contrast_of_heads(sheet, 4), 1, 0.05);
}

/// The first channel of words, as their numbers.
std::vector<double> first_numbers(const BlendedPicture& picture) {
  std::vector<double> values;
  for (std::size_t i = 0; i < picture.values_16_bit.size();
       i += static_cast<std::size_t>(picture.channels)) {
    values.push_back(picture.low + double{picture.step} * picture.values_16_bit[i]);
  }
  return values;
}

TEST(TextureBlender, NormalsKeepTheirReliefAndUnitLength) {
  TwoCharts sheet(kSize);
  for (std::uint64_t h = 0; h < 4; ++h) {
    sheet.add_head(
        [=](double, double, int column, int row) -> Eigen::Array3f {
          return {0.1F * noise(h, column, row, 4), 0.1F * noise(h + 4, column, row, 4), 0};
        },
        MapCoding::slope_coding());
  }
  const TextureBlender blender = sheet.blender();
  const BlendedPicture one = blender.blend(alone(2), 0), mixed = blender.blend(evenly(4), 0);
  ASSERT_EQ(mixed.channels, 3);
  const TextureMap& own = *sheet.textures.maps[0][2];
  const SurfaceTexels texels = sheet.texels();
  for (int y = 0; y < kSize; ++y) {
    for (const SurfaceTexels::Span& span : texels.row(y)) {
      for (int x = span.begin; x < span.end; ++x) {
        const std::size_t at =
            3 * (static_cast<std::size_t>(y) * kSize + static_cast<std::size_t>(x));
        const Eigen::Vector3d expected =
            Eigen::Vector3d(own.decode(own.row(0, y)[x]), own.decode(own.row(1, y)[x]), 1)
                .normalized();
        Eigen::Vector3d blended;
        for (std::size_t c = 0; c < 3; ++c) {
          ASSERT_NEAR(one.values_16_bit[at + c] / 65535.0 * 2 - 1, expected[static_cast<Index>(c)],
                      1e-4);
          blended[static_cast<Index>(c)] = mixed.values_16_bit[at + c] / 65535.0 * 2 - 1;
        }
        ASSERT_NEAR(blended.norm(), 1, 1e-4);
      }
    }
  }
  for (const int around : {4, 8}) {
    EXPECT_NEAR(contrast(first_numbers(mixed), around) / contrast(first_numbers(one), around), 1,
                0.1);
  }
}

// Heads' maps of floats each have a range of their own.
TEST(TextureBlender, HeightsOfDifferentRangesAreBlendedAsNumbers) {
  TwoCharts sheet(kSize);
  for (int h = 0; h < 2; ++h) {
    sheet.add_head(
        [h](double x, double, int, int) -> Eigen::Array3f {
          return Eigen::Array3f::Constant(static_cast<float>(h * 40 + 2 * x));
        },
        MapCoding::value_coding(1, h == 0 ? -1.0F : 39.0F, h == 0 ? 3.0F : 44.0F));
  }
  const BlendedPicture mixed = sheet.blender().blend(evenly(2), 0);
  ASSERT_EQ(mixed.channels, 1);
  const std::vector<double> values = first_numbers(mixed);
  const SurfaceTexels texels = sheet.texels();
  for (int y = 40; y < kSize - 40; y += 7) {
    for (const SurfaceTexels::Span& span : texels.row(y)) {
      const int x = span.begin;
      const double place = TwoCharts::from_uv((x + 0.5) / kSize, 1 - (y + 0.5) / kSize).first;
      ASSERT_NEAR(values[static_cast<std::size_t>(y) * kSize + static_cast<std::size_t>(x)],
                  20 + 2 * place, 0.05);
    }
  }
}

Eigen::Array3d lab(const Eigen::Array3d& srgb8) {
  const auto light = [](double value) {
    value /= 255;
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  };
  const double r = light(srgb8[0]), g = light(srgb8[1]), b = light(srgb8[2]);
  const auto f = [](double t) {
    return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116;
  };
  const double x = f((0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505);
  const double y = f(0.2126 * r + 0.7152 * g + 0.0722 * b);
  const double z = f((0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Eigen::Array3d colour_at_uv(const BlendedPicture& picture, const Eigen::RowVector2d& uv) {
  const double x = uv[0] * picture.width - 0.5, y = (1 - uv[1]) * picture.height - 0.5;
  const int left = static_cast<int>(x), top = static_cast<int>(y);
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const double weight = (i == 0 ? left + 1 - x : x - left) * (j == 0 ? top + 1 - y : y - top);
      const auto at = 3 * static_cast<std::size_t>((top + j) * picture.width + left + i);
      for (std::size_t c = 0; c < 3; ++c)
        sum[static_cast<Index>(c)] += weight * picture.srgb[at + c];
    }
  }
  return sum;
}

// Colours that meet at a seam in the heads still meet when they are blended, though both charts
// know of the other's neighbourhood nothing.
TEST(TextureBlender, NoSeamShows) {
  TwoCharts sheet(2 * kSize, 2);
  for (int h = 0; h < 4; ++h) {
    sheet.add_head([h](double x, double y, int, int) -> Eigen::Array3f {
      const double steep = 0.5 + 0.4 * std::tanh((x - 0.5 + 0.03 * h) * 12);
      const double fine = 0.12 * std::sin(40 * x + h) * std::sin((33 + 5 * h) * y + 2 * h);
      return Eigen::Array3d(0.25 + 0.3 * steep + fine, 0.2 + 0.2 * steep * y + fine, 0.2 + fine)
          .cast<float>();
    });
  }
  Recipe recipe = alone(0, 2);
  recipe.regions[0].weights = {{0, 0.5}, {1, 0.25}, {2, 0.25}};
  recipe.regions[1].weights = {{1, 0.2}, {2, 0.2}, {3, 0.6}};
  const BlendedPicture picture = sheet.blender().blend(recipe, 0);
  double squares = 0, most = 0;
  for (int i = 20; i < 380; ++i) {
    const double y = i / 400.0;
    const Eigen::Array3d left = lab(colour_at_uv(picture, TwoCharts::to_uv(0, 0.5, y)));
    const Eigen::Array3d right = lab(colour_at_uv(picture, TwoCharts::to_uv(1, 0.5, y)));
    const double difference = std::sqrt((left - right).square().sum());
    squares += difference * difference / 360;
    most = std::max(most, difference);
  }
  EXPECT_LT(std::sqrt(squares), 1);
  EXPECT_LT(most, 2);
}

TEST(TextureBlender, TheSameBytesOnAnyNumberOfThreads) {
  TwoCharts sheet(128);
  for (std::uint64_t h = 0; h < 3; ++h) {
    sheet.add_head([h](double x, double, int column, int row) -> Eigen::Array3f {
      return Eigen::Array3f::Constant(static_cast<float>(0.2 + 0.5 * x) +
                                      0.2F * noise(h, column, row));
    });
  }
  const auto bytes = [&](int threads) {
    const ThreadLimit limit(threads);
    return sheet.blender().blend(evenly(3), 0).srgb;
  };
  EXPECT_EQ(bytes(1), bytes(3));
}

TEST(TextureBlender, OtherHeadsHaveTheWeightOfOneWithoutATexture) {
  TwoCharts sheet(128);
  sheet.add_head([](double x, double, int, int) -> Eigen::Array3f {
    return Eigen::Array3d(0.5, 0.2 + 0.5 * x, 0.1).cast<float>();
  });
  sheet.add_bare_head();
  const TextureBlender blender = sheet.blender();
  const auto expected = blender.blend(alone(0), 0).srgb;
  EXPECT_EQ(blender.blend(evenly(2), 0).srgb, expected);
  EXPECT_EQ(blender.blend(alone(1), 0).srgb, expected) << "nobody else takes part";
}

TEST(TextureBlender, PartsHaveTheColoursOfTheirTarget) {
  TwoCharts sheet(128);
  sheet.of_target.assign(static_cast<std::size_t>(sheet.faces.topology.vertex_count), true);
  for (const float tone : {0.1F, 0.7F}) {
    sheet.add_head([tone](double, double, int, int) -> Eigen::Array3f {
      return Eigen::Array3f::Constant(tone);
    });
  }
  Recipe recipe = evenly(2);
  recipe.mixture = {};
  recipe.target = 1;
  const auto blended = sheet.blender().blend(recipe, 0).srgb;
  EXPECT_EQ(blended[3 * (64 * 128 + 30)], srgb8_of(*sheet.textures.maps[0][1])[0]);
}

TEST(TextureBlender, AFaceMayHaveColoursOfItsOwn) {
  TwoCharts sheet(kSize);
  for (std::uint64_t h = 0; h < 3; ++h) {
    sheet.add_head([h](double x, double, int column, int row) -> Eigen::Array3f {
      return Eigen::Array3f(0.4F, 0.3F, static_cast<float>(0.2 + 0.1 * x)) *
             (1 + 0.8F * noise(h, column, row));
    });
  }
  const TextureBlender blender = sheet.blender();
  Recipe recipe = alone(0);
  recipe.colours = {{2, 1}};
  EXPECT_EQ(blender.blend(recipe, 0).srgb, blender.blend(alone(2), 0).srgb);
  recipe.colours = {{1, 0.25}, {2, 0.75}};
  for (const auto& region : colour_weights(recipe, 3)) {
    EXPECT_THAT(region, ::testing::ElementsAre(0, 0.25, 0.75));
  }
}

TEST(ColourWeights, TheTargetHasWhatSourcesLeave) {
  Recipe recipe = alone(0);
  recipe.regions[0].weights = {{1, 0.3}, {2, 0.2}};
  const auto weights = colour_weights(recipe, 3);
  ASSERT_EQ(weights.size(), 1U);
  EXPECT_DOUBLE_EQ(weights[0][0], 0.5);
  EXPECT_DOUBLE_EQ(weights[0][1], 0.3);
  EXPECT_DOUBLE_EQ(weights[0][2], 0.2);
}

}  // namespace
}  // namespace crowdface
