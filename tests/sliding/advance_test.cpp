// One segment at a time, for codes that have a time loop of their own; and the roughest input there is.
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;

namespace {

/// Keeps what it sees, and counts what can not be.
template <class Law>
struct Witness {
  const Law& law;
  std::vector<EventKind> events;
  double way = 0, time = 0, input = 0, dissipated = 0, terms = 0;
  bool sound = true;

  void slide(const Slip& slip) {
    sound = sound && slip.distance >= -1e-15 * (1 + std::abs(slip.from)) && slip.duration >= 0;
    way += slip.distance, time += slip.duration, input += slip.work;
    dissipated += friction_work(law, slip.from, std::max(slip.distance, 0.0), slip.direction);
    terms += std::abs(slip.work);
  }
  void event(EventKind kind, double t, const State& state) {
    sound = sound && t >= 0 && state.velocity == 0 && (kind == EventKind::arrest) == (state.mode == Mode::stuck);
    events.push_back(kind);
  }
};

static_assert(MotionObserver<Witness<Coulomb>> && MotionObserver<NoObserver>);

double energy(const Slider<Coulomb>& slider, const State& s) {
  return s.velocity * s.velocity / 2 + slider.stiffness() * s.displacement * s.displacement / 2;
}

bool fits(const State& s) {
  return std::isfinite(s.displacement) && std::isfinite(s.velocity) &&
         (s.mode == Mode::stuck ? s.velocity == 0 : s.velocity * static_cast<int>(s.mode) >= 0);
}

}  // namespace

TEST_CASE("a state at a place and speed knows its mode", "[advance]") {
  CHECK(State::at(1, 0).mode == Mode::stuck);
  CHECK(State::at(1, 2).mode == Mode::forward);
  CHECK(State::at(1, -2).mode == Mode::backward);
  CHECK(sign(Direction::backward) == -1);
  CHECK(direction_of(mode_of(Direction::backward)) == Direction::backward);
}

TEST_CASE("a segment of no length does nothing", "[advance]") {
  State state = State::at(1, -2);
  advance(Slider(Coulomb(1), 1), Segment{0, 50, 50}, state);
  CHECK((state.displacement == 1 && state.velocity == -2 && state.mode == Mode::backward));
  State rest;
  advance(Slider(Coulomb(1)), Segment{0, 50, 50}, rest);
  CHECK(rest.mode == Mode::stuck);
}

