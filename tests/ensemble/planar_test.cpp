// Ensembles of sliders in the plane: members as integrate has them, moments of vectors, parts, white noise, refusals.
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "stickslip/ensemble/run.hpp"
#include "stickslip/excitation/with_transverse.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"
#include "support/size.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;

namespace {

using Block = PlanarSlider<Coulomb>;

/// Two components with a correlation of 0.6.
WithTransverse<GaussianExcitation> pairs() {
  return WithTransverse(GaussianExcitation(Spectrum::band_pass(0.05, 2, 40), 0.02, 201), 0.8, 0.6);
}

EnsembleOptions options(std::uint64_t members, std::uint64_t first = 0, unsigned threads = 2) {
  EnsembleOptions o;
  o.members = members;
  o.first_member = first;
  o.seed = 5;
  o.threads = threads;
  o.dt = 0.4;
  return o;
}

/// The unbiased covariance of two columns.
double covariance_of(const std::vector<double>& a, const std::vector<double>& b) {
  double mean_a = 0, mean_b = 0, sum = 0;
  const auto n = static_cast<double>(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) mean_a += a[i] / n, mean_b += b[i] / n;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - mean_a) * (b[i] - mean_b);
  return sum / (n - 1);
}

/// White noise of the strength D = 1 in both components: independent values, held for `dt`, under each of which a
/// component of the velocity changes by a normal number of the variance 2 D dt.
struct WhitePairs {
  double dt;
  std::size_t steps;

  GroundMotion sample(std::uint64_t seed, std::uint64_t member) const {
    std::seed_seq sequence{seed, member};
    std::mt19937_64 bits(sequence);
    std::normal_distribution<double> normal(0, std::sqrt(2 / dt));
    std::vector<double> n(steps + 1), t(steps + 1);
    for (std::size_t i = 0; i < steps; ++i) n[i] = normal(bits), t[i] = normal(bits);
    return GroundMotion(std::move(n), dt, Interpolation::constant).with_components(std::move(t));
  }
  std::optional<TimeBase> time_base() const { return TimeBase{dt * static_cast<double>(steps), dt}; }
  std::string configuration() const { return "{\"white pairs\": " + std::to_string(dt) + "}"; }
};

}  // namespace

TEST_CASE("members in the plane are what integrate says of them", "[ensemble][planar]") {
  const Block block{Coulomb(0.4)};
  const auto motions = pairs();
  // Equal to the rounding of some ten operations in each of a few hundred segments.
  for (const bool settle : {false, true}) {
    EnsembleOptions o = options(70, 64);
    o.settle = settle;
    const Ensemble e = run_ensemble(block, motions, o);
    REQUIRE(e.in_plane());
    REQUIRE(e.members() == 70);
    const auto peak = e.peak(), x = e.residual(), y = e.residual(Component::transverse);
    std::vector<double> xs, ys, vxs, vys;
    for (std::size_t i = 0; i < 70; ++i) {
      const PlanarResponse r = integrate(block, motions.sample(5, 64 + i), {.settle = settle});
      INFO("member " << 64 + i);
      REQUIRE(std::abs(peak[i] - r.peak) <= 1e-12 * r.peak);
      REQUIRE(norm(Vector2{x[i], y[i]} - r.residual) <= 1e-12 * r.peak);
      xs.push_back(r.displacement[140].axis), ys.push_back(r.displacement[140].transverse);
      vxs.push_back(r.velocity[140].axis), vys.push_back(r.velocity[140].transverse);
    }
    constexpr std::size_t k = 7;  // 2.8 s, sample 140
    const auto close = [](double found, double expected, double scale) {
      return std::abs(found - expected) <= 1e-12 * scale;
    };
    const double xx = covariance_of(xs, xs), yy = covariance_of(ys, ys), vv = covariance_of(vxs, vxs),
                 ww = covariance_of(vys, vys);
    CHECK(close(e.displacement_variance().value[k], xx, xx));
    CHECK(close(e.displacement_variance(Component::transverse).value[k], yy, yy));
    CHECK(close(e.velocity_variance().value[k], vv, vv));
    CHECK(close(e.velocity_variance(Component::transverse).value[k], ww, ww));
    CHECK(close(e.covariance(Component::transverse).value[k], covariance_of(ys, vys), std::sqrt(yy * ww)));
    CHECK(close(e.displacement_covariance().value[k], covariance_of(xs, ys), std::sqrt(xx * yy)));
    CHECK(close(e.velocity_covariance().value[k], covariance_of(vxs, vys), std::sqrt(vv * ww)));
    CHECK(e.displacement_covariance().error[k] > 0);
  }
}

