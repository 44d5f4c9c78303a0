// SPDX-License-Identifier: Apache-2.0
// What hashing costs: every file that is written or trusted passes through it.
#include <string>

#include <benchmark/benchmark.h>

#include "crowdface/core/hash.h"

#include "benchmarks/bench_size.h"

namespace crowdface {
namespace {

void BM_HashBytes(benchmark::State& state) {
  const std::string bytes(static_cast<std::size_t>(bench::size(64 << 20, 1 << 10)), 'x');
  for (auto _ : state) benchmark::DoNotOptimize(hash_bytes(bytes));
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes.size()));
}
BENCHMARK(BM_HashBytes)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace crowdface