TEST_CASE("segment by segment, a slider moves as through a whole motion, to the last bit", "[advance]") {
  const GroundMotion motion = broadband(30, 3'000);
  const auto same = [&](const auto& slider) {
    const Response whole = integrate(slider, motion);
    State state;
    bool equal = true;
    for (std::size_t i = 0; i < motion.segments(); ++i) {
      advance(slider, motion.segment(i), state);
      equal = equal && state.displacement == whole.displacement[i + 1] && state.velocity == whole.velocity[i + 1];
    }
    CHECK(equal);
    CHECK(state.mode == whole.state.mode);
  };
  same(Slider(Coulomb(1, 1.6)));
  same(Slider(Coulomb(1), 1.3));
  same(Slider(Caster(1, 0.5), 1.3));
  same(Slider(Bump{1, 0.5}));
}

TEST_CASE("two reversals fit into one straight piece of the ground motion", "[advance]") {
  // Pushed backward from 0.02 m/s, then forward; the reference says where to. Coulomb and a law that hides it.
  const auto turns_twice = [](const auto& law) {
    const Slider slider(law);
    Witness<std::remove_cvref_t<decltype(law)>> witness{law, {}};
    State state = State::at(0, 0.02);
    advance(slider, Segment{1, 4, -6}, state, witness);
    CHECK(witness.events == std::vector{EventKind::reversal, EventKind::reversal});
    CHECK(std::abs(state.displacement - 0.01542150464203804175432394215294192359768) <= 1e-15);
    CHECK(std::abs(state.velocity - 1.203935482821959107268081822123250367044) <= 1e-15 * 4);
  };
  turns_twice(Coulomb(1));
  turns_twice(Disguised{1});
}

TEST_CASE("a dip of the speed that misses zero changes nothing, one that passes it stops the slider", "[advance]") {
  // v = (1 - t)^2 +- gap: the net acceleration runs from -2 to 2 in 2 s, so the load from -1 to 3.
  const auto events = [](const auto& law, double gap) {
    Witness<std::remove_cvref_t<decltype(law)>> witness{law, {}};
    State state = State::at(0, 1 + gap);
    advance(Slider(law), Segment{2, 1, -3}, state, witness);
    CHECK(std::abs(state.velocity - (1 + gap)) <= 2 * std::sqrt(std::abs(std::min(gap, 0.0))) * 2 + 1e-14);
    CHECK(witness.sound);
    return witness.events;
  };
  const std::vector<EventKind> nothing, stop{EventKind::arrest, EventKind::breakaway};
  for (const double gap : {1e-1, 1e-3, 1e-6, 1e-9, 1e-12}) {
    INFO("gap " << gap);
    CHECK(events(Coulomb(1), gap) == nothing);
    CHECK(events(Disguised{1}, gap) == nothing);
    CHECK(events(Coulomb(1), -gap) == stop);
    CHECK(events(Disguised{1}, -gap) == stop);
  }
  CHECK(events(Coulomb(1), 0) == nothing);
}

TEST_CASE("where rounding takes a touch of zero speed for a stop, it lasts no time and changes nothing", "[advance]") {
  // A double root moves by the square root of a rounding, 1e-8 of the time here.
  const auto touches = [](const auto& slider, const std::vector<Segment>& segments, State state) {
    Witness<std::remove_cvref_t<decltype(slider.law())>> witness{slider.law(), {}};
    double duration = 0;
    for (const Segment& segment : segments) {
      advance(slider, segment, state, witness);
      duration += segment.duration;
    }
    CHECK(witness.sound);
    CHECK(std::abs(witness.time - duration) <= 1e-7 * duration);
    return state;
  };
  const State taylor = touches(Slider(Disguised{1}), {{2, 1, -3}}, State::at(0, 1));
  CHECK(std::abs(taylor.displacement - 2.0 / 3) <= 1e-15);
  CHECK(std::abs(taylor.velocity - 1) <= 1e-15);
  // On a spring, v = j (1 - cos wn t) / wn^2 touches zero after each period: three of them, cut at odd places.
  const double w = 8, T = 20 / w;
  const auto n = [&](double t) { return -1 - 3 * t; };
  std::vector<Segment> pieces;
  double before = 0;
  for (const double cut : {0.11, 0.3, 0.52, 0.77, 0.9, 1.0}) {
    pieces.push_back({(cut - before) * T, n(before * T), n(cut * T)});
    before = cut;
  }
  const State spring = touches(Slider(Coulomb(1), w), pieces, State{});
  CHECK(std::abs(spring.displacement - 3 * (T - std::sin(w * T) / w) / (w * w)) <= 1e-15);
  CHECK(std::abs(spring.velocity - 3 * (1 - std::cos(w * T)) / (w * w)) <= 1e-15);
}

TEST_CASE("cutting a segment anywhere changes nothing", "[advance]") {
  std::mt19937_64 bits(31);
  std::uniform_real_distribution<double> unit;
  std::normal_distribution<double> normal;
  const auto cut = [&](const auto& slider, int cases) {
    using Law = std::remove_cvref_t<decltype(slider.law())>;
    for (int i = 0; i < cases; ++i) {
      State whole = State::at(normal(bits) / 4, i % 3 == 0 ? 0 : normal(bits)), parts = whole;
      const Segment segment{0.05 + 2 * unit(bits), 3 * normal(bits), 3 * normal(bits)};
      std::vector<double> cuts{0, segment.duration};
      for (int k = 0; k < 1 + i % 5; ++k) cuts.push_back(segment.duration * unit(bits));
      std::ranges::sort(cuts);
      Witness<Law> one{slider.law(), {}}, many{slider.law(), {}};
      advance(slider, segment, whole, one);
      const auto n = [&](double t) {
        return t == segment.duration ? segment.end
                                     : segment.start + (segment.end - segment.start) * (t / segment.duration);
      };
      for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
        advance(slider, Segment{cuts[k + 1] - cuts[k], n(cuts[k]), n(cuts[k + 1])}, parts, many);
      // Some ten roundings of numbers up to 20, on each side, each event able to double them.
      CHECK(std::abs(whole.displacement - parts.displacement) <= 1e-13);
      CHECK(std::abs(whole.velocity - parts.velocity) <= 1e-13);
      CHECK(whole.mode == parts.mode);
      CHECK(one.events == many.events);
      CHECK(std::abs(one.way - many.way) <= 1e-13);
      CHECK(std::abs(one.input - many.input) <= 1e-12);
    }
  };
  // Short of a period: a slip that began from rest touches zero after one, and there rounding decides what it sees.
  for (const double natural_frequency : {0.0, 1.3, 3.0}) {
    cut(Slider(Coulomb(1, 1.6), natural_frequency), 400);
    cut(Slider(Caster(1, 0.3), natural_frequency), 200);
  }
}

TEST_CASE("each account of a segment adds up", "[advance]") {
  const Slider slider(Coulomb(1, 1.4), 2);
  Witness<Coulomb> witness{slider.law(), {}};
  State state = State::at(0.2, -1);
  const double before = energy(slider, state);
  advance(slider, Segment{5, -3, 6}, state, witness);
  CHECK(std::abs(before + witness.input - witness.dissipated - energy(slider, state)) <= 1e-14 * witness.terms);
  CHECK(witness.time <= 5);
  CHECK(witness.sound);
}

TEST_CASE("nothing rough makes a slider hang, vanish, gain energy or lose its order", "[advance][fuzz]") {
  // Short motions made of ties and jumps: whole numbers for n, the levels and the times, pieces of no length, repeats.
  std::mt19937_64 bits(32);
  const auto pick = [&](std::initializer_list<double> values) { return values.begin()[bits() % values.size()]; };
  const auto rough = [&](const std::string& name, const auto& slider) {
    using Law = std::remove_cvref_t<decltype(slider.law())>;
    const Law& law = slider.law();
    double x = pick({0, 0, 0, 1, -1, 0.5, 3});
    double v = pick({0, 0, 0, 1, -1, 2, 0.5});
    if (v < 0 && std::isinf(static_cast<double>(law.resist(0.0, Direction::backward)))) v = 0;
    State state = State::at(x, v);
    Witness<Law> witness{law, {}};
    if (state.mode != Mode::stuck) witness.events.push_back(EventKind::breakaway);
    const double k = slider.stiffness();
    const double before = v * v / 2 + k * x * x / 2;
    double n = 0, most = std::abs(x), max_speed = std::abs(v);
    const bool joined = bits() % 2 == 0;
    std::string input = name + ", wn " + detail::shortest(slider.natural_frequency()) + ", x " + detail::shortest(x) +
                        ", v " + detail::shortest(v) + ":";
    bool fine = true;
    double work = 0;  // of the ground, without regard to sign
    for (int i = 0; i < 8; ++i) {
      const double start = joined && i > 0 ? n : pick({0, 1, -1, 2, -2, 1.6, -1.6, 0.5, 50, -1e3});
      n = bits() % 3 == 0 ? start : pick({0, 1, -1, 2, -2, 1.6, -1.6, 3, -3, 1e3});
      const Segment segment{pick({0, 1, 1, 0.5, 2, 1e-9, 0.1, 7}), start, n};
      input +=
          " {" + detail::shortest(segment.duration) + ", " + detail::shortest(start) + ", " + detail::shortest(n) + "}";
      const double way = witness.way;
      advance(slider, segment, state, witness);
      fine = fine && fits(state);
      work += std::max(std::abs(start), std::abs(n)) * (witness.way - way);
      most = std::max(most, std::abs(state.displacement)), max_speed = std::max(max_speed, std::abs(state.velocity));
    }
    const double after = state.velocity * state.velocity / 2 + k * state.displacement * state.displacement / 2;
    // Each of at most some hundred slips rounds its accounts by a few 1e-16 of their terms.
    const double terms = work + witness.dissipated + before + after + max_speed * max_speed + k * most * most;
    INFO(input);
    CHECK(fine);
    CHECK(witness.sound);
    CHECK(std::abs(before + witness.input - witness.dissipated - after) <= 1e-13 * terms);
    bool sliding = false, ordered = true;
    for (const EventKind kind : witness.events) {
      ordered = ordered && (kind == EventKind::breakaway) != sliding;
      sliding = kind != EventKind::arrest;
    }
    CHECK(ordered);
    CHECK(sliding == (state.mode != Mode::stuck));
  };
  for (int i = 0; i < 1500; ++i) {
    const double frequency = pick({0, 0, 1, 2, std::numbers::pi, 0.1, 20});
    const double level = pick({0, 1, 2, 1.6}), backward = pick({0, 1, 2, 1.6, infinity}),
                 reach = pick({0.5, 1, 0.01, 1e6});
    const std::string levels = detail::shortest(level) + ", ";
    rough("Coulomb " + levels + detail::shortest(backward), Slider(Coulomb(level, backward), frequency));
    rough("Caster " + levels + detail::shortest(reach), Slider(Caster(level, reach), frequency));
    rough("Disguised " + levels, Slider(Disguised{level}, frequency));
    if (i % 5 == 0) rough("Bump " + levels + detail::shortest(reach), Slider(Bump{level, reach}, frequency));
  }
}

TEST_CASE("a segment or a state that is not finite is refused, and changes nothing", "[advance][errors]") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](const auto& slider) {
    for (const double bad : {nan, infinity, -infinity}) {
      for (const Segment& segment : {Segment{0.1, 0.2, bad}, Segment{0.1, bad, 0.2}, Segment{bad, 0.2, 0.2}}) {
        State state;
        CHECK_THROWS_AS(advance(slider, segment, state), std::invalid_argument);
        CHECK((state.displacement == 0 && state.velocity == 0 && state.mode == Mode::stuck));
        state = State::at(1, -2);
        CHECK_THROWS_AS(advance(slider, segment, state), std::invalid_argument);
        CHECK((state.displacement == 1 && state.velocity == -2 && state.mode == Mode::backward));
      }
      State state{bad, 0, Mode::stuck};
      CHECK_THROWS_AS(advance(slider, Segment{1, 0, 0}, state), std::invalid_argument);
      state = {0, bad, Mode::forward};
      CHECK_THROWS_AS(advance(slider, Segment{1, 0, 0}, state), std::invalid_argument);
    }
  };
  for (const double frequency : {0.0, 1.3}) {
    refused(Slider(Coulomb(1), frequency));
    refused(Slider(Coulomb(1, infinity), frequency));
    refused(Slider(Caster(1, 0.5), frequency));
  }
  State state;
  CHECK_THROWS_WITH(advance(Slider(Coulomb(1)), Segment{0.1, 0.2, nan}, state),
                    ContainsSubstring("must be finite") && ContainsSubstring("end nan m/s^2"));
  CHECK_THROWS_AS(advance(Slider(Coulomb(1)), HarmonicSegment{1, 2, nan, 0}, state), std::invalid_argument);
}

