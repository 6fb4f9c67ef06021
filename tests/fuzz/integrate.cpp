// One slider through one ground motion: `integrate` and all that must agree with it, against an integrator that shares
// nothing with it, on small problems of round numbers, loads at the level itself, grazes and extreme scales.
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "fuzz.hpp"
#include "stickslip/core.hpp"
#include "stickslip/sliding/histories.hpp"
#include "support/independent_slider.hpp"

using namespace stickslip;
using test::IndependentSlider;
using Real = IndependentSlider::Real;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double epsilon = std::numeric_limits<double>::epsilon();

struct Problem {
  bool caster = false;
  double forward = 1, backward = 1, reach = infinity, natural_frequency = 0;
  std::vector<double> acceleration{}, times{};  // times where they are uneven
  double dt = 1;
  Interpolation interpolation = Interpolation::linear;
  double displacement = 0, velocity = 0;
  bool settle = false;

  GroundMotion motion() const {
    return times.empty() ? GroundMotion(acceleration, dt, interpolation)
                         : GroundMotion(acceleration, times, interpolation);
  }
  double duration(std::size_t i) const { return times.empty() ? dt : times[i + 1] - times[i]; }
  Segment segment(std::size_t i) const {
    return {duration(i), acceleration[i], acceleration[interpolation == Interpolation::linear ? i + 1 : i]};
  }
  IndependentSlider independent() const {
    return {forward, backward, reach, natural_frequency, displacement, velocity};
  }
};

std::string hex(double value) {
  if (std::isinf(value)) return value > 0 ? "HUGE_VAL" : "-HUGE_VAL";
  char text[48];
  std::snprintf(text, sizeof text, "%a", value);
  return text;
}

std::string hex(const std::vector<double>& values) {
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(values.size(), 64); ++i) text += (i ? ", " : "") + hex(values[i]);
  return "{" + text + (values.size() > 64 ? ", ... " + std::to_string(values.size()) + " in all" : "") + "}";
}

/// As it is pasted into a test.
std::string code(const Problem& p) {
  const std::string law = p.caster ? "Caster(" + hex(p.forward) + ", " + hex(p.reach)
                                   : "Coulomb(" + hex(p.forward) + ", " + hex(p.backward);
  return "integrate(Slider(" + law + "), " + hex(p.natural_frequency) + "), GroundMotion(" + hex(p.acceleration) +
         ", " + (p.times.empty() ? hex(p.dt) : "std::vector<double>" + hex(p.times)) +
         ", Interpolation::" + (p.interpolation == Interpolation::linear ? "linear" : "constant") +
         "), {.displacement = " + hex(p.displacement) + ", .velocity = " + hex(p.velocity) +
         ", .settle = " + (p.settle ? "true" : "false") + "})";
}

struct Finding : std::runtime_error {
  using std::runtime_error::runtime_error;
};
struct Skip {};  // a problem that is right to take long

[[noreturn]] void fail(const Problem& problem, const std::string& what) {
  throw Finding(what + "\n  " + code(problem));
}

std::string versus(Real got, Real expected, Real tolerance) {
  char text[160];
  std::snprintf(text, sizeof text, ": %.17Lg, expected %.17Lg, off by %.3Lg, may be off by %.3Lg", got, expected,
                std::abs(got - expected), tolerance);
  return text;
}

/// @param what  returns the name of the compared quantity
template <class Name>
void close(const Problem& p, const Name& what, double got, Real expected, Real tolerance) {
  if (std::isfinite(got) && !(std::abs(Real(got) - expected) > tolerance)) return;
  fail(p, what() + versus(got, expected, tolerance));
}

/// The state at a sample.
struct Bound {
  Real x, v, x_error, v_error;
};

void close(const Problem& p, const char* who, std::size_t i, double x, double v, const Bound& b, Real factor = 1) {
  const auto at = [&](const char* what) { return std::string(who) + ": " + what + " at sample " + std::to_string(i); };
  close(
      p, [&] { return at("displacement"); }, x, b.x, factor * b.x_error);
  close(
      p, [&] { return at("velocity"); }, v, b.v, factor * b.v_error);
}

/// The result of `advance` over a motion; stops it if it does not end.
struct Watcher {
  const Problem& problem;
  std::size_t segment = 0, max_slides = 1000;
  struct Seen {
    std::size_t segment;
    double time;
    State state;
    EventKind kind;
  };
  std::vector<Seen> events{};
  std::size_t slides = 0, at_once = 0;
  bool extreme = false;  // may take long

