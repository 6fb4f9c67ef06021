// Friction that depends on the distance slid: closed forms, energy, an independent integration, splitting a run.
#include "stickslip/friction/degrading.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "stickslip/core.hpp"
#include "stickslip/ensemble/ensemble.hpp"
#include "stickslip/ensemble/one_of.hpp"
#include "stickslip/ensemble/run.hpp"
#include "stickslip/sliding/effective.hpp"
#include "stickslip/sliding/floor_motion.hpp"
#include "stickslip/sliding/forces.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;

static_assert(MemoryLaw<Degrading> && FrictionLaw<Degrading> && !MemorylessLaw<Degrading>);
static_assert(form_of<Degrading::Piece> == Form::linear && form_of<Coulomb> != Form::linear &&
              form_of<Degrading> != Form::constant);
static_assert(MemoryLaw<StaticKinetic<Degrading>> && LawWithHold<StaticKinetic<Degrading>>);

namespace {

const Degrading weakening({0, 0.3, 2}, {1, 0.4, 0.5}), hardening({0.1, 0.5}, {0.5, 1.3});

/// The resistance after a distance [m/s^2], and its integral: by the definition.
double level_after(const Degrading& law, double slid) {
  const auto &s = law.distances(), &a = law.levels();
  std::size_t i = 0;
  while (i < s.size() && slid > s[i]) ++i;
  if (i == 0) return a.front();
  if (i == s.size()) return a.back();
  return std::lerp(a[i - 1], a[i], (slid - s[i - 1]) / (s[i] - s[i - 1]));
}

/// x'' = p - s w a(slid) - c v - k x with straight p and w, step by step by the rule of Runge and Kutta of the fourth
/// order, each cut where the velocity or the distance to a knot comes to zero, by bisection; with a stick by the
/// definition. It shares no line with the library.
class RungeKutta {
 public:
  RungeKutta(const Degrading& law, double stiffness, double damping, bool one_way = false)
      : law_(law), k_(stiffness), c_(damping), one_way_(one_way) {}

  double x = 0, v = 0, slid = 0;
  int direction = 0;

  void segment(double duration, double p0, double p1, double w0, double w1, int parts) {
    const auto p = [&](double t) { return p0 + (p1 - p0) * (t / duration); };
    const auto w = [&](double t) { return w0 + (w1 - w0) * (t / duration); };
    const double h = duration / parts;
    double now = 0;
    while (now < duration) {
      const double end = std::min(duration, (std::floor(now / h * (1 + 1e-12)) + 1) * h);
      if (direction == 0) {
        // Within a part both margins are straight: the first zero by bisection.
        const double level = level_after(law_, slid);
        const auto beyond = [&](double t) {
          const double net = p(t) - k_ * x;
          return std::max(net, one_way_ ? net : -net) - level * w(t);
        };
        if (beyond(now) > 0 || beyond(end) > 0) {
          double low = now, high = end;
          if (beyond(now) > 0) high = now;
          while (low < high) {
            const double middle = low + (high - low) / 2;
            if (!(low < middle && middle < high)) break;
            (beyond(middle) > 0 ? high : low) = middle;
          }
          now = high;
          direction = p(now) - k_ * x > 0 ? 1 : -1;
        } else {
          now = end;
        }
        continue;
      }
      // Within one piece of the law, which goes on beyond its knot for the sake of bisection.
      const auto& knots = law_.distances();
      const auto above = std::upper_bound(knots.begin(), knots.end(), slid);
      const double next = above == knots.end() ? infinity : *above;
      const double a0 = level_after(law_, slid);
      double slope = 0;
      if (above != knots.end() && above != knots.begin()) {
        const auto i = static_cast<std::size_t>(above - knots.begin());
        slope = (law_.levels()[i] - law_.levels()[i - 1]) / (knots[i] - knots[i - 1]);
      }
      const double x0 = x, v0 = v, from = now;
      const auto acceleration = [&](double t, double at, double speed) {
        const double level = a0 + slope * (direction * (at - x0));
        return p(t) - direction * w(t) * level - c_ * speed - k_ * at;
      };
      const auto go = [&](double dt) {
        const double k1 = acceleration(from, x0, v0);
        const double k2 = acceleration(from + dt / 2, x0 + dt / 2 * v0, v0 + dt / 2 * k1);
        const double k3 = acceleration(from + dt / 2, x0 + dt / 2 * v0 + dt * dt / 4 * k1, v0 + dt / 2 * k2);
        const double k4 = acceleration(from + dt, x0 + dt * v0 + dt * dt / 2 * k2, v0 + dt * k3);
        x = x0 + dt * v0 + dt * dt / 6 * (k1 + k2 + k3);
        v = v0 + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      };
      const auto over = [&](double dt) {
        go(dt);
        return direction * v <= 0 || slid + direction * (x - x0) >= next;
      };
      double low = 0, high = end - now;
      const bool cut = over(high) && high > 1e-9 * h;
      if (cut) {
        for (int i = 0; i < 60; ++i) {
          const double middle = low + (high - low) / 2;
          (over(middle) ? high : low) = middle;
        }
        go(high);
      }
      now += high;
      if (!cut) now = end;
      slid += direction * (x - x0);
      if (slid >= next * (1 - 1e-15)) slid = next;
      if (direction * v <= 1e-13) v = 0, direction = 0;
    }
  }

