// Many members of a random excitation, each slid through, and reduced to statistics with their standard errors.
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <typeinfo>
#include <utility>
#include <vector>

#include "stickslip/detail/recorder.hpp"
#include "stickslip/error.hpp"
#include "stickslip/excitation/gaussian.hpp"
#include "stickslip/excitation/poisson.hpp"
#include "stickslip/friction/caster.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/slider.hpp"
#include "stickslip/sliding/advance.hpp"
#include "stickslip/sliding/integrate.hpp"
#include "stickslip/statistics/moments.hpp"
#include "stickslip/statistics/tally.hpp"
#include "stickslip/viscous.hpp"

namespace stickslip {

/// A random source of ground motions: (seed, member) names one for ever. All motions begin at the same time and last
/// `duration()` [s]; `configuration()` tells all that they depend on, so that only what belongs together is merged.
/// It is asked by many threads at a time.
template <class E>
concept Excitation = requires(const E& excitation, std::uint64_t number) {
  { excitation.sample(number, number) } -> std::same_as<GroundMotion>;
  { excitation.duration() } -> std::convertible_to<double>;
  { excitation.configuration() } -> std::convertible_to<std::string>;
};

class Ensemble;
struct EnsembleOptions;
struct EnsembleTimes;

namespace detail {
class Simulator;
using MakeSimulator = std::function<std::unique_ptr<Simulator>()>;
}  // namespace detail

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
  unsigned threads = 0;           ///< at most; 0: as many as the machine has
  double dt = 0;                  ///< between the times of the statistics [s]; 0: the excitation's, or 1/512 of it all
  bool settle = false;            ///< residual and peak after the slider has come to rest without ground acceleration
  bool velocity_spectrum = true;  ///< also the velocity's spectral density; some 2 ns a sample
  /// Called every tenth of a second or so, in the thread that called; may throw to end the work.
  std::function<void(const EnsembleProgress&)> heartbeat{};
};

/// The times of the statistics: 0, dt, 2 dt, ... of the motion.
struct EnsembleTimes {
  double dt = 0;          ///< [s]
  std::size_t count = 0;  ///< at least 2

  /// Stationary averages are taken over the central half, thesis 4.4: `central` times from `begin` on.
  std::size_t begin() const noexcept { return count / 4; }
  std::size_t central() const noexcept { return count / 2; }
  friend bool operator==(const EnsembleTimes&, const EnsembleTimes&) = default;
};

/// Averages over the central half of the motion, from `begin` to `end` [s], thesis 4.4, with standard errors from the
/// scatter between members.
struct Stationary {
  double begin, end;
  Estimate velocity_mean;      ///< [m/s]
  Estimate velocity_variance;  ///< [m^2/s^2]
  /// Its error is too small where members are few and velocities have heavy tails.
  Estimate velocity_kurtosis;  ///< mean fourth power over the variance squared (Gaussian: 3, Laplace: 6); NaN at rest
  Estimate covariance;         ///< of x and x' [m^2/s]; half of the growth rate, thesis (5.59), with more scatter
  /// Growth of the displacement variance [m^2/s]: of D(t) = Var[x(begin + t) - x(begin)], (D(T) - D(T/2)) / (T/2), T
  /// from begin to end. The part of x that does not grow cancels.
  Estimate growth_rate;
};

/// Spectral density of the velocity in the central half of the motion: Kaiser-Bessel window (4.62) with beta = 8 and a
/// mean square of one, density dt / (2 pi M) |DFT|^2 of the M windowed samples, two-sided.
struct VelocitySpectrum {
  std::vector<double> omega;    ///< [rad/s], from 0 to the Nyquist frequency
  std::vector<double> density;  ///< [m^2/s]: (m/s)^2 for each rad/s
  std::vector<double> error;    ///< its standard error
};

namespace detail {
Ensemble run_ensemble(const std::vector<std::pair<std::string, std::string>>& configuration, const EnsembleTimes& times,
                      const EnsembleOptions& options, const Ensemble* start, const MakeSimulator& make_simulator);
}

