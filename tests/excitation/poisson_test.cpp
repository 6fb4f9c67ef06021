// Poisson pulses: that the pulses are as random as they should be, that the motion is their exact sum, and that the
// closed forms hold.
//
// The seeds are fixed. Each statistical check says how often a correct program would fail it with a new seed.
#include "stickslip/excitation/poisson.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "stickslip/excitation/random.hpp"
#include "support/catch.hpp"
#include "support/mean.hpp"
#include "support/motions.hpp"
#include "support/size.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double pi = std::numbers::pi;

struct Pulses {
  std::vector<double> arrivals, amplitudes;
};

Pulses pulses_of(const PoissonPulses& excitation, std::uint64_t seed, std::uint64_t member) {
  Pulses p;
  excitation.pulses(seed, member, p.arrivals, p.amplitudes);
  return p;
}

/// n(t) and the sum of the magnitudes it consists of, from every pulse there is.
struct Direct {
  long double sum = 0, magnitude = 0;
  int acting = 0;
};

Direct direct(const PoissonPulses& excitation, const Pulses& pulses, double t) {
  Direct n;
  const PulseShape& shape = excitation.options().shape;
  for (std::size_t k = 0; k < pulses.arrivals.size(); ++k)
    for (std::size_t i = 0; i < shape.values().size(); ++i)
      if (pulses.arrivals[k] + shape.times()[i] * excitation.half_width() <= t &&
          t < pulses.arrivals[k] + shape.times()[i + 1] * excitation.half_width()) {
        const long double b = static_cast<long double>(pulses.amplitudes[k]) * shape.values()[i];
        n.sum += b;
        n.magnitude += std::abs(b);
        ++n.acting;
      }
  return n;
}

/// The segment that t is in.
std::size_t segment_at(const GroundMotion& motion, double t) {
  std::size_t low = 0, high = motion.segments();
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (motion.time(middle) <= t ? low : high) = middle;
  }
  return low;
}

/// Velocity and displacement of the ground after a motion that it began at rest, and the integral of n^2: exact.
struct Ground {
  double velocity = 0, displacement = 0, square = 0;
};

Ground ground_after(const GroundMotion& motion) {
  Ground g;
  for (std::size_t i = 0; i < motion.segments(); ++i) {
    const Segment s = motion.segment(i);
    g.displacement += s.duration * (g.velocity + s.start * s.duration / 2);
    g.velocity += s.start * s.duration;
    g.square += s.start * s.start * s.duration;
  }
  return g;
}

/// The Kolmogorov-Smirnov statistic sqrt(n) D; over 1.9495 once in 1000 times.
template <class Cdf>
double kolmogorov(std::vector<double> sample, Cdf cdf) {
  std::ranges::sort(sample);
  const auto n = static_cast<double>(sample.size());
  double largest = 0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const double p = cdf(sample[i]);
    largest = std::max({largest, p - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - p});
  }
  return std::sqrt(n) * largest;
}
constexpr double once_in_1000 = 1.9495;

double normal_cdf(double x) { return std::erfc(-x / std::numbers::sqrt2) / 2; }

/// Quantile of the Laplace distribution with mean square 1.
double laplace(double u) { return (u < 0.5 ? std::log(2 * u) : -std::log(2 * (1 - u))) / std::numbers::sqrt2; }

PulseShape shape(std::vector<double> times, std::vector<double> values) {
  return {std::move(times), std::move(values)};
}

}  // namespace

TEST_CASE("the number of pulses is Poisson", "[poisson]") {
  const PoissonPulses excitation(3, 0.1, 1, 4);
  constexpr int least = 5, most = 20;  // fewer, and more, are counted with these
  constexpr int members = 20000;
  std::array<double, most - least + 1> observed{}, expected{};
  for (std::uint64_t member = 0; member < members; ++member) {
    const auto count = static_cast<int>(pulses_of(excitation, 1, member).arrivals.size());
    ++observed[static_cast<std::size_t>(std::clamp(count, least, most) - least)];
  }
  double probability = std::exp(-12.0);  // of none; thesis (5.51) with lambda t = 12
  double rest = 1;
  for (int m = 0; m < most; probability *= 12.0 / ++m) {
    expected[static_cast<std::size_t>(std::max(m, least) - least)] += members * probability;
    rest -= probability;
  }
  expected.back() = members * rest;
  double chi_square = 0;
  for (std::size_t i = 0; i < observed.size(); ++i)
    chi_square += (observed[i] - expected[i]) * (observed[i] - expected[i]) / expected[i];
  CHECK(chi_square < 37.697);  // 15 degrees of freedom: fails once in 1000
}

