// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/steer_trait.h"

#include <algorithm>
#include <cmath>

#include "crowdface/core/parallel.h"

namespace crowdface {
namespace {

/// One value (weight or derivative) for each head that may contribute to a band.
using PerHead = std::vector<double>;

PerHead weights_of(const BandRecipe& band, const std::vector<Index>& heads) {
  PerHead row(heads.size(), 0);
  for (const SourceWeight& source : band.weights) {
    const auto at = std::ranges::lower_bound(heads, source.head);
    if (at != heads.end() && *at == source.head)
      row[static_cast<std::size_t>(at - heads.begin())] = source.weight;
  }
  return row;
}

void set_weights(BandRecipe& band, const std::vector<Index>& heads, const PerHead& row) {
  constexpr double kMinWeight = 1e-4;
  std::vector<SourceWeight> weights;
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (row[i] > kMinWeight) weights.push_back({heads[i], row[i]});
  }
  band.weights = normalized_weights(std::move(weights));
  band.position.reset();
}

/// Projects a vector onto the simplex: returns the nearest weights that are not negative and sum to
/// one (Held, Wolfe and Crowder 1974).
PerHead projected_onto_simplex(PerHead row) {
  PerHead sorted = row;
  std::ranges::sort(sorted, std::greater<>());
  double sum = 0, shift = 0;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    sum += sorted[i];
    const double next = (sum - 1) / static_cast<double>(i + 1);
    if (sorted[i] - next > 0) shift = next;
  }
  for (double& value : row) value = std::max(value - shift, 0.0);
  return row;
}

PerHead moved(const PerHead& weights, const PerHead& gradient, double step) {
  PerHead row = weights;
  for (std::size_t i = 0; i < row.size(); ++i) row[i] += step * gradient[i];
  return projected_onto_simplex(std::move(row));
}

/// Returns one derivative of the measurement for each head of a band: how fast the measurement
/// changes when the weights of the band move linearly until this head has all the weight.
PerHead gradient_of(const Recipe& recipe, const SteeredBand& band, double value,
                    const std::function<double(const Recipe&)>& measure) {
  constexpr double kStep = 0.05;
  const PerHead weights = weights_of(band_of(recipe.regions[band.region], band.band), band.heads);
  PerHead gradient(band.heads.size());
  parallel_for_each(gradient.size(), [&](std::size_t i) {
    PerHead nearer = weights;
    for (double& weight : nearer) weight *= 1 - kStep;
    nearer[i] += kStep;
    Recipe other = recipe;
    set_weights(band_of(other.regions[band.region], band.band), band.heads, nearer);
    gradient[i] = (measure(other) - value) / kStep;
  });
  return gradient;
}

double range_of(const PerHead& gradient) {
  const auto [low, high] = std::ranges::minmax(gradient);
  return high - low;
}

}  // namespace

Recipe steer_trait(Recipe recipe, const std::vector<SteeredBand>& bands, double wanted,
                   const std::function<double(const Recipe&)>& measure) {
  constexpr int kMaxSteps = 8, kHalvings = 60;
  constexpr double kTolerance = 0.005;   // in the unit of the measurement
  constexpr double kMinInfluence = 0.1;  // a band takes part if its range is this part of `widest`
  constexpr double kMaxChange = 1e3;     // of a weight in one step, before the projection
  double value = measure(recipe);
  std::vector<bool> takes_part;
  for (int step = 0; step < kMaxSteps && std::abs(wanted - value) > kTolerance; ++step) {
    std::vector<PerHead> weights, gradients;
    double widest = 0;  // largest range of a band's gradient
    for (const SteeredBand& band : bands) {
      weights.push_back(weights_of(band_of(recipe.regions[band.region], band.band), band.heads));
      gradients.push_back(gradient_of(recipe, band, value, measure));
      widest = std::max(widest, range_of(gradients.back()));
    }
    if (!(widest > 0)) break;
    if (takes_part.empty()) {
      for (const PerHead& gradient : gradients)
        takes_part.push_back(range_of(gradient) > kMinInfluence * widest);
    }
    const auto gain = [&](double length) {
      double sum = 0;
      for (std::size_t b = 0; b < bands.size(); ++b) {
        if (!takes_part[b]) continue;
        const PerHead row = moved(weights[b], gradients[b], length);
        for (std::size_t i = 0; i < row.size(); ++i) {
          sum += gradients[b][i] * (row[i] - weights[b][i]);
        }
      }
      return sum;
    };
    // The predicted change of the measurement grows with the step length. Use bisection to find the
    // step length with which the measurement reaches the wanted value.
    const double missing = wanted - value;
    double low = 0, high = std::copysign(kMaxChange / widest, missing);
    for (int i = 0; i < kHalvings && std::abs(gain(high)) > std::abs(missing); ++i) {
      const double middle = (low + high) / 2;
      (std::abs(gain(middle)) < std::abs(missing) ? low : high) = middle;
    }
    Recipe next = recipe;
    for (std::size_t b = 0; b < bands.size(); ++b) {
      if (!takes_part[b]) continue;
      set_weights(band_of(next.regions[bands[b].region], bands[b].band), bands[b].heads,
                  moved(weights[b], gradients[b], high));
    }
    const double reached = measure(next);
    if (!(std::abs(wanted - reached) < std::abs(wanted - value))) break;
    recipe = std::move(next);
    value = reached;
  }
  return recipe;
}

}  // namespace crowdface