TEST_CASE("members with heated surfaces, springs and slopes are what integrate says of them", "[ensemble][planar]") {
  const auto motions = pairs();
  const std::size_t members = size(6, 2);
  const auto check = [&](const auto& slider) {
    const Ensemble e = run_ensemble(slider, motions, options(members));
    for (std::size_t i = 0; i < members; ++i) {
      const PlanarResponse r = integrate(slider, motions.sample(5, i));
      INFO("member " << i);
      REQUIRE(r.peak > 0);
      REQUIRE(std::abs(e.peak()[i] - r.peak) <= 1e-12 * r.peak);
    }
  };
  check(PlanarSlider(Coulomb(0.4), {.natural_frequency = 3, .damping = 0.1, .slope_degrees = 1}));
  check(PlanarSlider(
      KumarFriction({.mu_ref = 0.06, .static_pressure = 20e6, .reference_pressure = 20e6, .contact_radius = 0.2})));
}

TEST_CASE("ensembles in the plane have the same bits on threads and in parts", "[ensemble][planar]") {
  const Block block{Coulomb(0.4)};
  const auto motions = pairs();
  const Ensemble whole = run_ensemble(block, motions, options(200, 0, 1));
  CHECK(run_ensemble(block, motions, options(200, 0, 3)) == whole);
  Ensemble parts = run_ensemble(block, motions, options(72, 128));
  parts.merge(run_ensemble(block, motions, options(128)));
  CHECK(parts == whole);
  const Ensemble start = run_ensemble(block, motions, options(128));
  CHECK(run_ensemble(block, motions, options(200), &start) == whole);
  CHECK(Ensemble(Ensemble::Parts(whole.parts())) == whole);
  const AnyPlanarSlider any = block;
  CHECK(run_ensemble(any, motions, options(200)).peak() == whole.peak());
}

TEST_CASE("collinear pairs move along their line", "[ensemble][planar]") {
  // Both components equal: the slider moves along the diagonal, sqrt(2) times as strongly shaken.
  const GaussianExcitation along(Spectrum::band_pass(0.05, 2, 40), 0.02, 201);
  const Ensemble e = run_ensemble(Block(Coulomb(0.4)), WithTransverse(along, 1.0, 1.0), options(64));
  const Ensemble one = run_ensemble(Slider(Coulomb(0.4 / std::sqrt(2.0))), along, options(64));
  for (std::size_t i = 0; i < 64; ++i)
    REQUIRE(std::abs(e.peak()[i] - std::sqrt(2.0) * one.peak()[i]) <= 1e-9 * one.peak()[i]);
  const double variance = e.displacement_variance().value.back();
  CHECK(std::abs(e.displacement_covariance().value.back() - variance) <= 1e-9 * variance);
}

TEST_CASE("impacts on a circular stop count as impacts forward", "[ensemble][planar]") {
  const auto motions = pairs();
  // The median is the peak of a member, which the stop would touch or not by a rounding.
  const double gap = 1.0001 * run_ensemble(Block(Coulomb(0.4)), motions, options(64)).quantile(0.5).value;
  const Ensemble e = run_ensemble(Block(Coulomb(0.4), Mounting{.stops = Stops(gap, 0.5)}), motions, options(64));
  CHECK(e.impact_probability().value == 0.5);
  CHECK(e.exceedance(gap).value == 0.5);
  CHECK(e.impact_probability(Direction::forward).value == 0.5);
  CHECK_THROWS_AS(e.impact_probability(Direction::backward), std::domain_error);
  CHECK_THROWS_AS(e.exceedance(1.001 * gap), std::invalid_argument);
}

