// Random ground motions of two horizontal components: reproducible, the stated variance and correlation, directions of
// pulses, the order of nesting, ensembles, refusals.
//
// The seeds are fixed. Each statistical check says how often a correct program would fail it with a new seed.
#include "stickslip/excitation/with_transverse.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>

#include "stickslip/core.hpp"
#include "stickslip/ensemble/run.hpp"
#include "stickslip/excitation/gaussian.hpp"
#include "stickslip/excitation/poisson.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;

namespace {

GaussianExcitation noise(double s0 = 0.02, double dt = 0.02, std::size_t samples = 301) {
  return {Spectrum::band_pass(s0, 2, 40), dt, samples};
}

struct Own {  // an excitation without a variance
  double level;
  GroundMotion sample(std::uint64_t, std::uint64_t member) const {
    return {std::vector<double>(301, level * static_cast<double>(member)), 0.02};
  }
  double duration() const { return 6; }
  std::string configuration() const { return detail::shortest(level); }
};

/// Mean squares and product of both components at one sample of each of n members, which are independent.
struct Squares {
  double along = 0, across = 0, product = 0;
};
template <class E>
Squares squares(const E& excitation, std::size_t n, std::size_t sample) {
  Squares s;
  for (std::size_t i = 0; i < n; ++i) {
    const GroundMotion motion = excitation.sample(23, i);
    const double a = motion.acceleration()[sample], t = motion.transverse()[sample];
    s.along += a * a / static_cast<double>(n);
    s.across += t * t / static_cast<double>(n);
    s.product += a * t / static_cast<double>(n);
  }
  return s;
}

}  // namespace

TEST_CASE("the transverse component is the stated sum, the other one has the bits that it has alone", "[excitation]") {
  const GaussianExcitation along = noise();
  const WithTransverse pairs(along, 0.5, 0.6);
  static_assert(Excitation<WithTransverse<GaussianExcitation>>);
  for (const std::uint64_t member : {0U, 7U}) {
    const GroundMotion motion = pairs.sample(5, member), n = along.sample(5, member);
    const GroundMotion t = along.sample(detail::transverse_seed(5), member);
    CHECK(std::ranges::equal(motion.acceleration(), n.acceleration()));  // the same bits
    CHECK(motion.name() == n.name());
    CHECK_FALSE(motion.has_vertical());
    for (std::size_t i = 0; i < motion.samples(); ++i) {
      const double stated = 0.5 * (0.6 * n.acceleration()[i] + 0.8 * t.acceleration()[i]);
      REQUIRE(std::abs(motion.transverse()[i] - stated) <= 4e-16 * n.peak_acceleration());
    }
    CHECK(pairs.sample(5, member) == motion);
    CHECK_FALSE(pairs.sample(6, member) == motion);
  }
  CHECK((pairs.duration() == along.duration() && pairs.dt() == 0.02 && pairs.ratio() == 0.5));
  CHECK(pairs.coherence() == 0.6);
  CHECK(WithTransverse(along, along, 0.5, 0.6) == pairs);
  CHECK_FALSE(WithTransverse(along, 0.5, 0.7) == pairs);
  CHECK(pairs.configuration() == R"({"excitation": "WithTransverse", "horizontal": )" + along.configuration() +
                                     R"(, "transverse": )" + along.configuration() +
                                     R"(, "ratio": 0.5, "coherence": 0.6, "arrivals": "independent"})");
}

TEST_CASE("with a coherence of 1 or -1 both components are in proportion", "[excitation]") {
  const GaussianExcitation along = noise(), coarser = noise(0.02, 0.04, 151);
  for (const double coherence : {1.0, -1.0}) {
    const GroundMotion motion = WithTransverse(along, 0.5, coherence).sample(1, 2);
    for (std::size_t i = 0; i < motion.samples(); ++i)
      REQUIRE(motion.transverse()[i] == 0.5 * coherence * motion.acceleration()[i]);
    CHECK(WithTransverse(along, coarser, 1, coherence).sample(1, 2).samples() == along.samples());  // none is drawn
  }
  const GroundMotion none = WithTransverse(along, 0.0).sample(1, 2);
  CHECK(none.has_transverse());
  CHECK(std::ranges::all_of(none.transverse(), [](double t) { return t == 0; }));
}

