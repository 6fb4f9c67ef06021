// Response spectra: loads with closed-form solutions, a fine Runge-Kutta integration, limits, scaling, rejected
// arguments.
#include "stickslip/ground/response_spectrum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;
using std::numbers::pi;

namespace {

constexpr std::array kinds{SpectrumKind::pseudo_acceleration, SpectrumKind::pseudo_velocity, SpectrumKind::displacement,
                           SpectrumKind::velocity, SpectrumKind::acceleration};

double one(const GroundMotion& motion, double period, double damping, SpectrumKind kind) {
  return response_spectrum(motion, {period}, {damping}, kind).value(0, 0);
}

/// max |x|, max |x'|, max |x'' + n| by Runge-Kutta in steps of some `step`, the free vibration of `after` included.
std::array<double, 3> runge_kutta(const GroundMotion& motion, double period, double zeta, double step, double after) {
  const double wn = 2 * pi / period, c = 2 * zeta * wn, k = wn * wn;
  std::array<double, 3> most{};
  double x = 0, v = 0;
  const auto go = [&](double duration, double start, double end) {
    const int steps = static_cast<int>(std::ceil(duration / step));
    const double h = duration / steps;
    for (int i = 0; i < steps; ++i) {
      const auto n = [&](double part) { return start + (end - start) * ((i + part) / steps); };
      const auto a = [&](double part, double x_, double v_) { return -n(part) - c * v_ - k * x_; };
      const double v1 = v, a1 = a(0, x, v1), v2 = v + h / 2 * a1, a2 = a(0.5, x + h / 2 * v1, v2), v3 = v + h / 2 * a2,
                   a3 = a(0.5, x + h / 2 * v2, v3), v4 = v + h * a3, a4 = a(1, x + h * v3, v4);
      x += h / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
      v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
      most = {std::max(most[0], std::abs(x)), std::max(most[1], std::abs(v)),
              std::max(most[2], std::abs(c * v + k * x))};
    }
  };
  for (std::size_t i = 0; i < motion.segments(); ++i) {
    const Segment s = motion.segment(i);
    if (s.duration > 0) go(s.duration, s.start, s.end);
  }
  go(after, 0, 0);
  return most;
}

}  // namespace

TEST_CASE("a load that is put on overshoots by what the textbook says", "[response_spectrum]") {
  // x = n / k (1 - e^(-zeta wn t) (cos + ...)): largest after half a damped period, 1 + exp(-pi zeta / sqrt(1 -
  // zeta^2)) times the static value. The segment holds between 5 and 10^6 periods.
  const GroundMotion motion = held(3, 8000);
  for (const double period : {0.01, 0.3, 7.0, 1500.0})
    for (const double zeta : {0.01, 0.05, 0.2, 0.7, 0.99}) {
      CAPTURE(period, zeta);
      const double over = 1 + std::exp(-pi * zeta / std::sqrt(1 - zeta * zeta));
      const double roundings = 1e-15 * std::max(1.0, 2 * pi * 8000 / period);
      CHECK(one(motion, period, zeta, SpectrumKind::pseudo_acceleration) ==
            Approx(3 * over).epsilon(1e-12 + roundings));
    }
  // Without damping, 2 after half a period. With critical damping or more it creeps up, and the load is never exceeded.
  CHECK(one(motion, 7, 0, SpectrumKind::pseudo_acceleration) == Approx(6).epsilon(1e-12));
  CHECK(one(motion, 7, 1, SpectrumKind::pseudo_acceleration) == Approx(3).epsilon(1e-12));
  CHECK(one(motion, 7, 1.9, SpectrumKind::pseudo_acceleration) == Approx(3).epsilon(1e-12));
}

TEST_CASE("a short push is followed by free vibration, which counts", "[response_spectrum]") {
  // Undamped, a push n over a time h below T / 2 ends before the maximum: 2 n / wn^2 sin(wn h / 2), and the velocity
  // and the absolute acceleration are those of a sine of this amplitude.
  const GroundMotion motion = held(2, 0.01);
  const double wn = 2 * pi / 0.9, amplitude = 4 / (wn * wn) * std::sin(wn * 0.005);
  CHECK(one(motion, 0.9, 0, SpectrumKind::displacement) == Approx(amplitude).epsilon(1e-13));
  CHECK(one(motion, 0.9, 0, SpectrumKind::velocity) == Approx(wn * amplitude).epsilon(1e-13));
  CHECK(one(motion, 0.9, 0, SpectrumKind::acceleration) == Approx(wn * wn * amplitude).epsilon(1e-13));
  CHECK(one(motion, 0.9, 0, SpectrumKind::pseudo_velocity) == Approx(wn * amplitude).epsilon(1e-13));
  // Critically damped, from x' = V: V / (e wn), up to the time the push takes.
  const GroundMotion kick = held(2e6, 1e-8);
  CHECK(one(kick, 0.9, 1, SpectrumKind::displacement) == Approx(0.02 / (std::numbers::e * wn)).epsilon(1e-6));
}