/// Statistics over the members of an ensemble, each with its standard error, from the scatter between members.
///
/// All sums are taken in one pass, about means, and merge pair by pair in an order that the members' numbers fix: the
/// same members give the same bits on any number of threads and in any parts that end on whole blocks.
class Ensemble {
 public:
  /// What the members depend on, name by name.
  using Configuration = std::vector<std::pair<std::string, std::string>>;

  /// Of each member of a block.
  struct Kept {
    std::vector<double> peak, residual;  ///< [m]
    friend bool operator==(const Kept&, const Kept&) = default;
  };

  /// All that an ensemble holds, to be put into a file and read back.
  struct Parts {
    Configuration configuration;
    EnsembleTimes times;
    bool velocity_spectrum = false;
    detail::TallyTree tallies;
    std::map<std::uint64_t, std::size_t> cut;  ///< blocks that are not whole, and how many members they have
    std::map<std::uint64_t, Kept> kept;        ///< by the block's number; empty once there are more than `most_kept`
    detail::Sketch peaks;                      ///< then this counts them
    friend bool operator==(const Parts&, const Parts&) = default;
  };

  /// Of more members than these no single peak and residual is kept; peaks are then counted in bins 0.1 % wide.
  static constexpr std::uint64_t most_kept = std::uint64_t{1} << 24;

  /// Times of the statistics there may be.
  static constexpr std::size_t max_times = std::size_t{1} << 24;

  /// Members are simulated and summed in blocks of this many, which the parts of an ensemble may not cut: 64, and fewer
  /// for motions of more than 16,384 times, so that a block's memory stays bounded.
  static std::size_t block(std::size_t times);

  /// @throws std::invalid_argument where the parts do not fit together, or no members can have left them: what is not
  ///         finite, a negative peak or sum of squares
  explicit Ensemble(Parts parts);
  const Parts& parts() const noexcept { return parts_; }

  /// Whether they are of one configuration and hold the same members with the same figures.
  friend bool operator==(const Ensemble&, const Ensemble&) = default;

  const Configuration& configuration() const noexcept { return parts_.configuration; }
  std::uint64_t members() const;

  /// Times of the statistics [s].
  std::vector<double> time() const;

  Estimates displacement_mean() const;  ///< of x [m], by time
  /// Of x about its mean, with the divisor members - 1 [m^2], by time.
  /// @throws std::domain_error with fewer than two members; so do all that follow but peak and residual
  Estimates displacement_variance() const;
  Estimates covariance() const;         ///< of x and x' [m^2/s], by time
  Estimates velocity_mean() const;      ///< of x' [m/s], by time
  Estimates velocity_variance() const;  ///< of x' [m^2/s^2], by time

  /// All of these and the stationary growth rate, as a theory answers.
  Moments moments() const;

  Stationary stationary() const;
  /// @throws std::domain_error also where it was not asked for
  VelocitySpectrum velocity_spectrum() const;

  /// Largest |x| of each member [m], between samples too, in the order of the members.
  /// @throws std::domain_error where there are more than `most_kept`
  std::vector<double> peak() const;
  /// Last x of each member [m].
  std::vector<double> residual() const;

  /// The peak that a share of the members does not exceed [m]; bounds from order statistics (binomial law), 0 and
  /// infinity where the members are too few to bound it.
  /// @param probability  the share, in (0, 1)
  /// @param confidence   of the bounds, in (0, 1)
  Interval quantile(double probability, double confidence = 0.95) const;
  /// The share of members whose peak exceeds a level; bounds of Clopper and Pearson (1934).
  /// @param level  [m], at least 0
  Interval exceedance(double level, double confidence = 0.95) const;

  /// Takes in the members of another part of the same ensemble.
  /// @throws std::invalid_argument where it is of another configuration (says what differs), or holds members that are
  ///         here already; nothing has changed then
  void merge(const Ensemble& other);