TEST_CASE("a time loop that meets a NaN ends in an error", "[advance][errors]") {
  const double n[] = {0.5, 0.2, std::numeric_limits<double>::quiet_NaN(), 2};
  for (const double frequency : {0.0, 1.3}) {
    const Slider slider(Coulomb(1), frequency);
    State state;
    advance(slider, Segment{0.1, n[0], n[1]}, state);
    CHECK_THROWS_AS(advance(slider, Segment{0.1, n[1], n[2]}, state), std::invalid_argument);
  }
}

TEST_CASE("events that no clock can tell apart end in an error", "[advance][errors]") {
  State state = State::at(1, 0);
  CHECK_THROWS_AS(advance(Slider(Coulomb(0), 1e20), Segment{1e5, 0, 0}, state), ConvergenceError);
}

TEST_CASE("a caster passes the shortest segments as if they were none", "[advance][range]") {
  State state = State::at(0, 6.69e77);
  advance(Slider(Caster(0.1, 0x1p-552)), Segment{0x1p-1074, 0.1, 0.1}, state);
  CHECK(std::abs(state.displacement - 6.69e77 * 0x1p-1074) <= 1e-15 * state.displacement);
  CHECK(state.velocity == 6.69e77);
  const GroundMotion with({-2.3, 0, -2}, {0, 1e-300, 1}), without({0, -2}, 1);
  const auto start = [] { return State::at(1e-8, 1); };
  State one = start(), other = start();
  for (std::size_t i = 0; i < 2; ++i) advance(Slider(Caster(2, 200)), with.segment(i), one);
  advance(Slider(Caster(2, 200)), without.segment(0), other);
  CHECK(std::abs(one.displacement - other.displacement) <= 1e-15);
  CHECK(std::abs(one.velocity - other.velocity) <= 1e-15);
}

