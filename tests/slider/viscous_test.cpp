// A slider on a damper without friction: closed forms, energy, limits, and ensembles of it.
#include "stickslip/slider/viscous.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "lanes/instruction_sets.hpp"
#include "lanes/viscous_lanes.hpp"
#include "stickslip/ensemble/run.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;
using std::numbers::pi;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

const std::vector<double> dampings = {0, 1e-9, 0.1, 1, 6, 6.0000001, 40, 1e6};
const std::vector<double> frequencies = {0, 1e-6, 0.5, 3, 20};

template <class F>
void for_all(F&& f) {
  for (const double zeta : dampings)
    for (const double wn : frequencies) {
      CAPTURE(zeta, wn);
      f(ViscousSlider(zeta, wn));
    }
}

GaussianExcitation shaking() { return {Spectrum::band_pass(1, 2, 4), 0.1, 256}; }

EnsembleOptions options(std::uint64_t members) {
  EnsembleOptions o;
  o.members = members;
  o.seed = 3;
  o.threads = 2;
  return o;
}

}  // namespace

TEST_CASE("a viscous slider under a symmetric pulse moves as thesis (5.14), (5.15) say", "[viscous]") {
  const GroundMotion pulse = steps({1.5, -1.5, 0, 0});
  for (const double zeta : {0.01, 1.0, 4.23, 50.0}) {
    CAPTURE(zeta);
    const Response r = integrate(ViscousSlider(zeta), pulse);
    const double b = 1.5, e = std::exp(-zeta), once = 1 - e;
    const double v[] = {0, -b / zeta * once, b / zeta * (1 - 2 * e + e * e), b / zeta * e * once * once,
                        b / zeta * e * e * once * once};
    // Line 3 with the sign of the errata. (5.15) itself loses digits at small damping, 1 / zeta^2; x goes to b / zeta
    // and back, by four steps and two turns.
    const double x[] = {0, -b / zeta * (1 - once / zeta), b / zeta * ((2 * e - e * e - 1) / zeta),
                        -b / (zeta * zeta) * e * once * once, -b / (zeta * zeta) * e * e * once * once};
    for (std::size_t i = 0; i < 5; ++i) {
      CHECK(r.velocity[i] == Approx(v[i]).epsilon(1e-13).margin(1e-15 / zeta));
      CHECK(r.displacement[i] == Approx(x[i]).epsilon(1e-13).margin(4e-15 / (zeta * zeta) + 4 * epsilon * b / zeta));
    }
  }
}

TEST_CASE("a step of any length is as many shorter ones", "[viscous]") {
  for_all([](const ViscousSlider& s) {
    for (const double duration : {1e-8, 0.01, 0.7, 30.0}) {
      CAPTURE(duration);
      // Straight ground acceleration, in one piece and in 64, from a start that is not at rest.
      std::vector<double> n;
      for (int i = 0; i <= 64; ++i) n.push_back(2 - 3.0 * i / 64);
      const Response one = integrate(s, line(2, -1, duration), from(0.3, -0.2)),
                     many = integrate(s, GroundMotion(n, duration / 64), from(0.3, -0.2));
      // Each of 64 steps has some roundings of the state; in a step a spring is off by one for each radian.
      const double tolerance = (400 + 4 * s.natural_frequency() * duration) * epsilon;
      const double x = one.peak, v = largest(many.velocity);
      CHECK(one.displacement[1] == Approx(many.displacement[64]).margin(tolerance * x));
      CHECK(one.velocity[1] == Approx(many.velocity[64]).margin(tolerance * (v + s.natural_frequency() * x)));
      CHECK(one.peak == Approx(many.peak).epsilon(tolerance));
      CHECK(one.sliding_distance == Approx(many.sliding_distance).epsilon(2 * tolerance).margin(2 * tolerance * x));
      CHECK(one.energy.damped == Approx(many.energy.damped).epsilon(4 * tolerance).margin(1e-300));
      CHECK(one.energy.dissipated == 0);
      CHECK(one.energy.input == Approx(many.energy.input).margin(tolerance * (turnover(many.energy) + 3 * x)));
    }
  });
}