 private:
  friend Ensemble detail::run_ensemble(const Configuration&, const EnsembleTimes&, const EnsembleOptions&,
                                       const Ensemble*, const detail::MakeSimulator&);
  void insert(std::uint64_t block, detail::Tally tally, Kept kept);
  void bound_memory();

  Parts parts_;
};

namespace detail {

/// The members of one block, while they are simulated: takes their motion row by row.
class Block {
 public:
  Block(const EnsembleTimes& times, bool velocity_spectrum, const std::atomic<bool>& stopped);
  ~Block();
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;

  const EnsembleTimes& times() const noexcept { return times_; }
  /// Members that a row has room for: a block, padded to whole vectors.
  std::size_t width() const noexcept { return width_; }

  /// The motion of all members at one time; each time in turn.
  /// @param displacement, velocity  `width()` of each; what is past the last member does not count
  void row(std::size_t time, const double* displacement, const double* velocity);

  /// Of each member, set by who simulates.
  std::span<double> peak() noexcept { return {peak_.data(), width_}; }
  std::span<double> residual() noexcept { return {residual_.data(), width_}; }

  /// Ends the work if that is wanted; to be called every millisecond or so.
  void beat() const {
    if (stopped_.load(std::memory_order_relaxed)) throw Stopped{};
  }
  struct Stopped {};

  void begin(std::size_t members);
  /// The sums of the block.
  Tally finish();

 private:
  struct Spectrum;
  EnsembleTimes times_;
  std::size_t members_ = 0;
  std::size_t width_;
  const std::atomic<bool>& stopped_;
  std::vector<double> peak_, residual_;
  std::vector<double> central_, marks_, velocities_;
  std::unique_ptr<Spectrum> spectrum_;
  Tally tally_;
};

/// Simulates the members of a block. Each thread has its own.
class Simulator {
 public:
  virtual ~Simulator() = default;
  virtual void simulate(std::uint64_t first_member, std::size_t members, Block& block) = 0;
};

/// Does the work; a failure to converge says which member it was.
template <class Work>
void naming_member(std::uint64_t member, Work&& work) {
  try {
    work();
  } catch (const ConvergenceError& error) {
    throw ConvergenceError("run_ensemble: member " + std::to_string(member) + ": " + error.what());
  }
}

/// Through a motion piece by piece: `go` moves over a segment, `keep` is called at each time of the statistics, which
/// cuts the segment that it lies in.
template <class Go, class Keep>
void go_through(const GroundMotion& motion, const Block& block, Go&& go, Keep&& keep_at) {
  const std::size_t times = block.times().count;
  const double dt = block.times().dt, begin = motion.time(0);
  std::size_t next = 0;  // time of the statistics
  const auto keep = [&] { keep_at(next++); };
  keep();
  double wanted = dt;
  for (std::size_t i = 0; i < motion.segments(); ++i) {
    if (i % 1024 == 0) block.beat();
    Segment segment = motion.segment(i);
    double from = motion.time(i) - begin;
    const double to = motion.time(i + 1) - begin;
    while (next < times && wanted < to) {
      if (wanted > from) {
        const double middle = segment.start + (segment.end - segment.start) * ((wanted - from) / segment.duration);
        go(Segment{wanted - from, segment.start, middle});
        segment = {to - wanted, middle, segment.end};
        from = wanted;
      }
      keep();
      wanted = static_cast<double>(next) * dt;
    }
    go(segment);
    if (next < times && wanted == to) {
      keep();
      wanted = static_cast<double>(next) * dt;
    }
  }
  while (next < times) keep();  // a last time that rounding put past the end
}

/// Any slider under any excitation, one member after the other, through the event loop of `advance`.
template <FrictionLaw Law, Excitation E>
class MemberSimulator final : public Simulator {
 public:
  MemberSimulator(const Slider<Law>& slider, const E& excitation, std::uint64_t seed, bool settle)
      : slider_(slider), excitation_(excitation), seed_(seed), settle_(settle) {}

