// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/visibility_filter.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "crowdface/core/instruction_set.h"

namespace crowdface {
namespace {

constexpr float kPixel = 0.01F;
constexpr std::size_t kFields = PointVisibility::kFields;

/// Pixels of a bent surface, some empty, and points that lie about as they do.
class LightSharing : public ::testing::Test {
 protected:
  LightSharing() {
    for (int y = -1; y <= kSquareSide; ++y) {
      for (int x = -1; x <= kSquareSide; ++x) {
        if (random_() % 7 == 0) continue;
        const std::size_t at = PixelVisibility::index(x, y);
        const std::array<float, kFields> pixel = draw(x, y);
        for (std::size_t f = 0; f < kFields; ++f)
          pixels_.field_values(static_cast<int>(f))[at] = pixel[f];
      }
    }
    for (auto& list : lists_) list.assign(kSquareSide + kMaxLanes, 0);
    for (int x = 0; x < kSquareSide; ++x) {
      const std::array<float, kFields> point = draw(x, kRow);
      for (std::size_t f = 0; f < kFields; ++f) lists_[f][static_cast<std::size_t>(x)] = point[f];
    }
  }
  std::array<float, kFields> draw(int x, int y) {
    const auto unit = [&] { return std::uniform_real_distribution<float>(-1, 1)(random_); };
    const auto at = [](int i) { return static_cast<float>(i) * kPixel; };
    Eigen::Vector3f normal(0.8F * unit(), 0.8F * unit(), 1);
    normal.normalize();
    const auto count = [&](int most) {
      return static_cast<float>(random_() % static_cast<unsigned>(most));
    };
    const float key = count(4), sky = count(3);
    return {at(x), at(y), 2 * kPixel * unit(), normal.x(), normal.y(), normal.z(), key, 3, sky, 2};
  }
  PointVisibility points(std::size_t first = 0) const {
    PointVisibility lights;
    for (std::size_t f = 0; f < kFields; ++f) lights.field_values[f] = lists_[f].data() + first;
    return lights;
  }
  struct Shares {
    std::vector<float> key = std::vector<float>(kSquareSide + kMaxLanes);
    std::vector<float> sky = std::vector<float>(kSquareSide + kMaxLanes);
  };
  Shares in_a_row(std::size_t count = kSquareSide) const {
    Shares shares;
    filter_visibility(points(), count, pixels_, PixelVisibility::index(0, kRow), true, kPixel,
                      shares.key.data(), shares.sky.data());
    return shares;
  }
  /// \return key and sky
  std::pair<float, float> alone(std::size_t point, int x) const {
    Shares shares;
    filter_visibility(points(point), 1, pixels_, PixelVisibility::index(x, kRow), false, kPixel,
                      shares.key.data(), shares.sky.data());
    return {shares.key[0], shares.sky[0]};
  }
  /// In plain loops.
  std::pair<double, double> plainly(std::size_t point, int x) const {
    const auto of = [&](int field) {
      return static_cast<double>(lists_[static_cast<std::size_t>(field)][point]);
    };
    double sums[4];
    for (int f = 0; f < 4; ++f) sums[f] = 0.01 * of(PointVisibility::kKeyVisible + f);
    for (int j = kRow - 1; j <= kRow + 1; ++j) {
      for (int i = x - 1; i <= x + 1; ++i) {
        const auto there = [&](int field) {
          return static_cast<double>(pixels_.field_values(field)[PixelVisibility::index(i, j)]);
        };
        double cosine = 0, height = 0;
        for (int c = 0; c < 3; ++c) {
          cosine += of(PointVisibility::kNormal + c) * there(PointVisibility::kNormal + c);
          height += of(PointVisibility::kNormal + c) *
                    (there(PointVisibility::kPoint + c) - of(PointVisibility::kPoint + c));
        }
        const double likeness = std::clamp((cosine - 0.7) / 0.25, 0.0, 1.0) *
                                std::clamp(2 - std::abs(height) / kPixel, 0.0, 1.0);
        for (int f = 0; f < 4; ++f) sums[f] += likeness * there(PointVisibility::kKeyVisible + f);
      }
    }
    return {sums[0] / sums[1], sums[2] / sums[3]};
  }

  static constexpr int kRow = 5;
  std::mt19937 random_{3};
  PixelVisibility pixels_;
  std::array<std::vector<float>, kFields> lists_;
};

TEST_F(LightSharing, IsThatOfPlainLoops) {
  const Shares row = in_a_row();
  double apart = 0;
  for (std::size_t i = 0; i < kSquareSide; ++i) {
    const auto [key, sky] = plainly(i, static_cast<int>(i));
    EXPECT_NEAR(row.key[i], key, 1e-5) << i;
    EXPECT_NEAR(row.sky[i], sky, 1e-5) << i;
    apart = std::max(apart, std::abs(static_cast<double>(row.key[i]) - row.key[0]));
  }
  EXPECT_GT(apart, 0.1) << "else nothing was compared";
}

TEST_F(LightSharing, OfPointsInARowIsThatOfEachAlone) {
  for (const std::size_t count : {std::size_t{1}, std::size_t{13}, std::size_t{kSquareSide}}) {
    const Shares row = in_a_row(count);
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(alone(i, static_cast<int>(i)), std::pair(row.key[i], row.sky[i]))
          << i << " of " << count;
    }
  }
}

TEST_F(LightSharing, IsTheSameWithAnyInstructionSet) {
  const Shares best = in_a_row();
  for (const std::string& name : instruction_sets()) {
    use_instruction_set(name);
    EXPECT_EQ(in_a_row().key, best.key) << name;
    EXPECT_EQ(in_a_row().sky, best.sky) << name;
  }
  use_instruction_set(instruction_sets().front());
}

TEST_F(LightSharing, OfWhatNobodyElseShowsIsItsOwn) {
  pixels_.clear();
  for (const int field :
       {PointVisibility::kKeyVisible, PointVisibility::kKeyTraced, PointVisibility::kSkyTraced}) {
    lists_[static_cast<std::size_t>(field)][3] = 0;
  }
  EXPECT_EQ(alone(3, 3), std::pair(0.0F, 1.0F)) << "no ray: a dark key, an open sky";
  lists_[PointVisibility::kKeyTraced][3] = 4;
  lists_[PointVisibility::kKeyVisible][3] = 3;
  EXPECT_FLOAT_EQ(alone(3, 3).first, 0.75F);
}

}  // namespace
}  // namespace crowdface
