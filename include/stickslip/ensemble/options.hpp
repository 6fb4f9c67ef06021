// How an ensemble is run.
#pragma once

#include <cstdint>
#include <functional>

#include "stickslip/sliding/response.hpp"

namespace stickslip {

class Ensemble;

/// How far a run has come.
struct EnsembleProgress {
  std::uint64_t done;      ///< number of members done
  std::uint64_t members;   ///< number of members requested
  const Ensemble& so_far;  ///< the completed blocks; may be copied
};

struct EnsembleOptions {
  std::uint64_t members = 1000;    ///< at least 1
  std::uint64_t first_member = 0;  ///< a multiple of Ensemble::block()
  std::uint64_t seed = 0;
  unsigned threads = 0;  ///< maximum number of threads; 0: all cores
  double dt = 0;         ///< time step of the statistics [s]; 0: that of the motions, or 1/512 of the duration
  bool settle = false;   ///< residual and peak after the slider has come to rest without ground acceleration
  Contact contact = Contact::flight;  ///< what sliders do while the ground falls away from under them
  bool velocity_spectrum = true;      ///< also compute the spectral density of velocity; about 2 ns per sample
  /// Also compute the moments of the ground acceleration in time. Each motion is then generated twice, which costs
  /// about 5 to 30 ns per sample.
  bool ground_acceleration = false;
  /// Called about ten times per second in the calling thread; may throw to stop the work.
  std::function<void(const EnsembleProgress&)> progress{};
};

}  // namespace stickslip
