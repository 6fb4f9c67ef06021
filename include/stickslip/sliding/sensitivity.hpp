// Derivatives of a response with respect to a parameter.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/ground/segment.hpp"
#include "stickslip/numerics/gauss_legendre.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/sliding/advance.hpp"
#include "stickslip/sliding/detail/engine_of.hpp"
#include "stickslip/sliding/detail/friction_variation.hpp"
#include "stickslip/sliding/detail/recorder.hpp"
#include "stickslip/sliding/detail/run.hpp"
#include "stickslip/sliding/detail/sink.hpp"
#include "stickslip/sliding/integrate.hpp"
#include "stickslip/sliding/observer.hpp"
#include "stickslip/sliding/parameter.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip {

/// Derivatives of a response with respect to a parameter: [m], [m/s] per unit of the parameter.
struct Sensitivity {
  double peak = 0;      ///< of the peak displacement
  double residual = 0;  ///< of the displacement at the end
  double velocity = 0;  ///< of the velocity at the end

  friend bool operator==(const Sensitivity&, const Sensitivity&) = default;
};

namespace detail {

/// Direct effects of a unit change of the parameter on the mounting and the load.
struct Change {
  double stiffness = 0, damping = 0;
  bool slope = false, scale = false;
};

/// The impulse response psi of y'' + c y' + k y, its derivative, and that of a unit displacement, k >= 0, c >= 0.
struct Propagator {
  double psi, psi_rate, phi, phi_rate;

  Propagator(double k, double c, double t) noexcept {
    if (equal(k, 0) && equal(c, 0)) {
      psi = t, psi_rate = 1, phi = 1, phi_rate = 0;
      return;
    }
    const double square = c * c / 4 - k;
    double even, odd;  // exp(-c t / 2) times cosh(m t) and sinh(m t) / m
    const double z = square * t * t;
    if (std::abs(z) < 1e-2) {
      const double decay = c > 0 ? std::exp(-c / 2 * t) : 1;
      even = decay * (1 + z / 2 * (1 + z / 12 * (1 + z / 30 * (1 + z / 56 * (1 + z / 90)))));
      odd = decay * t * (1 + z / 6 * (1 + z / 20 * (1 + z / 42 * (1 + z / 72 * (1 + z / 110)))));
    } else if (square < 0) {
      const double w = std::sqrt(-square), decay = std::exp(-c / 2 * t);
      even = decay * std::cos(w * t);
      odd = decay * std::sin(w * t) / w;
    } else {
      const double m = std::sqrt(square), slow = std::exp(-k / (c / 2 + m) * t), fast = std::exp(-(c / 2 + m) * t);
      even = (slow + fast) / 2;
      odd = (slow - fast) / (2 * m);
    }
    psi = odd;
    psi_rate = even - c / 2 * odd;
    phi = even + c / 2 * odd;
    phi_rate = -k * odd;
  }
};

/// The solutions of y'' + c y' + k(t) y = 0 from (1, 0) and from (0, 1), where k is linear in time, as power series:
/// the free motions of a pendulum whose weight varies.
class WeighedPropagator {
 public:
  /// @param first, last  k at t = 0 and at the end
  WeighedPropagator(double c, double first, double last, double duration) : c_(c), duration_(duration) {
    const double stiff = duration * duration * first, stiffens = duration * duration * (last - first);
    for (const std::size_t i : {0U, 1U}) {
      auto& y = series_[i];
      y[i] = i == 0 ? 1 : duration;
      for (std::size_t n = 0; n + 2 < terms; ++n) {
        const auto order = static_cast<double>(n);
        y[n + 2] = -(c * duration * (order + 1) * y[n + 1] + stiff * y[n] + (n > 0 ? stiffens * y[n - 1] : 0)) /
                   ((order + 2) * (order + 1));
      }
    }
  }

