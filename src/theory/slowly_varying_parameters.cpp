#include "stickslip/theory/slowly_varying_parameters.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "numerics/ode.hpp"
#include "numerics/quadrature.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/numerics/root.hpp"
#include "theory/theory_moments.hpp"

namespace stickslip::theory {
namespace {

using detail::require;
using std::numbers::pi;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double round_off = std::numeric_limits<double>::epsilon();

// Parameters of the search for solutions if the curves of a law may fold more than once.
constexpr double search_ratio = 1.0905077326652577;  // of neighboring amplitudes, 2^(1/8)
constexpr double search_reaches = 1e12;

void check_force(double B) {
  require(std::isfinite(B) && B > 0, "SlowlyVaryingParameters: B must be positive and finite", B, "m/s^2");
}

void check_frequency(double omega) {
  require(std::isfinite(omega) && omega > 0, "SlowlyVaryingParameters: omega must be positive and finite", omega,
          "rad/s");
}

void check_amplitude(double amplitude) {
  require(std::isfinite(amplitude) && amplitude > 0, "SlowlyVaryingParameters: amplitude must be positive and finite",
          amplitude, "m");
}

void check_cycle(double amplitude) {
  require(std::isfinite(amplitude) && amplitude >= 0,
          "SlowlyVaryingParameters: amplitude must be finite and at least 0", amplitude, "m");
}

/// sum c_j z^j.
double polynomial(std::span<const double> c, double z) {
  return std::accumulate(c.rbegin(), c.rend(), 0.0, [z](double sum, double next) { return sum * z + next; });
}

/// Integral of f(A sin(phi), sin(phi), cos(phi)) over a quarter of a cycle. Changes within |x| of `reach`, which may be
/// far below A, are resolved by even steps of t, phi = (reach / A) sinh(t).
template <class F>
double over_quarter(double amplitude, double reach, const F& f) {
  const double near = std::clamp(reach / amplitude, 1e-30, 1.0);
  return detail::integral(
      [&](double t) {
        const double angle = near * std::sinh(t), sine = std::sin(angle);
        return f(amplitude * sine, sine, std::cos(angle)) * (near * std::cosh(t));
      },
      0, std::asinh(pi / 2 / near));
}

}  // namespace

// ---- the coefficients S and C

SlowlyVaryingParameters::SlowlyVaryingParameters(detail::CycledLaw law, double natural_frequency)
    : law_(std::move(law)), natural_frequency_(natural_frequency) {
  const double forward = law_.level(0, Direction::forward), backward = law_.level(0, Direction::backward);
  const auto drifts = [](const std::string& where) {
    throw std::invalid_argument(
        "SlowlyVaryingParameters: the law must resist both ways alike, or the mass drifts; got " + where);
  };
  const auto differ = [](double a, double b, double scale) { return !(std::abs(a - b) <= 1e-12 * scale); };
  if (differ(forward, backward, std::min(forward, backward)))
    drifts(detail::shortest(forward) + " m/s^2 forward, " + detail::shortest(backward) + " m/s^2 backward at x = 0");

  // The power series at x = 0 shows where the law changes and whether it depends on the direction, and is itself the
  // result for small cycles. The law's own scale comes first, so that no length is too small or too large.
  std::array<std::array<double, orders + 1>, 2> c{};
  double scale = 1, shortest = infinity;
  for (const std::size_t highest : {std::size_t{2}, orders}) {
    scale *= std::isfinite(shortest) && shortest > 0 ? shortest : 1;
    shortest = infinity;
    law_.expand(0, scale, Direction::forward, std::span(c[0]).first(highest + 1));
    law_.expand(0, scale, Direction::backward, std::span(c[1]).first(highest + 1));
    for (const auto& series : c)
      for (std::size_t k = 0; k <= highest; ++k) {
        require(
            std::isfinite(series[k]),
            "SlowlyVaryingParameters: the level must have a finite power series at x = 0: order " + std::to_string(k),
            series[k]);
        if (k > 0 && series[k] != 0)
          shortest = std::min(shortest, std::pow(std::abs(forward / series[k]), 1 / static_cast<double>(k)));
      }
  }
  if (std::isinf(shortest)) {
    reach_ = law_.one_fold ? infinity : 0;
  } else {
    reach_ = scale * shortest;
    double power = 1;  // of `shortest`
    for (std::size_t k = 1; k <= orders; ++k) {
      power *= shortest;
      c[0][k] *= power;
      c[1][k] *= power;
    }
  }
  double weight = 1;  // (2/pi) int sin^(2j), a quarter of a cycle
  for (std::size_t j = 0; j <= orders / 2; ++j) {
    const std::size_t even = 2 * j, odd = even + 1;
    if (differ(c[0][even], c[1][even], forward)) drifts("unlike parts even in x, of order " + std::to_string(even));
    mean_[j] = c[0][even] / static_cast<double>(odd);
    if (j > 0) mean_slope_[j - 1] = static_cast<double>(even) * mean_[j];
    if (odd > orders) break;
    weight *= static_cast<double>(odd) / static_cast<double>(odd + 1);
    in_phase_[j] = (c[0][odd] - c[1][odd]) * weight;
    in_phase_slope_[j] = static_cast<double>(odd) * in_phase_[j];
    directed_ = directed_ || differ(c[0][odd], c[1][odd], forward);
  }
}

double SlowlyVaryingParameters::level(double x) const {
  return law_.level(x, Direction::forward) / 2 + law_.level(-x, Direction::forward) / 2;
}

// (1/A) int level(x) dx from 0 to A.
double SlowlyVaryingParameters::mean_level(double amplitude) const {
  if (amplitude <= reach_ / 4) {
    const double y = reach_ > 0 ? amplitude / reach_ : 0;
    return polynomial(mean_, y * y);
  }
  if (law_.mean_level) return law_.mean_level(amplitude);
  return over_quarter(amplitude, reach_, [&](double x, double, double cosine) { return level(x) * cosine; });
}

double SlowlyVaryingParameters::mean_level_slope(double amplitude, double mean_level) const {
  if (amplitude <= reach_ / 4) {  // where the difference below would cancel
    const double y = reach_ > 0 ? amplitude / reach_ : 0;
    return reach_ > 0 ? polynomial(mean_slope_, y * y) * y / reach_ : 0;
  }
  return (level(amplitude) - mean_level) / amplitude;
}

// (1/pi) int (difference(x) - difference(-x)) sin, difference = level forward - level backward, a quarter of a cycle.
double SlowlyVaryingParameters::in_phase_friction(double amplitude) const {
  if (!directed_) return 0;
  if (amplitude <= reach_ / 4) {
    const double y = reach_ > 0 ? amplitude / reach_ : 0;
    return polynomial(in_phase_, y * y) * y;
  }
  // With the mean level, which is subtracted again: an integral that may vanish has no relative accuracy.
  return over_quarter(amplitude, reach_,
                      [&](double x, double sine, double cosine) {
                        const double odd = law_.level(x, Direction::forward) - law_.level(-x, Direction::forward) -
                                           law_.level(x, Direction::backward) + law_.level(-x, Direction::backward);
                        return odd * sine + 4 * level(x) * cosine;
                      }) /
             pi -
         4 / pi * mean_level(amplitude);
}

double SlowlyVaryingParameters::in_phase_friction_slope(double amplitude) const {
  if (!directed_) return 0;
  if (amplitude <= reach_ / 4) {
    const double y = reach_ > 0 ? amplitude / reach_ : 0;
    return reach_ > 0 ? polynomial(in_phase_slope_, y * y) / reach_ : 0;
  }
  const auto slope = [&](double x, Direction direction) {
    std::array<double, 2> c;
    law_.expand(x, 1, direction, c);
    return c[1];
  };
  return over_quarter(amplitude, reach_,
                      [&](double x, double sine, double cosine) {
                        const double even = slope(x, Direction::forward) + slope(-x, Direction::forward) -
                                            slope(x, Direction::backward) - slope(-x, Direction::backward);
                        return even * sine * sine + 4 * level(x) * cosine / amplitude;
                      }) /
             pi -
         4 / pi * mean_level(amplitude) / amplitude;
}

// B + S, which small cycles of B next to -S(0) would otherwise lose: B + S(0) with 4 a / pi in two doubles, and
// S - S(0) by its power series.
double SlowlyVaryingParameters::surplus(double B, double amplitude, double mean_level) const {
  constexpr double four_over_pi = 4 / pi, rest_of_it = -7.8714706700729948e-17;
  if (amplitude > reach_ / 4) return B - four_over_pi * mean_level;
  const double y = reach_ > 0 ? amplitude / reach_ : 0;
  const double first = four_over_pi * mean_[0], rest = std::fma(four_over_pi, mean_[0], -first) + rest_of_it * mean_[0];
  return (B - first) - rest - four_over_pi * (polynomial(std::span(mean_).subspan(1), y * y) * y * y);
}

// S S' / A.
double SlowlyVaryingParameters::fold_term(double amplitude, double mean_level) const {
  return 4 / pi * mean_level / amplitude * (4 / pi) * mean_level_slope(amplitude, mean_level);
}

double SlowlyVaryingParameters::dissipative(double amplitude) const {
  check_cycle(amplitude);
  return -4 / pi * mean_level(amplitude);
}

double SlowlyVaryingParameters::dissipative_slope(double amplitude) const {
  check_cycle(amplitude);
  return -4 / pi * mean_level_slope(amplitude, mean_level(amplitude));
}

double SlowlyVaryingParameters::in_phase(double amplitude) const {
  check_cycle(amplitude);
  return natural_frequency_ * natural_frequency_ * amplitude + in_phase_friction(amplitude);
}

double SlowlyVaryingParameters::in_phase_slope(double amplitude) const {
  check_cycle(amplitude);
  return natural_frequency_ * natural_frequency_ + in_phase_friction_slope(amplitude);
}

// ---- periodic solutions

/// S^2 + (C - omega^2 A)^2 = B^2, in units of B.
struct SlowlyVaryingParameters::Balance {
  Balance(const SlowlyVaryingParameters& theory, double force, double frequency)
      : svp(theory),
        B(force),
        omega(frequency),
        stiffness((svp.natural_frequency_ - omega) * (svp.natural_frequency_ + omega)) {
    check_force(B);
    check_frequency(omega);
  }