  void simulate(std::uint64_t first_member, std::size_t members, Block& block) override {
    const std::size_t times = block.times().count, width = block.width();
    displacement_.resize(times * width);
    velocity_.resize(times * width);
    for (std::size_t i = 0; i < members; ++i) {
      const GroundMotion motion = excitation_.sample(seed_, first_member + i);
      naming_member(first_member + i, [&] {
        with_flows(slider_, motion.dt(), [&](const auto& flows) { slide(flows, motion, i, block); });
      });
    }
    for (std::size_t k = 0; k < times; ++k) block.row(k, &displacement_[k * width], &velocity_[k * width]);
  }

 private:
  class PeakObserver {
   public:
    PeakObserver(const Block& block, std::size_t most_events) : block_(block), most_events_(most_events) {}

    double peak() const noexcept { return peak_; }

    void slide(Direction direction, double from, double distance, double, double) {
      if constexpr (!ConstantLevelLaw<Law>) beat();
      peak_ = std::max(peak_, std::abs(from + sign(direction) * distance));
    }
    void event(EventKind, double, const State&) {
      beat();
      if (++events_ > most_events_) refuse_more_events(most_events_);
    }

   private:
    void beat() {
      if (++beats_ % Recorder<Law>::work_a_beat == 0) block_.beat();
    }
    const Block& block_;
    std::size_t most_events_, events_ = 0;
    std::uint32_t beats_ = 0;
    double peak_ = 0;
  };

  // One place for all: inlined wherever it is called it would take a compiler minutes.
  template <class Flows>
  [[gnu::flatten, gnu::noinline]] void go(const Flows& flows, const Segment& segment, State& state,
                                          PeakObserver& observer) const {
    advance(slider_.law(), flows, segment, state, observer);
  }

  template <class Flows>
  void slide(const Flows& flows, const GroundMotion& motion, std::size_t member, Block& block) {
    const std::size_t width = block.width();
    State state;
    PeakObserver observer(block, max_events(motion.segments() + block.times().count));
    go_through(
        motion, block, [&](const Segment& segment) { go(flows, segment, state, observer); },
        [&](std::size_t time) {
          displacement_[time * width + member] = state.displacement;
          velocity_[time * width + member] = state.velocity;
        });
    if (settle_)
      settle(slider_, state, [&](double duration) {
        block.beat();
        go(flows, Segment{duration, 0, 0}, state, observer);
      });
    block.peak()[member] = observer.peak();
    block.residual()[member] = state.displacement;
  }

  Slider<Law> slider_;
  const E& excitation_;
  std::uint64_t seed_;
  bool settle_;
  std::vector<double> displacement_, velocity_;  // by time and member
};

/// The viscous slider under any excitation, one member after the other.
template <Excitation E>
class ViscousSimulator final : public Simulator {
 public:
  ViscousSimulator(const ViscousSlider& slider, const E& excitation, std::uint64_t seed)
      : slider_(slider), excitation_(excitation), seed_(seed) {}

  void simulate(std::uint64_t first_member, std::size_t members, Block& block) override {
    const std::size_t times = block.times().count, width = block.width();
    displacement_.resize(times * width);
    velocity_.resize(times * width);
    ViscousStep step(slider_, 0);
    for (std::size_t i = 0; i < members; ++i) {
      const GroundMotion motion = excitation_.sample(seed_, first_member + i);
      ViscousMotion moving(slider_, 0, 0);
      const auto go = [&](const Segment& segment) {
        const double pieces = moving.pieces(segment.duration), slope = (segment.start - segment.end) / segment.duration;
        if (step.duration != segment.duration / pieces) step = ViscousStep(slider_, segment.duration / pieces);
        for (double piece = 0; piece < pieces; ++piece) {
          moving.advance(step, -segment.start + slope * (piece * step.duration), slope);
          if (std::fmod(piece, 1024) == 1023) block.beat();
        }
      };
      go_through(
          motion, block, [&](const Segment& segment) { segment.duration > 0 ? go(segment) : void(); },
          [&](std::size_t time) {
            displacement_[time * width + i] = moving.displacement();
            velocity_[time * width + i] = moving.velocity();
          });
      block.peak()[i] = moving.peak();
      block.residual()[i] = moving.displacement();
    }
    for (std::size_t k = 0; k < times; ++k) block.row(k, &displacement_[k * width], &velocity_[k * width]);
  }

