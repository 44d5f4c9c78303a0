// SPDX-License-Identifier: Apache-2.0
#include "bindings/long_call.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "crowdface/core/cancel.h"
#include "crowdface/core/error.h"
#include "crowdface/core/progress.h"

namespace crowdface::python {
namespace {

namespace py = pybind11;

constexpr std::chrono::milliseconds kPause{100};  ///< between two looks at signals and progress

struct Step {
  std::string stage;
  std::size_t done = 0, total = 0;
};

/// What the work tells the calling thread.
struct Report {
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<Step> news;  ///< the last step of each stage since the last look
  bool ended = false;

  void add(const std::string& stage, std::size_t done, std::size_t total) {
    const std::lock_guard lock(mutex);
    if (!news.empty() && news.back().stage == stage) {
      news.back() = {stage, done, total};
    } else {
      news.push_back({stage, done, total});
    }
  }
  void end() {
    const std::lock_guard lock(mutex);
    ended = true;
    changed.notify_all();
  }
};

void raise_signals() {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

/// Progress and cancelling belong to the whole process, so one call runs at a time.
class Turn {
 public:
  Turn() {
    if (owner_ == std::this_thread::get_id()) {
      throw UsageError("progress: expected a function that starts no long call of crowdface");
    }
    for (bool mine = false; !mine;) {
      {
        const py::gil_scoped_release release;
        mine = mutex_.try_lock_for(kPause);
      }
      if (mine) owner_ = std::this_thread::get_id();
      if (!mine) raise_signals();
    }
  }
  ~Turn() {
    owner_ = std::thread::id();
    mutex_.unlock();
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  static inline std::timed_mutex mutex_;
  static inline std::thread::id owner_;  ///< guarded by Python's lock
};

void call(const py::object& progress, const Step& step) {
  const py::object answer = progress(step.stage, step.done, step.total);
  if (answer.is(py::bool_(false))) {
    throw Interrupted("cancelled by the progress function; call again to continue");
  }
}

}  // namespace

void long_call(const py::object& progress, const std::function<void()>& work) {
  const Turn turn;
  Report report;
  if (!progress.is_none()) {
    set_progress_listener([&report](const std::string& stage, std::size_t done, std::size_t total) {
      report.add(stage, done, total);
    });
  }
  std::exception_ptr failure, stop;
  std::thread worker([&] {
    try {
      work();
    } catch (...) {
      failure = std::current_exception();
    }
    report.end();
  });
  std::optional<Step> last;
  for (bool ended = false; !ended;) {
    std::vector<Step> news;
    {
      const py::gil_scoped_release release;
      std::unique_lock lock(report.mutex);
      report.changed.wait_for(lock, kPause, [&] { return report.ended; });
      news.swap(report.news);
      ended = report.ended;
    }
    if (stop) continue;
    try {
      raise_signals();
      // A repeated call lets `progress` cancel a long step.
      if (news.empty() && last && !ended) news.push_back(*last);
      for (const Step& step : news) call(progress, step);
      if (!news.empty()) last = news.back();
    } catch (...) {
      stop = std::current_exception();
      cancel_work();
    }
  }
  {
    const py::gil_scoped_release release;
    worker.join();
  }
  set_progress_listener({});
  end_cancellation();
  if (stop) std::rethrow_exception(stop);
  if (failure) std::rethrow_exception(failure);
}

}  // namespace crowdface::python
