// The concept Theory: what each theory covers, why not the rest, and that its one way to be called gives what its own
// calls give.
#include "stickslip/theory/theory.hpp"

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "stickslip/stickslip.hpp"
#include "support/catch.hpp"

using namespace stickslip;
using namespace stickslip::theory;
using Catch::Matchers::ContainsSubstring;

namespace {

/// A law of the user's own: its level is analytic and the same both ways.
struct Bump {
  template <class T>
  auto resist(const T& x, Direction) const {
    using std::exp;
    return 2.0 * exp(-(x * x));
  }
};

/// One that resists forward sliding alone.
struct Ratchet {
  template <class T>
  auto resist(const T& x, Direction direction) const {
    using std::exp;
    return (direction == Direction::forward ? 2.0 : 1.0) * exp(-(x * x));
  }
};

/// One that holds more at rest than it resists.
struct Glue : Bump {
  double hold(double x, Direction direction) const { return 1.5 * resist(x, direction); }
};

/// One that weakens with the speed.
struct Film {
  template <class T>
  auto resist(const T&, const T& speed, Direction) const {
    return 1 / (1 + speed * speed);
  }
};

using Block = Slider<Coulomb>;
using Cart = Slider<Caster>;
using Own = Slider<Bump>;

static_assert(Theory<WhiteNoise, Block, double> && Theory<WhiteNoise, Block, WhiteLevel> &&
              Theory<WhiteNoise, Block, Spectrum> && Theory<WhiteNoise, Block, GaussianExcitation>);
static_assert(Theory<EquivalentLinearization, Block, double> && Theory<EquivalentLinearization, Cart, Spectrum> &&
              Theory<EquivalentLinearization, Own, GaussianExcitation> &&
              Theory<EquivalentLinearization, Block, PoissonPulses> &&
              Theory<EquivalentLinearization, Cart, ShapingFilter>);
static_assert(Theory<StationaryLinearization, Block, double> && Theory<StationaryLinearization, Block, Spectrum> &&
              Theory<StationaryLinearization, Block, GaussianExcitation>);
static_assert(Theory<PulseChain, Block, PoissonPulses>);
static_assert(Theory<PulseSuperposition, Block, PoissonPulses> && Theory<PulseSuperposition, Cart, PoissonPulses> &&
              Theory<PulseSuperposition, Own, PoissonPulses>);
static_assert(Theory<SlowlyVaryingParameters, Block, HarmonicMotion> &&
              Theory<SlowlyVaryingParameters, Cart, HarmonicMotion> &&
              Theory<SlowlyVaryingParameters, Own, HarmonicMotion>);

// Combinations that the types exclude do not compile.
static_assert(!Theory<WhiteNoise, Cart, double> && !Theory<StationaryLinearization, Cart, Spectrum> &&
              !Theory<PulseChain, Cart, PoissonPulses> && !Theory<PulseChain, Block, Spectrum> &&
              !Theory<EquivalentLinearization, Block, HarmonicMotion> &&
              !Theory<SlowlyVaryingParameters, Block, double>);

const auto theories =
    std::tuple(WhiteNoise(), EquivalentLinearization(),
               EquivalentLinearization({.force = EquivalentLinearization::Force::laplace}),
               EquivalentLinearization({.force = EquivalentLinearization::Force::thesis}), StationaryLinearization(),
               PulseChain(), PulseSuperposition(), PulseSuperposition(Overlap::none), SlowlyVaryingParameters());

GaussianExcitation gaussian(const Spectrum& spectrum, GaussianOptions options) { return {spectrum, 0.1, 256, options}; }

const GaussianExcitation shaking = gaussian(Spectrum::white(0.7), {.zero_frequency = true}),
                         no_mean = gaussian(Spectrum::white(0.7), {}),
                         band = gaussian(Spectrum::band_pass(1, 2, 4), {}),
                         fading = gaussian(Spectrum::band_pass(1, 2, 4), {.envelope = Envelope(1, 2, 3)});

PoissonPulses pulses_with(PoissonOptions options) { return {0.5, 1, 5, 60, std::move(options)}; }

// Of mean square 1: of mean 0, uniform; and one where a fifth of the amplitudes are 2 and the rest -1/2.
double uniform(double u) { return std::sqrt(3) * (2 * u - 1); }
double skew(double u) { return u > 0.8 ? 2 : -0.5; }
double one_way(double u) { return std::sqrt(3) * u; }

const PoissonPulses pulses = pulses_with({}), uneven = pulses_with({.shape = PulseShape({0, 1, 3}, {2, -1})}),
                    swelling = pulses_with({.envelope = Envelope(1, 2, 3)}),
                    even = pulses_with({.quantile = PoissonPulses::each(uniform)}),
                    skewed = pulses_with({.quantile = PoissonPulses::each(skew)}),
                    lopsided = pulses_with({.quantile = PoissonPulses::each(one_way)}), dense(2e6, 1, 5, 10);
const HarmonicMotion harmonic(4, 3, 60);
const Block block(Coulomb(1)), sprung(Coulomb(1), 2), slope(Coulomb(1, 1.5)), newmark(Coulomb(1, INFINITY));
const Cart cart(Caster(1, 2));
const Own own{Bump()};
const Slider ratchet{Ratchet()};
const Slider glue{Glue()};
const Slider film{Film()};
const Block damped(Coulomb(1), 0, 0.3);

const std::vector<double> times{1, 2.5, 40};

/// Each theory's answer in a letter: y covers; n is for excitations of another kind; s for another slider, or another
/// excitation of its kind. Where it says no, `predict` refuses in the same words.
template <class S, class E>
std::string answers(const S& slider, const E& excitation) {
  std::string all;
  const auto ask = [&]<class T>(const T& theory) {
    const Coverage coverage = theory.covers(slider, excitation);
    all += coverage ? 'y' : coverage.excitation ? 's' : 'n';
    CHECK(coverage.reason.empty() == static_cast<bool>(coverage));
    if constexpr (Theory<T, S, E>)
      if (!coverage) {
        CHECK_THROWS_AS(theory.predict(slider, excitation, times), std::invalid_argument);
        CHECK_THROWS_WITH(theory.predict(slider, excitation, times), coverage.reason);
      }
  };
  std::apply([&](const auto&... theory) { (ask(theory), ...); }, theories);
  return all;
}

/// Bit for bit.
bool same(const Moments& a, const Moments& b) {
  const auto equal = [](const Estimates& x, const Estimates& y) { return x.value == y.value && x.error == y.error; };
  const double rate = a.growth_rate.value, other = b.growth_rate.value;
  return a.time == b.time && equal(a.displacement_mean, b.displacement_mean) &&
         equal(a.displacement_variance, b.displacement_variance) && equal(a.covariance, b.covariance) &&
         equal(a.velocity_mean, b.velocity_mean) && equal(a.velocity_variance, b.velocity_variance) &&
         (rate == other || (std::isnan(rate) && std::isnan(other))) && a.remark == b.remark;
}

}  // namespace