 private:
  ViscousSlider slider_;
  const E& excitation_;
  std::uint64_t seed_;
  std::vector<double> displacement_, velocity_;  // by time and member
};

/// Many members side by side, by vector instructions, for sliders without a spring; null where that does not pay.
std::unique_ptr<Simulator> lanes_simulator(const Coulomb& law, const GaussianExcitation& excitation, std::uint64_t seed,
                                           bool settle);
std::unique_ptr<Simulator> lanes_simulator(const Caster& law, const GaussianExcitation& excitation, std::uint64_t seed,
                                           bool settle);
std::unique_ptr<Simulator> lanes_simulator(const Coulomb& law, const PoissonPulses& excitation, std::uint64_t seed,
                                           bool settle);
std::unique_ptr<Simulator> lanes_simulator(const ViscousSlider& slider, const GaussianExcitation& excitation,
                                           std::uint64_t seed, bool settle);

/// The fastest there is; all solve the same equations.
template <FrictionLaw Law, Excitation E>
std::unique_ptr<Simulator> simulator(const Slider<Law>& slider, const E& excitation, std::uint64_t seed, bool settle) {
  if constexpr (requires { lanes_simulator(slider.law(), excitation, seed, settle); })
    if (slider.stiffness() == 0)
      if (auto lanes = lanes_simulator(slider.law(), excitation, seed, settle)) return lanes;
  return std::make_unique<MemberSimulator<Law, E>>(slider, excitation, seed, settle);
}
template <Excitation E>
std::unique_ptr<Simulator> simulator(const ViscousSlider& slider, const E& excitation, std::uint64_t seed, bool) {
  if constexpr (requires { lanes_simulator(slider, excitation, seed, false); })
    if (auto lanes = lanes_simulator(slider, excitation, seed, false)) return lanes;
  return std::make_unique<ViscousSimulator<E>>(slider, excitation, seed);
}

/// What the motion of a slider depends on, as JSON.
std::string describe(const Coulomb& law, double natural_frequency);
std::string describe(const Caster& law, double natural_frequency);
/// A law of somebody's own: its type and a few of its levels.
std::string describe(const char* type, std::span<const double> levels, double natural_frequency);
template <FrictionLaw Law>
std::string describe(const Law& law, double natural_frequency) {
  double levels[10];
  for (int i = 0; i < 10; ++i)
    levels[i] = law.level(0.1 * ((i / 2) - 2), i % 2 == 0 ? Direction::forward : Direction::backward);
  return describe(typeid(Law).name(), levels, natural_frequency);
}
template <FrictionLaw Law>
std::string describe(const Slider<Law>& slider) {
  return describe(slider.law(), slider.natural_frequency());
}
std::string describe(const ViscousSlider& slider);

/// Times of the statistics for an excitation that has samples (of which they may be every second, third ...), or not.
EnsembleTimes ensemble_times(double dt, double sample_dt, double duration);

/// All sliders alike.
template <class S, Excitation E>
Ensemble run_ensemble(const S& slider, const E& excitation, const EnsembleOptions& options, const Ensemble* start) {
  double sample_dt = 0;
  if constexpr (requires { excitation.dt(); }) sample_dt = excitation.dt();
  const EnsembleTimes times = ensemble_times(options.dt, sample_dt, excitation.duration());
  const Ensemble::Configuration configuration{{"slider", describe(slider)},
                                              {"excitation", excitation.configuration()},
                                              {"seed", std::to_string(options.seed)},
                                              {"dt", shortest(times.dt)},
                                              {"times", std::to_string(times.count)},
                                              {"settle", options.settle ? "true" : "false"},
                                              {"velocity_spectrum", options.velocity_spectrum ? "true" : "false"}};
  return run_ensemble(configuration, times, options, start,
                      [&] { return simulator(slider, excitation, options.seed, options.settle); });
}

}  // namespace detail