  void begin(std::size_t i) { segment = i, slides = at_once = 0; }
  void slide(const Slip& slip) {
    if (!(slip.distance >= 0)) fail(problem, "a slip of " + hex(slip.distance) + " m");
    at_once = slip.duration > 0 ? 0 : at_once + 1;
    const auto where = [&] { return " in segment " + std::to_string(segment); };
    if (at_once > 100 && !extreme) fail(problem, "slips of no duration without end" + where());
    if (++slides <= max_slides) return;
    if (extreme) throw Skip();
    fail(problem, "more than " + std::to_string(max_slides) + " slips" + where());
  }
  void event(EventKind kind, double time, const State& state) { events.push_back({segment, time, state, kind}); }
};

/// Events follow one another as they can, in order of time and within the motion.
void check_events(const Problem& p, const Response& r, double begin) {
  bool sliding = false;
  double time = begin;
  for (std::size_t i = 0; i < r.events.size(); ++i) {
    const Event& e = r.events[i];
    const bool last = i + 1 == r.events.size();
    const auto which = [&] { return "event " + std::to_string(i) + " at " + hex(e.time); };
    if (!(e.time >= time)) fail(p, which() + " comes after one at " + hex(time));
    if ((e.kind == EventKind::end) != last) fail(p, which() + " is the end, or the end is missing");
    if (!last && (e.kind == EventKind::breakaway) == sliding) fail(p, which() + " cannot follow");
    if (i > 0 && !last && e.velocity != 0) fail(p, which() + " has a velocity");
    if (!last) sliding = e.kind != EventKind::arrest;
    if (std::abs(e.displacement) > r.peak) fail(p, which() + " lies beyond the peak");
    time = e.time;
  }
  if (r.events.empty() || sliding != (r.state.mode != Mode::stuck)) fail(p, "the last event does not fit the state");
}

template <class Law>
Slider<Law> slider_of(const Problem& p) {
  if constexpr (std::same_as<Law, Caster>)
    return Slider(Caster(p.forward, p.reach), p.natural_frequency);
  else
    return Slider(Coulomb(p.forward, p.backward), p.natural_frequency);
}

IntegrateOptions options_of(const Problem& p) {
  IntegrateOptions options;
  options.displacement = p.displacement, options.velocity = p.velocity, options.settle = p.settle;
  options.progress = [&p, calls = 0]() mutable {
    if (++calls > 100) fail(p, "no end after 100 progress calls");
  };
  return options;
}

/// To settle takes few swings.
bool settles_soon(const Problem& p, const IndependentSlider& s) {
  if (p.natural_frequency == 0) return !p.caster && std::abs(s.v) + s.v_error < 1e9 * std::min(p.forward, p.backward);
  if (p.natural_frequency < 1e-6) return false;
  const Real swing = std::max(std::abs(s.x), std::abs(s.v) / p.natural_frequency);
  const Real held = std::min(p.forward, p.backward) / std::cosh(swing / Real(p.reach));
  return swing * p.natural_frequency * p.natural_frequency < 100 * held;
}

template <class Law>
class Check {
 public:
  explicit Check(Problem problem)
      : p_(std::move(problem)), slider_(slider_of<Law>(p_)), motion_(p_.motion()), watcher_{p_} {}

  void run(unsigned extra) {
    own_loop();
    const IndependentSlider independent = compare();
    if (!(independent.largest < 1e290L)) {
      p_.settle = false;
      return overflows();
    }
    p_.settle =
        p_.settle && settles_soon(p_, independent) && !extreme({1, 0, 0}, static_cast<double>(std::abs(independent.v)));
    const Response response = whole(slider_, motion_, options_of(p_));
    same_as_own_loop(response);
    account(response, independent);
    if (p_.displacement == 0 && p_.velocity == 0) agree(response);
    switch (extra % 4) {
      case 0:
        return scaled(response, -1, 1);
      case 1:
        return scaled(response, std::ldexp(1.0, static_cast<int>(extra / 4 % 64) - 32), 1);
      case 2:
        return scaled(response, 1, std::ldexp(1.0, static_cast<int>(extra / 4 % 32) - 16));
      default:
        return split();
    }
  }