TEST_CASE("ratio and coherence are those of the rms accelerations and the correlation", "[excitation][statistics]") {
  // Each bound of 5 standard errors fails once in 1.7 million seeds. For Gaussian components of correlation r the
  // relative variance of a mean square is 2 / n, and n times that of the mean product is 1 + r^2 times both variances.
  constexpr std::size_t n = 4000;
  const double error = 1 / std::sqrt(static_cast<double>(n));
  const GaussianExcitation along = noise(), stronger = noise(0.1), coarse = noise(0.1, 0.04, 151);
  const auto check = [&](const auto& pairs, double along_variance, double across_variance) {
    const double coherence = pairs.coherence();
    const Squares s = squares(pairs, n, 100);
    CHECK(std::abs(s.along / along_variance - 1) < 5 * std::numbers::sqrt2 * error);
    CHECK(std::abs(s.across / across_variance - 1) < 5 * std::numbers::sqrt2 * error);
    const double scale = std::sqrt(along_variance * across_variance);
    CHECK(std::abs(s.product / scale - coherence) < 5 * std::sqrt(1 + coherence * coherence) * error);
  };
  for (const double coherence : {-0.7, 0.0, 0.4}) {
    check(WithTransverse(along, 0.8, coherence), along.variance(), 0.64 * along.variance());
    check(WithTransverse(along, stronger, 0.8, coherence), along.variance(), 0.64 * stronger.variance());
    // A sample of the finer component is one of the coarser one, too.
    check(WithTransverse(along, coarse, 1, coherence), along.variance(), coarse.variance());
  }
}

TEST_CASE("pulses arrive together, in random directions", "[excitation][statistics]") {
  const PoissonPulses pulses(2, 0.2, 1.5, 10);
  const WithTransverse together(pulses);
  CHECK(together.arrivals() == Arrivals::common);
  const GroundMotion pair = together.sample(3, 4), alone = pulses.sample(3, 4);
  REQUIRE(pair.samples() == alone.samples());
  CHECK(std::ranges::equal(pair.acceleration(), alone.acceleration()));
  std::vector<double> arrivals, b, others, across;
  pulses.pulses(3, 4, arrivals, b);
  pulses.pulses(detail::transverse_seed(3), 4, others, across);
  for (std::size_t i = 0; i < pair.samples(); ++i) {
    CHECK(pair.time(i) == alone.time(i));
    if (alone.acceleration()[i] == 0) CHECK(pair.transverse()[i] == 0);  // no pulse acts
  }
  // The first pulse acts alone until it steps or another one begins.
  std::size_t first = 0;
  while (pair.time(first) < arrivals[0]) ++first;
  CHECK(pair.acceleration()[first] == b[0]);
  CHECK(pair.transverse()[first] == across[0]);

  // Azimuths of the first pulses in 8 sectors: chi-squared of 7 degrees of freedom exceeds 40.5 once in a million
  // seeds. Magnitude and azimuth are independent: so is, to 5 standard errors, |b|^2 of cos 2 azimuth.
  constexpr std::size_t n = 8000;
  std::array<double, 8> counts{};
  double twice = 0, weighted = 0;
  std::size_t found = 0;
  for (std::size_t i = 0; i < n; ++i) {
    pulses.pulses(9, i, arrivals, b);
    if (arrivals.empty()) continue;
    const GroundMotion motion = together.sample(9, i);
    std::size_t k = 0;
    while (motion.time(k) < arrivals[0]) ++k;
    const double x = motion.acceleration()[k], y = motion.transverse()[k];
    const double azimuth = std::atan2(y, x) + std::numbers::pi;
    ++counts[std::min<std::size_t>(static_cast<std::size_t>(azimuth / (std::numbers::pi / 4)), 7)];
    twice += std::cos(2 * azimuth);
    weighted += (x * x + y * y) / (2 * 1.5 * 1.5) * std::cos(2 * azimuth);
    ++found;
  }
  const auto total = static_cast<double>(found);
  double chi_squared = 0;
  for (const double count : counts) chi_squared += (count - total / 8) * (count - total / 8) / (total / 8);
  CHECK(chi_squared < 40.5);
  CHECK(std::abs(twice / total) < 5 * std::sqrt(0.5 / total));     // variance of cos: 1/2
  CHECK(std::abs(weighted / total) < 5 * std::sqrt(1.0 / total));  // times the mean square 2 of an exponential variable

  const WithTransverse apart(pulses, 1, 0, Arrivals::independent);
  CHECK(apart.sample(3, 4).samples() > alone.samples());
  CHECK(WithTransverse(pulses, PoissonPulses(3, 0.2, 1.5, 10)).arrivals() == Arrivals::independent);
  CHECK_FALSE(apart == together);
}

