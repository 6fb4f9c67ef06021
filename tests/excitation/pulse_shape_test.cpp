// Pulses by their spectrum: that they have it, that they are of minimum phase, and shapes known in closed form.
#include "stickslip/excitation/pulse_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "stickslip/excitation/poisson.hpp"
#include "support/catch.hpp"
#include "support/mean.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;

namespace {

constexpr double pi = std::numbers::pi;

const Spectrum soil = Spectrum::kanai_tajimi(0.05, 15, 0.6), ground = Spectrum::clough_penzien(0.05, 15, 0.6, 1.5, 0.6),
               exponential = Spectrum::from_function([](double w) { return 4 / (1 + w * w); }, 0);

/// The integral of |density - S| from 0 to pi / dt over that of S, by frequencies that the library does not look at.
double misfit(const PoissonPulses& pulses, const Spectrum& spectrum, double dt) {
  constexpr int points = 2503;
  double off = 0, all = 0;
  for (int i = 0; i < points; ++i) {
    const double omega = pi / dt * (i + 0.5) / points;
    off += std::abs(pulses.density(omega) - spectrum(omega));
    all += spectrum(omega);
  }
  return off / all;
}

std::vector<double> values(const PulseShape& shape) { return {shape.values().begin(), shape.values().end()}; }

/// The running sums of the squares.
std::vector<double> partial_energy(const std::vector<double>& w) {
  std::vector<double> sums;
  double sum = 0;
  for (const double value : w) sums.push_back(sum += value * value);
  return sums;
}

}  // namespace

TEST_CASE("pulses with the shape of a spectrum have that spectrum", "[pulse_shape]") {
  const double dt = 0.01;
  for (const Spectrum& spectrum :
       {soil, ground, exponential, Spectrum::white(2), Spectrum::from_table({0, 5, 10, 400}, {0.05, 1, 0.2, 0.1})})
    for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
      const PoissonPulses pulses = PoissonPulses::from_spectrum(spectrum, 3, 60, dt, tolerance);
      CAPTURE(spectrum.configuration(), tolerance, pulses.options().shape.values().size());
      CHECK(misfit(pulses, spectrum, dt) < 1.05 * tolerance);  // 5 % for the frequencies being others
      // The rate only shares lambda sigma^2 with sigma.
      const PoissonPulses many = PoissonPulses::from_spectrum(spectrum, 300, 1, dt, tolerance);
      CHECK(many.options().shape == pulses.options().shape);
      CHECK(many.sigma() == Approx(pulses.sigma() / 10).epsilon(1e-13));
      CHECK(many.density(7) == Approx(pulses.density(7)).epsilon(1e-12));
    }
}

TEST_CASE("the thesis's pulse comes back from its own spectrum", "[pulse_shape]") {
  // (5.6) has double zeros at omega = 0 and 2 pi / Dt, 4 pi / Dt, ...: all zeros of the pulse are on the unit circle,
  // which still is minimum phase. With 8 pieces to a half width: eight of +1, eight of -1. Each zero on the circle is
  // found by its neighborhood of 1 / 2048 of the band; its values are off by less than that.
  const PoissonPulses thesis(3, 1.0 / 6, 2.5, 60);
  const Spectrum spectrum = Spectrum::from_function([&](double w) { return thesis.density(w); }, 0, 1e4);
  const PoissonPulses found = PoissonPulses::from_spectrum(spectrum, 3, 60, 1.0 / 48);
  const std::vector<double> w = values(found.options().shape);
  REQUIRE(w.size() == 16);
  for (std::size_t i = 0; i < 16; ++i) CHECK(w[i] == Approx(i < 8 ? 1 : -1).margin(2e-3));
  CHECK(found.options().shape.length() == Approx(1.0 / 3).epsilon(1e-15));
  CHECK(found.sigma() == Approx(2.5).epsilon(2e-3));
}

TEST_CASE("a spectrum of one pole makes a pulse that decays exponentially", "[pulse_shape]") {
  // S = 4 / (1 + omega^2): w = exp(-t), 2 pi S = lambda sigma^2 |w_hat 2 pi|^2. The pieces tend to it with dt, one
  // power of dt at least: the correction for steps moves them by less than a piece.
  double before = 0;
  for (const double dt : {0.04, 0.02, 0.01}) {
    const PoissonPulses pulses = PoissonPulses::from_spectrum(exponential, 2, 60, dt, 1e-5);
    const std::vector<double> w = values(pulses.options().shape);
    double largest = 0;
    for (std::size_t i = 0; i < w.size(); ++i)
      largest = std::max(largest, std::abs(w[i] - std::exp(-dt * static_cast<double>(i))));
    CAPTURE(dt, largest);
    CHECK(largest < dt);
    if (before > 0) CHECK(largest < 0.6 * before);
    before = largest;
    CHECK(pulses.rate() * pulses.sigma() * pulses.sigma() == Approx(8 * pi).epsilon(2 * dt));
  }
}