TEST_CASE("a speed that stops before the clock moves stops there", "[advance][range]") {
  // u = 2^-1074 m/s against 1 m/s^2: the stop underflows to 0, and must not be taken for none.
  for (const double backward : {1.0, 1e6}) {
    State state = State::at(0, -0x1p-1074);
    advance(Slider(Coulomb(1, backward)), Segment{1, 0, 0}, state);
    CHECK(state.mode == Mode::stuck);
    CHECK(std::abs(state.displacement) <= 0x1p-1000);
  }
  State state;  // frictionless, pushed by the smallest of loads and then by 2 m/s^2 for a second
  advance(Slider(Coulomb(0)), Segment{1, 0x1p-1074, 0x1p-1074}, state);
  advance(Slider(Coulomb(0)), Segment{1, -2, -2}, state);
  CHECK(state.displacement == 1);
}

TEST_CASE("a slip too short for a double is none", "[advance][range]") {
  // The load is above the level by less than round-off, and falls: the time to the stop underflows to zero. Then it
  // goes the other way: p = -1000 t for 0.1 s, and back to zero.
  const GroundMotion ramps({-5e-324, 100, 0}, 0.1);
  const auto through = [&](const auto& slider, const GroundMotion& motion, State state) {
    for (std::size_t i = 0; i < motion.segments(); ++i) advance(slider, motion.segment(i), state);
    return state.displacement;
  };
  const double h = 0.1;
  const auto ramp = [](double t) { return t - std::sin(t); };  // x'' + x = t
  CHECK(std::abs(through(Slider(Coulomb(0), 1), ramps, {}) - (-1000 * ramp(2 * h) + 2000 * ramp(h))) <= 1e-12);
  for (const double last : {through(Slider(Coulomb(0)), ramps, {}), through(Slider(Caster(0, 1)), ramps, {})})
    CHECK(std::abs(last + 100 * h * h) <= 1e-14);

  // The spring's pull of 6.7e-17 m/s^2 breaks it away. From t = 0 on the load is 0.433 (1 - t) and the level 0.1, to
  // which the spring adds less than 1e-16.
  const double n = 0.43326133328732264;
  const GroundMotion jump({0.1, -n, 0}, std::vector<double>{0, 1e-300, 1});
  CHECK(std::abs(through(Slider(Coulomb(0.1), 1e-8), jump, State::at(0.669, 0)) - (0.669 + (n - 0.1) / 2 - n / 6)) <=
        1e-15);
}