TEST_CASE("gaps are exponential, amplitudes Gaussian, and they know nothing of each other", "[poisson]") {
  const PoissonPulses excitation(2, 0.1, 2.5, 25);
  std::vector<double> gaps, amplitudes;
  double product = 0, neighbors = 0;
  for (std::uint64_t member = 0; member < 4000; ++member) {
    const Pulses p = pulses_of(excitation, 2, member);
    REQUIRE(p.arrivals.size() >= 6);  // of 50 expected: so the duration does not cut these gaps, which would bias them
    for (std::size_t k = 0; k < 5; ++k) {
      gaps.push_back(p.arrivals[k] - (k == 0 ? 0 : p.arrivals[k - 1]));
      amplitudes.push_back(p.amplitudes[k]);
      product += (2 * gaps.back() - 1) * p.amplitudes[k] / 2.5;
      neighbors += p.amplitudes[k] * p.amplitudes[k + 1] / (2.5 * 2.5);
    }
  }
  CHECK(kolmogorov(gaps, [](double gap) { return -std::expm1(-2 * gap); }) < once_in_1000);
  CHECK(kolmogorov(amplitudes, [](double b) { return normal_cdf(b / 2.5); }) < once_in_1000);
  const double n = static_cast<double>(gaps.size());
  CHECK(std::abs(product) < 3.29 * std::sqrt(n));    // products of variance 1: once in 1000
  CHECK(std::abs(neighbors) < 3.29 * std::sqrt(n));  // once in 1000
}

TEST_CASE("a motion begins at zero, ends at its duration and is held between times that increase", "[poisson]") {
  for (const bool stationary : {false, true}) {
    const PoissonPulses excitation(3, 1.0 / 6, 2.5, 59.9, {.stationary_start = stationary});
    for (std::uint64_t member = 0; member < 50; ++member) {
      const GroundMotion motion = excitation.sample(3, member);
      CHECK(motion.interpolation() == Interpolation::constant);
      CHECK(motion.time(0) == 0);
      CHECK(motion.time(motion.samples() - 1) == 59.9);
      for (std::size_t i = 0; i < motion.segments(); ++i) REQUIRE(motion.segment(i).duration > 0);
    }
  }
}

TEST_CASE("a motion without pulses is a ground at rest", "[poisson]") {
  const GroundMotion motion = PoissonPulses(1e-9, 1, 1, 10).sample(1, 1);
  CHECK(motion.samples() == 2);
  CHECK(motion.duration() == 10);
  CHECK(motion.peak_acceleration() == 0);
}

TEST_CASE("the acceleration is the sum of the acting pulses, at any time", "[poisson]") {
  const PulseShape symmetric, uneven = shape({0, 0.3, 0.7, 1.9, 2.5}, {1.1, -0.4, 0, 0.7}), box = shape({0, 1}, {1});
  std::vector<double> fine_times, fine_values;
  for (int i = 0; i <= 40; ++i) fine_times.push_back(i * 0.05);
  for (int i = 0; i < 40; ++i) fine_values.push_back(std::sin(pi * (i + 0.5) / 20));
  std::mt19937_64 bits(4);
  for (const PulseShape& w : {symmetric, uneven, box, shape(fine_times, fine_values)})
    for (const double overlap : {0.02, 0.5, 30.0})
      for (const bool stationary : {false, true}) {
        const PoissonPulses excitation(overlap / 0.7, 0.7, 1.3, 20, {.stationary_start = stationary, .shape = w});
        for (std::uint64_t member = 0; member < 3; ++member) {
          const GroundMotion motion = excitation.sample(5, member);
          const Pulses pulses = pulses_of(excitation, 5, member);
          std::vector<double> at;
          for (int i = 0; i < 50; ++i) at.push_back(std::uniform_real_distribution<>(0, 20)(bits));
          for (std::size_t i = 0; i < motion.segments(); i += size(7, 70)) at.push_back(motion.time(i));
          double worst = 0;  // error in roundings of the sum of magnitudes
          bool silent = true;
          for (const double t : at) {
            const double n = motion.acceleration()[segment_at(motion, t)];
            const Direct sum = direct(excitation, pulses, t);
            const double error = std::abs(static_cast<double>(n - sum.sum));
            if (error > 0) worst = std::max(worst, error / (epsilon * static_cast<double>(sum.magnitude)));
            if (sum.acting == 0) silent = silent && n == 0;
          }
          CAPTURE(overlap, stationary, member);
          CHECK(worst <= 1.01);  // each product and the sum are rounded once, the errors of the rest are carried along
          CHECK(silent);
        }
      }
}