  struct Values {
    double y[2], rate[2];
  };
  Values at(double t) const noexcept {
    Values result{};
    const double s = t / duration_;
    for (const std::size_t i : {0U, 1U}) {
      for (std::size_t n = terms; n-- > 0;) {
        result.rate[i] = result.rate[i] * s + result.y[i];
        result.y[i] = result.y[i] * s + series_[i][n];
      }
      result.rate[i] /= duration_;
    }
    return result;
  }
  /// What remains at the end, {y, y'}, of a unit velocity at time t; `now` and `last` are the values then and there.
  std::array<double, 2> of_push(double t, const Values& now, const Values& last) const noexcept {
    const double grows = std::exp(c_ * t);  // 1 / Wronskian
    return {grows * (now.y[0] * last.y[1] - last.y[0] * now.y[1]),
            grows * (now.y[0] * last.rate[1] - last.rate[0] * now.y[1])};
  }

 private:
  // The steps of a pendulum's flow are those of a Taylor series of this order or less.
  static constexpr std::size_t terms = 64;
  double c_, duration_;
  std::array<double, terms> series_[2]{};
};

/// Follows a slider and computes the variation of its motion: between events by the linear variational equation
///     dv' = dp - s d(a N+/g) - d(c) v - d(wn^2) x - c dv - wn^2 dx
/// (of a pendulum with wn^2 N+/g for wn^2; where the level a has a slope, d(a) contains that times dx),
/// with its propagator and Gauss-Legendre quadrature; at events by the jumps that result from the shift of their times.
template <FrictionLaw Law>
class VariationalMotion final : public Sink {
 public:
  static constexpr std::uint32_t work_per_report = NoRecorder::work_per_report;

  VariationalMotion(const Slider<Law>& slider, const GroundMotion& motion, const Change& change,
                    const FrictionVariation<Law>& friction, const State& start)
      : events_(max_events(motion.segments()), none_),
        slider_(slider),
        motion_(motion),
        pieces_(motion, slider.slope()),
        change_(change),
        friction_(friction),
        peak_(std::abs(start.displacement)),
        before_(start.mode) {
    friction_.begin(start);
  }

  void report_progress() const noexcept {}
  void begin_segment(double, double) {
    begin_piece(pieces_.segment(segment_), ground(segment_));
    ++segment_;
  }
  void pass(std::size_t segments) noexcept { segment_ += segments; }
  /// A segment after the motion.
  void begin_still(double duration) { begin_piece(load_segment(Segment{duration, 0, 0}, slider_.slope()), {}); }

  void slide(const Slip& slip, const SlipFlow& flow) override {
    const double s = sign(slip.direction), taken = slip.duration, c = slider_.damping();
    const bool needs_motion = !equal(change_.stiffness, 0) || !equal(change_.damping, 0) || spring().pendulum ||
                              FrictionVariation<Law>::depends_on_place;
    const LevelLine line = friction_.line(slip.direction, slip.from);
    const bool presses = load_.normal(time_ + taken / 2) > 0;
    double x = 0, v = 0;
    const auto weight_at = [&](double t) { return presses ? load_.normal(time_ + t) / standard_gravity : 0; };
    const auto stiffness_at = [&](double t) { return spring().under(weight_at(t)) + line.slope * weight_at(t); };
    const double stiffness = stiffness_at(0), stiffness_after = stiffness_at(taken);
    std::optional<WeighedPropagator> swings;
    WeighedPropagator::Values last{};
    if (!equal(stiffness, stiffness_after)) {
      swings.emplace(c, stiffness, stiffness_after, taken);
      last = swings->at(taken);
    }
    each_node(taken, [&](double t, double weight) {
      const double at = time_ + t, heavier = presses ? by_normal(at) / standard_gravity : 0;
      const Progress now = needs_motion ? flow.at(t) : Progress{};
      const double here = slip.from + s * now.distance;
      double force = by_load(at) - line.change_at(here) * weight_at(t) - line.at(here) * heavier;
      force -= (change_of_spring().under(weight_at(t)) + spring().rate(heavier)) * here;
      force -= change_.damping * s * now.speed;
      if (swings) {
        const auto [psi, psi_rate] = swings->of_push(t, swings->at(t), last);
        x += weight * psi * force;
        v += weight * psi_rate * force;
        return;
      }
      const Propagator rest(stiffness, c, taken - t);
      x += weight * rest.psi * force;
      v += weight * rest.psi_rate * force;
    });
    if (swings) {
      const auto [y, rate] = last;
      x += y[0] * dx_ + y[1] * dv_;
      v += rate[0] * dx_ + rate[1] * dv_;
    } else {
      const Propagator whole(stiffness, c, taken);
      x += whole.phi * dx_ + whole.psi * dv_;
      v += whole.phi_rate * dx_ + whole.psi_rate * dv_;
    }
    dx_ = x;
    dv_ = v;
    time_ += taken;
    direction_ = slip.direction;
    at_stop_ = false;
    arrives_ = line.at(slip.to());
    const LevelJump jump = friction_.slide(slip, dx_);
    if (!equal(jump.size, 0)) dv_ += jump.size * weight() * (jump.place - dx_) / (s * flow.at(taken).speed);
  }

