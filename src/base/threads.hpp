// Run work on several threads, with progress reports.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace stickslip::detail {

/// `next(task)` gives a thread its next task, in rising order over all threads; false: no more are to be done.
using NextTask = std::function<bool(std::size_t& task)>;

/// Runs `work(next)` on several threads at once and returns when all have ended. Meanwhile the calling thread calls
/// `report` ten times a second, and once more at the end.
///
/// When a task fails, no more are given; those before it are done to their end. The exception of the first task that
/// fails is rethrown, so that it does not depend on the machine. The exception of `report`, or of a thread that fails to
/// start, sets `stopped` and is rethrown instead. Work should check `stopped`, and end by returning or by any exception.
///
/// @param wanted  number of threads; 0: as many as the machine has
/// @param tasks   number of tasks, and maximum number of threads
void run_on_threads(unsigned wanted, std::size_t tasks, std::atomic<bool>& stopped,
                    const std::function<void(const NextTask& next)>& work, const std::function<void()>& report);

}  // namespace stickslip::detail
