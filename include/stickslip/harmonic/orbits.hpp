// Exact periodic motions of a slider under a harmonic ground motion, by shooting on the half-period map.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/ground/harmonic_motion.hpp"
#include "stickslip/harmonic/orbit.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/sliding/advance.hpp"
#include "stickslip/sliding/detail/balanced.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip {

namespace detail {

struct Matrix2 {
  double xx = 1, xv = 0, vx = 0, vv = 1;
};

/// Propagates a small change of the state through slips, reversals and stops (an observer).
///
/// Along a slip the flow supplies the variation. At a reversal x'' jumps from a to b, which multiplies a change of x'
/// by b/a: the saltation matrix is diag(1, b/a). At an arrest no change of x' remains: diag(1, 0). At breakaway the
/// change of the state remains as it is.
class Variation {
 public:
  explicit Variation(const State& state) {
    if (state.mode == Mode::stuck) jump(0);
  }

  Matrix2 matrix;          // derivative of (x, x') with respect to the initial (x, x')
  double determinant = 1;  // of the matrix: the product of all jumps, because a slip itself preserves area

  template <class Flow>
  void follow(const Flow& flow, double t) {
    if (turned_) jump(flow.acceleration() / -last_acceleration_);
    turned_ = false;
    const auto [xx, xv, vx, vv] = flow.variation(t);
    const Matrix2 m = matrix;
    matrix = {xx * m.xx + xv * m.vx, xx * m.xv + xv * m.vv, vx * m.xx + vv * m.vx, vx * m.xv + vv * m.vv};
    last_acceleration_ = flow.at(t).acceleration;
  }
  void slide(const Slip&) const noexcept {}
  void event(EventKind kind, double, const State&) noexcept {
    if (kind == EventKind::arrest) jump(0);
    turned_ = kind == EventKind::reversal;
  }

 private:
  void jump(double factor) noexcept {
    matrix.vx *= factor;
    matrix.vv *= factor;
    determinant *= factor;
  }

  double last_acceleration_ = 0;
  bool turned_ = false;
};

/// Collects the events of a motion and its work against friction (an observer).
template <FrictionLaw Law>
struct CycleRecorder {
  const Law& law;
  std::vector<Event> events{};
  double dissipated = 0;

  void slide(const Slip& slip) {
    dissipated += friction_work(law, slip.from, std::max(slip.distance, 0.0), slip.direction);
  }
  void event(EventKind kind, double time, const State& state) {
    events.push_back({time, state.displacement, state.velocity, kind});
  }
};

/// Finds the orbits of one slider under one load.
template <FrictionLaw Law, class Flows>
class OrbitFinder {
 public:
  OrbitFinder(const Slider<Law>& slider, const Flows& flows, double load, double omega)
      : slider_(slider), flows_(flows), load_(load), omega_(omega) {}

  /// The state of the slider at a phase of the load.
  struct Place {
    double phase;
    State state;
  };

  template <class Observer = const NoObserver>
  State after(const Place& from, double radians, Observer&& observer = {}) const {
    State state = from.state;
    typename Flows::Place moving(state);
    detail::advance(flows_, HarmonicSegment{radians / omega_, load_, omega_, from.phase}, moving, observer);
    store(moving, state);
    return state;
  }

  /// The mismatch of symmetry: the sum of the state and of the state half a period later, x in units of `scale` and x'
  /// in units of omega scale.
  struct Miss {
    double x, v;
    double size() const noexcept { return std::max(std::abs(x), std::abs(v)); }
  };
  Miss miss(const Place& from, const State& half_later, double scale) const noexcept {
    return {(from.state.displacement + half_later.displacement) / scale,
            (from.state.velocity + half_later.velocity) / (omega_ * scale)};
  }