TEST_CASE("each theory says which sliders and excitations it covers", "[theory]") {
  // WhiteNoise; EquivalentLinearization, with a Laplacian density, with the thesis's force; StationaryLinearization;
  // PulseChain; PulseSuperposition, without overlap; SlowlyVaryingParameters
  CHECK(answers(block, 0.7) == "yyyyynnnn");
  CHECK(answers(block, Spectrum::white(0.7)) == "yyyyynnnn");
  CHECK(answers(block, shaking) == "yyyyynnnn");
  CHECK(answers(sprung, shaking) == "syyyynnnn");
  CHECK(answers(slope, shaking) == "yyyysnnnn");
  CHECK(answers(newmark, shaking) == "yssssnnnn");
  CHECK(answers(damped, shaking) == "syyysnnnn");
  CHECK(answers(cart, shaking) == "sysysnnnn");
  CHECK(answers(own, shaking) == "sysssnnnn");
  CHECK(answers(ratchet, shaking) == "sssssnnnn");
  CHECK(answers(block, -1.0) == "nnnnnnnnn");
  CHECK(answers(block, no_mean) == "nnnnnnnnn");
  CHECK(answers(block, band) == "nyyyynnnn");
  CHECK(answers(sprung, band.spectrum()) == "nyyyynnnn");
  CHECK(answers(block, fading) == "nyyynnnnn");
  CHECK(answers(cart, fading) == "nysynnnnn");
  CHECK(answers(cart, ShapingFilter(1, {{0, 1, 1, 1, 1}})) == "nysynnnnn");

  CHECK(answers(block, pulses) == "nyyynyyyn");
  CHECK(answers(sprung, pulses) == "nyyynsssn");
  CHECK(answers(damped, pulses) == "nyyynsssn");
  CHECK(answers(slope, pulses) == "nyyynyyyn");
  CHECK(answers(cart, pulses) == "nysynsyyn");
  CHECK(answers(own, pulses) == "nyssnsyyn");
  CHECK(answers(block, swelling) == "nyyynsyyn");
  CHECK(answers(cart, swelling) == "nysynsssn");
  CHECK(answers(block, uneven) == "nyyynsyyn");
  CHECK(answers(block, even) == "nyyynysyn");
  CHECK(answers(block, skewed) == "nyyynysyn");
  CHECK(answers(slope, skewed) == "nyyynssyn");
  CHECK(answers(block, lopsided) == "nnnnnysyn");
  CHECK(answers(block, dense) == "nyyynssyn");

  CHECK(answers(block, harmonic) == "nnnnnnnny");
  CHECK(answers(sprung, harmonic) == "nnnnnnnny");
  CHECK(answers(slope, harmonic) == "nnnnnnnns");
  CHECK(answers(cart, harmonic) == "nnnnnnnny");
  CHECK(answers(own, harmonic) == "nnnnnnnny");
  CHECK(answers(ratchet, harmonic) == "nnnnnnnns");
}