TEST_CASE("no residue of rounding is left when the last pulse has ended", "[poisson]") {
  const PoissonPulses excitation(0.5, 0.4, 1, 4000);
  const GroundMotion motion = excitation.sample(6, 0);
  const Pulses pulses = pulses_of(excitation, 6, 0);
  int quiet = 0;
  for (std::size_t i = 0; i < motion.segments(); ++i)
    if (direct(excitation, pulses, motion.time(i)).acting == 0) {
      ++quiet;
      REQUIRE(motion.acceleration()[i] == 0);
    }
  CHECK(quiet > 500);
}

TEST_CASE("none is left either where overlapping pulses differ by 35 orders of magnitude", "[poisson]") {
  const PoissonPulses excitation(1, 1, 1, 15, {.envelope = Envelope(0, 0, 40)});  // e^-80 within a pulse
  int quiet = 0;
  for (std::uint64_t member = 0; member < 100; ++member) {
    const GroundMotion motion = excitation.sample(6, member);
    const Pulses pulses = pulses_of(excitation, 6, member);
    for (std::size_t i = 0; i < motion.segments(); ++i)
      if (direct(excitation, pulses, motion.time(i)).acting == 0) {
        ++quiet;
        REQUIRE(motion.acceleration()[i] == 0);
      }
  }
  CHECK(quiet > 100);
}

TEST_CASE("pulses too short for the clock to see leave the ground at rest", "[poisson]") {
  for (const PulseShape& w : {PulseShape(), shape({0, 0.5, 1, 2}, {3, -1, -1})}) {
    const GroundMotion motion = PoissonPulses(1, 1e-18, 1, 100, {.shape = w}).sample(6, 1);
    for (const double n : motion.acceleration()) REQUIRE(n == 0);
  }
}

TEST_CASE("a shape drawn in more pieces than it needs is the same pulse", "[poisson]") {
  const PoissonPulses plain(3, 0.25, 1, 30);
  const PoissonPulses pieces(3, 0.25, 1, 30, {.shape = shape({0, 0.5, 1, 1.25, 2}, {1, 1, -1, -1})});
  const GroundMotion a = plain.sample(7, 1), b = pieces.sample(7, 1);
  for (std::size_t i = 0; i < a.segments(); ++i)
    REQUIRE(b.acceleration()[segment_at(b, a.time(i))] == Approx(a.acceleration()[i]).epsilon(1e-14).margin(1e-14));
  CHECK(pieces.variance() == Approx(plain.variance()).epsilon(1e-15));
  CHECK(pieces.ground_velocity_variance() == Approx(plain.ground_velocity_variance()).epsilon(1e-15));
  CHECK(pieces.ground_displacement_variance(9) == Approx(plain.ground_displacement_variance(9)).epsilon(1e-15));
  CHECK(pieces.density(5) == Approx(plain.density(5)).epsilon(1e-14));
}

TEST_CASE("a pulse leaves the ground at rest, displaced by b Dt^2", "[poisson]") {
  const PoissonPulses excitation(1, 0.5, 1, 8);
  int whole = 0;
  for (std::uint64_t member = 0; member < 200; ++member) {
    const Pulses pulses = pulses_of(excitation, 8, member);
    if (!pulses.arrivals.empty() && pulses.arrivals.back() + 1 > 8) continue;  // the last one is cut
    ++whole;
    double size = 0, displacement = 0;
    for (const double b : pulses.amplitudes) size += std::abs(b), displacement += b * 0.25;  // thesis (5.48)
    const Ground ground = ground_after(excitation.sample(8, member));
    // Some ten roundings of each of some tens of steps, of times up to 8 s.
    CHECK(std::abs(ground.velocity) <= 100 * 8 * epsilon * size);
    CHECK(std::abs(ground.displacement - displacement) <= 100 * 64 * epsilon * size);
  }
  CHECK(whole > 40);
}