  /// C - omega^2 A.
  double excess(double amplitude) const { return stiffness * amplitude + svp.in_phase_friction(amplitude); }

  /// Positive where the right side is too small.
  double operator()(double amplitude) const { return at(amplitude, svp.mean_level(amplitude)); }

  /// Left side of (2.19), which is also half the slope of (2.16) over A.
  double determinant(double amplitude) const { return determinant(amplitude, svp.mean_level(amplitude)); }

  struct Sides {
    double amplitude, value, determinant;
  };
  Sides sides(double amplitude) const {
    const double mean = svp.mean_level(amplitude);
    return {amplitude, at(amplitude, mean), amplitude > 0 ? determinant(amplitude, mean) : 0};
  }

  HarmonicSolution solution(double amplitude) const {
    return {amplitude, std::atan2(svp.dissipative(amplitude), excess(amplitude)), determinant(amplitude) > 0};
  }

  /// Amplitudes between which there is one fold at most, from below the smallest solution to above the largest.
  std::vector<double> amplitudes() const {
    const double least = svp.min_amplitude(B), smallest = (*this)(0) < 0 ? 0 : 1e-6 * svp.reach_;
    const double low = least > 0 ? least / 2 : smallest, length = svp.reach_ > 0 ? svp.reach_ : 1;
    double high = svp.law_.one_fold ? 4 * least : search_reaches * length;  // at resonance
    if (omega != svp.natural_frequency_) {
      high = B / std::abs(stiffness) * (1 + 64 * round_off);
      if (!(high >= std::numeric_limits<double>::min() && high < infinity))
        throw std::overflow_error("SlowlyVaryingParameters: amplitudes at omega = " + detail::shortest(omega) +
                                  " rad/s leave the range of doubles");
      for (int i = 0; svp.directed_ && i < 8; ++i)
        high = std::max(high, 2 * (B + std::abs(svp.in_phase_friction(high))) / std::abs(stiffness));
    }
    if (!(low < high)) return {};
    std::vector<double> result{low};
    if (!svp.law_.one_fold)
      for (double a = std::max(low * search_ratio, std::min(length / 64, high * 0x1p-60));
           a < std::min(high, search_reaches * length); a *= search_ratio)
        result.push_back(a);
    result.push_back(high);
    return result;
  }

