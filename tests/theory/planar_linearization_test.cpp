// Equivalent linearization in the plane and in d dimensions: its coefficients by quadrature, its errors under white
// noise against the exact theory, and what it shares with one axis.
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "numerics/quadrature.hpp"
#include "stickslip/theory/equivalent_linearization.hpp"
#include "stickslip/theory/white_noise.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;
using detail::integral;
using std::numbers::pi;
using theory::EquivalentLinearization;
using theory::WhiteNoise;
using Force = EquivalentLinearization::Force;

namespace {

double relative(double found, double value) { return std::abs(found / value - 1); }

EquivalentLinearization in(int dimensions, Force force = Force::gaussian) {
  return EquivalentLinearization({.force = force, .dimensions = dimensions});
}

bool same(const Moments& a, const Moments& b, double tolerance) {
  for (std::size_t i = 0; i < a.time.size(); ++i)
    if (relative(a.displacement_variance.value[i], b.displacement_variance.value[i]) > tolerance ||
        relative(a.covariance.value[i], b.covariance.value[i]) > tolerance ||
        relative(a.velocity_variance.value[i], b.velocity_variance.value[i]) > tolerance)
      return false;
  return true;
}

const std::array<double, 3> times = {0.5, 5, 20};

}  // namespace

TEST_CASE("the equivalent damper has the work of friction, E|v| a = c E|v|^2", "[planar_linearization]") {
  const double a = 1.3, q22 = 0.7, s = std::sqrt(q22);
  for (const int d : {1, 2, 3, 4, 6}) {
    const auto mean = [&](int order, auto&& density) {  // of |v|^order, with a density that depends on |v| alone
      const auto moment = [&](int n) {
        return integral([&](double u) { return std::pow(u, d - 1 + n) * density(u); }, 0, 60,
                        std::array<double, 3>{0.5, 2, 8});
      };
      return moment(order) / moment(0);
    };
    const auto gaussian = [&](double u) { return std::exp(-u * u / (2 * q22)); };
    const auto laplace = [&](double u) { return std::exp(-u * std::sqrt(d + 1.0) / s); };
    CAPTURE(d);
    CHECK(relative(mean(2, gaussian), d * q22) < 1e-9);
    CHECK(relative(mean(2, laplace), d * q22) < 1e-9);
    const theory::LinearFriction by_gauss = in(d).coefficients(Coulomb(a), 2, 0.1, q22);
    const theory::LinearFriction by_laplace = in(d, Force::laplace).coefficients(Coulomb(a), 2, 0.1, q22);
    CHECK(by_gauss.a21 == 0);
    CHECK(by_laplace.a21 == 0);
    CHECK(relative(-by_gauss.a22, a * mean(1, gaussian) / mean(2, gaussian)) < 1e-8);
    CHECK(relative(-by_laplace.a22, a * mean(1, laplace) / mean(2, laplace)) < 1e-8);
  }
  CHECK(relative(-in(2).coefficients(Coulomb(1), 1, 0, 1).a22, std::sqrt(pi / 8)) < 1e-14);
}

TEST_CASE("errors of linearization in d dimensions under white noise", "[planar_linearization]") {
  struct Error {
    int dimensions;
    double variance, growth, laplace_growth;
  };
  // The table of docs/white_noise.md: ratios to the exact values.
  for (const Error& error :
       {Error{1, pi / 4, pi * pi / 20, 4.0 / 5}, Error{2, 8 / (3 * pi), 128 / (21 * pi * pi), 6.0 / 7},
        Error{3, 9 * pi / 32, 9 * pi * pi / 128, 8.0 / 9}}) {
    const int d = error.dimensions;
    const WhiteNoise exact = WhiteNoise::coulomb(0.8, 0.3, d);
    const Moments gaussian = in(d).stationary(Slider(Coulomb(0.8)), 0.3),
                  laplace = in(d, Force::laplace).stationary(Slider(Coulomb(0.8)), 0.3);
    CAPTURE(d);
    CHECK(relative(gaussian.velocity_variance.value[0], error.variance * exact.variance()) < 1e-8);
    CHECK(relative(gaussian.growth_rate.value, error.growth * exact.growth_rate()) < 1e-8);
    CHECK(relative(laplace.velocity_variance.value[0], exact.variance()) < 1e-8);
    CHECK(relative(laplace.growth_rate.value, error.laplace_growth * exact.growth_rate()) < 1e-8);
    const Moments late = in(d).predict(Coulomb(0.8), 0.3, std::array<double, 1>{1e3});
    CHECK(relative(late.velocity_variance.value[0], error.variance * exact.variance()) < 1e-8);
    CHECK(relative(late.growth_rate.value, error.growth * exact.growth_rate()) < 1e-12);
    // From rest, linearization is exact at first and then falls behind.
    double before = 1.001;
    for (const double time : {1e-4, 0.1, 1.0, 10.0, 100.0}) {
      const std::array<double, 1> one = {time};
      const double ratio = in(d).predict(Coulomb(0.8), 0.3, one).displacement_variance.value[0] /
                           exact.predict(one).displacement_variance.value[0];
      CHECK(ratio < before);
      CHECK(ratio > error.growth);
      before = ratio;
    }
  }
}

