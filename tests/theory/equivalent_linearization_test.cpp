// Generalized equivalent linearization: the covariance equations against independent solutions and in their limits, and
// the Gaussian expectations behind them.
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "stickslip/theory/equivalent_linearization.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"
#include "support/reference.hpp"
#include "theory/covariance.hpp"
#include "theory/linear_friction.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;
using std::numbers::pi;
using theory::EquivalentLinearization;
using theory::LinearFriction;
using theory::transition_time;
using Force = EquivalentLinearization::Force;
using From = EquivalentLinearization::Start;

namespace {

double relative(double found, double value) { return std::abs(found / value - 1); }

Force force(const std::string& name) {
  return name == "thesis" ? Force::thesis : name == "gaussian" ? Force::gaussian : Force::gaussian_a22;
}

detail::Covariance at(const EquivalentLinearization& el, const auto& slider, double s0, double time) {
  const Moments m = el.predict(slider, s0, std::array<double, 1>{time});
  return {m.displacement_variance.value[0], m.covariance.value[0], m.velocity_variance.value[0]};
}

double apart(const detail::Covariance& found, const detail::Covariance& value) {
  return std::max({relative(found.q11, value.q11), relative(found.q12, value.q12), relative(found.q22, value.q22)});
}

// Laws of a user, the library's own among them.
struct AsCoulomb {
  double a;
  template <class T>
  double resist(const T&, Direction) const {
    return a;
  }
};
struct AsCaster {
  Caster wheel;
  template <class T>
  auto resist(const T& x, Direction direction) const {
    return wheel.resist(x, direction);
  }
};
struct Bell {  // exp(-(x / reach)^2), whose expectations are known
  double a, reach;
  template <class T>
  auto resist(const T& x, Direction) const {
    using std::exp;
    return a * exp(-(x / reach) * (x / reach));
  }
};
struct Ramp {  // a slope that steepens: level against forward sliding a + k x, against backward a - k x, |x| < a / k
  double a, k;
  template <class T>
  auto resist(const T& x, Direction direction) const {
    return a + sign(direction) * k * x;
  }
};

const EquivalentLinearization by_gauss, without_a21({.force = Force::gaussian_a22}),
    by_thesis({.force = Force::thesis});

}  // namespace

TEST_CASE("covariances are those of independent solutions", "[equivalent_linearization]") {
  for (const auto& value : reference::rows("equivalent_linearization", "covariances")) {
    const EquivalentLinearization el({.force = force(value["force"].as<std::string>()),
                                      .start = value["from_rest"].as<bool>() ? From::rest : From::thesis,
                                      .tolerance = 1e-12});
    // gamma = infinity: a reach so short that no friction is left.
    const Caster law(1, value["gamma"] == infinity ? 1e-300 : 1 / value["gamma"]);
    CAPTURE(value["id"].as<std::string>());
    CHECK(apart(at(el, law, 1, value["time"]), {value["q11"], value["q12"], value["q22"]}) <
          std::max(1e-10, 3 * value["error"]));  // its error is that of one component, of the last digits
  }
}

TEST_CASE("tolerances are kept", "[equivalent_linearization]") {
  const std::vector<double> times = {1e-6, 0.1, 1, 10, 100, 1000, 1e6};
  const auto solve = [&](const detail::LinearizedLaw& law, double wn, double tolerance) {
    return detail::solve_covariance(law, wn, 1, times, {.tolerance = tolerance}).covariance;
  };
  for (const auto& [law, wn] : {std::pair<detail::LinearizedLaw, double>{Coulomb(1), 0},
                                {Caster(1, 1000), 0},
                                {Caster(1, 1), 0},
                                {Coulomb(1), 0.1}}) {
    const auto tight = solve(law, wn, 1e-12);
    for (const double tolerance : {1e-5, 1e-8, 1e-10}) {
      const auto found = solve(law, wn, tolerance);
      for (std::size_t i = 0; i < times.size(); ++i) {
        const double scale = std::sqrt(tight[i].q11 * tight[i].q22);
        CAPTURE(law.index(), wn, tolerance, times[i]);
        // Errors of some hundred steps add up, the integration's own tolerance is a tenth.
        CHECK(relative(found[i].q11, tight[i].q11) < 10 * tolerance);
        CHECK(relative(found[i].q22, tight[i].q22) < 10 * tolerance);
        CHECK(std::abs(found[i].q12 - tight[i].q12) < 10 * tolerance * scale);
      }
    }
  }
}

