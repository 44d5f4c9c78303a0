// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/parallel.h"

#include <algorithm>
#include <atomic>
#include <deque>
#include <exception>
#include <utility>
#include <vector>

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include "crowdface/core/fixed_order.h"
#include "crowdface/core/interrupt.h"

#if defined(__SANITIZE_THREAD__)  // GCC
#define CROWDFACE_THREAD_SANITIZER
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)  // clang
#define CROWDFACE_THREAD_SANITIZER
#endif
#endif
#ifdef CROWDFACE_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace crowdface {
namespace {

/// Tells ThreadSanitizer that one thread passes data to another thread in a synchronised way.
/// Debian builds TBB and Embree without ThreadSanitizer, so ThreadSanitizer does not see their
/// synchronisation. Does nothing in other builds.
class HandOver {
 public:
#ifdef CROWDFACE_THREAD_SANITIZER
  void give() {
    __tsan_release(&at_);
  }
  void take() {
    __tsan_acquire(&at_);
  }

 private:
  char at_ = 0;
#else
  void give() {}
  void take() {}
#endif
};

/// Runs the items of a loop. ThreadSanitizer sees that all items run after the code that precedes
/// the loop and before the code that follows the loop. ThreadSanitizer sees no order between the
/// items, so it reports races between items. The first exception is kept until the loop ends, and
/// items that have not started by then are skipped. TBB must not see exceptions: TBB would cancel
/// the loops that run inside other items, including Embree's loops, and the cancelled loops would
/// return incomplete results without an error.
class LoopItems {
 public:
  ~LoopItems() { after_.take(); }

  /// Call this before the loop, or before each task if tasks are added one by one.
  void begin() { before_.give(); }

  template <class Body>
  void run(const Body& body) {
    before_.take();
    if (!failed_) {
      try {
        body();
      } catch (...) {
        if (!failed_.exchange(true)) error_ = std::current_exception();
      }
    }
    after_.give();
  }

  /// Call this after the loop. \throws the first exception of an item.
  void end() {
    after_.take();
    if (error_) std::rethrow_exception(error_);
  }

 private:
  HandOver before_, after_;
  std::atomic<bool> failed_ = false;
  std::exception_ptr error_;
};

}  // namespace

struct ThreadLimit::Control {
  explicit Control(std::size_t threads)
      : limit(tbb::global_control::max_allowed_parallelism, threads) {}
  tbb::global_control limit;  // not copied: destroying a copy would end the limit
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

void detail::run_blocks(std::ptrdiff_t count, std::ptrdiff_t block,
                        const std::function<void(std::ptrdiff_t, std::ptrdiff_t)>& body) {
  if (count <= 0) return;
  const std::ptrdiff_t blocks = (count + block - 1) / block;
  if (blocks == 1) return body(0, count);
  LoopItems items;
  items.begin();
  // Run the loop in isolation, so that a thread that waits for this loop does not start another
  // heavy item of an outer loop.
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(std::ptrdiff_t{0}, blocks, [&](std::ptrdiff_t b) {
      items.run([&] {
        throw_if_interrupted();
        body(b * block, std::min(count, (b + 1) * block));
      });
    });
  });
  items.end();
}

void detail::run_items(std::ptrdiff_t count, const std::function<void(std::ptrdiff_t)>& body) {
  const tbb::blocked_range<std::ptrdiff_t> all(0, std::max<std::ptrdiff_t>(count, 0), 1);
  LoopItems items;
  items.begin();
  const auto run = [&](const tbb::blocked_range<std::ptrdiff_t>& range) {
    for (std::ptrdiff_t i = range.begin(); i != range.end(); ++i) {
      items.run([&] {
        throw_if_interrupted();
        body(i);
      });
    }
  };
  tbb::this_task_arena::isolate([&] { tbb::parallel_for(all, run, tbb::simple_partitioner()); });
  items.end();
}

struct BackgroundTasks::Group {
  // The closures that wait to run. The closures are in this list and not in TBB's tasks, so that
  // ThreadSanitizer sees how threads receive them.
  std::deque<std::function<void()>> pending;
  tbb::task_group tasks;
  LoopItems items;
};

BackgroundTasks::BackgroundTasks() : group_(std::make_unique<Group>()) {}

BackgroundTasks::~BackgroundTasks() {
  group_->tasks.wait();
}

void BackgroundTasks::run(std::function<void()> task) {
  const auto* pending = &group_->pending.emplace_back(std::move(task));
  group_->items.begin();
  group_->tasks.run([group = group_.get(), pending] { group->items.run(*pending); });
}

void BackgroundTasks::wait() {
  group_->tasks.wait();
  const std::unique_ptr<Group> done = std::exchange(group_, std::make_unique<Group>());
  done->items.end();
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

double parallel_dot(const double* a, const double* b, std::ptrdiff_t count, std::ptrdiff_t block) {
  return parallel_sum(count, block, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    const auto size = static_cast<std::size_t>(end - begin);
    return fixed_order_dot({a + begin, size}, {b + begin, size});
  });
}

}  // namespace crowdface
