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

/// A closed range of values to choose from at random. Equal ends give a fixed value.
struct Range {
  double low = 0;
  double high = 0;
  bool operator==(const Range&) const = default;
};

/// The distribution of a region's random position on the weight plane.
struct PositionDistribution {
  enum class Kind {
    kAnchored,  ///< near the anchor of a random source, see `pull`
    kUniform,   ///< anywhere in the convex hull of the sources' anchors
    kAround,    ///< in the disc of `radius` around a head's anchor
    kFixed,     ///< always at `at`
  };
  Kind kind = Kind::kAnchored;
  /// kAround: the head whose anchor is the centre; empty: the face's target
  std::optional<Eigen::Index> head;
  double radius = 0;                   ///< kAround: in units of the plane
  PlanePoint at = PlanePoint::Zero();  ///< kFixed
  /// kAnchored: largest step from the anchor towards a random point of the hull, as a fraction of
  /// the distance to this point. 0: stays at the anchor.
  double pull = 0.25;
};

/// Distribution of the smoothing level, L.
struct SmoothnessDistribution {
  enum class Unit {
    kFraction,    ///< fraction of L_max, as the paper's slider
    kIterations,  ///< whole iterations
    kSize,        ///< millimetres: the wavelength whose amplitude is halved (docs/method.md)
  };
  Unit unit = Unit::kFraction;
  Range range = {0.2, 0.9};
};

/// The distributions of one region.
struct RegionSampling {
  PositionDistribution position;
  SmoothnessDistribution smoothness;
  Range extrapolation = {1, 1};  ///< factor e of Fig. 6
};

/// The parameters of a band of detail. An empty member has the value of the band's region, or of
/// the crowd.
struct BandSampling {
  struct Region {
    std::optional<PositionDistribution> position;
    std::optional<SmoothnessDistribution>
        smoothness;  ///< where the band begins; may be empty for the first band only
    std::optional<Range> extrapolation;
  };
  std::string name;
  std::vector<Region> regions;                       ///< #regions
  std::optional<std::vector<Eigen::Index>> sources;  ///< ascending
  /// factor on the effect that an age has on the band, 0 … 1
  double ageing = 1;
};

/// A head and its relative frequency.
struct WeightedHead {
  Eigen::Index head = 0;
  double weight = 1;
  bool operator==(const WeightedHead&) const = default;
};

/// Chooses one of several things with probability proportional to its weight.
///
/// \param random  Random number from 0 to 1 that selects the thing.
template <class Things, class Weight>
const auto& weighted_choice(const Things& things, double random, const Weight& weight) {
  double total = 0;
  for (const auto& thing : things) total += std::invoke(weight, thing);
  double left = random * total;
  for (const auto& thing : things) {
    if (left < std::invoke(weight, thing)) return thing;
    left -= std::invoke(weight, thing);
  }
  return things.back();  // rounding errors: `random` exceeds the sum of the weights
}

/// Whether whole faces are mirrored.
enum class Mirroring {
  kNone,
  kRandom,  ///< half of the faces, at random
};

/// Distributions of the values of sampled faces.
struct SamplingOptions {
  std::vector<WeightedHead> targets;  ///< possible targets, with their frequencies
  std::vector<Eigen::Index> sources;  ///< heads that lend detail, ascending
  /// one for each region (one in all if there are no regions)
  std::vector<RegionSampling> regions;
  std::vector<BandSampling> bands;  ///< coarse to fine; empty: detail is one band
  /// largest number of heads with weight in one band of one region; empty: no limit
  std::optional<int> max_sources;
  Range age = {0, 0};        ///< ages of sampled faces, see apply_age
  Range asymmetry = {1, 1};  ///< see Recipe::asymmetry
  Mirroring mirror = Mirroring::kNone;
  std::vector<Eigen::Index> old_heads;  ///< heads tagged old, ascending
  std::vector<Eigen::Index> young_heads;
  TraitLimits traits = {};  ///< limits on measurements of the faces
};

/// Returns the number of bands of each region's detail.
inline std::size_t band_count(const SamplingOptions& sampling) {
  return std::max<std::size_t>(1, sampling.bands.size());
}
/// Returns whether any face may be mirrored or may have an asymmetry factor other than 1.
inline bool may_mirror(const SamplingOptions& sampling) {
  return sampling.asymmetry != Range{1, 1} || sampling.mirror != Mirroring::kNone;
}
/// Returns the distribution of the level at which a band of a region begins.
inline const SmoothnessDistribution& smoothness_of(const SamplingOptions& sampling,
                                                   std::size_t region, std::size_t band) {
  const bool own = !sampling.bands.empty() && sampling.bands[band].regions[region].smoothness;
  return own ? *sampling.bands[band].regions[region].smoothness
             : sampling.regions[region].smoothness;
}
/// Returns the heads that lend detail to a band.
inline const std::vector<Eigen::Index>& sources_of(const SamplingOptions& sampling,
                                                   std::size_t band) {
  const bool own = band < sampling.bands.size() && sampling.bands[band].sources;
  return own ? *sampling.bands[band].sources : sampling.sources;
}

/// A group: sampled faces with sampling parameters of their own.
struct Group {
  std::string name;
  /// number of faces; groups with a count come before all groups with a share
  std::optional<std::uint64_t> count;
  double share = 0;  ///< used if `count` is empty: fraction of the remaining faces, 0 … 1
  SamplingOptions sampling;
  std::map<std::string, double> hair_colours = {};  ///< replace the hair colours of the crowd
};

/// A hand-written face. Values that it does not specify are random, as for a sampled face.
struct ManualRecipe {
  struct Band {
    std::optional<PlanePoint> position;
    std::vector<WeightedHead> weights;  ///< empty: not given; excludes `position`
    std::optional<SmoothnessDistribution> smoothness;
    std::optional<Range> extrapolation;
  };
  /// The values of the region itself apply to all bands that have no values of their own, except
  /// that the region's smoothness applies only to the first band.
  struct Region : Band {
    std::vector<Band> bands;  ///< one for each band, or empty
  };
  std::string id;
  std::optional<Eigen::Index> target;
  std::vector<Region> regions;             ///< one for each region
  std::vector<WeightedHead> colours = {};  ///< heads that lend textures; empty: not given
  std::optional<Range> age;                ///< empty: as for sampled faces
  std::optional<Range> asymmetry;
  std::optional<bool> mirrored;
  TraitLimits traits = {};  ///< limits that the random values must meet
};

}  // namespace crowdface
