#include "stickslip/sliding/floor_motion.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "stickslip/friction/velocity_dependent.hpp"
#include "stickslip/ground/response_spectrum.hpp"
#include "stickslip/sliding/integrate.hpp"
#include "stickslip/stickslip.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;

namespace {

// The integral of an acceleration, and its largest magnitude.
double impulse(const std::vector<Segment>& pieces) {
  double sum = 0;
  for (const Segment& s : pieces) sum += s.duration * (s.start + s.end) / 2;
  return sum;
}
double largest(const std::vector<Segment>& pieces) {
  double most = 0;
  for (const Segment& s : pieces) most = std::max({most, std::abs(s.start), std::abs(s.end)});
  return most;
}

double duration(const std::vector<Segment>& pieces) {
  double sum = 0;
  for (const Segment& s : pieces) sum += s.duration;
  return sum;
}

GroundMotion record(std::size_t samples = 300, double dt = 0.05) {
  std::vector<double> n = record_a_samples();
  n.resize(samples);
  return {n, dt};
}

template <class Law>
std::vector<Segment> floor_of(const Slider<Law>& slider, const GroundMotion& motion, double tolerance = 1e-6) {
  return floor_motion(slider, motion, integrate(slider, motion), tolerance).segments;
}

}  // namespace

TEST_CASE("a floor that never slips moves with the ground", "[floor_motion]") {
  const GroundMotion motion = record();
  const Slider slider(Coulomb(1e3), 2);
  const std::vector<Segment> pieces = floor_of(slider, motion);
  REQUIRE(pieces.size() == motion.segments());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    CHECK(pieces[i].duration == motion.dt());
    CHECK(pieces[i].start == motion.acceleration()[i]);
    CHECK(pieces[i].end == motion.acceleration()[i + 1]);
  }
  const std::vector<double> periods{0, 0.1, 0.5, 2}, damping{0.02, 0.05};
  CHECK(response_spectrum(pieces, periods, damping).values == response_spectrum(motion, periods, damping).values);
}

TEST_CASE("what accelerates a floor gives it the velocity that it has", "[floor_motion]") {
  // The integral of x'' + n is the velocity of the floor above that of its start.
  const GroundMotion motion = record();
  const auto check = [&](const auto& slider, double tolerance) {
    const Response r = integrate(slider, motion);
    REQUIRE(r.events.size() > 10);
    const std::vector<Segment> pieces = floor_motion(slider, motion, r).segments;
    const double gained = r.velocity.back() + impulse({[&] {
                            std::vector<Segment> ground;
                            for (std::size_t i = 0; i < motion.segments(); ++i) ground.push_back(motion.segment(i));
                            return ground;
                          }()});
    CHECK(duration(pieces) == Approx(motion.duration()).epsilon(1e-10));  // a sum of 10^4 to 10^5 roundings
    CHECK(std::abs(impulse(pieces) - gained) < tolerance * largest(pieces) * motion.duration());
  };
  for (const double c : {0.0, 0.4})
    for (const double wn : {0.0, 3.0}) {
      const double tolerance = c == 0 && wn == 0 ? 1e-14 : 1e-6;
      check(Slider(Coulomb(1), wn, c), tolerance);
      check(Slider(Coulomb(1, 1.6), wn, c), tolerance);
      check(Slider(Caster(1, 5), wn, c), 2e-6);
      check(Slider(VelocityDependent(0.6, 1.2, 5), wn, c), 2e-6);
    }
}