TEST_CASE("coefficients are the Gaussian expectations", "[equivalent_linearization]") {
  for (const auto& value : reference::rows("equivalent_linearization", "coefficients")) {
    const Caster law(1, value["reach"]);
    CAPTURE(value["id"].as<std::string>());
    const LinearFriction full = by_gauss.coefficients(law, value["q11"], value["q12"], value["q22"]);
    CHECK(relative(full.a22, value["a22"]) < 1e-12);
    CHECK(relative(full.a21, value["a21"]) < 1e-12);
    CHECK(relative(without_a21.coefficients(law, value["q11"], value["q12"], value["q22"]).a22, value["a22"]) < 1e-12);
    CHECK(without_a21.coefficients(law, value["q11"], value["q12"], value["q22"]).a21 == 0);
    const LinearFriction thesis = by_thesis.coefficients(law, value["q11"], value["q12"], value["q22"]);
    CHECK(relative(thesis.a22, value["a22_thesis"]) < 1e-12);
    CHECK(thesis.a21 == 0);
  }
  const LinearFriction coulomb = by_gauss.coefficients(Coulomb(2), 7, 3, 5);
  CHECK(relative(coulomb.a22, -2 * std::sqrt(2 / (pi * 5))) < 1e-15);  // (3.44)
  CHECK(coulomb.a21 == 0);
}

TEST_CASE("expectations hold whatever the displacement is to the reach, and the correlation",
          "[equivalent_linearization]") {
  // Where the reach is long: sech(y) = 1 - y^2 / 2 + 5 y^4 / 24 within the density; where it is short, within sech the
  // density is flat, and the integrals of sech and of sech tanh y are pi.
  for (const double c : {-0.9, 0.0, 0.3, 0.866, 0.9999}) {
    const double s2 = (1 - c) * (1 + c);
    CAPTURE(c);
    for (const double eta : {1e-30, 1e-4}) {
      const LinearFriction f = by_gauss.coefficients(Caster(1, 1 / eta), 1, c, 1);
      CHECK(relative(f.a22, -std::sqrt(2 / pi) * (1 - s2 * eta * eta / 2)) < 1e-13);
      if (c != 0) CHECK(relative(f.a21, eta * eta * c * std::sqrt(2 / pi)) < 1e-7);
    }
    for (const double eta : {1e9, 1e300}) {
      const LinearFriction f = by_gauss.coefficients(Caster(1, 1 / eta), 1, c, 1);
      CHECK(relative(f.a22, -1 / (eta * std::sqrt(s2))) < 1e-13);
      // erf(c x / sqrt(2 (1 - c^2))) = 2 c x / sqrt(2 pi (1 - c^2)) there: a21 = (c / sqrt(1 - c^2)) / eta
      if (c != 0) CHECK(relative(f.a21, c / std::sqrt(s2) / eta) < 1e-12);
    }
  }
  // As the correlation becomes complete: E[|x'| level] over a line, d/dx of 1 / cosh.
  const LinearFriction line = by_gauss.coefficients(Caster(1, 1), 1, 1 - 1e-14, 1),
                       near = by_gauss.coefficients(Caster(1, 1), 1, 1 - 1e-10, 1);
  CHECK(relative(line.a21, near.a21) < 1e-4);
  CHECK(relative(line.a22, near.a22) < 1e-8);
}

