// The library against an independent integrator, on random problems.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "stickslip/core.hpp"
#include "stickslip/planar/integrate.hpp"
#include "support/catch.hpp"
#include "support/independent_plane.hpp"
#include "support/size.hpp"

using namespace stickslip;
using namespace test;

namespace {

using Real = IndependentPlane::Real;

class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(bits_() >> 11) * 0x1p-53);
  }
  double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  bool chance(double part) { return uniform(0, 1) < part; }
  Vector2 within(double size) { return {uniform(-size, size), uniform(-size, size)}; }

 private:
  std::mt19937_64 bits_;
};

// A few segments on a mounting, in which loads, weights, springs, dampers and stops matter.
struct Problem {
  Mounting mounting;
  std::vector<PlanarLoadSegment> segments;
  Vector2 displacement, velocity;
  Contact contact = Contact::flight;
  double level, load, duration = 0;  // scales
};

Problem problem(Random& random, bool stops) {
  Problem p;
  p.level = random.log_uniform(0.02, 0.5) * standard_gravity;
  p.load = p.level * random.log_uniform(0.3, 6);
  const int segments = 1 + static_cast<int>(random.uniform(0, 4));
  const double step = random.log_uniform(0.005, 0.3);
  const bool held = random.chance(0.2), vertical = random.chance(0.35), collinear = random.chance(0.05);
  const double angle = random.uniform(0, 7), up = random.log_uniform(0.3, stops ? 15 : 3);
  const auto draw = [&] {
    if (!collinear) return random.within(p.load);
    return random.uniform(-p.load, p.load) * Vector2{std::cos(angle), std::sin(angle)};
  };
  Vector2 load = draw();
  double normal = standard_gravity;
  for (int i = 0; i < segments; ++i) {
    PlanarLoadSegment s{step * (random.chance(0.2) ? random.uniform(0.1, 3) : 1), load, {}, normal, normal};
    s.load_end = held ? load : draw();
    if (vertical) s.normal_end = normal = standard_gravity + random.uniform(-up, up);
    load = held || random.chance(0.2) ? draw() : s.load_end;
    p.segments.push_back(s);
    p.duration += s.duration;
  }
  const double way = p.load * p.duration * p.duration;
  if (random.chance(0.5)) p.mounting.natural_frequency = random.log_uniform(0.1, 10) / (2 * p.duration);
  p.mounting.pendulum = p.mounting.natural_frequency > 0 && random.chance(0.3);
  if (random.chance(0.3)) p.mounting.damping = random.log_uniform(0.01, 3) / p.duration;
  if (random.chance(0.5)) p.velocity = random.within(p.load * p.duration * random.log_uniform(1e-3, 1));
  if (random.chance(0.5)) p.displacement = random.within(way * random.log_uniform(1e-3, 0.3));
  if (stops)
    p.mounting.stops =
        Stops(std::max(norm(p.displacement) * random.uniform(1.01, 2), way * random.log_uniform(1e-3, 0.3)),
              random.chance(0.3) ? 0.0 : random.uniform(0, 0.9));
  if (random.chance(0.2)) p.contact = Contact::clipped;
  return p;
}

// The sums of a motion.
struct Sums {
  double peak = 0, path = 0, input = 0, dissipated = 0, damped = 0, lost = 0;

  void event(EventKind, double, const PlanarState&) {}
  void dissipate(double work) { dissipated += work; }
  void lose(double energy) { lost += energy; }
  template <class Flow>
  void follow(const Flow& flow, double last, double) {
    const auto work = detail::work(flow, last);
    input += work.load, dissipated += work.friction, damped += work.damper;
    path += flow.at_parameter(last).distance;
    double where = 0;
    peak = std::max(peak, detail::largest_radius(flow, last, peak, where));
  }
};

struct Tally {
  int compared = 0, too_long = 0;
};