  /// Newton's method on the half-period map; empty if it does not converge.
  std::optional<Place> shoot(Place place, double scale) const {
    Variation variation(place.state);
    State later = after(place, std::numbers::pi, variation);
    Miss now = miss(place, later, scale);
    for (int steps = 0; steps < 20; ++steps) {
      // (1 + M) change = -miss; scaled
      const auto [xx, xv, vx, vv] = variation.matrix;
      const double a = 1 + xx, b = xv * omega_, c = vx / omega_, d = 1 + vv, determinant = a * d - b * c;
      const double dx = (b * now.v - d * now.x) / determinant, dv = (c * now.x - a * now.v) / determinant;
      if (!(std::isfinite(dx) && std::isfinite(dv))) return std::nullopt;
      bool better = false;
      for (double part = 1; part > 0x1p-5; part /= 2) {
        const Place next{place.phase, State::at(place.state.displacement + part * dx * scale,
                                                place.state.velocity + part * dv * scale * omega_)};
        Variation next_variation(next.state);
        const State next_later = after(next, std::numbers::pi, next_variation);
        const Miss then = miss(next, next_later, scale);
        if (then.size() < now.size()) {
          place = next, later = next_later, now = then, variation = next_variation;
          better = true;
          break;
        }
        if (now.size() <= close_enough) break;
      }
      if (!better || equal(now.size(), 0)) break;
    }
    if (now.size() > close_enough) return std::nullopt;
    // A slider that is at rest here has a velocity of round-off size, which would cause one more arrest.
    if (later.mode == Mode::stuck && std::abs(place.state.velocity) <= close_enough * omega_ * scale)
      place.state = State::at(place.state.displacement, 0);
    return place;
  }

  /// All properties of the orbit through a place.
  Orbit describe(const Place& place) const {
    Orbit orbit{};
    orbit.load = load_;
    orbit.omega = omega_;
    constexpr double cycle = 2 * std::numbers::pi;
    const double period = orbit.period(), begin = cycle_part(place.phase / cycle) * period;
    orbit.state = begin > 0 ? after(place, (period - begin) * omega_) : place.state;

    CycleRecorder<Law> recorder{slider_.law()};
    after(place, cycle, recorder);
    orbit.dissipated = recorder.dissipated;
    orbit.events = std::move(recorder.events);
    for (Event& e : orbit.events) e.time = cycle_part((begin + e.time) / period) * period;
    std::stable_sort(orbit.events.begin(), orbit.events.end(),
                     [](const Event& a, const Event& b) { return a.time < b.time; });
    double low = infinity, high = -infinity, time = 0;
    for (const Event& e : orbit.events) {
      orbit.stops_per_cycle += e.kind == EventKind::arrest;
      orbit.reversals_per_cycle += e.kind == EventKind::reversal;
      if (e.kind == EventKind::breakaway) continue;
      low = std::min(low, e.displacement);
      if (e.displacement > high) high = e.displacement, time = e.time;
    }
    orbit.amplitude = (high - low) / 2;
    orbit.phase = -std::remainder(omega_ * time, cycle);
    orbit.mean_arbitrary = form_of<Law> == Form::constant && equal(slider_.stiffness(), 0);

    Variation variation(place.state);
    after(place, std::numbers::pi, variation);
    orbit.half_period_multipliers = eigenvalues(variation);
    double largest = 0;
    for (std::size_t i = 0; i < 2; ++i) {
      const std::complex<double> m = orbit.half_period_multipliers[i];
      orbit.multipliers[i] = m * m;
      largest = std::max(largest, std::abs(m));
    }
    orbit.stable = largest <= 1 + 1e-10;
    return orbit;
  }

  /// Eigenvalues of minus the matrix. The product of the jumps gives the determinant more accurately than the
  /// difference of products of the matrix.
  static std::array<std::complex<double>, 2> eigenvalues(const Variation& variation) {
    const double half = -(variation.matrix.xx + variation.matrix.vv) / 2, determinant = variation.determinant;
    const double discriminant = half * half - determinant;
    if (discriminant < 0) {
      const double other = std::sqrt(-discriminant);
      return {std::complex{half, other}, std::complex{half, -other}};
    }
    const double one = half + std::copysign(std::sqrt(discriminant), half);
    return {one, equal(one, 0) ? 0 : determinant / one};
  }

  // Largest mismatch of an orbit, relative to its amplitude. Newton's method continues while the mismatch is larger.
  static constexpr double close_enough = 1e-11;