TEST_CASE("a user's law is integrated by its level alone", "[equivalent_linearization]") {
  for (const double reach : {1e-6, 0.3, 1.0, 40.0, 1e5})
    for (const double c : {-0.5, 0.0, 0.2, 0.866, 0.999}) {
      CAPTURE(reach, c);
      const Caster wheel(1.5, reach);
      const LinearFriction closed = by_gauss.coefficients(wheel, 4, 6 * c, 9),
                           any = by_gauss.coefficients(AsCaster{wheel}, 4, 6 * c, 9);
      CHECK(relative(any.a22, closed.a22) < 1e-11);
      CHECK(std::abs(any.a21 - closed.a21) < 1e-12);  // a difference of terms of 0.6 or so
      // E[exp(-(x / L)^2)] = 1 / sqrt(1 + 2 s^2 q11 / L^2) with the conditional variance, and a21 by hand
      const double s2 = 1 - c * c, k = 2 * 4 / (reach * reach);
      const LinearFriction bump = by_gauss.coefficients(Bell{1.5, reach}, 4, 6 * c, 9);
      CHECK(relative(bump.a22, -1.5 * std::sqrt(2 / pi) / 3 / std::sqrt(1 + s2 * k)) < 1e-11);
      // E[(2 x / L^2) exp(-(x / L)^2) erf(r x)], by parts
      const double r = c / std::sqrt(8 * s2), p = (1 + k) / 8;
      const double a21 = 1.5 * 2 / (reach * reach) / std::sqrt(8 * pi) * r / (p * std::sqrt(p + r * r));
      CHECK(bump.a21 == Approx(a21).epsilon(1e-9).margin(1e-12));
    }
  const LinearFriction flat = by_gauss.coefficients(AsCoulomb{2}, 7, 3, 5);
  CHECK(relative(flat.a22, -2 * std::sqrt(2 / (pi * 5))) < 1e-12);
  CHECK(std::abs(flat.a21) < 1e-14);
  // A bowl: friction that grows with the way up is a spring.
  const LinearFriction bowl = by_gauss.coefficients(Ramp{2000, 3}, 1, 0.2, 4);
  CHECK(relative(bowl.a21, -3) < 1e-10);
}

TEST_CASE("a user's law is predicted as the library's own", "[equivalent_linearization]") {
  const std::vector<double> times = {0.1, 1, 10, 100};
  for (const double wn : {0.0, 0.4}) {
    const auto same = [&](const auto& mine, const auto& theirs) {
      const Moments a = by_gauss.predict(Slider(mine, wn), 1, times),
                    b = by_gauss.predict(Slider(theirs, wn), 1, times);
      for (std::size_t i = 0; i < times.size(); ++i) {
        CAPTURE(wn, times[i]);
        CHECK(relative(a.displacement_variance.value[i], b.displacement_variance.value[i]) < 1e-8);
        CHECK(relative(a.velocity_variance.value[i], b.velocity_variance.value[i]) < 1e-8);
      }
    };
    same(AsCoulomb{1}, Coulomb(1));
    same(AsCaster{Caster(1, 10)}, Caster(1, 10));
    same(AsCaster{Caster(1, 1e-3)}, Caster(1, 1e-3));
  }
}

TEST_CASE("a short reach leaves no friction, a long one Coulomb's", "[equivalent_linearization]") {
  for (const EquivalentLinearization& el : {by_gauss, without_a21, by_thesis})
    for (const double t : {0.1, 10.0, 1000.0}) {
      CAPTURE(static_cast<int>(el.options().force), t);
      CHECK(apart(at(el, Caster(1, 1e-30), 1, t), {2 * pi / 3 * t * t * t, pi * t * t, 2 * pi * t}) < 1e-9);
      const detail::Covariance coulomb = at(el, Coulomb(1), 1, t);
      CHECK(apart(at(el, Caster(1, 1e9), 1, t), coulomb) < 1e-9);
      CHECK(apart(at(el, Caster(1, infinity), 1, t), coulomb) < 1e-9);
    }
}

