// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <memory>
#include <type_traits>

namespace crowdface {

/// While the object lives, parallel loops use at most `threads` threads (0: no limit).
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Control;
  /// TBB's limit on the number of threads; null if there is no limit
  std::unique_ptr<Control> control_;
};

/// Number of threads that parallel loops currently use.
int thread_count();

namespace detail {
/// The parts of parallel_blocks and parallel_for_each that parallel.cpp implements.
void run_blocks(std::ptrdiff_t count, std::ptrdiff_t block,
                const std::function<void(std::ptrdiff_t, std::ptrdiff_t)>& body);
void run_items(std::ptrdiff_t count, const std::function<void(std::ptrdiff_t)>& body);
}  // namespace detail

/// Calls `body(begin, end)` for the blocks [0, block), [block, 2·block), … of [0, count), in any
/// order and on any thread. The blocks do not depend on the thread count, so a body that writes
/// only its own block gives the same bits on every machine. After an exception, blocks that have
/// not started are skipped and the first exception is rethrown.
template <std::integral Count, class Body>
void parallel_blocks(Count count, std::type_identity_t<Count> block, const Body& body) {
  detail::run_blocks(static_cast<std::ptrdiff_t>(count), static_cast<std::ptrdiff_t>(block),
                     [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
                       body(static_cast<Count>(begin), static_cast<Count>(end));
                     });
}

/// Calls `body(i)` for each i in [0, count), with one task per i. Use it for a few items that take
/// long.
template <std::integral Count, class Body>
void parallel_for_each(Count count, const Body& body) {
  detail::run_items(static_cast<std::ptrdiff_t>(count),
                    [&](std::ptrdiff_t i) { body(static_cast<Count>(i)); });
}
/// Calls `body(i)` for each i, with one task per block of `parallel_blocks`. Use it for many items
/// that are quick.
template <std::integral Count, class Body>
void parallel_for_each(Count count, std::type_identity_t<Count> block, const Body& body) {
  parallel_blocks(count, block, [&](Count begin, Count end) {
    for (Count i = begin; i < end; ++i) body(i);
  });
}

/// Tasks that run in parallel to the caller. Idle threads run these tasks; the thread that calls
/// `wait` also runs tasks while it waits.
class BackgroundTasks {
 public:
  BackgroundTasks();
  ~BackgroundTasks();  ///< waits for all tasks; ignores their exceptions
  BackgroundTasks(const BackgroundTasks&) = delete;
  BackgroundTasks& operator=(const BackgroundTasks&) = delete;

  /// Adds a task; any thread may start it at once.
  void run(std::function<void()> task);
  /// Returns when all tasks are done. \throws the first exception of a task; tasks that had not
  /// started by then are skipped.
  void wait();

 private:
  struct Group;
  std::unique_ptr<Group> group_;  ///< TBB's task group and the tasks that have not started
};

/// Sum of `term(begin, end)` over the blocks of [0, count), in block order. The result does not
/// depend on the thread count.
double parallel_sum(std::ptrdiff_t count, std::ptrdiff_t block,
                    const std::function<double(std::ptrdiff_t, std::ptrdiff_t)>& term);

/// Σ a_i b_i: each block is summed in ascending order, then the blocks are added in block order.
double parallel_dot(const double* a, const double* b, std::ptrdiff_t count, std::ptrdiff_t block);

}  // namespace crowdface