TEST_CASE("a spectrum agrees with Runge-Kutta integration in fine steps", "[response_spectrum]") {
  // Steps of T / 600: off by (2 pi / 600)^2 / 8 = 1.4e-5 where the maximum lies between two of them; absolute
  // accelerations, which may turn sharply, need steps of the segment, too.
  const std::vector<double> n = gaussian(7, 40, 2);
  std::vector<double> times;
  for (std::size_t i = 0; i < n.size(); ++i)
    times.push_back(0.05 * static_cast<double>(i) + 0.02 * std::sin(static_cast<double>(i)));
  for (const GroundMotion& motion : {GroundMotion(n, 0.05), GroundMotion(n, 0.05, Interpolation::constant),
                                     GroundMotion(n, times), GroundMotion(n, times, Interpolation::constant)})
    for (const double period : {0.011, 0.04, 0.13, 0.5, 3.0})
      for (const double zeta : {0.0, 0.05, 0.6, 1.0, 1.7}) {
        CAPTURE(period, zeta, std::isnan(motion.dt()), static_cast<int>(motion.interpolation()));
        const auto found = runge_kutta(motion, period, zeta, std::min(period, 0.05) / 600, 2 * period);
        CHECK(one(motion, period, zeta, SpectrumKind::displacement) == Approx(found[0]).epsilon(3e-5));
        CHECK(one(motion, period, zeta, SpectrumKind::velocity) == Approx(found[1]).epsilon(3e-5));
        CHECK(one(motion, period, zeta, SpectrumKind::acceleration) == Approx(found[2]).epsilon(3e-5));
        // Never below the maximum found on the way, except for the error of the integration itself.
        CHECK(one(motion, period, zeta, SpectrumKind::displacement) >= found[0] * (1 - 1e-8));
        CHECK(one(motion, period, zeta, SpectrumKind::velocity) >= found[1] * (1 - 1e-8));
      }
}

TEST_CASE("segments that are cut have the same spectrum", "[response_spectrum]") {
  // Few maxima lie within the fine segments of the one, nearly all within those of the other.
  const std::vector<double> n = gaussian(3, 60, 1);
  std::vector<double> fine;
  for (std::size_t i = 0; i + 1 < n.size(); ++i)
    for (int k = 0; k < 64; ++k) fine.push_back(n[i] + (n[i + 1] - n[i]) * k / 64);
  fine.push_back(n.back());
  const std::vector<double> periods{0.013, 0.02, 0.05, 0.1, 0.17, 0.4, 1, 2.5, 8}, damping{0, 0.02, 0.3, 1, 1.5};
  for (const SpectrumKind kind : kinds) {
    const auto a = response_spectrum(GroundMotion(n, 0.1), periods, damping, kind);
    const auto b = response_spectrum(GroundMotion(fine, 0.1 / 64), periods, damping, kind);
    for (std::size_t i = 0; i < a.values.size(); ++i) {
      CAPTURE(static_cast<int>(kind), i);
      CHECK(a.values[i] == Approx(b.values[i]).epsilon(1e-11));
    }
  }
}

TEST_CASE("pseudo-acceleration and acceleration are one without damping", "[response_spectrum]") {
  const GroundMotion motion = broadband(1, 300);
  for (const double period : {0.05, 0.7, 4.0}) {
    CHECK(one(motion, period, 0, SpectrumKind::acceleration) ==
          Approx(one(motion, period, 0, SpectrumKind::pseudo_acceleration)).epsilon(1e-12));
    // and with damping larger than it, as x'' + n = -c x' - wn^2 x is -wn^2 x where x' = 0
    CHECK(one(motion, period, 0.3, SpectrumKind::acceleration) >
          one(motion, period, 0.3, SpectrumKind::pseudo_acceleration));
  }
}

