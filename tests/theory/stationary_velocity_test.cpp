#include "stickslip/theory/stationary_velocity.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "stickslip/numerics/gauss_legendre.hpp"
#include "stickslip/theory/transport.hpp"
#include "stickslip/theory/white_noise.hpp"
#include "support/catch.hpp"

using namespace stickslip;
using std::numbers::pi;
using theory::StationaryVelocity;

TEST_CASE("Coulomb friction has the stationary velocity of WhiteNoise") {
  for (const auto& [a, b] :
       {std::pair{1.0, 1.0}, {0.3, 1.0}, {2.0, 0.5}, {1.0, std::numeric_limits<double>::infinity()}})
    for (const double s0 : {0.02, 1.0, 50.0}) {
      const Coulomb law(a, b);
      const StationaryVelocity found(Slider<Coulomb>{law}, s0);
      const theory::WhiteNoise exact(law, s0);
      CHECK(found.mean() == Approx(exact.mean()).epsilon(1e-12).margin(1e-13 * exact.mean_speed()));
      CHECK(found.mean_speed() == Approx(exact.mean_speed()).epsilon(1e-12));
      CHECK(found.variance() == Approx(exact.variance()).epsilon(1e-12));
      CHECK(found.growth_rate() == Approx(exact.growth_rate()).epsilon(1e-12));
      for (const double v : {-2.0, -0.1, 0.0, 0.7, 5.0})
        CHECK(found.density(v * s0) == Approx(exact.density(v * s0)).epsilon(1e-11).margin(1e-30));
    }
}

TEST_CASE("a damper with next to no friction has a Gaussian velocity") {
  // An Ornstein-Uhlenbeck process: variance D / c, growth 2 D / c^2.
  const double s0 = 0.7, c = 0.4, d = pi * s0;
  const StationaryVelocity found(Slider(Coulomb(1e-12), 0, c), s0);
  CHECK(found.variance() == Approx(d / c).epsilon(1e-10));
  CHECK(found.growth_rate() == Approx(2 * d / (c * c)).epsilon(1e-10));
  CHECK(found.density(1) == Approx(std::exp(-c / (2 * d)) / std::sqrt(2 * pi * d / c)).epsilon(1e-10));
}

TEST_CASE("dry and viscous friction have the closed density of Touchette, Prellberg and Just") {
  // p ~ exp(-(a |v| + c v^2 / 2) / D): with z = a / sqrt(2 c D), total = sqrt(2 pi D / c) exp(z^2) erfc(z).
  const double a = 0.8, c = 0.3, s0 = 0.4, d = pi * s0, z = a / std::sqrt(2 * c * d);
  const double total = std::sqrt(2 * pi * d / c) * std::exp(z * z) * std::erfc(z);
  const StationaryVelocity found(Slider(Coulomb(a), 0, c), s0);
  for (const double v : {-3.0, 0.0, 0.5, 2.0})
    CHECK(found.density(v) == Approx(std::exp(-(a * std::abs(v) + c * v * v / 2) / d) / total).epsilon(1e-12));
  // E|v| and E v^2 by parts: D p(0) = (a/2 + c E|v| / 2) ..., that is c E|v| = 2 D p(0) - a, and c E v^2 = D - a E|v|.
  const double mean_speed = (2 * d / total - a) / c;
  CHECK(found.mean_speed() == Approx(mean_speed).epsilon(1e-12));
  CHECK(found.variance() == Approx((d - a * mean_speed) / c).epsilon(1e-12));
}

TEST_CASE("the stationary velocity of laws of the speed is that of the transport operator") {
  const AnySlider sliders[] = {Slider(VelocityDependent(0.5, 1.0, 2.0)), Slider(VelocityDependent(1.0, 0.5, 2.0)),
                               Slider(Stribeck(1.3, 0.8, 0.3, 1)), Slider(Stribeck(1.5, 1.0, 0.5, 2), 0, 0.2)};
  for (const AnySlider& slider : sliders)
    for (const double s0 : {0.05, 0.5}) {
      const StationaryVelocity exact(slider, s0);
      const auto found = theory::Transport(1e-3).stationary(slider, theory::TwoStateNoise(s0));
      CHECK(std::abs(found.velocity_variance.value - exact.variance()) < found.velocity_variance.error);
      CHECK(std::abs(found.growth_rate.value - exact.growth_rate()) < found.growth_rate.error);
      CHECK(exact.mean() == Approx(0).margin(1e-13));
    }
}

TEST_CASE("friction that slides one way has no backward velocity, and the flux through rest vanishes") {
  Mounting one_way;
  one_way.one_way = true;
  const StationaryVelocity found(Slider(VelocityDependent(0.5, 1.0, 2.0), one_way), 0.3);
  CHECK(found.density(-1e-9) == 0);
  CHECK(found.mean() == found.mean_speed());
  // D p(0) = E f: friction takes what the reflection at rest gives.
  double friction = 0;
  for (double v = 0; v < 60; v += 0.1)
    numerics::gauss_points<8>(v, v + 0.1, [&](double u, double weight) {
      friction += weight * (1 - 0.5 * std::exp(-2 * u)) * found.density(u);
    });
  CHECK(friction == Approx(pi * 0.3 * found.density(0)).epsilon(1e-10));
}

TEST_CASE("what has no stationary velocity under white noise is refused") {
  using Catch::Contains;
  CHECK_THROWS_WITH(StationaryVelocity(Slider(Coulomb(0)), 1.0), Contains("friction must bound the velocity"));
  CHECK_THROWS_WITH(StationaryVelocity(Slider(VelocityDependent(1, 0, 2)), 1.0), Contains("must bound the velocity"));
  CHECK_THROWS_WITH(StationaryVelocity(Slider(Coulomb(1), 0.5), 1.0), Contains("without a spring"));
  CHECK_THROWS_WITH(StationaryVelocity(Slider(Caster(1, 2)), 1.0), Contains("depends on the speed alone"));
  CHECK_THROWS_WITH(StationaryVelocity(Slider(Coulomb(1)), -1.0), Contains("positive and finite"));
  CHECK(std::isnan(StationaryVelocity(Slider(Coulomb(1)), 1.0).density(std::nan(""))));
}