TEST_CASE("the variance of the acceleration is 2 lambda Dt sigma^2", "[poisson]") {  // thesis (5.61)
  const PoissonPulses excitation(3, 1.0 / 6, 2.5, 20, {.stationary_start = true});
  CHECK(excitation.variance() == Approx(2 * 3 / 6.0 * 2.5 * 2.5).epsilon(1e-15));
  Mean square, mean;
  for (std::uint64_t member = 0; member < 4000; ++member) {
    const Ground ground = ground_after(excitation.sample(9, member));
    square.add(ground.square / 20);
    mean.add(ground.velocity / 20);
  }
  CHECK(std::abs(square.value() - excitation.variance()) < 3 * square.error());  // three times in 1000
  CHECK(square.error() < 0.005 * excitation.variance());
  CHECK(std::abs(mean.value()) < 3 * mean.error());  // three times in 1000
}

TEST_CASE("a stationary start has its variance at once; the thesis's rises to it within 2 Dt", "[poisson]") {
  const double half_width = 0.5, rate = 1.5, sigma = 2;
  for (const bool stationary : {false, true}) {
    const PoissonPulses excitation(rate, half_width, sigma, 3, {.stationary_start = stationary});
    for (const double t : {0.0, 0.25, 0.75, 1.0, 2.5}) {
      Mean square;
      for (std::uint64_t member = 0; member < 20000; ++member) {
        const GroundMotion motion = excitation.sample(10, member);
        const double n = motion.acceleration()[segment_at(motion, t)];
        square.add(n * n);
      }
      // lambda sigma^2 int_0^t w^2, by Campbell's theorem: thesis (5.28) with z = b w
      const double expected = stationary ? excitation.variance() : rate * sigma * sigma * std::min(t, 2 * half_width);
      CAPTURE(stationary, t, square.value(), expected);
      if (expected == 0) CHECK(square.value() == 0);
      if (expected > 0) CHECK(std::abs(square.value() - expected) < 3.3 * square.error());  // once in 1000, each of 9
    }
  }
}

TEST_CASE("ground velocity and displacement have the variances of the thesis", "[poisson][statistics]") {
  const double half_width = 1.0 / 6, rate = 3, sigma = 2.5, duration = 60;
  const PoissonPulses excitation(rate, half_width, sigma, duration);
  const double power = rate * sigma * sigma;
  CHECK(excitation.ground_velocity_variance() == Approx(2 * power * std::pow(half_width, 3) / 3).epsilon(1e-15));
  CHECK(excitation.ground_displacement_variance(60) == Approx(power * std::pow(half_width, 4) * 60).epsilon(1e-15));

  Mean velocity, displacement;
  for (std::uint64_t member = 0; member < 20000; ++member) {
    const Ground ground = ground_after(excitation.sample(11, member));
    velocity.add(ground.velocity * ground.velocity);
    displacement.add(ground.displacement * ground.displacement);
  }
  CHECK(std::abs(velocity.value() - excitation.ground_velocity_variance()) < 3 * velocity.error());  // 3 in 1000
  // (5.49) less what pulses do not move while they act: lambda sigma^2 int_0^t (displacement of a pulse)^2
  const double exact = excitation.ground_displacement_variance(duration - 37.0 / 30 * half_width);
  CHECK(std::abs(displacement.value() - exact) < 3 * displacement.error());  // 3 in 1000
  CHECK(std::abs(displacement.value() - excitation.ground_displacement_variance(duration)) <
        3 * displacement.error());  // no more often: they differ by 0.3 standard errors
}