 private:
  const Degrading& law_;
  double k_, c_;
  bool one_way_;
};

}  // namespace

TEST_CASE("a slide under a constant load grows or swings by its closed form", "[degrading]") {
  // x'' = p - a - k x from speed u within one piece.
  const double u = 0.3, t = 0.4;
  for (const double p : {0.0, 1.2, 3.0}) {
    State falls = State::at(0, u), rises = State::at(0, u);
    advance(Slider(Degrading({0, 10}, {1.1, 0})), Segment{t, -p, -p}, falls);
    advance(Slider(Degrading({0, 10}, {0.1, 40.1})), Segment{t, -p, -p}, rises);
    CAPTURE(p);
    if (u > 1.1 * t || p > 1.1) {
      const double r = std::sqrt(0.11);
      CHECK(std::abs(falls.displacement -
                     (u / r * std::sinh(r * t) + 2 * (p - 1.1) / 0.11 * std::pow(std::sinh(r * t / 2), 2))) <= 1e-15);
      CHECK(std::abs(falls.velocity - (u * std::cosh(r * t) + (p - 1.1) / r * std::sinh(r * t))) <= 2e-15);
      CHECK(falls.sliding_distance == falls.displacement);
    }
    // It stops where tan(2 t) = -2 u / (p - a), t <= pi / 2 with p > a, and stays there while p <= a + k x.
    const double when = p > 0.1 ? 3.141592653589793 / 2 - std::atan(2 * u / (p - 0.1)) / 2 : std::atan(2 * u / 0.1) / 2;
    const auto at = [&](double time) { return u / 2 * std::sin(2 * time) + (p - 0.1) / 4 * (1 - std::cos(2 * time)); };
    CHECK(std::abs(rises.displacement - at(std::min(t, when))) <= 1e-15);
  }
  // From rest under a load that grows at the rate j through the level, which falls by 4 a meter: x = j (sinh(2 t) -
  // 2 t) / 8.
  State state;
  advance(Slider(Degrading({0, 0.2}, {1, 0.2})), Segment{1.5, 0, -1.5}, state);
  CHECK(std::abs(state.displacement - (std::sinh(1.0) - 1) / 8) <= 1e-15);
}

TEST_CASE("without a load it slides until friction's work is the energy it began with", "[degrading]") {
  // The work is the integral of a(s), whatever the knots.
  const auto stop = [](const Degrading& law, double u, double slid = 0) {
    return integrate(law, line(0, 0, 100), [&] {
      IntegrateOptions options = from(0, u);
      options.sliding_distance = slid;
      return options;
    }());
  };
  const auto energy = [](const Degrading& law, double slid, double to) {
    double sum = 0, at = slid;
    std::vector<double> ends = law.distances();
    ends.push_back(to);
    std::ranges::sort(ends);
    for (const double end : ends)
      if (end > at && end <= to) {
        sum += (level_after(law, at) + level_after(law, end)) / 2 * (end - at);
        at = end;
      }
    return sum;
  };
  const Degrading sudden({0.1, 0.1 + 1e-9, 0.2, 0.3}, {0.8, 0.3, 0.3, 2.5});
  for (const Degrading* law : {&weakening, &hardening, &sudden})
    for (const double slid : {0.0, 0.05, 0.1})
      for (const double way : {0.01, 0.25, 0.7, 3.0}) {
        CAPTURE(law->distances().size(), slid, way);
        const Response r = stop(*law, std::sqrt(2 * energy(*law, slid, slid + way)), slid);
        // The stop's place is as sure as the energy over the level.
        CHECK(std::abs(r.residual - way) <= 1e-14 * (1 + way) / 0.3);
        CHECK(r.state.mode == Mode::stuck);
        CHECK(std::abs(r.state.sliding_distance - slid - way) <= 1e-14 * (1 + way) / 0.3);
        CHECK(std::abs(r.energy.dissipated - energy(*law, slid, slid + way)) <= 1e-14 * (1 + r.energy.initial));
      }
}