TEST_CASE("Coulomb friction alone has a solution of its own", "[equivalent_linearization]") {
  // With y = sqrt(q22 / q22(infinity)): t = -(pi^2 / 2) (y + ln(1 - y)), and q12 = (pi^5 / 4) (1 + (1 - y) (y^2 / 2 +
  // 2 y - 1 + 3 ln(1 - y))), from q22' = 2 pi - 2 sqrt(2 q22 / pi) and (3.33).
  for (const double y : {0.01, 0.1, 0.5, 0.9, 0.999, 1 - 1e-9}) {
    const double ln = std::log1p(-y), t = -pi * pi / 2 * (y + ln);
    const detail::Covariance q = at(EquivalentLinearization({.tolerance = 1e-12}), Coulomb(1), 1, t);
    CAPTURE(y, t);
    CHECK(relative(q.q22, std::pow(pi, 3) / 2 * y * y) < (y < 0.05 ? 1e-9 : 1e-10));  // t loses digits as y^2
    CHECK(relative(q.q12, std::pow(pi, 5) / 4 * (1 + (1 - y) * (y * (y / 2 + 2) - 1 + 3 * ln))) <
          (y < 0.2 ? 1e-7 : 1e-9));
  }
  // Late: (3.45) to (3.47), q11 with its intercept of 47 pi^7 / 96.
  const detail::Covariance q = at(by_gauss, Coulomb(1), 1, 1e5);
  CHECK(relative(q.q22, std::pow(pi, 3) / 2) < 1e-8);
  CHECK(relative(q.q12, std::pow(pi, 5) / 4) < 1e-8);
  CHECK(relative(q.q11, std::pow(pi, 5) / 2 * (1e5 - 47 * pi * pi / 48)) < 1e-8);
  CHECK(relative(by_gauss.predict(Coulomb(1), 1.0, std::array<double, 1>{1}).growth_rate.value, std::pow(pi, 5) / 2) <
        1e-14);
}

TEST_CASE("it begins as the exact series does", "[equivalent_linearization]") {
  // The remainders are p^3 and less, p = sqrt(t) / pi; beyond, friction away from x = 0 is nothing yet.
  for (const double t : {1e-30, 1e-9, 1e-6}) {
    const double root = std::sqrt(t);
    for (const double reach : {infinity, 100.0, 1.0}) {
      CAPTURE(t, reach);
      CHECK(apart(at(by_gauss, Caster(1, reach), 1, t),
                  {2 * pi / 3 * t * t * t * (1 - 44 * root / (35 * pi) + 8 * t / (15 * pi * pi)),
                   pi * t * t * (1 - 22 * root / (15 * pi) + 32 * t / (45 * pi * pi)),
                   2 * pi * t * (1 - 4 * root / (3 * pi) + 2 * t / (3 * pi * pi))}) < 1e-9);
    }
  }
}

TEST_CASE("with a spring, the displacement too becomes stationary", "[equivalent_linearization]") {
  for (const double wn : {0.05, 1.0, 4.0}) {
    CAPTURE(wn);
    const detail::Covariance q = at(by_gauss, Slider(Coulomb(1), wn), 1, 2000);
    CHECK(relative(q.q22, std::pow(pi, 3) / 2) < 1e-8);
    CHECK(relative(q.q11, std::pow(pi, 3) / 2 / (wn * wn)) < 1e-8);
    CHECK(std::abs(q.q12) < 1e-8 * std::sqrt(q.q11 * q.q22));
    CHECK(by_gauss.predict(Slider(Coulomb(1), wn), 1.0, std::array<double, 1>{1}).growth_rate.value == 0);
  }
  // A weak spring is none.
  CHECK(apart(at(by_gauss, Slider(Coulomb(1), 1e-7), 1, 50), at(by_gauss, Coulomb(1), 1, 50)) < 1e-9);
  // A caster is held by its spring while a reach wn > pi S0: friction then takes up to 2 a reach wn, more than the
  // noise gives. Stationary: a22 q22 = -pi S0 and q22 = wn^2 q11.
  const Caster law(1, 10);
  const auto growth = [&](double wn) {
    return by_gauss.predict(Slider(law, wn), 1.0, std::array<double, 1>{1}).growth_rate.value;
  };
  CHECK(growth(0.35) == 0);
  CHECK(std::isnan(growth(0.3)));
  const detail::Covariance held = at(by_gauss, Slider(law, 0.6), 1, 3000);
  CHECK(relative(by_gauss.coefficients(law, held.q11, 0, held.q22).a22 * held.q22, -pi) < 1e-8);
  CHECK(relative(held.q22, 0.36 * held.q11) < 1e-8);
  const detail::Covariance loose = at(by_gauss, Slider(law, 0.2), 1, 1000),
                           later = at(by_gauss, Slider(law, 0.2), 1, 2000);
  // On average: the energy rises by pi S0 - a reach wn a unit of time.
  CHECK(relative((0.04 * (later.q11 - loose.q11) + later.q22 - loose.q22) / 2000, pi - 2) < 0.05);
}

