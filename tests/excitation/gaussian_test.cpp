// Gaussian excitations: the sum of cosines they are, the spectrum of the motion that acts, and how Gaussian it is.
#include "stickslip/excitation/gaussian.hpp"

#include <complex>
#include <numbers>
#include <thread>

#include "stickslip/excitation/random.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;
using std::numbers::pi;
using Complex = std::complex<long double>;

namespace {

const double edge = 20 / (pi * pi);
const Spectrum band = Spectrum::band_pass(1, edge, 2 * edge);  // thesis, figures 4.4 to 4.6
const Spectrum soil = Spectrum::kanai_tajimi(1, 15, 0.6);

constexpr long double pi_l = std::numbers::pi_v<long double>;

/// n at samples 0, 1, .. by summing the cosines of (4.49), uncorrected; `dt` may be finer than the excitation's.
std::vector<double> cosine_sum(const GaussianExcitation& excitation, std::uint64_t seed, std::uint64_t member,
                               std::size_t first_line, std::size_t lines, std::size_t samples, std::size_t finer = 1) {
  std::vector<std::complex<double>> phase(lines);
  phasors({seed, member, GaussianExcitation::phase_purpose}, phase);
  const std::size_t period = excitation.options().period;
  const long double spacing = 2 * pi_l / (static_cast<long double>(period) * excitation.dt());
  std::vector<double> n(samples);
  for (std::size_t m = 0; m < samples; ++m) {
    long double sum = 0;
    for (std::size_t i = 0; i < lines; ++i) {
      const std::size_t k = first_line + i;
      const double omega = static_cast<double>(static_cast<long double>(k) * spacing);
      const bool alone = k == 0 || 2 * k == period;
      const long double amplitude = (alone ? std::sqrt(2.0L) : 2) * std::sqrt(excitation.spectrum()(omega) * spacing);
      const std::size_t turns = k * m % (finer * period);
      const long double angle = 2 * pi_l * static_cast<long double>(turns) / static_cast<long double>(finer * period) +
                                std::arg(Complex(phase[i].real(), phase[i].imag()));
      sum += amplitude * std::cos(angle);
    }
    n[m] = static_cast<double>(sum);
  }
  return n;
}

/// (1/T) int n e^{-i omega t} dt over one period of the motion that acts, exactly, at line k.
Complex coefficient(const std::vector<double>& n, std::size_t k, Interpolation interpolation) {
  const std::size_t period = n.size();
  const long double x = 2 * pi_l * static_cast<long double>(k) / static_cast<long double>(period);  // omega dt
  const Complex turn = std::polar(1.0L, -x), i(0, 1);
  const Complex of_one = (1.0L - turn) / (i * x);               // int_0^1 e^{-ixs} ds
  const Complex of_s = turn * i / x + (turn - 1.0L) / (x * x);  // int_0^1 s e^{-ixs} ds
  Complex sum = 0;
  for (std::size_t m = 0; m < period; ++m) {
    const long double start = n[m], end = interpolation == Interpolation::linear ? n[(m + 1) % period] : n[m];
    const long double turns = static_cast<long double>(k * m % period) / static_cast<long double>(period);
    sum += std::polar(1.0L, -2 * pi_l * turns) * (start * of_one + (end - start) * of_s);
  }
  return sum / static_cast<long double>(period);
}

std::vector<double> acceleration(const GaussianExcitation& excitation, std::uint64_t seed, std::uint64_t member) {
  const GroundMotion motion = excitation.sample(seed, member);
  return {motion.acceleration().begin(), motion.acceleration().end()};
}

double mean_power(const std::vector<double>& n, int power) {
  double sum = 0;
  for (const double x : n) sum += std::pow(x, power);
  return sum / static_cast<double>(n.size());
}

GaussianOptions options(bool correct, Interpolation interpolation = Interpolation::linear) {
  GaussianOptions result;
  result.correct_interpolation = correct;
  result.interpolation = interpolation;
  return result;
}

GaussianOptions everything() {  // all lines, truly Gaussian
  GaussianOptions result = options(false, Interpolation::constant);
  result.random_amplitudes = result.zero_frequency = true;
  return result;
}

struct Average {
  double sum = 0, squares = 0, count = 0;
  void add(double x) {
    sum += x;
    squares += x * x;
    ++count;
  }
  double mean() const { return sum / count; }
  double error() const { return std::sqrt((squares / count - mean() * mean()) / (count - 1)); }
};

// Statistical bounds are 4.9 standard errors at a fixed seed: each fails by chance once in a million seeds.
constexpr double bound = 4.9;

}  // namespace