TEST_CASE("white noise in the plane agrees with the exact theory", "[ensemble][planar][statistics]") {
  // Unit friction and D = 1: per component E v^2 = 3 and, stationary, E x v = 21/2, half the growth rate. Extrapolated
  // to dt = 0 from two steps with independent members, from an error of the first order; what remains is of the size of
  // dt^2. The seeds are fixed; each of the two checks within three standard errors fails for one seed in 370. The two
  // components are not correlated, but not independent: the error of their mean is taken as the mean of their errors.
  constexpr double duration = 40, dt = 0.05;  // a relaxation takes 4 D / a^2 = 4
  const auto mean = [](const Estimates& a, const Estimates& b) {
    return Estimate{(a.value.back() + b.value.back()) / 2, (a.error.back() + b.error.back()) / 2};
  };
  const auto run = [&](double step, std::uint64_t seed) {
    EnsembleOptions o;
    o.members = 6000;
    o.seed = seed;
    o.dt = duration / 2;
    return run_ensemble(Block(Coulomb(1)), WhitePairs{step, static_cast<std::size_t>(std::round(duration / step))}, o);
  };
  const Ensemble coarse = run(4 * dt, 1), fine = run(dt, 2);
  const auto check = [&](const char* what, const Estimate& c, const Estimate& f, double expected) {
    const double value = (4 * f.value - c.value) / 3, error = std::hypot(4 * f.error, c.error) / 3;
    INFO(what << ": " << c.value << " and " << f.value << ", extrapolated " << value << " +- " << error << ", exact "
              << expected);
    CHECK(std::abs(value - expected) < 3 * error);
  };
  constexpr auto y = Component::transverse;
  check("E v^2", mean(coarse.velocity_variance(), coarse.velocity_variance(y)),
        mean(fine.velocity_variance(), fine.velocity_variance(y)), 3);
  check("E x v", mean(coarse.covariance(), coarse.covariance(y)), mean(fine.covariance(), fine.covariance(y)), 10.5);
}

TEST_CASE("what ensembles in the plane cannot say", "[ensemble][planar]") {
  const Block block{Coulomb(0.4)};
  const Ensemble e = run_ensemble(block, pairs(), options(64));
  CHECK_THROWS_WITH(e.stationary(), ContainsSubstring("not available for sliders in the plane"));
  CHECK_THROWS_WITH(e.velocity_spectrum(), ContainsSubstring("not available for sliders in the plane"));
  CHECK_THROWS_WITH(e.displacement_mean(Component::vertical), ContainsSubstring("must be axis or transverse"));
  EnsembleOptions o = options(64);
  o.ground_acceleration = true;
  CHECK_THROWS_WITH(run_ensemble(block, pairs(), o), ContainsSubstring("ground_acceleration is not available"));
  const GaussianExcitation along(Spectrum::band_pass(0.05, 2, 40), 0.02, 201);
  CHECK_THROWS_WITH(run_ensemble(block, along, options(64)),
                    ContainsSubstring("member 0") && ContainsSubstring("transverse component"));
  const Ensemble axis = run_ensemble(Coulomb(0.4), along, options(64));
  CHECK(!axis.in_plane());
  CHECK_THROWS_WITH(axis.displacement_covariance(), ContainsSubstring("no transverse displacement"));
  CHECK_THROWS_WITH(axis.residual(Component::transverse), ContainsSubstring("no transverse displacement"));
  Ensemble merged = axis;
  CHECK_THROWS_WITH(merged.merge(e), ContainsSubstring("cannot merge what differs"));
}