  /// A long record: in order, and by pieces where `integrate` does that.
  void run_long() {
    const IndependentSlider independent = compare_samples();
    if (!(independent.largest < 1e290L)) return;
    p_.settle = p_.settle && settles_soon(p_, independent);
    const Response one = detail::integrate_in_order(slider_, motion_, options_of(p_)),
                   other = integrate(slider_, motion_, options_of(p_));
    check_events(p_, one, motion_.time(0));
    check_events(p_, other, motion_.time(0));
    samples("integrate in order", one.displacement, one.velocity);
    samples("integrate", other.displacement, other.velocity);
    account(one, independent);
    account(other, independent);
    if (p_.displacement != 0 || p_.velocity != 0) return;
    const Histories h = histories(slider_, motion_);
    samples("histories", h.displacement, h.velocity);
  }

 private:
  template <class... Arguments>
  Response whole(const Arguments&... arguments) const {
    try {
      return integrate(arguments...);
    } catch (const std::overflow_error& error) {
      fail(p_, error.what());
    } catch (const ConvergenceError& error) {
      fail(p_, error.what());
    }
  }

  void own_loop() {
    // Without a spring five events at most; each half period of it brings two more.
    State state = State::at(p_.displacement, p_.velocity);
    states_.assign(1, state);
    for (std::size_t i = 0; i < motion_.segments(); ++i) {
      go(i, p_.segment(i), state);
      states_.push_back(state);
    }
  }

