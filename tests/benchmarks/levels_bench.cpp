// SPDX-License-Identifier: Apache-2.0
// How well the levels of a head are represented: the paper's cubic and the basis at several
// tolerances, against the exact filter in double precision at every vertex. Prints a table.
//
//   crowdface_levels_bench [HEAD.obj [ROUNDS]]    ROUNDS of subdivision; without a file, a synthetic head
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include "crowdface/io/obj_file.h"
#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/subdivision.h"
#include "crowdface/smooth/cubic_fit.h"
#include "crowdface/smooth/level_basis.h"
#include "crowdface/smooth/level_size.h"
#include "head_models/synth/synthetic_head.h"

#include "benchmarks/bench_size.h"
#include "support/levels.h"

namespace crowdface {
namespace {

constexpr double kMmPerCm = 10;

struct Levels {
  std::vector<std::uint64_t> numbers;
  std::vector<Positions> exact;
};

/// Both parities, dense at the start, few enough to be held at once.
Levels exact_levels(const ChebyshevFilter& filter, const Positions& positions,
                    std::uint64_t max_level) {
  Levels levels;
  for (const std::uint64_t level : levels_dense_at_start(max_level, 23)) {
    levels.numbers.push_back(level);
    if (level > 0 && level + 1 < max_level) levels.numbers.push_back(level + 1);
  }
  std::sort(levels.numbers.begin(), levels.numbers.end());
  const auto end = std::unique(levels.numbers.begin(), levels.numbers.end());
  levels.numbers.erase(end, levels.numbers.end());
  levels.exact = smooth(filter, positions, levels.numbers);
  return levels;
}

/// The largest and the root mean square distance from the exact levels.
template <class Represented>
void print_row(const char* name, const LevelFields& fields, const Levels& levels, double seconds,
               const Represented& represented) {
  double largest = 0, squares = 0, count = 0;
  std::uint64_t where = 0;
  for (std::size_t i = 0; i < levels.numbers.size(); ++i) {
    const Positions found = represented(levels.numbers[i]);
    const auto missed = (found - levels.exact[i]).rowwise().squaredNorm().eval();
    squares += missed.sum();
    count += static_cast<double>(missed.size());
    if (const double here = std::sqrt(missed.maxCoeff()); here > largest) {
      largest = here;
      where = levels.numbers[i];
    }
  }
  const auto vertices = static_cast<double>(fields.vertex_count);
  std::printf("| %-22s | %2td | %4.1f | %8.4f at %-6llu | %8.5f | %3.0f | %5.2f |\n", name,
              fields.rank, static_cast<double>(fields.quantized_values.size()) / (3 * vertices),
              kMmPerCm * largest, static_cast<unsigned long long>(where),
              kMmPerCm * std::sqrt(squares / count),
              static_cast<double>(fields.quantized_values.size_bytes()) / vertices, seconds);
}

template <class Work>
double seconds_of(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Mesh head_from(int count, char** arguments) {
  if (count < 2 || arguments[1][0] == '-') {  // options are for Google Benchmark
    const SyntheticHeads heads(static_cast<Index>(bench::size(1'200'000, 5'000)));
    return {heads.topology(), heads.positions(1, 2), heads.uvs()};
  }
  ObjFile file = read_obj(arguments[1]);
  Mesh mesh{std::move(file.topology), std::move(file.positions), std::move(file.uvs)};
  for (int round = count > 2 ? std::atoi(arguments[2]) : 0; round > 0; --round) {
    mesh = subdivide(mesh);
  }
  return mesh;
}

void print_table(const Mesh& head) {
  const SmoothingOperator smoothing(build_adjacency(head.topology), Boundary::kFixed,
                                    OperatorKind::kUmbrella);
  // The paper's 20,000 iterations at 1.2 million vertices, the same distance on other meshes.
  const std::uint64_t max_level = std::max<std::uint64_t>(
      1, static_cast<std::uint64_t>(head.topology.vertex_count) * 20'000 / 1'204'897);
  const ChebyshevFilter filter(smoothing, head.positions);
  const Levels levels = exact_levels(filter, head.positions, max_level);
  std::printf("%td vertices, L_max %llu, %zu levels compared at every vertex\n",
              head.topology.vertex_count, static_cast<unsigned long long>(max_level),
              levels.numbers.size());
  std::printf(
      "| representation | fields | at a vertex, mean | largest error, mm | rms, mm | bytes a "
      "vertex | s |\n");

  CubicFit cubic;
  const double cubic_seconds =
      seconds_of([&] { cubic = fit_cubic(filter, head.positions, max_level); });
  print_row("levels: cubic", cubic.fields, levels, cubic_seconds,
            [&](std::uint64_t level) { return testing::evaluate(cubic, head.positions, level); });
  cubic.fields = {};
  const LevelNodes nodes(OperatorKind::kUmbrella, max_level);
  NodeFields fields;
  const double filter_seconds =
      seconds_of([&] { fields = filter_nodes(filter, nodes, head.positions); });
  for (const double tolerance_mm : {0.5, 0.2, 0.1, 0.05, 0.02}) {
    LevelBasis basis;
    const std::string name = "levels: basis, " + std::to_string(tolerance_mm).substr(0, 4) + " mm";
    try {
      const double fit_seconds = seconds_of(
          [&] { basis = fit_level_basis(filter, nodes, fields, tolerance_mm / kMmPerCm); });
      print_row(name.c_str(), basis.fields, levels, filter_seconds + fit_seconds,
                [&](std::uint64_t level) {
                  return testing::evaluate(basis, nodes, head.positions, level);
                });
    } catch (const std::exception& refused) {
      std::printf("| %s | refused: %s\n", name.c_str(), refused.what());
    }
  }
}

}  // namespace
}  // namespace crowdface

int main(int count, char** arguments) {
  try {
    crowdface::print_table(crowdface::head_from(count, arguments));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
