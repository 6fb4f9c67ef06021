// Stationary linearization: its roots, its limits, and where it is right and wrong against ensembles.
#include "stickslip/theory/stationary_linearization.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "numerics/quadrature.hpp"
#include "stickslip/ensemble/run.hpp"
#include "stickslip/excitation/poisson.hpp"
#include "stickslip/theory/stationary_linearization.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"
#include "support/reference.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;
using std::numbers::pi;
using theory::StationaryLinearization;
using theory::StationaryPrediction;

namespace {

const StationaryLinearization method;
const double critical = std::sqrt(2 / pi);

StationaryPrediction in_band(double low, double width, double a = 1) {
  return method.predict(Coulomb(a), Spectrum::band_pass(1, low, low + width));
}

/// A band as a function, which takes the way of quadrature.
Spectrum as_function(double s0, double low, double high) {
  return Spectrum::from_function([=](double) { return s0; }, low, high);
}

std::vector<Spectrum> spectra() {
  return {Spectrum::band_pass(0.3, 2, 5),
          Spectrum::kanai_tajimi(0.2, 15, 0.6),
          Spectrum::kanai_tajimi(0.02, 15, 0.002),
          Spectrum::clough_penzien(0.2, 15, 0.6, 1.5, 0.6),
          Spectrum::from_table({0.5, 1, 4}, {1, 3, 0}),
          Spectrum::from_function([](double w) { return w * w * std::exp(-w); }, 0)};
}

/// The damping that the velocity has by thesis (4.20), over that which was found: by an integral of its own, in the
/// logarithm of |r|, r = (omega^2 - wn^2) / omega, in which nothing is sharp:
///     sigma_v^2 = 2 int S / (r^2 + zeta^2) omega^2 / (omega^2 + wn^2) dr,   omega = (r + sqrt(r^2 + 4 wn^2)) / 2
double closure(const StationaryPrediction& p, double a) {
  const double zeta = p.damping, wn = p.natural_frequency;
  double square = 0;
  for (const double sign : {1.0, -1.0}) {
    std::vector<double> cuts = {std::log(zeta)};
    for (double w : p.spectrum.breakpoints())
      if (const double r = sign * (w * w - wn * wn) / w; r > 0) cuts.push_back(std::log(r));
    if (wn > 0) cuts.push_back(std::log(wn));
    std::ranges::sort(cuts);
    square += 2 * detail::integral(
                      [&](double y) {
                        const double r = std::exp(y), root = std::hypot(r, 2 * wn);
                        const double w = sign > 0 ? (r + root) / 2 : 2 * wn * wn / (root + r);
                        return w == 0 ? 0 : p.spectrum(w) * r / (r * r + zeta * zeta) / (1 + std::pow(wn / w, 2));
                      },
                      cuts.front() - 60, cuts.back() + 60, cuts);
    if (wn == 0) break;
  }
  return critical * a / std::sqrt(square) / zeta;
}

}  // namespace

TEST_CASE("linearization of a band has its root, its displacement and its growth", "[stationary_linearization]") {
  for (const auto& r : reference::rows("stationary_linearization", "band_pass")) {
    CAPTURE(r["low"], r["width"]);
    const StationaryPrediction p = in_band(r["low"], r["width"]);
    if (std::isinf(r["damping"])) {
      CHECK((std::isinf(p.damping) && p.velocity_std == 0 && p.displacement_std == 0 && p.growth_rate == 0));
      CHECK_THAT(p.remark, ContainsSubstring("no motion"));
      continue;
    }
    // Round-off of the edges and of 2/pi, as large as the variance's is of its excess over 2/pi.
    const double tolerance = 1e-14 / (1 - 1 / (pi * r["width"]));
    CHECK(p.damping == Approx(r["damping"]).epsilon(tolerance));
    CHECK(p.velocity_std == Approx(r["velocity_std"]).epsilon(tolerance));
    if (r["low"] > 0) {
      CHECK(p.displacement_std == Approx(r["displacement_std"]).epsilon(2 * tolerance));
      CHECK(p.growth_rate == 0);
    } else {
      CHECK(std::isinf(p.displacement_std));
      CHECK(p.growth_rate == Approx(r["growth_rate"]).epsilon(2 * tolerance));
    }
  }
}

