// Equivalent linearization with the states of a filter, envelopes, unequal levels, dampers and the Laplacian density:
// against quadrature, closed forms, the frequency domain and the exact answers to white noise.
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "stickslip/theory/equivalent_linearization.hpp"
#include "stickslip/theory/shaping_filter.hpp"
#include "stickslip/theory/stationary_linearization.hpp"
#include "stickslip/theory/white_noise.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;
using std::numbers::pi;
using theory::EquivalentLinearization;
using theory::ShapedNoise;
using theory::ShapingFilter;
using theory::StationaryLinearization;
using theory::WhiteNoise;
using Force = EquivalentLinearization::Force;

namespace {

double relative(double found, double value) { return std::abs(found / value - 1); }

const EquivalentLinearization by_gauss, by_laplace({.force = Force::laplace}), by_thesis({.force = Force::thesis});
const Spectrum soil = Spectrum::kanai_tajimi(0.02, 15, 0.6), ground = Spectrum::clough_penzien(0.02, 15, 0.6, 1.5, 0.7);

/// A level with a ridge beside x = 0, symmetric.
struct Ridge {
  double level, height;
  template <class T>
  auto resist(const T& x, Direction) const {
    using std::exp;
    return level + height * (x * x) * exp(-(x * x));
  }
};

/// Largest relative distance of the second moments; that of the covariance in units of the two variances.
double apart(const Moments& a, const Moments& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.time.size(); ++i) {
    const double q11 = b.displacement_variance.value[i], q22 = b.velocity_variance.value[i];
    largest =
        std::max({largest, relative(a.displacement_variance.value[i], q11), relative(a.velocity_variance.value[i], q22),
                  std::abs(a.covariance.value[i] - b.covariance.value[i]) / std::sqrt(q11 * q22)});
  }
  return largest;
}

/// Simpson's rule of 2 n intervals.
template <class F>
double simpson(const F& f, double low, double high, int n) {
  const double h = (high - low) / (2 * n);
  double sum = f(low) + f(high);
  for (int i = 1; i < 2 * n; ++i) sum += f(low + i * h) * (i % 2 == 1 ? 4 : 2);
  return sum * h / 3;
}

/// The autocovariance of Kanai-Tajimi's acceleration, damping z < 1.
double soil_covariance(double s0, double w, double z, double lag) {
  const double root = std::sqrt(1 - z * z), angle = root * w * lag;
  return pi * s0 * w / (2 * z) * std::exp(-z * w * lag) *
         ((1 + 4 * z * z) * std::cos(angle) + z / root * (1 - 4 * z * z) * std::sin(angle));
}

/// A user's law that is Coulomb's.
struct Flat {
  double a;
  template <class T>
  double resist(const T&, Direction) const {
    return a;
  }
};

}  // namespace

TEST_CASE("the filters of Kanai, Tajimi, Clough and Penzien have their spectra", "[shaping_filter]") {
  for (const auto& [spectrum, order] : {std::pair{Spectrum::white(0.3), 0}, {soil, 2}, {ground, 4}}) {
    const ShapingFilter filter = ShapingFilter::of(spectrum);
    CHECK(filter.order() == order);
    CHECK(filter.misfit() == 0);
    for (const double omega : {0.01, 1.0, 1.5, 14.0, 15.0, 300.0})
      CHECK(relative(filter(omega), spectrum(omega)) < 1e-14);  // some ten roundings
  }
  CHECK(ShapingFilter::of(ground)(0) == 0);
}

