// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/plane/weights.h"
#include "crowdface/traits/trait_limits.h"

namespace crowdface {

/// A closed range from which a value is chosen at random. If both ends are equal, the value is
/// fixed.
struct Range {
  double low = 0;
  double high = 0;
  bool operator==(const Range&) const = default;
};

/// The unit of an age.
enum class AgeUnit {
  kFraction,  ///< the age is a number from −1 (young) to 1 (old), see apply_age
  kYears,     ///< the age is in years
};

/// An age; see age_as_fraction.
struct Age {
  double value = 0;
  AgeUnit unit = AgeUnit::kFraction;
  bool operator==(const Age&) const = default;
};

/// A range of ages.
struct AgeRange {
  Range range = {0, 0};
  AgeUnit unit = AgeUnit::kFraction;
  bool operator==(const AgeRange&) const = default;
};

/// The distribution of a region's random position on the weight plane: a plane on which each head
/// has a point (its anchor). The position determines the weights of the heads in the region.
struct PositionDistribution {
  /// How the position is drawn.
  enum class Kind {
    /// A source and a point in the convex hull of all sources' anchors are chosen at random. The
    /// position lies on the straight line from this source's anchor to this point. `pull` limits
    /// the distance from the anchor.
    kAnchored,
    kUniform,  ///< the position lies anywhere in the convex hull of the sources' anchors
    /// the position lies in a disc around the anchor of a head; the disc's radius is `radius`
    kAround,
    kFixed,  ///< the position is always the point `at`
  };
  Kind kind = Kind::kAnchored;
  /// Used only with kAround: the head whose anchor is the centre of the disc. If `head` is empty,
  /// the centre is the anchor of the face's target.
  std::optional<Eigen::Index> head;
  /// used only with kAround: radius of the disc, in the same unit as the coordinates of the anchors
  double radius = 0;
  PlanePoint at = PlanePoint::Zero();  ///< used only with kFixed: the position
  /// Used only with kAnchored: the position lies at most this fraction (0 … 1) of the way from the
  /// anchor to the random point in the convex hull. 0: the position is always the anchor.
  double pull = 0.25;
};

/// Distribution of the smoothing level, L.
struct SmoothnessDistribution {
  /// The unit of `range`.
  enum class Unit {
    /// values are fractions of L_max, the largest number of smoothing iterations; the slider in the
    /// paper has the same unit
    kFraction,
    kIterations,  ///< values are numbers of smoothing iterations
    /// values are wavelengths in mm. The number of smoothing iterations is chosen so that smoothing
    /// halves the amplitude of relief that has this wavelength (docs/method.md).
    kSize,
  };
  Unit unit = Unit::kFraction;
  Range range = {0.2, 0.9};  ///< values in `unit`; all values are equally likely
};

/// The distributions of one region.
struct RegionSampling {
  PositionDistribution position;
  SmoothnessDistribution smoothness;
  Range extrapolation = {1, 1};  ///< range of the extrapolation factor (e in Fig. 6 of the paper)
};

/// The parameters of one band of detail. If a member is empty, the value of the band's region or of
/// the crowd applies.
struct BandSampling {
  /// The distributions of this band in one region.
  struct Region {
    std::optional<PositionDistribution> position;
    /// Distribution of the smoothing level at which the band begins. Only the first band may have
    /// no value.
    std::optional<SmoothnessDistribution> smoothness;
    std::optional<Range> extrapolation;
  };
  std::string name;
  std::vector<Region> regions;  ///< distributions of the band, one entry for each region
  /// heads that lend detail to the band, ascending
  std::optional<std::vector<Eigen::Index>> sources;
  /// factor (0 … 1) on the effect that ageing has on the band
  double ageing = 1;
};

/// A head and its relative frequency or weight.
struct WeightedHead {
  Eigen::Index head = 0;
  double weight = 1;
  bool operator==(const WeightedHead&) const = default;
};

/// Chooses one of several things at random, with probabilities proportional to the things' weights.
///
/// \param random_number  Random number from 0 to 1 that selects the thing.
template <class Things, class Weight>
const auto& weighted_choice(const Things& things, double random_number, const Weight& weight) {
  double total = 0;
  for (const auto& thing : things) total += std::invoke(weight, thing);
  double remaining = random_number * total;
  for (const auto& thing : things) {
    if (remaining < std::invoke(weight, thing)) return thing;
    remaining -= std::invoke(weight, thing);
  }
  // reached only if rounding errors leave a remainder after the last weight
  return things.back();
}

/// Whether whole faces are mirrored.
enum class Mirroring {
  kNone,
  kRandom,  ///< half of the faces are mirrored, chosen at random
};

/// The distributions from which the values of sampled faces are drawn.
struct SamplingOptions {
  std::vector<WeightedHead> targets;  ///< possible targets, with their frequencies
  std::vector<Eigen::Index> sources;  ///< heads that lend detail, ascending
  /// distributions of the regions, one entry for each region (one entry in total if there are no
  /// regions)
  std::vector<RegionSampling> regions;
  /// parameters of the bands, from coarse to fine; empty: all detail is one band
  std::vector<BandSampling> bands;
  /// largest number of heads that may have weight in one band of one region; empty: no limit
  std::optional<int> max_sources;
  AgeRange age = {};         ///< range of the ages of sampled faces
  Range asymmetry = {1, 1};  ///< range of the asymmetry factor; see Recipe::asymmetry
  Mirroring mirror = Mirroring::kNone;
  std::vector<Eigen::Index> heads_tagged_old;    ///< heads with the tag `old`, ascending
  std::vector<Eigen::Index> heads_tagged_young;  ///< heads with the tag `young`, ascending
  TraitLimits traits = {};                       ///< limits on the measurements of the faces
};

/// Returns the number of bands of each region's detail.
inline std::size_t band_count(const SamplingOptions& sampling) {
  return std::max<std::size_t>(1, sampling.bands.size());
}
/// Returns whether any face may be mirrored or may have an asymmetry factor other than 1.
inline bool may_mirror(const SamplingOptions& sampling) {
  return sampling.asymmetry != Range{1, 1} || sampling.mirror != Mirroring::kNone;
}
/// Returns the distribution from which the smoothness of a band of a region is drawn
/// (BandRecipe::smoothness).
inline const SmoothnessDistribution& smoothness_of(const SamplingOptions& sampling,
                                                   std::size_t region, std::size_t band) {
  const bool is_set_by_band =
      !sampling.bands.empty() && sampling.bands[band].regions[region].smoothness;
  return is_set_by_band ? *sampling.bands[band].regions[region].smoothness
                        : sampling.regions[region].smoothness;
}
/// Returns the heads that lend detail to a band.
inline const std::vector<Eigen::Index>& sources_of(const SamplingOptions& sampling,
                                                   std::size_t band) {
  const bool is_set_by_band = band < sampling.bands.size() && sampling.bands[band].sources;
  return is_set_by_band ? *sampling.bands[band].sources : sampling.sources;
}

/// A group of sampled faces that have their own sampling parameters.
struct Group {
  std::string name;
  /// Number of faces. Groups with a count get their faces before groups with a share.
  std::optional<std::uint64_t> count;
  /// used if `count` is empty: fraction (0 … 1) of the faces that are in no group with a count
  double share = 0;
  SamplingOptions sampling;
  /// Maps a kind of attachments to the fraction of the group's faces that wear no item of this
  /// kind. This fraction replaces the crowd's fraction.
  std::map<std::string, double> fraction_without_item_by_kind = {};
  /// Maps the name of a hair colour to the fraction of the group's faces with this colour. Replaces
  /// the crowd's fractions.
  std::map<std::string, double> hair_colours = {};
};

/// A face that the user specifies by hand. Values that are not specified are random, as for a
/// sampled face.
struct ManualRecipe {
  /// The values of one band; empty values are random.
  struct Band {
    std::optional<PlanePoint> position;
    /// weights of the heads that lend detail; empty: the recipe gives no weights. A recipe cannot
    /// give both weights and a `position`.
    std::vector<WeightedHead> weights;
    std::optional<SmoothnessDistribution> smoothness;
    std::optional<Range> extrapolation;
  };
  /// The values of a region, which apply to all bands that have no values of their own. Exception:
  /// the region's smoothness applies only to the first band.
  struct Region : Band {
    std::vector<Band> bands;  ///< values of the bands, one entry for each band, or empty
  };
  std::string id;
  std::optional<Eigen::Index> target;
  std::vector<Region> regions;  ///< values of the regions, one entry for each region
  /// heads whose textures are blended for the face; empty: not given
  std::vector<WeightedHead> colours = {};
  std::optional<AgeRange> age;  ///< range of the face's age; empty: as for sampled faces
  std::optional<Range> asymmetry;
  std::optional<bool> mirrored;
  /// limits on the face's measurements; the values that the recipe leaves random are drawn so that
  /// the face meets these limits
  TraitLimits traits = {};
};

}  // namespace crowdface
