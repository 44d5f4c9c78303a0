// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/quotas.h"

#include <algorithm>
#include <cmath>

#include "crowdface/core/contains.h"
#include "crowdface/core/random.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

constexpr double kRounding = 1e-9;  // 0.3 · 10 is 3, whatever doubles make of it

std::uint64_t floor_share(double share, std::uint64_t n) {
  return static_cast<std::uint64_t>(std::floor(share * static_cast<double>(n) + kRounding));
}

/// The face at which a quota must have got `m` faces.
std::uint64_t deadline(double share, std::uint64_t m) {
  return static_cast<std::uint64_t>(std::ceil(static_cast<double>(m) / share - kRounding));
}

/// Whether leaving place `n` to the rest would make some quota late at a later place.
bool must_serve(const std::vector<Quota>& quotas, std::uint64_t served, std::uint64_t n,
                std::uint64_t horizon) {
  for (std::uint64_t m = n; m <= n + horizon; ++m) {
    std::uint64_t due = 0;
    for (const Quota& quota : quotas) due += floor_share(quota.share, m);
    if (due > served + (m - n)) return true;
  }
  return false;
}

}  // namespace

std::vector<int> schedule_quotas(const std::vector<Quota>& quotas, std::uint64_t count) {
  std::vector<int> schedule(count, -1);
  double total = 0;
  for (const Quota& quota : quotas) total += quota.share;
  const bool all_taken = total > 1 - kRounding;
  // Later than that nothing can fall due that is not due already (docs/casting.md).
  const auto kinds = static_cast<double>(quotas.size());
  const std::uint64_t horizon =
      quotas.size() <= 1 || all_taken
          ? 0
          : static_cast<std::uint64_t>(std::min((kinds + 1) / (1 - total), 1e4)) + 1;
  std::vector<std::uint64_t> served(quotas.size(), 0);
  std::uint64_t all_served = 0;
  for (std::uint64_t n = 1; n <= count; ++n) {
    if (!all_taken && !must_serve(quotas, all_served, n, horizon)) continue;
    int next = -1;
    std::uint64_t earliest = 0;
    for (std::size_t j = 0; j < quotas.size(); ++j) {
      if (quotas[j].share <= 0) continue;
      const std::uint64_t due = deadline(quotas[j].share, served[j] + 1);
      if (next < 0 || due < earliest) {
        next = static_cast<int>(j);
        earliest = due;
      }
    }
    if (next < 0) continue;
    schedule[n - 1] = next;
    ++served[static_cast<std::size_t>(next)];
    ++all_served;
  }
  return schedule;
}

std::vector<int> scatter_quotas(const std::vector<double>& shares, std::uint64_t count,
                                std::uint64_t seed, const std::string& purpose) {
  struct Next {
    std::uint64_t served = 0, place = 0, due = 0;
  };
  const auto next_after = [&](std::size_t j, std::uint64_t served) -> Next {
    if (shares[j] <= 0) return {served, UINT64_MAX, UINT64_MAX};
    const std::uint64_t before = served == 0 ? 0 : deadline(shares[j], served);
    const std::uint64_t due = deadline(shares[j], served + 1);
    const double drawn = random_pair({seed, served, concat(purpose, '/', j)})[0];
    const auto steps = static_cast<std::uint64_t>(drawn * static_cast<double>(due - before));
    return {served, before + 1 + steps, due};
  };
  std::vector<Next> next;
  for (std::size_t j = 0; j < shares.size(); ++j) next.push_back(next_after(j, 0));
  std::vector<int> schedule(count, -1);
  for (std::uint64_t n = 1; n <= count; ++n) {
    std::size_t first = shares.size();
    for (std::size_t j = 0; j < shares.size(); ++j) {
      if (next[j].place > n) continue;
      if (first == shares.size() || next[j].due < next[first].due) first = j;
    }
    if (first == shares.size()) continue;
    schedule[n - 1] = static_cast<int>(first);
    next[first] = next_after(first, next[first].served + 1);
  }
  return schedule;
}

TargetsOfQuota targets_by_quota(const std::vector<WeightedHead>& targets,
                                const std::vector<Quota>& quotas) {
  TargetsOfQuota result(quotas.size() + 1);
  for (const WeightedHead& target : targets) {
    bool in_any = false;
    for (std::size_t q = 0; q < quotas.size(); ++q) {
      if (quotas[q].band || !contains(quotas[q].heads, target.head)) continue;
      result[q + 1].push_back(target);
      in_any = true;
    }
    if (in_any) continue;
    result[0].push_back(target);
    for (std::size_t q = 0; q < quotas.size(); ++q) {
      if (quotas[q].band) result[q + 1].push_back(target);
    }
  }
  return result;
}

std::vector<std::vector<Eigen::Index>> sources_by_quota(const SamplingOptions& sampling,
                                                        const std::vector<Quota>& quotas,
                                                        int quota) {
  std::vector<std::vector<Eigen::Index>> sources(band_count(sampling));
  for (std::size_t band = 0; band < sources.size(); ++band) {
    std::vector<Eigen::Index> claimed;
    for (const Quota& other : quotas) {
      if (other.band == band) claimed.insert(claimed.end(), other.heads.begin(), other.heads.end());
    }
    if (claimed.empty()) continue;
    const bool own = quota >= 0 && quotas[static_cast<std::size_t>(quota)].band == band;
    const auto& heads = own ? quotas[static_cast<std::size_t>(quota)].heads : claimed;
    sources[band] = sources_of(sampling, band);
    std::erase_if(sources[band], [&](Eigen::Index head) { return contains(heads, head) != own; });
  }
  return sources;
}

std::vector<int> schedule_groups(const std::vector<Group>& groups, std::uint64_t count,
                                 std::uint64_t times) {
  std::vector<int> schedule;
  std::vector<Quota> shares;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const std::uint64_t own = groups[g].count.value_or(0) * times;
    schedule.insert(schedule.end(), own, static_cast<int>(g));
    shares.push_back({groups[g].name, groups[g].count ? 0 : groups[g].share, {}});
  }
  schedule.resize(count, -1);
  const auto counted =
      static_cast<std::size_t>(std::find(schedule.begin(), schedule.end(), -1) - schedule.begin());
  const std::vector<int> rest = schedule_quotas(shares, count - counted);
  std::copy(rest.begin(), rest.end(), schedule.begin() + static_cast<std::ptrdiff_t>(counted));
  return schedule;
}

std::vector<int> schedule_kinds(const Casting& casting, std::uint64_t count, std::uint64_t times) {
  return casting.groups.empty() ? schedule_quotas(casting.diversity.quotas, count)
                                : schedule_groups(casting.groups, count, times);
}

std::vector<FaceKind> face_kinds(const Casting& casting) {
  std::vector<FaceKind> kinds;
  const std::vector<Quota>& quotas = casting.diversity.quotas;
  for (auto& targets : targets_by_quota(casting.sampling.targets, quotas)) {
    const int quota = static_cast<int>(kinds.size()) - 1;
    kinds.push_back({&casting.sampling, std::move(targets), std::nullopt,
                     sources_by_quota(casting.sampling, quotas, quota)});
  }
  for (std::size_t g = 0; g < casting.groups.size(); ++g) {
    kinds.push_back(kind_of_group(casting, g));
  }
  return kinds;
}

}  // namespace crowdface