TEST_CASE("a level that stays the same is Coulomb's, with any mounting", "[degrading]") {
  const GroundMotion motion = record_a();
  std::vector<double> up(motion.samples());
  for (std::size_t i = 0; i < up.size(); ++i) up[i] = 2.5 * std::cos(0.5 * static_cast<double>(i) + 0.2);
  const GroundMotion shaken = motion.with_components({}, up);
  const Degrading flat({0.1, 0.7}, {1, 1});
  const auto same = [&](const Mounting& mounting, double tolerance = 1e-12) {
    for (const GroundMotion* m : {&motion, &shaken}) {
      const Response one = integrate(Slider(flat, mounting), *m), other = integrate(Slider(Coulomb(1), mounting), *m);
      CHECK(difference(one.displacement, other.displacement) <= tolerance * other.peak);
      CHECK(std::abs(one.peak - other.peak) <= tolerance * other.peak);
      CHECK(std::abs(one.energy.dissipated - other.energy.dissipated) <= 1e-12 * other.energy.dissipated);
      CHECK(count(one.events) == count(other.events));
    }
  };
  same({});
  same({.natural_frequency = 2});
  same({.natural_frequency = 2, .damping = 0.3});
  same({.damping = 0.3});
  same({.natural_frequency = 1.4, .pendulum = true});
  same({.slope_degrees = 4, .one_way = true});
  same({.stops = {0.02, 0.5}}, 1e-6);  // grazing impacts, see sliding/stops_test.cpp
  CHECK(integrate(StaticKinetic(flat, 1.3), motion).residual ==
        Approx(integrate(StaticKinetic(Coulomb(1), 1.3), motion).residual).epsilon(1e-12));
  // The same of a slope that is next to none.
  const Degrading nearly({0, 10}, {1, 1 + 1e-9});
  CHECK(difference(integrate(nearly, motion).displacement, integrate(Coulomb(1), motion).displacement) <= 1e-8);
}

