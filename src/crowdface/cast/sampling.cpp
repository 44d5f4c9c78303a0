// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/sampling.h"

#include <algorithm>

namespace crowdface {

std::size_t band_count(const SamplingOptions& sampling) {
  return std::max<std::size_t>(1, sampling.bands.size());
}

bool mirrors(const SamplingOptions& sampling) {
  return sampling.asymmetry != Range{1, 1} || sampling.mirror != Mirroring::kNone;
}

const SmoothnessDistribution& smoothness_of(const SamplingOptions& sampling, std::size_t region,
                                            std::size_t band) {
  if (!sampling.bands.empty()) {
    const auto& own = sampling.bands[band].regions[region].smoothness;
    if (own) return *own;
  }
  return sampling.regions[region].smoothness;
}

const std::vector<Eigen::Index>& sources_of(const SamplingOptions& sampling, std::size_t band) {
  const bool own = band < sampling.bands.size() && sampling.bands[band].sources;
  return own ? *sampling.bands[band].sources : sampling.sources;
}

}  // namespace crowdface
