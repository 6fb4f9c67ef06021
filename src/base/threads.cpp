#include "base/threads.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace stickslip::detail {

void run_on_threads(unsigned wanted, std::size_t tasks, std::atomic<bool>& stopped,
                    const std::function<void(const NextTask& next)>& work, const std::function<void()>& report) {
  const std::size_t available = wanted != 0 ? wanted : std::max(1U, std::thread::hardware_concurrency());
  const std::size_t count = std::min(available, tasks);
  std::mutex mutex;  // guards the members below
  std::condition_variable changed;
  std::exception_ptr error;
  std::size_t failed = 0;  // the task that threw `error`
  std::size_t working = count;
  std::atomic<std::size_t> given = 0;

  const auto run = [&] {
    std::size_t own = 0;
    const NextTask next = [&](std::size_t& task) {
      if (stopped || (own = given++) >= tasks) return false;
      task = own;
      return true;
    };
    try {
      work(next);
    } catch (...) {
      const std::scoped_lock lock(mutex);
      given = tasks;
      if (!stopped && (!error || own < failed)) {  // once stopped, work throws only because of the stop
        failed = own;
        error = std::current_exception();
      }
    }
    const std::scoped_lock lock(mutex);
    --working;
    changed.notify_all();
  };

  std::vector<std::thread> threads;
  try {
    for (std::size_t i = 0; i < count; ++i) threads.emplace_back(run);
    for (;;) {
      std::unique_lock lock(mutex);
      const bool ended = changed.wait_for(lock, std::chrono::milliseconds(100), [&] { return working == 0; });
      if (ended && error) break;
      lock.unlock();
      report();
      if (ended) break;
    }
  } catch (...) {
    const std::scoped_lock lock(mutex);
    stopped = true;
    error = std::current_exception();
  }
  for (std::thread& thread : threads) thread.join();
  if (error) std::rethrow_exception(error);
}

}  // namespace stickslip::detail
