// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/cast/face_space.h"
#include "crowdface/heads/cache_folder.h"

namespace crowdface {

/// Makes a FaceSpace. Reads the tables of the FaceSpace from the cache if the cache has them.
/// \param heads, weights, bands  see the constructor of FaceSpace
FaceSpace cached_face_space(const CacheFolder& cache, HeadsAtSamples heads,
                            const std::vector<double>& weights, std::size_t bands);

}  // namespace crowdface
