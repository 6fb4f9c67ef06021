// Simulates many members side by side in vector lanes.
#pragma once

#include <cstdint>
#include <memory>

#include "stickslip/detail/ensemble/simulator.hpp"
#include "stickslip/excitation/gaussian.hpp"
#include "stickslip/excitation/poisson.hpp"
#include "stickslip/friction/caster.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/viscous.hpp"

namespace stickslip::detail {

/// Many members side by side, by vector instructions, for sliders without a spring; null where that does not pay.
std::unique_ptr<Simulator> lanes_simulator(const Coulomb& law, const GaussianExcitation& excitation, std::uint64_t seed,
                                           bool settle);
std::unique_ptr<Simulator> lanes_simulator(const Caster& law, const GaussianExcitation& excitation, std::uint64_t seed,
                                           bool settle);
std::unique_ptr<Simulator> lanes_simulator(const Coulomb& law, const PoissonPulses& excitation, std::uint64_t seed,
                                           bool settle);
std::unique_ptr<Simulator> lanes_simulator(const ViscousSlider& slider, const GaussianExcitation& excitation,
                                           std::uint64_t seed, bool settle);

}  // namespace stickslip::detail