/// Slides through many members of a random excitation and takes the statistics of displacement and velocity over them.
///
///     x'' + level(x) sgn(x') + wn^2 x = -n(t),   n(t) = excitation.sample(seed, member)        thesis 4.4, 5.4
///
/// from rest at x = 0. Each member is solved exactly between events, as by `integrate`.
///
/// @param slider      any law, with or without a spring
/// @param excitation  a source of ground motions
/// @param options     members, seed, threads, times of the statistics
/// @param start       part of the same ensemble: its members are not simulated again. An ensemble that was cut off and
///                    goes on from what was kept ends with the same bits
/// @return statistics over the members `first_member` to `first_member + members - 1`, and those of `start`
/// @throws std::invalid_argument  an option out of its range (names it); a `start` of another configuration
/// @throws std::overflow_error    displacements or velocities beyond 1e34 [m, m/s], whose statistics could leave the
///                                range of doubles; says which member or block
/// @throws ConvergenceError       a member does not settle, or its law has no power series; says which member
/// What `heartbeat` throws ends the work; what it was shown before is whole and can be gone on from.
///
/// Cost on one thread, the motions and the statistics included (2.5 GHz, AVX2): without a spring, Coulomb friction 6 to
/// 7 ns a sample and casters 70 under Gaussian excitation, Coulomb friction 10 ns a step under pulses; else as
/// `integrate`, and some 10 ns. Casters in vector lanes are within 1e-9 of those by `integrate`, all else is exact to
/// round-off. Memory: 1 kB for each time of the statistics and thread, 16 bytes a member.
template <FrictionLaw Law, Excitation E>
Ensemble run_ensemble(const Slider<Law>& slider, const E& excitation, const EnsembleOptions& options = {},
                      const Ensemble* start = nullptr) {
  return detail::run_ensemble(slider, excitation, options, start);
}

template <FrictionLaw Law, Excitation E>
Ensemble run_ensemble(const Law& law, const E& excitation, const EnsembleOptions& options = {},
                      const Ensemble* start = nullptr) {
  return run_ensemble(Slider<Law>(law), excitation, options, start);
}

/// The same for the linear system
///     x'' + zeta x' + wn^2 x = -n(t),                                                               thesis (4.2), 4.4
/// as `integrate` solves it, exactly. Options and answers are those of a slider on friction; `settle` is refused, for
/// it never comes to rest. Cost on one thread: 9 ns a sample under Gaussian excitation with steps of less than 1 / wn,
/// else 0.1 to 0.3 us.
template <Excitation E>
Ensemble run_ensemble(const ViscousSlider& slider, const E& excitation, const EnsembleOptions& options = {},
                      const Ensemble* start = nullptr) {
  if (options.settle)
    throw std::invalid_argument("run_ensemble: settle must be false, a ViscousSlider never comes to rest");
  return detail::run_ensemble(slider, excitation, options, start);
}

}  // namespace stickslip

#ifdef STICKSLIP_LIBRARY  // linked to: it holds these
namespace stickslip {
extern template class detail::MemberSimulator<Coulomb, GaussianExcitation>;
extern template class detail::MemberSimulator<Coulomb, PoissonPulses>;
extern template class detail::MemberSimulator<Caster, GaussianExcitation>;
extern template class detail::MemberSimulator<Caster, PoissonPulses>;
extern template class detail::ViscousSimulator<GaussianExcitation>;
extern template class detail::ViscousSimulator<PoissonPulses>;
}  // namespace stickslip
#endif
