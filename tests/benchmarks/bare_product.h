// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace crowdface::bench {

/// Milliseconds a face that a bare product with Eigen takes, in single precision, of `values` rows by
/// `fields` with `fields` by `faces`: by blocks of rows that fit the cache and lie together in memory, on
/// the library's threads, compiled for the best instruction set this processor has. The least of some
/// runs.
double bare_product_ms(std::ptrdiff_t values, std::ptrdiff_t fields, std::ptrdiff_t faces);

}  // namespace crowdface::bench
