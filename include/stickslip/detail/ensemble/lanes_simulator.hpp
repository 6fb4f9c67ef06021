// Simulates many members side by side in vector lanes.
#pragma once

#include <cstdint>
#include <memory>

#include "stickslip/detail/ensemble/simulator.hpp"
#include "stickslip/excitation/gaussian.hpp"
#include "stickslip/excitation/poisson.hpp"
#include "stickslip/friction/caster.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/slider.hpp"

namespace stickslip::detail {

/// Many members side by side, by vector instructions: friction alone, or, of Coulomb sliders, spring and damper alone;
/// null where it is neither, or does not pay.
std::unique_ptr<Simulator> lanes_simulator(const Slider<Coulomb>& slider, const GaussianExcitation& excitation,
                                           std::uint64_t seed, bool settle);
std::unique_ptr<Simulator> lanes_simulator(const Slider<Caster>& slider, const GaussianExcitation& excitation,
                                           std::uint64_t seed, bool settle);
std::unique_ptr<Simulator> lanes_simulator(const Slider<Coulomb>& slider, const PoissonPulses& excitation,
                                           std::uint64_t seed, bool settle);

}  // namespace stickslip::detail
