// The caster: a wheel whose slip level falls off as sech(x / reach).
#include <limits>
#include <numbers>

#include "support/catch.hpp"
#include "support/motions.hpp"
#include "support/reference.hpp"

using namespace stickslip;
using namespace test;

TEST_CASE("a caster under record A moves as 32 digits say", "[caster]") {
  // Each Taylor step is cut off at a quarter of a rounding and checked against the equation of motion to 32 of them:
  // some ten roundings a segment, 400 segments, friction forgetting those of the velocity: 400 * 10 * 1.1e-16 = 4e-13
  // if all went one way; at random, 1e-14.
  for (const auto& run : reference::rows("sliders", "caster")) {
    const Response r = integrate(Slider(Caster(1, 0.5), run["natural_frequency"]), record_a());
    INFO(run["id"].as<std::string>());
    CHECK(std::abs(r.residual - run["displacement"]) <= 1e-13 * run["peak"]);
    CHECK(std::abs(r.state.velocity - run["velocity"]) <= 1e-13 * largest(r.velocity));
    CHECK(std::abs(r.peak - run["peak"]) <= 1e-13 * run["peak"]);
    CHECK(std::abs(r.energy.dissipated - run["dissipated"]) <= 1e-13 * run["dissipated"]);
    CHECK(count(r.events) == Counts{run["breakaways"].as<int>(), run["arrests"].as<int>(), run["reversals"].as<int>()});
  }
}

TEST_CASE("the slip level is the sine of the wheel's angle", "[caster]") {
  const Caster law(2, 0.3);
  for (const auto& angle : reference::rows("casters", "angles")) {
    const double position = angle["position"], sine = angle["sine"];
    CHECK(std::abs(law.resist(position * 0.3, Direction::forward) - 2 * sine) <= 1e-15 * 2 * sine * 4);
  }
  CHECK(law.resist(1e6, Direction::forward) == 0);
  CHECK(law.resist(0.7, Direction::forward) == law.resist(-0.7, Direction::backward));
}

TEST_CASE("the work of a caster is the integral of its level", "[caster]") {
  // a reach (gd(to) - gd(from)) in long doubles, gd(y) = pi/2 - 2 atan(e^-y) on the side where it does not cancel.
  const Caster law(1.5, 0.25);
  const auto work = [](long double from, long double to) {
    if (from < 0 && to <= 0) {
      std::swap(from, to);
      from = -from, to = -to;
    }
    if (from >= 0) return 1.5L * 0.25L * 2 * (std::atan(std::exp(-from / 0.25L)) - std::atan(std::exp(-to / 0.25L)));
    return 1.5L * 0.25L * 2 * (std::atan(std::tanh(to / 0.5L)) - std::atan(std::tanh(from / 0.5L)));
  };
  for (const double from : {-30.0, -5.0, -0.3, -1e-3, 0.0, 1e-9, 0.2, 1.0, 4.0, 20.0})
    for (const double way : {0x1p-20, 0.01, 0.3, 2.0, 50.0}) {
      INFO("from " << from << " by " << way);
      const double expected = static_cast<double>(work(from, static_cast<long double>(from) + way));
      // exp(y) is right to |y| roundings; `work` above cancels to some 5e-20
      const double y = (std::abs(from) + way) / 0.25;
      CHECK(law.work(-from, way, Direction::backward) == law.work(from, way, Direction::forward));
      CHECK(std::abs(law.work(from, way, Direction::forward) - expected) <=
            (8 + y) * 1.2e-16 * expected + 1.2e-16 * 1.5 * std::abs(from) + 1e-19);
    }
  CHECK(Caster(2, infinity).work(-1, 4, Direction::forward) == 8);
  CHECK(std::abs(Caster(2, 1e200).work(-1, 4, Direction::forward) - 8) <= 1e-14);
}

TEST_CASE("the work of a caster over its whole well is pi a reach", "[caster]") {
  CHECK(std::abs(Caster(2, 0.1).work(-1e3, 2e3, Direction::forward) - std::numbers::pi * 2 * 0.1) <= 1e-15);
}