TEST_CASE("the spectral density is that of the corrected (5.6)", "[poisson]") {
  const double half_width = 1.0 / 6, rate = 3, sigma = 2.5;
  const PoissonPulses excitation(rate, half_width, sigma, 60);
  for (const double omega : {1e-6, 0.1, 1.0, 13.9866, 30.0, 123.4}) {
    const double expected =
        8 * rate * sigma * sigma * std::pow(std::sin(omega * half_width / 2), 4) / (pi * omega * omega);
    CHECK(excitation.density(omega) == Approx(expected).epsilon(1e-13));
    CHECK(excitation.density(-omega) == excitation.density(omega));
  }
  CHECK(excitation.density(0) == 0);

  // By the trapezoidal rule up to a high frequency; beyond it sin^4 is 3/8 on average.
  const double step = 0.02, highest = 12 * pi * 1000;
  double sum = 0;
  for (int i = 1; i * step < highest; ++i) sum += 2 * step * excitation.density(i * step);
  sum += 2 * 8 * rate * sigma * sigma * 3 / 8 / (pi * highest);
  CHECK(sum == Approx(excitation.variance()).epsilon(1e-6));
}

TEST_CASE("sampled motions have the spectral density", "[poisson]") {
  const double half_width = 0.5, rate = 2, sigma = 1, duration = 40;
  const PoissonPulses excitation(rate, half_width, sigma, duration, {.stationary_start = true});
  const std::array<double, 8> omegas = {0.31, 1.1, 2.0, 3.9, 4.66, 6.0, 9.5, 15.0};
  std::array<Mean, 8> periodogram;
  for (std::uint64_t member = 0; member < 3000; ++member) {
    const GroundMotion motion = excitation.sample(12, member);
    for (std::size_t k = 0; k < omegas.size(); ++k) {
      double real = 0, imaginary = 0;
      for (std::size_t i = 0; i < motion.segments(); ++i) {
        const double from = omegas[k] * motion.time(i), to = omegas[k] * motion.time(i + 1);
        real += motion.acceleration()[i] * (std::sin(to) - std::sin(from));
        imaginary += motion.acceleration()[i] * (std::cos(to) - std::cos(from));
      }
      periodogram[k].add((real * real + imaginary * imaginary) / (omegas[k] * omegas[k] * 2 * pi * duration));
    }
  }
  // A finite window leaks: its expectation is int (1 - abs(s)/T) R(s) cos(omega s) ds / (2 pi).
  const auto correlation = [&](double s) {
    return rate * sigma * sigma * (s < half_width ? 2 * half_width - 3 * s : s - 2 * half_width);
  };
  for (std::size_t k = 0; k < omegas.size(); ++k) {
    double leaked = 0;
    const int steps = 20000;
    for (int i = 0; i < steps; ++i) {
      const double s = 2 * half_width * (i + 0.5) / steps;
      leaked += s * correlation(s) * std::cos(omegas[k] * s) * 2 * half_width / steps;
    }
    const double expected = excitation.density(omegas[k]) - leaked / (pi * duration);
    CAPTURE(omegas[k], periodogram[k].value(), expected);
    CHECK(std::abs(periodogram[k].value() - expected) < 3.3 * periodogram[k].error());  // once in 1000, each of 8
    CHECK(periodogram[k].error() < 0.025 * expected);  // chi-square of 2 degrees: 1 / sqrt(members)
  }
}

TEST_CASE("a pulse with a net velocity leaves no stationary ground velocity", "[poisson]") {
  const PoissonPulses excitation(2, 0.5, 3, 10, {.shape = shape({0, 1}, {1})});
  CHECK(excitation.variance() == Approx(2 * 9 * 0.5).epsilon(1e-15));
  CHECK(excitation.density(0) == Approx(2 * 9 * 0.25 / (2 * pi)).epsilon(1e-15));
  CHECK(excitation.ground_velocity_variance() == infinity);
  CHECK(excitation.ground_displacement_variance(1) == infinity);
  // 2 * 0.1 - 1 * (0.3 - 0.1) is not zero in binary, and yet no net velocity.
  const PoissonPulses rounded(2, 0.5, 3, 10, {.shape = shape({0, 0.1, 0.3}, {2, -1})});
  CHECK(std::isfinite(rounded.ground_velocity_variance()));
}

