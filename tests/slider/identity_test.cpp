// What tells sliders and ground motions apart.
#include <cmath>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "stickslip/slider/identity.hpp"
#include "stickslip/sliding/any_slider.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;

namespace {

struct Fading {
  double level, reach;
  static constexpr const char* class_name = "Fading";
  static constexpr auto parts() { return std::tuple(Part{"level", &Fading::level}, Part{"reach", &Fading::reach}); }
  double resist(double x, Direction) const { return level * std::exp(-(x / reach) * (x / reach)); }
};

}  // namespace

TEST_CASE("the identity of a slider states its law and its mounting", "[identity]") {
  CHECK(identity(Slider(Coulomb(1, 2))) ==
        R"({"law": "Coulomb", "slip_level": 1, "backward": 2, "natural_frequency": 0})");
  CHECK(identity(Slider(Caster(1, 0.5), 2)) ==
        R"({"law": "Caster", "slip_level": 1, "reach": 0.5, "natural_frequency": 2})");
  CHECK(identity(Slider(Caster(1, 0.5, 0.02), 2)) ==
        R"({"law": "Caster", "slip_level": 1, "reach": 0.5, "rolling": 0.02, "natural_frequency": 2})");
  CHECK(identity(Slider(Stribeck(2, 1, 0.1, 2))) ==
        R"({"law": "Stribeck", "static": 2, "kinetic": 1, "velocity": 0.1, )"
        R"("exponent": 2, "natural_frequency": 0})");
  CHECK(identity(Slider(Degrading({0, 0.5}, {2, 1}))) ==
        R"({"law": "Degrading", "distances": [0, 0.5], "levels": [2, 1], "backward": [2, 1], "natural_frequency": 0})");
  CHECK(identity(Slider(StaticKinetic(VelocityDependent(1, 2, 30), 3))) ==
        R"({"static": [3, 3], "law": "VelocityDependent", "slow": 1, "fast": 2, "rate": 30, "natural_frequency": 0})");
  CHECK(identity(Slider(KumarFriction(
            {.mu_ref = 0.06, .static_pressure = 1e7, .reference_pressure = 2e7, .contact_radius = infinity}))) ==
        R"({"law": "KumarFriction", "mu_ref": 0.06, "static_pressure": 1e+07, "reference_pressure": 2e+07, )"
        R"("contact_radius": null, "temperature": 20, "rate": 100, "diffusivity": 4.44e-06, "conductivity": 18, )"
        R"("natural_frequency": 0})");
}

TEST_CASE("each part of a mounting counts", "[identity]") {
  const Mounting all{.natural_frequency = 2,
                     .damping = 0.1,
                     .slope_degrees = 5,
                     .one_way = true,
                     .stops = {0.1, 0.2, 0.5},
                     .pendulum = true};
  std::vector<Mounting> mountings(7, all);
  mountings[1].natural_frequency = 3;
  mountings[2].damping = 0.2;
  mountings[3].slope_degrees = 6;
  mountings[4].one_way = false;
  mountings[5].stops = {0.1, 0.2, 0.6};
  mountings[6].pendulum = false;
  std::set<std::string> texts;
  for (const Mounting& mounting : mountings) texts.insert(identity(Slider(Coulomb(1), mounting)));
  CHECK(texts.size() == mountings.size());
  CHECK(identity(Slider(Coulomb(1), -0.0, -0.0)) == identity(Slider(Coulomb(1))));
  CHECK(identity(AnySlider(Slider(Coulomb(1), all))) == identity(Slider(Coulomb(1), all)));
}

TEST_CASE("your own law is known by its parts, or by some of its levels", "[identity]") {
  struct Rate {
    double scale;
    double resist(double, double speed, Direction) const { return 2 + std::exp(-speed / scale); }
  };
  static_assert(SpeedLaw<Rate> && !WithParts<Rate>);
  CHECK(identity(Slider(Rate{0.001})) != identity(Slider(Rate{0.0025})));
  CHECK(identity(Slider(Rate{0.001})) == identity(Slider(Rate{0.001})));

  CHECK(identity(Slider(Fading{2, 0.01})) == R"({"law": "Fading", "level": 2, "reach": 0.01, "natural_frequency": 0})");

  const auto within = [](double limit) {
    return FunctionLaw([limit](double x, double, Direction) { return std::abs(x) < limit ? 1.0 : not_a_number; });
  };
  CHECK(identity(Slider(within(0.15))) != identity(Slider(within(0.25))));
  CHECK(identity(Slider(within(0.15))) == identity(Slider(within(0.15))));
}

TEST_CASE("all samples of a ground motion count, and its times; names do not", "[identity]") {
  const std::vector<double> a{0, 1, -1, 0}, b{0, 0.5, 0.25, 0};
  const auto text = [](const GroundMotion& motion) { return identity(std::span(&motion, 1)); };
  const GroundMotion plain(a, 0.1);
  std::vector<GroundMotion> motions{plain,
                                    GroundMotion(a, 0.2),
                                    GroundMotion(b, 0.1),
                                    GroundMotion(a, 0.1, Interpolation::constant),
                                    plain.with_components({}, b),
                                    plain.with_components(b),
                                    plain.with_components({}, a)};
  std::set<std::string> texts;
  for (const GroundMotion& motion : motions) texts.insert(text(motion));
  CHECK(texts.size() == motions.size());
  CHECK(text(GroundMotion(a, 0.1)).size() == 16);
  CHECK(text(GroundMotion(a, 0.1)) == text(plain));
}