  void go(std::size_t i, const Segment& segment, State& state) {
    watcher_.begin(i);
    const double swings = p_.natural_frequency * segment.duration;
    if (swings > (p_.caster ? 100 : 1e4)) throw Skip();
    watcher_.max_slides = (p_.caster ? 20'000 : 20) + static_cast<std::size_t>(2 * swings);
    watcher_.extreme = extreme(segment, std::abs(state.velocity));
    try {
      advance(slider_, segment, state, watcher_);
    } catch (const ConvergenceError& error) {
      if (!watcher_.extreme) fail(p_, error.what());
      throw Skip();
    }
    if (std::isfinite(state.displacement) && !(state.velocity * static_cast<double>(state.mode) >= 0))
      fail(p_, "a velocity against the mode, after segment " + std::to_string(i));
    if (state.mode == Mode::stuck && state.velocity != 0) fail(p_, "a velocity where it is stuck");
  }

  /// Where a power series of a caster may over- or underflow.
  bool extreme(const Segment& s, double speed) const {
    if (s.duration < 1e-150 || p_.reach < 1e-250) return p_.caster;
    const double load = std::max({p_.forward, std::abs(s.start), std::abs(s.end)});
    return p_.caster && std::max({p_.natural_frequency * s.duration, load * s.duration * s.duration / p_.reach,
                                  speed * s.duration / p_.reach}) > 1e9;
  }

  void at_sample(const IndependentSlider& s) { bounds_.push_back({s.x, s.v, s.x_error, s.v_error}); }

  IndependentSlider compare_samples() {
    IndependentSlider independent = p_.independent();
    independent.max_steps = 1'000'000;
    at_sample(independent);
    for (std::size_t i = 0; i < motion_.segments(); ++i) {
      const Segment s = p_.segment(i);
      independent.advance(s.duration, s.start, s.end, std::array<Real, 0>(), [](std::size_t) {});
      at_sample(independent);
    }
    return independent;
  }

  IndependentSlider compare() {
    IndependentSlider independent = p_.independent();
    at_sample(independent);
    std::vector<Real> times;
    std::size_t next = 0;
    for (std::size_t i = 0; i < motion_.segments(); ++i) {
      const Segment s = p_.segment(i);
      times.clear();
      const std::size_t first = next;
      for (; next < watcher_.events.size() && watcher_.events[next].segment == i; ++next)
        times.push_back(watcher_.events[next].time);
      if (!std::is_sorted(times.begin(), times.end()) || (!times.empty() && times.back() > s.duration))
        fail(p_, "events out of order in segment " + std::to_string(i));
      independent.advance(s.duration, s.start, s.end, times, [&](std::size_t k) {
        if (!(independent.largest < 1e290L)) return;
        const auto& e = watcher_.events[first + k];
        const auto event = [&](const char* what) {
          return "event " + std::to_string(first + k) + " at " + hex(e.time) + " of segment " + std::to_string(i) +
                 ": " + what;
        };
        const Real late = independent.time_error();
        close(
            p_, [&] { return event("velocity"); }, e.state.velocity, independent.v, independent.v_error + late);
        close(
            p_, [&] { return event("displacement"); }, e.state.displacement, independent.x,
            independent.x_error + (std::abs(independent.v) + late) * 32 * epsilon * Real(s.duration));
      });
      at_sample(independent);
      if (!(independent.largest < 1e290L)) return independent;
      close(p_, "advance", i + 1, states_[i + 1].displacement, states_[i + 1].velocity, bounds_.back());
    }
    if (independent.clear) {
      bool same = independent.events.size() == watcher_.events.size();
      for (std::size_t i = 0; same && i < watcher_.events.size(); ++i)
        same = independent.events[i] == watcher_.events[i].kind;
      if (!same) fail(p_, "events " + kinds(watcher_.events) + ", expected " + kinds(independent.events));
    }
    return independent;
  }

  static char letter(EventKind kind) { return "brae"[static_cast<int>(kind)]; }
  static std::string kinds(const std::vector<EventKind>& events) {
    std::string text;
    for (const EventKind kind : events) text += letter(kind);
    return '"' + text + '"';
  }
  static std::string kinds(const std::vector<Watcher::Seen>& events) {
    std::string text;
    for (const auto& e : events) text += letter(e.kind);
    return '"' + text + '"';
  }

  /// Beyond the range of doubles an answer that is finite, or the error that says so.
  void overflows() const {
    try {
      static_cast<void>(integrate(slider_, motion_, options_of(p_)));
    } catch (const std::overflow_error&) {
    } catch (const ConvergenceError&) {
    }
  }

  void samples(const char* who, const std::vector<double>& x, const std::vector<double>& v) const {
    for (std::size_t i = 0; i < bounds_.size(); ++i) close(p_, who, i, x[i], v[i], bounds_[i]);
  }

  void same_as_own_loop(const Response& r) {
    for (std::size_t i = 0; i < states_.size(); ++i)
      if (r.displacement[i] != states_[i].displacement || r.velocity[i] != states_[i].velocity)
        fail(p_, "integrate differs from a loop over advance at sample " + std::to_string(i));
    check_events(p_, r, motion_.time(0));
    std::size_t k = p_.velocity != 0 ? 1 : 0;  // a slip that is under way
    for (const auto& seen : watcher_.events) {
      if (k >= r.events.size()) fail(p_, "integrate has fewer events than a loop over advance");
      const Event& e = r.events[k++];
      const double time = motion_.time(seen.segment) + seen.time;
      if (e.kind != seen.kind || e.displacement != seen.state.displacement || e.velocity != seen.state.velocity ||
          std::abs(e.time - time) > 2 * epsilon * std::abs(time))
        fail(p_, "integrate differs from a loop over advance at event " + std::to_string(k - 1));
    }
    if (!p_.settle && k + 1 != r.events.size()) fail(p_, "integrate has more events than a loop over advance");
  }

  void account(const Response& r, IndependentSlider s) const {
    const std::size_t n = motion_.samples();
    if (p_.settle) {
      settle(r, s);
      const bool at_rest = r.displacement.back() == r.residual && r.velocity.back() == 0;
      if (!r.truncated && !at_rest && !(r.displacement.size() == n && r.events.back().time <= motion_.time(n - 1)))
        fail(p_, "the last sample is not the rest");
    }
    if (r.velocity.size() != r.displacement.size() || r.displacement.size() < n ||
        (!p_.settle && r.displacement.size() != n))
      fail(p_, std::to_string(r.displacement.size()) + " samples");
    if (!(s.largest < 1e290L)) return;
    const auto same = [&](const char* what, double got, Real expected, Real tolerance) {
      close(
          p_, [&] { return std::string(what); }, got, expected, tolerance);
    };
    same("residual", r.residual, s.x, s.x_error);
    same("peak", r.peak, s.peak, s.peak_error + s.x_error);
    // Sums of `terms` terms; the bounds allow each 32 roundings.
    const Real terms = Real(n + r.events.size()), sums = 1 + terms / 32, least = 0x1p-1000L;
    const Energy& e = r.energy;
    same("sliding distance", r.sliding_distance, s.path, sums * (s.path_error + 32 * epsilon * s.path));
    same("input", e.input, s.input, sums * (s.input_error + least));
    same("dissipated", e.dissipated, s.dissipated, sums * (s.dissipated_error + least));
    const Real turnover = Real(e.initial) + std::abs(e.input) + e.dissipated + e.elastic;
    same("imbalance", e.imbalance(), 0, sums * (s.imbalance + least + 32 * epsilon * turnover));
    const Real lasts = r.events.back().time - Real(motion_.time(0));
    if (!(r.time_sliding >= 0) || !(r.time_sliding <= lasts + 1e-12L * (lasts + std::abs(motion_.time(0)) + p_.settle)))
      fail(p_, "it slides for " + hex(r.time_sliding) + " s");
  }

  void settle(const Response& r, IndependentSlider& s) const {
    double duration = 1;
    do s.advance(duration, 0, 0, std::array<Real, 0>(), [](std::size_t) {});
    while (s.direction != 0 && (duration *= 2) <= 0x1p40);
    if (r.state.mode != Mode::stuck) fail(p_, "settled, and slides");
    if (!s.clear && p_.natural_frequency > 0) {  // the last creep, under next to no force
      const Real stiffness = Real(p_.natural_frequency) * p_.natural_frequency,
                 level = std::min(p_.forward, p_.backward);
      const Real creep = 64 * epsilon * (std::abs(s.x) + level / stiffness);
      s.x_error += creep, s.path_error += creep;
      s.input_error += creep * level, s.dissipated_error += creep * level;
    }
    const Real pull = Real(p_.natural_frequency) * p_.natural_frequency * r.residual;
    const Real level = p_.caster ? p_.forward / std::cosh(Real(r.residual) / p_.reach)
                                 : Real(r.residual > 0 ? p_.backward : p_.forward);
    if (std::abs(pull) >
        level * (1 + 8 * epsilon * (1 + (p_.caster ? std::abs(r.residual / p_.reach) : 0))) + 0x1p-1000)
      fail(p_, "settled where friction does not hold the spring");
  }

  void agree(const Response& r) const {
    try {
      const Histories h = histories(slider_, motion_);
      const std::size_t n = motion_.samples();  // integrate continues if it settles
      if (!std::equal(h.displacement.begin(), h.displacement.end(), r.displacement.begin(),
                      r.displacement.begin() + n) ||
          !std::equal(h.velocity.begin(), h.velocity.end(), r.velocity.begin(), r.velocity.begin() + n))
        fail(p_, "histories differs from integrate");
    } catch (const ConvergenceError& error) {
      fail(p_, std::string("histories: ") + error.what());
    }
  }

  /// All accelerations times `alpha`, all times times `tau`: powers of two, except for the sign.
  void scaled(const Response& r, double alpha, double tau) const {
    const auto tame = [](double value) { return value == 0 || (std::abs(value) > 1e-30 && std::abs(value) < 1e30); };
    bool possible = tame(p_.displacement) && tame(p_.velocity) && tame(p_.natural_frequency) && tame(p_.forward);
    for (const double n : p_.acceleration) possible = possible && tame(n);
    for (std::size_t i = 0; i < motion_.segments(); ++i) possible = possible && tame(p_.duration(i));
    if (alpha == -1)
      possible = !std::isinf(p_.backward);  // with any numbers
    else if (p_.caster && !std::isinf(p_.reach))
      possible = possible && tame(p_.reach) && r.peak < 500 * p_.reach;
    if (!possible || (tau != 1 && p_.settle)) return;
    Problem other = p_;
    const double length = alpha * tau * tau, speed = alpha * tau, energy = speed * speed;
    for (double& n : other.acceleration) n *= alpha;
    for (double& t : other.times) t *= tau;
    other.dt *= tau;
    other.natural_frequency /= tau;
    other.displacement *= length, other.velocity *= speed;
    other.forward *= std::abs(alpha), other.backward *= std::abs(alpha), other.reach *= std::abs(length);
    if (alpha < 0) std::swap(other.forward, other.backward);
    const Response o = whole(slider_of<Law>(other), other.motion(), options_of(other));
    bool same = o.events.size() == r.events.size() && o.displacement.size() == r.displacement.size() &&
                o.peak == r.peak * std::abs(length) && o.residual == r.residual * length &&
                o.sliding_distance == r.sliding_distance * std::abs(length) && o.time_sliding == r.time_sliding * tau &&
                o.energy.input == r.energy.input * energy && o.energy.dissipated == r.energy.dissipated * energy;
    for (std::size_t i = 0; same && i < r.displacement.size(); ++i)
      same = o.displacement[i] == r.displacement[i] * length && o.velocity[i] == r.velocity[i] * speed;
    for (std::size_t i = 0; same && i < r.events.size(); ++i) {
      const Event &a = o.events[i], &b = r.events[i];
      same = a.kind == b.kind && a.time == b.time * tau && a.displacement == b.displacement * length &&
             a.velocity == b.velocity * speed;
    }
    if (!same)
      fail(p_, alpha < 0 ? std::string("the mirrored problem has another answer")
                         : "another answer with accelerations times " + hex(alpha) + ", times times " + hex(tau));
  }

  /// A sample more on the line of each segment.
  void split() {
    const std::vector<State> states = states_;
    State state = states_.front();
    for (std::size_t i = 0; i < motion_.segments(); ++i) {
      const auto [duration, start, end] = p_.segment(i);
      const double half = duration / 2, middle = start / 2 + end / 2;
      if (half + half != duration) return;
      go(i, {half, start, start == end ? end : middle}, state);
      go(i, {half, start == end ? start : middle, end}, state);
      close(p_, "segments in halves", i + 1, state.displacement, state.velocity, bounds_[i + 1], 4);
    }
  }

  Problem p_;
  Slider<Law> slider_;
  GroundMotion motion_;
  Watcher watcher_;
  std::vector<State> states_{};
  std::vector<Bound> bounds_{};
};

/// Reads bytes; zeros when they are used up.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  unsigned next() { return at_ < size_ ? data_[at_++] : 0; }
  template <std::size_t N>
  double one_of(const double (&values)[N]) {
    return values[next() % N];
  }
  double fraction() {
    const unsigned high = next();
    return high * 0x1p-8 + next() * 0x1p-16 + next() * 0x1p-53;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_, at_ = 0;
};

/// Where the slider is at the last sample of a problem that grows.
class Follower {
 public:
  explicit Follower(const Problem& p) : p_(p), slider_(p.independent()) {}