TEST_CASE("a pulse by its spectrum is of minimum phase", "[pulse_shape]") {
  // A first value w_0 of a causal pulse is at most exp(mean of log |W| around the circle), and only minimum phase has
  // it (Jensen). For an amplitude that is smooth around the circle the mean by the midpoint rule has no error.
  const double dt = 0.01;
  for (const Spectrum& spectrum : {soil, exponential, Spectrum::white(2)}) {
    const PoissonPulses pulses = PoissonPulses::from_spectrum(spectrum, 4, 60, dt, 1e-6);
    const std::vector<double> w = values(pulses.options().shape);
    const int points = 100'000;
    double mean = 0;
    for (int i = 0; i < points; ++i) {
      const double u = pi / 2 * (i + 0.5) / points, loss = std::sin(u) / u * dt;
      mean += std::log(2 * pi * spectrum(2 * u / dt)) / 2 - std::log(loss);
    }
    CHECK(std::sqrt(pulses.rate()) * pulses.sigma() * w[0] == Approx(std::exp(mean / points)).epsilon(1e-4));

    // Its energy comes no later than that of any other pulse with the same amplitude: passed through an all-pass
    // filter, and played backward.
    const std::vector<double> earliest = partial_energy(w);
    for (const double a : {-0.5, 0.3, 0.9}) {
      std::vector<double> later = w;
      later.resize(w.size() + 2000);
      double in = 0, out = 0;  // y_k = a y_k-1 - a x_k + x_k-1
      for (double& value : later) {
        const double y = a * out - a * value + in;
        in = value;
        value = out = y;
      }
      const std::vector<double> passed = partial_energy(later);
      CHECK(passed.back() == Approx(earliest.back()).epsilon(1e-10));
      for (std::size_t i = 0; i < earliest.size(); ++i) CHECK(passed[i] < earliest[i] * (1 + 1e-12));
      CHECK(passed[0] == Approx(a * a * earliest[0]).epsilon(1e-12));
    }
    const std::vector<double> backward = partial_energy({w.rbegin(), w.rend()});
    for (std::size_t i = 0; i < w.size(); ++i) CHECK(backward[i] < earliest[i] * (1 + 1e-12));
  }
}