TEST_CASE("a band without an upper edge is the limit of broad ones", "[stationary_linearization]") {
  for (const auto& r : reference::rows("stationary_linearization", "high_pass")) {
    CAPTURE(r["low"]);
    const Spectrum far = Spectrum::band_pass(1, r["low"], 1e14);  // what is beyond has 1e-14 of the velocity's variance
    const StationaryPrediction p = method.predict(Coulomb(1), far);
    CHECK(p.damping == Approx(r["damping"]).epsilon(1e-12));
    CHECK(p.velocity_std == Approx(r["velocity_std"]).epsilon(1e-12));
    CHECK(p.displacement_std == Approx(r["displacement_std"]).epsilon(1e-12));
  }
  // and from zero on white noise, thesis (4.40), (4.36)
  const StationaryPrediction white = method.predict(Coulomb(3), Spectrum::white(2));
  CHECK(white.damping == Approx(2 / (pi * pi) * 9 / 2).epsilon(1e-14));
  CHECK(white.velocity_std == Approx(std::sqrt(pi * pi * pi / 2) * 2 / 3).epsilon(1e-14));
  CHECK(std::isinf(white.displacement_std));
  CHECK(white.growth_rate == Approx(2 * pi * 2 / (white.damping * white.damping)).epsilon(1e-14));
  CHECK(method.threshold(Coulomb(3), Spectrum::white(2)) == 0);
  CHECK(method.predict(Coulomb(3), Spectrum::band_pass(2, 0, 1e12)).damping == Approx(white.damping).epsilon(1e-10));
}

TEST_CASE("quadrature agrees with the closed form", "[stationary_linearization]") {
  for (const auto& [low, width] :
       {std::pair{0.0, 0.4}, {0.01, 2.0}, {1.0, 0.32}, {2.0, 2.0}, {1e-3, 1e3}, {50.0, 3.0}}) {
    CAPTURE(low, width);
    const StationaryPrediction p = in_band(low, width),
                               q = method.predict(Coulomb(1), as_function(1, low, low + width));
    const double tolerance = 1e-10 / (1 - 1 / (pi * width));
    CHECK(q.damping == Approx(p.damping).epsilon(tolerance));
    CHECK(q.displacement_std == Approx(p.displacement_std).epsilon(tolerance));
    CHECK(q.growth_rate == Approx(p.growth_rate).epsilon(tolerance));
  }
}

TEST_CASE("the damping solves its equation, with a spring too", "[stationary_linearization]") {
  for (const Spectrum& s : spectra())
    for (const double wn : {0.0, 1e-3, 1.0, 3.0, 40.0})
      for (const double share : {0.999, 0.7, 0.1, 1e-3}) {  // of the threshold
        const double a = share * std::sqrt(s.variance()) / critical;
        CAPTURE(s.configuration(), wn, share);
        const StationaryPrediction p = method.predict(Slider(Coulomb(a), wn), s);
        // Each integral is right to 1e-9; near the threshold what is left of the variance to 1e-9 of it all.
        CHECK(closure(p, a) == Approx(1).epsilon(1e-8));
        CHECK(method.threshold(Slider(Coulomb(a), wn), s) == Approx(share).epsilon(1e-9));
      }
}