TEST_CASE("Table 5.1 comes out", "[poisson]") {
  struct Row {
    const char* name;
    double rate, half_width, sigma, duration, velocity, displacement, tolerance;
  };
  // [cm]: of the moderate events values.json table51.*, 15 digits; of the great ones the errata, 4 digits
  const Row rows[] = {
      {"great very near field", 3, 1.0 / 6, 2.5, 60, 24.06, 93.17, 3e-4},
      {"great near field", 2.5, 0.2, 1, 60, 11.55, 48.99, 5e-4},
      {"moderate very near field", 4, 0.125, 2, 15, 14.4337567297406, 24.2061459137964, 1e-14},
      {"moderate near field", 3, 1.0 / 6, 0.5, 15, 4.81125224324688, 9.31694990624912, 1e-14},
  };
  REQUIRE(PoissonPulses::events().size() == std::size(rows));
  for (const Row& row : rows) {
    const PoissonPulses e = PoissonPulses::event(row.name);
    CHECK(e.rate() == Approx(row.rate).epsilon(1e-15));
    CHECK(e.half_width() == Approx(row.half_width).epsilon(1e-15));
    CHECK(e.sigma() == Approx(row.sigma).epsilon(1e-15));
    CHECK(e.duration() == row.duration);
    CHECK(100 * std::sqrt(e.ground_velocity_variance()) == Approx(row.velocity).epsilon(row.tolerance));
    CHECK(100 * std::sqrt(e.ground_displacement_variance(e.duration())) ==
          Approx(row.displacement).epsilon(row.tolerance));
  }
  CHECK_THROWS_WITH(PoissonPulses::event("small"),
                    "PoissonPulses: event must be one of 'great very near field', 'great near field', 'moderate very "
                    "near field', 'moderate near field', got 'small'");
}

TEST_CASE("pulses like an earthquake have its rms acceleration, whatever their shape and overlap", "[poisson]") {
  for (const double overlap : {0.1, 0.5, 2.0})
    for (const PulseShape& w : {PulseShape(), shape({0, 0.5, 2}, {3, -1})}) {
      const auto e = PoissonPulses::from_earthquake(1.7, 2.5, 30, overlap, {.shape = w});
      CHECK(e.variance() == Approx(1.7 * 1.7).epsilon(1e-15));
      CHECK(e.half_width() == 0.2);
      CHECK(e.rate() * e.half_width() == Approx(overlap).epsilon(1e-15));
    }
}

TEST_CASE("a member is the same motion for ever, and another member another", "[poisson]") {
  const PoissonPulses excitation(3, 1.0 / 6, 2.5, 60);
  const GroundMotion motion = excitation.sample(13, 7), again = PoissonPulses(excitation).sample(13, 7);
  REQUIRE(motion.samples() == again.samples());
  for (std::size_t i = 0; i < motion.samples(); ++i) {
    REQUIRE(motion.time(i) == again.time(i));
    REQUIRE(motion.acceleration()[i] == again.acceleration()[i]);
  }
  const double first = pulses_of(excitation, 13, 7).arrivals[0];
  CHECK(pulses_of(excitation, 13, 8).arrivals[0] != first);
  CHECK(pulses_of(excitation, 14, 7).arrivals[0] != first);
  CHECK(pulses_of(excitation, 13, 7 + (std::uint64_t{1} << 32)).arrivals[0] != first);
}

TEST_CASE("a longer motion begins with the same pulses", "[poisson]") {
  const PoissonPulses brief(3, 0.1, 1, 5), lasting(3, 0.1, 1, 500);
  for (std::uint64_t member = 0; member < 50; ++member) {
    const Pulses a = pulses_of(brief, 14, member), b = pulses_of(lasting, 14, member);
    REQUIRE(std::ranges::equal(a.arrivals, std::span(b.arrivals).first(a.arrivals.size())));
    REQUIRE(std::ranges::equal(a.amplitudes, std::span(b.amplitudes).first(a.amplitudes.size())));
    REQUIRE(b.arrivals[a.arrivals.size()] >= 5);
  }
}

