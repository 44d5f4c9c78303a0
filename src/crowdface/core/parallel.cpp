// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/parallel.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <vector>

namespace crowdface {

struct ThreadLimit::Control {
  explicit Control(std::size_t threads)
      : limit(tbb::global_control::max_allowed_parallelism, threads) {}
  tbb::global_control limit;  // copying one would end the limit with the copy
};

ThreadLimit::ThreadLimit(int threads) {
  if (threads <= 0) return;
  control_ = std::make_unique<Control>(static_cast<std::size_t>(threads));
}
ThreadLimit::~ThreadLimit() = default;

int thread_count() {
  return static_cast<int>(std::min<std::size_t>(
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism),
      static_cast<std::size_t>(std::max(1, tbb::info::default_concurrency()))));
}

void parallel_blocks(std::ptrdiff_t count, std::ptrdiff_t block,
                     const std::function<void(std::ptrdiff_t, std::ptrdiff_t)>& body) {
  if (count <= 0) return;
  const std::ptrdiff_t blocks = (count + block - 1) / block;
  if (blocks == 1) return body(0, count);
  // Isolated: a thread that waits for this loop must not begin another heavy item of an outer one.
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(std::ptrdiff_t{0}, blocks, [&](std::ptrdiff_t b) {
      body(b * block, std::min(count, (b + 1) * block));
    });
  });
}

void parallel_for_each(std::ptrdiff_t count, const std::function<void(std::ptrdiff_t)>& body) {
  const tbb::blocked_range<std::ptrdiff_t> items(0, std::max<std::ptrdiff_t>(count, 0), 1);
  const auto run = [&](const tbb::blocked_range<std::ptrdiff_t>& range) {
    for (std::ptrdiff_t i = range.begin(); i != range.end(); ++i) body(i);
  };
  tbb::this_task_arena::isolate(
      [&] { tbb::parallel_for(items, run, tbb::simple_partitioner()); });
}

double parallel_sum(std::ptrdiff_t count, std::ptrdiff_t block,
                    const std::function<double(std::ptrdiff_t, std::ptrdiff_t)>& term) {
  if (count <= 0) return 0;
  std::vector<double> partial(static_cast<std::size_t>((count + block - 1) / block));
  parallel_blocks(count, block, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    partial[static_cast<std::size_t>(begin / block)] = term(begin, end);
  });
  double sum = 0;
  for (const double value : partial) sum += value;
  return sum;
}

}  // namespace crowdface
