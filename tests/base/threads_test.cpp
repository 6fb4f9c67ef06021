// Work on several threads: the order of tasks, and the error that is reported.
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <stdexcept>
#include <thread>
#include <vector>

#include "base/threads.hpp"
#include "support/catch.hpp"

using stickslip::detail::NextTask;
using stickslip::detail::run_on_threads;

namespace {

const auto quiet = [] {};

TEST_CASE("each task is given once", "[threads]") {
  std::atomic<bool> stopped = false;
  std::vector<std::atomic<int>> times(1000);
  run_on_threads(
      3, times.size(), stopped,
      [&](const NextTask& next) {
        for (std::size_t task; next(task);) ++times[task];
      },
      quiet);
  CHECK(std::ranges::all_of(times, [](const auto& count) { return count == 1; }));
  CHECK_FALSE(stopped);
}

TEST_CASE("the error is that of the first task that fails, although a later one failed before", "[threads]") {
  std::atomic<bool> stopped = false, later_fails = false;
  std::atomic<std::size_t> begun = 0;
  const auto work = [&](const NextTask& next) {
    for (std::size_t task; next(task);) {
      ++begun;
      if (task == 1) {
        later_fails = true;
        later_fails.notify_all();
        throw std::runtime_error("task 1");
      }
      later_fails.wait(false);
      if (task == 0) throw std::runtime_error("task 0");
    }
  };
  CHECK_THROWS_WITH(run_on_threads(2, 1000, stopped, work, quiet), "task 0");
  CHECK(begun == 2);  // no more are given
}

TEST_CASE("an error of the report stops the work, whose errors are then of no interest", "[threads]") {
  std::atomic<bool> stopped = false;
  const auto work = [&](const NextTask& next) {
    for (std::size_t task; next(task);) {
      while (!stopped) std::this_thread::yield();
      throw std::runtime_error("stopped");
    }
  };
  CHECK_THROWS_WITH(run_on_threads(2, 2, stopped, work, [] { throw std::runtime_error("interrupted"); }),
                    "interrupted");
  CHECK(stopped);
}

TEST_CASE("what fails before its first task is reported, too", "[threads]") {
  std::atomic<bool> stopped = false;
  const auto work = [](const NextTask&) { throw std::runtime_error("no memory"); };
  CHECK_THROWS_WITH(run_on_threads(2, 10, stopped, work, quiet), "no memory");
}

}  // namespace