TEST_CASE("energy that comes in is kept or dissipated", "[viscous]") {
  for_all([](const ViscousSlider& s) {
    for (const Interpolation interpolation : {Interpolation::linear, Interpolation::constant}) {
      const Response r = integrate(s, broadband(1, 500, false, interpolation), from(0.4, 0.3));
      // Round-off of 500 steps, each of two radians at most; the energy counts twice.
      CHECK(std::abs(r.energy.imbalance()) < 2 * 500 * 4 * epsilon * turnover(r.energy));
      CHECK((s.damping() == 0 ? r.energy.damped == 0 : r.energy.damped > 0));
      CHECK(r.energy.elastic == Approx(s.stiffness() * r.residual * r.residual / 2));
      CHECK(r.energy.kinetic == Approx(std::pow(r.velocity.back(), 2) / 2));
      CHECK(count(r.events).arrests == 0);  // it turns, and never sticks
      CHECK(r.time_sliding == Approx(49.9));
      CHECK(r.sliding_distance >= r.peak - 0.4);
    }
  });
}

TEST_CASE("a viscous slider is linear: motions add up", "[viscous]") {
  const GroundMotion a = broadband(1, 300), b = broadband(2, 300);
  std::vector<double> both;
  for (std::size_t i = 0; i < 300; ++i) both.push_back(a.acceleration()[i] - 2 * b.acceleration()[i]);
  for_all([&](const ViscousSlider& s) {
    const Response ra = integrate(s, a), rb = integrate(s, b), rc = integrate(s, GroundMotion(both, 0.1));
    const double scale = ra.peak + 2 * rb.peak;
    for (std::size_t i = 0; i < 300; ++i)
      CHECK(std::abs(rc.displacement[i] - (ra.displacement[i] - 2 * rb.displacement[i])) < 300 * 8 * epsilon * scale);
  });
}

TEST_CASE("without damping and spring it is the ground that moves, with much damping nothing does", "[viscous]") {
  const GroundMotion motion = broadband(3, 200);
  const Response free = integrate(ViscousSlider(0), motion), ice = integrate(Coulomb(0), motion);
  CHECK(difference(free.displacement, ice.displacement) < 1e-13 * ice.peak);
  CHECK(free.peak == Approx(ice.peak).epsilon(1e-13));
  CHECK(free.sliding_distance == Approx(ice.sliding_distance).epsilon(1e-13));
  // Strong damping: x' = -n / zeta, except during a time of 1 / zeta.
  const double zeta = 1e9;
  const Response stiff = integrate(ViscousSlider(zeta), motion);
  for (std::size_t i = 1; i < 200; ++i)
    CHECK(stiff.velocity[i] * zeta == Approx(-motion.acceleration()[i]).margin(1e-6));
  // A spring alone swings, and its amplitude stays.
  const Response swing = integrate(ViscousSlider(0, 7), held(0, 1000), from(0.5));
  CHECK(swing.displacement[1] == Approx(0.5 * std::cos(7000.0)).margin(1e-12));
  CHECK(swing.peak == Approx(0.5).epsilon(1e-12));
  CHECK(swing.sliding_distance == Approx(2228 * 1.0 + 0.5 - 0.5 * std::cos(7000 - 2228 * pi)).epsilon(1e-9));
}

