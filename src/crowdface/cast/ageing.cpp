// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/ageing.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "crowdface/cast/substitute_heads.h"
#include "crowdface/core/contains.h"
#include "crowdface/core/require.h"
#include "crowdface/core/rounded.h"

namespace crowdface {
namespace {

/// Returns the fraction of a band's weights that apply_age moves to old or young heads, for a face
/// of this age (−1 … 1).
double aged_fraction(double age, const SamplingOptions& sampling, std::size_t band) {
  return std::abs(age) * (sampling.bands.empty() ? 1 : sampling.bands[band].ageing);
}

bool same_sex(const std::vector<std::string>& one, const std::vector<std::string>& other) {
  return contains(one, "female") == contains(other, "female") &&
         contains(one, "male") == contains(other, "male");
}

/// The heads of one age class (old or young). A face that is aged gets the detail of these heads.
class AgedHeads {
 public:
  AgedHeads(double age, const CastingOptions& casting, const SamplingOptions& sampling)
      : heads_(heads_of_class(age, sampling)), casting_(casting) {
    require(!heads_.empty(), "an age of ", age, " without heads of that age");
  }

  /// Returns the heads with the tag `old` if `age` is above 0, otherwise the heads with the tag
  /// `young`.
  static const std::vector<Index>& heads_of_class(double age, const SamplingOptions& sampling) {
    return age > 0 ? sampling.heads_tagged_old : sampling.heads_tagged_young;
  }
  bool has(Index head) const { return std::ranges::binary_search(heads_, head); }
  /// Returns, of all heads of the age class, the head nearest to `head`. (The mean of several old
  /// heads would have no wrinkles.)
  Index nearest_to(Index head) const {
    return *std::ranges::min_element(heads_, {}, [&](Index other) { return rank(head, other); });
  }
  /// Moves a fraction of each head's weight to the nearest head in the age class. Heads in the age
  /// class keep their weight.
  std::vector<SourceWeight> with_moved(const std::vector<SourceWeight>& weights,
                                       double fraction) const {
    std::map<Index, double> sums;
    for (const SourceWeight& source : weights) {
      const double moved = has(source.head) ? 0 : fraction * source.weight;
      sums[source.head] += source.weight - moved;
      if (moved != 0) sums[nearest_to(source.head)] += moved;
    }
    std::vector<SourceWeight> result;
    for (const auto& [head, weight] : sums) {
      if (weight > 0) result.push_back({head, weight});
    }
    return result;
  }

 private:
  std::tuple<bool, std::ptrdiff_t, double> rank(Index head, Index other) const {
    const auto a = static_cast<std::size_t>(head), b = static_cast<std::size_t>(other);
    const double apart = (casting_.anchors[a] - casting_.anchors[b]).norm();
    if (casting_.tags.empty()) return {false, 0, apart};
    const auto &own = casting_.tags[a], &tags = casting_.tags[b];
    return {!same_sex(own, tags), -static_cast<std::ptrdiff_t>(common_tag_count(own, tags)), apart};
  }

  const std::vector<Index>& heads_;
  const CastingOptions& casting_;
};

/// Returns the weighted mean of the ages of the heads that lend the finest detail, over all
/// regions.
///
/// \param weights_of  returns the weights of a band.
template <class WeightsOf>
double mean_age_years(const FacePlan& face, const std::vector<double>& head_ages_years,
                      const WeightsOf& weights_of) {
  double sum = 0, weight = 0;
  for (const RegionRecipe& region : face.recipe.regions) {
    for (const SourceWeight& source : weights_of(band_of(region, band_count(region) - 1))) {
      sum += source.weight * head_ages_years[static_cast<std::size_t>(source.head)];
      weight += source.weight;
    }
  }
  return sum / weight;
}

}  // namespace

double age_as_fraction(const Age& age, const FacePlan& face, const CastingOptions& casting) {
  if (age.unit == AgeUnit::kFraction) return age.value;
  const std::vector<double>& ages_years = casting.head_ages_years;
  require(!ages_years.empty(), "an age of ", age.value, " years without ages of the heads");
  const double own =
      mean_age_years(face, ages_years, [](const BandRecipe& band) { return band.weights; });
  const double sign = age.value > own ? 1 : -1;
  const SamplingOptions& sampling = sampling_of(casting, face.group);
  if (AgedHeads::heads_of_class(sign, sampling).empty()) return 0;
  const AgedHeads aged(sign, casting, sampling);
  const double share = aged_fraction(sign, sampling, band_count(sampling) - 1);
  const double most = mean_age_years(face, ages_years, [&](const BandRecipe& band) {
    return aged.with_moved(band.weights, share);
  });
  // apply_age moves a fraction of the weights to old or young heads. The mean age changes linearly
  // with this fraction: from `own` at 0 to `most` at 1.
  const double change = sign * (most - own);
  if (change <= 0) return 0;
  return sign * rounded(std::min(1.0, sign * (age.value - own) / change));
}

void apply_age(FacePlan& face, const Age& wanted, const CastingOptions& casting) {
  face.age_years.reset();
  if (wanted.unit == AgeUnit::kYears) face.age_years = rounded(wanted.value);
  const double age = age_as_fraction(wanted, face, casting);
  if (age == 0) return;
  const SamplingOptions& sampling = sampling_of(casting, face.group);
  const AgedHeads aged(age, casting, sampling);
  for (RegionRecipe& region : face.recipe.regions) {
    for (std::size_t b = 0; b < band_count(region); ++b) {
      const double share = aged_fraction(age, sampling, b);
      if (share == 0) continue;
      BandRecipe& band = band_of(region, b);
      band.weights = aged.with_moved(band.weights, share);
      band.position.reset();
    }
  }
  face.age = age;
}

void undo_age(FacePlan& face, const CastingOptions& casting) {
  constexpr double kRounding = 1e-9;
  if (face.age.value_or(0) == 0) return;
  const SamplingOptions& sampling = sampling_of(casting, face.group);
  const AgedHeads aged(*face.age, casting, sampling);
  bool known = true;
  for (RegionRecipe& region : face.recipe.regions) {
    for (std::size_t b = 0; b < band_count(region); ++b) {
      const double share = aged_fraction(*face.age, sampling, b);
      known = known && share <= 1 - kRounding;
      if (share == 0 || share > 1 - kRounding) continue;
      // Undo apply_age, which multiplied the weights of the heads outside the age class by 1 −
      // share.
      std::vector<SourceWeight>& weights = band_of(region, b).weights;
      weights = aged.with_moved(weights, -share / (1 - share));
      std::erase_if(weights, [](const SourceWeight& s) { return s.weight < kRounding; });
    }
  }
  if (known) face.age.reset();
}

}  // namespace crowdface
