#include "stickslip/detail/ensemble/lanes_simulator.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "simd/caster_lanes.hpp"
#include "simd/coulomb_lanes.hpp"
#include "simd/pulse_lanes.hpp"
#include "simd/transpose.hpp"
#include "simd/viscous_lanes.hpp"

namespace stickslip::detail {
namespace {

CoulombLanes lanes_of(const Coulomb& law, double duration) { return {law.forward(), law.backward(), duration}; }
CasterLanes lanes_of(const Caster& law, double duration) { return {law, duration}; }
ViscousLanes lanes_of(const ViscousSlider& slider, double duration) { return {slider, ViscousStep(slider, duration)}; }

// Without ground acceleration until they rest.
template <class Law>
void settle_all(const Law& law, const LaneStates& states, std::uint64_t first_member, std::size_t members) {
  const Slider<Law> slider(law);
  for (std::size_t i = 0; i < members; ++i) {
    State state = State::at(states.displacement[i], states.velocity[i]);
    naming_member(first_member + i, [&] {
      settle(slider, state, [&](double duration) { advance(slider, Segment{duration, 0, 0}, state); });
    });
    states.displacement[i] = state.displacement;
    states.peak[i] = std::max(states.peak[i], std::abs(state.displacement));
  }
}

void settle_all(const ViscousSlider&, const LaneStates&, std::uint64_t, std::size_t) {}  // refused before

/// Under a Gaussian excitation, whose members share their times.
/// @tparam Law  or the viscous slider
template <class Law>
class LanesSimulator final : public Simulator {
 public:
  LanesSimulator(const Law& law, const GaussianExcitation& excitation, std::uint64_t seed, bool settle)
      : law_(law), excitation_(excitation), seed_(seed), settle_(settle) {}

  void simulate(std::uint64_t first_member, std::size_t members, Block& block) override {
    const std::size_t width = block.width(), samples = excitation_.samples();
    generate(first_member, members, width, block);

    const auto every = static_cast<std::size_t>(std::round(block.times().dt / excitation_.dt()));
    const bool linear = excitation_.interpolation() == Interpolation::linear;
    const auto slider = lanes_of(law_, excitation_.dt());
    displacement_.assign(width, 0);
    velocity_.assign(width, 0);
    std::fill(block.peak().begin(), block.peak().end(), 0.0);
    const LaneStates states{displacement_.data(), velocity_.data(), block.peak().data()};
    block.row(0, displacement_.data(), velocity_.data());
    for (std::size_t i = 1; i < samples; ++i) {
      const double* const start = &ground_[(i - 1) * width];
      advance_lanes(slider, width, start, linear ? start + width : start, states);
      if (i % every == 0) block.row(i / every, displacement_.data(), velocity_.data());
      if (i % 256 == 0) block.beat();
    }
    if (settle_) settle_all(law_, states, first_member, members);
    std::copy_n(displacement_.begin(), width, block.residual().begin());
  }

 private:
  // The ground accelerations of all members, by sample and member; none beyond the last, whatever was there before:
  // lanes of casters are not the same to the last bit beside others.
  void generate(std::uint64_t first_member, std::size_t members, std::size_t width, Block& block) {
    const std::size_t samples = excitation_.samples();
    if (ground_.size() != width * samples) {
      ground_.resize(width * samples);
      records_.resize(row_padding * samples);
    }
    for (std::size_t i = 0; i < width; i += row_padding) {
      block.beat();
      const std::size_t some = std::min(row_padding, members - std::min(members, i));
      for (std::size_t k = 0; k < some; ++k)
        excitation_.sample(seed_, first_member + i + k, {&records_[k * samples], samples}, workspace_);
      if (some < row_padding)
        std::fill(records_.begin() + static_cast<std::ptrdiff_t>(some * samples), records_.end(), 0.0);
      transpose(records_.data(), row_padding, samples, samples, &ground_[i], width);
    }
  }

  Law law_;
  const GaussianExcitation& excitation_;
  std::uint64_t seed_;
  bool settle_;
  GaussianExcitation::Workspace workspace_;
  std::vector<double> records_, ground_, displacement_, velocity_;
};

/// Under pulses, of which each member has its own, at its own times.
class PulseSimulator final : public Simulator {
 public:
  PulseSimulator(const Coulomb& law, const PoissonPulses& excitation, std::uint64_t seed, bool settle)
      : law_(law),
        excitation_(excitation),
        seed_(seed),
        settle_(settle),
        lanes_{law.forward(), law.backward(), {}, {}} {
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
    if (settle_) settle_all(law_, states, first_member, members);
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

  Coulomb law_;
  const PoissonPulses& excitation_;
  std::uint64_t seed_;
  bool settle_;
  PulseLanes lanes_;
  PulseStreams pulses_;
  std::vector<double> arrivals_, amplitudes_, displacement_, velocity_, displacements_, velocities_;
};

}  // namespace

std::unique_ptr<Simulator> lanes_simulator(const Coulomb& law, const PoissonPulses& excitation, std::uint64_t seed,
                                           bool settle) {
  const std::size_t edges = excitation.options().shape.times().size();
  // Blocks so long that they could not be interrupted within a blink go member by member.
  if (edges > most_edges || excitation.rate() * excitation.duration() * static_cast<double>(edges) > 1e5)
    return nullptr;
  return std::make_unique<PulseSimulator>(law, excitation, seed, settle);
}

std::unique_ptr<Simulator> lanes_simulator(const Coulomb& law, const GaussianExcitation& excitation, std::uint64_t seed,
                                           bool settle) {
  return std::make_unique<LanesSimulator<Coulomb>>(law, excitation, seed, settle);
}

std::unique_ptr<Simulator> lanes_simulator(const Caster& law, const GaussianExcitation& excitation, std::uint64_t seed,
                                           bool settle) {
  // The lanes measure lengths in reaches.
  if (!(law.reach() > 1e-9 && law.reach() < 1e9)) return nullptr;
  return std::make_unique<LanesSimulator<Caster>>(law, excitation, seed, settle);
}

std::unique_ptr<Simulator> lanes_simulator(const ViscousSlider& slider, const GaussianExcitation& excitation,
                                           std::uint64_t seed, bool settle) {
  if (!(slider.natural_frequency() * excitation.dt() <= ViscousLanes::longest)) return nullptr;
  return std::make_unique<LanesSimulator<ViscousSlider>>(slider, excitation, seed, settle);
}

}  // namespace stickslip::detail
