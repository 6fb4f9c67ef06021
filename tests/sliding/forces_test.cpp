#include "stickslip/sliding/forces.hpp"

#include <cmath>
#include <cstddef>
#include <limits>

#include "stickslip/friction/velocity_dependent.hpp"
#include "stickslip/sliding/integrate.hpp"
#include "support/catch.hpp"
#include "support/laws.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;

namespace {

// Work of friction and damper by the trapezoidal rule, over what the response accounts for; and what friction is off
// its level or its bounds at most.
struct Balance {
  double friction, damper, beyond;
};

template <class Law>
Balance balance(const Slider<Law>& slider, const GroundMotion& motion) {
  const Response r = integrate(slider, motion);
  const Forces f = forces(slider, motion, r);
  REQUIRE(f.friction.size() == motion.samples());
  Balance result{-r.energy.dissipated, -r.energy.damped, 0};
  for (std::size_t i = 0; i < motion.samples(); ++i) {
    const double v = r.velocity[i], x = r.displacement[i];
    const double weight = motion.dt() * (i == 0 || i + 1 == motion.samples() ? 0.5 : 1);
    result.friction += weight * f.friction[i] * v;
    result.damper += weight * f.damper[i] * v;
    CHECK(f.total(i) == f.friction[i] + f.damper[i] + f.spring[i]);
    if (f.stuck[i] != 0) {
      CHECK(v == 0);
      CHECK(std::abs(f.total(i) + motion.acceleration()[i]) < 1e-14);
      result.beyond = std::max({result.beyond, f.friction[i] - hold(slider.law(), x, Direction::forward),
                                -f.friction[i] - hold(slider.law(), x, Direction::backward)});
    } else if (v != 0) {
      const Direction direction = v > 0 ? Direction::forward : Direction::backward;
      CHECK(f.friction[i] == sign(direction) * resist(slider.law(), x, std::abs(v), direction));
    }
  }
  result.friction /= r.energy.dissipated;
  result.damper /= std::max(r.energy.damped, std::numeric_limits<double>::min());
  return result;
}

}  // namespace

TEST_CASE("forces balance, and their work is the energy that is dissipated", "[forces]") {
  std::vector<double> n;
  const std::vector<double> coarse = record_a_samples();
  for (std::size_t k = 0; k < 400 * 64; ++k)
    n.push_back(std::lerp(coarse[k / 64], coarse[k / 64 + 1], static_cast<double>(k % 64) / 64));
  const GroundMotion motion(n, 0.1 / 64);
  const auto check = [&](const auto& slider) {
    const Balance b = balance(slider, motion);
    // h^2 / 12 of the second derivative of F v, some (2 pi / 0.2 s)^2 of it
    CHECK(std::abs(b.friction) < 1e-3);
    CHECK(std::abs(b.damper) < (slider.damping() > 0 ? 1e-3 : 1e-300));
    CHECK(b.beyond < 1e-14);
  };
  for (const double wn : {0.0, 1.3})
    for (const double c : {0.0, 0.4}) {
      check(Slider(Coulomb(1), wn, c));
      check(Slider(Coulomb(1, 1.6), wn, c));
      check(Slider(Caster(1, 0.5), wn, c));
      check(Slider(VelocityDependent(0.6, 1.2, 5), wn, c));
      check(Slider(Bump{1, 0.3}, wn, c));
    }
}

TEST_CASE("where a slip begins, turns or stops, the forces are those just after it", "[forces]") {
  const Coulomb block(1);
  const auto friction = [&](const GroundMotion& motion) {
    return forces(block, motion, integrate(block, motion)).friction;
  };
  CHECK(friction(steps({0.5, 3, 0.5})) == std::vector<double>{-0.5, -1, -1, -1});
  CHECK(friction(steps({3, 0, 0, 0.25})) == std::vector<double>{-1, -1, -1, -0.25, -0.25});
  CHECK(friction(steps({2, 0, -3})) == std::vector<double>{-1, -1, 1, 1});
}

