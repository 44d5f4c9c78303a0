// SPDX-License-Identifier: Apache-2.0
// Smoothing: one product with W by different means, and preparing a head as a whole. The counter
// `times_faster` relates preparing to the same number of sweeps of Eigen's row-major sparse product
// in double precision, timed in the same run.
#include <chrono>
#include <map>
#include <memory>
#include <numeric>

#include <Eigen/SparseCore>
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Smoother/JacobiLaplaceSmootherT.hh>
#include <benchmark/benchmark.h>

#include "crowdface/core/random.h"
#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/subdivision.h"
#include "crowdface/smooth/chebyshev_series.h"
#include "crowdface/smooth/iterate.h"
#include "crowdface/smooth/level_basis.h"
#include "head_models/synth/synthetic_head.h"

#include "benchmarks/bench_size.h"

namespace crowdface {
namespace {

constexpr std::int64_t kLarge = 1'200'000, kSmall = 5'000;

/// In which order a head's vertices stand in its file.
enum Order : std::int64_t {
  kGrid,  ///< of the synthetic layout's grids: neighbours stand together, which suits plain loops
  kSubdivided,  ///< of a subdivided mesh, as sculpting programs write: old vertices, edges, faces
  kShuffled,    ///< none: the worst that a file can do
};

/// The mesh with its vertices in an order drawn at random.
Mesh shuffled(const Mesh& mesh) {
  std::vector<std::uint32_t> place(static_cast<std::size_t>(mesh.topology.vertex_count));
  std::iota(place.begin(), place.end(), 0U);
  for (std::size_t i = place.size(); i > 1; --i) {  // Fisher and Yates
    const double drawn = random_between({1, i, "place", 0}, 0, static_cast<double>(i));
    std::swap(place[i - 1], place[std::min(i - 1, static_cast<std::size_t>(drawn))]);
  }
  Mesh result = mesh;
  for (std::uint32_t& v : result.topology.corner_vertices) v = place[v];
  for (std::size_t v = 0; v < place.size(); ++v) {
    result.positions.row(place[v]) = mesh.positions.row(static_cast<Index>(v));
  }
  return result;
}

Mesh head_of(std::int64_t vertices, std::int64_t order) {
  const int rounds = order == kSubdivided ? 3 : 0;
  const SyntheticHeads heads(std::max<Index>(vertices >> (2 * rounds), kSmall));
  Mesh mesh{heads.topology(), heads.positions(1, 1), heads.uvs()};
  for (int round = 0; round < rounds && mesh.topology.vertex_count < vertices / 2; ++round) {
    mesh = subdivide(mesh);
  }
  return order == kShuffled ? shuffled(mesh) : mesh;
}

/// A synthetic head of about this many vertices and what smoothing it needs.
struct Subject {
  explicit Subject(Mesh head)
      : mesh(std::move(head)),
        smoothing(build_adjacency(mesh.topology), Boundary::kFixed, OperatorKind::kUmbrella),
        filter(smoothing, mesh.positions) {}
  Mesh mesh;
  SmoothingOperator smoothing;
  ChebyshevFilter filter;
};

const Subject& subject(std::int64_t vertices, std::int64_t order = kGrid) {
  static std::map<std::pair<std::int64_t, std::int64_t>, std::unique_ptr<Subject>> subjects;
  auto& entry = subjects[{vertices, order}];
  if (!entry) entry = std::make_unique<Subject>(head_of(vertices, order));
  return *entry;
}

Eigen::SparseMatrix<double, Eigen::RowMajor> eigen_operator(const SmoothingOperator& smoothing) {
  std::vector<Eigen::Triplet<double>> entries;
  const Index vertices = smoothing.vertex_count();
  for (Index i = 0; i < vertices; ++i) {
    const auto ring = smoothing.neighbours(i);
    if (ring.empty()) entries.emplace_back(i, i, 1.0);
    for (const std::uint32_t n : ring) {
      entries.emplace_back(i, n, 1.0 / static_cast<double>(ring.size()));
    }
  }
  Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(vertices, vertices);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// One sweep of the plain loop that people write: x = W·x with Eigen.
void eigen_sweep(const Eigen::SparseMatrix<double, Eigen::RowMajor>& matrix, Columns& now,
                 Columns& next) {
  next.noalias() = matrix * now;
  now.swap(next);
}

/// Seconds of one Eigen sweep, the least of a few.
double eigen_sweep_seconds(const Subject& s) {
  const auto matrix = eigen_operator(s.smoothing);
  Columns now = s.mesh.positions, next(now.rows(), now.cols());
  double least = HUGE_VAL;
  for (int i = 0; i < 5; ++i) {
    const auto start = std::chrono::steady_clock::now();
    eigen_sweep(matrix, now, next);
    least = std::min(
        least, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return least;
}

/// Counts what one product takes where a turn of the benchmark makes several.
class ProductTime {
 public:
  ProductTime(benchmark::State& state, int products) : state_(state), products_(products) {}
  ~ProductTime() {
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start_;
    state_.counters["ms_per_product"] =
        1e3 * took.count() / static_cast<double>(state_.iterations()) / products_;
  }
  ProductTime(const ProductTime&) = delete;
  ProductTime& operator=(const ProductTime&) = delete;

 private:
  benchmark::State& state_;
  int products_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

void BM_SweepEigen(benchmark::State& state) {
  const Subject& s = subject(bench::size(kLarge, kSmall), state.range(0));
  const auto matrix = eigen_operator(s.smoothing);
  Columns now = s.mesh.positions, next(now.rows(), now.cols());
  for (auto _ : state) eigen_sweep(matrix, now, next);
}
BENCHMARK(BM_SweepEigen)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->ArgName("order")
    ->Arg(kGrid)
    ->Arg(kSubdivided)
    ->Arg(kShuffled);

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};

void BM_SweepOpenMesh(benchmark::State& state) {
  using Mesh = OpenMesh::PolyMesh_ArrayKernelT<DoubleTraits>;
  const Subject& s = subject(bench::size(kLarge, kSmall));
  Mesh mesh;
  std::vector<Mesh::VertexHandle> vertices;
  for (Index i = 0; i < s.mesh.positions.rows(); ++i) {
    vertices.push_back(
        mesh.add_vertex({s.mesh.positions(i, 0), s.mesh.positions(i, 1), s.mesh.positions(i, 2)}));
  }
  for (Index f = 0; f < s.mesh.topology.face_count(); ++f) {
    std::vector<Mesh::VertexHandle> face;
    for (const std::uint32_t v : s.mesh.topology.face(f)) face.push_back(vertices[v]);
    mesh.add_face(face);
  }
  mesh.request_face_normals();
  mesh.request_vertex_normals();
  OpenMesh::Smoother::JacobiLaplaceSmootherT<Mesh> smoother(mesh);
  smoother.initialize(OpenMesh::Smoother::SmootherT<Mesh>::Tangential_and_Normal,
                      OpenMesh::Smoother::SmootherT<Mesh>::C0);
  for (auto _ : state) smoother.smooth(1);
}
BENCHMARK(BM_SweepOpenMesh)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(2);

void BM_SweepPlain(benchmark::State& state) {
  const Subject& s = subject(bench::size(kLarge, kSmall));
  constexpr int kSweeps = 10;
  ProductTime time(state, kSweeps);
  for (auto _ : state) benchmark::DoNotOptimize(iterate(s.smoothing, s.mesh.positions, kSweeps));
}
BENCHMARK(BM_SweepPlain)->Unit(benchmark::kMillisecond)->UseRealTime();

/// A pass of 401 terms for `state.range(0)` levels up to the one that needs them all.
template <class T>
void BM_FilterPass(benchmark::State& state) {
  constexpr std::size_t kTerms = 401;
  const Subject& s = subject(bench::size(kLarge, kSmall));
  FilterInput<T> input{s.filter.rows_of<T>(s.mesh.positions), {}};
  ChebyshevSeries series(kTerms, 0.0);
  for (std::size_t k = 0; k < kTerms; k += 2) series[k] = 1.0 / 201;  // one parity, as powers have
  input.series.assign(static_cast<std::size_t>(state.range(0)), series);
  ProductTime time(state, kTerms - 1);
  for (auto _ : state) benchmark::DoNotOptimize(s.filter.template run<T>({&input, 1}));
  state.counters["ms_per_product"] =
      benchmark::Counter(1e-3 * (kTerms - 1), benchmark::Counter::kIsIterationInvariantRate |
                                                  benchmark::Counter::kInvert);
}
BENCHMARK(BM_FilterPass<float>)->Unit(benchmark::kMillisecond)->UseRealTime()->Arg(1)->Arg(8);
BENCHMARK(BM_FilterPass<double>)->Unit(benchmark::kMillisecond)->UseRealTime()->Arg(1)->Arg(8);

/// One level of 20,000 iterations to 10⁻⁸ of the head's size, on tiles that are there: what as many
/// sweeps give.
template <class T>
void BM_OneLevel(benchmark::State& state) {
  const Subject& s = subject(bench::size(kLarge, kSmall), state.range(0));
  const auto level = static_cast<std::uint64_t>(bench::size(20'000, 300));
  double seconds = 0;
  FilterInput<T> input{s.filter.rows_of<T>(s.mesh.positions), {}};
  input.series = {power_series(OperatorKind::kUmbrella, level, 1e-8)};
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(s.filter.template run<T>({&input, 1}));
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  state.counters["products"] = static_cast<double>(input.series.front().size() - 1);
  state.counters["times_faster"] = eigen_sweep_seconds(s) * static_cast<double>(level) / seconds;
}
BENCHMARK(BM_OneLevel<float>)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(1)
    ->ArgName("order")
    ->Arg(kGrid)
    ->Arg(kSubdivided)
    ->Arg(kShuffled);
BENCHMARK(BM_OneLevel<double>)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(1)
    ->ArgName("order")
    ->Arg(kGrid);

/// Tiles, filter and basis of one head: what `crowdface prepare` does for the first of a set.
void BM_PrepareHead(benchmark::State& state) {
  const Subject& s = subject(bench::size(state.range(0), kSmall), state.range(2));
  const auto max_level = static_cast<std::uint64_t>(bench::size(state.range(1), 300));
  constexpr double kToleranceCm = 0.005;
  Index rank = 0;
  double seconds = 0;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    const ChebyshevFilter filter(s.smoothing, s.mesh.positions);
    const LevelNodes nodes(OperatorKind::kUmbrella, max_level);
    const LevelBasis basis =
        fit_level_basis(filter, nodes, filter_nodes(filter, nodes, s.mesh.positions), kToleranceCm);
    rank = basis.rank();
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  state.counters["rank"] = static_cast<double>(rank);
  state.counters["times_faster"] =
      eigen_sweep_seconds(s) * static_cast<double>(max_level) / seconds;
}
BENCHMARK(BM_PrepareHead)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(1)
    ->ArgNames({"vertices", "L_max", "order"})
    ->Args({10'000, 166, kGrid})
    ->Args({40'000, 666, kGrid})
    ->Args({150'000, 2'500, kGrid})
    ->Args({400'000, 6'660, kGrid})
    ->Args({kLarge, 20'000, kGrid})
    ->Args({kLarge, 20'000, kSubdivided})
    ->Args({kLarge, 20'000, kShuffled})
    ->Args({kLarge, 1'000, kGrid})
    ->Args({kLarge, 5'000, kGrid})
    ->Args({kLarge, 100'000, kGrid});

}  // namespace
}  // namespace crowdface