TEST_CASE("peak and way count turns between samples", "[viscous]") {
  // One sample of a free vibration that turns twice within: against a thousand.
  for_all([](const ViscousSlider& s) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const std::vector<double> n = gaussian(seed, 12, 1);
      std::vector<double> fine;
      for (std::size_t i = 0; i + 1 < n.size(); ++i)
        for (int k = 0; k < 1000; ++k) fine.push_back(n[i] + (n[i + 1] - n[i]) * k / 1000);
      fine.push_back(n.back());
      const Response coarse = integrate(s, GroundMotion(n, 1)), dense = integrate(s, GroundMotion(fine, 1e-3));
      const double between = largest(dense.velocity) * 1e-3;
      CHECK(coarse.peak >= largest(dense.displacement) * (1 - 1e-9));
      CHECK(coarse.peak <= largest(dense.displacement) + between);
      double way = 0;
      for (std::size_t i = 1; i < fine.size(); ++i) way += std::abs(dense.displacement[i] - dense.displacement[i - 1]);
      CHECK(coarse.sliding_distance == Approx(way).margin(100 * between).epsilon(1e-6));
      CHECK(coarse.sliding_distance >= way * (1 - 1e-9));
    }
  });
}

TEST_CASE("under noise it has the variance of its spectrum", "[viscous]") {
  // pi S0 / zeta of the velocity, pi S0 / (zeta wn^2) of the displacement, and as much for all samples: the band is
  // white to 60 rad/s. Seed fixed; with a new seed it would fail one time in 185 (two quantities, three standard
  // errors).
  const double zeta = 1.2, wn = 3;
  GaussianExcitation excitation(Spectrum::band_pass(1, 0, 60), 0.05, 1024, {.random_amplitudes = true, .period = 4096});
  const Ensemble e = run_ensemble(ViscousSlider(zeta, wn), excitation, options(2000));
  const double beyond = 2.0 / 60, beyond_x = 2.0 / (3 * 60.0 * 60 * 60);  // of white noise, 2 S0 / w and 2 S0 / 3 w^3
  const std::size_t last = 1023;
  const Estimates v = e.velocity_variance(), x = e.displacement_variance();
  CHECK(std::abs(v.value[last] - (pi / zeta - beyond)) < 3 * v.error[last]);
  CHECK(std::abs(x.value[last] - (pi / (zeta * wn * wn) - beyond_x)) < 3 * x.error[last]);
}

TEST_CASE("many viscous sliders side by side are each one by one", "[viscous]") {
  for (const auto& [zeta, wn] :
       {std::pair{0.0, 0.0}, {0.3, 0.0}, {1e4, 0.0}, {0.3, 2.0}, {0.0, 9.9}, {60.0, 9.9}, {0.3, 12.0}}) {
    CAPTURE(zeta, wn);
    const ViscousSlider slider(zeta, wn);
    for (const Interpolation interpolation : {Interpolation::linear, Interpolation::constant}) {
      GaussianOptions how;
      how.interpolation = interpolation;
      const GaussianExcitation excitation(Spectrum::band_pass(1, 2, 25), 0.1, 300, how);
      const Ensemble e = run_ensemble(slider, excitation, options(70));
      const auto peak = e.peak(), residual = e.residual();
      for (std::size_t i = 0; i < 70; ++i) {
        const Response r = integrate(slider, excitation.sample(3, i));
        CHECK(peak[i] == Approx(r.peak).epsilon(300 * 8 * epsilon));
        CHECK(residual[i] == Approx(r.residual).margin(300 * 8 * epsilon * r.peak));
      }
    }
  }
}