TEST_CASE("vertical and transverse components nest in either order, with the same bits", "[excitation]") {
  const GaussianExcitation along = noise(), up = noise(0.01, 0.005, 1201), across = noise(0.03, 0.03, 201);
  const WithVertical one(WithTransverse(along, across, 0.9, 0.3), up, 0.5);
  const WithTransverse other(WithVertical(along, up, 0.5), across, 0.9, 0.3);
  static_assert(Excitation<decltype(one)> && Excitation<decltype(other)>);
  for (const std::uint64_t member : {0U, 3U}) CHECK(one.sample(7, member) == other.sample(7, member));
  CHECK(one.configuration() == other.configuration());
  CHECK_THAT(one.configuration(),
             ContainsSubstring(R"({"excitation": "WithVertical", "horizontal": {"excitation": "With)"));
  const GroundMotion motion = one.sample(7, 3);
  CHECK((motion.has_transverse() && motion.has_vertical()));
  for (const GroundMotion& without : {one.sample_along_axis(7, 3), other.sample_along_axis(7, 3)})
    CHECK(without == WithVertical(along, up, 0.5).sample(7, 3));

  const WithVertical usual(WithTransverse(along, 1, 0.3), 0.5);  // the vertical component from `along`
  const WithTransverse turned(WithVertical(along, 0.5), 1, 0.3);
  CHECK(usual.sample(7, 1) == turned.sample(7, 1));
  CHECK(usual.configuration() == turned.configuration());
  CHECK(std::ranges::equal(usual.sample(7, 1).vertical(), WithVertical(along, 0.5).sample(7, 1).vertical()));
}

TEST_CASE("an ensemble on one axis has the bits of one without a transverse component", "[excitation][ensemble]") {
  const EnsembleOptions options{.members = 70, .seed = 2, .threads = 2};
  const GaussianExcitation along = noise(), across = noise(0.1, 0.005, 1201);
  const PoissonPulses pulses(3, 0.2, 2, 6);
  const auto check = [&](const auto& sliders, const auto& pairs, const auto& alone) {
    const Ensemble with = run_ensemble(sliders, pairs, options), without = run_ensemble(sliders, alone, options);
    CHECK(std::ranges::equal(with.peak(), without.peak()));
    CHECK(std::ranges::equal(with.residual(), without.residual()));
    CHECK(std::ranges::equal(with.time(), without.time()));
    CHECK_FALSE(with.parts().configuration == without.parts().configuration);
  };
  check(Coulomb(0.6), WithTransverse(along, across, 1, 0.5), along);  // in lanes
  check(Slider(Coulomb(0.6), Mounting{.slope_degrees = 1}), WithTransverse(along), along);
  check(Coulomb(0.6), WithTransverse(pulses), pulses);
  check(Coulomb(0.6), WithVertical(WithTransverse(along, across), 0.5), WithVertical(along, 0.5));
  check(Coulomb(0.6), WithTransverse(WithVertical(along, 0.5), across), WithVertical(along, 0.5));
}

TEST_CASE("pairs that do not fit are refused", "[excitation][errors]") {
  const GaussianExcitation along = noise();
  const PoissonPulses pulses(3, 0.2, 2, 6);
  CHECK_THROWS_WITH(WithTransverse(along, -0.5), "WithTransverse: ratio must be finite and at least 0, got -0.5");
  CHECK_THROWS_WITH(WithTransverse(along, 1, 1.5), "WithTransverse: coherence must be from -1 to 1, got 1.5");
  CHECK_THROWS_WITH(WithTransverse(along, 1, not_a_number), ContainsSubstring("coherence must be from -1 to 1"));
  CHECK_THROWS_WITH(
      WithTransverse(along, noise(0.02, 0.02, 300)),
      "WithTransverse: the transverse component must last as long as the horizontal one, 6 s, got 5.98 s");
  CHECK_THROWS_WITH(WithTransverse(along, pulses).sample(1, 0),
                    ContainsSubstring("both components must be lines between samples or both held values"));
  const WithTransverse pairs(along);
  CHECK_THROWS_WITH(WithTransverse(pairs, along).sample(1, 0),
                    ContainsSubstring("the horizontal excitation must make motions without a transverse component"));
  CHECK_THROWS_WITH(WithTransverse(along, pairs).sample(1, 0),
                    ContainsSubstring("the transverse excitation must make motions of one component"));
  CHECK_THROWS_WITH(WithTransverse(along, along, 1, 0, Arrivals::common), ContainsSubstring("common arrivals need"));
  CHECK_THROWS_WITH(WithTransverse(pulses, PoissonPulses(4, 0.2, 2, 6), 1, 0, Arrivals::common),
                    ContainsSubstring("common arrivals need the same PoissonPulses"));
  CHECK_THROWS_WITH(WithTransverse(Own{1}, Own{2}, 1, 0.5), ContainsSubstring("needs the variance of both"));
  CHECK(WithTransverse(Own{1}, Own{2}).sample(1, 3).transverse()[0] == 6);
  CHECK(WithTransverse(Own{1}, 1, 1).sample(1, 3).transverse()[0] == 3);
}
