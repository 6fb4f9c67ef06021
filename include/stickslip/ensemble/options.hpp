// How an ensemble is run.
#pragma once

#include <cstdint>
#include <functional>

#include "stickslip/sliding/response.hpp"

namespace stickslip {

class Ensemble;

/// How far a run has come.
struct EnsembleProgress {
  std::uint64_t done;      ///< members
  std::uint64_t members;   ///< that were asked for
  const Ensemble& so_far;  ///< whole blocks of them; may be copied
};

struct EnsembleOptions {
  std::uint64_t members = 1000;    ///< at least 1
  std::uint64_t first_member = 0;  ///< a multiple of Ensemble::block()
  std::uint64_t seed = 0;
  unsigned threads = 0;  ///< at most; 0: as many as the machine has
  double dt = 0;         ///< between the times of the statistics [s]; 0: the motions', or 1/512 of it all
  bool settle = false;   ///< residual and peak after the slider has come to rest without ground acceleration
  Contact contact = Contact::flight;  ///< what sliders do where the ground falls away from under them
  bool velocity_spectrum = true;      ///< also the velocity's spectral density; some 2 ns a sample
  /// Also the moments of the ground acceleration by time; each motion is made once more for it, some 5 to 30 ns a
  /// sample.
  bool ground_acceleration = false;
  /// Called every tenth of a second or so, in the thread that called; may throw to end the work.
  std::function<void(const EnsembleProgress&)> progress{};
};

}  // namespace stickslip