TEST_CASE("lanes find the peaks between samples, with each instruction set", "[viscous]") {
  // Segments as long as lanes take, where most peaks lie between samples.
  const double h = 1;
  for (const auto& [zeta, wn] : {std::pair{0.0, 0.0}, {0.5, 0.0}, {0.0, 1.0}, {0.2, 1.0}, {2.0, 1.0}, {9.0, 1.0}}) {
    CAPTURE(zeta, wn);
    const detail::ViscousLanes lanes{ViscousSlider(zeta, wn), DampedBasis(zeta, wn, h)};
    on_each_instruction_set([&](const std::string& set) {
      INFO(set);
      alignas(64) double x[detail::max_lanes] = {}, v[detail::max_lanes] = {}, peak[detail::max_lanes] = {};
      std::vector<Response> one_by_one;
      std::vector<std::vector<double>> n;
      for (std::size_t i = 0; i < detail::max_lanes; ++i) {
        n.push_back(gaussian(100 + i, 60, 1));
        one_by_one.push_back(integrate(lanes.slider, GroundMotion(n[i], h)));
      }
      for (std::size_t k = 1; k < 60; ++k) {
        double start[detail::max_lanes], end[detail::max_lanes];
        for (std::size_t i = 0; i < detail::max_lanes; ++i) {
          start[i] = n[i][k - 1];
          end[i] = n[i][k];
        }
        advance_lanes(lanes, detail::max_lanes, start, end, {x, v, peak});
      }
      for (std::size_t i = 0; i < detail::max_lanes; ++i) {
        CHECK(peak[i] == Approx(one_by_one[i].peak).epsilon(1e-12));
        CHECK(x[i] == Approx(one_by_one[i].residual).margin(1e-12 * one_by_one[i].peak));
      }
    });
  }
}

TEST_CASE("an ensemble under pulses, whose times are uneven, is its members", "[viscous]") {
  const PoissonPulses pulses(2, 0.3, 1, 12);
  for (const ViscousSlider& slider : {ViscousSlider(0.4), ViscousSlider(0.4, 15)}) {
    EnsembleOptions o = options(20);
    o.dt = 0.25;
    const Ensemble e = run_ensemble(slider, pulses, o);
    const auto peak = e.peak(), residual = e.residual();
    double last = 0;
    for (std::size_t i = 0; i < 20; ++i) {
      const Response r = integrate(slider, pulses.sample(3, i));
      CHECK(peak[i] == Approx(r.peak).epsilon(1e-12));
      CHECK(residual[i] == Approx(r.residual).margin(1e-12 * r.peak));
      last += r.residual / 20;
    }
    CHECK(e.displacement_mean().value.back() == Approx(last).margin(1e-12));
  }
  CHECK(run_ensemble(ViscousSlider(0.4), pulses, options(2)).configuration()[0].second ==
        R"({"law": "Coulomb", "slip_level": 0, "backward": 0, "natural_frequency": 0, "damping": 0.4})");
}

TEST_CASE("invalid arguments of a viscous slider are rejected", "[viscous]") {
  CHECK_THROWS_WITH(ViscousSlider(-1), "Slider: damping and its square must be finite and at least 0, got -1 1/s");
  CHECK_THROWS_AS(ViscousSlider(infinity), std::invalid_argument);
  CHECK_THROWS_AS(ViscousSlider(not_a_number), std::invalid_argument);
  CHECK_THROWS_WITH(ViscousSlider(1, -2), "Slider: natural_frequency must be finite and at least 0, got -2 rad/s");
  CHECK_THROWS_AS(ViscousSlider(1, 1e200), std::invalid_argument);
  const GroundMotion motion = line(0, 1, 1);
  CHECK_THROWS_WITH(integrate(ViscousSlider(1), motion, from(0, 0, true)), ContainsSubstring("does not come to rest"));
  CHECK_THROWS_AS(integrate(ViscousSlider(1), motion, from(not_a_number)), std::invalid_argument);
  CHECK_THROWS_AS(integrate(ViscousSlider(1), motion, from(0, infinity)), std::invalid_argument);
  CHECK_THROWS_AS(integrate(ViscousSlider(0, 1e8), motion, from(1)), ConvergenceError);
  CHECK_THROWS_AS(integrate(ViscousSlider(0), held(1e100, 1e200)), std::overflow_error);
  EnsembleOptions settle = options(2);
  settle.settle = true;
  CHECK_THROWS_WITH(run_ensemble(ViscousSlider(1), shaking(), settle), ContainsSubstring("does not come to rest"));
  IntegrateOptions how;
  how.progress = [] { throw std::runtime_error("enough"); };
  CHECK_THROWS_WITH(integrate(ViscousSlider(1), broadband(1, 20000), how), "enough");
}