TEST_CASE("a caster's level and reach follow from the balance of moments at its wheel", "[caster]") {
  const double mu = 0.4, width = 0.02;
  for (const auto& wheel : reference::rows("casters", "wheels")) {
    INFO("l/w = " << wheel["trail_over_width"]);
    const double trail = wheel["trail_over_width"] * width;
    const Caster law = Caster::from_geometry(mu, trail, width);
    CHECK(std::abs(law.slip_level() / (mu * standard_gravity) - wheel["level"]) <= 1e-14 * wheel["level"]);
    CHECK(std::abs(law.reach() / trail - wheel["reach"]) <= 1e-14 * wheel["reach"]);
    const Caster thesis = Caster::from_geometry_thesis(mu, trail, width);
    CHECK(std::abs(thesis.slip_level() / (mu * standard_gravity) - wheel["thesis_level"]) <= 1e-14);
    CHECK(thesis.reach() == 3 * trail);
  }
}

TEST_CASE("a thin wheel trails in line, a broad one scrubs like a block", "[caster]") {
  // l/w to infinity: the torque bound mu N w / 4 acts at l, level to mu g w/(4 l), reach to l; both with errors of
  // (w/l)^2 / 10. l/w to 0: level to mu g, and the reach l + w B / 2 with B = 1/sinh y, y to 6 l/w, to w^2 / (12 l).
  for (const double ratio : {1e2, 1e4, 1e8}) {
    const Caster law = Caster::from_geometry(1, ratio, 1);
    CHECK(std::abs(law.slip_level() / (standard_gravity / (4 * ratio)) - 1) <= 1 / (ratio * ratio) + 1e-14);
    CHECK(std::abs(law.reach() / ratio - 1) <= 1 / (ratio * ratio) + 1e-14);
  }
  for (const double ratio : {1e-3, 1e-5, 1e-8}) {
    const Caster law = Caster::from_geometry(1, ratio, 1);
    CHECK(std::abs(law.slip_level() / standard_gravity - 1) <= 10 * ratio * ratio + 1e-14);
    CHECK(std::abs(law.reach() * 12 * ratio - 1) <= 20 * ratio * ratio + 1e-14);
  }
}

TEST_CASE("a caster of infinite reach is a block", "[caster]") {
  for (const double natural_frequency : {0.0, 1.3}) {
    const Response block = integrate(Slider(Coulomb(1), natural_frequency), record_a());
    const Response caster = integrate(Slider(Caster(1, infinity), natural_frequency), record_a());
    CHECK(difference(block.displacement, caster.displacement) <= 1e-12 * block.peak);
    CHECK(difference(block.velocity, caster.velocity) <= 1e-12 * largest(block.velocity));
    CHECK(count(block.events) == count(caster.events));
  }
}

TEST_CASE("a caster of great reach is nearly a block", "[caster]") {
  // The levels differ by at most d = a X^2 / (2 reach^2), X the peak. Coulomb friction never drives two motions apart:
  // so |v - v'| <= d T and |x - x'| <= d T^2 / 2.
  const Response block = integrate(Coulomb(1), record_a());
  for (const double reach : {1e3, 1e5, 1e8, 1e200}) {
    const Response caster = integrate(Caster(1, reach), record_a());
    const double part = std::pow(std::max(block.peak, caster.peak) / reach, 2) / 2;
    CHECK(difference(block.velocity, caster.velocity) <= part * 40 + 1e-12 * largest(block.velocity));
    CHECK(difference(block.displacement, caster.displacement) <= part * 40 * 40 / 2 + 1e-12 * block.peak);
  }
}

