// SPDX-License-Identifier: Apache-2.0
// Compiled with -march=native: a baseline should not be slow for want of instructions. Nothing that
// the library compiles may come from here, so Eigen stands in a namespace of its own.
#define Eigen EigenNative
#include "benchmarks/bare_product.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include <Eigen/Core>

#include "crowdface/core/parallel.h"

namespace crowdface::bench {

double bare_product_ms(std::ptrdiff_t values, std::ptrdiff_t fields, std::ptrdiff_t faces) {
  using Matrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic>;
  constexpr std::ptrdiff_t kRows = 384;
  const Matrix block = Matrix::Random(kRows, fields), factors = Matrix::Random(fields, faces);
  std::vector<Matrix> out(static_cast<std::size_t>((values + kRows - 1) / kRows));
  double least = HUGE_VAL;
  for (int i = 0; i < 3; ++i) {
    const auto start = std::chrono::steady_clock::now();
    parallel_for_each(static_cast<std::ptrdiff_t>(out.size()), [&](std::ptrdiff_t b) {
      out[static_cast<std::size_t>(b)].noalias() = block * factors;
    });
    least = std::min(
        least, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return 1e3 * least / static_cast<double>(faces);
}

}  // namespace crowdface::bench