TEST_CASE("without friction it is exact, with a spring too", "[equivalent_linearization]") {
  const double s0 = 0.3, wn = 1.3;
  for (const double t : {1e-5, 0.02, 1.0, 30.0}) {
    CAPTURE(t);
    for (const EquivalentLinearization& el : {by_gauss, by_thesis}) {
      const detail::Covariance free = at(el, Coulomb(0), s0, t);
      CHECK(relative(free.q22, 2 * pi * s0 * t) < 1e-15);              // (3.41)
      CHECK(relative(free.q12, pi * s0 * t * t) < 1e-15);              // (3.42)
      CHECK(relative(free.q11, 2 * pi / 3 * s0 * t * t * t) < 1e-15);  // (3.43)
      CHECK(apart(at(el, Caster(0, 3), s0, t), free) < 1e-15);
    }
    // int_0^t (sin wn u / wn)^2 du and so on, in long double
    const long double w = wn, u = t, angle = 2 * w * u;
    const detail::Covariance exact{
        static_cast<double>(std::numbers::pi_v<long double> * s0 * (u - std::sin(angle) / (2 * w)) / (w * w)),
        static_cast<double>(std::numbers::pi_v<long double> * s0 * std::pow(std::sin(w * u) / w, 2.0L)),
        static_cast<double>(std::numbers::pi_v<long double> * s0 * (u + std::sin(angle) / (2 * w)))};
    CHECK(apart(at(by_gauss, Slider(Coulomb(0), wn), s0, t), exact) < (t < 1e-3 ? 1e-8 : t < 0.1 ? 1e-12 : 1e-14));
    CHECK(apart(at(by_gauss, Slider(AsCoulomb{0}, wn), s0, t), exact) < 1e-7);
  }
}

TEST_CASE("the covariance stays positive definite", "[equivalent_linearization]") {
  std::vector<double> times;
  for (int i = -40; i <= 60; ++i) times.push_back(std::pow(10, i / 10.0));
  const auto look = [&](const Moments& m) {
    for (std::size_t i = 0; i < times.size(); ++i) {
      const double q11 = m.displacement_variance.value[i], q12 = m.covariance.value[i],
                   q22 = m.velocity_variance.value[i];
      CAPTURE(times[i]);
      REQUIRE(q11 > 0);
      REQUIRE(q22 > 0);
      REQUIRE(q12 * q12 < q11 * q22);
    }
  };
  for (const From start : {From::rest, From::thesis})
    for (const double reach : {1e-6, 1.0, 300.0, infinity}) {
      CAPTURE(static_cast<int>(start), reach);
      look(EquivalentLinearization({.start = start, .tolerance = 1e-6}).predict(Caster(1, reach), 1.0, times));
      look(EquivalentLinearization({.force = Force::thesis, .start = start, .tolerance = 1e-3})
               .predict(Caster(1, reach), 1.0, times));
    }
}

