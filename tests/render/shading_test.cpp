// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/shading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "crowdface/core/instruction_set.h"
#include "crowdface/render/perpendicular.h"
#include "crowdface/render/skin_specular.h"

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

TEST(Srgb, BytesAreThoseOfTheCurve) {
  const auto curve = [](double light) {
    const double over = std::max(0.0, (light - 0.6) / 0.4);
    const double bent = std::min(light, 0.6) + 0.4 * over / (1 + 0.55 * over);
    const double shown = std::clamp(bent, 0.0, 1.0);
    return 255 * (shown <= 0.0031308 ? 12.92 * shown : 1.055 * std::pow(shown, 1 / 2.4) - 0.055);
  };
  std::array<int, 256> seen{};
  for (int i = 0; i < 400'000; ++i) {
    const float light = static_cast<float>(i) * 4e-6F;
    const double exact = curve(static_cast<double>(light));
    const int byte = to_srgb8({light, light, light})[0];
    EXPECT_NEAR(byte, exact, 0.5 + 1e-4) << light;
    ++seen[static_cast<std::size_t>(byte)];
  }
  EXPECT_EQ(std::ranges::count(seen, 0), 0) << "bytes that no light shows";
}

/// Points of all kinds that look in all directions.
std::vector<ShadePoint> many_points() {
  std::mt19937 random(2);
  const auto unit = [&] { return std::uniform_real_distribution<float>(0, 1)(random); };
  const auto direction = [&] {
    return Eigen::Vector3f(2 * unit() - 1, 2 * unit() - 1, unit() + 0.01F).normalized();
  };
  std::vector<ShadePoint> points;
  for (int i = 0; i < 77; ++i) {
    ShadePoint& point = points.emplace_back();
    point.normal = direction();
    point.to_viewer = direction();
    point.albedo = LinearRgb(unit(), unit(), unit());
    point.kind = static_cast<SurfaceKind>(i % 6);
    point.is_back = i % 5 == 0;
    point.sky_visibility = unit();
    point.key_visibility = unit();
    if (i % 3 == 0) point.roughness = unit();
  }
  return points;
}

TEST(Shade, IsTheSameAloneAndInCompanyWithAnyInstructionSet) {
  const std::vector<ShadePoint> points = many_points();
  std::vector<LinearRgb> alone;
  for (const ShadePoint& point : points) alone.push_back(shade(point, 0.7F));
  ShadeBatch batch;
  for (const std::string& name : instruction_sets()) {
    use_instruction_set(name);
    batch.clear();
    for (const ShadePoint& point : points) batch.add(point, 0.7F);
    batch.shade();
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_TRUE((batch.radiance(i) == alone[i]).all()) << name << ", point " << i;
    }
  }
  use_instruction_set(instruction_sets().front());
}

/// Light of the key alone, in double precision, by the formulas as they are printed.
Eigen::Array3d plain_key_light(const ShadePoint& point) {
  const Material& material = material_of(point.kind);
  const Lamp& lamp = studio().key;
  const Eigen::Vector3d n = point.normal.cast<double>(), v = point.to_viewer.cast<double>();
  const Eigen::Vector3d l = lamp.direction.cast<double>(), h = (l + v).normalized();
  const Eigen::Array3d albedo = point.albedo.cast<double>(), wrap = material.wrap.cast<double>();
  const Eigen::Array3d lit = ((n.dot(l) + wrap) / (1 + wrap)).max(0.0);
  const Eigen::Array3d diffuse =
      lit.square() / (1 + wrap).square() * (1 + wrap) * 0.5 + lit / (1 + wrap) * 0.5;
  double gloss = 0;
  if (n.dot(l) > 0) {
    const double a2 = std::pow(static_cast<double>(material.roughness), 4);
    const double n_l = n.dot(l), n_v = std::max(n.dot(v), 0.05), n_h = std::max(n.dot(h), 0.0);
    const double distribution = a2 / std::pow(n_h * n_h * (a2 - 1) + 1, 2);  // GGX, times π
    const double reflectance = static_cast<double>(material.reflectance);
    const double fresnel = reflectance + (1 - reflectance) * std::pow(1 - v.dot(h), 5);
    const auto smith = [&](double cosine) {
      return cosine + std::sqrt(a2 + (1 - a2) * cosine * cosine);
    };
    gloss = n_l * distribution * fresnel / (smith(n_l) * smith(n_v));
  }
  return lamp.colour.cast<double>() * static_cast<double>(point.key_visibility) *
         (albedo * diffuse + gloss);
}