TEST_CASE("a motion is the sum of cosines (4.49)", "[gaussian]") {
  struct Case {
    Spectrum spectrum;
    double dt;
    std::size_t samples, period, first, lines;
    bool zero;
  };
  const Case cases[] = {{band, 0.1, 1024, 0, 34, 33, false},   {band, 0.1, 1023, 0, 33, 33, false},
                        {band, 0.1, 700, 1024, 34, 33, false}, {soil, 0.02, 256, 0, 1, 128, false},
                        {soil, 0.02, 255, 0, 1, 127, false},   {soil, 0.02, 256, 0, 0, 129, true},
                        {soil, 0.02, 2, 0, 1, 1, false},       {soil, 0.02, 2, 3, 0, 2, true}};
  for (const Case& c : cases) {
    GaussianOptions plain = options(false);
    plain.period = c.period;
    plain.zero_frequency = c.zero;
    const GaussianExcitation excitation(c.spectrum, c.dt, c.samples, plain);
    INFO(excitation.configuration());
    CHECK(excitation.lines() == c.lines);
    const auto expected = cosine_sum(excitation, 5, 7, c.first, c.lines, c.samples);
    // Each amplitude has a few roundings, and an FFT about one for each of its log2 stages.
    CHECK(difference(acceleration(excitation, 5, 7), expected) <= 2e-15 * 10 * std::sqrt(excitation.variance()));
  }
}

TEST_CASE("variances are those of the reference's exact sums", "[gaussian]") {
  const GaussianExcitation corrected(band, 0.1, 1024), plain(band, 0.1, 1024, options(false));
  CHECK(corrected.variance() == Approx(4.116216534553666).epsilon(1e-14));  // values.json mc.fig44.pre2
  CHECK(plain.variance() == Approx(4.049709280018092).epsilon(1e-14));      // values.json mc.fig44.pre0
  CHECK(corrected.lines() == 33);                                           // ERRATA (4.47)
  CHECK(GaussianExcitation(Spectrum::band_pass(1, edge, edge + 0.2), 0.1, 1024, options(true)).variance() ==
        Approx(0.3709989007249732).epsilon(1e-14));  // values.json mc.fig48.O1_2.0264.dO_0.2000
}

TEST_CASE("the motion that acts has the spectrum that was asked for, exactly", "[gaussian]") {
  for (const Interpolation interpolation : {Interpolation::linear, Interpolation::constant})
    for (const std::size_t samples : {200, 201}) {
      const GaussianExcitation excitation(soil, 0.05, samples, options(true, interpolation));
      const auto n = acceleration(excitation, 3, 1);
      std::vector<std::complex<double>> phase(excitation.lines());
      phasors({3, 1, GaussianExcitation::phase_purpose}, phase);
      double worst = 0;
      for (std::size_t k = 1; 2 * k < samples; ++k) {
        const double omega = static_cast<double>(k) * excitation.line_spacing();
        const double target = std::sqrt(soil(omega) * excitation.line_spacing());  // half of (4.49)'s amplitude
        Complex found = coefficient(n, k, interpolation);
        if (interpolation == Interpolation::constant)  // held values come half a step late
          found *= std::polar(1.0L, pi_l * static_cast<long double>(k) / static_cast<long double>(samples));
        worst = std::max(
            worst, static_cast<double>(std::abs(found / Complex(phase[k - 1]) - static_cast<long double>(target))));
      }
      CHECK(worst <= 1e-13);
    }
}

TEST_CASE("without the correction the motion that acts lacks high frequencies, by sinc^2", "[gaussian]") {
  const GaussianExcitation excitation(soil, 0.05, 200, options(false));
  const auto n = acceleration(excitation, 3, 1);
  for (const std::size_t k : {1, 30, 60, 99}) {
    const double u = pi * static_cast<double>(k) / 200, sinc = std::sin(u) / u;
    const double target =
        std::sqrt(soil(static_cast<double>(k) * excitation.line_spacing()) * excitation.line_spacing());
    CHECK(static_cast<double>(std::abs(coefficient(n, k, Interpolation::linear))) ==
          Approx(target * sinc * sinc).epsilon(1e-12));  // ERRATA (4.57)
  }
}

