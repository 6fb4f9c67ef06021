#include "stickslip/ensemble/detail/lanes_simulator.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <type_traits>
#include <variant>
#include <vector>

#include "lanes/caster_lanes.hpp"
#include "lanes/coulomb_lanes.hpp"
#include "lanes/pulse_lanes.hpp"
#include "lanes/viscous_lanes.hpp"

namespace stickslip::detail {
namespace {

CoulombLanes coulomb_lanes(const Slider<Coulomb>& slider, double duration) {
  return {slider.law().forward(), slider.law().backward(), duration};
}
CasterLanes caster_lanes(const Slider<Caster>& slider, double duration) { return {slider.law(), duration}; }
ViscousLanes viscous_lanes(const Slider<Coulomb>& slider, double duration) {
  return {slider, DampedBasis(slider.damping(), slider.natural_frequency(), duration)};
}

bool has_friction_alone(const auto& slider) { return slider.stiffness() == 0 && slider.damping() == 0; }

template <class Law>
std::unique_ptr<Simulator> series_simulator(const Slider<Law>& slider, const GaussianExcitation& excitation,
                                            std::uint64_t seed, bool settle) {
#ifdef STICKSLIP_VECTORS
  return lanes_simulator<Law>(slider, excitation, seed, settle);
#else
  return nullptr;
#endif
}

/// Under pulses: each member has its own, at its own times.
class PulseSimulator final : public Simulator {
 public:
  PulseSimulator(const Slider<Coulomb>& slider, const PoissonPulses& excitation, std::uint64_t seed, bool settle)
      : slider_(slider),
        excitation_(excitation),
        seed_(seed),
        settle_(settle),
        lanes_{slider.law().forward(), slider.law().backward(), {}, {}} {
    const PulseShape& shape = excitation.options().shape;
    double before = 0;
    for (std::size_t i = 0; i < shape.times().size(); ++i) {
      const double after = i < shape.values().size() ? shape.values()[i] : 0;
      lanes_.edges.push_back(shape.times()[i] * excitation.half_width());
      lanes_.jumps.push_back(after - before);
      before = after;
    }
  }

  void simulate(std::uint64_t first_member, std::size_t members, Block& block) override {
    const std::size_t width = block.width(), times = block.times().count;
    draw(first_member, members, width);
    displacement_.assign(width, 0);
    velocity_.assign(width, 0);
    std::fill(block.peak().begin(), block.peak().end(), 0.0);
    const LaneStates states{displacement_.data(), velocity_.data(), block.peak().data()};
    displacements_.resize((times + 1) * width);
    velocities_.resize((times + 1) * width);
    advance_lanes(lanes_, excitation_.duration(), pulses_,
                  {block.times().dt, times, displacements_.data(), velocities_.data()}, states);
    for (std::size_t k = 0; k < times; ++k) block.row(k, &displacements_[k * width], &velocities_[k * width]);
    if (settle_) settle_all(slider_, states, first_member, members, 0, block);
    std::copy_n(displacement_.begin(), width, block.residual().begin());
  }

 private:
  void draw(std::uint64_t first_member, std::size_t members, std::size_t width) {
    constexpr double never = std::numeric_limits<double>::infinity();
    pulses_.arrivals.clear();
    pulses_.amplitudes.clear();
    pulses_.first.clear();
    for (std::size_t i = 0; i < width; ++i) {
      pulses_.first.push_back(static_cast<std::int64_t>(pulses_.arrivals.size()));
      if (i < members) {
        excitation_.pulses(seed_, first_member + i, arrivals_, amplitudes_);
        pulses_.arrivals.insert(pulses_.arrivals.end(), arrivals_.begin(), arrivals_.end());
        pulses_.amplitudes.insert(pulses_.amplitudes.end(), amplitudes_.begin(), amplitudes_.end());
      }
      pulses_.arrivals.push_back(never);
      pulses_.amplitudes.push_back(0);
    }
    pulses_.arrivals.push_back(never);
  }