  /// All symmetric orbits that the search finds, in order of amplitude.
  std::vector<Orbit> find(const std::function<void()>& progress) const {
    std::vector<Orbit> found;
    if (load_ <= level(0)) found.push_back(rest());
    if constexpr (form_of<Law> == Form::constant) {
      if (!found.empty()) return found;
      if (const auto orbit = without_stops()) {
        found.push_back(*orbit);
        return found;  // two motions never diverge under constant friction, but two orbits would
      }
      if (equal(slider_.stiffness(), 0)) return {with_stops()};
    }
    search(found, progress);
    std::sort(found.begin(), found.end(), [](const Orbit& a, const Orbit& b) { return a.amplitude < b.amplitude; });
    return found;
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  double level(double displacement) const { return slider_.law().resist(displacement, Direction::backward); }

  static double cycle_part(double cycles) noexcept {
    const double part = cycles - std::floor(cycles);
    return part < 1 ? part : 0;
  }

  Orbit rest() const {
    Orbit orbit{};
    orbit.load = load_;
    orbit.omega = omega_;
    orbit.phase = std::numeric_limits<double>::quiet_NaN();
    orbit.half_period_multipliers = {-1, 0};
    orbit.multipliers = {1, 0};
    orbit.stable = true;
    orbit.mean_arbitrary = form_of<Law> == Form::constant && equal(slider_.stiffness(), 0);
    return orbit;
  }

  // Den Hartog's orbit (1931). With the friction force +a during backward sliding, from x = A to -A,
  //     x = a/wn^2 (1 - cos wn t) + D sin wn t + G cos(omega t + theta),   G = B / (wn^2 - omega^2),
  //     D = -a/wn^2 tan(pi wn / 2 omega),  A = G cos(theta),  G omega sin(theta) = wn D;
  // This is an orbit if the slider neither stops nor reverses in between.
  std::optional<Orbit> without_stops() const {
    const double wn = slider_.natural_frequency(), angle = std::numbers::pi / 2 * (wn / omega_);
    const double tangent = wn > 0 ? std::tan(angle) / wn : std::numbers::pi / (2 * omega_);
    const double g = load_ / ((wn - omega_) * (wn + omega_));
    const double sine = -level(0) * tangent / (g * omega_);
    if (!(std::abs(sine) <= 1) || !std::isfinite(g)) return std::nullopt;
    const double cosine = std::copysign(std::sqrt((1 - sine) * (1 + sine)), g), amplitude = g * cosine;
    const double phase = std::atan2(sine, cosine);
    const State turned = after({phase, State::at(amplitude, 0)}, std::numbers::pi / 2);
    if (turned.mode != Mode::backward) return std::nullopt;
    const auto place = shoot({phase + std::numbers::pi / 2, turned}, amplitude);
    if (!place) return std::nullopt;
    const Orbit orbit = describe(*place);
    if (orbit.stops_per_cycle > 0 || std::abs(orbit.amplitude - amplitude) > 1e-6 * amplitude) return std::nullopt;
    return orbit;
  }

  // Without a spring the slider rests until the load exceeds friction, slips, and stops.
  Orbit with_stops() const {
    const double phase = -std::acos(level(0) / load_);
    const double way = after({phase, {}}, std::numbers::pi).displacement;
    return describe({phase - 0x1p-20, State::at(-way / 2, 0)});
  }

  // Every symmetric orbit reverses or stops at its maximum x, A > 0. It leaves this position at a phase theta at which
  // the load permits backward sliding. These phases form an arc; a slider that has stopped breaks away at the start of
  // the arc. The mismatch is computed on a grid over A and the arc. Newton's method starts in each triangle of the grid
  // in which both components of the linearly interpolated mismatch are zero. At the start of the arc the mismatch of x'
  // is zero, and only the mismatch of x must change sign. Two orbits near a fold may be closer to each other than the
  // grid spacing; Newton's method therefore also starts at local minima of the mismatch.
  void search(std::vector<Orbit>& found, const std::function<void()>& progress) const {
    const auto [least, largest] = amplitudes();
    const double usual = load_ / (omega_ * omega_ + slider_.stiffness());
    const double begin = std::max(least, 1e-5 * usual);
    const double step = std::min(std::pow(10.0, 1.0 / 12), std::pow(largest / begin, 1.0 / 30));  // at least 30 rows

    std::vector<Row> rows;
    if (equal(least, 0)) rows.push_back({.free = load_ > level(0), .misses = {{{-1, 0}}}});
    for (double amplitude = begin; amplitude < largest * step; amplitude *= step) {
      if (progress) progress();
      // Orbits without stops have amplitudes above 1e-3 usual.
      rows.push_back(row_at(amplitude, amplitude > 1e-3 * usual ? columns : 0));
    }
    for (std::size_t i = 1; i < rows.size(); ++i) {
      if (progress) progress();
      search_beginning(rows[i - 1], rows[i], found);
      if (rows[i - 1].columns == columns && rows[i].columns == columns) search_between(rows[i - 1], rows[i], found);
      if (i + 1 < rows.size()) search_dips(rows[i - 1], rows[i], rows[i + 1], found);
    }
  }

  static constexpr int columns = 20;

  /// The mismatch along the arc for one amplitude.
  struct Row {
    double amplitude = 0;
    bool free = false;          // whether the slider can slide backward from the amplitude
    double begin = 0, end = 0;  // phases at which the arc begins and ends [rad]
    int columns = 0;
    std::array<Miss, OrbitFinder::columns + 1> misses{{{2, 0}}};  // 2: the slider does not move from there

    double phase(double column) const noexcept { return begin + (end - begin) * (column / OrbitFinder::columns); }
  };

  // A motion that is too fast to be computed is not an orbit.
  Miss miss_from(double phase, double displacement) const {
    const Place turn{phase, State::at(displacement, 0)};
    try {
      return miss(turn, after(turn, std::numbers::pi), displacement);
    } catch (const ConvergenceError&) {
      return {2, 0};
    }
  }

  Row row_at(double amplitude, int wanted) const {
    Row row{.amplitude = amplitude};
    // The slider slides backward if the load is below `held`.
    const double held = slider_.stiffness() * amplitude - level(amplitude);
    row.free = held > -load_;
    if (!row.free) return row;
    const bool always = held >= load_;
    row.begin = always ? 0 : std::acos(held / load_);
    row.end = (always ? 2 : 2 - 1e-3) * std::numbers::pi - row.begin;  // no slip begins at the end of the arc itself
    row.columns = wanted;
    for (int j = 0; j <= wanted; ++j) row.misses[static_cast<std::size_t>(j)] = miss_from(row.phase(j), amplitude);
    return row;
  }

  // Search between two amplitudes, at the start of the arc, if their mismatches of x differ in sign.
  void search_beginning(const Row& before, const Row& row, std::vector<Orbit>& found) const {
    if ((before.misses[0].x > 0) == (row.misses[0].x > 0)) return;
    double low = before.amplitude, high = row.amplitude;
    Row middle = row;
    while (high - low > 1e-10 * high) {
      middle = row_at(low + (high - low) / 2, 0);
      ((middle.misses[0].x > 0) == (before.misses[0].x > 0) ? low : high) = middle.amplitude;
    }
    if (middle.free && middle.misses[0].size() < 1e-3) keep(middle.begin, middle.amplitude, found);
  }

  // Search the triangles between two rows in which the linearly interpolated mismatch is zero.
  void search_between(const Row& before, const Row& row, std::vector<Orbit>& found) const {
    struct Corner {
      const Row* row;
      std::size_t column;
    };
    const auto look = [&](const std::array<Corner, 3>& corners) {
      std::array<Miss, 3> m;
      for (std::size_t i = 0; i < 3; ++i) m[i] = corners[i].row->misses[corners[i].column];
      std::array<double, 3> weight;
      for (std::size_t i = 0; i < 3; ++i) {
        const Miss &a = m[(i + 1) % 3], &b = m[(i + 2) % 3];
        weight[i] = a.x * b.v - a.v * b.x;
      }
      const double sum = weight[0] + weight[1] + weight[2];
      for (double& w : weight) w /= sum;
      if (!(weight[0] >= 0 && weight[1] >= 0 && weight[2] >= 0)) return;
      double amplitude = 0, phase = 0, corner_miss = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        amplitude += weight[i] * corners[i].row->amplitude;
        phase += weight[i] * corners[i].row->phase(static_cast<double>(corners[i].column));
        corner_miss = std::max(corner_miss, m[i].size());
      }
      if (miss_from(phase, amplitude).size() < corner_miss) keep(phase, amplitude, found);
    };
    for (std::size_t j = 0; j < columns; ++j) {
      look({{{&before, j}, {&before, j + 1}, {&row, j + 1}}});
      look({{{&before, j}, {&row, j}, {&row, j + 1}}});
    }
  }