  const SlowlyVaryingParameters& svp;
  double B, omega, stiffness;

 private:
  double at(double amplitude, double mean_level) const {
    const double s = 4 / pi * mean_level / B, e = excess(amplitude) / B;
    return e * e - svp.surplus(B, amplitude, mean_level) / B * (1 + s);
  }

  double determinant(double amplitude, double mean_level) const {
    return excess(amplitude) / amplitude * (stiffness + svp.in_phase_friction_slope(amplitude)) +
           svp.fold_term(amplitude, mean_level);
  }
};

std::vector<HarmonicSolution> SlowlyVaryingParameters::response(double B, double omega) const {
  const Balance balance(*this, B, omega);
  std::vector<HarmonicSolution> found;
  const auto look = [&](const Balance::Sides& low, const Balance::Sides& high) {
    if ((low.value > 0) != (high.value > 0))
      found.push_back(balance.solution(numerics::root(balance, low.amplitude, low.value, high.amplitude, high.value)));
  };
  const auto determinant = [&](double amplitude) { return balance.determinant(amplitude); };
  const std::vector<double> amplitudes = balance.amplitudes();
  if (amplitudes.empty()) return found;
  Balance::Sides low = balance.sides(amplitudes.front());
  for (const double amplitude : std::span(amplitudes).subspan(1)) {
    const Balance::Sides high = balance.sides(amplitude);
    if (low.amplitude > 0 && (low.determinant > 0) != (high.determinant > 0)) {
      const Balance::Sides fold =
          balance.sides(numerics::root(determinant, low.amplitude, low.determinant, high.amplitude, high.determinant));
      look(low, fold);
      look(fold, high);
    } else {
      look(low, high);
    }
    low = high;
  }
  return found;
}

Branches SlowlyVaryingParameters::frequency(double B, double amplitude) const {
  check_force(B);
  check_amplitude(amplitude);
  const double mean = mean_level(amplitude), less = surplus(B, amplitude, mean), more = B + 4 / pi * mean;
  const double middle = natural_frequency_ * natural_frequency_ + in_phase_friction(amplitude) / amplitude;
  const double distance = std::sqrt(less) * std::sqrt(more) / amplitude;
  return {std::sqrt(middle - distance), std::sqrt(middle + distance)};  // (2.48), (2.53); NaN below 0
}

Branches SlowlyVaryingParameters::stability_boundary(double amplitude) const {
  check_amplitude(amplitude);
  const double secant = in_phase_friction(amplitude) / amplitude, tangent = in_phase_friction_slope(amplitude);
  const double middle = natural_frequency_ * natural_frequency_ + (secant + tangent) / 2;
  const double difference = (secant - tangent) / 2;
  const double distance = std::sqrt(difference * difference - fold_term(amplitude, mean_level(amplitude)));
  const auto clipped = [](double square) { return std::sqrt(square < 0 ? 0 : square); };
  return {clipped(middle - distance), clipped(middle + distance)};  // (2.41), from (2.19)
}

double SlowlyVaryingParameters::min_amplitude(double B) const {
  check_force(B);
  if (surplus(B, 0, mean_[0]) >= 0) return 0;
  if (std::isinf(reach_)) return infinity;
  const auto shortage = [&](double amplitude) { return -surplus(B, amplitude, mean_level(amplitude)); };
  const double length = reach_ > 0 ? reach_ : 1, step = law_.one_fold ? 2 : search_ratio;
  const double last = law_.one_fold ? std::numeric_limits<double>::max() : search_reaches * length;
  double low = 0, low_value = shortage(low), high = length / 64, high_value = shortage(high);
  while (high_value > 0) {
    low = high;
    low_value = high_value;
    high *= step;
    if (!(high <= last)) return infinity;
    high_value = shortage(high);
  }
  return numerics::root(shortage, low, low_value, high, high_value);
}

bool SlowlyVaryingParameters::rests(double B) const {
  check_force(B);
  return surplus(B, 0, mean_[0]) <= 0;
}

// ---- transients

namespace {

/// A cos(phi) and A sin(phi), in units of B / omega^2.
struct Point {
  double x, y;
  friend Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
};

double distance(Point a, Point b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// The angle by which `center` sees a point go from `a` to `b`, from -pi to pi.
double angle_seen(Point center, Point a, Point b) {
  const Point from = a - center, to = b - center;
  return std::atan2(from.x * to.y - from.y * to.x, from.x * to.x + from.y * to.y);
}

/// Detects that a motion is captured by a stable point. The flow contracts areas, so there is no closed orbit; a motion
/// that has turned about the point once, with the other stationary points outside, never leaves it.
class Turn {
 public:
  Turn(Point center, std::vector<Point> others, Point start)
      : center_(center), others_(std::move(others)), near_(1e300), start_(start), last_(start), seen_(others_.size()) {
    for (const Point other : others_) near_ = std::min(near_, 1e-3 * distance(center_, other));
  }

  bool caught(Point p) {
    if (distance(center_, p) < near_) return true;
    angle_ += angle_seen(center_, last_, p);
    bool clear = true;  // whether the angles seen from the other points are beyond doubt
    for (std::size_t i = 0; i < others_.size(); ++i) {
      const double seen = angle_seen(others_[i], last_, p);
      seen_[i] += seen;
      clear = clear && std::abs(seen) < 2;
    }
    last_ = p;
    if (clear && std::abs(angle_) < 2 * pi) return false;
    bool alone = clear;
    for (std::size_t i = 0; i < others_.size(); ++i)
      alone = alone && std::abs(seen_[i] + angle_seen(others_[i], p, start_)) < pi;
    start_ = p;
    angle_ = 0;
    std::ranges::fill(seen_, 0.0);
    return alone;
  }

 private:
  Point center_;
  std::vector<Point> others_;
  double near_;
  Point start_, last_;
  double angle_ = 0;
  std::vector<double> seen_;
};

constexpr double at_rest = 1e-9;  // an amplitude that counts as none

}  // namespace

/// The averaged equations in the plane of A cos(phi), A sin(phi), as functions of omega t. In this plane, A = 0 is
/// singular only because of friction.
class SlowlyVaryingParameters::Plane {
 public:
  Plane(const SlowlyVaryingParameters& theory, double force, double frequency, double amplitude, double phase,
        const std::function<void()>& progress)
      : balance_(theory, force, frequency),
        length_(force / frequency / frequency),
        rests_(theory.rests(force)),
        progress_(progress) {
    check_cycle(amplitude);
    require(std::isfinite(phase), "SlowlyVaryingParameters: phase must be finite", phase, "rad");
    const double start = amplitude / length_;
    if (!(length_ >= std::numeric_limits<double>::min() && length_ < infinity && std::isfinite(start)))
      throw std::overflow_error("SlowlyVaryingParameters: amplitudes at omega = " + detail::shortest(frequency) +
                                " rad/s leave the range of doubles");
    at_ = {start * std::cos(phase), start * std::sin(phase)};
    options_.relative_tolerance = 1e-10;
    options_.absolute_tolerance = {1e-12};
  }

