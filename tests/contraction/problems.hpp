// Random sliders under random ground, the same ones in every program that includes this.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <numbers>
#include <utility>
#include <vector>

#include "stickslip/core.hpp"

namespace contraction {

using namespace stickslip;

/// SplitMix64 (Steele, Lea & Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 0x2545F4914F6CDD1D) {}

  std::uint64_t bits() {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
    return z ^ (z >> 31);
  }
  double uniform(double low, double high) { return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1p-53); }
  double normal(double deviation) {
    const double radius = std::sqrt(-2 * std::log(1 - uniform(0, 1)));
    return deviation * radius * std::cos(2 * std::numbers::pi * uniform(0, 1));
  }
  bool chance(double probability) { return uniform(0, 1) < probability; }
  std::size_t below(std::size_t count) { return bits() % count; }
  double one_of(std::initializer_list<double> values) { return values.begin()[below(values.size())]; }

 private:
  std::uint64_t state_;
};

/// A law that is defined by numbers only.
struct ByNumbers {
  static constexpr bool numeric = true;
  double level;
  double resist(double x, double speed, Direction) const {
    return level * (1 + 0.3 * std::tanh(20 * x)) * (0.6 + 0.4 / (1 + 8 * speed));
  }
};

/// Ground acceleration along the axis, across it and upward [m/s^2]; `up` may be empty.
struct Ground {
  double dt;
  std::vector<double> along, across, up;

  double upward(std::size_t i) const { return up.empty() ? 0 : up[i]; }
  GroundMotion motion() const { return GroundMotion(along, dt).with_components(across, up); }
};

/// Half of all ground has round values: loads then equal levels, remain equal to them, and vanish with the weight.
inline Ground ground_of(Random& random, double level) {
  const std::size_t samples = 10 + random.below(30);
  const bool round = random.chance(0.5), vertical = random.chance(0.5);
  const double strength = random.one_of({0.5, 1.2, 3}) * level;
  const double upward = random.one_of({0.05, 1, 4, 9}) * (vertical ? 1 : 0);
  const auto component = [&](double deviation, double unit) {
    std::vector<double> values(samples);
    for (std::size_t i = 0; i < samples; ++i) {
      const double value = random.normal(deviation);
      values[i] = !round ? value : random.chance(0.3) && i > 0 ? values[i - 1] : unit * std::round(value / unit);
    }
    return values;
  };
  const double dt = random.one_of({0.01, 0.02, 0.1, 0.25, random.uniform(0.001, 0.5)});
  Ground ground{dt, component(strength, level / 2), component(strength, level / 2), {}};
  if (vertical) ground.up = component(upward, standard_gravity / 4);
  return ground;
}

inline Mounting mounting_of(Random& random, bool in_plane) {
  Mounting on;
  if (random.chance(0.6)) on.natural_frequency = random.one_of({2, random.uniform(0.3, 12)});
  if (random.chance(0.3)) on.damping = random.uniform(0, 2);
  const double gap = random.one_of({0.03, random.uniform(0.005, 0.2)});
  const double restitution =
      random.one_of({0, 0.5, 0.9, in_plane ? 0.7 : 1});  // without loss it bounces along a circle
  if (random.chance(0.3)) on.stops = Stops(gap, in_plane ? gap : random.one_of({gap, 2 * gap}), restitution);
  on.one_way = !in_plane && random.chance(0.1);
  on.pendulum = on.natural_frequency > 0 && random.chance(0.4);
  if (on.natural_frequency > 0 && random.chance(0.2)) on.slope_degrees = random.uniform(0, 8);
  return on;
}

inline KumarFriction liner(double level) {
  KumarFriction::Parameters of;
  of.mu_ref = level / standard_gravity;
  of.static_pressure = 30e6;
  of.reference_pressure = 40e6;
  of.contact_radius = 0.1;
  return KumarFriction(of);
}

/// Laws of both problems, with how well a motion is known, relative to its largest displacement.
template <class Use>
bool with_common_law(std::size_t which, Random& random, double level, Use&& use) {
  if (which == 0) return use(Coulomb(level), 1e-12), true;
  if (which == 1) return use(StaticKinetic(Coulomb(level), random.one_of({1, 1.5}) * level), 1e-12), true;
  if (which == 2)
    return use(Stribeck(level, 0.6 * level, random.uniform(0.02, 0.3), random.chance(0.5) ? 1 : 2), 1e-11), true;
  if (which == 3) return use(VelocityDependent(0.6 * level, level, random.uniform(2, 50)), 1e-11), true;
  if (which == 4)
    return use(Degrading({0, 0.01, 0.1}, {level, random.one_of({0.7, 1.2}) * level, 0.5 * level}), 1e-11), true;
  if (which == 5) return use(liner(level), 1e-6), true;
  return false;
}

/// A slider under its ground.
/// @tparam Of  a Slider or a PlanarSlider
template <class Of>
struct Problem {
  Of slider;
  Ground ground;
  Contact contact;
  double accuracy;  ///< of its displacement, relative to the largest
  bool symmetric;   ///< whether on mirrored ground it moves in mirror image
};

/// Calls `use` with a problem on one axis.
template <class Use>
void with_axis_problem(std::uint64_t number, Use&& use) {
  Random random(2 * number);
  const double level = random.one_of({1, 0.125, random.uniform(0.05, 4)});
  Mounting on = mounting_of(random, false);
  const Contact contact = random.chance(0.8) ? Contact::flight : Contact::clipped;
  const std::size_t which = random.below(10);
  const auto with = [&](auto law, double accuracy) {
    if constexpr (std::same_as<decltype(law), MultiPendulum>) {
      on.natural_frequency = on.slope_degrees = 0;
      on.one_way = on.pendulum = false;
      on.stops = {};
    }
    const bool even = on.stops.forward() <= on.stops.backward() && on.stops.backward() <= on.stops.forward();
    const bool symmetric = which < 6 && even && !on.one_way && !(on.slope_degrees > 0);
    use(Problem<Slider<decltype(law)>>{Slider(std::move(law), on), ground_of(random, level), contact, accuracy,
                                       symmetric});
  };
  if (with_common_law(which, random, level, with)) return;
  const double mu = level / standard_gravity;
  if (which == 6) return with(Coulomb(level, random.one_of({1, 1.5}) * level), 1e-12);
  if (which == 7) return with(Caster(level, random.uniform(0.02, 0.5), random.one_of({0, 0.1}) * level), 1e-11);
  if (which == 8) return with(MultiPendulum({1, 2.5}, {0.5 * mu, mu}, {0.2, 0.3}), 1e-11);
  with(ByNumbers{level}, 1e-8);
}

/// The same in the plane.
template <class Use>
void with_planar_problem(std::uint64_t number, Use&& use) {
  Random random(2 * number + 1);
  const double level = random.one_of({1, 0.125, random.uniform(0.05, 4)});
  const Mounting on = mounting_of(random, true);
  const Contact contact = random.chance(0.8) ? Contact::flight : Contact::clipped;
  const std::size_t which = random.below(random.chance(0.2) ? 6 : 5);  // heated laws take long
  with_common_law(which, random, level, [&](auto law, double accuracy) {
    use(Problem<PlanarSlider<decltype(law)>>{PlanarSlider(std::move(law), on), ground_of(random, level), contact,
                                             accuracy, !(on.slope_degrees > 0)});
  });
}

}  // namespace contraction