TEST_CASE("a pulse leaves the ground no velocity where its spectrum begins at zero", "[pulse_shape]") {
  // S rises as omega^4: no displacement either. What is left of both sums is rounding.
  const PoissonPulses still = PoissonPulses::from_spectrum(ground, 3, 60, 0.01);
  const std::vector<double> w = values(still.options().shape);
  double net = 0, moment = 0, size = 0, away = 0;
  for (std::size_t i = 0; i < w.size(); ++i) {
    net += w[i];
    size += std::abs(w[i]);
    moment += w[i] * static_cast<double>(i);
    away += std::abs(w[i]) * static_cast<double>(i);
  }
  CHECK(std::abs(net) < 1e-13 * size);
  CHECK(std::abs(moment) < 1e-13 * away);
  // The variance of the ground velocity is the integral of S / omega^2.
  double velocity = 0;
  const double step = 1e-3;
  for (int i = 1; i < 314'159; ++i) velocity += 2 * step * ground(i * step) / (i * step * i * step);
  CHECK(still.ground_velocity_variance() == Approx(velocity).epsilon(5e-3));
  CHECK(still.ground_displacement_variance(1e3) < 1e-20);

  CHECK(PoissonPulses::from_spectrum(soil, 3, 60, 0.01).ground_velocity_variance() == infinity);
}

TEST_CASE("a shape by its spectrum has its units", "[pulse_shape]") {
  // Ten times the strength, or everything five times as slow, is the same shape.
  const PulseShape one = PulseShape::from_spectrum(ground, 0.01);
  const auto scaled = [](double strength, double slow) {
    return Spectrum::clough_penzien(strength * 0.05, 15 / slow, 0.6, 1.5 / slow, 0.6);
  };
  const PulseShape strong = PulseShape::from_spectrum(scaled(100, 1), 0.01),
                   slow = PulseShape::from_spectrum(scaled(1, 5), 0.05);
  REQUIRE(strong.values().size() == one.values().size());
  REQUIRE(slow.values().size() == one.values().size());
  for (std::size_t i = 0; i < one.values().size(); ++i) {
    CHECK(strong.values()[i] == Approx(one.values()[i]).margin(1e-12));
    CHECK(slow.values()[i] == Approx(one.values()[i]).margin(1e-10));
    CHECK(slow.times()[i] == Approx(5 * one.times()[i]).epsilon(1e-14));
  }
  CHECK(*std::ranges::max_element(one.values()) == 1);
}

TEST_CASE("motions of pulses by their spectrum have that spectrum", "[pulse_shape][statistics]") {
  // The mean periodogram of 300 motions of 40 s, seed fixed. A finite window smooths: its expectation is the density
  // convolved with T / 2 pi sinc^2(omega T / 2), whose tails leak from the whole band.
  const double dt = 0.05, duration = 40;
  const PoissonPulses pulses = PoissonPulses::from_spectrum(ground, 1, duration, dt, 1e-3, {.stationary_start = true});
  const std::array<double, 7> omegas = {1.1, 2.0, 4.66, 9.5, 15.0, 25.0, 40.0};
  std::array<Mean, 7> periodogram;
  for (std::uint64_t member = 0; member < 300; ++member) {
    const GroundMotion motion = pulses.sample(5, member);
    for (std::size_t k = 0; k < omegas.size(); ++k) {
      std::complex<double> sum = 0, from = 1;
      for (std::size_t i = 0; i < motion.segments(); ++i) {
        const std::complex<double> to = std::polar(1.0, -omegas[k] * motion.time(i + 1));
        sum += motion.acceleration()[i] * (to - from);
        from = to;
      }
      periodogram[k].add(std::norm(sum) / (omegas[k] * omegas[k] * 2 * pi * duration));
    }
  }
  for (std::size_t k = 0; k < omegas.size(); ++k) {
    double expected = 0;
    const double step = 0.004;
    for (double w = -60 + step / 2; w < 60; w += step) {
      const double u = (w - omegas[k]) * duration / 2, window = u == 0 ? 1 : std::sin(u) / u;
      expected += ground(w) * window * window * duration / (2 * pi) * step;
    }
    CAPTURE(omegas[k], periodogram[k].value(), periodogram[k].error(), expected);
    // Once in 2000, each of 7; 1e-3 is the shape's tolerance.
    CHECK(std::abs(periodogram[k].value() - expected) < 3.5 * periodogram[k].error() + 0.005 * expected);
    CHECK(periodogram[k].error() < 0.1 * expected);  // 1 / sqrt(members), and more for pulses that are few
  }
}

TEST_CASE("spectra that no pulse has are refused", "[pulse_shape][errors]") {
  const auto from = [](const Spectrum& s, double dt = 0.01, double tolerance = 1e-3) {
    return PulseShape::from_spectrum(s, dt, tolerance);
  };
  CHECK_THROWS_WITH(from(soil, 0), "PulseShape: dt must be positive and finite, got 0 s");
  CHECK_THROWS_WITH(from(soil, not_a_number), "PulseShape: dt must be positive and finite, got nan s");
  CHECK_THROWS_WITH(from(soil, 0.01, 1e-7), "PulseShape: the tolerance must be from 1e-6 to 0.1, got 1e-07");
  CHECK_THROWS_WITH(from(soil, 0.01, not_a_number), ContainsSubstring("tolerance"));
  CHECK_THROWS_WITH(from(Spectrum::band_pass(1, 0, 100)),
                    ContainsSubstring("must reach pi / dt = 314.159") && ContainsSubstring("ends at, got 100 rad/s"));
  CHECK_THROWS_WITH(from(Spectrum::band_pass(1, 2, 400)),
                    ContainsSubstring("must be positive from 0 to pi / dt") && ContainsSubstring("at omega = 0 rad/s"));
  CHECK_THROWS_WITH(from(Spectrum::from_table({0, 10, 15, 400}, {1, 0, 0, 1})),
                    ContainsSubstring("must be positive") && ContainsSubstring("at omega = 10."));
  CHECK_THROWS_WITH(from(Spectrum::from_table({0, 10, 400}, {0, 1, 1})),
                    ContainsSubstring("must rise as an even power of omega") && ContainsSubstring("got 1"));
  CHECK_THROWS_WITH(from(Spectrum::kanai_tajimi(1, 15, 1e-6)), ContainsSubstring("too sharp for so short a dt"));
  CHECK_THROWS_WITH(PoissonPulses::from_spectrum(soil, 0, 60, 0.01),
                    "PoissonPulses: rate must be positive and finite, got 0 per second");
  CHECK_THROWS_WITH(PoissonPulses::from_spectrum(soil, 1, 60, 0.01, 1e-3, {.shape = PulseShape({0, 1}, {1})}),
                    ContainsSubstring("must get no other"));
}