TEST_CASE("a whole period has exactly the variance of its lines, and no mean", "[gaussian]") {
  const GaussianExcitation excitation(band, 0.1, 1024);
  for (std::uint64_t member = 0; member < 20; ++member) {
    const auto n = acceleration(excitation, 1, member);
    CHECK(mean_power(n, 2) == Approx(excitation.variance()).epsilon(1e-13));
    CHECK(std::abs(mean_power(n, 1)) < 1e-14);
  }
  GaussianOptions longer;
  longer.period = 4096;
  const auto part = acceleration(GaussianExcitation(soil, 0.01, 1024, longer), 1, 1);
  CHECK(std::abs(mean_power(part, 1)) > 0.01);  // the remedy: a part of a longer period may have one
}

TEST_CASE("the line at zero frequency is a constant of variance S(0) domega", "[gaussian][statistics]") {
  GaussianOptions with;
  with.zero_frequency = true;
  const GaussianExcitation excitation(soil, 0.05, 64, with);
  Average squares;
  for (std::uint64_t member = 0; member < 20000; ++member) {
    const double mean = mean_power(acceleration(excitation, 2, member), 1);
    squares.add(mean * mean);
  }
  CHECK(std::abs(squares.mean() - soil(0) * excitation.line_spacing()) < bound * squares.error());
}

