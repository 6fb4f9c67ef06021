// Ensembles under random vertical motion: members as integrate has them, threads, limits, refusals.
#include <cmath>
#include <string>
#include <vector>

#include "stickslip/ensemble/run.hpp"
#include "stickslip/excitation/with_vertical.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;

namespace {

/// Zero at the end, so that no member ends in the air.
GaussianExcitation shaking(double strength = 1) {
  return {Spectrum::band_pass(strength * 0.05, 2, 40),
          0.02,
          401,
          {.envelope = Envelope::from_table({0, 1, 6, 8}, {0, 1, 1, 0})}};
}

EnsembleOptions options(std::uint64_t members, std::uint64_t first = 0, unsigned threads = 2) {
  EnsembleOptions o;
  o.members = members;
  o.first_member = first;
  o.seed = 5;
  o.threads = threads;
  return o;
}

/// To the rounding of some ten operations on the largest x in each of a few hundred segments.
template <class S, class M>
void check_members(const S& slider, const M& motions, Contact contact, bool settle) {
  EnsembleOptions o = options(30, 64);
  o.contact = contact;
  o.settle = settle;
  const Ensemble ensemble = run_ensemble(slider, motions, o);
  IntegrateOptions how;
  how.contact = contact;
  how.settle = settle;
  bool flew = false;
  for (std::size_t i = 0; i < 30; ++i) {
    const Response r = integrate(slider, motions.sample(5, 64 + i), how);
    INFO("member " << 64 + i);
    REQUIRE(std::abs(ensemble.peak()[i] - r.peak) <= 1e-12 * r.peak);
    REQUIRE(std::abs(ensemble.residual()[i] - r.residual) <= 1e-12 * r.peak);
    flew = flew || !r.gap.empty();
  }
  CHECK(flew == (contact == Contact::flight));
}

}  // namespace

TEST_CASE("a member under vertical motion is what integrate says of it", "[ensemble]") {
  const WithVertical lines(shaking(20), 1.0);
  for (const auto contact : {Contact::flight, Contact::clipped})
    for (const bool settle : {false, true}) {
      check_members(Coulomb(1), lines, contact, settle);
      check_members(Slider(StaticKinetic(Coulomb(1), 1.5), 3, 0.5), lines, contact, settle);
    }
  PoissonOptions still{.envelope = Envelope::from_table({0, 4, 4.2, 6}, {1, 1, 0, 0})};
  check_members(Coulomb(1), WithVertical(PoissonPulses(5, 0.1, 8, 6, still), PoissonPulses(9, 0.05, 12, 6, still)),
                Contact::flight, true);
}

TEST_CASE("vertical motion is the same on 1, 2 and 3 threads, in parts, and resumed", "[ensemble]") {
  const WithVertical motions(shaking(), 2.0 / 3);
  const Ensemble whole = run_ensemble(Coulomb(1), motions, options(300, 0, 1));
  CHECK(run_ensemble(Coulomb(1), motions, options(300, 0, 2)) == whole);
  CHECK(run_ensemble(Coulomb(1), motions, options(300, 0, 3)) == whole);
  Ensemble parts = run_ensemble(Coulomb(1), motions, options(172, 128));
  parts.merge(run_ensemble(Coulomb(1), motions, options(128)));
  CHECK(parts == whole);
  const Ensemble begun = run_ensemble(Coulomb(1), motions, options(64, 64));
  CHECK(run_ensemble(Coulomb(1), motions, options(300), &begun) == whole);
  CHECK_THROWS_WITH(parts.merge(run_ensemble(Coulomb(1), WithVertical(shaking(), 0.5), options(64, 320))),
                    ContainsSubstring("excitation"));
}

TEST_CASE("without vertical acceleration the members are those of horizontal motion alone", "[ensemble]") {
  const Ensemble with = run_ensemble(Coulomb(1), WithVertical(shaking(), 0.0), options(100));
  const Ensemble without = run_ensemble(Coulomb(1), shaking(), options(100));
  for (std::size_t i = 0; i < 100; ++i) {
    REQUIRE(std::abs(with.peak()[i] - without.peak()[i]) <= 1e-12 * without.peak()[i]);
    REQUIRE(std::abs(with.residual()[i] - without.residual()[i]) <= 1e-12 * without.peak()[i]);
  }
  CHECK(with.time() == without.time());
  const Estimates a = with.displacement_variance(), b = without.displacement_variance();
  for (std::size_t k = 0; k < a.value.size(); ++k) REQUIRE(std::abs(a.value[k] - b.value[k]) <= 1e-11 * b.value.back());
}

TEST_CASE("half of the vertical and the same horizontal motion: common random numbers", "[ensemble][statistics]") {
  // Vertical motion of high frequency averages out of the friction: peaks change by a fraction of themselves, while
  // they scatter by as much as they are. The pairs therefore correlate; independent ones would have |r| < 5 / sqrt(n),
  // 0.29, but once in 1.7 million seeds.
  constexpr std::size_t n = 300;
  const Ensemble with = run_ensemble(Coulomb(1), WithVertical(shaking(), 0.5), options(n));
  const Ensemble without = run_ensemble(Coulomb(1), shaking(), options(n));
  double x = 0, y = 0, xx = 0, yy = 0, xy = 0;
  for (std::size_t i = 0; i < n; ++i) {
    x += with.peak()[i] / n;
    y += without.peak()[i] / n;
  }
  for (std::size_t i = 0; i < n; ++i) {
    xx += (with.peak()[i] - x) * (with.peak()[i] - x);
    yy += (without.peak()[i] - y) * (without.peak()[i] - y);
    xy += (with.peak()[i] - x) * (without.peak()[i] - y);
  }
  CHECK(xy > 0.29 * std::sqrt(xx * yy));
}

TEST_CASE("members that end in the air count with their state there, and land if they settle", "[ensemble]") {
  // Held values: the acceleration at the end is that of the last step, and members end below -g now and then.
  const GaussianExcitation strong(Spectrum::band_pass(2, 2, 40), 0.02, 401, {.interpolation = Interpolation::constant});
  const WithVertical source(strong, 1.0);
  const Ensemble e = run_ensemble(Coulomb(1), source, options(64, 0, 1));
  std::uint64_t airborne = 0;
  for (std::uint64_t member = 0; member < 64; ++member) {
    const Response alone = integrate(Coulomb(1), source.sample(5, member), {.may_end_in_flight = true});
    airborne += alone.state.in_flight ? 1 : 0;
    CHECK_THAT(e.residual()[member], WithinAbs(alone.residual, 1e-12 * alone.peak));
  }
  CHECK(airborne > 0);
  CHECK(e.airborne() == airborne);
  EnsembleOptions settled = options(64, 0, 1);
  settled.settle = true;
  CHECK(run_ensemble(Coulomb(1), source, settled).airborne() == 0);
}