TEST_CASE("the rate of a load may be as large as doubles are", "[advance][range]") {
  // Within 1e-300 s no load stops a speed of 2.5e-17 m/s.
  State state = State::at(0, 2.5e-17);
  advance(Slider(Coulomb(1)), Segment{1e-300, 0, -1e8}, state);
  CHECK(state.velocity == 2.5e-17);
  CHECK(state.mode == Mode::forward);
}

TEST_CASE("a motion beyond the range of doubles is an error, also one segment at a time, and changes nothing",
          "[advance][range]") {
  State state = State::at(1, 2);
  CHECK_THROWS_AS(advance(Slider(Coulomb(1)), Segment{1e200, -1e200, -1e200}, state), std::overflow_error);
  CHECK(state.displacement == 1);
  CHECK(state.velocity == 2);
  CHECK_THROWS_AS(advance(Slider(Coulomb(1)), HarmonicSegment{1e160, 1e160, 1e-160, 0}, state), std::overflow_error);
  CHECK(state.displacement == 1);
  CHECK(state.velocity == 2);
}

TEST_CASE("a caster far from its center answers the smallest of loads", "[advance][range]") {
  // Its level there underflows, so it slides under any load; under this one not visibly.
  State state = State::at(-0x1.0624dd2f1a9fcp-30, 0);
  advance(Slider(Caster(0x1p-20, 0x1.bff2ee48e053p-353)), Segment{2, -0.0, 0x1p-1074}, state);
  CHECK(state.displacement == -0x1.0624dd2f1a9fcp-30);
}