  // Search around the local minima of the mismatch in the middle row.
  void search_dips(const Row& before, const Row& row, const Row& after, std::vector<Orbit>& found) const {
    const auto beginning = [](const Row& r) { return std::abs(r.misses[0].x); };
    if (before.free && row.free && beginning(row) < beginning(before) && beginning(row) < beginning(after)) {
      double low = before.amplitude, high = after.amplitude;  // golden section
      Row least = row;
      for (int i = 0; i < 30 && high - low > 1e-7 * high; ++i) {
        constexpr double part = 0.3819660112501051;
        const bool below = least.amplitude - low > high - least.amplitude;
        const double at = below ? least.amplitude - part * (least.amplitude - low)
                                : least.amplitude + part * (high - least.amplitude);
        const Row next = row_at(at, 0);
        if ((next.misses[0].x > 0) != (row.misses[0].x > 0)) {
          search_beginning(before, next, found);
          search_beginning(next, after, found);
          break;
        }
        if (beginning(next) < beginning(least))
          (below ? high : low) = std::exchange(least, next).amplitude;
        else
          (below ? low : high) = at;
      }
    }
    if (!(before.columns == columns && row.columns == columns && after.columns == columns)) return;
    for (std::size_t j = 0; j <= columns; ++j) {
      const double size = row.misses[j].size();
      bool least = size < 0.5;
      for (const Row* r : {&before, &row, &after})
        for (std::size_t k = j == 0 ? 0 : j - 1; k <= std::min<std::size_t>(j + 1, columns); ++k)
          least = least && r->misses[k].size() >= size;
      if (!least) continue;
      for (const double amplitude :
           {std::sqrt(before.amplitude * row.amplitude), row.amplitude, std::sqrt(row.amplitude * after.amplitude)})
        keep(row.phase(static_cast<double>(j)), amplitude, found);
    }
  }