TEST_CASE("pulses twice as strong, or everything twice as slow, is the same motion in other units", "[poisson]") {
  const GroundMotion motion = PoissonPulses(3, 0.125, 1, 40).sample(15, 3);
  const GroundMotion strong = PoissonPulses(3, 0.125, 2, 40).sample(15, 3);
  const GroundMotion slow = PoissonPulses(1.5, 0.25, 1, 80).sample(15, 3);
  REQUIRE((strong.samples() == motion.samples() && slow.samples() == motion.samples()));
  for (std::size_t i = 0; i < motion.samples(); ++i) {  // powers of two: exact
    REQUIRE(strong.acceleration()[i] == 2 * motion.acceleration()[i]);
    REQUIRE(slow.acceleration()[i] == motion.acceleration()[i]);
    REQUIRE(slow.time(i) == 2 * motion.time(i));
  }
}

TEST_CASE("amplitudes follow the distribution that is passed", "[poisson]") {
  const PoissonPulses excitation(5, 0.1, 3, 10, {.quantile = PoissonPulses::each(laplace)});
  std::vector<double> sample;
  for (std::uint64_t member = 0; member < 400; ++member) {
    const Pulses p = pulses_of(excitation, 16, member);
    sample.insert(sample.end(), p.amplitudes.begin(), p.amplitudes.end());
    REQUIRE(p.arrivals == pulses_of(PoissonPulses(5, 0.1, 3, 10), 16, member).arrivals);
  }
  const auto cdf = [](double b) {
    const double x = std::numbers::sqrt2 * b / 3;
    return x < 0 ? std::exp(x) / 2 : 1 - std::exp(-x) / 2;
  };
  CHECK(kolmogorov(sample, cdf) < once_in_1000);
}

TEST_CASE("an envelope weighs whole pulses, which still leave the ground at rest", "[poisson]") {
  for (const bool stationary : {false, true}) {
    const Envelope envelope(stationary ? 0 : 4, 5, 0.3);
    const PoissonPulses plain(2, 0.3, 1, 30, {.stationary_start = stationary});
    const PoissonPulses shaped(2, 0.3, 1, 30, {.stationary_start = stationary, .envelope = envelope});
    for (std::uint64_t member = 0; member < 20; ++member) {
      const Pulses a = pulses_of(plain, 17, member), b = pulses_of(shaped, 17, member);
      REQUIRE(a.arrivals == b.arrivals);
      for (std::size_t i = 0; i < a.arrivals.size(); ++i)
        REQUIRE(b.amplitudes[i] == a.amplitudes[i] * envelope(std::max(a.arrivals[i], 0.0)));
      if (b.arrivals.empty() || b.arrivals.back() + 0.6 > 30 || stationary) continue;
      CHECK(std::abs(ground_after(shaped.sample(17, member)).velocity) < 1e-12);
    }
  }
}

TEST_CASE("a configuration tells all that the motions depend on", "[poisson]") {
  CHECK(PoissonPulses(3, 0.5, 2.5, 60).configuration() ==
        R"({"excitation": "PoissonPulses", "rate": 3, "half_width": 0.5, "sigma": 2.5, "duration": 60, )"
        R"("stationary_start": false, "shape": {"times": [0, 1, 2], "values": [1, -1]}, "quantile": null, )"
        R"("envelope": null})");
  const auto of = [](PoissonPulses::Options options) {
    return PoissonPulses(3, 0.5, 2.5, 60, std::move(options)).configuration();
  };
  const auto normal_like = [](double u) { return std::sqrt(3.0) * (2 * u - 1); };
  const std::vector<std::string> all = {of({}),
                                        of({.stationary_start = true}),
                                        of({.shape = shape({0, 1, 3}, {2, -1})}),
                                        of({.quantile = PoissonPulses::each(laplace)}),
                                        of({.quantile = PoissonPulses::each(normal_like)}),
                                        of({.envelope = Envelope(1, 2, 3)})};
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) CHECK(all[i] != all[j]);
  CHECK(of({.quantile = PoissonPulses::each([](double u) { return laplace(u); })}) == all[3]);
  CHECK(PoissonPulses(3, 0.5, 2.5, 60) == PoissonPulses(3, 0.5, 2.5, 60));
  CHECK_FALSE(PoissonPulses(3, 0.5, 2.5, 60) == PoissonPulses(3, 0.5, 2.5, 61));
}

