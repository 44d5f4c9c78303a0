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
  const Matrix factors = Matrix::Random(fields, faces);
  std::vector<Matrix> out(static_cast<std::size_t>((values + kRows - 1) / kRows));
  std::vector<Matrix> blocks(out.size());
  parallel_for_each(static_cast<std::ptrdiff_t>(blocks.size()), [&](std::ptrdiff_t b) {
    blocks[static_cast<std::size_t>(b)].setConstant(kRows, fields, 0.5F);
  });
  double least = HUGE_VAL;
  for (int run = 0; run < 3; ++run) {
    const auto start = std::chrono::steady_clock::now();
    parallel_for_each(static_cast<std::ptrdiff_t>(out.size()), [&](std::ptrdiff_t b) {
      const auto i = static_cast<std::size_t>(b);
      out[i].noalias() = blocks[i] * factors;
    });
    least = std::min(
        least, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return 1e3 * least / static_cast<double>(faces);
}

}  // namespace crowdface::bench