TEST_CASE("mirrored ground moves a caster in mirror image, to the last bit", "[caster]") {
  for (const double natural_frequency : {0.0, 1.3}) {
    const Slider slider(Caster(1, 0.5), natural_frequency);
    const GroundMotion motion = broadband(11, 2'000);
    const Response one = integrate(slider, motion), other = integrate(slider, motion.scaled(-1));
    bool mirrored = one.events.size() == other.events.size();
    for (std::size_t i = 0; i < motion.samples(); ++i)
      mirrored = mirrored && one.displacement[i] == -other.displacement[i] && one.velocity[i] == -other.velocity[i];
    CHECK(mirrored);
    CHECK(one.energy.dissipated == other.energy.dissipated);
  }
}

TEST_CASE("a caster pushed below its escape speed stops where its energy is spent", "[caster]") {
  const Caster law(1, 0.5);
  for (const auto& escape : reference::rows("casters", "escapes")) {
    const double start = escape["from"], speed = escape["speed"], stop = escape["stop"];
    INFO("from " << start);
    const Response r = integrate(law, held(0, 1), from(start, 0.9 * speed, true));
    // Its energy, known to some roundings, over the level where it stops gives the way; the level is 0.05 to 0.2 of
    // that at the start.
    CHECK(std::abs(r.residual - stop) <= 1e-14 * stop);
    CHECK(r.state.mode == Mode::stuck);
    CHECK(std::abs(r.energy.imbalance()) <= 1e-13 * r.energy.initial);
    const Response mirror = integrate(law, held(0, 1), from(-start, -0.9 * speed, true));
    CHECK(mirror.residual == -r.residual);
  }
}

TEST_CASE("a caster pushed beyond its escape speed never comes to rest", "[caster]") {
  const Caster law(1, 0.5);
  for (const auto& escape : reference::rows("casters", "escapes")) {
    const double start = escape["from"], speed = escape["speed"];
    CHECK_THROWS_AS(integrate(law, held(0, 1), from(start, 1.01 * speed, true)), ConvergenceError);
    // and without settling, it drifts away at what speed its energy leaves it: v^2 - escape^2
    const Response r = integrate(law, held(0, 1e8), from(start, 1.01 * speed));
    const double left = speed * std::sqrt(1.01 * 1.01 - 1);
    CHECK(std::abs(r.state.velocity - left) <= 1e-12 * left);
  }
}

TEST_CASE("a caster that shoots through its well pays the well's whole work", "[caster]") {
  // v^2 / 2 falls by pi a reach in all; half of it at the center. One segment, or many: the same.
  const double a = 1, reach = 0.5, start = -400 * reach;
  const double well = std::numbers::pi * a * reach;
  for (const double speed : {std::sqrt(2 * well * 1.01), 3.0, 30.0, 3e3, 3e6}) {
    INFO("speed " << speed);
    const double lasting = 2 * -start / speed * (speed < 3 ? 3 : 1);
    const Response one = integrate(Caster(a, reach), line(0, 0, lasting), from(start, speed));
    const Response many =
        integrate(Caster(a, reach), GroundMotion(std::vector<double>(1001, 0.0), lasting / 1000), from(start, speed));
    const double out = std::sqrt(speed * speed - 2 * well);
    CHECK(one.state.velocity > 0);
    CHECK(std::abs(one.state.velocity - out) <= 1e-12 * speed * speed / out);
    CHECK(std::abs(many.state.velocity - out) <= 1e-12 * speed * speed / out);
    CHECK(std::abs(one.residual - many.residual) <= 1e-11 * many.peak);
    CHECK(std::abs(one.energy.dissipated - well) <= 1e-12 * one.energy.initial);
    CHECK(std::abs(one.energy.imbalance()) <= 1e-12 * one.energy.initial);
  }
  // Too slow for it, it stops in the well.
  const Response stopped = integrate(Caster(a, reach), held(0, 1), from(start, std::sqrt(2 * well * 0.5), true));
  CHECK(std::abs(stopped.residual) <= 1e-11);
  CHECK(stopped.state.mode == Mode::stuck);
}

TEST_CASE("a caster driven back from afar into its well feels it", "[caster]") {
  // At 800 reaches the level has underflowed to nothing; the ground then pushes it back and beyond the center.
  const double reach = 0.5, start = 800 * reach, push = 1;
  const double lasting = std::sqrt(2 * 1.5 * start / push);
  const Response r = integrate(Caster(1, reach), held(push, lasting), from(start));
  const double kinetic = push * (start - r.residual) - std::numbers::pi * reach;
  CHECK(r.residual < -50 * reach);
  CHECK(std::abs(r.energy.kinetic - kinetic) <= 1e-12 * kinetic);
  CHECK(std::abs(r.energy.imbalance()) <= 1e-12 * r.energy.input);
}

TEST_CASE("a caster accelerated from afar through its narrow well feels it", "[caster]") {
  // From rest 50 reaches out, where the level is 1e-22 of that within, x'' = -1000 t: cut in pieces, or not, the same.
  const Slider slider(Caster(1, 0.01));
  State whole = State::at(0.5, 0), parts = whole;
  advance(slider, Segment{1, 0, 1000}, whole);
  for (int i = 0; i < 1000; ++i) advance(slider, Segment{1e-3, 1.0 * i, 1.0 * (i + 1)}, parts);
  CHECK(std::abs(whole.displacement - parts.displacement) <= 1e-11 * 166);
  CHECK(std::abs(whole.velocity - parts.velocity) <= 1e-11 * 500);
}

TEST_CASE("a caster feels its level fall, also where a block would come back to where it began", "[caster]") {
  // From rest at x = 0 under a net acceleration from 1 to -2, a block's cubic returns to 0 just at the end of the
  // piece.
  State whole, parts;
  const Slider slider(Caster(1, 0.5));
  advance(slider, Segment{0.5, -2, 1}, whole);
  for (int i = 0; i < 64; ++i) advance(slider, Segment{0.5 / 64, -2 + 3.0 * i / 64, -2 + 3.0 * (i + 1) / 64}, parts);
  CHECK(std::abs(whole.displacement - parts.displacement) <= 1e-14);
  CHECK(std::abs(whole.velocity - parts.velocity) <= 1e-14);
}

TEST_CASE("a caster coasts on where its level is less than any normal number", "[caster]") {
  // Levels of 1e-300 to 1e-324 m/s^2 have no effect on 0.07 m/s.
  for (const double x : {350.0, 353.0, 354.5, 355.0, 356.0, 357.0, 360.0, 370.0, 372.0, 373.0})
    for (const double v : {0.07, -0.07}) {
      INFO("from " << x << " at " << v);
      State state = State::at(x, v);
      REQUIRE_NOTHROW(advance(Slider(Caster(1, 0.5)), Segment{1, 0, 0}, state));
      CHECK(std::abs(state.displacement - (x + v)) <= 1e-13);
      CHECK(state.velocity == v);
    }
}

TEST_CASE("Caster names the arguments that it rejects", "[caster][errors]") {
  CHECK_THROWS_WITH(Caster(-2, 1), "Caster: slip_level must be finite and at least 0, got -2 m/s^2");
  CHECK_THROWS_WITH(Caster(not_a_number, 1), "Caster: slip_level must be finite and at least 0, got nan m/s^2");
  CHECK_THROWS_WITH(Caster(1, 0), "Caster: reach must be positive, got 0 m");
  CHECK_THROWS_WITH(Caster(1, -0.1), "Caster: reach must be positive, got -0.1 m");
  CHECK_THROWS_WITH(Caster(1, not_a_number), "Caster: reach must be positive, got nan m");
  CHECK_THROWS_WITH(Caster::from_geometry(-1, 1, 1), "Caster: mu must be finite and at least 0, got -1");
  CHECK_THROWS_WITH(Caster::from_geometry(1, 0, 1), "Caster: trail must be positive and finite, got 0 m");
  CHECK_THROWS_WITH(Caster::from_geometry_thesis(1, 1, infinity),
                    "Caster: wheel_width must be positive and finite, got inf m");
  CHECK_THROWS_AS(Caster(1, 0), std::invalid_argument);
}

TEST_CASE("the work of a caster of enormous reach is that of Coulomb friction", "[caster][range]") {
  constexpr double largest = std::numeric_limits<double>::max();
  for (const double level : {1.0, 9.8})
    for (const double distance : {3.0, 1e-16})
      CHECK(std::abs(Caster(level, largest).work(0.1, distance, Direction::forward) - level * distance) <=
            1e-14 * level * distance);
}

TEST_CASE("however slow a caster starts, the motion is that from rest", "[caster]") {
  // A start at 1e-12 m/s shifts x by less than 1e-12 m within the 0.7 s.
  const GroundMotion motion({2, -1}, 0.7);
  const auto residual = [&](double velocity) {
    IntegrateOptions options;
    options.velocity = velocity;
    return integrate(Caster(1, 1), motion, options).residual;
  };
  const double from_rest = residual(0);
  for (const double velocity : {-1e-300, -1e-20, -1e-12, 1e-20})
    CHECK(std::abs(residual(velocity) - from_rest) <= 1e-12);
}

TEST_CASE("rolling resistance is the same everywhere, and its work grows with the way", "[caster]") {
  const Caster plain(1.5, 0.25), rolling(1.5, 0.25, 0.3);
  for (const Direction direction : {Direction::forward, Direction::backward})
    for (const double x : {-30.0, -0.3, 0.0, 0.01, 1.0, 20.0}) {
      CHECK(rolling.resist(x, direction) == Approx(plain.resist(x, direction) + 0.3).epsilon(4e-16));
      for (const double way : {0.0, 0x1p-70, 0.01, 2.0, 50.0}) {
        const double expected = plain.work(x, way, direction) + 0.3 * way;
        CHECK(std::abs(rolling.work(x, way, direction) - expected) <= 4e-16 * expected);
      }
    }
  CHECK(rolling.resist(1e9, Direction::forward) == 0.3);
  CHECK(Caster(1, 2).rolling() == 0);
  CHECK(Caster(1, 2, -0.0).resist(0.3, Direction::forward) == Caster(1, 2).resist(0.3, Direction::forward));
}

TEST_CASE("a caster that only rolls is a block of the same level", "[caster]") {
  // Taylor series against the closed form, as a caster of infinite reach.
  for (const double natural_frequency : {0.0, 1.3}) {
    const Response block = integrate(Slider(Coulomb(1), natural_frequency), record_a());
    const Response wheel = integrate(Slider(Caster(0, 0.5, 1), natural_frequency), record_a());
    CHECK(difference(block.displacement, wheel.displacement) <= 1e-12 * block.peak);
    CHECK(difference(block.velocity, wheel.velocity) <= 1e-12 * largest(block.velocity));
    CHECK(std::abs(wheel.energy.dissipated - block.energy.dissipated) <= 1e-12 * block.energy.dissipated);
    CHECK(count(block.events) == count(wheel.events));
  }
}

TEST_CASE("rolling resistance stops a caster that would escape, where its energy is spent", "[caster]") {
  const Caster law(1, 0.5, 0.02);
  for (const auto& escape : reference::rows("casters", "escapes")) {
    const double start = escape["from"], speed = escape["speed"];
    INFO("from " << start);
    const Response r = integrate(law, held(0, 1), from(start, 1.01 * speed, true));
    CHECK(r.state.mode == Mode::stuck);
    const double energy = 1.01 * speed * 1.01 * speed / 2, way = r.residual - start;
    CHECK(way > 0);
    // The sliding distance is a difference of positions, each with some four roundings.
    const double rounding = 8 * 1.1e-16 * r.residual * law.resist(start, Direction::forward);
    CHECK(std::abs(law.work(start, way, Direction::forward) - energy) <= 1e-13 * energy + rounding);
    CHECK(std::abs(r.energy.imbalance()) <= 1e-13 * energy);
  }
}

TEST_CASE("rolling resistance from the geometry is a coefficient of the weight", "[caster]") {
  const Caster plain = Caster::from_geometry(0.5, 0.04, 0.032), rolling = Caster::from_geometry(0.5, 0.04, 0.032, 0.01);
  CHECK(rolling.slip_level() == plain.slip_level());
  CHECK(rolling.reach() == plain.reach());
  CHECK(rolling.rolling() == 0.01 * standard_gravity);
  CHECK(Caster::from_geometry_thesis(0.5, 0.04, 0.032, 0.01).rolling() == rolling.rolling());
}

TEST_CASE("rolling resistance that is none is refused by its value", "[caster][errors]") {
  for (const double bad : {-0.1, infinity, not_a_number}) {
    const std::string got = " must be finite and at least 0, got " + detail::shortest(bad);
    CHECK_THROWS_WITH(Caster(1, 0.5, bad), "Caster: rolling" + got + " m/s^2");
    CHECK_THROWS_WITH(Caster::from_geometry(0.5, 0.04, 0.032, bad), "Caster: rolling_mu" + got);
  }
}
