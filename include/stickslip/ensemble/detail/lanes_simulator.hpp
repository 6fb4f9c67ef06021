// Simulates many members in parallel vector lanes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "stickslip/ensemble/detail/simulator.hpp"
#include "stickslip/excitation/gaussian.hpp"
#include "stickslip/excitation/poisson.hpp"
#include "stickslip/friction/caster.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/friction/velocity_dependent.hpp"
#include "stickslip/lanes/row.hpp"
#include "stickslip/lanes/series_lanes.hpp"
#include "stickslip/lanes/transpose.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/sliding/any_slider.hpp"

namespace stickslip::detail {

/// Continue without ground acceleration until all rest.
/// @param segments  number of segments of the preceding motion
template <class Law>
void settle_all(const Slider<Law>& slider, const LaneStates& states, std::uint64_t first_member, std::size_t members,
                std::size_t segments, const Block& block) {
  const EngineOf<Law> engine(slider);
  for (std::size_t i = 0; i < members; ++i) {
    State state = engine.started(State::at(states.displacement[i], states.velocity[i]));
    PeakObserver observer(block, max_events(segments + block.times().count));
    naming_member(first_member + i, [&] { settle_member(engine, false, Contact::flight, state, observer, block); });
    states.displacement[i] = state.displacement;
    states.peak[i] = std::max(states.peak[i], observer.peak());
  }
}

/// Members under a Gaussian excitation, which have common times.
template <class Law, class Lanes>
class LanesSimulator final : public Simulator {
 public:
  LanesSimulator(const Slider<Law>& slider, const Lanes& lanes, const GaussianExcitation& excitation,
                 std::uint64_t seed, bool settle)
      : slider_(slider), lanes_(lanes), excitation_(excitation), seed_(seed), settle_(settle) {}

  void simulate(std::uint64_t first_member, std::size_t members, Block& block) override {
    const std::size_t width = block.width(), samples = excitation_.samples();
    generate(first_member, members, width, block);

    const auto every = static_cast<std::size_t>(std::round(block.times().dt / excitation_.dt()));
    const bool linear = excitation_.interpolation() == Interpolation::linear;
    displacement_.assign(width, 0);
    velocity_.assign(width, 0);
    std::fill(block.peak().begin(), block.peak().end(), 0.0);
    const LaneStates states{displacement_.data(), velocity_.data(), block.peak().data()};
    block.row(0, displacement_.data(), velocity_.data());
    for (std::size_t i = 1; i < samples; ++i) {
      const double* const start = &ground_[(i - 1) * width];
      try {
        advance_lanes(lanes_, width, start, linear ? start + width : start, states);
      } catch (const LaneError& error) {
        naming_member(first_member + error.lane, [&] { throw ConvergenceError(error); });
      }
      if (i % every == 0) block.row(i / every, displacement_.data(), velocity_.data());
      block.check_stopped();
    }
    if (settle_) settle_all(slider_, states, first_member, members, samples - 1, block);
    std::copy_n(displacement_.begin(), width, block.residual().begin());
  }

 private:
  // The ground accelerations of all members, by sample and member. Unused lanes are set to zero, because the last bits
  // of lanes of series depend on the other lanes.
  void generate(std::uint64_t first_member, std::size_t members, std::size_t width, Block& block) {
    const std::size_t samples = excitation_.samples();
    if (ground_.size() != width * samples) {
      ground_.resize(width * samples);
      records_.resize(row_padding * samples);
    }
    for (std::size_t i = 0; i < width; i += row_padding) {
      block.check_stopped();
      const std::size_t some = std::min(row_padding, members - std::min(members, i));
      for (std::size_t k = 0; k < some; ++k)
        excitation_.sample(seed_, first_member + i + k, {&records_[k * samples], samples}, workspace_);
      if (some < row_padding)
        std::fill(records_.begin() + static_cast<std::ptrdiff_t>(some * samples), records_.end(), 0.0);
      transpose(records_.data(), row_padding, samples, samples, &ground_[i], width);
    }
  }

  Slider<Law> slider_;
  Lanes lanes_;
  const GaussianExcitation& excitation_;
  std::uint64_t seed_;
  bool settle_;
  GaussianExcitation::Workspace workspace_;
  std::vector<double> records_, ground_, displacement_, velocity_;
};

#ifdef STICKSLIP_VECTORS
/// Members with any law; null if it acts on more than level ground, or springs or dampers are so stiff that very many time
/// steps would be needed.
template <LawWithLanes Law>
std::unique_ptr<Simulator> lanes_simulator(const Slider<Law>& slider, const GaussianExcitation& excitation,
                                           std::uint64_t seed, bool settle) {
  const double dt = excitation.dt();
  if (!slider.plain()) return nullptr;
  if (!(slider.natural_frequency() * dt <= SeriesLanes<Law>::longest && slider.damping() * dt <= 2)) return nullptr;
  return std::make_unique<LanesSimulator<Law, SeriesLanes<Law>>>(slider, SeriesLanes<Law>(slider, dt), excitation, seed,
                                                                 settle);
}
#endif

/// The same, with specialized kernels where they exist: Coulomb friction alone, spring and damper alone, casters
/// without rolling resistance alone.
std::unique_ptr<Simulator> lanes_simulator(const Slider<Coulomb>& slider, const GaussianExcitation& excitation,
                                           std::uint64_t seed, bool settle);
std::unique_ptr<Simulator> lanes_simulator(const Slider<Caster>& slider, const GaussianExcitation& excitation,
                                           std::uint64_t seed, bool settle);
std::unique_ptr<Simulator> lanes_simulator(const Slider<VelocityDependent>& slider,
                                           const GaussianExcitation& excitation, std::uint64_t seed, bool settle);
/// Coulomb friction alone under pulses; else null.
std::unique_ptr<Simulator> lanes_simulator(const Slider<Coulomb>& slider, const PoissonPulses& excitation,
                                           std::uint64_t seed, bool settle);
/// The same for a slider of any law; null where there are no lanes.
std::unique_ptr<Simulator> lanes_simulator(const AnySlider& slider, const GaussianExcitation& excitation,
                                           std::uint64_t seed, bool settle);
std::unique_ptr<Simulator> lanes_simulator(const AnySlider& slider, const PoissonPulses& excitation, std::uint64_t seed,
                                           bool settle);

}  // namespace stickslip::detail