TEST_CASE("(seed, member) names a motion: whoever makes it, in whatever memory", "[gaussian]") {
  const GaussianExcitation excitation(band, 0.1, 1024), other(soil, 0.02, 300);
  const auto expected = acceleration(excitation, 1, 7);
  CHECK(acceleration(excitation, 1, 7) == expected);
  CHECK(acceleration(excitation, 1, 8) != expected);
  CHECK(acceleration(excitation, 2, 7) != expected);
  CHECK(acceleration(GaussianExcitation(band, 0.1, 1024), 1, 7) == expected);

  GaussianExcitation::Workspace workspace;
  std::vector<double> room(1024 + 4), rest(300);
  for (std::size_t shift = 0; shift < 4; ++shift) {  // whatever the alignment
    other.sample(9, 9, rest, workspace);
    excitation.sample(1, 7, std::span(room).subspan(shift, 1024), workspace);
    CHECK(difference(std::span(room).subspan(shift, 1024), expected) == 0);
  }

  std::vector<double> worst(4, infinity);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < worst.size(); ++i)
    threads.emplace_back([&, i] {
      double largest = 0;
      for (int round = 0; round < 20; ++round)
        largest = std::max(largest, difference(acceleration(GaussianExcitation(band, 0.1, 1024), 1, 7), expected));
      worst[i] = largest;
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(worst == std::vector<double>(4, 0.0));
}

TEST_CASE("a sample is a ground motion of the grid asked for", "[gaussian]") {
  const GaussianExcitation excitation(band, 0.1, 1000, options(true, Interpolation::constant));
  const GroundMotion motion = excitation.sample(1, 7);
  CHECK(motion.samples() == 1000);
  CHECK(motion.dt() == 0.1);
  CHECK(motion.duration() == excitation.duration());
  CHECK(motion.interpolation() == Interpolation::constant);
  CHECK(motion.name() == "seed 1, member 7");
}

TEST_CASE("a refined motion passes through the coarse one's samples", "[gaussian]") {
  for (const bool random : {false, true})
    for (const std::size_t samples : {128, 129}) {
      GaussianOptions plain = options(false);
      plain.random_amplitudes = random;
      plain.zero_frequency = true;
      const GaussianExcitation coarse(soil, 0.05, samples, plain);  // its Nyquist line among them
      const auto n = acceleration(coarse, 4, 4);
      const GaussianExcitation twice = coarse.refined(2).refined(3), once = coarse.refined(6);
      CHECK(once == twice);
      CHECK(once.samples() == 6 * (samples - 1) + 1);
      CHECK(once.duration() == Approx(coarse.duration()).epsilon(1e-15));
      CHECK(once.lines() == coarse.lines());
      CHECK(once.line_spacing() == coarse.line_spacing());
      const auto fine = acceleration(once, 4, 4);
      CHECK(acceleration(twice, 4, 4) == fine);
      double worst = 0;
      for (std::size_t i = 0; i < samples; ++i) worst = std::max(worst, std::abs(fine[6 * i] - n[i]));
      CHECK(worst < 1e-13);
    }
  const GaussianExcitation coarse(band, 0.1, 1024);
  CHECK(coarse.refined(1) == coarse);
  CHECK(acceleration(coarse.refined(1), 1, 1) == acceleration(coarse, 1, 1));
}

TEST_CASE("the interpolation error of refined motions falls as dt^2, or as dt where values are held", "[gaussian]") {
  for (const Interpolation interpolation : {Interpolation::linear, Interpolation::constant}) {
    const GaussianExcitation coarse(band, 0.1, 256, options(true, interpolation));
    const std::size_t finest = 32;
    const auto truth = cosine_sum(coarse, 1, 2, 9, coarse.lines(), 255 * finest + 1, finest);
    double before = 0;
    for (const std::size_t factor : {1, 2, 4, 8, 16}) {
      const auto n = acceleration(coarse.refined(factor), 1, 2);
      const std::size_t step = finest / factor;
      double worst = 0;
      for (std::size_t i = 0; i + 1 < n.size(); ++i)
        for (std::size_t j = 0; j <= step; ++j) {
          const double slope = interpolation == Interpolation::linear ? n[i + 1] - n[i] : 0;
          const double between = n[i] + slope * static_cast<double>(j) / static_cast<double>(step);
          worst = std::max(worst, std::abs(between - truth[i * step + j]));
        }
      INFO(factor);
      const double order = interpolation == Interpolation::linear ? 4 : 2;
      if (before > 0) CHECK(before / worst == Approx(order).epsilon(0.15));
      before = worst;
    }
  }
}

TEST_CASE("white noise with all its lines is a row of independent numbers of variance 2 pi S0 / dt",
          "[gaussian][statistics]") {
  for (const std::size_t samples : {64, 65}) {
    const GaussianExcitation excitation(Spectrum::white(0.7), 0.1, samples, everything());
    CHECK(excitation.variance() == Approx(2 * pi * 0.7 / 0.1).epsilon(1e-13));
    std::vector<Average> lags(samples);
    Average fourth;
    for (std::uint64_t member = 0; member < 20000; ++member) {
      const auto n = acceleration(excitation, 6, member);
      for (std::size_t lag = 0; lag < samples; ++lag) lags[lag].add(n[0] * n[lag] / excitation.variance());
      fourth.add(std::pow(n[5], 4) / std::pow(excitation.variance(), 2));
    }
    for (std::size_t lag = 0; lag < samples; ++lag)
      CHECK(std::abs(lags[lag].mean() - (lag == 0 ? 1 : 0)) < bound * lags[lag].error());
    CHECK(std::abs(fourth.mean() - 3) < bound * fourth.error());
  }
}

TEST_CASE("with random amplitudes each line's periodogram is chi-square with two degrees of freedom",
          "[gaussian][statistics]") {
  GaussianOptions random = options(true);
  random.random_amplitudes = true;
  const std::size_t samples = 100, members = 4000;
  const GaussianExcitation excitation(soil, 0.05, samples, random);
  std::vector<Average> power(samples / 2), squared(samples / 2);
  for (std::uint64_t member = 0; member < members; ++member) {
    const auto n = acceleration(excitation, 8, member);
    for (const std::size_t k : {1, 2, 7, 20, 49}) {
      const double target = soil(static_cast<double>(k) * excitation.line_spacing()) * excitation.line_spacing();
      const double ratio = static_cast<double>(std::norm(coefficient(n, k, Interpolation::linear))) / target;
      power[k].add(ratio);
      squared[k].add(ratio * ratio);
    }
  }
  // Exponential of mean 1: the mean of 4000 has standard error 1 / sqrt(4000), that of their squares sqrt(20 / 4000).
  for (const std::size_t k : {1, 2, 7, 20, 49}) {
    INFO(k);
    CHECK(std::abs(power[k].mean() - 1) < bound / std::sqrt(4000.0));
    CHECK(std::abs(squared[k].mean() - 2) < bound * std::sqrt(20 / 4000.0));
  }
}

TEST_CASE("with fixed amplitudes the kurtosis is 3 - 1.5 / effective lines", "[gaussian][statistics]") {
  const GaussianExcitation few(Spectrum::band_pass(1, edge, edge + 0.2), 0.1, 1024);
  CHECK(few.lines() == 3);
  CHECK(few.effective_lines() == Approx(3).epsilon(1e-3));
  CHECK(GaussianExcitation(band, 0.1, 1024).effective_lines() == Approx(33).epsilon(1e-4));
  GaussianOptions random;
  random.random_amplitudes = true;
  const GaussianExcitation gaussian(few.spectrum(), 0.1, 1024, random);
  const GaussianExcitation uneven(Spectrum::kanai_tajimi(1, 8, 0.1), 0.1, 64);
  CHECK(uneven.effective_lines() < 0.9 * static_cast<double>(uneven.lines()));
  Average fixed, truly, of_uneven;
  for (std::uint64_t member = 0; member < 20000; ++member) {
    fixed.add(mean_power(acceleration(few, 3, member), 4) / std::pow(few.variance(), 2));
    truly.add(std::pow(acceleration(gaussian, 3, member)[17], 4) / std::pow(gaussian.variance(), 2));
    of_uneven.add(mean_power(acceleration(uneven, 3, member), 4) / std::pow(uneven.variance(), 2));
  }
  CHECK(std::abs(fixed.mean() - (3 - 1.5 / few.effective_lines())) < bound * fixed.error());
  CHECK(std::abs(of_uneven.mean() - (3 - 1.5 / uneven.effective_lines())) < bound * of_uneven.error());
  CHECK(std::abs(truly.mean() - 3) < bound * truly.error());
}

TEST_CASE("a period that would do is one that does", "[gaussian]") {
  GaussianOptions longer;
  longer.period = GaussianExcitation(Spectrum::band_pass(1, edge, edge + 0.2), 0.1, 1024).period_for(30);
  CHECK(longer.period == 16384);
  CHECK(GaussianExcitation(Spectrum::band_pass(1, edge, edge + 0.2), 0.1, 1024, longer).effective_lines() >= 30);
}

TEST_CASE("an envelope multiplies the samples", "[gaussian]") {
  GaussianOptions shaped = options(false);
  shaped.envelope = Envelope(2, 5, 0.3);
  const GaussianExcitation excitation(band, 0.1, 256, shaped), stationary(band, 0.1, 256, options(false));
  const auto n = acceleration(excitation, 1, 1), plain = acceleration(stationary, 1, 1);
  for (std::size_t i = 0; i < n.size(); ++i) CHECK(n[i] == plain[i] * (*shaped.envelope)(static_cast<double>(i) * 0.1));
  CHECK(excitation.variance() == stationary.variance());
  const auto fine = acceleration(excitation.refined(4), 1, 1);
  for (std::size_t i = 0; i < n.size(); ++i) CHECK(fine[4 * i] == Approx(n[i]).margin(1e-13));
}

TEST_CASE("what lies beyond the Nyquist frequency of an endless spectrum is lost, and counted", "[gaussian]") {
  const GaussianExcitation excitation(soil, 0.05, 512, options(false));
  const double kept = soil.variance(0, pi / 0.05) / soil.variance();
  CHECK(excitation.lost_variance() == Approx(1 - kept).epsilon(1e-8));
  CHECK(excitation.refined(4).lost_variance() == excitation.lost_variance());
  CHECK(GaussianExcitation(band, 0.1, 1024).lost_variance() == 0);
  CHECK(GaussianExcitation(Spectrum::white(1), 0.1, 1024).lost_variance() == 1);
}

TEST_CASE("lines that meet an edge of the band but for round-off are in it", "[gaussian]") {
  for (const double dt : {0.1, 0.07, 0.013, 0.3}) {
    const double spacing = 2 * pi / (1000 * dt);
    const GaussianExcitation excitation(Spectrum::band_pass(1, 11 * spacing, pi / dt), dt, 1000);
    CHECK(excitation.lines() == 490);
    CHECK(GaussianExcitation(Spectrum::band_pass(1, 0, 33 * spacing), dt, 1000).lines() == 33);
  }
}

TEST_CASE("a gap in a table costs a phase, not its neighbors'", "[gaussian]") {
  const Spectrum gap = Spectrum::from_table({1, 2, 2.1, 3, 3.1, 4}, {1, 1, 0, 0, 1, 1});
  const GaussianExcitation excitation(gap, 0.1, 1024, options(false));
  CHECK(excitation.lines() < 50);
  const auto expected = cosine_sum(excitation, 5, 7, 17, 49, 1024);
  CHECK(difference(acceleration(excitation, 5, 7), expected) < 1e-13);
}

TEST_CASE("an excitation can be compared and written down", "[gaussian]") {
  const GaussianExcitation excitation(band, 0.1, 1024);
  CHECK(excitation == GaussianExcitation(band, 0.1, 1024));
  GaussianOptions same;
  same.period = 1024;
  CHECK(excitation == GaussianExcitation(band, 0.1, 1024, same));
  CHECK_FALSE(excitation == GaussianExcitation(band, 0.1, 1024, options(false)));
  CHECK_FALSE(excitation == excitation.refined(2));
  CHECK(
      excitation.configuration() ==
      R"({"excitation": "GaussianExcitation", "spectrum": )" + band.configuration() +
          R"(, "dt": 0.1, "samples": 1024, "interpolation": "linear", "correct_interpolation": true, )"
          R"("random_amplitudes": false, "zero_frequency": false, "period": 1024, "refinement": 1, "envelope": null})");
  const auto by_function = [](double level) {
    return GaussianExcitation(Spectrum::from_function([=](double w) { return w < 3.5 ? level : 1.0; }, 3, 4), 0.1, 1024)
        .configuration();
  };
  CHECK(by_function(1.25) == by_function(1.25));  // told by what it gives at the lines
  CHECK(by_function(1.25) != by_function(1.5));
}

TEST_CASE("what cannot be sampled is refused, and says what could", "[gaussian][errors]") {
  const auto make = [](const Spectrum& spectrum, double dt, std::size_t samples, std::size_t period = 0) {
    GaussianOptions with;
    with.period = period;
    return GaussianExcitation(spectrum, dt, samples, with);
  };
  CHECK_THROWS_WITH(make(band, 0, 1024), "GaussianExcitation: dt must be positive and finite, got 0 s");
  CHECK_THROWS_WITH(make(band, not_a_number, 1024), "GaussianExcitation: dt must be positive and finite, got nan s");
  CHECK_THROWS_WITH(make(band, 0.1, 1), "GaussianExcitation: needs at least two samples, got 1");
  CHECK_THROWS_WITH(make(band, 0.1, 1024, 1000),
                    "GaussianExcitation: period must be at least samples = 1024, got 1000");
  CHECK_THROWS_WITH(make(band, 0.1, 1024, std::size_t{1} << 31),
                    "GaussianExcitation: period must be at most 2147483647 samples, got 2147483648");
  CHECK_THROWS_WITH(
      make(Spectrum::band_pass(1, 2, 40), 0.1, 1024),
      ContainsSubstring("the spectrum reaches 40 rad/s, beyond the Nyquist frequency pi / dt = 31.4159") &&
          ContainsSubstring("rad/s; dt must be at most 0.0785398") && ContainsSubstring("s, got 0.1 s"));
  CHECK_NOTHROW(make(Spectrum::band_pass(1, 2, 40), pi / 40, 1024));
  CHECK_THROWS_WITH(make(Spectrum::band_pass(1, 2, 2.01), 0.1, 1024),
                    ContainsSubstring("no line lies in the band from 2 to 2.01 rad/s") &&
                        ContainsSubstring("0.06135923") &&
                        ContainsSubstring("A period of 6284 samples would do, got 1024"));
  CHECK_NOTHROW(make(Spectrum::band_pass(1, 2, 2.01), 0.1, 1024, 6284));
  CHECK_THROWS_WITH(make(band, 0.1, 1024).refined(0), "GaussianExcitation: a refinement must be at least 1, got 0");
  CHECK_THROWS_WITH(make(band, 0.1, 1024).refined(1 << 21),
                    ContainsSubstring("at most 2147483647 samples, got 1024 times a refinement of 2097152"));
  std::vector<double> room(1000);
  GaussianExcitation::Workspace workspace;
  CHECK_THROWS_WITH(make(band, 0.1, 1024).sample(1, 1, room, workspace),
                    "GaussianExcitation: needs room for 1024 samples, got 1000");
}