  void event(EventKind kind, double time, const State& state) override {
    events_.event(kind, time, state);
    time_ = time;
    const double s = sign(direction_);
    const auto push = [&](double way, double speed) {  // acceleration during sliding in that direction
      const Direction direction = way > 0 ? Direction::forward : Direction::backward;
      const double force = direction == direction_ ? arrives_ : friction_.line(direction, state.displacement).value;
      return net(state.displacement) - force * weight() - slider_.damping() * way * speed;
    };
    switch (kind) {
      case EventKind::breakaway:
        if (before_ == Mode::stuck) break_away(state);
        break;
      case EventKind::reversal:
        if (!at_stop_) dv_ *= push(-s, 0) / push(s, 0);  // the jump at an impact includes this one
        break;
      case EventKind::arrest:
        dv_ = 0;
        if (at_wall(state.displacement)) dx_ = friction_.strike(state.displacement);
        break;
      case EventKind::impact: {
        const double wall = friction_.strike(state.displacement);
        note_peak(state.displacement, wall);
        const double e = slider_.mounting().stops.restitution(), speed = std::abs(state.velocity);
        const double before = push(s, speed), after = push(-s, e * speed);
        dv_ = -e * dv_ + (e * before + after) * (dx_ - wall) / state.velocity;
        dx_ = wall - e * (dx_ - wall);
        break;
      }
      case EventKind::liftoff:
      case EventKind::landing:
        throw std::invalid_argument(
            "sensitivity: the slider must not leave the ground, got a lift-off; use contact = clipped");
      case EventKind::end:
        break;
    }
    if (kind != EventKind::impact) note_peak(state.displacement, dx_);
    at_stop_ = kind == EventKind::impact;
    before_ = state.mode;
    if (kind == EventKind::reversal || kind == EventKind::breakaway) direction_ = direction_of(state.mode);
  }

  Sensitivity finish(const State& state) {
    note_peak(state.displacement, dx_);
    return {at_peak_, dx_, state.mode == Mode::stuck ? 0 : dv_};
  }

 private:
  /// Ground acceleration at both ends of a segment [m/s^2].
  struct Ground {
    double n_start = 0, n_end = 0, up_start = 0, up_end = 0;
  };
  Ground ground(std::size_t i) const {
    const Segment n = motion_.segment(i);
    if (!motion_.has_vertical()) return {n.start, n.end};
    const std::size_t next = motion_.interpolation() == Interpolation::linear ? 1 : 0;
    return {n.start, n.end, motion_.vertical()[i], motion_.vertical()[i + next]};
  }

  void begin_piece(const LoadSegment& load, const Ground& ground) {
    load_ = load;
    time_ = 0;
    const double sine = std::sin(slider_.slope()), cosine = std::cos(slider_.slope());
    const auto changes = [&](double n, double up) -> std::array<double, 2> {  // of p and N
      if (change_.scale) return {up * sine - n * cosine, up * cosine + n * sine};
      if (!change_.slope) return {0, 0};
      const double heavy = standard_gravity + up;
      constexpr double radians = std::numbers::pi / 180;
      return {radians * (heavy * cosine + n * sine), radians * (n * cosine - heavy * sine)};
    };
    const auto first = changes(ground.n_start, ground.up_start), last = changes(ground.n_end, ground.up_end);
    change_of_load_ = {load.duration, first[0], last[0], first[1], last[1]};
  }