TEST_CASE("a theory says in one sentence why it does not cover", "[theory]") {
  CHECK_THAT(WhiteNoise().covers(cart, 1.0).reason, ContainsSubstring("covers Coulomb friction without a spring"));
  CHECK_THAT(WhiteNoise().covers(sprung, 1.0).reason, ContainsSubstring("natural_frequency must be 0, got 2 rad/s"));
  CHECK_THAT(WhiteNoise().covers(block, band).reason, ContainsSubstring("covers white noise only"));
  CHECK_THAT(EquivalentLinearization().covers(block, no_mean).reason, ContainsSubstring("zero_frequency must be True"));
  CHECK_THAT(EquivalentLinearization().covers(newmark, 1.0).reason,
             ContainsSubstring("both slip levels must be finite; backward, got inf m/s^2"));
  CHECK_THAT(EquivalentLinearization().covers(block, lopsided).reason,
             ContainsSubstring("must have amplitudes of mean 0"));
  CHECK_THAT(EquivalentLinearization({.force = EquivalentLinearization::Force::laplace}).covers(cart, 1.0).reason,
             ContainsSubstring("the Laplacian density is that of Coulomb friction"));
  CHECK_THAT(EquivalentLinearization({.start = EquivalentLinearization::Start::thesis}).covers(block, band).reason,
             ContainsSubstring("(3.38) to (3.40) are of stationary white noise"));
  CHECK_THAT(
      EquivalentLinearization({.start = EquivalentLinearization::Start::thesis}).covers(Block(Coulomb(0)), 1.0).reason,
      ContainsSubstring("slip_level must be positive"));
  CHECK_THAT(StationaryLinearization().covers(block, fading).reason, ContainsSubstring("envelope must be None"));
  CHECK_THAT(PulseChain().covers(cart, pulses).reason, ContainsSubstring("PulseSuperposition covers other laws"));
  CHECK_THAT(PulseChain().covers(block, uneven).reason, ContainsSubstring("must have equal steps, got 2"));
  CHECK_THAT(PulseChain().covers(slope, skewed).reason, ContainsSubstring("amplitudes must be symmetric"));
  CHECK_THAT(PulseSuperposition().covers(cart, swelling).reason, ContainsSubstring("constant slip levels only"));
  CHECK_THAT(SlowlyVaryingParameters::covers(slope, harmonic).reason, ContainsSubstring("resist both ways alike"));
  CHECK(PulseChain().covers(block, harmonic).reason == "PulseChain: covers PoissonPulses");
}

TEST_CASE("no theory covers static friction that differs from kinetic, or the speed, and linearization alone a damper",
          "[theory]") {
  for (const std::string& all : {answers(glue, shaking), answers(film, shaking)}) CHECK(all == "sssssnnnn");
  for (const std::string& all : {answers(glue, pulses), answers(film, pulses)}) CHECK(all == "nsssnsssn");
  for (const std::string& all : {answers(damped, harmonic), answers(glue, harmonic), answers(film, harmonic)})
    CHECK(all == "nnnnnnnns");
  CHECK(PulseChain().covers(damped, pulses).reason ==
        "PulseChain: a slider with a damper is not covered, damping must be 0, got 0.3 1/s");
  CHECK(PulseSuperposition().covers(glue, pulses).reason ==
        "PulseSuperposition: static friction that differs from kinetic is not covered, it must hold 2 m/s^2 at x = 0, "
        "got 3 m/s^2");
  CHECK(EquivalentLinearization().covers(film, 1.0).reason ==
        "EquivalentLinearization: a resistance that depends on the speed is not covered");
  CHECK_THROWS_WITH(pulse_response(damped, 2, 1), ContainsSubstring("damping must be 0, got 0.3 1/s"));
}