  Slider<Coulomb> slider_;
  const PoissonPulses& excitation_;
  std::uint64_t seed_;
  bool settle_;
  PulseLanes lanes_;
  PulseStreams pulses_;
  std::vector<double> arrivals_, amplitudes_, displacement_, velocity_, displacements_, velocities_;
};

}  // namespace

std::unique_ptr<Simulator> lanes_simulator(const Slider<Coulomb>& slider, const PoissonPulses& excitation,
                                           std::uint64_t seed, bool settle) {
  const std::size_t edges = excitation.options().shape.times().size();
  // Blocks too long to be interrupted promptly are simulated member by member.
  if (!slider.plain() || !has_friction_alone(slider) || edges > max_edges ||
      excitation.rate() * excitation.duration() * static_cast<double>(edges) > 1e5)
    return nullptr;
  return std::make_unique<PulseSimulator>(slider, excitation, seed, settle);
}

std::unique_ptr<Simulator> lanes_simulator(const Slider<Coulomb>& slider, const GaussianExcitation& excitation,
                                           std::uint64_t seed, bool settle) {
  if (!slider.plain()) return nullptr;
  const double dt = excitation.dt();
  const auto simulator = [&](const auto& lanes) -> std::unique_ptr<Simulator> {
    return std::make_unique<LanesSimulator<Coulomb, std::remove_cvref_t<decltype(lanes)>>>(slider, lanes, excitation,
                                                                                           seed, settle);
  };
  if (has_friction_alone(slider)) return simulator(coulomb_lanes(slider, dt));
  if (slider.law().forward() > 0 || slider.law().backward() > 0)
    return series_simulator(slider, excitation, seed, settle);
  if (!(slider.natural_frequency() * dt <= ViscousLanes::longest)) return nullptr;
  return simulator(viscous_lanes(slider, dt));
}

std::unique_ptr<Simulator> lanes_simulator(const Slider<Caster>& slider, const GaussianExcitation& excitation,
                                           std::uint64_t seed, bool settle) {
  if (!slider.plain()) return nullptr;
  // The unit of length in the lanes is the reach.
  const double reach = slider.law().reach();
  if (!has_friction_alone(slider) || slider.law().rolling() > 0)
    return series_simulator(slider, excitation, seed, settle);
  if (!(reach > 1e-9 && reach < 1e9)) return nullptr;
  return std::make_unique<LanesSimulator<Caster, CasterLanes>>(slider, caster_lanes(slider, excitation.dt()),
                                                               excitation, seed, settle);
}

std::unique_ptr<Simulator> lanes_simulator(const Slider<VelocityDependent>& slider,
                                           const GaussianExcitation& excitation, std::uint64_t seed, bool settle) {
  return series_simulator(slider, excitation, seed, settle);
}

std::unique_ptr<Simulator> lanes_simulator(const AnySlider& slider, const GaussianExcitation& excitation,
                                           std::uint64_t seed, bool settle) {
  if (const auto* coulomb = std::get_if<Slider<Coulomb>>(&slider))
    return lanes_simulator(*coulomb, excitation, seed, settle);
  if (const auto* caster = std::get_if<Slider<Caster>>(&slider))
    return lanes_simulator(*caster, excitation, seed, settle);
  if (const auto* other = std::get_if<Slider<VelocityDependent>>(&slider))
    return lanes_simulator(*other, excitation, seed, settle);
  return nullptr;
}

std::unique_ptr<Simulator> lanes_simulator(const AnySlider& slider, const PoissonPulses& excitation, std::uint64_t seed,
                                           bool settle) {
  const auto* coulomb = std::get_if<Slider<Coulomb>>(&slider);
  return coulomb ? lanes_simulator(*coulomb, excitation, seed, settle) : nullptr;
}

}  // namespace stickslip::detail