TEST(Shade, OfTheKeyIsTheFormulaInDoublePrecision) {
  for (ShadePoint point : many_points()) {
    point.is_back = false;
    point.sky_visibility = 0;
    point.roughness = -1;
    // Dark skin and attachments reflect less; other tests check that.
    if (point.kind == SurfaceKind::kAttachment) point.kind = SurfaceKind::kTeeth;
    point.albedo = point.albedo.max(0.06F);
    const Eigen::Array3d exact = plain_key_light(point);
    const Eigen::Array3d found = shade(point).cast<double>();
    EXPECT_LT(((found - exact) / (exact + 1e-3)).abs().maxCoeff(), 2e-5);
  }
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
      const LinearRgb light = shade(point);
      EXPECT_TRUE(light.isFinite().all());
      EXPECT_GE(light.minCoeff(), 0);
      EXPECT_LT(light.maxCoeff(), 20);
    }
  }
}

TEST(Gleam, PaintedHairGleamsLessThanTheSkinAroundWhateverTheTone) {
  for (const float skin : {0.06F, 0.3F}) {
    const auto specular = [&](float share) {
      return skin_specular_factor(LinearRgb::Constant(share * skin), skin);
    };
    EXPECT_EQ(specular(1), 1);
    EXPECT_EQ(specular(1.5F), 1);
    EXPECT_LT(specular(0.3F), 0.5F);
    EXPECT_LT(specular(0.1F), 0.2F);
    EXPECT_GT(specular(0.1F), 0);
  }
  EXPECT_EQ(skin_specular_factor(LinearRgb::Constant(0.01F), 0), 1) << "no picture";
  // Half of the gloss: half way to none.
  const Eigen::Vector3f to_viewer(0, 0, 1);
  const ShadePoint point{(key_light_direction() + to_viewer).normalized(), to_viewer,
                         LinearRgb::Constant(0.3F)};
  const LinearRgb middle = (shade(point) + shade(point, 0)) / 2;
  EXPECT_LT((shade(point, 0.5F) - middle).abs().maxCoeff(), 1e-6);
  EXPECT_GT((shade(point) - shade(point, 0)).minCoeff(), 0.02F);
}

TEST(Gleam, SkinIsToldFromAPictureWithHairAndBlackAround) {
  Texture picture{61, 20, std::vector<LinearRgb>(1220, LinearRgb::Constant(0.4F))};
  std::fill_n(picture.texels.begin(), 500, LinearRgb::Constant(0.02F));
  EXPECT_FLOAT_EQ(skin_lightness(picture), 0.4F);
  EXPECT_EQ(skin_lightness(Texture{}), 0);
}

TEST(Shade, LessLightArrivingIsDarker) {
  ShadePoint point{key_light_direction(), Eigen::Vector3f::UnitZ(), albedo_of(SurfaceKind::kSkin)};
  const LinearRgb full = shade(point);
  point.key_visibility = 0;
  const LinearRgb shadowed = shade(point);
  point.sky_visibility = 0;
  const LinearRgb dark = shade(point);
  EXPECT_TRUE((shadowed < 0.6F * full).all());
  EXPECT_TRUE((dark < shadowed).all());
  EXPECT_NEAR(dark.maxCoeff(), 0, 1e-6);
  point.key_visibility = point.sky_visibility = 1;
  point.is_back = true;
  EXPECT_TRUE((shade(point) < 0.5F * full).all());
}

TEST(Background, IsLighterOnTop) {
  EXPECT_TRUE((background_colour(0) > background_colour(1)).all());
}

TEST(Perpendicular, CompletesARightHandedFrame) {
  for (const Eigen::Vector3f& axis :
       {Eigen::Vector3f(0, 0, 1), Eigen::Vector3f(0, 0, -1), Eigen::Vector3f(0.6F, 0, 0.8F),
        Eigen::Vector3f(-0.48F, 0.6F, -0.64F)}) {
    const auto [s, t] = tangent_basis(axis);
    Eigen::Matrix3f frame;
    frame << s, t, axis;
    EXPECT_TRUE((frame * frame.transpose()).isIdentity(1e-5F));
    EXPECT_NEAR(frame.determinant(), 1, 1e-5);
  }
}

}  // namespace
}  // namespace crowdface
