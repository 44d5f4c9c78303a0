// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstdlib>

namespace crowdface::bench {

/// The size a benchmark runs at: `full`, or `smoke` where only that it runs is of interest (the
/// test suite sets CROWDFACE_BENCH_SMOKE).
inline std::int64_t size(std::int64_t full, std::int64_t smoke) {
  return std::getenv("CROWDFACE_BENCH_SMOKE") == nullptr  // NOLINT(concurrency-mt-unsafe): at start
             ? full
             : smoke;
}

}  // namespace crowdface::bench