TEST_CASE("degrading friction takes no side, scales, and closes its ledger", "[degrading]") {
  const GroundMotion motion = broadband(31, 1'000);
  std::vector<double> up = gaussian(7, 1'000, 3);
  const GroundMotion shaken = motion.with_components({}, up);
  for (const Degrading* law : {&weakening, &hardening})
    for (const double wn : {0.0, 2.5})
      for (const double c : {0.0, 0.4})
        for (const bool stops : {false, true}) {
          CAPTURE(wn, c, stops);
          Mounting mounting{.natural_frequency = wn, .damping = c};
          if (stops) mounting.stops = {0.3, 0.4};
          const Slider slider(*law, mounting);
          const Response r = integrate(slider, motion), mirrored = integrate(slider, motion.scaled(-1));
          CHECK(std::abs(r.energy.imbalance()) <= 1e-12 * turnover(r.energy));
          CHECK(r.residual == -mirrored.residual);
          CHECK(std::abs(r.state.sliding_distance - r.sliding_distance) <= 1e-12 * r.sliding_distance);
          if (!stops) CHECK(grammatical(r));
          CHECK(std::abs(integrate(slider, shaken).energy.imbalance()) <= 1e-12 * turnover(r.energy));
          if (stops) continue;
          // Lengths and accelerations four times as large.
          std::vector<double> distances = law->distances(), levels = law->levels();
          for (double& d : distances) d *= 4;
          for (double& a : levels) a *= 4;
          CHECK(integrate(Slider(Degrading(distances, levels), mounting), motion.scaled(4)).residual == 4 * r.residual);
        }
  // The two directions may differ; mirrored they change places.
  const Degrading unequal({0, 1}, {1, 0.4}, {1.5, 0.3}), swapped({0, 1}, {1.5, 0.3}, {1, 0.4});
  const Response r = integrate(unequal, motion);
  CHECK(r.residual == -integrate(swapped, motion.scaled(-1)).residual);
  CHECK(std::abs(r.energy.imbalance()) <= 1e-12 * turnover(r.energy));
}

TEST_CASE("sliders on degrading friction move as an independent integration does", "[degrading]") {
  // One step of h under x'' = -K x + ... is off by at most (K h^2)^2 (|v| h + |a| h^2) / 120 or so: 1e-14 m for K <= 8
  // and h = 0.1 s / 128, in 51,200 steps 5e-10 at most if all of them pointed one way. Weakening lets a difference grow
  // by exp(sqrt(2) T) in a slip of T, a second at most; within it nearly all steps are far smaller.
  const GroundMotion motion = record_a();
  std::vector<double> up(motion.samples());
  for (std::size_t i = 0; i < up.size(); ++i) up[i] = 2.5 * std::cos(0.5 * static_cast<double>(i) + 0.2);
  const GroundMotion shaken = motion.with_components({}, up);
  for (const Degrading* law : {&weakening, &hardening})
    for (const GroundMotion* m : {&motion, &shaken})
      for (const Mounting& mounting :
           {Mounting{}, Mounting{.natural_frequency = 2}, Mounting{.natural_frequency = 2, .damping = 0.3},
            Mounting{.damping = 0.5}, Mounting{.slope_degrees = 2, .one_way = true}}) {
        CAPTURE(law->levels()[0], m->has_vertical(), mounting.natural_frequency, mounting.damping, mounting.one_way);
        const Response r = integrate(Slider(*law, mounting), *m);
        const double slope = mounting.slope_degrees * 3.141592653589793 / 180, g = standard_gravity;
        RungeKutta other(*law, mounting.natural_frequency * mounting.natural_frequency, mounting.damping,
                         mounting.one_way);
        double largest = 0;
        for (std::size_t i = 0; i + 1 < m->samples(); ++i) {
          const auto vertical = [&](std::size_t k) { return g + (m->has_vertical() ? m->vertical()[k] : 0); };
          const auto load = [&](std::size_t k) {
            return vertical(k) * std::sin(slope) - m->acceleration()[k] * std::cos(slope);
          };
          const auto weight = [&](std::size_t k) {
            return (vertical(k) * std::cos(slope) + m->acceleration()[k] * std::sin(slope)) / g;
          };
          other.segment(0.1, load(i), load(i + 1), weight(i), weight(i + 1), 128);
          largest = std::max(largest, std::abs(other.x - r.displacement[i + 1]));
        }
        CHECK(largest <= 5e-10);
        CHECK(std::abs(other.slid - r.state.sliding_distance) <= 5e-10);
      }
}

TEST_CASE("closed form and power series agree on any knots, from 1e-9 m apart to a meter", "[degrading]") {
  // Stops far away take the way of power series. Two ways to the same motion: each of 80 segments and their events adds
  // some roundings, and weakening lets them grow.
  std::mt19937_64 bits(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int k = 0; k < 500; ++k) {
    std::vector<double> distances, levels;
    double slid = uniform(bits) < 0.5 ? 0 : uniform(bits);
    for (int knots = 1 + static_cast<int>(6 * uniform(bits)); knots > 0; --knots) {
      distances.push_back(slid);
      levels.push_back(uniform(bits) < 0.15 ? 0 : 1.5 * uniform(bits));
      slid += std::pow(10, -9 * uniform(bits) * uniform(bits));
    }
    Mounting mounting{.natural_frequency = uniform(bits) < 0.5 ? 5 * uniform(bits) : 0,
                      .damping = uniform(bits) < 0.4 ? 3 * uniform(bits) : 0};
    const GroundMotion motion = broadband(static_cast<std::uint64_t>(k), 80);
    const Degrading law(distances, levels);
    const Response one = integrate(Slider(law, mounting), motion);
    mounting.stops = {1e6, 0.5};
    const Response other = integrate(Slider(law, mounting), motion);
    CAPTURE(k, distances, levels, mounting.natural_frequency, mounting.damping);
    CHECK(difference(one.displacement, other.displacement) <= 1e-10 * one.peak);
    CHECK(std::abs(one.energy.imbalance()) <= 1e-12 * turnover(one.energy));
    CHECK(std::abs(other.energy.imbalance()) <= 1e-12 * turnover(other.energy));
  }
}

TEST_CASE("a run can be split anywhere: the state holds all that matters", "[degrading]") {
  const GroundMotion motion = broadband(8, 300);
  for (const Mounting& mounting : {Mounting{}, Mounting{.natural_frequency = 2, .damping = 0.3},
                                   Mounting{.slope_degrees = 2, .one_way = true}, Mounting{.stops = {0.2, 0.3}}}) {
    const Slider slider(weakening, mounting);
    const Response whole = integrate(slider, motion);
    // Step by step: but for round-off, as only a whole motion knows the springs on which its segments run.
    State state;
    bool same = true;
    const auto equals = [](double one, double other) { return std::abs(one - other) <= 1e-11 * (1 + std::abs(other)); };
    for (std::size_t i = 0; i < motion.segments(); ++i) {
      advance(slider, motion.segment(i), state);
      same = same && equals(state.displacement, whole.displacement[i + 1]) &&
             equals(state.velocity, whole.velocity[i + 1]);
    }
    CHECK(same);
    CHECK(state.mode == whole.state.mode);
    CHECK(equals(state.sliding_distance, whole.state.sliding_distance));
    // Cut within its segments: but for round-off, of which weakening makes more.
    State cut;
    for (std::size_t i = 0; i < motion.segments(); ++i) {
      Segment s = motion.segment(i);
      for (const double part : {0.3, 0.7}) {
        const double middle = std::lerp(s.start, s.end, part);
        advance(slider, Segment{s.duration * part, s.start, middle}, cut);
        s = {s.duration * (1 - part), middle, s.end};
      }
      advance(slider, s, cut);
    }
    CHECK(std::abs(cut.displacement - state.displacement) <= (mounting.stops ? 1e-6 : 1e-10) * whole.peak);
    // Resumed half way, by `integrate`.
    const std::vector<double> n(motion.acceleration().begin(), motion.acceleration().end());
    const Response first = integrate(slider, GroundMotion(std::vector<double>(n.begin(), n.begin() + 151), 0.1));
    IntegrateOptions options = from(first.state.displacement, first.state.velocity);
    options.sliding_distance = first.state.sliding_distance;
    const Response second =
        integrate(slider, GroundMotion(std::vector<double>(n.begin() + 150, n.end()), 0.1), options);
    CHECK(second.residual == whole.residual);
    CHECK(second.state.sliding_distance == whole.state.sliding_distance);
  }
}

TEST_CASE("a one-way block slides between those of its highest and its lowest level", "[degrading]") {
  // v' = p - a(s) with v >= 0: the lower the level, the faster at all times.
  const GroundMotion motion = broadband(3, 500);
  const Mounting newmark{.slope_degrees = 3, .one_way = true};
  const auto slides = [&](const auto& law) { return integrate(Slider(law, newmark), motion).residual; };
  double before = slides(Coulomb(1));
  for (const double last : {0.95, 0.9, 0.8, 0.6}) {
    const double degrading = slides(Degrading({0, 0.5}, {1, last}));
    CHECK(degrading > before);
    CHECK(degrading < slides(Coulomb(last)));
    CHECK(degrading < slides(Degrading({0, 0.25}, {1, last})));
    before = degrading;
  }
}

TEST_CASE("it sticks at the level that it has come to", "[degrading]") {
  // Slides 0.3 m to the level 0.4, where a load of 0.39 holds and one of 0.41 does not.
  IntegrateOptions options = from(0, 0);
  options.sliding_distance = 0.3;
  CHECK(integrate(weakening, held(0.39, 1), options).sliding_distance == 0);
  CHECK(integrate(weakening, held(0.41, 1), options).sliding_distance > 0);
  CHECK(integrate(weakening, held(0.99, 1)).sliding_distance == 0);
  // A static level above it stays.
  CHECK(integrate(StaticKinetic(weakening, 1.3), held(1.29, 1), options).sliding_distance == 0);
  CHECK(integrate(StaticKinetic(weakening, 1.3), held(1.31, 1), options).sliding_distance > 0);
}

TEST_CASE("under a harmonic motion degrading friction closes its ledger, too", "[degrading]") {
  const HarmonicMotion motion(3, 4, 20, 0.01);
  for (const double wn : {0.0, 2.0}) {
    const Response r = integrate(Slider(weakening, wn), motion);
    CHECK(std::abs(r.energy.imbalance()) <= 1e-12 * turnover(r.energy));
    // Straight lines between samples of a cosine are off by B (omega h)^2 / 8 = 6e-4 of it, so is the way.
    std::vector<double> n(motion.samples());
    for (std::size_t i = 0; i < n.size(); ++i) n[i] = motion.acceleration(motion.time(i));
    const Response sampled = integrate(Slider(weakening, wn), GroundMotion(n, 0.01));
    CHECK(std::abs(r.sliding_distance - sampled.sliding_distance) <= 6e-4 * r.sliding_distance);
  }
}

TEST_CASE("forces, loops and floor motions know how far the slider has slid", "[degrading]") {
  const GroundMotion motion = broadband(5, 200);
  const Slider slider(weakening, 2.0, 0.2);
  IntegrateOptions options = from(0, 0);
  options.sliding_distance = 0.05;
  const Response r = integrate(slider, motion, options);
  const Forces f = forces(slider, motion, r);
  State state;
  state.sliding_distance = 0.05;
  for (std::size_t i = 0; i < motion.segments(); ++i) {
    if (state.velocity != 0)
      CHECK(std::abs(std::abs(f.friction[i]) - level_after(weakening, state.sliding_distance)) <= 1e-13);
    else
      CHECK(std::abs(f.friction[i]) <= level_after(weakening, state.sliding_distance) + 1e-13);
    advance(slider, motion.segment(i), state);
  }
  // The floor's acceleration at the samples is -(friction + damper + spring).
  double time = 0;
  std::size_t i = 0;
  for (const Segment& s : floor_motion(slider, motion, r, 1e-4).segments) {
    if (std::abs(time - motion.time(i)) < 1e-9 && f.stuck[i] == 0 && r.velocity[i] != 0)
      CHECK(std::abs(s.start - f.acceleration(i)) <= 1e-12);
    time += s.duration;
    while (i + 1 < motion.samples() && motion.time(i) < time - 1e-9) ++i;
  }
  // F / D of the loop at the peak.
  const Loop loop = largest_loop(slider, motion, r);
  CHECK(loop.displacement == r.peak);
  double slid = 0.05, x = 0;
  for (const Event& e : r.events) {
    slid += std::abs(e.displacement - x);
    x = e.displacement;
    if (std::abs(x) == r.peak) break;
  }
  CHECK(std::abs(loop.force - 4 * r.peak - level_after(weakening, slid)) <= 1e-12);
}

TEST_CASE("members on degrading friction go one by one, as by integrate", "[degrading][ensemble]") {
  std::vector<GroundMotion> motions;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) motions.push_back(broadband(seed, 100));
  const Slider slider(weakening, 1.5);
  EnsembleOptions options;
  options.members = 5;
  options.dt = 0.1;
  const Ensemble e = run_ensemble(slider, OneOf(motions, Order::in_turn), options);
  double sum = 0;
  for (const GroundMotion& motion : motions) sum += integrate(slider, motion).displacement[99] / 5;
  CHECK(std::abs(e.displacement_mean().value[99] - sum) <= 1e-14);
}

TEST_CASE("degrading friction that cannot be is refused", "[degrading][errors]") {
  CHECK_THROWS_WITH(Degrading({}, {}), "Degrading: distance must hold at least one, got 0");
  CHECK_THROWS_WITH(Degrading({0, 1}, {1}), "Degrading: levels must be as many as distances, 2, got 1");
  CHECK_THROWS_WITH(Degrading({0, 1}, {1, 1}, {1}), "Degrading: backward must be as many as distances, 2, got 1");
  CHECK_THROWS_WITH(Degrading({-1, 1}, {1, 1}), "Degrading: distance[0] must be finite and at least 0, got -1 m");
  CHECK_THROWS_WITH(Degrading({1, 1}, {1, 1}), "Degrading: distance[1] must be above the one before, 1 m, got 1 m");
  CHECK_THROWS_WITH(Degrading({0, 1}, {1, -0.5}), "Degrading: levels[1] must be finite and at least 0, got -0.5 m/s^2");
  CHECK_THROWS_AS(Degrading({0, 1}, {1, 1}, {1, infinity}), std::invalid_argument);
  CHECK_THROWS_AS(Degrading({0, not_a_number}, {1, 1}), std::invalid_argument);
  CHECK_THROWS_WITH(StaticKinetic(weakening, 0.9),
                    Catch::Matchers::ContainsSubstring("at least the kinetic one of 1 m/s^2, got 0.9"));
  CHECK_THROWS_WITH(Slider(Degrading({0, 1}, {0.1, 1}), Mounting{.slope_degrees = 2}),
                    Catch::Matchers::ContainsSubstring("it slides under its own weight"));
  State state;
  state.sliding_distance = -1;
  CHECK_THROWS_WITH(advance(Slider(weakening), Segment{1, 0, 0}, state),
                    "advance: sliding_distance must be finite and at least 0, got -1 m");
  IntegrateOptions options;
  options.sliding_distance = not_a_number;
  CHECK_THROWS_AS(integrate(weakening, record_a(), options), std::invalid_argument);
}
