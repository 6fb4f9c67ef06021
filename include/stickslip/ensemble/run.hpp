// Simulate many members and compute their statistics.
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "stickslip/base/error.hpp"
#include "stickslip/ensemble/detail/lanes_simulator.hpp"
#include "stickslip/ensemble/detail/planar_simulator.hpp"
#include "stickslip/ensemble/detail/simulator.hpp"
#include "stickslip/ensemble/ensemble.hpp"
#include "stickslip/ensemble/member.hpp"
#include "stickslip/ensemble/one_of.hpp"
#include "stickslip/ensemble/options.hpp"
#include "stickslip/ensemble/random_slider.hpp"
#include "stickslip/excitation/excitation.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/slider/slider.hpp"

namespace stickslip {

namespace detail {

/// The excitation of the component along the axis, where another one makes more; held by reference.
template <class M>
const auto& along_axis(const M& motions) {
  if constexpr (requires { motions.along_axis(); })
    return motions.along_axis();
  else
    return motions;
}

/// Whether the members of a source slide in the plane.
template <MemberSource Source>
constexpr bool in_plane =
    feels_transverse<std::remove_cvref_t<decltype(std::declval<const Source&>().member(0, 0).slider)>>;

/// The fastest simulator for a source; all of them solve the same equations.
template <MemberSource Source>
std::unique_ptr<Simulator> simulator(const Source& source, const EnsembleOptions& options) {
  using Members = std::conditional_t<in_plane<Source>, PlanarMemberSimulator<Source>, MemberSimulator<Source>>;
  return std::make_unique<Members>(source, options.seed, options.settle, options.contact);
}
template <class S, MotionSource M>
std::unique_ptr<Simulator> simulator(const PairedMembers<S, M>& source, const EnsembleOptions& options) {
  using Source = PairedMembers<S, M>;
  if constexpr (in_plane<Source>) {
    return std::make_unique<PlanarMemberSimulator<Source>>(source, options.seed, options.settle, options.contact);
  } else {
    const auto& motions = along_axis(source.motions());  // all sliders in lanes are on one axis
    if constexpr (requires { lanes_simulator(source.sliders(), motions, options.seed, options.settle); })
      if (auto lanes = lanes_simulator(source.sliders(), motions, options.seed, options.settle)) return lanes;
    return std::make_unique<MemberSimulator<Source>>(source, options.seed, options.settle, options.contact);
  }
}

/// Adds ground accelerations to the block by generating each motion a second time. This works with every simulator and
/// costs nothing if the accelerations are not requested.
template <MemberSource Source>
class GroundSimulator final : public Simulator {
 public:
  GroundSimulator(const Source& source, std::uint64_t seed, std::unique_ptr<Simulator> sliders)
      : source_(source), seed_(seed), sliders_(std::move(sliders)) {}

  void simulate(std::uint64_t first_member, std::size_t members, Block& block) override {
    sliders_->simulate(first_member, members, block);
    for (std::size_t i = 0; i < members; ++i) {
      block.check_stopped();
      const auto& member = source_.member(seed_, first_member + i);
      accelerations(member.motion, block.times(), acceleration_);
      block.ground(acceleration_);
    }
  }

