// Outcomes of many runs, on threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <vector>

#include "base/threads.hpp"

namespace stickslip::detail {

/// The outcomes of runs; options as RockingRunOptions.
/// @param outcome_of  `outcome_of(i, progress)`, where `progress` throws when the runs are to stop
template <class Outcome, class Options, class OutcomeOf>
std::vector<Outcome> outcomes_of(std::size_t runs, const Options& options, OutcomeOf&& outcome_of) {
  struct Stopped {};
  std::vector<Outcome> outcomes(runs);
  std::atomic<bool> stopped = false;
  std::atomic<std::size_t> done = 0;
  const std::function<void()> progress = [&] {
    if (stopped) throw Stopped{};
  };
  run_on_threads(
      options.threads, runs, stopped,
      [&](const NextTask& next) {
        for (std::size_t i; next(i); ++done) outcomes[i] = outcome_of(i, progress);
      },
      [&] {
        if (options.progress) options.progress(done, runs);
      });
  return outcomes;
}

}  // namespace stickslip::detail