  const IndependentSlider& at_last_sample() {
    try {
      for (; known_ + 1 < p_.acceleration.size(); ++known_) {
        const Segment s = p_.segment(known_);
        slider_.advance(s.duration, s.start, s.end, std::array<Real, 0>(), [](std::size_t) {});
      }
    } catch (const IndependentSlider::TooLong&) {
    }
    return slider_;
  }

 private:
  const Problem& p_;
  IndependentSlider slider_;
  std::size_t known_ = 0;
};

/// The next sample.
double sample(Bytes& bytes, const Problem& p, Follower& follower, double unit, double duration) {
  const auto& n = p.acceleration;
  const double forward = p.forward > 0 ? p.forward : unit;
  const double backward = p.backward > 0 && !std::isinf(p.backward) ? p.backward : unit;
  const double last = n.empty() ? 0 : n.back(), before = n.size() < 2 ? last : n[n.size() - 2];
  const auto within_a_slip = [&](bool to_the_end) {  // the line that grazes v = 0, or stops at its end
    const IndependentSlider& s = follower.at_last_sample();
    const Real w = p.natural_frequency, direction = s.direction, u = std::abs(s.v);
    const Real level = (s.direction > 0 ? p.forward : p.backward) / std::cosh(s.x / Real(p.reach));
    const Real a = direction * (-Real(last) - w * w * s.x) - level;
    const Real rate =
        to_the_end ? -2 * (u + a * duration) / (Real(duration) * duration) : w * w * u / 2 + a * a / (2 * u);
    const double value = static_cast<double>(last - direction * rate * duration);
    return u > 0 && std::abs(value) < 1e4 * (unit + std::abs(last)) ? value : last;
  };
  switch (const unsigned kind = bytes.next() % 40) {
    case 0:
      return 0;
    case 1:
      return -0.0;
    case 2:
      return forward;
    case 3:
      return -forward;
    case 4:
      return std::nextafter(-forward, -infinity);
    case 5:
      return std::nextafter(-forward, 0.0);
    case 6:
      return std::nextafter(backward, infinity);
    case 7:
      return std::nextafter(backward, 0.0);
    case 8:
      return backward;
    case 9:
      return -2 * forward;
    case 10:
      return 2 * backward;
    case 11:
      return -forward / 2;
    case 12:
      return backward / 2;
    case 13:
    case 14:
      return -3 * forward;
      return 1.5 * backward;
    case 15:
      return last;
    case 16:
      return -last;
    case 17:
      return 2 * last - before;
    case 18:
    case 19:
      return within_a_slip(false);
    case 20:
      return std::nextafter(within_a_slip(false), infinity);
    case 21:
      return std::nextafter(within_a_slip(false), -infinity);
    case 22:
      return within_a_slip(true);
    case 23:
      return std::nextafter(within_a_slip(true), infinity);
    case 24:
      return 1e3 * unit;
    case 25:
      return -1e3 * unit;
    case 26:
      return 1e-8 * unit;
    case 27:
      return -1e8 * unit;
    case 28:
      return 0x1p-1074;
    case 29:
      return -0x1p-1074;
    case 30:
      return 1e-300;
    case 31:
    case 32: {  // the net load at the level
      const IndependentSlider& s = follower.at_last_sample();
      const Real pull = Real(p.natural_frequency) * p.natural_frequency * s.x;
      const Real at_the_level = kind == 31 ? -forward - pull : backward - pull;
      return std::abs(at_the_level) < 1e99L ? static_cast<double>(at_the_level) : last;
    }
    case 33:
    case 34:
      return (bytes.fraction() - 0.5) * 10 * unit;
    default:
      return (static_cast<int>(bytes.next()) - 128) / 32.0 * unit;
  }
}

Problem read(Bytes& bytes) {
  constexpr double tiny = std::numeric_limits<double>::denorm_min(), huge = std::numeric_limits<double>::max();
  const unsigned flags = bytes.next(), law = bytes.next();
  Problem p;
  p.caster = law % 64 == 63;  // they take long
  double scale =
      flags & 3
          ? 1
          : bytes.one_of({1, 0.1, 9.80665, 1e-5, 1e-100, 1e-150, 1e-165, 1e-200, 1e-250, 1e-280, 1e10, 1e50, 1e90});
  if (p.caster) scale = std::max(scale, 1e-200);  // the series has absolute limits
  double pace = (flags ^ 7) & 15 ? 1 : bytes.one_of({1, 1e-3, 1e3, 1e-10, 1e10, 1e-100, 1e-140, 1e80});
  if (p.caster) pace = std::max(pace, 1e-30);
  p.interpolation = flags & 16 ? Interpolation::constant : Interpolation::linear;
  p.settle = flags & 32;
  const bool uneven = flags & 64;
  const double unit = scale * bytes.one_of({1, 1, 0.5, 0.1, 0.3, 2, 0x1p-20});
  p.dt = pace * bytes.one_of({0.1, 0.01, 0.25, 1});
  p.forward = p.backward = unit;
  switch (law % 16) {
    case 7:
    case 8:
      p.backward = unit * bytes.one_of({2, 0.5, 1e6, 1.1, 0});
      break;
    case 9:
    case 10:
      p.backward = infinity;
      break;
    case 11:
    case 12:
      p.forward = p.backward = 0;
      break;
    case 13:
    case 14:
      p.forward = p.backward = scale * bytes.fraction();
      break;
    case 15:
      if (!p.caster) break;
      p.reach = unit * p.dt * p.dt * bytes.one_of({1, 10, 1e-3, 1e-8, 1e10, infinity, 0.1, 100, 1e-100, tiny, huge});
      if (bytes.next() % 16 == 0) p.reach = bytes.one_of({1, tiny, huge, 1e-300, 1e300});
      if (!(p.reach > 0)) p.reach = 1;
      if (bytes.next() % 16 == 0) p.forward = p.backward = 0;
  }
  if (flags & 128)
    p.natural_frequency = bytes.one_of({1, 1, 3.141592653589793, 6.283185307179586, 1e-8, 1e-3, 0.1, 0.1, 0.5, 0.5,
                                        1.4142135623730951, 2, 1e-4, 3e-2, 0.2, 0.3}) /
                          p.dt;
  if (flags & 128 && bytes.next() % 16 == 0) p.natural_frequency = bytes.one_of({1, 1e-8, 10, 1e3, 1e-100, 1e2}) / pace;
  if (p.caster) p.natural_frequency = std::min(p.natural_frequency, 2 / p.dt);  // which keeps it quick
  const auto signed_unit = [&] {
    return bytes.next() & 1 ? 0.0
                            : bytes.one_of({1, -1, 0.5, -2, 0.669, -1e-3, 1e-8, 1e6, tiny, -tiny, -0.1, 3, 1e-16});
  };
  p.displacement = unit * p.dt * p.dt * signed_unit();
  p.velocity = unit * p.dt * signed_unit();
  if (p.natural_frequency > 0 && bytes.next() % 8 == 0)
    p.displacement = (bytes.next() & 1 ? p.forward : -p.forward) / (p.natural_frequency * p.natural_frequency);
  if (!std::isfinite(p.displacement)) p.displacement = 0;
  if (std::isinf(p.backward)) p.velocity = std::abs(p.velocity);  // the other way is refused
  Follower follower(p);
  const unsigned few = 1 + bytes.next() % 4, samples = 2 + bytes.next() % (p.caster ? 4 : 11) * few / 4;
  double time = uneven ? bytes.one_of({0, 0, 0, 1, -5, 100}) * pace : 0;
  for (unsigned i = 0; i < samples; ++i) {
    double duration = p.dt;
    if (uneven && i > 0) {
      double later = time + p.dt * bytes.one_of({1, 1, 0.5, 0.25, 2, 3, 0.1, 0.7, 1e-9, 1e-16, 1e-100, 0, 0});
      if (bytes.next() % 16 == 0) later = time + 1e-300;
      if (later == time && (p.interpolation == Interpolation::linear || bytes.next() % 2 == 0))
        later = std::nextafter(time, infinity);
      duration = later - time;
      time = later;
    }
    p.acceleration.push_back(sample(bytes, p, follower, unit, duration));
    if (uneven) p.times.push_back(time);
  }
  return p;
}

/// A segment that is not finite is refused.
void check_refusal(Bytes& bytes) {
  const double infinite = bytes.one_of({infinity, -infinity, std::numeric_limits<double>::quiet_NaN()});
  Segment segment{1, bytes.one_of({0, 2, -2}), bytes.one_of({0, 2, -2})};
  switch (bytes.next() % 3) {
    case 0:
      segment.duration = infinite;
      break;
    case 1:
      segment.start = infinite;
      break;
    default:
      segment.end = infinite;
      break;
  }
  Problem p;
  p.acceleration = {segment.start, segment.end};
  p.dt = segment.duration;
  p.natural_frequency = bytes.one_of({0, 1});
  p.velocity = bytes.one_of({0, 1, -1});
  p.caster = bytes.next() % 2;
  if (p.caster) p.reach = 1;
  State state = State::at(0, p.velocity);
  Watcher watcher{p};
  try {
    if (p.caster)
      advance(slider_of<Caster>(p), segment, state, watcher);
    else
      advance(slider_of<Coulomb>(p), segment, state, watcher);
  } catch (const std::invalid_argument&) {
    return;
  } catch (const ConvergenceError& error) {
    fail(p, error.what());
  }
  fail(p, "advance takes a segment that is not finite");
}

}  // namespace

std::vector<std::string> fuzz_seeds() { return {}; }

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const unsigned extra = bytes.next() + 256 * bytes.next();
  if (extra == 0xFFFF || (extra & 0x3FF) == 7) check_refusal(bytes);
  Problem p = read(bytes);
  try {
    static_cast<void>(p.motion());
  } catch (const std::invalid_argument&) {
    return 0;  // times that do not increase, or accelerations beyond the range
  }
  if (p.velocity < 0 && std::isinf(p.backward)) return 0;  // refused
  const auto run = [&]<class Law>(std::type_identity<Law>) {
    Check<Law>(p).run(extra);
    if ((extra & 0x3FF) != 11 || p.natural_frequency != 0 || !p.times.empty() || p.caster) return;
    const std::vector<double> pattern = p.acceleration;
    for (std::size_t i = pattern.size(); i < 8192 + extra / 1024 * 32; ++i)
      p.acceleration.push_back(pattern[i % pattern.size()]);
    Check<Law>(p).run_long();
  };
  try {
    if (p.caster)
      run(std::type_identity<Caster>());
    else
      run(std::type_identity<Coulomb>());
  } catch (const Skip&) {
  } catch (const IndependentSlider::TooLong&) {
  }
  return 0;
}