TEST_CASE("the velocity's spectrum adds up to its variance", "[stationary_linearization]") {
  for (const Spectrum& s : spectra()) {
    CAPTURE(s.configuration());
    const StationaryPrediction p = method.predict(Slider(Coulomb(0.4), 2), s);
    const double zeta = p.damping;
    const auto cuts = [&] {
      std::vector<double> result = s.breakpoints();
      result.insert(result.end(), {2, zeta});
      std::ranges::sort(result);
      return result;
    }();
    const auto over = [&](auto&& f) { return 2 * detail::integral(f, s.low(), s.high(), cuts); };
    CHECK(over([&](double w) { return p.velocity_spectrum(w); }) == Approx(std::pow(p.velocity_std, 2)).epsilon(1e-8));
    CHECK(over([&](double w) { return p.velocity_spectrum(w) / (w * w); }) ==
          Approx(std::pow(p.displacement_std, 2)).epsilon(1e-8));
    CHECK(p.velocity_spectrum(-2.3) == p.velocity_spectrum(2.3));
    CHECK(p.velocity_spectrum(0) == 0);
    // Power that comes in is power that is dissipated: int S Re H = zeta sigma_v^2, H = i w / (wn^2 - w^2 + i zeta w).
    CHECK(over([&](double w) { return s(w) * zeta / (std::pow(w - 4 / w, 2) + zeta * zeta); }) ==
          Approx(zeta * std::pow(p.velocity_std, 2)).epsilon(1e-8));
  }
}