TEST_CASE("after the ground motion what a stuck slider holds is its spring", "[forces]") {
  const Slider slider(Coulomb(1), 1.3);
  const GroundMotion motion = steps({4, -4});
  const Response r = integrate(slider, motion, from(0, 0, true));
  const Forces f = forces(slider, motion, r);
  REQUIRE(r.displacement.size() > motion.samples());
  CHECK(f.stuck.back() == 1);
  CHECK(f.total(r.displacement.size() - 1) == 0);
  CHECK(f.friction.back() == -slider.stiffness() * r.residual);
}

TEST_CASE("the largest force has its closed form", "[forces]") {
  // On arrival at the largest displacement, without a damper.
  const double level = 0.5, wn = 2;
  const Slider slider(Coulomb(level), wn);
  const auto interpolation = GENERATE(Interpolation::linear, Interpolation::constant);
  const GroundMotion motion = record_a(interpolation);
  const Response r = integrate(slider, motion);
  const LargestForce f = peak_force(slider, motion, r);
  CHECK(f.force == Approx(wn * wn * r.peak + level).epsilon(1e-13));
  const double at[] = {f.time};
  CHECK(std::abs(states_at(slider, motion, r, at)[0].displacement) == Approx(r.peak).epsilon(1e-13));
  // Without a spring friction is all, from the first slip on.
  const Response block = integrate(Coulomb(level), motion);
  const LargestForce friction = peak_force(Coulomb(level), motion, block);
  CHECK(friction.force == Approx(level).epsilon(1e-13));
  CHECK(friction.time <= block.events.front().time + 1e-9);
}

TEST_CASE("the largest force of a linear oscillator at resonance is that of spring and damper", "[forces]") {
  const double ratio = 0.1, wn = 3, c = 2 * ratio * wn, amplitude = 1 / (c * wn);
  const Slider slider(Coulomb(0), wn, c);
  // x = amplitude sin(wn t): wn^2 x + c x' has the amplitude of both
  const HarmonicMotion motion(1, wn, 10, 0.01);
  const Response r = integrate(slider, motion, from(0, amplitude * wn));
  CHECK(peak_force(slider, motion, r).force == Approx(amplitude * std::hypot(wn * wn, c * wn)).epsilon(1e-9));
}

TEST_CASE("the largest force is that of many samples", "[forces]") {
  std::vector<double> n;
  const std::vector<double> coarse = record_a_samples();
  for (std::size_t k = 0; k < 400 * 16; ++k)
    n.push_back(std::lerp(coarse[k / 16], coarse[k / 16 + 1], static_cast<double>(k % 16) / 16));
  const GroundMotion fine(n, 0.1 / 16);
  const auto check = [&](const auto& slider, double accuracy = 1e-9, double missed = 0.01) {
    const Response r = integrate(slider, fine);
    const Forces many = forces(slider, fine, r);
    const double found = peak_force(slider, record_a(), integrate(slider, record_a())).force;
    double largest = 0;
    for (std::size_t i = 0; i < many.friction.size(); ++i) largest = std::max(largest, std::abs(many.total(i)));
    CHECK(peak_force(slider, fine, r).force == Approx(found).epsilon(accuracy));
    CHECK(found >= largest * (1 - accuracy));
    CHECK(found <= largest * (1 + missed));
  };
  for (const double wn : {0.0, 1.3, 9.0})
    for (const double c : {0.0, 0.4}) {
      check(Slider(Coulomb(1, 1.6), wn, c));
      check(Slider(Caster(1, 0.01), wn, c));
      check(Slider(VelocityDependent(0.6, 1.2, 5), wn, c));
    }
  for_each_law([&](const auto& example) {  // between samples static friction has a peak where the slider breaks away
    INFO(example.name);
    for (const double c : {0.0, 0.4}) check(Slider(example.law, 2, c), std::max(1e-9, 10 * example.accuracy), 0.05);
  });
}