  const Balance& balance() const { return balance_; }
  Point at() const { return at_; }
  double length() const { return length_; }
  bool rests(Point p) const { return rests_ && std::hypot(p.x, p.y) < at_rest; }
  Point place(const HarmonicSolution& s) const {
    const double a = s.amplitude / length_;
    return {a * std::cos(s.phase), a * std::sin(s.phase)};
  }

  /// Continues through `angles` of omega t, counted from the present one, until `visit` stops it.
  template <class Visit>
  void follow(std::span<const double> angles, const Visit& visit) {
    const std::array<double, 2> start{at_.x, at_.y};
    const detail::OdeSolution solution = [&] {
      try {
        return detail::solve_ode([this](double, std::span<const double> y, std::span<double> slope) { rate(y, slope); },
                                 0, start, angles, options_);
      } catch (const detail::OdeFailure& failure) {
        throw ConvergenceError("SlowlyVaryingParameters: reached " +
                               detail::shortest((passed_ + failure.reached) / balance_.omega) + " s: " + failure.why);
      }
    }();
    if (!angles.empty()) passed_ += angles.back();
    for (std::size_t i = 0; i < angles.size(); ++i) {
      at_ = {solution.at(i)[0], solution.at(i)[1]};
      if (!visit(at_)) return;
    }
  }