  // Add the orbit near a turning point at x = A to `found`, unless it is already there.
  void keep(double phase, double displacement, std::vector<Orbit>& found) const try {
    constexpr double quarter = std::numbers::pi / 2;  // away from the turning point, where the map is not smooth
    const auto place = shoot({phase + quarter, after({phase, State::at(displacement, 0)}, quarter)}, displacement);
    if (!place) return;
    const Orbit orbit = describe(*place);
    const auto same = [&](const Orbit& other) {
      const double apart = std::max(std::abs(other.state.displacement - orbit.state.displacement),
                                    std::abs(other.state.velocity - orbit.state.velocity) / omega_);
      return apart <= 1e-6 * orbit.amplitude;
    };
    if (orbit.amplitude > 0 && std::none_of(found.begin(), found.end(), same)) found.push_back(orbit);
  } catch (const ConvergenceError&) {  // Newton's method left the range that can be computed
  }

  // Bounds of the amplitude. The n-th harmonic of x, times |wn^2 - n^2 omega^2|, equals that of the load minus that of
  // friction, which is at most 4 level / (pi n). At resonance this gives no upper bound, and a practical one is used.
  std::pair<double, double> amplitudes() const {
    const double wn = slider_.natural_frequency(), usual = load_ / (omega_ * omega_ + slider_.stiffness());
    double highest = level(0);
    for (double x = 1e-6 * usual; x < 1e6 * usual; x *= 2) highest = std::max(highest, level(x));
    const auto harmonic = [&](int n) {
      return 4 * highest / (std::numbers::pi * n) / std::abs((wn - n * omega_) * (wn + n * omega_));
    };
    const double first = load_ / std::abs((wn - omega_) * (wn + omega_));
    double others = 0;
    for (int n = 3; n < 100; n += 2) others += harmonic(n);
    if (!std::isfinite(first + others)) return {0, 1e6 * usual};
    return {std::max(0.99 * first - harmonic(1) - others, 0.0),
            std::min(1.01 * first + harmonic(1) + others, 1e6 * usual)};
  }

