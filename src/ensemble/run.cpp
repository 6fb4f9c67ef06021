#include "stickslip/ensemble/run.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <stdexcept>

#include "base/threads.hpp"

namespace stickslip::detail {
namespace {

void check(const EnsembleOptions& options, std::size_t block) {
  if (options.members == 0) throw std::invalid_argument("run_ensemble: members must be at least 1, got 0");
  if (options.first_member % block != 0)
    throw std::invalid_argument("run_ensemble: first_member must be a multiple of " + std::to_string(block) +
                                ", the members in a block, got " + std::to_string(options.first_member));
  if (options.members > UINT64_MAX - options.first_member)
    throw std::invalid_argument("run_ensemble: first_member + members must be less than 2^64, got members = " +
                                std::to_string(options.members));
}

// Throws if motions are so large that their statistics could overflow.
void check_range(const Ensemble::Kept& kept, const Tally& tally, const EnsembleTimes& times, std::uint64_t first) {
  const auto refuse = [](const std::string& got) {
    throw std::overflow_error("run_ensemble: displacement [m] and velocity [m/s] must not exceed " +
                              shortest(Tally::max_motion) + ", since eighth powers are summed, got " + got);
  };
  for (std::size_t i = 0; i < kept.peak.size(); ++i)
    for (const double x : {kept.peak[i], std::abs(kept.residual[i])})
      if (!(x <= Tally::max_motion))
        refuse("a displacement of " + shortest(x) + " m in member " + std::to_string(first + i));
  for (const double peak : kept.floor_peaks)
    if (!std::isfinite(peak))
      throw std::overflow_error("run_ensemble: peaks of floors overflow in the members from " + std::to_string(first) +
                                " on");
  const auto time = tally.out_of_range();
  if (!time) return;
  const std::string members = "members " + std::to_string(first) + " to " + std::to_string(first + tally.count - 1);
  if (*time < times.count)
    refuse("more for " + members + " at " + shortest(static_cast<double>(*time) * times.dt) + " s");
  throw std::overflow_error("run_ensemble: velocity spectrum or growth rate overflows for " + members);
}

}  // namespace

Ensemble run_ensemble(EnsembleConfiguration configuration, const EnsembleTimes& times, const EnsembleOptions& options,
                      bool in_plane, const Ensemble* start, const MakeSimulator& make_simulator) {
  const std::size_t block_size = Ensemble::block(times.count);
  check(options, block_size);
  Ensemble::Parts empty;
  empty.configuration = std::move(configuration);
  empty.times = times;
  empty.velocity_spectrum = options.velocity_spectrum;
  empty.ground_acceleration = options.ground_acceleration;
  empty.in_plane = in_plane;
  Ensemble ensemble(std::move(empty));
  if (start) ensemble.merge(*start);

  const std::uint64_t first_block = options.first_member / block_size;
  const std::uint64_t blocks = (options.members + block_size - 1) / block_size;
  const auto members_of = [&](std::uint64_t block) {
    const std::uint64_t before = (block - first_block) * block_size;
    return static_cast<std::size_t>(std::min<std::uint64_t>(block_size, options.members - before));
  };
  for (const auto& [block, members] : ensemble.parts().cut)
    if (block >= first_block && block - first_block < blocks && members_of(block) != members)
      throw std::invalid_argument("run_ensemble: start holds only " + std::to_string(members) + " members from " +
                                  std::to_string(block * block_size) + " on, part of a block of " +
                                  std::to_string(block_size) + "; a resumed ensemble must end on a block boundary");

  std::mutex mutex;  // guards everything below, and the ensemble
  std::atomic<bool> stopped = false;
  std::uint64_t done = 0;

  const auto work = [&](const NextTask& next) {
    const std::unique_ptr<Simulator> simulator = make_simulator();
    Block block(times, options.velocity_spectrum, options.ground_acceleration, stopped, in_plane);
    for (std::size_t task; next(task);) {
      const std::uint64_t number = first_block + task;
      const std::size_t members = members_of(number);
      {
        const std::scoped_lock lock(mutex);
        if (ensemble.parts().tallies.overlaps({0, number})) {  // `start` holds it
          done += members;
          continue;
        }
      }
      block.begin(members);
      simulator->simulate(number * block_size, members, block);
      Tally tally = block.finish();
      Ensemble::Kept kept;
      kept.peak.assign(block.peak().begin(), block.peak().begin() + static_cast<std::ptrdiff_t>(members));
      kept.residual.assign(block.residual().begin(), block.residual().begin() + static_cast<std::ptrdiff_t>(members));
      const auto across = block.residual_transverse();
      if (in_plane)
        kept.residual_transverse.assign(across.begin(), across.begin() + static_cast<std::ptrdiff_t>(members));
      const auto floors = block.floor_peaks();
      kept.floor_peaks.assign(floors.begin(), floors.end());
      if (const auto impacts = block.impacts(); !impacts.empty())
        kept.impacts.assign(impacts.begin(), impacts.begin() + static_cast<std::ptrdiff_t>(members));
      check_range(kept, tally, times, number * block_size);
      const std::scoped_lock lock(mutex);
      ensemble.insert(number, std::move(tally), std::move(kept), block.gaps(), block.airborne());
      done += members;
    }
  };
  const auto report = [&] {
    const std::scoped_lock lock(mutex);
    if (options.progress) options.progress({done, options.members, ensemble});
  };
  run_on_threads(options.threads, blocks, stopped, work, report);
  return ensemble;
}

}  // namespace stickslip::detail
