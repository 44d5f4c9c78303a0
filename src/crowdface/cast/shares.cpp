// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/shares.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "crowdface/core/random.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

constexpr double kRounding = 1e-9;  // tolerance, so that 0.3 · 10 gives 3 despite rounding errors

std::uint64_t floor_share(double share, std::uint64_t n) {
  return static_cast<std::uint64_t>(std::floor(share * static_cast<double>(n) + kRounding));
}

/// Returns the deadline for the m-th face of a share: the smallest n for which the share must have
/// at least m of the first n faces.
std::uint64_t deadline(double share, std::uint64_t m) {
  return static_cast<std::uint64_t>(std::ceil(static_cast<double>(m) / share - kRounding));
}

/// Returns whether face `n` must be assigned to some share, because otherwise a share would miss a
/// deadline. The deadlines: for each m, a share with the fraction q must get at least ⌊q·m⌋ of the
/// first m faces. Suppose that face `n` is not assigned. Then only the m − n faces n + 1 to m
/// remain to meet the deadlines of the number m. So the function checks, for each m from n to n +
/// horizon, whether all shares together still need more than m − n of the first m faces.
/// \param served  number of faces before face `n` that are assigned to shares
bool must_serve(const std::vector<double>& shares, std::uint64_t served, std::uint64_t n,
                std::uint64_t horizon) {
  for (std::uint64_t m = n; m <= n + horizon; ++m) {
    std::uint64_t due = 0;
    for (const double share : shares) due += floor_share(share, m);
    if (due > served + (m - n)) return true;
  }
  return false;
}

/// Returns whether the faces after face `n` are enough for all shares. For each m from n to n +
/// horizon, a share with the fraction q must get at least ⌊q·m⌋ of the first m faces.
/// \param served  for each share: number of the faces 1 to n that are assigned to the share
bool can_serve(const std::vector<double>& shares, const std::vector<std::uint64_t>& served,
               std::uint64_t n, std::uint64_t horizon) {
  for (std::uint64_t m = n; m <= n + horizon; ++m) {
    std::uint64_t due = 0;
    for (std::size_t j = 0; j < shares.size(); ++j) {
      const std::uint64_t least = floor_share(shares[j], m);
      due += least > served[j] ? least - served[j] : 0;
    }
    if (due > m - n) return false;
  }
  return true;
}

}  // namespace

std::vector<int> schedule_shares(const std::vector<double>& shares, std::uint64_t count) {
  std::vector<int> schedule(count, -1);
  double total = 0;
  for (const double share : shares) total += share;
  const bool all_taken = total > 1 - kRounding;
  const auto share_count = static_cast<double>(shares.size());
  // must_serve looks `horizon` faces ahead. A larger horizon cannot change the result of must_serve
  // (docs/method.md).
  const std::uint64_t horizon =
      shares.size() <= 1 || all_taken
          ? 0
          : static_cast<std::uint64_t>(std::min((share_count + 1) / (1 - total), 1e4)) + 1;
  std::vector<std::uint64_t> served(shares.size(), 0);
  std::uint64_t all_served = 0;
  for (std::uint64_t n = 1; n <= count; ++n) {
    if (!all_taken && !must_serve(shares, all_served, n, horizon)) continue;
    int next = -1;
    std::uint64_t earliest = 0;
    for (std::size_t j = 0; j < shares.size(); ++j) {
      if (shares[j] <= 0) continue;
      const std::uint64_t due = deadline(shares[j], served[j] + 1);
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

std::vector<int> schedule_shares_randomly(std::vector<double> shares, std::uint64_t count,
                                          std::uint64_t seed, const std::string& purpose) {
  struct Lack {
    std::size_t share = 0;
    double faces = 0;
  };
  const std::size_t none = shares.size();
  shares.push_back(std::max(0.0, 1 - std::reduce(shares.begin(), shares.end())));
  // can_serve looks `horizon` faces ahead: far enough for two faces of the smallest share, but at
  // most 1000 faces.
  double smallest = 1;
  for (const double share : shares) {
    if (share > kRounding) smallest = std::min(smallest, share);
  }
  const auto horizon = static_cast<std::uint64_t>(std::ceil(std::min(2 / smallest, 1e3)));
  std::vector<std::uint64_t> served(shares.size(), 0);
  std::vector<int> schedule(count, -1);
  for (std::uint64_t n = 1; n <= count; ++n) {
    std::vector<Lack> possible;
    for (std::size_t j = 0; j < shares.size(); ++j) {
      const double lack = shares[j] * static_cast<double>(n) - static_cast<double>(served[j]);
      if (shares[j] <= kRounding || lack <= kRounding) continue;
      ++served[j];
      if (can_serve(shares, served, n, horizon)) possible.push_back({j, lack});
      --served[j];
    }
    if (possible.empty()) continue;
    const double drawn = random_uniform({seed, n, purpose});
    const std::size_t next = weighted_choice(possible, drawn, &Lack::faces).share;
    ++served[next];
    if (next != none) schedule[n - 1] = static_cast<int>(next);
  }
  return schedule;
}

std::vector<int> schedule_groups(const std::vector<Group>& groups, std::uint64_t count,
                                 std::uint64_t pool_size_factor) {
  std::vector<int> schedule;
  std::vector<double> shares;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const std::uint64_t own = groups[g].count.value_or(0) * pool_size_factor;
    schedule.insert(schedule.end(), own, static_cast<int>(g));
    shares.push_back(groups[g].count ? 0 : groups[g].share);
  }
  schedule.resize(count, -1);
  const auto counted =
      static_cast<std::size_t>(std::find(schedule.begin(), schedule.end(), -1) - schedule.begin());
  const std::vector<int> rest = schedule_shares(shares, count - counted);
  std::copy(rest.begin(), rest.end(), schedule.begin() + static_cast<std::ptrdiff_t>(counted));
  return schedule;
}

}  // namespace crowdface