TEST_CASE("motion begins at the threshold and rises with it", "[stationary_linearization]") {
  const Spectrum band = Spectrum::band_pass(1, 2, 4);  // sigma_n = 2
  CHECK(method.threshold(Coulomb(1), band) == Approx(critical / 2).epsilon(1e-15));
  double before = infinity;
  for (const double beyond : {1e-1, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
    const StationaryPrediction p = method.predict(Coulomb(2 / critical / (1 + beyond)), band);
    CAPTURE(beyond);
    CHECK((p.velocity_std > 0 && p.velocity_std < before));
    before = p.velocity_std;
    CHECK_THAT(p.remark, ContainsSubstring("near sqrt(2/pi)"));
    // With zeta large sigma_v^2 is (sigma_n / zeta)^2 less the acceleration's second moment, 2 (4^3 - 2^3) / 3, over
    // zeta^4: the excess 2 beyond of sigma_n^2 is that moment over zeta^2.
    if (beyond <= 1e-4)
      CHECK(p.damping == Approx(std::sqrt(112.0 / 3 / (4 * 2 * beyond))).epsilon(5 * beyond + 3e-16 / beyond));
  }
  for (const double a : {2 / critical * (1 + 1e-12), 3.0, 1e10}) {
    const StationaryPrediction p = method.predict(Coulomb(a), band);
    CHECK((p.velocity_std == 0 && std::isinf(p.damping) && p.velocity_spectrum(3) == 0 && p.displacement_std == 0));
    CHECK(p.transient(std::vector{1.0, 2.0}).velocity_variance.value == std::vector<double>{0, 0});
    CHECK_THAT(p.remark, ContainsSubstring("no motion is predicted"));
  }
  // More friction, less motion; more ground acceleration, more of it.
  for (double a = 0.1; a < 2; a += 0.1) {
    CHECK(method.predict(Coulomb(a), band).velocity_std > method.predict(Coulomb(a + 0.1), band).velocity_std);
    CHECK(in_band(1, a + 0.3).velocity_std < in_band(1, a + 0.4).velocity_std);
  }
}

TEST_CASE("units of length and time do not matter", "[stationary_linearization]") {
  // x in units of length L, t in units of time T: a L/T^2, S L^2/T^3, wn 1/T.
  for (const double l : {1e-6, 1.0, 1e5})
    for (const double t : {1e-6, 1.0, 1e6})
      for (const double wn : {0.0, 0.7}) {
        CAPTURE(l, t, wn);
        const auto scaled = [&](double unit_l, double unit_t) {
          const double s0 = unit_l * unit_l / std::pow(unit_t, 3);
          return method.predict(Slider(Coulomb(unit_l / (unit_t * unit_t)), wn / unit_t),
                                Spectrum::band_pass(s0, 0.5 / unit_t, 2 / unit_t));
        };
        const StationaryPrediction one = scaled(1, 1), other = scaled(l, t);
        CHECK(other.damping * t == Approx(one.damping).epsilon(1e-13));
        CHECK(other.velocity_std * t / l == Approx(one.velocity_std).epsilon(1e-13));
        CHECK(other.displacement_std / l == Approx(one.displacement_std).epsilon(1e-11));
        const Moments m = one.transient(std::array{3.0}), n = other.transient(std::array{3 * t});
        CHECK(n.velocity_variance.value[0] * t * t / (l * l) == Approx(m.velocity_variance.value[0]).epsilon(1e-9));
        CHECK(n.displacement_variance.value[0] / (l * l) == Approx(m.displacement_variance.value[0]).epsilon(1e-9));
      }
}

TEST_CASE("bands from a millionth to a million have the limits they should", "[stationary_linearization]") {
  // A narrow band far out: sigma_v^2 (omega^2 + zeta^2) = sigma_n^2 with (4.19); a broad one: (4.44).
  CHECK(in_band(1e6, 1e3).velocity_std == Approx(std::sqrt(2e3 - 2 / pi) / (1e6 + 5e2)).epsilon(1e-6));
  CHECK(in_band(1e6, 1e12).velocity_std == Approx(std::sqrt(2e-6)).epsilon(1e-6));
  CHECK(in_band(1e6, 1e12).damping == Approx(std::sqrt(1e6 / pi)).epsilon(1e-3));
  // Close to zero: as from zero, but that the displacement has a variance, 2 S0 / (zeta^2 omega_1).
  const StationaryPrediction low = in_band(1e-6, 2), zero = in_band(0, 2);
  CHECK(low.damping == Approx(zero.damping).epsilon(1e-5));
  CHECK(low.displacement_std == Approx(std::sqrt(2e6) / zero.damping).epsilon(1e-5));
}

TEST_CASE("without friction the slider stays where it is and the ground moves", "[stationary_linearization]") {
  const StationaryPrediction p = in_band(2, 2, 0);
  CHECK(p.damping == 0);
  CHECK(p.velocity_std == Approx(std::sqrt(2 * (1 / 2.0 - 1 / 4.0))).epsilon(1e-15));
  CHECK(p.displacement_std == Approx(std::sqrt(2.0 / 3 * (1 / 8.0 - 1 / 64.0))).epsilon(1e-15));
  CHECK(p.growth_rate == 0);
  CHECK(method.predict(Coulomb(0), as_function(1, 2, 4)).velocity_std == Approx(p.velocity_std).epsilon(1e-10));
  CHECK(in_band(2, 2, 1e-9).velocity_std == Approx(p.velocity_std).epsilon(1e-8));  // zeta falls in proportion to a
  CHECK(in_band(2, 2, 1e-9).displacement_std == Approx(p.displacement_std).epsilon(1e-8));

  // Pulses leave no ground velocity: (5.46), (5.49).
  const PoissonPulses pulses(3, 1.0 / 6, 2.5, 60);
  const auto spectrum = Spectrum::from_function([&](double w) { return pulses.density(w); }, 0, 2000);
  const StationaryPrediction q = method.predict(Coulomb(0), spectrum);
  CHECK(q.velocity_std == Approx(std::sqrt(pulses.ground_velocity_variance())).epsilon(1e-6));  // 1e-8 is above 2000
  CHECK(q.growth_rate == Approx(pulses.ground_displacement_variance(1)).epsilon(1e-6));
  CHECK(std::isinf(q.displacement_std));

  // Content at zero frequency: the ground's velocity itself diffuses.
  CHECK((std::isinf(in_band(0, 2, 0).velocity_std) && std::isinf(in_band(0, 2, 0).growth_rate)));
  // On a spring in the band it resonates without end; out of it it does not.
  const auto on_spring = [](double wn) { return method.predict(Slider(Coulomb(0), wn), Spectrum::band_pass(1, 2, 4)); };
  CHECK(std::isinf(on_spring(3).velocity_std));
  CHECK(on_spring(1e-4).velocity_std == Approx(p.velocity_std).epsilon(1e-7));
  CHECK(on_spring(1e4).displacement_std == Approx(2e-8).epsilon(1e-6));  // sigma_n / wn^2
}

TEST_CASE("how a spectrum begins tells whether the displacement has a variance", "[stationary_linearization]") {
  const auto power = [](double p) {
    return method.predict(Coulomb(0.1),
                          Spectrum::from_function([p](double w) { return std::pow(w, p) * std::exp(-w); }, 0));
  };
  for (const double p : {-0.5, 0.0, 0.5, 1.0, 1.5, 2.0, 4.0}) {
    CAPTURE(p);
    const StationaryPrediction q = power(p);
    CHECK(std::isfinite(q.velocity_std));
    CHECK(std::isinf(q.displacement_std) == (p <= 1));
    if (p < 0) CHECK(std::isinf(q.growth_rate));
    if (p > 0) CHECK(q.growth_rate == 0);
    if (p == 0) CHECK(q.growth_rate == Approx(2 * pi / (q.damping * q.damping)).epsilon(1e-9));
  }
  const auto table = [](double first, double second) {
    return method.predict(Coulomb(0.1), Spectrum::from_table({0, 1, 2}, {first, second, 1}));
  };
  CHECK((std::isinf(table(1, 1).displacement_std) && table(1, 1).growth_rate > 0));
  CHECK((std::isinf(table(0, 1).displacement_std) && table(0, 1).growth_rate == 0));
  CHECK(std::isfinite(table(0, 0).displacement_std));
  // A spring always gives it one.
  CHECK(std::isfinite(
      method.predict(Slider(Coulomb(0.1), 2), Spectrum::from_table({0, 1, 2}, {1, 1, 1})).displacement_std));
}

TEST_CASE("the iteration (4.41) of the thesis has not come to the root", "[stationary_linearization]") {
  const auto iterated = [](double low, double width) {
    double z = 1e6;
    for (int i = 0; i < 50; ++i) z = 1 / (pi * std::atan(z * width / (z * z + low * (low + width))));
    return z;
  };
  // Values: Z_after_50_iters_of_441 at dOmega = 0.35, Omega1 = 1: 8691.7 instead of 3.73; and at Omega2 = inf (here
  // 1e9), Omega1 = 10, where it cycles, 45 % too much.
  CHECK(iterated(1, 0.35) == Approx(8691.68915463).epsilon(1e-8));
  CHECK(in_band(1, 0.35).damping == Approx(3.732720998963410).epsilon(1e-12));
  CHECK(iterated(10, 1e15) == Approx(2.60807144387).epsilon(1e-8));
  CHECK(iterated(1, 1.0) == Approx(in_band(1, 1).damping).epsilon(1e-8));  // elsewhere it does
}

TEST_CASE("from rest the linear system comes to its stationary velocity", "[stationary_linearization]") {
  const double band = 20 / (pi * pi);
  const StationaryPrediction p = in_band(band, band);
  std::vector<double> times;
  const std::vector<reference::Value> transient = reference::rows("stationary_linearization", "transient");
  for (const reference::Value& r : transient) times.push_back(r["time"]);
  const Moments m = p.transient(times);
  for (std::size_t i = 0; i < times.size(); ++i) {
    CAPTURE(times[i]);
    CHECK(std::sqrt(m.velocity_variance.value[i]) == Approx(transient[i]["velocity_std"]).epsilon(1e-8));
  }
  CHECK(m.velocity_mean.value == std::vector<double>(times.size()));
  CHECK(m.velocity_variance.error == std::vector<double>(times.size()));
  // The displacement keeps the ground velocity that it began with, over zeta: more than (4.45) has.
  const double offset = 2 * (1 / band - 1 / (2 * band)) / (p.damping * p.damping);
  CHECK(p.transient(std::array{1e6}).displacement_variance.value[0] ==
        Approx(std::pow(p.displacement_std, 2) + offset).epsilon(1e-5));  // the rest decreases as 1/t
}

TEST_CASE("from rest: early, late, and how the moments hang together", "[stationary_linearization]") {
  for (const Spectrum& s : spectra())
    for (const double wn : {0.0, 1e-6, 2.0, 30.0})
      for (const double a : {0.0, 1e-3, 0.5}) {
        CAPTURE(s.configuration(), wn, a);
        const StationaryPrediction p = method.predict(Slider(Coulomb(a), wn), s);
        // At once: v = -n t, x = -n t^2 / 2, while the ground acceleration stays as it is (its fastest part, here
        // beyond 1e3 rad/s, is worth 1e-3 of its variance or less).
        const double t = 1e-5;
        const Moments early = p.transient(std::array{t});
        CHECK(early.velocity_variance.value[0] == Approx(s.variance() * t * t).epsilon(2e-3));
        CHECK(early.displacement_variance.value[0] == Approx(s.variance() * std::pow(t, 4) / 4).epsilon(2e-3));
        CHECK(early.covariance.value[0] == Approx(s.variance() * std::pow(t, 3) / 2).epsilon(2e-3));
        // d/dt E[x^2] = 2 E[x v], by a fourth-order difference: (60 h)^4 / 30 of the fastest part, wn = 30,
        // and 1e-9 over h of the moments' own error.
        const double at = 0.8, h = 0.004;
        const Moments m = p.transient(std::array{at - 2 * h, at - h, at, at + h, at + 2 * h});
        const auto& x = m.displacement_variance.value;
        CHECK((x[0] - 8 * x[1] + 8 * x[3] - x[4]) / (12 * h) ==
              Approx(2 * m.covariance.value[2]).margin(2e-4 * std::sqrt(x[2] * m.velocity_variance.value[2])));
        // At last: the stationary velocity, and with a spring the stationary displacement.
        if (p.damping > 0.05) {
          const Moments late = p.transient(std::array{40 / p.damping + (wn > 1 ? 40 * p.damping / (wn * wn) : 0)});
          CHECK(std::sqrt(late.velocity_variance.value[0]) == Approx(p.velocity_std).epsilon(1e-7));
          if (wn > 1 && p.damping < wn)
            CHECK(std::sqrt(late.displacement_variance.value[0]) == Approx(p.displacement_std).epsilon(1e-7));
        }
      }
}

TEST_CASE("from rest under white noise it is the exact answer", "[stationary_linearization]") {
  // Thesis (3.41) ff. for a linear damper: q22 = pi S0 (1 - E^2) / zeta and its integrals.
  const StationaryPrediction p = method.predict(Coulomb(1), Spectrum::white(1));
  const double zeta = p.damping, t = 7, e = std::exp(-zeta * t);
  const Moments m = p.transient(std::array{t});
  CHECK(m.velocity_variance.value[0] == Approx(pi * (1 - e * e) / zeta).epsilon(1e-10));
  CHECK(m.covariance.value[0] == Approx(pi * std::pow((1 - e) / zeta, 2)).epsilon(1e-10));
  CHECK(m.displacement_variance.value[0] ==
        Approx(2 * pi / (zeta * zeta) * (t - 2 * (1 - e) / zeta + (1 - e * e) / (2 * zeta))).epsilon(1e-10));
  // A broad band is nearly that: what it lacks, beyond 1e4, is 2 S0 / 1e4.
  const Moments broad = method.predict(Coulomb(1), Spectrum::band_pass(1, 0, 1e4)).transient(std::array{t});
  CHECK(broad.velocity_variance.value[0] == Approx(m.velocity_variance.value[0]).epsilon(1e-3));
  CHECK(broad.displacement_variance.value[0] == Approx(m.displacement_variance.value[0]).epsilon(1e-3));
}

TEST_CASE("the linear system of an ensemble is the one that was predicted", "[stationary_linearization]") {
  // Figures 4.4 and 4.6. Seed fixed; with a new seed it would fail one time in 30: 12 comparisons within three standard
  // errors, each off 27 times in 10,000. The lines of the spectrum are 0.0016 apart, a tenth of what would be seen.
  const double band = 20 / (pi * pi);
  const Spectrum spectrum = Spectrum::band_pass(1, band, 2 * band);
  const StationaryPrediction p = method.predict(Coulomb(1), spectrum);
  const GaussianExcitation excitation(spectrum, 0.05, 513, {.period = 1 << 16});
  EnsembleOptions options;
  options.members = 4000;
  options.seed = 4;
  const Ensemble e = run_ensemble(ViscousSlider(p.damping), excitation, options);
  const Estimates v = e.velocity_variance(), x = e.displacement_variance(), xv = e.covariance();
  const std::array<double, 4> times{0.5, 1, 4, 25.6};
  const Moments m = p.transient(times);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto k = static_cast<std::size_t>(std::lround(times[i] / 0.05));
    CAPTURE(times[i], v.value[k], v.error[k], x.value[k], x.error[k]);
    CHECK(std::abs(v.value[k] - m.velocity_variance.value[i]) < 3 * v.error[k]);
    CHECK(std::abs(x.value[k] - m.displacement_variance.value[i]) < 3 * x.error[k]);
    CHECK(std::abs(xv.value[k] - m.covariance.value[i]) < 3 * xv.error[k]);
  }
}

