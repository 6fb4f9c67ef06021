// Run work on several threads, with progress reports.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace stickslip::detail {

/// Runs `work` on several threads at once and returns when all have ended. Meanwhile the calling thread calls `report`
/// ten times a second, and once more at the end.
///
/// An exception sets `stopped` and is rethrown when all threads have ended: the exception of `report` or of a thread
/// that fails to start, otherwise the first one of `work`. Work should check `stopped`, and end by returning or by any
/// exception.
///
/// @param wanted  number of threads; 0: as many as the machine has
/// @param tasks   maximum number of threads
void run_on_threads(unsigned wanted, std::size_t tasks, std::atomic<bool>& stopped, const std::function<void()>& work,
                    const std::function<void()>& report);

}  // namespace stickslip::detail