TEST_CASE("in every mounting the floor gains the velocity that its acceleration and impulses give it",
          "[floor_motion]") {
  // x'' + n cos(slope) - a_z sin(slope) integrates to the velocity along x, with the jumps at stops and landings.
  std::mt19937_64 bits(1);
  const auto random = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(bits); };
  double worst = 0;
  int impacts = 0, landings = 0, clipped = 0;
  const auto check = [&](const auto& slider, const GroundMotion& motion, const IntegrateOptions& options) {
    const Response r = integrate(slider, motion, options);
    const FloorMotion floor = floor_motion(slider, motion, r, 1e-7);
    double ground = 0;
    const bool linear = motion.interpolation() == Interpolation::linear;
    for (std::size_t i = 0; i < motion.segments(); ++i) {
      const Segment n = motion.segment(i);
      const double up = (motion.vertical()[i] + motion.vertical()[linear ? i + 1 : i]) / 2;
      ground += n.duration * ((n.start + n.end) / 2 * std::cos(slider.slope()) - up * std::sin(slider.slope()));
    }
    double jumps = 0;
    for (const Impulse& one : floor.impulses) jumps += one.velocity;
    const double gained = r.velocity.back() - r.velocity.front() + ground, scale = largest(floor.segments) + 1;
    worst = std::max(worst, std::abs(impulse(floor.segments) + jumps - gained) / (scale * motion.duration()));
    for (const Event& e : r.events) impacts += e.kind == EventKind::impact, landings += e.kind == EventKind::landing;
    clipped += options.contact == Contact::clipped;
  };
  for (int k = 0; k < 60; ++k) {
    std::vector<double> n, up;
    const double a = random(0.2, 1.2), b = random(0.3, 2), strong = random(1, 6), high = random(1, 16);
    for (int i = 0; i < 60; ++i) {
      n.push_back(strong * (std::sin(a * i) + 0.6 * std::sin(1.7 * b * i)));
      up.push_back(i < 58 ? high * std::cos(b * i) : 0);
    }
    const GroundMotion motion =
        GroundMotion(n, 0.05, k % 3 == 0 ? Interpolation::constant : Interpolation::linear).with_components({}, up);
    Mounting on;
    on.natural_frequency = k % 2 == 0 ? random(1, 8) : 0;
    on.damping = k % 5 < 2 ? random(0, 2) : 0;
    on.slope_degrees = k % 4 == 1 ? random(2, 15) : 0;
    on.one_way = k % 8 == 5;
    on.pendulum = k % 4 == 2;
    if (k % 3 != 1) on.stops = Stops(random(0.02, 0.2), random(0.02, 0.2), k % 9 == 0 ? 0 : random(0, 1));
    const IntegrateOptions options{.velocity = k % 6 == 0 ? 0.2 : 0,
                                   .settle = k % 7 < 3,
                                   .contact = k % 10 < 5 ? Contact::flight : Contact::clipped};
    const double level = random(0.5, 3) + (on.slope_degrees > 0 ? 3 : 0);
    check(Slider(Coulomb(level, random(0.5, 3)), on), motion, options);
    check(Slider(StaticKinetic(Coulomb(level), 1.3 * level), on), motion, options);
    check(Slider(Degrading({0, 0.3}, {level + 1, level}), on), motion, options);
  }
  CHECK(worst < 1e-7);  // chords of 1e-7 of the largest acceleration
  CHECK(impacts > 100);
  CHECK(landings > 100);
  CHECK(clipped > 50);
}

TEST_CASE("without vertical motion a pendulum is a floor on a spring", "[floor_motion]") {
  const GroundMotion motion = record();
  for (const double c : {0.0, 0.4}) {
    const auto spring = floor_of(Slider(Coulomb(1), 3, c), motion);
    const auto pendulum =
        floor_of(Slider(Coulomb(1), {.natural_frequency = 3, .damping = c, .pendulum = true}), motion);
    const std::vector<double> periods{0, 0.1, 0.5, 2};
    const auto one = response_spectrum(spring, periods).values, other = response_spectrum(pendulum, periods).values;
    for (std::size_t i = 0; i < one.size(); ++i) CHECK(other[i] == Approx(one[i]).epsilon(1e-9));
  }
}