  double by_load(double time) const noexcept { return change_of_load_.load(time); }
  double by_normal(double time) const noexcept { return change_of_load_.normal(time); }
  double weight() const noexcept { return std::max(load_.normal(time_), 0.0) / standard_gravity; }
  Spring spring() const noexcept { return slider_.mounting().spring(); }
  Spring change_of_spring() const noexcept { return {change_.stiffness, spring().pendulum}; }
  double net(double x) const noexcept { return load_.load(time_) - spring().under(weight()) * x; }
  bool at_wall(double x) const noexcept {
    const Stops& stops = slider_.mounting().stops;
    return equal(x, stops.forward()) || equal(x, -stops.backward());
  }

  /// Points and weights of the quadrature over a slip or a part of one.
  template <class Use>
  void each_node(double taken, Use&& use) const {
    // Six points integrate one cycle of the product of a motion and a propagator, each of this rate, to round-off.
    const double turns = 2 * taken * (rate_ + slider_.damping());
    const double panels = std::max(1.0, std::min(std::ceil(turns), 4096.0));
    for (double k = 0; k < panels; ++k)
      numerics::gauss_points<6>(taken * (k / panels), taken * ((k + 1) / panels), use);
  }

  /// The time at which the load reaches a static level depends on the parameter, and the slip begins with a jump of the
  /// acceleration. If the load itself jumps through the level, the time does not change.
  void break_away(const State& state) {
    const Direction direction = direction_of(state.mode);
    const double s = sign(direction), x = state.displacement, level = hold(law_at(slider_.law(), state), x, direction);
    const double held = level * weight(), jump = held - s * friction_.line(direction, x).value * weight();
    dv_ = 0;
    if (!(jump > 0) || s * net(x) - held > 1e-9 * held) return;
    const double duration = load_.duration, stiffness = spring().under(weight());
    const double heavier = (load_.normal_end - load_.normal_start) / duration / standard_gravity;
    const double rate =
        s * ((load_.load_end - load_.load_start) / duration - spring().rate(heavier) * x) - level * heavier;
    const double change_of_weight = by_normal(time_) / standard_gravity;
    const double pulls = (change_of_spring().under(weight()) + spring().rate(change_of_weight)) * x + stiffness * dx_;
    const double nearer = s * (by_load(time_) - pulls) -
                          friction_.change_of_hold() * load_.normal(time_) / standard_gravity -
                          level * change_of_weight;
    dv_ = s * jump * nearer / rate;
  }

  void note_peak(double x, double change) noexcept {
    if (!(std::abs(x) > peak_)) return;
    peak_ = std::abs(x);
    at_peak_ = x < 0 ? -change : change;
  }

  std::function<void()> none_{};
  NoRecorder events_;  // counts them
  const Slider<Law>& slider_;
  const GroundMotion& motion_;
  LoadPieces pieces_;
  Change change_;
  FrictionVariation<Law> friction_;
  double peak_;
  Mode before_;
  std::size_t segment_ = 0;
  LoadSegment load_{1, 0, 0, standard_gravity, standard_gravity}, change_of_load_{1, 0, 0, 0, 0};
  double time_ = 0, dx_ = 0, dv_ = 0, at_peak_ = 0;
  double rate_ = std::sqrt(slider_.stiffness() + friction_.steepest());  // of a free motion, at most [rad/s]
  double arrives_ = 0;                                                   // force of the law at the end of the last slip
  Direction direction_ = Direction::forward;
  bool at_stop_ = false;  // an impact, and no slip since
};

/// The effects of a parameter on the mounting and the load; rejects a parameter that the mounting does not have.
inline Change change_of(const Mounting& mounting, Parameter parameter) {
  Change change;
  switch (parameter) {
    case Parameter::natural_frequency:
      if (!(mounting.natural_frequency > 0))
        refuse_sensitivity("without a spring there is no derivative by natural_frequency");
      change.stiffness = 2 * mounting.natural_frequency;
      break;
    case Parameter::damping:
      change.damping = 1;
      break;
    case Parameter::slope:
      change.slope = true;
      break;
    case Parameter::scale:
      change.scale = true;
      break;
    default:  // of the law
      break;
  }
  return change;
}

}  // namespace detail