TEST_CASE("linearization is right of the velocity, and wrong of the displacement",
          "[stationary_linearization][statistics]") {
  // Thesis 4.5, figures 4.4, 4.6: velocities within 10 %, and a displacement variance that grows where none is
  // predicted. The asserted differences are twenty standard errors or more: no seed would fail.
  const double band = 20 / (pi * pi);
  const Spectrum spectrum = Spectrum::band_pass(1, band, 2 * band);
  const StationaryPrediction p = method.predict(Coulomb(1), spectrum);
  EnsembleOptions options;
  options.members = 4000;
  options.seed = 4;
  const Stationary s = run_ensemble(Coulomb(1), GaussianExcitation(spectrum, 0.1, 1024), options).stationary();
  CHECK(p.velocity_std == Approx(std::sqrt(s.velocity_variance.value)).epsilon(0.1));
  CHECK(p.growth_rate == 0);
  CHECK(s.growth_rate.value > 5 * s.growth_rate.error);
  CHECK_THAT(p.remark, ContainsSubstring("drifts"));
}

TEST_CASE("arguments that stationary linearization does not cover are rejected", "[stationary_linearization]") {
  const Spectrum band = Spectrum::band_pass(1, 2, 4);
  CHECK_THROWS_WITH(method.predict(Coulomb(1, 2), band),
                    ContainsSubstring("same both ways") && ContainsSubstring("2 m/s^2 backward"));
  CHECK_THROWS_AS(method.threshold(Coulomb(1, infinity), band), std::invalid_argument);
  const auto takes = []<class Law>(const Law& law) {
    return requires { method.predict(law, Spectrum::white(1)); };
  };
  CHECK(takes(Coulomb(1)));
  CHECK_FALSE(takes(Caster(1, 1)));
  const StationaryPrediction p = method.predict(Coulomb(1), band);
  CHECK_THROWS_WITH(p.transient(std::array{-1.0}), ContainsSubstring("got -1 s"));
  CHECK_THROWS_AS(p.transient(std::array{infinity}), std::invalid_argument);
  CHECK_THROWS_AS(p.transient(std::array{not_a_number}), std::invalid_argument);
  CHECK_THROWS_WITH(p.transient(std::array{1.0}, [] { throw std::runtime_error("enough"); }), "enough");
}