TEST_CASE("friction away from rest only loosens: a21 pushes out", "[equivalent_linearization]") {
  // Casters lie between Coulomb friction and none (thesis 3.4.3), and a21 > 0 spreads them further.
  const std::vector<double> times = {1, 10, 100, 1000};
  Moments before = by_gauss.predict(Coulomb(1), 1.0, times);
  for (const double gamma : {0.001, 0.01, 0.1, 1.0, 10.0}) {
    const Moments full = by_gauss.predict(Caster(1, 1 / gamma), 1.0, times),
                  half = without_a21.predict(Caster(1, 1 / gamma), 1.0, times);
    for (std::size_t i = 0; i < times.size(); ++i) {
      CAPTURE(gamma, times[i]);
      const double q11 = full.displacement_variance.value[i];
      CHECK(q11 > before.displacement_variance.value[i]);
      CHECK(q11 > half.displacement_variance.value[i]);
    }
    before = full;
  }
}

TEST_CASE("nothing but gamma and a^2 t / S0 matter to it", "[equivalent_linearization]") {
  const double gamma = 0.02, t = 70;
  const detail::Covariance one = at(by_gauss, Slider(Caster(1, 1 / gamma), 0.1), 1, t);
  for (const auto& [a, s0] : {std::pair{3.0, 0.2}, std::pair{1e-30, 1e-40}, std::pair{1e30, 1e40}}) {
    const double time = s0 / a / a, velocity = s0 / a, displacement = velocity * time;
    const detail::Covariance q = at(by_gauss, Slider(Caster(a, displacement / gamma), 0.1 / time), s0, t * time);
    CAPTURE(a, s0);
    CHECK(apart({q.q11 / displacement / displacement, q.q12 / displacement / velocity, q.q22 / velocity / velocity},
                one) < 1e-9);
  }
}

TEST_CASE("times between others change nothing", "[equivalent_linearization]") {
  const Caster law(1, 30);
  std::vector<double> times;
  for (int i = 1; i <= 200; ++i) times.push_back(0.5 * i);
  const Moments many = by_gauss.predict(law, 1.0, times);
  const detail::Covariance one = at(by_gauss, law, 1, 100);
  CHECK(relative(many.displacement_variance.value.back(), one.q11) < 1e-8);
  CHECK(relative(many.velocity_variance.value.back(), one.q22) < 1e-8);
  // q11' = 2 q12 between them, by Simpson's rule from 40 to 60
  double sum = 0;
  for (std::size_t i = 79; i <= 119; ++i)
    sum += many.covariance.value[i] * (i == 79 || i == 119 ? 1 : i % 2 == 0 ? 4 : 2);
  CHECK(relative(many.displacement_variance.value[119] - many.displacement_variance.value[79], 2 * sum * 0.5 / 3) <
        1e-6);
}

TEST_CASE("a start at time zero is answered with where it starts", "[equivalent_linearization]") {
  const std::array<double, 2> times = {0, 1e-12};
  const Moments rest = by_gauss.predict(Caster(2, 1), 3.0, times);
  CHECK(rest.displacement_variance.value[0] == 0);
  CHECK(rest.velocity_variance.value[0] == 0);
  CHECK(rest.displacement_variance.error == std::vector<double>{0, 0});
  CHECK(rest.displacement_mean.value == std::vector<double>{0, 0});
  const Moments thesis = EquivalentLinearization({.start = From::thesis}).predict(Caster(2, 1), 3.0, times);
  for (const std::size_t i : {0U, 1U}) {
    CHECK(relative(thesis.displacement_variance.value[i], 0.01 * 81 / 64) < 1e-8);  // (3.38)
    CHECK(relative(thesis.covariance.value[i], 5.4e-8 * 27 / 16) < 1e-3);           // (3.39)
    CHECK(relative(thesis.velocity_variance.value[i], 1.3e-5 * 9 / 4) < 1e-5);      // (3.40)
  }
  CHECK(!thesis.remark.empty());
  CHECK(by_gauss.predict(Coulomb(1), 1.0, {}).time.empty());
}