  const Slider<Law>& slider_;
  const Flows& flows_;
  double load_, omega_;
};

template <FrictionLaw Law, class Work>
auto with_finder(const Slider<Law>& slider, double load, double omega, Work&& work) {
  std::invoke_result_t<Work, OrbitFinder<Law, Taylor<Law>>> result;
  with_harmonic_flows(slider, omega, std::numeric_limits<double>::quiet_NaN(), [&](const auto& flows) {
    result = work(OrbitFinder<Law, std::remove_cvref_t<decltype(flows)>>(slider, flows, load, omega));
  });
  return result;
}

template <FrictionLaw Law>
void check_orbit_arguments(const Slider<Law>& slider, double load, double omega, const std::string& who) {
  static_assert(PositionLaw<Law>, "orbits: a resistance that depends on the speed or the distance slid is not covered");
  require_plain_mounting(slider.mounting(), who);
  require(equal(slider.damping(), 0), who + ": a slider with a damper is not covered, damping must be 0",
          slider.damping(), "1/s");
  require(load > 0 && load <= GroundMotion::max_acceleration, who + ": B must be positive and at most 1e100 m/s^2",
          load, "m/s^2");
  require(omega > 0 && std::isfinite(omega * omega) && std::isfinite(2 * std::numbers::pi / omega),
          who + ": omega must be positive, its square and its period finite", omega, "rad/s");
  const double length = load / (omega * omega + slider.stiffness());
  for (const double x : {0.0, 0.1, 1.0, 10.0}) {
    const double forward = slider.law().resist(x * length, Direction::forward);
    const double backward = slider.law().resist(-x * length, Direction::backward);
    require(std::isfinite(forward), who + ": the slip level must be finite", forward, "m/s^2");
    if constexpr (LawWithHold<Law>) {
      const double held = hold(slider.law(), x * length, Direction::forward);
      require(equal(held, forward),
              who + ": static friction that differs from kinetic is not covered, it must hold " + shortest(forward) +
                  " m/s^2",
              held, "m/s^2");
    }
    require(
        std::abs(forward - backward) <= 1e-12 * forward,
        who + ": the slip level against forward sliding, " + shortest(forward) +
            " m/s^2, must be that of the mirrored slip (of Coulomb friction on a spring, finite alone), for else the "
            "slider drifts",
        backward, "m/s^2");
  }
}

/// The same orbit with its center shifted by `distance` [m].
inline Orbit moved(Orbit orbit, double distance) {
  if (equal(distance, 0)) return orbit;
  orbit.center += distance;
  orbit.state.displacement += distance;
  for (Event& event : orbit.events) event.displacement += distance;
  return orbit;
}

}  // namespace detail