TEST_CASE("variants of a theory have names of their own", "[theory]") {
  std::vector<std::string> names;
  std::apply([&](const auto&... theory) { (names.push_back(theory.name()), ...); }, theories);
  CHECK(names == std::vector<std::string>{"WhiteNoise", "EquivalentLinearization", "EquivalentLinearization, laplace",
                                          "EquivalentLinearization, thesis", "StationaryLinearization", "PulseChain",
                                          "PulseSuperposition, renewal", "PulseSuperposition, none",
                                          "SlowlyVaryingParameters"});
  CHECK(PulseChain(true).name() == "PulseChain, refined");
}

TEST_CASE("a theory answers by its one call as by its own ones, to the last bit", "[theory]") {
  const Spectrum white = Spectrum::white(0.7);
  const Moments exact = WhiteNoise(slope, 0.7).predict(times);
  CHECK(same(WhiteNoise().predict(slope, 0.7, times), exact));
  CHECK(same(WhiteNoise().predict(slope, white, times), exact));
  CHECK(same(WhiteNoise().predict(slope, shaking, times), exact));

  const Moments linear = EquivalentLinearization().predict(cart, 0.7, times);
  CHECK(same(EquivalentLinearization().predict(cart, white, times), linear));
  CHECK(same(EquivalentLinearization().predict(cart, shaking, times), linear));

  const StationaryLinearization stationary;
  const Moments filtered = stationary.predict(sprung, band.spectrum()).transient(times);
  CHECK(same(stationary.predict(sprung, band.spectrum(), times), filtered));
  CHECK(same(stationary.predict(sprung, band, times), filtered));
  CHECK(same(stationary.predict(block, 0.7, times), stationary.predict(block, white).transient(times)));

  const Moments turning = SlowlyVaryingParameters(cart).predict(harmonic, times);
  CHECK(same(SlowlyVaryingParameters::predict(cart, harmonic, times), turning));
}

TEST_CASE("under harmonic ground the averaged motion is a mean without scatter", "[theory]") {
  const SlowlyVaryingParameters theory(block);
  const std::vector<double> long_after{0, 500, 500.3};
  const Moments moments = theory.predict(harmonic, long_after);
  const double omega = harmonic.omega();
  const auto solutions = theory.response(harmonic.amplitude(), omega);
  REQUIRE(solutions.size() == 1);
  const auto& [amplitude, phase, stable] = solutions.front();
  CHECK(moments.displacement_mean.value[0] == 0);  // from rest
  CHECK(moments.velocity_mean.value[0] == 0);
  for (const std::size_t i : {1U, 2U}) {
    const double angle = omega * long_after[i] + phase;
    // Amplitude and phase are integrated to 1e-10 a step; they contract to the solution.
    CHECK(std::abs(moments.displacement_mean.value[i] - amplitude * std::cos(angle)) < 1e-7 * amplitude);
    CHECK(std::abs(moments.velocity_mean.value[i] + omega * amplitude * std::sin(angle)) < 1e-7 * omega * amplitude);
    CHECK(moments.displacement_variance.value[i] == 0);
  }
  CHECK(moments.growth_rate.value == 0);
}

TEST_CASE("a caster that only rolls is linearized as a block", "[theory]") {
  const Cart rolling(Caster(0, 2, 0.1));
  const theory::EquivalentLinearization linearization;
  REQUIRE(linearization.covers(rolling, theory::WhiteLevel(0.01)));
  const std::vector<double> times{1, 10, 100};
  const Moments cart = linearization.predict(rolling, theory::WhiteLevel(0.01), times);
  const Moments block = linearization.predict(Slider(Coulomb(0.1)), theory::WhiteLevel(0.01), times);
  for (std::size_t i = 0; i < times.size(); ++i) {  // both to the tolerance of CVODE, 1e-8 a step
    CHECK(cart.displacement_variance.value[i] == Approx(block.displacement_variance.value[i]).epsilon(1e-5));
    CHECK(cart.velocity_variance.value[i] == Approx(block.velocity_variance.value[i]).epsilon(1e-5));
  }
  CHECK_THROWS_WITH(
      theory::transition_time(rolling, theory::WhiteLevel(1)),
      "transition_time: a caster with rolling resistance is not covered, rolling must be 0, got 0.1 m/s^2");
}
