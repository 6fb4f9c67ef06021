#include "base/threads.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace stickslip::detail {

void run_on_threads(unsigned wanted, std::size_t tasks, std::atomic<bool>& stopped, const std::function<void()>& work,
                    const std::function<void()>& report) {
  const std::size_t available = wanted != 0 ? wanted : std::max(1U, std::thread::hardware_concurrency());
  const std::size_t count = std::min(available, tasks);
  std::mutex mutex;  // guards the members below
  std::condition_variable changed;
  std::exception_ptr error;
  std::size_t working = count;

  const auto run = [&] {
    try {
      work();
    } catch (...) {
      const std::scoped_lock lock(mutex);
      if (!stopped.exchange(true)) error = std::current_exception();  // the others throw only because of the stop
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