  /// Time since the start [s].
  double passed() const { return passed_ / balance_.omega; }

 private:
  // A' = (S - B sin(phi)) / (2 omega), A phi' = (C - omega^2 A - B cos(phi)) / (2 omega)
  void rate(std::span<const double> y, std::span<double> slope) {
    if (progress_ && ++rates_ % 4096 == 0) progress_();
    const double a = std::hypot(y[0], y[1]), amplitude = a * length_;
    if (rests({y[0], y[1]})) {
      slope[0] = slope[1] = 0;
      return;
    }
    const double cosine = a > 0 ? y[0] / a : 0, sine = a > 0 ? y[1] / a : -1;  // from rest it moves with the force
    const double s = -4 / pi * balance_.svp.mean_level(amplitude) / balance_.B;
    const double e = balance_.excess(amplitude) / balance_.B;
    slope[0] = (s * cosine - e * sine) / 2;
    slope[1] = (s * sine + e * cosine - 1) / 2;
  }

  Balance balance_;
  double length_;
  bool rests_;
  const std::function<void()>& progress_;
  long rates_ = 0;
  Point at_{};
  double passed_ = 0;  // omega t
  detail::OdeOptions options_;
};

HarmonicTransient SlowlyVaryingParameters::transient(double B, double omega, double amplitude, double phase,
                                                     std::span<const double> times,
                                                     const std::function<void()>& progress) const {
  Plane plane(*this, B, omega, amplitude, phase, progress);
  std::vector<double> angles;
  for (std::size_t i = 0; i < times.size(); ++i) {
    require(std::isfinite(times[i]) && times[i] >= 0 && (i == 0 || times[i] > times[i - 1]),
            "SlowlyVaryingParameters: times must be finite and increase, from 0 on: time " + std::to_string(i),
            times[i], "s");
    angles.push_back(omega * times[i]);
  }
  HarmonicTransient result;
  plane.follow(angles, [&](Point p) {
    const double a = plane.rests(p) ? 0 : std::hypot(p.x, p.y);
    result.amplitude.push_back(a * plane.length());
    result.phase.push_back(a > 0 ? std::atan2(p.y, p.x) : not_a_number);
    return true;
  });
  return result;
}

Moments SlowlyVaryingParameters::predict(const HarmonicMotion& motion, std::span<const double> times,
                                         const std::function<void()>& progress) const {
  const double omega = motion.omega();
  const double phase = center_ > 0 ? pi : 0;
  const HarmonicTransient path = transient(motion.amplitude(), omega, std::abs(center_), phase, times, progress);
  Moments moments = detail::moments_at(times);
  const bool stays = rests(motion.amplitude());  // at x = 0, which friction holds as well as the center
  for (std::size_t i = 0; i < times.size(); ++i) {
    moments.displacement_mean.value[i] = stays ? 0 : center_;
    if (stays || path.amplitude[i] == 0) continue;  // its phase is NaN
    const double angle = motion.phase(times[i]) + path.phase[i];
    moments.displacement_mean.value[i] += path.amplitude[i] * std::cos(angle);
    moments.velocity_mean.value[i] = -omega * path.amplitude[i] * std::sin(angle);
  }
  moments.growth_rate.value = 0;
  return moments;
}

HarmonicSolution SlowlyVaryingParameters::settles_on(double B, double omega, double amplitude, double phase,
                                                     const std::function<void()>& progress) const {
  constexpr int samples = 64, max_turns = 100'000;
  Plane plane(*this, B, omega, amplitude, phase, progress);
  const Balance& balance = plane.balance();
  const std::vector<HarmonicSolution> solutions = response(B, omega);
  const double largest = solutions.empty() ? 0 : solutions.back().amplitude;
  const bool grows = balance.stiffness == 0 && balance(2 * largest) < 0;

  std::vector<HarmonicSolution> ends;
  std::ranges::copy_if(solutions, std::back_inserter(ends), &HarmonicSolution::stable);
  std::vector<Turn> turns;
  for (const HarmonicSolution& end : ends) {
    std::vector<Point> others{{0, 0}};
    for (const HarmonicSolution& other : solutions)
      if (other.amplitude != end.amplitude) others.push_back(plane.place(other));
    turns.emplace_back(plane.place(end), std::move(others), plane.at());
  }
  if (rests(B)) ends.push_back({0, not_a_number, true});
  if (grows) ends.push_back({infinity, -pi / 2, true});
  if (ends.size() == 1) return ends.front();

  const double detuning = std::max(std::abs(balance.stiffness) / omega / omega, 0.01);
  std::array<double, samples> angles;
  for (int i = 0; i < samples; ++i) angles[static_cast<std::size_t>(i)] = 4 * pi / detuning * (i + 1) / samples;
  for (int turn = 0; turn < max_turns; ++turn) {
    const HarmonicSolution* end = nullptr;
    plane.follow(angles, [&](Point p) {
      if (plane.rests(p)) end = &ends[turns.size()];
      if (grows && p.y * plane.length() < -largest) end = &ends.back();  // there -S < B, and phi goes to -pi/2
      for (std::size_t i = 0; i < turns.size(); ++i)
        if (turns[i].caught(p)) end = &ends[i];
      return end == nullptr;
    });
    if (end != nullptr) return *end;
  }
  throw ConvergenceError("SlowlyVaryingParameters: not settled after " + detail::shortest(plane.passed()) + " s");
}

}  // namespace stickslip::theory