TEST_CASE("an impulse sets an oscillator moving with its velocity", "[floor_motion]") {
  const std::vector<Segment> still{{0.5, 0, 0}, {0.25, 0, 0}, {0.25, 0, 0}};
  const double jump = 0.3;
  for (const std::size_t before : {0, 1, 2, 3})
    for (const double period : {0.03, 0.4, 5.0}) {
      const double wn = 2 * std::numbers::pi / period;
      const auto value = [&](double damping, SpectrumKind kind, const std::vector<Impulse>& impulses) {
        return response_spectrum(still, {period}, {damping}, kind, impulses).values[0];
      };
      const std::vector<Impulse> one{{before, jump}};
      CHECK(value(0, SpectrumKind::pseudo_acceleration, one) == Approx(wn * jump).epsilon(1e-12));
      CHECK(value(0.3, SpectrumKind::velocity, one) == Approx(jump).epsilon(1e-12));
      // damped: x = jump exp(-z wn t) sin(wd t) / wd, largest where tan(wd t) = wd / (z wn)
      const double z = 0.3, wd = wn * std::sqrt(1 - z * z), at = std::atan2(wd, z * wn) / wd;
      CHECK(value(z, SpectrumKind::displacement, one) ==
            Approx(jump * std::exp(-z * wn * at) * std::sin(wd * at) / wd).epsilon(1e-12));
      CHECK(value(z, SpectrumKind::displacement, {{before, jump}, {before, -jump}}) == 0);
    }
  // A block thrown against a stop 0.1 m away stays there: the floor loses 1 m/s, in one jump.
  const Slider block(Coulomb(0), {.stops = Stops(0.1, 0)});
  const GroundMotion motion = line(0, 0, 1);
  const FloorMotion floor = floor_motion(block, motion, integrate(block, motion, from(0, 1)));
  REQUIRE(floor.impulses.size() == 1);
  CHECK(floor.impulses[0].velocity == Approx(-1).epsilon(1e-14));
  CHECK(largest(floor.segments) == 0);
  const std::vector<Impulse> one{{0, jump}};
  CHECK_THROWS_WITH(response_spectrum(still, {0.0}, {0.05}, SpectrumKind::acceleration, one),
                    ContainsSubstring("give periods above 0"));
  CHECK(response_spectrum(still, {0.0}, {0.05}, SpectrumKind::displacement, one).values[0] == 0);
  CHECK_THROWS_WITH(response_spectrum(still, {1.0}, {0.05}, SpectrumKind::velocity, {{4, 1}}),
                    ContainsSubstring("impulses[0].before must be at most the number of segments, 3, got 4"));
  CHECK_THROWS_WITH(response_spectrum(still, {1.0}, {0.05}, SpectrumKind::velocity, {{0, NAN}}),
                    ContainsSubstring("impulses[0].velocity must be finite"));
}

TEST_CASE("a sliding floor shakes what stands on it no harder than its friction", "[floor_motion]") {
  const GroundMotion motion = record();
  const auto pieces = floor_of(Slider(Coulomb(0.7)), motion);
  for (const auto kind : {SpectrumKind::pseudo_acceleration, SpectrumKind::acceleration})
    CHECK(response_spectrum(pieces, {0.0}, {0.05}, kind).values[0] == Approx(0.7).epsilon(1e-13));
  // Twice the ground and twice the level: twice the floor.
  const auto twice = floor_of(Slider(Coulomb(1.4)), motion.scaled(2));
  REQUIRE(twice.size() == pieces.size());
  const std::vector<double> periods{0.05, 0.4, 3};
  const auto one = response_spectrum(pieces, periods), two = response_spectrum(twice, periods);
  for (std::size_t i = 0; i < periods.size(); ++i) CHECK(two.values[i] == Approx(2 * one.values[i]).epsilon(1e-12));
}

TEST_CASE("a floor spectrum is that of the acceleration that jumps", "[floor_motion]") {
  // A block is pushed at 4 for 0.3 s against a level of 1, and stops 0.9 s later: its acceleration is -1 for 1.2 s,
  // then 0.
  const GroundMotion push({-4, 0, 0}, std::vector<double>{0, 0.3, 2}, Interpolation::constant);
  const auto pieces = floor_of(Slider(Coulomb(1)), push);
  const GroundMotion same({-1, 0, 0}, std::vector<double>{0, 1.2, 2}, Interpolation::constant);
  for (const Segment& s : pieces) CHECK(s.start == s.end);
  for (const double period : {0.1, 1.0, 2.4, 7.0})
    for (const double damping : {0.0, 0.05, 0.7})
      CHECK(response_spectrum(pieces, {period}, {damping}).values[0] ==
            Approx(response_spectrum(same, {period}, {damping}).values[0]).epsilon(1e-13));
}