TEST_CASE("a rate, a width, an amplitude or a duration that is not positive is refused", "[poisson][errors]") {
  const std::string rule = " must be positive and finite, got ";
  for (const double bad : {0.0, -1.0, not_a_number, infinity}) {
    const std::string got = detail::shortest(bad);
    CHECK_THROWS_WITH(PoissonPulses(bad, 1, 1, 1), "PoissonPulses: rate" + rule + got + " per second");
    CHECK_THROWS_WITH(PoissonPulses(1, bad, 1, 1), "PoissonPulses: half_width" + rule + got + " s");
    CHECK_THROWS_WITH(PoissonPulses(1, 1, bad, 1), "PoissonPulses: sigma" + rule + got + " m/s^2");
    CHECK_THROWS_WITH(PoissonPulses(1, 1, 1, bad), "PoissonPulses: duration" + rule + got + " s");
    CHECK_THROWS_WITH(PoissonPulses::from_earthquake(bad, 1, 1),
                      "PoissonPulses: rms_acceleration" + rule + got + " m/s^2");
    CHECK_THROWS_WITH(PoissonPulses::from_earthquake(1, bad, 1),
                      "PoissonPulses: center_frequency_hz" + rule + got + " Hz");
    CHECK_THROWS_WITH(PoissonPulses::from_earthquake(1, 1, bad), "PoissonPulses: duration" + rule + got + " s");
    CHECK_THROWS_WITH(PoissonPulses::from_earthquake(1, 1, 1, bad), "PoissonPulses: overlap" + rule + got);
  }
  CHECK_THROWS_WITH(PoissonPulses(1, 1, 1, 1).ground_displacement_variance(-1),
                    "PoissonPulses: t must be finite and at least 0, got -1 s");
}

TEST_CASE("more steps than memory holds are refused before they are made", "[poisson][errors]") {
  const std::string rule =
      "PoissonPulses: rate times duration must make at most 3e8 steps (4.8 GB), 3 for each pulse, got ";
  CHECK_THROWS_WITH(PoissonPulses(1e6, 1, 1, 1e6), rule + "3e+12 steps");
  CHECK_THROWS_WITH(PoissonPulses(1e6, 1e6, 1, 1, {.stationary_start = true}), ContainsSubstring("steps"));
  CHECK_THROWS_WITH(PoissonPulses(1e200, 1, 1, 1e200), rule + "inf steps");
  CHECK_NOTHROW(PoissonPulses(1e4, 1, 1, 1e4));
}

TEST_CASE("a shape that is no pulse is refused", "[poisson][errors]") {
  CHECK_THROWS_WITH(shape({}, {}),
                    "PulseShape: needs one time more than values, and a value, got 0 times for 0 values");
  CHECK_THROWS_WITH(shape({0, 1}, {1, -1}), ContainsSubstring("got 2 times for 2 values"));
  CHECK_THROWS_WITH(shape({0, 1, not_a_number}, {1, -1}), "PulseShape: times[2] must be finite, got nan");
  CHECK_THROWS_WITH(shape({0, infinity}, {1}), "PulseShape: times[1] must be finite, got inf");
  CHECK_THROWS_WITH(shape({1, 2}, {1}), "PulseShape: times[0] must be 0, where the pulse arrives, got 1");
  CHECK_THROWS_WITH(shape({0, 1, 1}, {1, -1}), "PulseShape: times[2] must be greater than 1, got 1");
  CHECK_THROWS_WITH(shape({0, 1}, {infinity}), "PulseShape: values[0] must be finite, got inf");
  CHECK_THROWS_WITH(shape({0, 1, 2}, {0, 0}), "PulseShape: values must not all be 0");
}

TEST_CASE("a distribution whose rms amplitude is not sigma is refused", "[poisson][errors]") {
  const auto with = [](auto quantile) {
    return PoissonPulses(1, 1, 1, 1, {.quantile = PoissonPulses::each(quantile)});
  };
  CHECK_THROWS_WITH(with([](double u) { return 2 * laplace(u); }),
                    ContainsSubstring("the quantile function must have a mean square of 1"));
  CHECK_THROWS_WITH(with([](double) { return not_a_number; }),
                    "PoissonPulses: the quantile function must be finite in (0, 1), got nan");
  CHECK_NOTHROW(with([](double u) { return u < 0.5 ? -1.0 : 1.0; }));
}