template <class Law>
void compare(const Problem& p, const Law& law, IndependentPlane::Level level, Tally& tally) {
  const PlanarSlider slider(law, p.mounting);
  PlanarState state = PlanarState::at(p.displacement, p.velocity);
  Sums sums;
  sums.peak = norm(p.displacement);
  const auto stored = [&] {
    return dot(state.velocity, state.velocity) / 2 +
           p.mounting.stiffness() * dot(state.displacement, state.displacement) / 2;
  };
  const double gap = p.mounting.stops.forward(), before = stored();
  for (const PlanarLoadSegment& segment : p.segments) {
    advance(slider, segment, state, sums, p.contact);
    CHECK(norm(state.displacement) <= gap * (1 + 1e-14));
  }
  const double fast = p.load * p.duration + norm(p.velocity), least = 1e-4 * fast;
  const double energy = std::max({before, stored(), sums.dissipated, std::abs(sums.input), least * least});
  CHECK(std::abs(before + sums.input - sums.dissipated - sums.damped - sums.lost - stored()) <= 1e-12 * energy);

  IndependentPlane other(std::move(level), {.natural_frequency = p.mounting.natural_frequency,
                                            .damping = p.mounting.damping,
                                            .pendulum = p.mounting.pendulum,
                                            .gap = gap,
                                            .restitution = p.mounting.stops ? p.mounting.stops.restitution() : 0,
                                            .flight = p.contact == Contact::flight});
  other.begin(p.displacement.axis, p.displacement.transverse, p.velocity.axis, p.velocity.transverse);
  other.max_steps = 500;
  try {
    for (const PlanarLoadSegment& s : p.segments)
      other.advance({s.duration,
                     {s.load_start.axis, s.load_start.transverse},
                     {s.load_end.axis, s.load_end.transverse},
                     s.normal_start,
                     s.normal_end});
  } catch (const IndependentPlane::TooLong&) {
    ++tally.too_long;
    return;
  }
  ++tally.compared;
  const double accuracy = 1e-11, size = std::max({static_cast<double>(other.peak), sums.path, least * p.duration});
  const auto away = [](Real x, Real y, Vector2 v) { return std::hypot(x - Real(v.axis), y - Real(v.transverse)); };
  CHECK(away(other.x, other.y, state.displacement) <= accuracy * size);
  CHECK(away(other.vx, other.vy, state.velocity) <= accuracy * fast);
  CHECK(std::abs(other.peak - Real(sums.peak)) <= accuracy * size);
  CHECK(std::abs(other.path - Real(sums.path)) <= accuracy * size);
  CHECK(std::abs(other.dissipated - Real(sums.dissipated)) <= accuracy * energy);
  CHECK(std::abs(other.damped - Real(sums.damped)) <= accuracy * energy);
  CHECK(std::abs(other.lost - Real(sums.lost)) <= accuracy * energy);
}

// The law of a given index, in the scales of the problem.
void compare(const Problem& p, int law, Random& random, Tally& tally) {
  const Real a = p.level;
  const double fast = p.load * p.duration;
  if (law == 0) {
    compare(p, Coulomb(p.level), {[=](std::size_t, Real, Real) { return a; }, [=](Real) { return a; }}, tally);
  } else if (law == 1) {
    const double holds = p.level * random.uniform(1, 2);
    compare(p, StaticKinetic(Coulomb(p.level), holds),
            {[=](std::size_t, Real, Real) { return a; }, [=](Real) { return Real(holds); }}, tally);
  } else if (law == 2) {
    const double most = p.level * random.uniform(1, 3), rate = random.log_uniform(0.1, 20) / fast;
    compare(
        p, VelocityDependent(p.level, most, rate),
        {[=](std::size_t, Real, Real u) { return most - (most - a) * std::exp(-rate * u); }, [=](Real) { return a; }},
        tally);
  } else if (law == 3) {
    const double holds = p.level * random.uniform(1, 2), speed = fast * random.log_uniform(0.05, 1);
    const int exponent = 1 + static_cast<int>(random.uniform(0, 3));
    compare(
        p, Stribeck(holds, p.level, speed, exponent),
        {[=](std::size_t, Real, Real u) { return a + (holds - a) * std::exp(-std::pow(u / speed, Real(exponent))); },
         [=](Real) { return Real(holds); }},
        tally);
  } else {
    std::vector<double> distances, levels;
    double at = 0;
    for (int i = 0; i < 3; ++i) {
      distances.push_back(at), levels.push_back(p.level * random.uniform(0.4, 1.5));
      at += fast * p.duration * random.log_uniform(1e-3, 0.3);
    }
    const auto line = [=](std::size_t piece, Real path) -> Real {
      if (piece == 0) return levels.front();
      if (piece >= levels.size()) return levels.back();
      const Real part = (path - distances[piece - 1]) / (Real(distances[piece]) - distances[piece - 1]);
      return levels[piece - 1] + (Real(levels[piece]) - levels[piece - 1]) * part;
    };
    IndependentPlane::Level level;
    level.resist = [=](std::size_t piece, Real path, Real) { return line(piece, path); };
    level.hold = [=](Real path) {
      std::size_t piece = 0;
      while (piece < distances.size() && path >= distances[piece]) ++piece;
      return line(piece, path);
    };
    level.knots.assign(distances.begin(), distances.end());
    compare(p, Degrading(distances, levels), level, tally);
  }
}

}  // namespace

TEST_CASE("random problems in the plane agree with an independent integrator", "[planar]") {
  const bool stops = GENERATE(false, true);
  Tally tally;
  for (int law = 0; law < 5; ++law) {
    for (int i = 0; i < size(5, 2); ++i) {
      const std::uint64_t seed = 1000 * static_cast<std::uint64_t>(law) + static_cast<std::uint64_t>(i);
      INFO("law " << law << ", problem " << i << (stops ? ", with a stop" : ""));
      Random random(seed);
      const Problem p = problem(random, stops);
      compare(p, law, random, tally);
    }
  }
  CHECK(tally.compared > tally.too_long);
}
