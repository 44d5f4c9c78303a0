// SPDX-License-Identifier: Apache-2.0
// How the heads' measures are spread, against what has been measured on people.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "head_models/synth/identity.h"
#include "head_models/synth/mean_head.h"
#include "head_models/synth/measures.h"
#include "head_models/synth/sculpture.h"

namespace crowdface::synth {
namespace {

using Eigen::Vector3d;

constexpr std::uint64_t kPeopleSeed = 77, kPeople = 600;

Vector3d mirrored(Vector3d point) {
  point.x() = -point.x();
  return point;
}

/// A distance between two landmarks of the average head.
struct Distance {
  std::string name;
  Vector3d from, to;
};

struct Spread {
  double mean = 0, deviation = 0;
};

/// Millimetres, by sex: women, men.
std::array<Spread, 2> spread_of(const Distance& distance) {
  std::array<std::vector<double>, 2> lengths;
  for (std::uint64_t i = 0; i < kPeople; ++i) {
    const Identity identity(kPeopleSeed, i);
    const Vector3d between = identity.deform(distance.from) - identity.deform(distance.to);
    lengths[identity.person().maleness > 0 ? 1 : 0].push_back(10 * between.norm());
  }
  std::array<Spread, 2> out;
  for (std::size_t sex = 0; sex < 2; ++sex) {
    for (const double x : lengths[sex]) out[sex].mean += x;
    out[sex].mean /= static_cast<double>(lengths[sex].size());
    for (const double x : lengths[sex]) {
      out[sex].deviation += (x - out[sex].mean) * (x - out[sex].mean);
    }
    out[sex].deviation = std::sqrt(out[sex].deviation / static_cast<double>(lengths[sex].size()));
  }
  return out;
}

struct Landmarks {
  Vector3d euryon = project_onto_skin({0, 4, -1}, {8, 4, -1});
  Vector3d frontotemporale = project_onto_skin({0, 2.6, 6.5}, {6, 2.6, 6.5});
  Vector3d zygion = project_onto_skin({0, -2, 3}, {8, -2, 3});
  Vector3d gonion = project_onto_skin({0, -7.6, 1.4}, {6, -7.6, 1.4});
  Vector3d glabella = project_onto_skin({0, 1.9, 0}, {0, 1.9, 10});
  Vector3d opisthocranion = project_onto_skin({0, 2, 0}, {0, 2, -10});
  Vector3d nasion = project_onto_skin({0, 0.6, 6}, {0, 0.6, 10});
  Vector3d gnathion = project_onto_skin({0, -9, 7.4}, {0, -13, 7.4});
  Vector3d subnasale = project_onto_skin({0, -3.5, 8}, {0, -4.8, 9.9});
  Vector3d alare = project_onto_skin({0, -3.9, 10}, {2, -3.9, 10});
  Vector3d endocanthion = mean_skin({SkinPatch::kEye, 1, 0.5, 1}).position;
  Vector3d exocanthion = mean_skin({SkinPatch::kEye, 1, 2.5, 1}).position;
  Vector3d cheilion = mean_skin({SkinPatch::kMouth, 1, 2.5, 1}).position;
};

// Effect sizes (Cohen's d) of adults: Kesterke et al. 2016, "Using the 3D Facial Norms Database to
// investigate craniofacial sexual dimorphism …", Biology of Sex Differences 7:23, table 3.
TEST(Proportions, MenAndWomenDifferAsMeasured) {
  const Landmarks at;
  const auto across = [](const Vector3d& point) { return std::pair(point, mirrored(point)); };
  const std::vector<std::tuple<std::string, std::pair<Vector3d, Vector3d>, double>> published = {
      {"maximum cranial width", across(at.euryon), 1.20},
      {"minimum frontal width", across(at.frontotemporale), 0.80},
      {"maximum facial width", across(at.zygion), 1.34},
      {"mandibular width", across(at.gonion), 1.21},
      {"maximum cranial length", {at.glabella, at.opisthocranion}, 1.84},
      {"morphological facial height", {at.nasion, at.gnathion}, 1.58},
      {"lower facial height", {at.subnasale, at.gnathion}, 1.17},
      {"intercanthal width", across(at.endocanthion), 0.61},
      {"outercanthal width", across(at.exocanthion), 0.94},
      {"palpebral fissure length", {at.endocanthion, at.exocanthion}, 0.46}};
  for (const auto& [name, points, d] : published) {
    const auto [women, men] = spread_of({name, points.first, points.second});
    const double pooled =
        std::sqrt((women.deviation * women.deviation + men.deviation * men.deviation) / 2);
    EXPECT_NEAR((men.mean - women.mean) / pooled, d, 0.35) << name;
  }
}

TEST(Proportions, FacesHaveHumanSizes) {
  // Millimetres; wide enough for the means of published samples of several origins.
  const Landmarks at;
  struct Range {
    Distance distance;
    double least, most;
  };
  for (const auto& [distance, least, most] : std::vector<Range>{
           {{"bizygomatic width", at.zygion, mirrored(at.zygion)}, 128, 146},
           {{"bigonial width", at.gonion, mirrored(at.gonion)}, 96, 122},
           {{"nasal height", at.nasion, at.subnasale}, 46, 59},
           {{"nasal width", at.alare, mirrored(at.alare)}, 31, 43},
           {{"intercanthal width", at.endocanthion, mirrored(at.endocanthion)}, 29, 34},
           {{"mouth width", at.cheilion, mirrored(at.cheilion)}, 45, 56}}) {
    for (const Spread& spread : spread_of(distance)) {
      EXPECT_GT(spread.mean, least) << distance.name;
      EXPECT_LT(spread.mean, most) << distance.name;
      EXPECT_GT(spread.deviation, 0.03 * spread.mean) << distance.name;
      EXPECT_LT(spread.deviation, 0.13 * spread.mean) << distance.name;
    }
  }
}

// The measure mouth_height moved the middle of the mouth more than the corners: sad mouths.
TEST(Proportions, CornersOfTheMouthLieNearTheHeightOfItsMiddle) {
  const Vector3d corner = Landmarks().cheilion;
  const Vector3d middle = (mean_skin({SkinPatch::kMouth, 1, 1.5, 1}).position +
                           mean_skin({SkinPatch::kMouth, 1, 3.5, 1}).position) /
                          2;
  std::vector<double> degrees;
  for (std::uint64_t i = 0; i < kPeople; ++i) {
    const Identity identity(kPeopleSeed, i);
    const Vector3d left = identity.deform(corner), right = identity.deform(mirrored(corner));
    const double rise = (left.y() + right.y()) / 2 - identity.deform(middle).y();
    degrees.push_back(std::atan2(2 * rise, left.x() - right.x()) * 180 / std::numbers::pi);
  }
  const auto share_below = [&](double limit) {
    return static_cast<double>(
               std::ranges::count_if(degrees, [=](double d) { return d < limit; })) /
           static_cast<double>(kPeople);
  };
  EXPECT_LT(share_below(-5), 0.02);
  EXPECT_LT(share_below(-3), 0.2);
  EXPECT_GT(share_below(5), 0.98) << "no smiles";
}

TEST(Proportions, ColumellaIsNotThin) {
  // When columellas were 3 mm wide, blended columellas intersected themselves.
  const double b = row_distance(4) + 0.6, a = column_distance(1);
  const Spread width = spread_of({"columella", mean_skin({SkinPatch::kStrip, 1, -a, b}).position,
                                  mean_skin({SkinPatch::kStrip, 1, a, b}).position})[0];
  EXPECT_GT(width.mean, 3.8);
}

TEST(Measures, AreManyAndEachIsDrawnForItself) {
  std::set<std::string> names;
  for (const Measure& measure : measures()) {
    EXPECT_TRUE(names.insert(std::string(measure.name)).second) << measure.name;
    EXPECT_GT(measure.spread, 0) << measure.name;
  }
  EXPECT_GE(names.size(), 20U);
}

TEST(Person, SexesAndAgesAreAllThere) {
  int men = 0, old = 0, young = 0;
  for (std::uint64_t i = 0; i < kPeople; ++i) {
    const Person person = random_person(kPeopleSeed, i);
    men += person.maleness > 0 ? 1 : 0;
    old += person.age_years >= 55 ? 1 : 0;
    young += person.age_years < 35 ? 1 : 0;
  }
  EXPECT_NEAR(men, kPeople / 2.0, 60);
  EXPECT_GT(old, 150);
  EXPECT_GT(young, 120);
}

}  // namespace
}  // namespace crowdface::synth
