// Derivatives of responses: reference values, differences of integrate, closed forms, refusals.
#include "stickslip/sliding/sensitivity.hpp"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "stickslip/core.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;

namespace {

template <class Law>
Sensitivity derivative(const Slider<Law>& slider, const GroundMotion& motion, Parameter parameter,
                       const IntegrateOptions& options = {}) {
  return sensitivity(slider, motion, integrate(slider, motion, options), parameter);
}

GroundMotion with_vertical(double factor) {
  std::vector<double> up;
  for (int m = 0; m <= 400; ++m) up.push_back(factor * 2.5 * std::cos(0.5 * m + 0.2));
  return record_a().with_components({}, up);
}

/// The response with a parameter at a value.
using Answer = std::function<Response(double)>;

/// Central differences at two steps: the nearer one is off by a third of what they differ by, to leading order, and by
/// the round-off of the response over the step.
void check_differences(const Answer& answer, double at, double step, const Sensitivity& found) {
  const auto difference = [&](double h) {
    const Response above = answer(at + h), below = answer(at - h);
    REQUIRE(above.events.size() == below.events.size());  // else a decision changes within the step
    return Sensitivity{(above.peak - below.peak) / (2 * h), (above.residual - below.residual) / (2 * h),
                       (above.velocity.back() - below.velocity.back()) / (2 * h)};
  };
  const Sensitivity near = difference(step / 2), far = difference(step);
  const Response r = answer(at);
  const double round_off = 1e-12 / step;
  CHECK(std::abs(found.peak - near.peak) <= std::abs(far.peak - near.peak) + round_off * r.peak);
  CHECK(std::abs(found.residual - near.residual) <= std::abs(far.residual - near.residual) + round_off * r.peak);
  CHECK(std::abs(found.velocity - near.velocity) <= std::abs(far.velocity - near.velocity) + round_off);
}

}  // namespace

TEST_CASE("derivatives by the levels are those of the reference", "[sensitivity]") {
  // next_values.json H; the record is rounded to doubles, which its response shows with 1e-13.
  const Sensitivity coulomb = derivative(Slider(Coulomb(1)), record_a(), Parameter::slip_level);
  CHECK(std::abs(coulomb.residual - 0.0369442211152422060947586) < 1e-11);
  CHECK(std::abs(coulomb.velocity - 0.2826502237287907562626829) < 1e-11);

  const Sensitivity kinetic = derivative(Slider(StaticKinetic(Coulomb(1), 1.3)), record_a(), Parameter::kinetic);
  CHECK(std::abs(kinetic.residual - -0.005800506449603001092489243) < 1e-11);
  CHECK(std::abs(kinetic.velocity - 0.2820330604952225279172446) < 1e-11);

  const Slider stopped(Coulomb(0.5), {.stops = Stops(0.1, 0.7)});
  const Sensitivity stops = derivative(stopped, record_a(), Parameter::slip_level);
  CHECK(std::abs(stops.residual - 0.02719720013980316472404459) < 1e-9);
  CHECK(std::abs(stops.velocity - 0.1273957726095713824050136) < 1e-9);
  CHECK(stops.peak == 0);  // at a stop

  const Sensitivity damped = derivative(Slider(Coulomb(1), 5, 1), record_a(), Parameter::slip_level);
  CHECK(std::abs(damped.residual - 0.05566782222475651241968373) < 1e-11);
  CHECK(std::abs(damped.velocity - 0.4190548807616716596707476) < 1e-11);
  CHECK(std::abs(damped.peak - -0.06605024081606075327844513) < 1e-11);
}