 private:
  const Source& source_;
  std::uint64_t seed_;
  std::unique_ptr<Simulator> sliders_;
  std::vector<double> acceleration_;
};

}  // namespace detail

/// Simulate many members and compute the statistics of their displacement and velocity.
///
///     x'' + resist sgn(x') + c x' + wn^2 x = -n(t)                                               thesis 4.4, 5.4
///
/// from rest at x = 0, with the slider and n(t) of `source.member(seed, index)`. Each member is solved exactly between
/// events, as by `integrate`.
///
/// @param source   of members, see MemberSource; held by reference
/// @param options  members, seed, threads, times of the statistics
/// @param start    part of the same ensemble, whose members are not simulated again. A run that is stopped and later
///                 resumed from its saved ensemble gives the same bits as an uninterrupted one
/// @return statistics over the members `first_member` to `first_member + members - 1` and those of `start`
/// @throws std::invalid_argument  an option out of its range (the message names it); a `start` with a different
///                                configuration; a `dt` where ground motions differ in duration
/// @throws std::overflow_error    displacements or velocities beyond 1e34 [m, m/s], whose statistics could leave the
///                                range of doubles; the message names the member or block
/// @throws ConvergenceError       a member does not settle, or its law has no power series; the message names the
///                                member
///
/// An exception from `progress` stops the work; the partial ensemble passed to it remains valid and can be resumed.
///
/// Members whose slider is a PlanarSlider slide in the plane, under ground motions with a transverse component: their
/// statistics are those of vectors (see Ensemble). They cost 1 to 2 us per sample of sliding.
///
/// Cost on one thread: that of `integrate` per member, and about 10 ns per time of the statistics. Memory: 1 kB per
/// time of the statistics and thread, 16 bytes per member.
template <MemberSource Source>
Ensemble run_ensemble(const Source& source, const EnsembleOptions& options = {}, const Ensemble* start = nullptr) {
  const EnsembleTimes times = detail::ensemble_times(options.dt, source.time_base());
  EnsembleOptions asked = options;
  constexpr bool planar = detail::in_plane<Source>;
  if (planar && options.ground_acceleration)
    throw std::invalid_argument(
        "run_ensemble: ground_acceleration is not available for sliders in the plane; run a slider on one axis under "
        "each component");
  asked.velocity_spectrum = options.velocity_spectrum && times.count > 0 && !planar;
  asked.ground_acceleration = options.ground_acceleration && times.count > 0;
  EnsembleConfiguration configuration = source.configuration();
  configuration.insert(configuration.end(), {{"seed", std::to_string(options.seed)},
                                             {"dt", detail::shortest(times.dt)},
                                             {"times", std::to_string(times.count)},
                                             {"settle", options.settle ? "true" : "false"},
                                             {"velocity_spectrum", asked.velocity_spectrum ? "true" : "false"}});
  if (options.contact == Contact::clipped) configuration.emplace_back("contact", "clipped");
  if (asked.ground_acceleration) configuration.emplace_back("ground_acceleration", "true");
  if (planar) configuration.emplace_back("plane", "true");
  return detail::run_ensemble(std::move(configuration), times, asked, planar, start, [&] {
    std::unique_ptr<detail::Simulator> sliders = detail::simulator(source, options);
    if (asked.ground_acceleration)
      sliders = std::make_unique<detail::GroundSimulator<Source>>(source, options.seed, std::move(sliders));
    return sliders;
  });
}

/// The same, with members paired by index: one slider, or the sliders of a source, under the motions of a source.
///
///     run_ensemble(Coulomb(2), GaussianExcitation(...), {.members = 10'000});
///     run_ensemble(RandomSlider([](double mu) { return Coulomb::from_friction(mu); }, Lognormal(0.3, 0.3)),
///                  OneOf(std::vector{kobe, chi_chi}), {.members = 1000});
///
/// @param sliders  a Slider with any law, spring and damper; a law alone; or a SliderSource: a RandomSlider, or OneOf
///                 for a list
/// @param motions  an Excitation, or OneOf<GroundMotion>. If motions differ in duration, there are no statistics in
///                 time
///
/// Cost on one thread, including motions and statistics (2.5 GHz, AVX2): one slider for all members under Gaussian
/// excitation is integrated in SIMD lanes: Coulomb friction alone takes 6 to 7 ns per sample, with a spring or a damper
/// 25, spring and damper without friction 9 (with steps of less than 1 / wn), casters alone 70, any other law, with or
/// without spring and damper, 100 to 250. Coulomb friction takes 10 ns per step under pulses. All other cases cost what
/// `integrate` does, plus about 10 ns. In lanes, laws whose resistance changes while they slide agree with `integrate`
/// to 1e-9, from series with a tolerance of 1e-14 per step; the rest is exact to round-off. If the resistance of a law
/// changes much within a step, the event loop integrates its members one by one, at the cost of `integrate` or up to
/// twice that.
template <class S, MotionSource M>
requires(!FrictionLaw<S>) Ensemble run_ensemble(const S& sliders, const M& motions, const EnsembleOptions& options = {},
                                                const Ensemble* start = nullptr) {
  return run_ensemble(PairedMembers<S, M>(sliders, motions), options, start);
}

template <FrictionLaw Law, MotionSource M>
Ensemble run_ensemble(const Law& law, const M& motions, const EnsembleOptions& options = {},
                      const Ensemble* start = nullptr) {
  return run_ensemble(Slider<Law>(law), motions, options, start);
}

}  // namespace stickslip