TEST_CASE("remarks name the effects that are neglected", "[equivalent_linearization]") {
  const auto remark = [](const EquivalentLinearization& el, const auto& slider) {
    return el.predict(slider, 1.0, std::array<double, 1>{1}).remark;
  };
  for (const std::string& coulomb : {remark(by_gauss, Coulomb(1)), remark(by_thesis, Caster(1, infinity))})
    CHECK_THAT(coulomb, ContainsSubstring("WhiteNoise has the exact figures"));
  CHECK_THAT(remark(by_thesis, Caster(1, 1)), ContainsSubstring("a21"));
  CHECK(remark(by_gauss, Caster(1, 1)).empty());
  CHECK(remark(by_gauss, Caster(1, 100)).empty());  // at t = 1 it has not broken loose
  const auto loose = [](const auto& slider, double s0, double time) {
    const std::array<double, 2> times = {time / 2, time};
    return by_gauss.predict(slider, s0, times).remark;
  };
  CHECK_THAT(loose(Caster(1, 100), 1, 80), ContainsSubstring("here z is from ") && ContainsSubstring("= 0.01"));
  // In other units of length and time, gamma is the same.
  CHECK(loose(Caster(4, 100 * 0.25 / 64), 0.5, 80 * 0.5 / 16) == loose(Caster(1, 100), 1, 80));
  CHECK(loose(Caster(1, 100), 1, 2000).find("breaks loose") == std::string::npos);  // it has
  CHECK_THAT(loose(Slider(Caster(1, 1), 4), 1, 20), ContainsSubstring("on a spring"));
  CHECK(remark(by_thesis, Coulomb(0)).empty());  // exact
}

TEST_CASE("z exp(z^2) erfc(z) for any z", "[equivalent_linearization]") {
  CHECK(detail::scaled_erfc(0) == 0);
  CHECK(relative(detail::scaled_erfc(1), 0.42758357615580700442) < 1e-15);  // e erfc(1)
  CHECK(relative(detail::scaled_erfc(1e200), 1 / std::sqrt(pi)) < 1e-15);
  CHECK(detail::scaled_erfc(infinity) == 1 / std::sqrt(pi));
  for (const double z : {3.0, 7.999999, 8.000001, 20.0}) {
    // x = 1 / (z + (1/2) / (z + 1 / (z + (3/2) / (z + ...)))) / sqrt(pi)
    double fraction = z;
    for (int k = 400; k >= 1; --k) fraction = z + k / 2.0 / fraction;
    CAPTURE(z);
    CHECK(relative(detail::scaled_erfc(z), z / fraction / std::sqrt(pi)) < 1e-14);
  }
}

TEST_CASE("transition times", "[equivalent_linearization]") {
  for (const auto& value : reference::rows("equivalent_linearization", "transitions"))
    CHECK(relative(transition_time(Caster(1, 1 / value["gamma"]), 1.0).thesis, value["time"]) < 1e-12);
  // ERRATA to (3.51): 35.1 and 44.8 for gamma = 0.01.
  const theory::TransitionTime t = transition_time(Caster(1, 100), Spectrum::white(1));
  CHECK(t.thesis == Approx(35.1).margin(0.05));
  CHECK(t.with_intercept == Approx(44.8).margin(0.05));
  // At z = 1 on the way of Coulomb friction, (3.30): q11 - q12^2 / q22 = reach^2 / 2.
  const auto late = transition_time(Caster(1, 3000), 1.0);
  const detail::Covariance q = at(by_gauss, Coulomb(1), 1, late.with_intercept);
  CHECK(relative(q.q11 - q.q12 * q.q12 / q.q22, 3000. * 3000 / 2) < 1e-8);
  // Units: S0 / a^2 and gamma = S0^2 / (reach a^3).
  const auto scaled = transition_time(Caster(3, 100 * 0.04 / 27), 0.2);
  CHECK(relative(scaled.with_intercept, t.with_intercept * 0.2 / 9) < 1e-14);
  CHECK(std::isinf(transition_time(Caster(1, infinity), 1.0).thesis));
  CHECK_THROWS_WITH(transition_time(Caster(0, 1), 1.0), ContainsSubstring("without friction"));
  CHECK_THROWS_WITH(transition_time(Slider<Caster>(Caster(1, 1), 2), 1.0), ContainsSubstring("without a spring"));
}

