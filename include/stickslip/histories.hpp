// The motion at the samples and nothing else: faster than a whole response.
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <vector>

#include "stickslip/advance.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/ground_motion.hpp"
#include "stickslip/slider.hpp"
#include "stickslip/state.hpp"

namespace stickslip {

/// The motion at the samples of a ground motion.
struct Histories {
  std::vector<double> displacement;  ///< x [m]
  std::vector<double> velocity;      ///< x' [m/s]
};

namespace detail {

/// Coulomb friction without a spring forgets where it came from when it sticks: two motions of it that are stuck at the
/// same sample are the same from there on, but for a constant in x. So a long record is cut in pieces, which start from
/// rest and are computed side by side, in vector lanes; then each is done again from its true beginning, until both
/// are stuck.
/// @pre more samples than 64 pieces have to be worth it; all steps alike
Histories histories_by_pieces(const Coulomb& law, const GroundMotion& motion, const std::function<void()>& heartbeat);

}  // namespace detail

/// What `integrate` gives as displacement and velocity at the samples, from rest at x = 0, without events, peak and
/// energy:
///     x'' + level(x) sgn(x') + wn^2 x = -n(t).
/// @param slider     any law, with or without a spring
/// @param motion     the ground acceleration
/// @param heartbeat  called at least every second or so; may throw to end the work; optional
/// @throws std::overflow_error  a displacement or velocity beyond the range of doubles
/// @throws ConvergenceError     a law without power series
/// Accuracy as by `integrate`, of which the last bits may differ. Coulomb friction without a spring takes 8 to 16 ns a
/// sample at even steps, new arrays included, where `integrate` takes 15 to 36 (AVX2).
template <FrictionLaw Law>
Histories histories(const Slider<Law>& slider, const GroundMotion& motion,
                    const std::function<void()>& heartbeat = {}) {
  constexpr std::size_t worth_pieces = 8192, segments_a_beat = 4096;
  Histories result;
  const auto whole = [&] {
    result.displacement.resize(motion.samples());
    result.velocity.resize(motion.samples());
    State state;
    detail::with_flows(slider, motion.dt(), [&](const auto& flows) {
      for (std::size_t i = 0; i < motion.segments(); ++i) {
        if (heartbeat && (i + 1) % segments_a_beat == 0) heartbeat();
        const NoObserver observer;
        detail::advance(slider.law(), flows, motion.segment(i), state, observer);
        result.displacement[i + 1] = state.displacement;
        result.velocity[i + 1] = state.velocity;
      }
    });
  };
  if constexpr (std::same_as<Law, Coulomb>) {
    if (slider.stiffness() == 0 && std::isfinite(motion.dt()) && motion.samples() >= worth_pieces)
      result = detail::histories_by_pieces(slider.law(), motion, heartbeat);
    else
      whole();
  } else {
    whole();
  }
  for (const auto* values : {&result.displacement, &result.velocity})
    for (const double value : *values)
      if (!std::isfinite(value)) throw std::overflow_error("histories: the motion leaves the range of doubles");
  return result;
}

template <FrictionLaw Law>
Histories histories(const Law& law, const GroundMotion& motion, const std::function<void()>& heartbeat = {}) {
  return histories(Slider<Law>(law), motion, heartbeat);
}

}  // namespace stickslip
