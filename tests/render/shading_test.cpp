// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/shading.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "crowdface/render/gleam.h"
#include "crowdface/render/perpendicular.h"

namespace crowdface {
namespace {

TEST(Srgb, EveryDisplayedColourComesBackBelowTheShoulder) {
  // Linear 0.6 and less is encoded as it is: sRGB 0 to 203.
  for (int value = 0; value <= 203; ++value) {
    const auto grey = static_cast<float>(value) / 255;
    EXPECT_EQ(to_srgb8(from_srgb({grey, grey, grey}))[1], value);
  }
}

TEST(Srgb, ShoulderRisesAndNeverBurnsOut) {
  int last = 0;
  for (float light = 0; light < 3; light += 0.05F) {
    const int value = to_srgb8({light, light, light})[0];
    EXPECT_GE(value, last);
    last = value;
  }
  EXPECT_EQ(to_srgb8({-1, 0, 100}), (std::array<std::uint8_t, 3>{0, 0, 255}));
}

TEST(Shade, IsFiniteAndNotNegativeInEveryDirection) {
  for (int i = 0; i < 400; ++i) {
    const float z = 1 - 2 * (static_cast<float>(i) + 0.5F) / 400;
    const float around = 2.399963F * static_cast<float>(i);
    const float across = std::sqrt(1 - z * z);
    ShadePoint point{{across * std::cos(around), across * std::sin(around), z},
                     Eigen::Vector3f::UnitZ(),
                     albedo_of(SurfaceKind::kSkin)};
    for (const SurfaceKind kind : {SurfaceKind::kSkin, SurfaceKind::kEye, SurfaceKind::kIris}) {
      point.kind = kind;
      const Light light = shade(point);
      EXPECT_TRUE(light.isFinite().all());
      EXPECT_GE(light.minCoeff(), 0);
      EXPECT_LT(light.maxCoeff(), 20);
    }
  }
}

TEST(Gleam, PaintedHairGleamsLessThanTheSkinAroundWhateverTheTone) {
  for (const float skin : {0.06F, 0.3F}) {
    const auto gleam = [&](float share) { return skin_gleam(Light::Constant(share * skin), skin); };
    EXPECT_EQ(gleam(1), 1);
    EXPECT_EQ(gleam(1.5F), 1);
    EXPECT_LT(gleam(0.3F), 0.5F);
    EXPECT_LT(gleam(0.1F), 0.2F);
    EXPECT_GT(gleam(0.1F), 0);
  }
  EXPECT_EQ(skin_gleam(Light::Constant(0.01F), 0), 1) << "no picture";
  // Half of the gloss: half way to none.
  const Eigen::Vector3f to_eye(0, 0, 1);
  const ShadePoint point{(key_direction() + to_eye).normalized(), to_eye, Light::Constant(0.3F)};
  const Light middle = (shade(point) + shade(point, 0)) / 2;
  EXPECT_LT((shade(point, 0.5F) - middle).abs().maxCoeff(), 1e-6);
  EXPECT_GT((shade(point) - shade(point, 0)).minCoeff(), 0.02F);
}

TEST(Gleam, SkinIsToldFromAPictureWithHairAndBlackAround) {
  Texture picture{61, 20, std::vector<Light>(1220, Light::Constant(0.4F))};
  std::fill_n(picture.texels.begin(), 500, Light::Constant(0.02F));
  EXPECT_FLOAT_EQ(skin_lightness(picture), 0.4F);
  EXPECT_EQ(skin_lightness(Texture{}), 0);
}

TEST(Shade, LessLightArrivingIsDarker) {
  ShadePoint point{key_direction(), Eigen::Vector3f::UnitZ(), albedo_of(SurfaceKind::kSkin)};
  const Light full = shade(point);
  point.key = 0;
  const Light shadowed = shade(point);
  point.sky = 0;
  const Light dark = shade(point);
  EXPECT_TRUE((shadowed < 0.6F * full).all());
  EXPECT_TRUE((dark < shadowed).all());
  EXPECT_NEAR(dark.maxCoeff(), 0, 1e-6);
  point.key = point.sky = 1;
  point.inside = true;
  EXPECT_TRUE((shade(point) < 0.5F * full).all());
}

TEST(Background, IsLighterOnTop) {
  EXPECT_TRUE((background(0) > background(1)).all());
}

TEST(Perpendicular, CompletesARightHandedFrame) {
  for (const Eigen::Vector3f& axis :
       {Eigen::Vector3f(0, 0, 1), Eigen::Vector3f(0, 0, -1), Eigen::Vector3f(0.6F, 0, 0.8F),
        Eigen::Vector3f(-0.48F, 0.6F, -0.64F)}) {
    const auto [s, t] = perpendicular(axis);
    Eigen::Matrix3f frame;
    frame << s, t, axis;
    EXPECT_TRUE((frame * frame.transpose()).isIdentity(1e-5F));
    EXPECT_NEAR(frame.determinant(), 1, 1e-5);
  }
}

}  // namespace
}  // namespace crowdface
