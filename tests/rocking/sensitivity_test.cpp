// Derivatives of slender blocks: differences, identities of similar motions, refusals.
#include "stickslip/rocking/sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <stdexcept>
#include <vector>

#include "stickslip/base/units.hpp"
#include "stickslip/rocking/integrate.hpp"
#include "support/catch.hpp"

using namespace stickslip;
using Catch::Matchers::ContainsSubstring;

namespace {

struct Problem {
  double p, right, left, restitution;
  std::vector<double> n;
  bool settle;

  SlenderBlock block() const { return {p, right, left, restitution}; }
  GroundMotion motion(double scale = 1) const {
    std::vector<double> scaled = n;
    for (double& one : scaled) one *= scale;
    return {scaled, 0.1};
  }
  RockingResponse response(double scale = 1) const {
    RockingOptions options;
    options.settle = settle;
    return integrate(block(), motion(scale), options);
  }
};

Problem draw(std::mt19937_64& random, int trial) {
  std::uniform_real_distribution<double> unit(0, 1);
  Problem one{1 + 3 * unit(random), 0.1 + 0.2 * unit(random), 0, 0.5 + 0.45 * unit(random), {}, trial % 2 == 0};
  one.left = trial % 3 == 0 ? one.right : one.right * (0.8 + 0.4 * unit(random));
  const double strength = one.right * standard_gravity * (1 + unit(random)), phase = 6 * unit(random);
  for (int i = 0; i <= 60; ++i) {
    const double envelope = std::sin(3.14159 * i / 60);
    one.n.push_back(strength * envelope * std::sin(0.9 * i + phase + unit(random)));
  }
  return one;
}

}  // namespace

TEST_CASE("derivatives of a slender block are those of differences", "[rocking][sensitivity]") {
  std::mt19937_64 random(5);
  int compared = 0, close = 0, all = 0;
  for (int trial = 0; compared < 200; ++trial) {
    REQUIRE(trial < 2000);
    const Problem given = draw(random, trial);
    const RockingResponse r = given.response();
    if (r.overturned != 0 || r.impacts == 0 || r.condition > 30) continue;
    const auto compare = [&](RockingParameter parameter, double value, auto&& with) {
      constexpr double h = 2e-5;
      const RockingSensitivity s = sensitivity(given.block(), given.motion(), r, parameter);
      const double size = (1 + r.condition) * given.right / value;
      const auto check = [&](double derivative, double allowed, auto&& of) {
        // Central differences of two steps, and what they extrapolate to. Near a graze they are not close to each other.
        const auto difference = [&](double part) {
          return (of(with(value * (1 + part))) - of(with(value * (1 - part)))) / (2 * part * value);
        };
        const double coarse = difference(h), fine = difference(h / 2);
        if (std::abs(fine - coarse) < allowed) ++close;
        ++all;
        CHECK(std::abs(derivative - (4 * fine - coarse) / 3) < allowed + std::abs(fine - coarse));
      };
      INFO("trial " << trial << ", parameter " << static_cast<int>(parameter));
      check(s.peak, 1e-7 * size, [](const auto& one) { return one.peak; });
      check(s.rotation, 1e-7 * size, [](const auto& one) { return one.state.rotation; });
      check(s.rate, 1e-7 * given.p * size, [](const auto& one) { return one.state.rate; });
    };
    const auto changed = [&](double Problem::*member) {
      return [&given, member](double value) {
        Problem other = given;
        other.*member = value;
        return other.response();
      };
    };
    compare(RockingParameter::p, given.p, changed(&Problem::p));
    compare(RockingParameter::restitution, given.restitution, changed(&Problem::restitution));
    compare(RockingParameter::alpha_right, given.right, changed(&Problem::right));
    compare(RockingParameter::alpha_left, given.left, changed(&Problem::left));
    compare(RockingParameter::scale, 1, [&](double scale) { return given.response(scale); });
    ++compared;
  }
  CHECK(close > 0.9 * all);
}

TEST_CASE("theta is proportional to alpha and the ground acceleration together", "[rocking][sensitivity]") {
  std::mt19937_64 random(9);
  int compared = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Problem given = draw(random, trial);
    const RockingResponse r = given.response();
    if (r.overturned != 0 || r.impacts == 0) continue;
    const auto by = [&](RockingParameter parameter) {
      return sensitivity(given.block(), given.motion(), r, parameter);
    };
    const RockingSensitivity right = by(RockingParameter::alpha_right), left = by(RockingParameter::alpha_left),
                             both = by(RockingParameter::alpha), scale = by(RockingParameter::scale);
    const double allowed = 1e-11 * (1 + r.condition);
    CHECK(std::abs(right.peak + left.peak - both.peak) < allowed);
    CHECK(std::abs(given.right * right.peak + given.left * left.peak + scale.peak - r.peak) < allowed);
    CHECK(std::abs(given.right * right.rotation + given.left * left.rotation + scale.rotation - r.state.rotation) <
          allowed);
    CHECK(std::abs(given.right * right.rate + given.left * left.rate + scale.rate - r.state.rate) < given.p * allowed);
    ++compared;
  }
  CHECK(compared > 100);
}

TEST_CASE("derivatives refuse what has none", "[rocking][sensitivity]") {
  const SlenderBlock block(2, 0.2, 0.8);
  const GroundMotion strong({0, 30, 30, 30, 0}, 0.5), weak({0, 1, 0}, 0.1);
  const RockingResponse fallen = integrate(block, strong), rests = integrate(block, weak);
  CHECK_THROWS_WITH(sensitivity(block, strong, fallen, RockingParameter::p), ContainsSubstring("has overturned"));
  const GroundMotion lifted = weak.with_components({}, {0, 1, 0});
  CHECK_THROWS_WITH(sensitivity(block, lifted, integrate(block, lifted), RockingParameter::p),
                    ContainsSubstring("without vertical motion"));
  CHECK_THROWS_AS(sensitivity(block, weak, {}, RockingParameter::p), std::invalid_argument);
  CHECK(sensitivity(block, weak, rests, RockingParameter::p) == RockingSensitivity{});
}
