// Ground motions, and properties required of any response; shared by the tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <ostream>
#include <random>
#include <span>
#include <vector>

#include "stickslip/core.hpp"

namespace test {

using namespace stickslip;

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// The reference's record A, whose samples are rounded once: sines of doubles near 760 would be wrong by 3e-14.
inline std::vector<double> record_a_samples() {
  std::vector<double> n;
  for (int m = 0; m <= 400; ++m)
    n.push_back(static_cast<double>(2 * std::sin(0.7L * m) + 1.3L * std::cos(1.9L * m + 0.4L)));
  return n;
}

inline GroundMotion record_a(Interpolation interpolation = Interpolation::linear) {
  return {record_a_samples(), 0.1, interpolation};
}

/// Gaussian samples; smooth ones are moving averages of three, scaled to the same deviation.
inline std::vector<double> gaussian(std::uint64_t seed, std::size_t samples, double deviation, bool smooth = false) {
  std::mt19937_64 bits(seed);
  std::normal_distribution<double> normal(0, deviation);
  std::vector<double> n(samples + 2);
  for (double& value : n) value = normal(bits);
  for (std::size_t i = 0; smooth && i < samples; ++i) n[i] = (n[i] + n[i + 1] + n[i + 2]) / std::sqrt(3.0);
  n.resize(samples);
  return n;
}

/// Random ground, twice as strong as a slip level of 1.
inline GroundMotion broadband(std::uint64_t seed, std::size_t samples, bool smooth = false,
                              Interpolation interpolation = Interpolation::linear) {
  return {gaussian(seed, samples, 2, smooth), 0.1, interpolation};
}

/// A straight line, or a value held, for `duration`.
inline GroundMotion line(double start, double end, double duration) { return {{start, end}, duration}; }
inline GroundMotion held(double value, double duration) { return {{value, value}, duration, Interpolation::constant}; }

/// `values` held `duration` each; the sample that closes the motion is added.
inline GroundMotion steps(std::vector<double> values, double duration = 1) {
  values.push_back(0);
  return {std::move(values), duration, Interpolation::constant};
}

/// Options to start elsewhere than at rest in the middle.
inline IntegrateOptions from(double displacement, double velocity = 0, bool settle = false) {
  IntegrateOptions options;
  options.displacement = displacement;
  options.velocity = velocity;
  options.settle = settle;
  return options;
}

struct Counts {
  int breakaways = 0, arrests = 0, reversals = 0;
  bool operator==(const Counts&) const = default;
};

inline std::ostream& operator<<(std::ostream& out, const Counts& c) {
  return out << c.breakaways << " breakaways, " << c.arrests << " arrests, " << c.reversals << " reversals";
}

inline Counts count(const std::vector<Event>& events) {
  const auto of = [&](EventKind kind) {
    return static_cast<int>(std::ranges::count_if(events, [&](const Event& e) { return e.kind == kind; }));
  };
  return {of(EventKind::breakaway), of(EventKind::arrest), of(EventKind::reversal)};
}

inline double largest(std::span<const double> values) {
  double result = 0;
  for (double value : values) result = std::max(result, std::abs(value));
  return result;
}

/// Largest difference between two histories.
inline double difference(std::span<const double> a, std::span<const double> b) {
  double result = a.size() == b.size() ? 0 : infinity;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) result = std::max(result, std::abs(a[i] - b[i]));
  return result;
}

/// The largest term of the energy balance, which sets the scale of its round-off.
inline double turnover(const Energy& e) {
  return std::max({e.initial, std::abs(e.input), e.dissipated, e.kinetic, e.elastic});
}

/// Whether events follow one another as they can: breakaway, reversals, arrest, again and again; times and speeds fit.
inline bool grammatical(const Response& response) {
  bool sliding = false;
  double time = -infinity;
  for (std::size_t i = 0; i < response.events.size(); ++i) {
    const Event& e = response.events[i];
    const bool last = i + 1 == response.events.size();
    if ((e.kind == EventKind::end) != last || !(e.time >= time) || std::isinf(e.time)) return false;
    if ((e.kind == EventKind::breakaway) == sliding && !last) return false;
    if (e.velocity != 0 && i != 0 && !last) return false;
    if (!last) sliding = e.kind != EventKind::arrest;
    time = e.time;
  }
  return time > -infinity && sliding == (response.state.mode != Mode::stuck);
}

/// A law that is constant but does not say so: it takes the Taylor flow.
struct Disguised {
  double slip_level;
  template <class T>
  auto resist(const T& x, Direction) const {
    return x * 0.0 + slip_level;
  }
};

/// A user's law: the slip level decays as exp(-(x/reach)^2).
struct Bump {
  double slip_level, reach;
  template <class T>
  auto resist(const T& x, Direction) const {
    using std::exp;
    return slip_level * exp(-(x / reach) * (x / reach));
  }
};

/// The example of CONTRIBUTING.md: friction that falls from rest to a kinetic value as the speed grows.
struct RateDependent {
  double at_rest, sliding, scale;

  template <class X, class Speed>
  auto resist(const X&, const Speed& speed, Direction) const {
    using std::exp;
    return sliding + (at_rest - sliding) * exp(-speed / scale);
  }
};

}  // namespace test