TEST_CASE("where the loads balance to the last digit, the slowest slip ends", "[advance][range]") {
  // The spring pulls by the level exactly; a quarter swing is 52 s.
  const Slider slider(Caster(1, 0x1p+1000), 0x1.eb851eb851eb8p-6);
  State state = State::at(0x1.15c71c71c71c7p+10, -0x1p-1074);
  advance(slider, Segment{1e6, 0, 0}, state);
  CHECK(state.mode == Mode::stuck);
  CHECK(state.displacement == 0x1.15c71c71c71c7p+10);
}

TEST_CASE("extreme but legal input ends in bounded work, with an answer or a reason", "[advance][range][errors]") {
  using Catch::Matchers::ContainsSubstring;
  const GroundMotion motion({0, 3, -3, 1}, 0.1);
  CHECK_THROWS_WITH(Slider(Coulomb(1), 0, 1e200),
                    "Slider: damping and its square must be finite and at least 0, got "
                    "1e+200 1/s");
  const Response damped = integrate(Slider(Coulomb(1), 0, 1e150), motion);
  CHECK(damped.peak == Approx(1e-151).epsilon(1e-6));  // 3 m/s^2 - 1 m/s^2 over 1e150 1/s, for 0.05 s on average
  for (const double frequency : {0.0, 3.0}) {
    const Slider slider(Coulomb(1), {.natural_frequency = frequency, .stops = Stops(0.1, 0.5)});
    State state = State::at(0.001, 0.1);
    advance(slider, Segment{0.1, 1e99, -5e98}, state);
    CHECK(state.displacement == 0.1);
    CHECK_THROWS_WITH(advance(slider, Segment{0.1, 1e308, -5e307}, state),
                      "advance: load and normal force must be at most 1e100 m/s^2 in magnitude, got 1e+308 m/s^2");
    CHECK(state.displacement == 0.1);
  }
  CHECK_THROWS_WITH(
      KumarFriction({.mu_ref = 1e308, .static_pressure = 3e7, .reference_pressure = 3e7, .contact_radius = 0.1}),
      ContainsSubstring("mu_ref must be from 0 to 1e+300"));
  State state = State::at(0, 1);
  CHECK_THROWS_AS(advance(Slider(Stribeck(1e308, 1, 0.1, 2)), Segment{0.1, 3, -3}, state), ConvergenceError);
  CHECK_THROWS_WITH(advance(Slider(Coulomb(1, infinity)), Segment{1, 0, 0}, state = State::at(0, -1)),
                    "advance: velocity must not point where the slip level is infinite, got -1 m/s");
  CHECK(state.velocity == -1);
}
