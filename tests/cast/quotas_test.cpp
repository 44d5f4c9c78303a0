// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/quotas.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace crowdface {
namespace {

Quota quota(double share, std::vector<Eigen::Index> heads = {}) {
  return {"q", share, std::move(heads)};
}

TEST(Quotas, OneQuotaIsMetExactlyAtEveryCount) {
  for (const double share : {0.0, 0.01, 0.1, 0.25, 0.3, 1. / 3, 0.5, 0.7, 0.9, 1.0}) {
    const auto schedule = schedule_quotas({quota(share)}, 1000);
    double got = 0;
    for (std::size_t n = 1; n <= schedule.size(); ++n) {
      got += schedule[n - 1] == 0 ? 1 : 0;
      EXPECT_EQ(got, std::floor(share * static_cast<double>(n) + 1e-9)) << share << " of " << n;
    }
  }
}

TEST(Quotas, SeveralAreNeverLateAndHardlyEarly) {
  for (const std::vector<double>& shares : {std::vector<double>{0.3, 0.3, 0.4},
                                            {0.5, 0.5},
                                            {0.25, 0.25, 0.2},
                                            {0.1, 0.6, 0.29},
                                            {1. / 3, 1. / 3, 1. / 3},
                                            {0.05, 0.05, 0.05, 0.05, 0.7}}) {
    std::vector<Quota> quotas;
    for (const double share : shares) quotas.push_back(quota(share));
    const auto schedule = schedule_quotas(quotas, 600);
    std::vector<double> got(shares.size(), 0);
    for (std::size_t n = 1; n <= schedule.size(); ++n) {
      if (schedule[n - 1] >= 0) ++got[static_cast<std::size_t>(schedule[n - 1])];
      for (std::size_t j = 0; j < shares.size(); ++j) {
        const double due = shares[j] * static_cast<double>(n);
        EXPECT_GE(got[j], std::floor(due + 1e-9)) << j << " of " << n;
        EXPECT_LT(got[j], due + static_cast<double>(shares.size())) << j << " of " << n;
      }
    }
  }
}

TEST(Quotas, GrowingTheCrowdMovesNobody) {
  const std::vector<Quota> quotas = {quota(0.3), quota(0.21), quota(0.4)};
  const auto many = schedule_quotas(quotas, 500);
  for (const std::uint64_t count : {0U, 1U, 17U, 250U}) {
    const auto few = schedule_quotas(quotas, count);
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

TEST(Quotas, TargetsComeFromTheQuotasHeadsOrFromNone) {
  const std::vector<WeightedHead> targets = {{0, 1}, {1, 2}, {2, 1}, {4, 3}};
  const std::vector<Quota> quotas = {quota(0.3, {1, 3}), quota(0.3, {2})};
  const TargetsOfQuota targets_of = targets_by_quota(targets, quotas);
  const auto heads = [&](int q) {
    std::vector<Eigen::Index> list;
    for (const WeightedHead& t : targets_of[static_cast<std::size_t>(q + 1)]) {
      list.push_back(t.head);
    }
    return list;
  };
  EXPECT_EQ(heads(-1), (std::vector<Eigen::Index>{0, 4}));
  EXPECT_EQ(heads(0), (std::vector<Eigen::Index>{1}));
  EXPECT_EQ(heads(1), (std::vector<Eigen::Index>{2}));
}

TEST(Quotas, OfABandBindItsSourcesAndNoTargets) {
  SamplingOptions sampling;
  sampling.sources = {0, 1, 2, 3};
  sampling.bands.resize(2);
  sampling.bands[1].sources = {{1, 2, 3}};
  std::vector<Quota> quotas = {quota(0.3, {0}), quota(0.2, {0, 2}), quota(0.1, {3})};
  quotas[1].band = quotas[2].band = 1;
  using Sources = std::vector<std::vector<Eigen::Index>>;
  EXPECT_EQ(sources_by_quota(sampling, quotas, -1), (Sources{{}, {1}}));
  EXPECT_EQ(sources_by_quota(sampling, quotas, 0), (Sources{{}, {1}}));
  EXPECT_EQ(sources_by_quota(sampling, quotas, 1), (Sources{{}, {2}}));
  EXPECT_EQ(sources_by_quota(sampling, quotas, 2), (Sources{{}, {3}}));
  const TargetsOfQuota targets = targets_by_quota({{0, 1}, {1, 1}, {3, 1}}, quotas);
  for (const std::size_t kind : {0U, 2U, 3U}) {
    ASSERT_EQ(targets[kind].size(), 2U);
    EXPECT_EQ(targets[kind][0].head, 1);
    EXPECT_EQ(targets[kind][1].head, 3);
  }
  EXPECT_EQ(targets[1].size(), 1U);
}

}  // namespace
}  // namespace crowdface