TEST_CASE("a stiff oscillator moves with the ground, a slow one stays where it was", "[response_spectrum]") {
  const GroundMotion lines = broadband(2, 300, true);
  const double pga = lines.peak_acceleration();
  for (const SpectrumKind kind : {SpectrumKind::pseudo_acceleration, SpectrumKind::acceleration}) {
    CHECK(one(lines, 0, 0.05, kind) == pga);
    // It follows lines up to what their bends excite: |change of slope| / wn = |change of slope| T / 2 pi per n.
    CHECK(one(lines, 1e-5, 0.05, kind) == Approx(pga).epsilon(1e-4));
  }
  for (const SpectrumKind kind : {SpectrumKind::pseudo_velocity, SpectrumKind::displacement, SpectrumKind::velocity})
    CHECK(one(lines, 0, 0.05, kind) == 0);
  // Ground that comes to rest: its velocity goes to 1, -1 and 0 m/s, its displacement to 0.75 m, where the velocity is
  // zero, and back. x = -ground, x' = -velocity, but for zeta wn t.
  const GroundMotion moves = steps({1, -2, 1});
  CHECK(one(moves, 1e6, 0.05, SpectrumKind::velocity) == Approx(1).epsilon(1e-5));
  CHECK(one(moves, 1e6, 0.05, SpectrumKind::displacement) == Approx(0.75).epsilon(1e-5));
}

TEST_CASE("spectra scale with the motion and with time", "[response_spectrum]") {
  const GroundMotion motion = broadband(5, 200);
  const std::vector<double> n(motion.acceleration().begin(), motion.acceleration().end());
  const std::vector<double> periods{0, 0.03, 0.2, 1, 5}, slow{0, 0.12, 0.8, 4, 20}, damping{0, 0.05, 1.2};
  for (const SpectrumKind kind : kinds) {
    const auto once = response_spectrum(motion, periods, damping, kind);
    for (const double factor : {2.0, 0x1p-300, 0x1p300})  // exact in binary
      CHECK(response_spectrum(motion.scaled(factor), periods, damping, kind).values == [&] {
        std::vector<double> expected = once.values;
        for (double& value : expected) value *= std::abs(factor);
        return expected;
      }());
    const auto mirrored = response_spectrum(motion.scaled(-1), periods, damping, kind);
    for (std::size_t i = 0; i < mirrored.values.size(); ++i)
      CHECK(mirrored.values[i] == Approx(once.values[i]).epsilon(1e-14));
    const double power = kind == SpectrumKind::displacement                                        ? 16
                         : kind == SpectrumKind::velocity || kind == SpectrumKind::pseudo_velocity ? 4
                                                                                                   : 1;
    const auto late = response_spectrum(GroundMotion(n, 0.4), slow, damping, kind);
    for (std::size_t i = 0; i < late.values.size(); ++i)
      CHECK(late.values[i] == Approx(power * once.values[i]).epsilon(1e-12));
  }
}

TEST_CASE("each oscillator is on its own, however many there are and in whatever order", "[response_spectrum]") {
  const GroundMotion motion = broadband(8, 100);
  std::vector<double> periods;
  for (int i = 0; i < 19; ++i) periods.push_back(std::fmod(0.7 * (i + 1), 1.1));
  const auto all = response_spectrum(motion, periods, {0.02, 0.5});
  for (std::size_t d = 0; d < 2; ++d)
    for (std::size_t p = 0; p < periods.size(); ++p)
      CHECK(all.value(d, p) == one(motion, periods[p], all.damping[d], SpectrumKind::pseudo_acceleration));
  // Steps of zero duration have no effect.
  const GroundMotion twice({1, 5, -1, 2, 0}, {0, 1, 1, 2, 3}, Interpolation::constant);
  CHECK(response_spectrum(twice, periods).values == response_spectrum(steps({1, -1, 2}), periods).values);
  CHECK(one(line(0, 0, 1), 0.5, 0.05, SpectrumKind::velocity) == 0);
}

TEST_CASE("a spectrum that makes no sense is refused", "[response_spectrum]") {
  const GroundMotion motion = line(0, 1, 1);
  CHECK_THROWS_WITH(response_spectrum(motion, {}), ContainsSubstring("at least one period"));
  CHECK_THROWS_WITH(response_spectrum(motion, {1}, {}), ContainsSubstring("at least one damping ratio"));
  CHECK_THROWS_WITH(response_spectrum(motion, {1, -0.5}),
                    "response_spectrum: periods[1] must be 0 or from 1e-6 to 1e6 s, got -0.5 s");
  CHECK_THROWS_WITH(response_spectrum(motion, {1}, {5}),
                    "response_spectrum: damping[0] must be at least 0 and below 2, a ratio of critical damping (5 % is "
                    "0.05), got 5");
  for (const double bad : {not_a_number, infinity, -infinity}) {
    CHECK_THROWS_AS(response_spectrum(motion, {bad}), std::invalid_argument);
    CHECK_THROWS_AS(response_spectrum(motion, {1}, {bad}), std::invalid_argument);
  }
  for (const double bad : {1e-7, 1e7}) CHECK_THROWS_AS(response_spectrum(motion, {bad}), std::invalid_argument);
  CHECK_THROWS_AS(response_spectrum(motion, {1}, {-1e-9}), std::invalid_argument);
}