TEST_CASE("in the plane, the moments are those of one axis with a level lower by pi / 4", "[planar_linearization]") {
  const double a = 0.9, gaussian = pi / 4, laplace = std::sqrt(2.0 / 3);
  const Spectrum soil = Spectrum::kanai_tajimi(0.25, 15, 0.6);
  const GaussianExcitation quake(soil, 0.02, 1024, {.zero_frequency = true, .envelope = Envelope(4, 6, 0.3)});
  for (const auto& [spring, damping] : {std::pair{0.0, 0.0}, std::pair{2.0, 0.0}, std::pair{2.0, 0.4}}) {
    const Slider block(Coulomb(a), spring, damping), gauss(Coulomb(gaussian * a), spring, damping),
        two_sided(Coulomb(laplace * a), spring, damping);
    CAPTURE(spring, damping);
    CHECK(same(in(2).predict(block, 0.4, times), in(1).predict(gauss, 0.4, times), 1e-9));
    CHECK(same(in(2).predict(block, soil, times), in(1).predict(gauss, soil, times), 1e-9));
    CHECK(same(in(2).predict(block, quake, times), in(1).predict(gauss, quake, times), 1e-9));
    CHECK(same(in(2, Force::laplace).predict(block, soil, times), in(1, Force::laplace).predict(two_sided, soil, times),
               1e-9));
    if (spring > 0) CHECK(same(in(2).stationary(block, soil), in(1).stationary(gauss, soil), 1e-9));
  }
  // A linear spring and damper without friction do not know of other coordinates.
  CHECK(same(in(3).predict(Slider(Coulomb(0), 2, 0.4), soil, times),
             in(1).predict(Slider(Coulomb(0), 2, 0.4), soil, times), 1e-12));
}

TEST_CASE("names, remarks and refusals of linearization in d dimensions", "[planar_linearization]") {
  CHECK(in(2).name() == "EquivalentLinearization, 2 dimensions");
  CHECK(in(3, Force::laplace).name() == "EquivalentLinearization, laplace, 3 dimensions");
  const std::array<double, 1> one = {1};
  CHECK_THAT(in(2).predict(Coulomb(1), 1.0, one).remark,
             ContainsSubstring("in 2 dimensions under white noise the stationary velocity variance is 15 % low and the "
                               "growth of the displacement variance 38 %: WhiteNoise has"));
  CHECK_THAT(in(2, Force::laplace).predict(Coulomb(1), 1.0, one).remark,
             ContainsSubstring("exact, the growth of the displacement variance 14 % low"));
  CHECK_THAT(in(3, Force::laplace).stationary(Slider(Coulomb(1)), 1.0).remark, ContainsSubstring("11 % low"));
  CHECK(in(2).predict(Slider(Coulomb(1), 2), 1.0, one).remark.empty());

  CHECK_THROWS_WITH(in(0), ContainsSubstring("dimensions must be from 1 to 6, got 0"));
  CHECK_THROWS_WITH(in(7), ContainsSubstring("dimensions must be from 1 to 6, got 7"));
  CHECK_THROWS_WITH(in(2, Force::thesis), ContainsSubstring("dimensions must be 1, got 2"));
  CHECK_THROWS_AS(EquivalentLinearization({.start = EquivalentLinearization::Start::thesis, .dimensions = 2}),
                  std::invalid_argument);
  CHECK_THROWS_WITH(in(2).predict(Caster(1, 1), 1.0, one), ContainsSubstring("covers Coulomb friction"));
  CHECK_THROWS_WITH(in(2).predict(Coulomb(1, 2), 1.0, one),
                    ContainsSubstring("must be equal") && ContainsSubstring("got 1 and 2"));
  CHECK_THAT(in(2).covers(Slider(Caster(1, 1)), 1.0).reason, ContainsSubstring("in 2 dimensions covers Coulomb"));
  CHECK(in(2).covers(Slider(Coulomb(1), 2, 0.3), PoissonPulses(0.5, 1, 5, 60)));
}
