// The list of friction laws, with an example of each: what holds for all of them is tested over this list.
#pragma once

#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "stickslip/core.hpp"
#include "support/motions.hpp"

namespace test {

/// A law that is defined by numbers only, in units of `length` and `time`. A negative length mirrors it.
struct ByNumbers {
  static constexpr bool numeric = true;
  double length = 1, time = 1;
  double resist(double x, double speed, Direction) const {
    const double unit = std::abs(length);
    return 1.1 * (1 + 0.3 * std::tanh(20 * x / length)) * (0.6 + 0.4 / (1 + 8 * speed * time / unit)) * unit /
           (time * time);
  }
};

/// An example of a law, and what becomes of it when directions are exchanged, and when lengths are multiplied by
/// `length` and times by `time`.
template <class Law, class Mirror, class Scale>
struct Example {
  const char* name;
  Law law;
  Mirror mirror;
  Scale scale;
  double accuracy;  ///< of a motion, relative to its largest displacement, as documented
};
template <class Law, class Mirror, class Scale>
Example(const char*, Law, Mirror, Scale, double) -> Example<Law, Mirror, Scale>;

inline const auto same = [](const auto& law) { return law; };

/// All laws. What friction is multiplied by, in the scaled world, is length / time^2.
inline auto all_laws() {
  const auto force = [](double length, double time) { return length / (time * time); };
  KumarFriction::Parameters liner;
  liner.mu_ref = 0.06;
  liner.static_pressure = 30e6;
  liner.reference_pressure = 40e6;
  liner.contact_radius = 0.1;
  return std::tuple{
      Example{"Coulomb", Coulomb(1, 0.7), [](const Coulomb& c) { return Coulomb(c.backward(), c.forward()); },
              [=](const Coulomb& c, double l, double t) {
                return Coulomb(c.forward() * force(l, t), c.backward() * force(l, t));
              },
              1e-12},
      Example{"StaticKinetic", StaticKinetic(Coulomb(1), 1.4), same,
              [=](const StaticKinetic<Coulomb>& s, double l, double t) {
                return StaticKinetic(Coulomb(s.sliding().forward() * force(l, t)), s.static_forward() * force(l, t));
              },
              1e-12},
      Example{"Caster", Caster(1.2, 0.05), same,
              [=](const Caster& c, double l, double t) { return Caster(c.slip_level() * force(l, t), c.reach() * l); },
              1e-11},
      Example{"VelocityDependent", VelocityDependent(0.6, 1.2, 20), same,
              [=](const VelocityDependent&, double l, double t) {
                return VelocityDependent(0.6 * force(l, t), 1.2 * force(l, t), 20 * t / l);
              },
              1e-11},
      Example{"Stribeck", Stribeck(1.3, 0.8, 0.1, 2), same,
              [=](const Stribeck&, double l, double t) {
                return Stribeck(1.3 * force(l, t), 0.8 * force(l, t), 0.1 * l / t, 2);
              },
              1e-11},
      Example{"Degrading", Degrading({0, 0.02, 0.3}, {1.3, 0.9, 0.5}), same,
              [=](const Degrading&, double l, double t) {
                const double f = force(l, t);
                return Degrading({0, 0.02 * l, 0.3 * l}, {1.3 * f, 0.9 * f, 0.5 * f});
              },
              1e-11},
      Example{"MultiPendulum", MultiPendulum({1.5, 3}, {0.05, 0.12}, {0.3, 0.3}), same,
              [=](const MultiPendulum&, double l, double t) {
                const double f = force(l, t);
                return MultiPendulum({1.5 * t * t, 3 * t * t}, {0.05 * f, 0.12 * f}, {0.3 * l, 0.3 * l});
              },
              1e-11},
      Example{"a user's law", Bump{1.2, 0.1}, same,
              [=](const Bump& b, double l, double t) {
                return Bump{b.slip_level * force(l, t), b.reach * l};
              },
              1e-11},
      Example{"a law by numbers", ByNumbers{},
              [](const ByNumbers&) {
                return ByNumbers{-1, 1};
              },
              [](const ByNumbers&, double l, double t) {
                return ByNumbers{l, t};
              },
              1e-8},
      Example{"KumarFriction", KumarFriction(liner), same, nullptr, 1e-6},  // heat has its own scales
  };
}

/// A mounting as a law takes it: a MultiPendulum is a pendulum itself, on level ground, and slides both ways.
template <class Law>
Mounting taken_by(const Law&, Mounting mounting) {
  if constexpr (std::same_as<Law, MultiPendulum>) {
    mounting.slope_degrees = 0;
    mounting.one_way = mounting.pendulum = false;
  }
  return mounting;
}

/// Call `work(example)` for each law.
template <class Work>
void for_each_law(Work&& work) {
  std::apply([&](const auto&... examples) { (work(examples), ...); }, all_laws());
}

}  // namespace test