TEST_CASE("chords are as close to a curved acceleration as was asked", "[floor_motion]") {
  const GroundMotion motion = record();
  const double z = 0.05, bound = 1 / std::tanh(std::numbers::pi * z / (2 * std::sqrt(1 - z * z)));
  const std::vector<double> periods{0.1, 0.3, 1, 3};
  const auto check = [&](const auto& slider) {
    const auto finest = floor_of(slider, motion, 1e-9);
    const auto exact = response_spectrum(finest, periods, {z}).values;
    std::size_t pieces = finest.size();
    for (const double tolerance : {1e-6, 1e-4, 1e-2}) {
      const auto coarse = floor_of(slider, motion, tolerance);
      CHECK(coarse.size() < pieces);
      pieces = coarse.size();
      const auto values = response_spectrum(coarse, periods, {z}).values;
      for (std::size_t i = 0; i < periods.size(); ++i)
        CHECK(std::abs(values[i] - exact[i]) < bound * (tolerance + 1e-9) * largest(finest));
    }
  };
  check(Slider(Coulomb(1), 3));
  check(Slider(Coulomb(1), 3, 0.5));
  check(Slider(Caster(1, 2), 3));
}

TEST_CASE("between samples a floor follows the motion itself", "[floor_motion]") {
  // The same lines, sampled 16 times as often, have the same spectrum but for the chords of either: each at most
  // coth(pi z / (2 sqrt(1 - z^2))) = 12.7 times 1e-9 of the largest acceleration.
  const auto refined = [](std::size_t factor) {
    const std::vector<double> coarse = record_a_samples();
    std::vector<double> n;
    for (std::size_t k = 0; k < 100 * factor; ++k)
      n.push_back(std::lerp(coarse[k / factor], coarse[k / factor + 1],
                            static_cast<double>(k % factor) / static_cast<double>(factor)));
    return GroundMotion(n, 0.2 / static_cast<double>(factor));
  };
  const Slider slider(Caster(1, 1), 4);
  const auto once = floor_of(slider, refined(1), 1e-9), often = floor_of(slider, refined(16), 1e-9);
  const std::vector<double> periods{0.2, 0.5, 1.0};
  const auto one = response_spectrum(once, periods).values, other = response_spectrum(often, periods).values;
  for (std::size_t i = 0; i < periods.size(); ++i) CHECK(std::abs(one[i] - other[i]) < 2 * 12.7e-9 * largest(once));
}

TEST_CASE("under a harmonic motion the floor sticks to a cosine", "[floor_motion]") {
  const HarmonicMotion motion(0.8, 3, 10, 0.1);
  const Slider slider(Coulomb(1));
  const auto pieces = floor_motion(slider, motion, integrate(slider, motion)).segments;
  CHECK(largest(pieces) == Approx(0.8).epsilon(1e-12));
  double time = 0;
  for (const Segment& s : pieces) {
    CHECK(std::abs(s.start - motion.acceleration(time)) < 1e-10);  // time is a sum of 10^4
    time += s.duration;
  }
  CHECK(time == Approx(10));
  CHECK(pieces.size() > 1000);
}

TEST_CASE("a floor motion that makes no sense is refused", "[floor_motion]") {
  const GroundMotion motion = record();
  const Slider slider(Coulomb(1));
  Response r = integrate(slider, motion);
  for (const double bad : {0.0, -1.0, 2.0, std::numeric_limits<double>::quiet_NaN()})
    CHECK_THROWS_WITH(floor_motion(slider, motion, r, bad), ContainsSubstring("tolerance must be from 1e-10 to 1"));
  CHECK_THROWS_WITH(floor_motion(slider, record(301), r), ContainsSubstring("301 samples, got 300"));
  r.truncated = true;
  CHECK_THROWS_WITH(floor_motion(slider, motion, r), ContainsSubstring("truncated"));
  const std::vector<double> periods{1};
  CHECK_THROWS_WITH(response_spectrum(std::vector<Segment>{}, periods), ContainsSubstring("positive, finite sum"));
  CHECK_THROWS_WITH(response_spectrum(std::vector<Segment>{{1, 0, 0}, {-1, 0, 0}}, periods),
                    ContainsSubstring("motion[1].duration must be finite and at least 0, got -1 s"));
  CHECK_THROWS_WITH(response_spectrum(std::vector<Segment>{{1, 0, 1e101}}, periods),
                    ContainsSubstring("motion[0] must be finite"));
}