TEST_CASE("arguments that it does not cover are rejected", "[equivalent_linearization]") {
  const std::array<double, 1> one = {1};
  CHECK_THROWS_WITH(by_gauss.predict(Coulomb(1, infinity), 1.0, one),
                    ContainsSubstring("both slip levels must be finite; backward, got inf m/s^2"));
  CHECK_THROWS_WITH(by_gauss.coefficients(Coulomb(1, 2), 1, 0, 1),
                    ContainsSubstring("the same both ways, got levels of 1 and 2 m/s^2"));
  CHECK_THROWS_WITH(by_gauss.predict(Ramp{1, -1e-3}, 1.0, std::array<double, 1>{1e4}), ContainsSubstring("at least 0"));
  struct Uphill {
    double resist(double x, Direction) const { return 2 + std::tanh(x); }
  };
  CHECK_THROWS_WITH(by_gauss.predict(Uphill{}, 1.0, one), ContainsSubstring("level(x, forward) = level(-x, backward)"));
  CHECK_THROWS_WITH(by_thesis.predict(AsCoulomb{1}, 1.0, one), ContainsSubstring("that of Coulomb and Caster"));
  struct Kinked {
    double resist(double x, Direction) const { return std::abs(x) < 1 ? 1 : 0.2; }
  };
  CHECK_THROWS_AS(by_gauss.coefficients(Kinked{}, 1, 0.3, 1), ConvergenceError);
  CHECK_THROWS_WITH(
      EquivalentLinearization({.filter = {.order = 2}}).predict(Coulomb(1), Spectrum::band_pass(1, 1, 2), one),
      ContainsSubstring("no filter of order 2 fits the spectrum: the best misplaces 0."));
  CHECK_THROWS_AS(by_gauss.predict(Coulomb(1), 0.0, one), std::invalid_argument);
  CHECK_THROWS_AS(by_gauss.predict(Coulomb(1), not_a_number, one), std::invalid_argument);
  CHECK_THROWS_WITH(by_gauss.predict(Coulomb(1), 1.0, std::array<double, 1>{-1}),
                    ContainsSubstring("at least 0, got -1 s"));
  CHECK_THROWS_AS(by_gauss.predict(Coulomb(1), 1.0, std::array<double, 2>{2, 1}), std::invalid_argument);
  CHECK_THROWS_AS(by_gauss.predict(Coulomb(1), 1.0, std::array<double, 1>{not_a_number}), std::invalid_argument);
  CHECK_THROWS_WITH(by_gauss.predict(Coulomb(0), 1.0, std::array<double, 1>{1e200}),
                    ContainsSubstring("exceed the range of doubles"));
  CHECK_THROWS_WITH(EquivalentLinearization({.start = From::thesis}).predict(Coulomb(0), 1.0, one),
                    ContainsSubstring("need friction"));
  CHECK_THROWS_AS(EquivalentLinearization({.tolerance = 1e-15}), std::invalid_argument);
  CHECK_THROWS_AS(EquivalentLinearization({.tolerance = not_a_number}), std::invalid_argument);
  CHECK_THROWS_WITH(by_gauss.coefficients(Coulomb(1), 1, 2, 1), ContainsSubstring("less than q11 q22"));
  CHECK_THROWS_AS(by_gauss.coefficients(Coulomb(1), -1, 0, 1), std::invalid_argument);
  // A spring that would swing indefinitely at this rate.
  CHECK_THROWS_WITH(by_gauss.predict(Slider(Coulomb(1e-3), 10), 1.0, std::array<double, 1>{1e9}),
                    ContainsSubstring("reached "));
  int calls = 0;
  struct Stop {};
  CHECK_THROWS_AS(by_gauss.predict(Slider(Coulomb(1e-3), 10), 1.0, std::array<double, 1>{1e9},
                                   [&] {
                                     if (++calls == 2) throw Stop();
                                   }),
                  Stop);
}