/// The exact symmetric periodic motions of a slider under -n(t) = B cos(omega t),
///     x'' + resist(x) sgn(x') + wn^2 x = B cos(omega t),                          thesis (2.27), (2.28), (2.50)
/// The method of slowly varying parameters, (2.16), approximates them. A damper, static friction that differs from
/// kinetic, and friction that depends on the speed or the sliding distance are not covered.
///
/// Constant friction has one orbit if B > a. If the slider does not stop, it is Den Hartog's orbit, in closed form;
/// without a spring this is A = sqrt(B^2 - (pi a/2)^2) / omega^2 for B/a >= sqrt(1 + pi^2/4), and for smaller B/a the
/// slider stops twice per cycle. At resonance, wn = omega, there is no orbit for B >= 4 a/pi: the amplitude grows
/// without bound. For other laws the result contains all orbits, stable or not, that a search of the turning points
/// finds: on a grid of at least twelve amplitudes per decade and twenty phases, whose cells are refined by Newton's
/// method on the half-period map. The state of rest at x = 0 is included, with amplitude 0, if B is at most the slip
/// level there. Asymmetric orbits are not sought.
///
/// Coulomb friction with unequal levels on a spring: with x = center + y, center = (backward - forward) / (2 wn^2), the
/// motion y is that under the mean level, a = (forward + backward) / 2. The orbits lie around the center.
///
/// @param slider  a law with equal levels in both directions, and an optional spring; or Coulomb friction with any
///                finite levels on a spring
/// @param load    B [m/s^2], positive and at most 1e100
/// @param omega   [rad/s], positive, with a finite square
/// @param progress  called several times per second; may throw to stop the work; optional
/// @return the orbits in order of amplitude
/// @throws std::invalid_argument  a value out of its range; levels that differ by direction without a spring
///                                (the slider drifts)
/// Orbits are accurate to about 1e-13 of their amplitude, times their largest multiplier. Constant friction takes 7 us
/// without a spring, 20 us with a spring and 2 ms with a spring and stops. A caster takes 10 to 200 ms, and
/// proportionally longer if a stiff spring oscillates many times per period. Reference: J. P. Den Hartog, Forced
/// vibrations with combined Coulomb and viscous friction, Trans. ASME 53 (1931).
template <FrictionLaw Law>
std::vector<Orbit> orbits(const Slider<Law>& slider, double load, double omega,
                          const std::function<void()>& progress = {}) {
  const auto balanced = detail::balanced(slider);
  detail::check_orbit_arguments(balanced.slider, load, omega, "orbits");
  std::vector<Orbit> found =
      detail::with_finder(balanced.slider, load, omega, [&](const auto& finder) { return finder.find(progress); });
  for (Orbit& orbit : found) orbit = detail::moved(std::move(orbit), balanced.center);
  return found;
}

template <FrictionLaw Law>
std::vector<Orbit> orbits(const Law& law, double load, double omega, const std::function<void()>& progress = {}) {
  return orbits(Slider<Law>(law), load, omega, progress);
}

/// Compute the states of a slider on its orbit at given times.
/// @param slider  the slider of the orbit
/// @param times   [s], finite, in any order; the orbit continues without beginning or end
/// @return the state at each time
template <FrictionLaw Law>
std::vector<State> states_at(const Slider<Law>& slider, const Orbit& orbit, const std::vector<double>& times) {
  std::vector<State> states(times.size(), State::at(orbit.center, 0));
  if (orbit.at_rest() || times.empty()) return states;
  for (const double time : times) detail::require(std::isfinite(time), "states_at: times must be finite", time, "s");
  const HarmonicMotion motion(orbit.load, orbit.omega, orbit.period());
  std::vector<std::pair<double, std::size_t>> phases;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double phase = motion.phase(times[i]);
    phases.emplace_back(phase < 0 ? phase + 2 * std::numbers::pi : phase, i);
  }
  std::sort(phases.begin(), phases.end());
  detail::with_finder(slider, orbit.load, orbit.omega, [&](const auto& finder) {
    State state = orbit.state;
    double now = 0;
    for (const auto& [phase, i] : phases) {
      if (phase > now) state = finder.after({now, state}, phase - now);
      now = phase;
      states[i] = state;
    }
    return true;
  });
  return states;
}

}  // namespace stickslip

#ifdef STICKSLIP_LIBRARY  // the linked library contains these
#include "stickslip/friction/caster.hpp"
#include "stickslip/friction/coulomb.hpp"

namespace stickslip {
extern template std::vector<Orbit> orbits(const Slider<Coulomb>&, double, double, const std::function<void()>&);
extern template std::vector<Orbit> orbits(const Slider<Caster>&, double, double, const std::function<void()>&);
extern template std::vector<State> states_at(const Slider<Coulomb>&, const Orbit&, const std::vector<double>&);
extern template std::vector<State> states_at(const Slider<Caster>&, const Orbit&, const std::vector<double>&);
}  // namespace stickslip
#endif
