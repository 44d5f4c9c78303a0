// SPDX-License-Identifier: Apache-2.0
// Ageing keeps people apart.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "crowdface/core/text.h"
#include "crowdface/io/obj_writer.h"
#include "crowdface/run/generate.h"
#include "head_models/synth/identity.h"
#include "head_models/synth/synthetic_head.h"

#include "support/reference_distance.h"
#include "support/temporary_folder.h"

namespace crowdface {
namespace {

constexpr int kPeople = 10;

/// Ten people, made from the young heads among thirty synthetic heads.
class TenPeople {
 public:
  TenPeople() {
    constexpr std::uint64_t kSeed = 1, kHeads = 30;
    const SyntheticHeads synthetic(5000);
    std::filesystem::create_directories(folder_ / "heads");
    for (std::uint64_t h = 1; h <= kHeads; ++h) {
      const Mesh mesh{synthetic.topology(), synthetic.positions(kSeed, h), synthetic.uvs()};
      const std::string name = concat("head_", 10 + h);
      encode_obj(mesh, "").write(folder_ / concat("heads/", name, ".obj"));
      const synth::Person person = synth::random_person(kSeed, h);
      const char* age = person.age_years < 35 ? "young" : person.age_years < 55 ? "adult" : "old";
      tags_ += concat(h > 1 ? ", " : "", name, ": [", person.maleness > 0 ? "male" : "female", ", ",
                      age, "]");
    }
  }

  /// Returns the vertices of each person at an age, cm.
  std::vector<reference::Points> at(double age) const {
    const std::string out = concat("age_", age);
    std::string changes = "changes:\n";
    for (int p = 1; p <= kPeople; ++p) {
      changes += concat("  ", name(p), ": {age: ", age, "}\n");
    }
    generate(
        folder_.write(concat(out, ".yaml"),
                      concat("schema: 1\ncrowd: {name: ten, count: ", kPeople,
                             ", seed: 5}\nfaces: {", "directory: heads, units: cm, tags: {", tags_,
                             "}}\n", "sampling: {smoothness: [0.15, 0.7], max_sources: 3}\n",
                             "groups:\n  - {name: women, tags: [female, young]}\n",
                             "  - {name: men, tags: [male, young]}\n", "output: {directory: ", out,
                             ", contact_sheet: none}\n", age == 0 ? "" : changes)),
        {}, {folder_ / "cache", Replace::kRefuse, false});
    std::vector<reference::Points> people;
    for (int p = 1; p <= kPeople; ++p) {
      people.push_back(reference::read_obj(folder_ / out / "meshes" / (name(p) + ".obj")).vertices);
    }
    return people;
  }

  std::vector<double> areas(const std::vector<reference::Points>& people) const {
    return reference::front_areas(reference::read_obj(folder_ / "heads/head_11.obj"), people);
  }

 private:
  static std::string name(int person) { return concat("ten_00", person < 10 ? "0" : "", person); }

  testing::TemporaryFolder folder_;
  std::string tags_;
};

// The mean of all old heads stood for each of them: with age 1, the closest pair came to 0.47 of its
// distance.
TEST(AgedPeople, RemainTenPeople) {
  const TenPeople ten;
  const std::vector<reference::Points> young = ten.at(0);
  const std::vector<double> areas = ten.areas(young);
  const auto mm = [&](const reference::Points& a, const reference::Points& b) {
    return reference::distance_mm(areas, a, b, 10);
  };
  const auto closest = [&](const std::vector<reference::Points>& people) {
    double least = HUGE_VAL;
    for (std::size_t a = 0; a < people.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) least = std::min(least, mm(people[a], people[b]));
    }
    return least;
  };
  // The young heads are 26 years old on average, the old ones 66: these people are 20 years older. With
  // 24 years, one of the ten was nearer to another's younger self than to their own.
  const std::vector<reference::Points> older = ten.at(0.5), oldest = ten.at(1);
  for (std::size_t a = 0; a < older.size(); ++a) {
    const auto nearest = std::ranges::min_element(
        young, {}, [&](const reference::Points& other) { return mm(older[a], other); });
    EXPECT_EQ(nearest - young.begin(), static_cast<std::ptrdiff_t>(a));
    EXPECT_GT(mm(older[a], young[a]), 0.4) << "the person has aged";
  }
  EXPECT_GT(closest(older), 0.5 * closest(young));    // 0.65 seen
  EXPECT_GT(closest(oldest), 0.75 * closest(young));  // 0.95 seen
}

}  // namespace
}  // namespace crowdface
