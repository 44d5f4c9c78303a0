// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <memory>
#include <type_traits>

namespace crowdface {

/// While it lives, parallel loops use at most `threads` threads (0: all the machine has).
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Control;
  std::unique_ptr<Control> control_;
};

/// Threads parallel loops use at present.
int thread_count();

namespace detail {
void run_blocks(std::ptrdiff_t count, std::ptrdiff_t block,
                const std::function<void(std::ptrdiff_t, std::ptrdiff_t)>& body);
void run_items(std::ptrdiff_t count, const std::function<void(std::ptrdiff_t)>& body);
}  // namespace detail

/// Calls `body(begin, end)` for the fixed blocks [0, block), [block, 2·block), … of [0, count), in
/// any order on any thread. The blocks do not depend on the thread count, so that a body that
/// writes only its own block gives the same bits on any machine. An exception ends the loop.
template <std::integral Count, class Body>
void parallel_blocks(Count count, std::type_identity_t<Count> block, const Body& body) {
  detail::run_blocks(static_cast<std::ptrdiff_t>(count), static_cast<std::ptrdiff_t>(block),
                     [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
                       body(static_cast<Count>(begin), static_cast<Count>(end));
                     });
}

/// Calls `body(i)` for each i in [0, count), one task each: for few, heavy items.
template <std::integral Count, class Body>
void parallel_for_each(Count count, const Body& body) {
  detail::run_items(static_cast<std::ptrdiff_t>(count),
                    [&](std::ptrdiff_t i) { body(static_cast<Count>(i)); });
}
/// The same, one task for each of the blocks of `parallel_blocks`: for many, light items.
template <std::integral Count, class Body>
void parallel_for_each(Count count, std::type_identity_t<Count> block, const Body& body) {
  parallel_blocks(count, block, [&](Count begin, Count end) {
    for (Count i = begin; i < end; ++i) body(i);
  });
}

/// Work that is done beside what the caller does next, by threads that have nothing else to do, or
/// while somebody waits for it.
class BackgroundTasks {
 public:
  BackgroundTasks();
  ~BackgroundTasks();  ///< waits, and drops any exception
  BackgroundTasks(const BackgroundTasks&) = delete;
  BackgroundTasks& operator=(const BackgroundTasks&) = delete;

  void run(std::function<void()> task);
  /// Returns when all tasks are done. \throws the first exception of one; tasks that had not begun
  /// by then are left out.
  void wait();

 private:
  struct Group;
  std::unique_ptr<Group> group_;
};

/// Sum of `term(begin, end)` over the fixed blocks of [0, count), added in block order.
double parallel_sum(std::ptrdiff_t count, std::ptrdiff_t block,
                    const std::function<double(std::ptrdiff_t, std::ptrdiff_t)>& term);

/// Σ a_i b_i, each of those blocks in ascending order.
double parallel_dot(const double* a, const double* b, std::ptrdiff_t count, std::ptrdiff_t block);

}  // namespace crowdface
