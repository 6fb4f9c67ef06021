// Derivatives of pendulums with several surfaces. Those of random bearings are in tests/python, where they compile
// faster.
#include <cstddef>
#include <vector>

#include "stickslip/friction/multi_pendulum.hpp"
#include "stickslip/sliding/any_slider.hpp"
#include "stickslip/sliding/sensitivity.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;

TEST_CASE("the derivative of a slip across a jump of the force is known", "[sensitivity]") {
  // Thrown at v, the first, flat surface takes d at mu1 g, and the second, flat one the rest at mu2 g:
  //     v^2 / 2 = mu1 g d + mu2 g (x - d).
  const double mu1 = 0.02, mu2 = 0.05, d = 0.1, v = 1, g = standard_gravity;
  const MultiPendulum law({infinity, infinity}, {mu1, mu2}, {d, infinity});
  const GroundMotion motion = held(0, 10);
  IntegrateOptions thrown;
  thrown.velocity = v;
  const AnySlider slider = Slider(law);
  const Response r = integrate(slider, motion, thrown);
  const double beyond = v * v / 2 / (mu2 * g) - mu1 * d / mu2;
  REQUIRE(r.residual == Approx(d + beyond).epsilon(1e-13));
  const auto by = [&](Parameter parameter, std::size_t surface) {
    return sensitivity(slider, motion, r, parameter, surface).residual;
  };
  CHECK(by(Parameter::mu, 0) == Approx(-d / mu2).epsilon(1e-12));
  CHECK(by(Parameter::mu, 1) == Approx(-beyond / mu2).epsilon(1e-12));
  CHECK(by(Parameter::capacity, 0) == Approx(1 - mu1 / mu2).epsilon(1e-12));
  CHECK(sensitivity(slider, motion, r, Parameter::mu).residual == Approx(-(d + beyond) / mu2).epsilon(1e-12));
}

TEST_CASE("elements change with their surfaces") {
  const std::vector<double> radii{0.15, 0.6, 0.7, 1.9, 2.3}, mu{0.015, 0.03, 0.045, 0.07, 0.10},
      capacities{0.05, 0.10, 0.12, 0.30, 0.35};
  for (std::size_t i = 0; i < radii.size(); ++i)
    for (auto member :
         {&MultiPendulum::Element::radius, &MultiPendulum::Element::mu, &MultiPendulum::Element::capacity}) {
      const auto elements = [&](double change) {
        std::vector<double> lists[] = {radii, mu, capacities};
        lists[member == &MultiPendulum::Element::radius ? 0
              : member == &MultiPendulum::Element::mu   ? 1
                                                        : 2][i] += change;
        return MultiPendulum(lists[0], lists[1], lists[2], 0, true).elements();
      };
      std::vector<MultiPendulum::Element> unit(radii.size(), {0, 0, 0});
      unit[i].*member = 1;
      const double h = 1e-5;
      const auto above = elements(h), below = elements(-h),
                 found = MultiPendulum(radii, mu, capacities, 0, true).change_of_elements(unit);
      for (std::size_t k = 0; k < above.size(); ++k)
        for (auto of :
             {&MultiPendulum::Element::radius, &MultiPendulum::Element::mu, &MultiPendulum::Element::capacity})
          CHECK_THAT(found[k].*of, WithinAbs((above[k].*of - below[k].*of) / (2 * h), 1e-7));
    }
}

TEST_CASE("what a pendulum has no derivative by is refused with the reason", "[sensitivity]") {
  const GroundMotion quake = record_a();
  const auto refused_of = [&](const MultiPendulum& law, Parameter parameter, std::size_t surface, const char* reason) {
    const AnySlider slider = Slider(law);
    CHECK_THROWS_WITH(sensitivity(slider, quake, integrate(slider, quake), parameter, surface),
                      ContainsSubstring(reason));
  };
  const MultiPendulum bearing({1, infinity}, {0.05, 0.1}, {0.1, infinity});
  refused_of(bearing, Parameter::mu, 2, "the index of a surface must be from 0 to 1, got 2");
  refused_of(bearing, Parameter::radius, 1, "radii[1] is infinite");
  refused_of(bearing, Parameter::capacity, 1, "capacities[1] is infinite");
  refused_of(bearing, Parameter::scale, 0, "only radius, mu and capacity belong to a surface");
}
