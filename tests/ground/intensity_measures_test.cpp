// Intensity measures: sines and steps with closed answers, segments that are cut, scaling.
#include "stickslip/ground/intensity_measures.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include "stickslip/base/units.hpp"
#include "stickslip/ground/processing.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using std::numbers::pi;

namespace {

/// Whole periods of a sine, as straight lines of dt, each off by (omega dt)^2 / 8 at most.
GroundMotion sine(double amplitude, double hz, int periods, double dt) {
  std::vector<double> n;
  for (int i = 0; i * dt <= periods / hz + dt / 2; ++i) n.push_back(amplitude * std::sin(2 * pi * hz * i * dt));
  return {n, dt};
}

}  // namespace

TEST_CASE("a sine has the measures of the textbook", "[intensity_measures]") {
  // v = A / w (1 - cos w t), d = A / w (t - sin w t / w), int |n| = 2 A / pi T, int n^2 = A^2 T / 2.
  const double A = 3, f = 2, w = 2 * pi * f, T = 10, allowed = std::pow(w * 1e-3, 2) / 6;
  const GroundMotion motion = sine(A, f, 20, 1e-3);
  CHECK(peak_velocity(motion) == Approx(2 * A / w).epsilon(allowed));
  CHECK(peak_displacement(motion) == Approx(A * T / w).epsilon(allowed));
  CHECK(cumulative_absolute_velocity(motion) == Approx(2 * A / pi * T).epsilon(allowed));
  CHECK(arias_intensity(motion) == Approx(pi / (2 * standard_gravity) * A * A * T / 2).epsilon(allowed));
}

TEST_CASE("measures of steps and lines are exact between the samples", "[intensity_measures]") {
  // 1, -2, 1 m/s^2, a second each: v to 1, -1, 0; d to 3 / 4 where v = 0, at 1.5 s.
  const GroundMotion up_and_down = steps({1, -2, 1});
  CHECK(peak_velocity(up_and_down) == 1);
  CHECK(peak_displacement(up_and_down) == Approx(0.75).epsilon(1e-15));
  CHECK(cumulative_absolute_velocity(up_and_down) == 4);
  // From 1 to -1 within a second: v = t - t^2, 1 / 4 at its half, d = t^2 / 2 - t^3 / 3.
  CHECK(peak_velocity(line(1, -1, 1)) == 0.25);
  CHECK(peak_displacement(line(1, -1, 1)) == Approx(1.0 / 6).epsilon(1e-15));
  CHECK(cumulative_absolute_velocity(line(1, -1, 1)) == 0.5);
  CHECK(cumulative_absolute_velocity(line(3, -1, 1)) == 1.25);
  // Down, back past zero and on: v to -1, 3, 0, d to -1/2, 1/2, 2.
  CHECK(peak_displacement(steps({-1, 4, -3})) == Approx(2).epsilon(1e-15));
  for (auto* measure : {&peak_velocity, &peak_displacement, &cumulative_absolute_velocity, &arias_intensity})
    CHECK(measure(line(0, 0, 1)) == 0);
}

TEST_CASE("measures do not depend on how a motion is cut, and scale", "[intensity_measures]") {
  const std::vector<double> n = gaussian(4, 50, 1);
  std::vector<double> fine;
  for (std::size_t i = 0; i + 1 < n.size(); ++i)
    for (int k = 0; k < 7; ++k) fine.push_back(n[i] + (n[i + 1] - n[i]) * k / 7);
  fine.push_back(n.back());
  const GroundMotion coarse(n, 0.1), cut_up(fine, 0.1 / 7), slow(n, 0.3);
  const int powers[] = {1, 2, 1, 1};
  const auto* power = powers;
  for (auto* measure : {&peak_velocity, &peak_displacement, &cumulative_absolute_velocity, &arias_intensity}) {
    CHECK(measure(cut_up) == Approx(measure(coarse)).epsilon(1e-12));
    CHECK(measure(slow) == Approx(std::pow(3, *power++) * measure(coarse)).epsilon(1e-12));
    CHECK(measure(coarse.scaled(-2)) == (measure == &arias_intensity ? 4 : 2) * measure(coarse));
  }
  CHECK(mean_period(coarse.scaled(-2)) == mean_period(coarse));
}

TEST_CASE("the mean period is that of the band alone", "[intensity_measures]") {
  // Two sines of amplitudes 1 and 2, 1 and 4 Hz: (1 / 1 + 4 / 4) / 5; a third of 30 Hz does not count.
  std::vector<double> n;
  for (int i = 0; i < 4000; ++i) {
    const double t = 0.01 * i;
    n.push_back(std::sin(2 * pi * t) + 2 * std::sin(8 * pi * t) + 5 * std::sin(60 * pi * t));
  }
  CHECK(mean_period(GroundMotion(n, 0.01)) == Approx(0.4).epsilon(1e-10));  // whole periods: no leakage
  std::vector<double> times;
  for (std::size_t i = 0; i < n.size(); ++i) times.push_back(5 + 0.01 * static_cast<double>(i));
  CHECK(mean_period(GroundMotion(n, times)) == Approx(0.4).epsilon(1e-9));
  CHECK(std::isnan(mean_period(line(0, 0, 1))));
  CHECK(std::isnan(mean_period(GroundMotion(n, 2.5))));
  CHECK(std::isnan(mean_period(GroundMotion(n, 1e-7))));
}
