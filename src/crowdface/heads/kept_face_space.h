// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "crowdface/cast/face_space.h"

namespace crowdface {

/// As FaceSpace's constructor; its tables are kept, so that the same heads, masks and weights make them once.
/// \param cache  the folder; empty: nothing is kept.
FaceSpace kept_face_space(const std::filesystem::path& cache, SampledHeads heads,
                          const std::vector<double>& weights, std::size_t bands);

}  // namespace crowdface