/// Derivatives of a response with respect to a parameter, by the variational equation between events and jumps of its
/// solution at events. With the direction s, the acceleration f, the rate of the load q', the levels at rest and during
/// sliding a_s and a_k, and x and v before the event:
///     slip        d(v') = dp - s d(a_k N+/g) - d(c) v - d(wn^2) x - c dv - wn^2 dx,  a pendulum: wn^2 N+/g for wn^2
///     arrest      dv = 0
///     reversal    dv jumps by the factor f+ / f-
///     breakaway   dv = -(a_s - a_k) (d(a_s) + s wn^2 dx) / (q' - s a_s'), on level ground
///     impact      dx = dX - e (dx - dX),  dv = -e dv + (e f- + f+) (dx - dX) / v,  at a stop that moves by dX
///     jump        dv = dv + (f- - f+) (dX - dx) / v, where the force of a MultiPendulum jumps at X
///     peak        d|x| = sgn(x) dx at its time
/// The level of a MultiPendulum is a line in x from one change of its moving elements to the next; d(a_k) contains its
/// slope times dx, and what the changes of its elements and of their turning points do. Changes at which the force does
/// not jump leave the variation continuous.
///
/// @param slider     Coulomb friction, also with a static level, or a MultiPendulum; any mounting
/// @param motion     its ground motion
/// @param response   the result of `integrate` for them
/// @param parameter  with respect to which to differentiate
/// @param surface    of a MultiPendulum, the index of its radius, mu or capacity; without it all change alike
/// @throws std::invalid_argument  another law; a parameter that the slider does not have; a slider that leaves the
///                                ground; a response that is not differentiable: a velocity that reverses, or a force
///                                that jumps, without acceleration
/// With static friction above kinetic friction the response jumps where a decision changes. The derivative applies
/// between such jumps; Margins state how close the next one is. Of two flat elements with equal mu that slide together
/// only the derivative by both mu is defined. Accuracy:
/// near round-off. Cost: 0.1 us per sample without spring and damper, 0.3 us with them, 2 us for a MultiPendulum and
/// for the natural frequency with a damper: 3 to 17 times that of `integrate`.
template <FrictionLaw Law>
Sensitivity sensitivity(const Slider<Law>& slider, const GroundMotion& motion, const Response& response,
                        Parameter parameter, std::optional<std::size_t> surface = {}) {
  if constexpr (!detail::DifferentiableLaw<Law>) {
    throw std::invalid_argument(
        "sensitivity: covers Coulomb friction, also with a static level, and a MultiPendulum; of another law, whose "
        "level changes during a slip, take differences of integrate");
  } else {
    const detail::Change change = detail::change_of(slider.mounting(), parameter);
    const detail::FrictionVariation<Law> friction(slider.law(), parameter, surface);
    const detail::EngineOf<Law> engine(slider);
    State state = engine.started(State::at(response.displacement.front(), response.velocity.front()));
    detail::VariationalMotion<Law> variation(slider, motion, change, friction, state);
    std::vector<double> x(motion.samples()), v(motion.samples());
    const detail::HistorySpans spans{{x, v}};
    detail::run_loaded(engine, motion, response.contact, state, variation, spans);
    if (response.events.back().time > motion.time(motion.segments()))
      detail::settle(engine, state, [&](double duration) {
        variation.begin_still(duration);
        detail::advance(engine, Segment{duration, 0, 0}, true, response.contact, state, variation);
      });
    const Sensitivity result = variation.finish(state);
    if (!std::isfinite(result.peak) || !std::isfinite(result.residual) || !std::isfinite(result.velocity))
      throw std::invalid_argument(
          "sensitivity: the response is not differentiable: a velocity comes to zero, or a load to a level, with no "
          "rate");
    return result;
  }
}

template <FrictionLaw Law>
Sensitivity sensitivity(const Law& law, const GroundMotion& motion, const Response& response, Parameter parameter,
                        std::optional<std::size_t> surface = {}) {
  return sensitivity(Slider<Law>(law), motion, response, parameter, surface);
}

}  // namespace stickslip