TEST_CASE("derivatives are the limits of differences", "[sensitivity]") {
  const GroundMotion quake = record_a(), shaken = with_vertical(1);
  SECTION("by the level") {
    check_differences([&](double a) { return integrate(Coulomb(a), quake); }, 1, 1e-4,
                      derivative(Slider(Coulomb(1)), quake, Parameter::slip_level));
    check_differences([&](double a) { return integrate(Slider(Coulomb(a), 2), shaken); }, 1, 1e-4,
                      derivative(Slider(Coulomb(1), 2), shaken, Parameter::slip_level));
  }
  SECTION("by static and kinetic levels, with a spring and a damper") {
    const auto slider = [](double held, double slides) { return Slider(StaticKinetic(Coulomb(slides), held), 5, 0.7); };
    check_differences([&](double a) { return integrate(slider(a, 0.8), quake); }, 1.3, 1e-5,
                      derivative(slider(1.3, 0.8), quake, Parameter::static_level));
    check_differences([&](double a) { return integrate(slider(1.3, a), quake); }, 0.8, 1e-5,
                      derivative(slider(1.3, 0.8), quake, Parameter::kinetic));
    check_differences([&](double d) { return integrate(slider(1.3 + d, 0.8 + d), quake); }, 0, 1e-5,
                      derivative(slider(1.3, 0.8), quake, Parameter::slip_level));
    check_differences([&](double f) { return integrate(slider(1.3, 0.8), quake.scaled(f)); }, 1, 1e-5,
                      derivative(slider(1.3, 0.8), quake, Parameter::scale));
  }
  SECTION("by the spring and the damper") {
    for (const double c : {0.0, 0.5, 4.0, 9.0}) {  // also critically damped and above
      INFO(c);
      const auto slider = [&](double wn, double damping) { return Slider(Coulomb(0.6), wn, damping); };
      check_differences([&](double wn) { return integrate(slider(wn, c), quake); }, 2, 1e-4,
                        derivative(slider(2, c), quake, Parameter::natural_frequency));
      if (c > 0)
        check_differences([&](double d) { return integrate(slider(2, d), quake); }, c, 1e-4,
                          derivative(slider(2, c), quake, Parameter::damping));
    }
    check_differences([&](double d) { return integrate(Slider(Coulomb(0.6), 0, d), quake); }, 1, 1e-4,
                      derivative(Slider(Coulomb(0.6), 0, 1), quake, Parameter::damping));
    check_differences([&](double wn) { return integrate(Slider(Coulomb(0.3), wn), shaken); }, 40, 1e-4,
                      derivative(Slider(Coulomb(0.3), 40), shaken, Parameter::natural_frequency));
  }
  SECTION("by the slope and the scale, under vertical motion") {
    const auto slider = [&](double degrees) { return Slider(Coulomb(4), {.slope_degrees = degrees, .one_way = true}); };
    check_differences([&](double degrees) { return integrate(slider(degrees), shaken); }, 20, 1e-4,
                      derivative(slider(20), shaken, Parameter::slope));
    check_differences([&](double f) { return integrate(slider(20), shaken.scaled(f)); }, 1, 1e-5,
                      derivative(slider(20), shaken, Parameter::scale));
  }
  SECTION("with stops that take all speed") {
    const auto slider = [&](double a) { return Slider(Coulomb(a), {.stops = Stops(0.1, 0)}); };
    check_differences([&](double a) { return integrate(slider(a), quake); }, 0.5, 1e-6,
                      derivative(slider(0.5), quake, Parameter::slip_level));
  }
  SECTION("without contact, clipped") {
    IntegrateOptions clipped;
    clipped.contact = Contact::clipped;
    const GroundMotion strong = with_vertical(5);
    check_differences([&](double a) { return integrate(Coulomb(a), strong, clipped); }, 1, 1e-5,
                      derivative(Slider(Coulomb(1)), strong, Parameter::slip_level, clipped));
  }
  SECTION("of held values, to the final rest") {
    IntegrateOptions settle;
    settle.settle = true;
    const GroundMotion held = record_a(Interpolation::constant);
    const auto slider = [](double a) { return Slider(StaticKinetic(Coulomb(a), 1.3 * a), 1); };
    check_differences([&](double a) { return integrate(slider(a), held, settle); }, 0.8, 1e-5,
                      [&] {
                        const Sensitivity one = derivative(slider(0.8), held, Parameter::kinetic, settle),
                                          other = derivative(slider(0.8), held, Parameter::static_level, settle);
                        return Sensitivity{one.peak + 1.3 * other.peak, one.residual + 1.3 * other.residual,
                                           one.velocity + 1.3 * other.velocity};
                      }());
  }
}

TEST_CASE("derivatives follow the laws of scaling", "[sensitivity]") {
  // x is homogeneous of degree one in level and ground motion together, and without a spring x(a, f n) = f x(a / f, n).
  const GroundMotion quake = record_a();
  for (const double level : {0.5, 1.0, 1.7}) {
    const Slider slider(Coulomb(level), 1.5);
    const Response r = integrate(slider, quake);
    const Sensitivity a = sensitivity(slider, quake, r, Parameter::slip_level),
                      f = sensitivity(slider, quake, r, Parameter::scale);
    CHECK(std::abs(level * a.residual + f.residual - r.residual) < 1e-10 * r.peak);
    CHECK(std::abs(level * a.peak + f.peak - r.peak) < 1e-10 * r.peak);
    CHECK(std::abs(level * a.velocity + f.velocity - r.state.velocity) < 1e-10);
  }
}

TEST_CASE("the derivative of one slip is known", "[sensitivity]") {
  // Thrown at v against a it goes v^2 / (2 a).
  IntegrateOptions thrown;
  thrown.velocity = 2;
  const Sensitivity s = derivative(Slider(Coulomb(0.5)), held(0, 10), Parameter::slip_level, thrown);
  CHECK(s.residual == Approx(-8).epsilon(1e-13));
  CHECK(s.peak == Approx(-8).epsilon(1e-13));
  CHECK(s.velocity == 0);
  // At rest all the time.
  CHECK(derivative(Slider(Coulomb(9)), record_a(), Parameter::slip_level) == Sensitivity{});
}

TEST_CASE("what has no derivative is refused with the reason", "[sensitivity]") {
  const GroundMotion quake = record_a();
  const auto refused = [&](const auto& slider, const GroundMotion& motion, Parameter parameter, const char* reason) {
    CHECK_THROWS_WITH(derivative(slider, motion, parameter), ContainsSubstring(reason));
  };
  refused(Slider(Caster(1, 0.5)), quake, Parameter::slip_level, "covers Coulomb friction");
  refused(Slider(VelocityDependent(0.5, 1, 3)), quake, Parameter::slip_level, "covers Coulomb friction");
  refused(Slider(Coulomb(1)), quake, Parameter::static_level, "has one level for sliding and rest");
  refused(Slider(Coulomb(1)), quake, Parameter::natural_frequency, "without a spring");
  refused(Slider<Coulomb>::friction_pendulum(Coulomb(1), 2), quake, Parameter::slip_level, "got a pendulum");
  refused(Slider(Coulomb(1)), with_vertical(5), Parameter::slip_level, "must not leave the ground");
}