TEST_CASE("a fit says by how much it misses its spectrum", "[shaping_filter]") {
  for (const auto& [low, high] : {std::pair{2.0, 4.0}, {2.0, 12.0}, {0.0, 4.0}, {0.1, 4.0}}) {
    const Spectrum band = Spectrum::band_pass(3, low, high);
    const ShapingFilter filter = ShapingFilter::of(band);
    CAPTURE(low, high);
    CHECK(filter.order() == 8);
    // Inside the band it is |3 - S|, outside all of S, whose tail falls as omega^-2 or faster.
    const auto missed = [&](double omega) { return std::abs(filter(omega) - band(omega)); };
    const double sum = simpson(missed, low * (1 + 1e-9), high * (1 - 1e-9), 20'000) +
                       simpson(missed, 0, low * (1 - 1e-9), 20'000) +
                       simpson([&](double u) { return missed(high / u) * high / (u * u); }, 1e-6, 1 - 1e-9, 200'000);
    CHECK(filter.misfit() == Approx(sum / (3 * (high - low))).epsilon(0.02));  // by trapezoids over 0.6 % steps
    CHECK(filter.misfit() < 0.14);
    CHECK((filter(0) == 0) == (low > 0));
  }
  const auto misfit = [](const Spectrum& spectrum, int order) {
    return ShapingFilter::of(spectrum, {order, 10}).misfit();
  };
  // A spectrum that is rational itself is found; a smooth one nearly; a band the better, the more states.
  CHECK(misfit(Spectrum::from_function([](double w) { return 2 / (1 + std::pow(w / 5, 4)); }, 0), 2) < 1e-4);
  CHECK(misfit(Spectrum::from_function([](double w) { return std::exp(-w * w / 8); }, 0), 4) < 0.01);
  const Spectrum band = Spectrum::band_pass(1, 2, 4);
  CHECK(misfit(band, 8) < misfit(band, 6));
  CHECK(misfit(band, 6) < misfit(band, 4));
  // Frequency and level only set the units.
  CHECK(relative(misfit(Spectrum::band_pass(1e-6, 2e3, 4e3), 8), misfit(band, 8)) < 1e-3);
}

TEST_CASE("what is no filter, or has none, is refused with its error", "[shaping_filter]") {
  const Spectrum band = Spectrum::band_pass(1, 2, 4);
  CHECK_THROWS_WITH(ShapingFilter::of(band, {.order = 4}), ContainsSubstring("no filter of order 4 fits the spectrum: "
                                                                             "the best misplaces 0.4"));
  CHECK_THROWS_WITH(ShapingFilter::of(band, {.order = 8, .max_misfit = 0.01}), ContainsSubstring("max_misfit is 0.01"));
  for (const int order : {0, 3, 18, -2})
    CHECK_THROWS_WITH(ShapingFilter::of(band, {.order = order}), ContainsSubstring("order must be 2, 4, ... or 16"));
  CHECK_THROWS_WITH(ShapingFilter::of(band, {.max_misfit = not_a_number}), ContainsSubstring("must be above 0"));
  CHECK_THROWS_WITH(ShapingFilter(1, {{0, 1, 1, -0.1, 4}}),
                    ContainsSubstring("section 0 is unstable: d1 must be positive and finite, got -0.1 1/s"));
  CHECK_THROWS_WITH(ShapingFilter(1, {{0, 1, 1, 1, 1}, {0, 1, 1, 1, -4}}),
                    ContainsSubstring("section 1 is unstable: d0 must be positive and finite, got -4 1/s^2"));
  CHECK_THROWS_WITH(ShapingFilter(1, {{0, not_a_number, 1, 1, 1}}), ContainsSubstring("b1 must be finite, got nan"));
  CHECK_THROWS_WITH(ShapingFilter(1, {{0, 0, 0, 1, 1}}), ContainsSubstring("must differ from 0"));
  CHECK_THROWS_WITH(ShapingFilter(-1), ContainsSubstring("s0 must be positive"));
  CHECK_THROWS_WITH(ShapingFilter(1, std::vector(9, ShapingFilter::Section{0, 1, 1, 1, 1})),
                    ContainsSubstring("at most 8 sections, got 9"));
}

TEST_CASE("a linear oscillator on filtered noise has the moments of the frequency domain", "[shaped_linearization]") {
  // From rest, by integrals over the spectrum, 1e-8; and the floor below which velocities count as rest.
  const std::vector<double> times = {0.1, 1, 4, 20};
  for (const Spectrum& spectrum : {soil, ground, Spectrum::white(0.02)})
    for (const auto& [wn, c] : {std::pair{3.0, 0.0}, {3.0, 0.4}, {0.0, 0.4}, {0.0, 0.0}}) {
      const theory::StationaryPrediction exact{c, 0, 0, 0, "", spectrum, wn};
      CAPTURE(spectrum.configuration(), wn, c);
      if (c == 0 && wn == 0 && spectrum == soil) continue;  // quadrature does not resolve it
      CHECK(apart(by_gauss.predict(Slider(Coulomb(0), wn, c), spectrum, times), exact.transient(times)) < 1e-7);
    }
  // Stationary: int S / |wn^2 - omega^2 + i c omega|^2.
  const double wn = 3, c = 0.4;
  const Moments late = by_gauss.stationary(Slider(Coulomb(0), wn, c), soil);
  const auto gain = [&](double omega) {
    return soil(omega) / (std::pow(wn * wn - omega * omega, 2) + c * c * omega * omega);
  };
  CHECK(relative(late.displacement_variance.value[0], 2 * simpson(gain, 0, 400, 400'000)) < 1e-8);
  CHECK(late.time[0] == infinity);
  CHECK(late.covariance.value[0] == 0);
}

TEST_CASE("without friction an envelope's variances are integrals over it", "[shaped_linearization]") {
  const std::vector<double> times = {0.5, 2, 3.5, 6, 9};
  const Envelope swelling(2, 2, 0.4), table = Envelope::from_table({1, 3, 8}, {0.5, 2, 0.25});
  GaussianOptions options{.zero_frequency = true};
  for (const Envelope& envelope : {swelling, table}) {
    options.envelope = envelope;
    const auto pieces = [&](const auto& f, double t) {  // split where it bends
      double sum = 0, from = 0;
      for (const double cut : {1.0, 2.0, 3.0, 4.0, 8.0, t})
        if (cut <= t && cut > from) {
          sum += simpson(f, from * (1 + 1e-15), cut * (1 - 1e-15), 200);
          from = cut;
        }
      return sum;
    };
    // White noise of level S0: E v^2 = 2 pi S0 int e^2, E x v with (t - s), E x^2 with (t - s)^2
    const double s0 = 0.3;
    const Moments white =
        by_gauss.predict(Coulomb(0), GaussianExcitation(Spectrum::white(s0), 0.1, 256, options), times);
    for (std::size_t i = 0; i < times.size(); ++i) {
      const double t = times[i];
      const auto power = [&](int p) {
        return 2 * pi * s0 * pieces([&](double s) { return std::pow(envelope(s), 2) * std::pow(t - s, p); }, t);
      };
      CAPTURE(envelope.configuration(), t);
      CHECK(white.velocity_variance.value[i] == Approx(power(0)).epsilon(1e-8).margin(1e-12));
      CHECK(white.covariance.value[i] == Approx(power(1)).epsilon(1e-8).margin(1e-12));
      CHECK(white.displacement_variance.value[i] == Approx(power(2)).epsilon(1e-8).margin(1e-12));
    }
    // Kanai-Tajimi: E v^2 = 2 int_0^t e(s) int_0^s e(u) R(s - u) du ds
    const double w = 6, z = 0.5;
    const std::array<double, 1> one = {6};
    const Moments shaped =
        by_gauss.predict(Coulomb(0), GaussianExcitation(Spectrum::kanai_tajimi(s0, w, z), 0.1, 256, options), one);
    const double variance =
        2 * pieces(
                [&](double s) {
                  return envelope(s) *
                         pieces([&](double u) { return envelope(u) * soil_covariance(s0, w, z, s - u); }, s);
                },
                one[0]);
    CHECK(relative(shaped.velocity_variance.value[0], variance) < 1e-7);
  }
}

TEST_CASE("n states agree with the two of white noise", "[shaped_linearization]") {
  // A damper that does nothing takes them through the general equations; what creeps below the floor leaves 1e-8.
  const std::vector<double> times = {0.1, 1, 10, 100};
  const auto same = [&](const EquivalentLinearization& el, const auto& law, double wn) {
    CAPTURE(el.name(), wn);
    CHECK(apart(el.predict(Slider(law, wn, 1e-300), 1.0, times), el.predict(Slider(law, wn), 1.0, times)) < 1e-7);
  };
  for (const double wn : {0.0, 0.7}) {
    for (const EquivalentLinearization& el : {by_gauss, by_laplace, by_thesis}) same(el, Coulomb(1), wn);
    for (const EquivalentLinearization& el :
         {by_gauss, by_thesis, EquivalentLinearization({.force = Force::gaussian_a22})})
      for (const double reach : {0.5, 20.0}) same(el, Caster(1, reach), wn);
    same(by_gauss, Flat{1}, wn);
  }
}

TEST_CASE("by the Laplacian density the stationary velocity is exact and the growth four fifths",
          "[shaped_linearization]") {
  for (const auto& [a, s0] : {std::pair{1.0, 1.0}, {0.3, 2.0}}) {
    const double d = pi * s0;
    const Moments late = by_laplace.stationary(Slider(Coulomb(a)), s0);
    CAPTURE(a, s0);
    CHECK(relative(late.velocity_variance.value[0], 2 * d * d / a / a) < 1e-10);             // (3.48)
    CHECK(relative(late.growth_rate.value, 0.8 * 10 * d * d * d / std::pow(a, 4)) < 1e-10);  // (3.49)
    CHECK(late.displacement_variance.value[0] == infinity);
    const std::array<double, 2> times = {1e3 * s0 / a / a, 2e3 * s0 / a / a};
    const Moments m = by_laplace.predict(Coulomb(a), s0, times);
    CHECK(relative(m.velocity_variance.value[1], 2 * d * d / a / a) < 1e-8);
    CHECK(relative((m.displacement_variance.value[1] - m.displacement_variance.value[0]) / (times[1] - times[0]),
                   m.growth_rate.value) < 1e-8);
    CHECK(relative(m.growth_rate.value, late.growth_rate.value) < 1e-10);
    CHECK_THAT(m.remark, ContainsSubstring("velocity variance is exact"));
  }
  // Unequal levels have a Laplacian of two sides, and its mean and variance.
  const Coulomb slope(1, 1.5);
  const Moments late = by_laplace.stationary(Slider(slope), 0.7);
  const WhiteNoise exact(slope, 0.7);
  const double d = pi * 0.7;
  CHECK(relative(late.velocity_mean.value[0], d - d / 1.5) < 1e-10);
  CHECK(relative(late.velocity_variance.value[0], d * d * (1 + 1 / 2.25)) < 1e-10);
  CHECK(late.growth_rate.value == Approx(exact.growth_rate()).epsilon(0.3));
  const std::array<double, 3> times = {1, 10, 300};
  const Moments m = by_laplace.predict(slope, 0.7, times), known = exact.predict(times);
  CHECK(relative(m.velocity_mean.value[2], d - d / 1.5) < 1e-6);
  for (const std::size_t i : {0U, 1U, 2U}) {  // from rest the velocity is not yet Laplacian: measured, 8 %
    CHECK(m.velocity_mean.value[i] == Approx(known.velocity_mean.value[i]).epsilon(0.08));
    CHECK(m.velocity_variance.value[i] == Approx(known.velocity_variance.value[i]).epsilon(0.08));
  }
}

TEST_CASE("stationary linearization is where the general one ends", "[shaped_linearization]") {
  const StationaryLinearization thesis;
  for (const Spectrum& spectrum : {soil, ground, Spectrum::white(0.02)})
    for (const auto& [a, wn] : {std::pair{0.5, 0.0}, {0.2, 0.0}, {0.5, 2.0}, {1.2, 1.0}}) {
      const Slider slider(Coulomb(a), wn);
      const theory::StationaryPrediction p = thesis.predict(slider, spectrum);
      const Moments late = by_gauss.stationary(slider, spectrum);
      CAPTURE(spectrum.configuration(), a, wn);
      CHECK(relative(late.velocity_variance.value[0], p.velocity_std * p.velocity_std) < 1e-8);
      CHECK(late.growth_rate.value == Approx(p.growth_rate).epsilon(1e-8).margin(1e-15));
      if (wn > 0) CHECK(relative(late.displacement_variance.value[0], std::pow(p.displacement_std, 2)) < 1e-8);
      if (wn > 0) CHECK(apart(by_gauss.predict(slider, spectrum, std::array<double, 1>{200}), late) < 1e-7);
    }
  // The same for cases that only the general equations cover.
  const std::array<double, 1> long_after = {300};
  const auto ends = [&](const auto& slider, const ShapedNoise& noise) {
    return apart(by_gauss.predict(slider, noise, long_after), by_gauss.stationary(slider, noise));
  };
  CHECK(ends(Slider(Caster(0.5, 0.3), 2), soil) < 1e-7);
  CHECK(ends(Slider(Caster(0.5, 0.3), 2, 0.3), ground) < 1e-7);
  CHECK(ends(Slider(Coulomb(0.5, 0.8), 2), soil) < 1e-7);
  CHECK(ends(Slider(Coulomb(0.5), 2, 0.3), PoissonPulses(20, 0.1, 2, 10)) < 1e-7);
}

TEST_CASE("there is no stationary solution where nothing holds the motion", "[shaped_linearization]") {
  const auto why = [&](const auto& slider, const ShapedNoise& noise, const std::string& reason) {
    CHECK_THROWS_WITH(by_gauss.stationary(slider, noise), ContainsSubstring("no stationary solution: " + reason));
  };
  why(Slider(Coulomb(0)), soil, "without friction and damper nothing takes the energy");
  why(Slider(Coulomb(0), 3), soil, "without friction and damper nothing takes the energy");
  why(Slider(Caster(1, 2)), soil, "without a spring the displacement grows, and with it changes the slip level");
  why(Slider(Caster(1, 10), 0.3), 1.0, "friction does not take up what the noise gives");  // a reach wn < pi S0
  why(Slider(Coulomb(0, 1)), 1.0, "friction in one direction only");
  const GaussianOptions fading{.envelope = Envelope(1, 2, 3)};
  why(Slider(Coulomb(1), 1), GaussianExcitation(soil, 0.05, 256, fading), "the envelope");
  CHECK(std::isnan(by_gauss.predict(Caster(1, 2), soil, std::array<double, 1>{1}).growth_rate.value));
  // Without a spring the velocity alone is stationary, and the displacement that does not grow depends on the start.
  const Moments late = by_gauss.stationary(Slider(Coulomb(0.5)), ground);
  CHECK(late.growth_rate.value == 0);
  CHECK(std::isnan(late.displacement_variance.value[0]));
  CHECK_THAT(late.remark, ContainsSubstring("without a spring the displacement has no stationary variance"));
}

TEST_CASE("a caster with rolling resistance grows at last as Coulomb friction of that level",
          "[shaped_linearization]") {
  const std::vector<double> times = {2e3, 4e3};
  const auto found = [&](const auto& slider, const Spectrum& spectrum) {
    return by_gauss.predict(slider, spectrum, times);
  };
  for (const Spectrum& spectrum : {soil, Spectrum::white(0.02)}) {
    const Moments m = found(Slider(Caster(0.6, 1e-3, 0.3)), spectrum);
    const double rate = m.growth_rate.value;
    CAPTURE(spectrum.configuration());
    CHECK(relative(rate, StationaryLinearization().predict(Slider(Coulomb(0.3)), spectrum).growth_rate) < 1e-8);
    CHECK(relative((m.displacement_variance.value[1] - m.displacement_variance.value[0]) / 2e3, rate) < 0.02);
    // The first second suffices to know it.
    CHECK(by_gauss.predict(Caster(0.6, 1e-3, 0.3), spectrum, std::array<double, 1>{1}).growth_rate.value == rate);
  }
  CHECK(by_gauss.predict(Caster(0.6, 300, 0.3), 0.02, std::array<double, 1>{1}).growth_rate.value ==
        by_gauss.predict(Coulomb(0.3), 0.02, std::array<double, 1>{1}).growth_rate.value);
  // With a damper, also where no friction is left.
  for (const double rolling : {0.0, 0.3}) {
    const Moments m = found(Slider(Caster(0.4, 1e-3, rolling), 0.0, 0.5), soil);
    const double growth = m.displacement_variance.value[1] - m.displacement_variance.value[0];
    CAPTURE(rolling);
    CHECK(relative(growth / 2e3, m.growth_rate.value) < 0.02);
  }
  // Held at the start it remains there, although it could roll.
  const Moments held = found(Slider(Caster(3, 0.1, 0.1)), soil);
  CHECK(held.growth_rate.value == 0);
  CHECK(held.displacement_variance.value == std::vector<double>{0, 0});
  // The same for any law that is constant far away, unless a ridge on the way might hold the slider.
  const auto far = [&](double ridge) { return found(Slider(Ridge{0.3, ridge}), soil).growth_rate.value; };
  CHECK(relative(far(0.1), found(Slider(Coulomb(0.3)), soil).growth_rate.value) < 1e-10);
  CHECK(std::isnan(far(6)));
}

TEST_CASE("below the threshold of motion nothing moves", "[shaped_linearization]") {
  // sigma_n < sqrt(2 / pi) a, (4.22).
  const double a = 1.3 * std::sqrt(soil.variance());
  for (const double wn : {0.0, 2.0}) {
    const Moments m = by_gauss.predict(Slider(Coulomb(a), wn), soil, std::array<double, 2>{1, 20});
    CHECK(m.velocity_variance.value == std::vector<double>{0, 0});
    CHECK(m.displacement_variance.value == std::vector<double>{0, 0});
    CHECK_THAT(m.remark, ContainsSubstring("times that below which no motion is predicted"));
    CHECK_THAT(m.remark, ContainsSubstring("at 2 of 2 times friction is predicted to hold the slider"));
  }
  CHECK(by_gauss.stationary(Slider(Coulomb(a)), soil).velocity_variance.value[0] == 0);
  CHECK(by_gauss.predict(Coulomb(0.2), soil, std::array<double, 1>{20}).remark.empty());
}

TEST_CASE("whether friction holds is judged at each time, not by the tolerance", "[shaped_linearization]") {
  // The rms acceleration, 3.8 m/s^2 in the strong phase from 4 to 10 s, is below sqrt(1/2) of the level before 1.7 s
  // and after 15.6 s.
  const Spectrum strong = Spectrum::kanai_tajimi(0.25, 9, 0.4);
  GaussianOptions options;
  options.zero_frequency = true;
  options.envelope = Envelope(4, 6, 0.3);
  const GaussianExcitation quake(strong, 0.02, 1024, options);
  const std::vector<double> times = {0.5, 8, 30};
  std::vector<Moments> found;
  for (const double tolerance : {1e-10, 1e-8, 1e-6, 1e-4})
    for (const double wn : {0.0, 2.0}) {
      CAPTURE(tolerance, wn);
      const EquivalentLinearization el({.force = Force::laplace, .tolerance = tolerance});
      const Moments m = el.predict(Slider(Coulomb(1), wn), quake, times);
      for (const std::size_t held : {std::size_t{0}, std::size_t{2}}) {
        CHECK(m.velocity_variance.value[held] == 0);
        CHECK(m.covariance.value[held] == 0);
      }
      CHECK(m.displacement_variance.value[0] == 0);
      CHECK(m.velocity_variance.value[1] > 0.01);
      CHECK_THAT(m.remark, ContainsSubstring("at 2 of 3 times friction is predicted to hold the slider"));
      if (wn == 0) CHECK(m.displacement_variance.value[2] > m.displacement_variance.value[1]);
      found.push_back(m);
      const Moments& exact = found[wn == 0 ? 0 : 1];
      CHECK(relative(m.velocity_variance.value[1], exact.velocity_variance.value[1]) < 10 * tolerance + 1e-8);
      CHECK(relative(m.displacement_variance.value[1], exact.displacement_variance.value[1]) < 10 * tolerance + 1e-8);
    }
  CHECK(by_laplace.predict(Coulomb(1), quake, std::array<double, 2>{5, 8}).remark.empty());
}

TEST_CASE("unequal levels drift, mirrored levels the other way", "[shaped_linearization]") {
  const std::vector<double> times = {0.5, 2, 10, 40};
  for (const EquivalentLinearization& el : {by_gauss, by_laplace})
    for (const double wn : {0.0, 2.0}) {
      const Moments one = el.predict(Slider(Coulomb(0.4, 0.7), wn), soil, times),
                    other = el.predict(Slider(Coulomb(0.7, 0.4), wn), soil, times);
      CAPTURE(el.name(), wn);
      CHECK(apart(one, other) < 1e-8);
      for (std::size_t i = 0; i < times.size(); ++i) {
        CHECK(one.displacement_mean.value[i] > 0);  // the lower level is forward
        CHECK(relative(one.displacement_mean.value[i], -other.displacement_mean.value[i]) < 1e-7);
      }
      // A spring holds the mean where it carries half the difference.
      if (wn > 0) {
        const Moments late = el.stationary(Slider(Coulomb(0.4, 0.7), wn), soil);
        CHECK(relative(late.displacement_mean.value[0], 0.15 / (wn * wn)) < 1e-12);
        CHECK(relative(one.displacement_mean.value[3], 0.15 / (wn * wn)) < 1e-7);
      }
    }
  // Without a spring motion begins where the stationary solution does, with a drift.
  for (const auto& [el, force] : {std::pair(by_gauss, "gaussian"), std::pair(by_laplace, "laplace")})
    for (const double backward : {1.0, 1.5, 3.0, 1000.0}) {
      CAPTURE(force, backward);
      const auto ratio = [&](double level) {  // of the rms acceleration to the threshold, as the remark gives it
        const Moments m = el.stationary(Slider(Coulomb(level, backward * level)), soil);
        const std::size_t at = m.remark.find(" is ") + 4;
        return std::pair(std::stod(m.remark.substr(at)), m.velocity_variance.value[0]);
      };
      const double sigma = std::sqrt(soil.variance()), guess = 1.2 * sigma;
      const double threshold = guess * ratio(guess).first;  // level at which the ratio is 1, to its three digits
      CHECK(ratio(1.01 * threshold).second == 0);
      CHECK(ratio(0.99 * threshold).second > 0);
    }
  // Levels that hardly differ are equal ones.
  CHECK(apart(by_gauss.predict(Coulomb(0.5, std::nextafter(0.5, 1)), soil, times),
              by_gauss.predict(Coulomb(0.5), soil, times)) < 1e-8);
}

TEST_CASE("pulses shake as their spectrum and their envelope do", "[shaped_linearization]") {
  // Without friction the ground's own motion, whose velocity is stationary and whose displacement grows.
  const PoissonPulses pulses(5, 0.2, 1, 10);
  const ShapingFilter filter = ShapingFilter::of(pulses);
  CHECK(filter.misfit() < 0.1);
  CHECK(filter(0) == 0);
  for (const double omega : {0.5, 3.0, 10.0}) CHECK(filter(omega) == Approx(pulses.density(omega)).epsilon(0.05));
  const std::array<double, 2> times = {20, 40};
  const Moments m = by_gauss.predict(Coulomb(0), pulses, times);
  CHECK(m.velocity_variance.value[1] == Approx(pulses.ground_velocity_variance()).epsilon(0.01));  // measured, 0.2 %
  const double growth = (m.displacement_variance.value[1] - m.displacement_variance.value[0]) / 20;
  CHECK(growth == Approx(pulses.ground_displacement_variance(1)).epsilon(0.05));
  CHECK_THAT(m.remark, ContainsSubstring("the spectrum is approximated by a filter of order 6 (misfit"));

  // From rest where no pulse begins before time zero; half an hour later all the same.
  PoissonOptions options;
  options.stationary_start = true;
  const std::array<double, 2> early = {0.01, 40};
  const Moments start = by_gauss.predict(Coulomb(0.1), PoissonPulses(5, 0.2, 1, 10, options), early),
                rest = by_gauss.predict(Coulomb(0.1), pulses, early);
  CHECK(start.velocity_variance.value[0] > 3 * rest.velocity_variance.value[0]);
  CHECK(relative(start.velocity_variance.value[1], rest.velocity_variance.value[1]) < 1e-7);

  // An envelope is the strength of each pulse: displacement grows with the integral of its square.
  options = {};
  options.envelope = Envelope::from_table({0, 40}, {0.5, 0.5});
  const Moments half = by_gauss.predict(Coulomb(0), PoissonPulses(5, 0.2, 1, 10, options), times);
  CHECK(relative(half.displacement_variance.value[1], m.displacement_variance.value[1] / 4) < 1e-7);
}

TEST_CASE("a filter by hand is the spectrum's", "[shaped_linearization]") {
  const std::vector<double> times = {1, 10};
  const Slider cart(Caster(0.5, 0.3), 2);
  CHECK(apart(by_gauss.predict(cart, ShapingFilter::of(ground), times), by_gauss.predict(cart, ground, times)) == 0);
  CHECK(apart(by_gauss.predict(cart, ShapingFilter(0.4), times), by_gauss.predict(cart, 0.4, times)) == 0);
  // A filter that lets the white noise through beside its own.
  const ShapingFilter through(1, {{1, 0, 1, 1, 1}});
  CHECK(relative(through(1e9), 1) < 1e-15);
  const auto gain = [&](double w) { return through(w) * w * w / (std::pow(4 - w * w, 2) + 0.25 * w * w); };
  const double variance =
      2 * (simpson(gain, 0, 100, 100'000) + simpson([&](double u) { return gain(1 / u) / (u * u); }, 1e-9, 0.01, 1000));
  CHECK(relative(by_gauss.stationary(Slider(Coulomb(0), 2, 0.5), through).velocity_variance.value[0], variance) < 1e-8);
  CHECK(
      relative(
          by_gauss.predict(Slider(Coulomb(0), 2, 0.5), through, std::array<double, 1>{100}).velocity_variance.value[0],
          variance) < 1e-8);
}

TEST_CASE("a line at zero frequency that is missing is remarked", "[shaped_linearization]") {
  const std::array<double, 1> one = {1};
  CHECK_THAT(by_gauss.predict(Coulomb(0.2), GaussianExcitation(soil, 0.02, 256), one).remark,
             ContainsSubstring("no line at zero frequency"));
  CHECK(by_gauss.predict(Coulomb(0.2), GaussianExcitation(soil, 0.02, 256, {.zero_frequency = true}), one)
            .remark.empty());
  CHECK_THROWS_WITH(
      by_gauss.predict(Coulomb(0.2), GaussianExcitation(soil, 0.02, 256), std::array<double, 1>{not_a_number}),
      ContainsSubstring("times must be finite"));
}
