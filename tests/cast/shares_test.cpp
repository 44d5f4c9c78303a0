// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/shares.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace crowdface {
namespace {

/// Checks how many of the first n faces each share gets, for all n.
/// \param limits  maps the exact number, share · n, to the lowest and the highest allowed.
template <class Limits>
void expect_between(const std::vector<int>& schedule, const std::vector<double>& shares,
                    const Limits& limits) {
  std::vector<double> got(shares.size(), 0);
  for (std::size_t n = 1; n <= schedule.size(); ++n) {
    if (schedule[n - 1] >= 0) ++got[static_cast<std::size_t>(schedule[n - 1])];
    for (std::size_t j = 0; j < shares.size(); ++j) {
      const auto [low, high] = limits(shares[j] * static_cast<double>(n));
      EXPECT_GE(got[j], low) << j << " of " << n;
      EXPECT_LE(got[j], high) << j << " of " << n;
    }
  }
}

TEST(Shares, OneIsMetExactlyAtEveryCount) {
  for (const double share : {0.0, 0.01, 0.1, 0.25, 0.3, 1. / 3, 0.5, 0.7, 0.9, 1.0}) {
    const auto schedule = schedule_shares({share}, 1000);
    double got = 0;
    for (std::size_t n = 1; n <= schedule.size(); ++n) {
      got += schedule[n - 1] == 0 ? 1 : 0;
      EXPECT_EQ(got, std::floor(share * static_cast<double>(n) + 1e-9)) << share << " of " << n;
    }
  }
}

TEST(Shares, SeveralAreNeverLateAndHardlyEarly) {
  for (const std::vector<double>& shares : {std::vector<double>{0.3, 0.3, 0.4},
                                            {0.5, 0.5},
                                            {0.25, 0.25, 0.2},
                                            {0.1, 0.6, 0.29},
                                            {1. / 3, 1. / 3, 1. / 3},
                                            {0.05, 0.05, 0.05, 0.05, 0.7}}) {
    const auto schedule = schedule_shares(shares, 600);
    const auto kinds = static_cast<double>(shares.size());
    expect_between(schedule, shares, [&](double due) {
      return std::pair(std::floor(due + 1e-9), std::ceil(due + kinds - 1));
    });
  }
}

// Shares that sum to 1 were scattered late: of forty faces, one in five had seven.
TEST(Shares, AreScatteredExactly) {
  for (const std::vector<double>& shares : {std::vector<double>{0.3, 0.3, 0.4},
                                            {0.2},
                                            {0.2, 0.4, 0.4},
                                            {0.25, 0.25, 0.2},
                                            {1. / 3, 1. / 3, 1. / 3},
                                            {0.05, 0.05, 0.05, 0.05, 0.7},
                                            {0.0, 1.0}}) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const auto schedule = schedule_shares_randomly(shares, 300, seed, "test");
      expect_between(schedule, shares, [](double due) {
        return std::pair(std::floor(due + 1e-9), std::ceil(due - 1e-9));
      });
      const auto few = schedule_shares_randomly(shares, 77, seed, "test");
      EXPECT_TRUE(std::equal(few.begin(), few.end(), schedule.begin()));
    }
  }
  const auto fifth = schedule_shares_randomly({0.2}, 300, 1, "test");
  int periodic = 0;
  for (std::size_t n = 5; n < 300; ++n) periodic += fifth[n] == 0 && fifth[n - 5] == 0 ? 1 : 0;
  EXPECT_LT(periodic, 30) << "of sixty: no row of a sheet is all red";
}

TEST(Shares, GrowingTheCrowdMovesNobody) {
  const std::vector<double> shares = {0.3, 0.21, 0.4};
  const auto many = schedule_shares(shares, 500);
  for (const std::uint64_t count : {0U, 1U, 17U, 250U}) {
    const auto few = schedule_shares(shares, count);
    EXPECT_TRUE(std::equal(few.begin(), few.end(), many.begin())) << count;
  }
}

Group group(std::optional<std::uint64_t> count, double share) {
  return {"g", count, share, {}};
}

TEST(Groups, CountsComeFirstAndSharesAreOfTheRest) {
  const std::vector<Group> groups = {group({}, 0.5), group(3, 0), group({}, 0.25)};
  const std::vector<int> schedule = schedule_groups(groups, 43);
  ASSERT_EQ(schedule.size(), 43U);
  const auto of = [&](int g) { return std::count(schedule.begin(), schedule.end(), g); };
  EXPECT_EQ(std::count(schedule.begin(), schedule.begin() + 3, 1), 3);
  EXPECT_EQ(of(1), 3);
  EXPECT_EQ(of(0), 20);
  EXPECT_EQ(of(2), 10);
  EXPECT_EQ(of(-1), 10);
  const std::vector<int> pool = schedule_groups(groups, 86, 2);
  EXPECT_EQ(std::count(pool.begin(), pool.end(), 1), 6) << "a pool of two crowds";
}

TEST(Groups, GrowingTheCrowdMovesNobody) {
  const std::vector<Group> groups = {group(4, 0), group({}, 0.3), group({}, 0.7)};
  const auto many = schedule_groups(groups, 300);
  for (const std::uint64_t count : {0U, 2U, 4U, 50U}) {
    const auto few = schedule_groups(groups, count);
    ASSERT_EQ(few.size(), count);
    EXPECT_TRUE(std::equal(few.begin(), few.end(), many.begin())) << count;
  }
}

}  // namespace
}  // namespace crowdface
