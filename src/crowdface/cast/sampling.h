// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/plane/weights.h"

namespace crowdface {

/// A closed range to draw from; both ends equal: a fixed value.
struct Range {
  double low = 0;
  double high = 0;
  bool operator==(const Range&) const = default;
};

/// Where on the weight plane a region's position is drawn.
struct PositionDistribution {
  enum class Kind {
    kAnchored,  ///< near the anchor of a source drawn at random, see `pull`
    kUniform,   ///< anywhere in the convex hull of the sources' anchors
    kAround,    ///< in the disc of `radius` around a head's anchor
    kFixed,     ///< always at `at`
  };
  Kind kind = Kind::kAnchored;
  std::optional<Eigen::Index> head;    ///< kAround: whose anchor; none: the face's own target's
  double radius = 0;                   ///< kAround: in units of the plane
  PlanePoint at = PlanePoint::Zero();  ///< kFixed
  /// kAnchored: how far, at most, from that anchor towards a point anywhere in the hull; 0 stays on
  /// it, 1 may go all the way.
  double pull = 0.25;
};

/// How much is smoothed away, L.
struct SmoothnessDistribution {
  enum class Unit {
    kFraction,    ///< of L_max, the paper's slider
    kIterations,  ///< whole iterations
    kSize,        ///< millimetres: the wavelength that is halved (docs/method.md)
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

/// A band of detail. What it leaves open is as for its region, or for the crowd.
struct BandSampling {
  struct Region {
    std::optional<PositionDistribution> position;
    std::optional<SmoothnessDistribution>
        smoothness;  ///< where it begins; only the first may leave it
    std::optional<Range> extrapolation;
  };
  std::string name;
  std::vector<Region> regions;                       ///< one for each region
  std::optional<std::vector<Eigen::Index>> sources;  ///< ascending
  double ageing = 1;                                 ///< how much of an age acts on it, 0 … 1
};

/// A head and how often it is drawn, relative to the others.
struct WeightedHead {
  Eigen::Index head = 0;
  double weight = 1;
};

/// One of some things, drawn in proportion to their weights. \param drawn  from 0 to 1
template <class Things, class Weight>
const auto& weighted_choice(const Things& things, double drawn, const Weight& weight) {
  double total = 0;
  for (const auto& thing : things) total += std::invoke(weight, thing);
  double left = drawn * total;
  for (const auto& thing : things) {
    if (left < std::invoke(weight, thing)) return thing;
    left -= std::invoke(weight, thing);
  }
  return things.back();  // rounding used up the last weight
}

/// Whether faces are mirrored as wholes.
enum class Mirroring {
  kNone,
  kDrawn,  ///< half of them
};

/// How sampled faces are drawn.
struct SamplingOptions {
  std::vector<WeightedHead> targets;    ///< heads that may be the target, with their frequency
  std::vector<Eigen::Index> sources;    ///< heads whose details take part, ascending
  std::vector<RegionSampling> regions;  ///< one for each region (one in all without regions)
  std::vector<BandSampling> bands;      ///< coarse to fine; none: detail is one band
  std::optional<int> max_sources;  ///< of each band of each region: the largest weights; none: all
  Range age = {0, 0};              ///< of sampled faces, see apply_age
  Range asymmetry = {1, 1};        ///< see Recipe
  Mirroring mirror = Mirroring::kNone;
  std::vector<Eigen::Index> old_heads;  ///< tagged old, ascending
  std::vector<Eigen::Index> young_heads;
};

/// How many bands a region's detail has.
inline std::size_t band_count(const SamplingOptions& sampling) {
  return std::max<std::size_t>(1, sampling.bands.size());
}
/// Whether any face may be other than blended: mirrored, or more or less asymmetric.
inline bool mirrors(const SamplingOptions& sampling) {
  return sampling.asymmetry != Range{1, 1} || sampling.mirror != Mirroring::kNone;
}
/// Where a band of a region begins.
inline const SmoothnessDistribution& smoothness_of(const SamplingOptions& sampling,
                                                   std::size_t region, std::size_t band) {
  const bool own = !sampling.bands.empty() && sampling.bands[band].regions[region].smoothness;
  return own ? *sampling.bands[band].regions[region].smoothness
             : sampling.regions[region].smoothness;
}
/// Heads that lend to a band.
inline const std::vector<Eigen::Index>& sources_of(const SamplingOptions& sampling,
                                                   std::size_t band) {
  const bool own = band < sampling.bands.size() && sampling.bands[band].sources;
  return own ? *sampling.bands[band].sources : sampling.sources;
}

/// Sampled faces that are drawn by numbers of their own.
struct Group {
  std::string name;
  std::optional<std::uint64_t> count;  ///< so many faces, before all that have a share
  double share = 0;                    ///< without a count: of the faces after those, 0 … 1
  SamplingOptions sampling;
};

/// A face spelled out by hand; what is left out is drawn as for a sampled face.
struct HandRecipe {
  struct Band {
    std::optional<PlanePoint> position;
    std::vector<WeightedHead> weights;  ///< empty: none given; not both position and weights
    std::optional<SmoothnessDistribution> smoothness;
    std::optional<Range> extrapolation;
  };
  /// Its own values hold for all bands that have none of their own, smoothness for the first.
  struct Region : Band {
    std::vector<Band> bands;  ///< one for each band, or none
  };
  std::string id;
  std::optional<Eigen::Index> target;
  std::vector<Region> regions;             ///< one for each region
  std::vector<WeightedHead> colours = {};  ///< whose textures; empty: none given
  std::optional<Range> age;                ///< none: as for sampled faces
  std::optional<Range> asymmetry;
  std::optional<bool> mirrored;
};

}  // namespace crowdface
