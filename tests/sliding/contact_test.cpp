// Vertical motion, slopes and lost contact: reference values, closed forms, limits, energy.
#include "stickslip/sliding/detail/contact.hpp"

#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "support/catch.hpp"
#include "support/motions.hpp"
#include "support/outcome.hpp"
#include "support/reference.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;

namespace {

/// Record A and its vertical component, times a factor.
GroundMotion shaken(double factor) {
  std::vector<double> up;
  for (int m = 0; m <= 400; ++m) up.push_back(static_cast<double>(factor * (2.5L * std::cos(0.5L * m + 0.2L))));
  return record_a().with_components({}, up);
}

IntegrateOptions clipped() {
  IntegrateOptions options;
  options.contact = Contact::clipped;
  return options;
}

Mounting slope(double degrees, bool one_way = false) {
  Mounting mounting;
  mounting.slope_degrees = degrees;
  mounting.one_way = one_way;
  return mounting;
}

void check(const char* id, const Response& r, bool at_once) {
  INFO(id);
  const auto expected = reference::row("sliders", "others", id);
  check_outcome(r, expected, at_once);
  CHECK(std::abs(r.energy.dissipated - expected["dissipated"]) <= 1e-12 * expected["dissipated"]);
}

int number_of(const Response& r, EventKind kind) {
  int result = 0;
  for (const Event& e : r.events) result += e.kind == kind;
  return result;
}

/// Whether two responses are the same to round-off.
void check_same(const Response& a, const Response& b, double tolerance = 1e-12) {
  CHECK(difference(a.displacement, b.displacement) <= tolerance * b.peak);
  CHECK(difference(a.velocity, b.velocity) <= tolerance * largest(b.velocity));
  CHECK(std::abs(a.peak - b.peak) <= tolerance * b.peak);
  CHECK(std::abs(a.energy.dissipated - b.energy.dissipated) <= tolerance * turnover(b.energy));
  CHECK(count(a.events) == count(b.events));
}

}  // namespace

TEST_CASE("sliders under vertical motion move as the reference does", "[contact]") {
  check("A.coulomb", integrate(Coulomb::from_friction(0.1), shaken(1)), false);
  check("A.coulomb.spring7", integrate(Slider(Coulomb::from_friction(0.1), 7), shaken(1)), false);
  check("A.highmu", integrate(Coulomb::from_friction(0.3), shaken(3.5)), false);
  check("A.clipped", integrate(Coulomb::from_friction(0.1), shaken(5), clipped()), false);
  const VelocityDependent liner(0.04 * standard_gravity, 0.08 * standard_gravity, 30);
  check("C.cmr.fps", integrate(Slider(liner, 2.5), shaken(1)), true);
}

TEST_CASE("blocks on slopes move as the reference does", "[contact]") {
  check("A.slope20.twoway", integrate(Slider(Coulomb::from_friction(0.45), slope(20)), shaken(1)), false);
  check("A.slope20.oneway", integrate(Slider(Coulomb::from_friction(0.45), slope(20, true)), shaken(1)), false);
  check("A.slope5.oneway", integrate(Slider(Coulomb::from_friction(0.15), slope(5, true)), shaken(1)), false);
}

TEST_CASE("a block on a slope yields at g tan(phi - theta)", "[contact]") {
  // Under horizontal shaking: g sin - n cos = mu (g cos + n sin), mu = tan phi. Uphill at g tan(phi + theta).
  const double degrees = 20, mu = 0.5, th = degrees * (std::numbers::pi / 180), phi = std::atan(mu);
  const Slider block(Coulomb::from_friction(mu), slope(degrees));
  const double down = standard_gravity * std::tan(phi - th), up = standard_gravity * std::tan(phi + th), hair = 1e-12;
  CHECK(integrate(block, held(-down * (1 - hair), 1)).peak == 0);
  CHECK(integrate(block, held(up * (1 - hair), 1)).peak == 0);
  CHECK(integrate(block, held(-down * (1 + hair), 1)).residual > 0);
  CHECK(integrate(block, held(up * (1 + hair), 1)).residual < 0);
  CHECK(integrate(Slider(Coulomb::from_friction(mu), slope(degrees, true)), held(2 * up, 1)).peak == 0);
}

TEST_CASE("a block that flies moves as the reference does", "[contact]") {
  // next_values.json A.flight: closed form, 34 against 44 digits. Its reversals and stops in flight are not counted.
  const Response r = integrate(Coulomb::from_friction(0.1), shaken(5));
  CHECK(std::abs(r.residual - 0.1402816363826218557289617) <= 1e-12 * r.peak);
  CHECK(r.state.velocity == 0);
  CHECK(std::abs(r.displacement[100] - -0.01800681797542172545246738) <= 1e-12 * r.peak);
  CHECK(std::abs(r.displacement[200] - 0.05370231662224442639665359) <= 1e-12 * r.peak);
  CHECK(std::abs(r.displacement[300] - 0.2011357361535469851791799) <= 1e-12 * r.peak);
  CHECK(number_of(r, EventKind::liftoff) == 32);
  CHECK(number_of(r, EventKind::landing) == 32);
  CHECK(std::abs(r.energy.imbalance()) <= 1e-12 * turnover(r.energy));
  std::size_t next = 0;
  for (const auto& [kind, time, x] :
       {std::tuple{EventKind::breakaway, 0.2043784235996376079177977, 0.0},
        {EventKind::liftoff, 0.4621194176153134695276659, -0.03514026487229715869823802},
        {EventKind::landing, 0.9898639718756189939552888, 0.04263221242337716281087717}}) {
    while (r.events[next].kind != kind) ++next;
    CHECK(std::abs(r.events[next].time - time) <= 1e-12);
    CHECK(std::abs(r.events[next].displacement - x) <= 1e-12 * r.peak);
  }
  REQUIRE(r.gap.size() == r.displacement.size());
  CHECK(largest(r.gap) <= 0.09150840963072837272206117 + 1e-12);
  CHECK(largest(r.gap) > 0.08);  // the greatest height lies between samples
}

TEST_CASE("a vertical motion of none is no vertical motion", "[contact]") {
  for (const GroundMotion& motion : {record_a(), record_a(Interpolation::constant), broadband(3, 2000)}) {
    const GroundMotion still = motion.with_components({}, std::vector<double>(motion.samples()));
    const auto same = [&](const auto& slider) { check_same(integrate(slider, still), integrate(slider, motion)); };
    same(Slider(Coulomb(1)));
    same(Slider(Coulomb(0.8, 1.4)));
    same(Slider(Coulomb(1), 3));
    same(Slider(Coulomb(1), 3, 0.5));
    same(Slider(Caster(1, 0.02)));
    same(Slider(VelocityDependent(0.6, 1.5, 5), 2));
    same(Slider(Disguised{1}));
  }
}

TEST_CASE("a slope of none, and a wall far away, are none", "[contact]") {
  const GroundMotion motion = broadband(4, 2000);
  const Slider plain(Coulomb(0.8), 2);
  Mounting far{.natural_frequency = 2, .stops = {1e9, 0.5}};
  check_same(integrate(Slider(Coulomb(0.8), far), motion), integrate(plain, motion));
  // As the slope goes to nothing, so does its effect: of first order.
  double last = infinity;
  for (const double degrees : {1e-3, 1e-6, 1e-9}) {
    const Response r = integrate(Slider(Coulomb(0.8), slope(degrees)), motion), flat = integrate(Coulomb(0.8), motion);
    const double effect = difference(r.displacement, flat.displacement);
    CHECK(effect <= 2e-3 * last);
    last = effect;
  }
}

TEST_CASE("a law in closed form and one in series agree under vertical motion", "[contact]") {
  for (const double factor : {1.0, 5.0})
    for (const double wn : {0.0, 3.0}) {
      CAPTURE(factor, wn);
      check_same(integrate(Slider(Disguised{1}, wn), shaken(factor)), integrate(Slider(Coulomb(1), wn), shaken(factor)),
                 1e-11);
    }
}

TEST_CASE("a block thrown up flies a parabola and lands on time", "[contact]") {
  // The ground falls with 1.5 g for a while, then holds still: y'' = g / 2 at first, then -g.
  const double g = standard_gravity, fall = 0.2;
  const GroundMotion motion = GroundMotion(std::vector<double>(5), {0, fall, fall, 2, 3}, Interpolation::constant)
                                  .with_components({}, {-1.5 * g, 0, 0, 0, 0});
  IntegrateOptions options;
  options.velocity = 0.7;
  const Coulomb law = Coulomb::from_friction(0.5);
  const Response r = integrate(law, motion, options);
  const double up = g / 2 * fall, height = g / 4 * fall * fall;
  const double lands = fall + (up + std::sqrt(up * up + 2 * g * height)) / g;
  const double hits = g * (lands - fall) - up;
  std::vector<EventKind> kinds;
  for (const Event& e : r.events) kinds.push_back(e.kind);
  // The impulse of friction is 0.5 |y'| > 0.7 m/s: it stops at once.
  REQUIRE(0.5 * hits > 0.7);
  CHECK(kinds ==
        std::vector{EventKind::breakaway, EventKind::liftoff, EventKind::landing, EventKind::arrest, EventKind::end});
  CHECK(std::abs(r.events[2].time - lands) <= 1e-14);
  CHECK(std::abs(r.residual - 0.7 * lands) <= 1e-14);
  CHECK(std::abs(r.energy.dissipated - 0.7 * 0.7 / 2) <= 1e-14);
  // With less friction some speed is left.
  const Response faster = integrate(Coulomb::from_friction(0.1), motion, options);
  const double left = 0.7 - 0.1 * hits;
  CHECK(std::abs(faster.residual - (0.7 * lands + left * left / (2 * 0.1 * g))) <= 1e-14);
  // Friction that does not depend on the speed, written as if it did.
  const Response same = integrate(VelocityDependent(0.1 * g, 0.1 * g, 3), motion, options);
  CHECK(std::abs(same.residual - faster.residual) <= 1e-13);
  // And that does: d|v|/dJ = -mu(v), by Simpson's rule for dJ = d|v| / mu.
  const VelocityDependent law_of_speed(0.05 * g, 0.1 * g, 3);
  const auto mu = [&](double v) { return law_of_speed.resist(0.0, v, Direction::forward) / g; };
  const double after = detail::after_impulse(law_of_speed, 0, Direction::forward, 0.7, hits);
  double impulse = 0;
  constexpr int steps = 200;
  const double h = (0.7 - after) / steps;
  for (int i = 0; i < steps; ++i) {
    const double v = after + i * h;
    impulse += h / 6 * (1 / mu(v) + 4 / mu(v + h / 2) + 1 / mu(v + h));
  }
  CHECK(std::abs(impulse - hits) <= 1e-11);
}

TEST_CASE("a pendulum's spring weighs what rests on it", "[contact]") {
  const auto pendulum = [](const auto& law, double wn) {
    return Slider(law, Mounting{.natural_frequency = wn, .pendulum = true});
  };
  // Without vertical motion it is a spring.
  const GroundMotion motion = record_a();
  check_same(integrate(pendulum(Coulomb(0.5), 2), motion), integrate(Slider(Coulomb(0.5), 2), motion));
  // Under a vertical acceleration that stays, N = g + a_z, it is a spring of wn^2 N / g, and friction has the level mu
  // N.
  const double part = 1.3;
  const GroundMotion heavy =
      motion.with_components({}, std::vector<double>(motion.samples(), (part - 1) * standard_gravity));
  check_same(integrate(pendulum(Coulomb(0.5), 2), heavy),
             integrate(Slider(Coulomb(0.5 * part), 2 * std::sqrt(part)), motion));
  const VelocityDependent liner(0.3, 0.8, 20);
  const VelocityDependent weighed(0.3 * part, 0.8 * part, 20);
  check_same(integrate(pendulum(liner, 2), heavy), integrate(Slider(weighed, 2 * std::sqrt(part)), motion));
  // Energy closes under one that varies; and at rest too, where it changes the pull.
  for (const double factor : {1.0, 2.0}) {
    const Response r = integrate(pendulum(liner, 2.2), shaken(factor));
    CHECK(std::abs(r.energy.imbalance()) <= 1e-12 * turnover(r.energy));
  }
}

TEST_CASE("vertical motion may be cut anywhere", "[contact]") {
  // The same motion with each segment cut in three: what happens in between is carried by the state, flights too.
  const GroundMotion whole = shaken(5);
  std::vector<double> times, n, up;
  for (std::size_t i = 0; i < whole.segments(); ++i)
    for (const double part : {0.0, 0.3, 0.8}) {
      times.push_back((static_cast<double>(i) + part) * 0.1);
      n.push_back(std::lerp(whole.acceleration()[i], whole.acceleration()[i + 1], part));
      up.push_back(std::lerp(whole.vertical()[i], whole.vertical()[i + 1], part));
    }
  times.push_back(40), n.push_back(whole.acceleration().back()), up.push_back(whole.vertical().back());
  const GroundMotion pieces = GroundMotion(n, times).with_components({}, up);
  const auto compare = [&](const auto& slider, const IntegrateOptions& options) {
    const Response one = integrate(slider, whole, options), other = integrate(slider, pieces, options);
    CHECK(std::abs(one.residual - other.residual) <= 1e-12 * one.peak);
    CHECK(std::abs(one.peak - other.peak) <= 1e-12 * one.peak);
    CHECK(count(one.events) == count(other.events));
    CHECK(number_of(one, EventKind::landing) == number_of(other, EventKind::landing));
    State state;
    for (std::size_t i = 0; i < pieces.segments(); ++i)
      advance(slider,
              LoadSegment{times[i + 1] - times[i], -n[i], -n[i + 1], standard_gravity + up[i],
                          standard_gravity + up[i + 1]},
              state, NoObserver{}, options.contact);
    CHECK(std::abs(one.residual - state.displacement) <= 1e-12 * one.peak);
  };
  compare(Slider(Coulomb(1)), {});
  compare(Slider(Coulomb(1)), clipped());
  compare(Slider(Coulomb(1), 3, 0.3), {});
  compare(Slider(VelocityDependent(0.5, 1, 5), 3), {});
}

TEST_CASE("a slider settles on a slope and after a flight", "[contact]") {
  IntegrateOptions options;
  options.settle = true;
  options.velocity = 2;
  const GroundMotion still({0, 0}, 0.1);
  // Downhill, against mu g cos - g sin.
  const double degrees = 10, mu = 0.3, th = degrees * (std::numbers::pi / 180);
  const double deceleration = standard_gravity * (mu * std::cos(th) - std::sin(th));
  const Response r = integrate(Slider(Coulomb::from_friction(mu), slope(degrees)), still, options);
  CHECK(std::abs(r.residual - 4 / (2 * deceleration)) <= 1e-13);
  CHECK(std::abs(r.energy.imbalance()) <= 1e-13);
  CHECK(r.state.mode == Mode::stuck);
  // The motion ends while it flies.
  const double g = standard_gravity;
  const GroundMotion drop =
      GroundMotion({0, 0, 0}, std::vector<double>{0, 0.3, 0.6}).with_components({}, {-3 * g, -3 * g, 0});
  const Response landed = integrate(Coulomb::from_friction(0.1), drop, options);
  CHECK(number_of(landed, EventKind::landing) == 1);
  CHECK(landed.state.mode == Mode::stuck);
  CHECK(landed.gap.back() == 0);
  CHECK(landed.gap.size() == landed.displacement.size());
}

TEST_CASE("what cannot be is refused", "[contact]") {
  CHECK_THROWS_WITH(
      Slider(Coulomb::from_friction(0.1), slope(20)),
      ContainsSubstring("on a slope of 20 degrees it slides under its own weight unless mu is at least 0.36"));
  CHECK_NOTHROW(Slider(Coulomb(0.1), Mounting{.natural_frequency = 1, .slope_degrees = 20}));
  CHECK_THROWS_WITH(Slider(Coulomb(9), slope(90)),
                    "Slider: slope_degrees must be from 0 to less than 90, got 90 degrees");
  CHECK_THROWS_WITH(Slider(Coulomb(9), slope(not_a_number)), ContainsSubstring("got nan"));
  CHECK_THROWS_WITH(Slider(Coulomb(9), Mounting{.pendulum = true}), ContainsSubstring("needs a natural_frequency"));
  const GroundMotion falls = record_a().with_components({}, std::vector<double>(401, -10));
  CHECK_THROWS_WITH(integrate(Coulomb(1), falls), ContainsSubstring("never lands"));
  IntegrateOptions back;
  back.velocity = -1;
  CHECK_THROWS_WITH(integrate(Slider(Coulomb(5), slope(1, true)), record_a(), back),
                    "integrate: velocity must not point backward on a one-way slider, got -1 m/s");
  CHECK_THROWS_WITH(integrate(Slider(Coulomb(5), slope(1)), HarmonicMotion(1, 1, 10, 0.1)),
                    ContainsSubstring("level ground"));
  State state;
  CHECK_THROWS_AS(advance(Slider(Coulomb(1)), LoadSegment{0.1, 0, 0, not_a_number, 1}, state), std::invalid_argument);
}

TEST_CASE("Stribeck friction stops a slider before the normal force vanishes, however few the samples", "[contact]") {
  // The vertical acceleration falls to -20 m/s^2 in k straight pieces, all on one line.
  const auto answer = [](int k, Contact contact) {
    std::vector<double> n, times, up;
    for (int j = 0; j <= k; ++j) {
      const double f = static_cast<double>(j) / k;
      n.push_back(0.1 + 0.4 * f);
      times.push_back(0.1 * f);
      up.push_back(-20 * f);
    }
    n.push_back(0.5);
    times.push_back(0.2);
    up.push_back(0);
    IntegrateOptions options;
    options.velocity = 0.04;
    options.contact = contact;
    return integrate(Stribeck(2.4, 1.2, 0.02, 6), GroundMotion(n, times).with_components({}, up), options);
  };
  for (const Contact contact : {Contact::clipped, Contact::flight}) {
    const Response fine = answer(100, contact);
    for (const int k : {1, 2, 4}) {
      const Response r = answer(k, contact);
      CHECK(std::abs(r.residual - fine.residual) <= 1e-12 * fine.peak);
      CHECK(std::abs(r.energy.imbalance()) <= 1e-12 * turnover(r.energy));
    }
  }
}

TEST_CASE("a slider in flight that touches the ground and falls lands at once", "[contact]") {
  struct Kinds {
    std::vector<std::pair<EventKind, double>> seen;
    void slide(const Slip&) {}
    void event(EventKind kind, double time, const State&) { seen.emplace_back(kind, time); }
  };
  const double g = standard_gravity, level = 0.1 * g, speed = 1, fall = 0.5;
  State state = State::at(0, speed);
  state.in_flight = true;
  state.gap_velocity = -fall;
  Kinds kinds;
  advance(Slider(Coulomb(level)), LoadSegment{0.1, 0, 0, g, g}, state, kinds);
  REQUIRE(kinds.seen.size() == 1);
  CHECK(kinds.seen[0].first == EventKind::landing);
  CHECK(kinds.seen[0].second == 0);
  CHECK(!state.in_flight);
  CHECK(state.velocity == Approx(speed - 0.1 * fall - level * 0.1).epsilon(1e-14));
  // Without a rate either, it lands as soon as the ground presses on it.
  State resting = State::at(0, speed);
  resting.in_flight = true;
  advance(Slider(Coulomb(level)), LoadSegment{0.1, 0, 0, 0, g}, resting);
  CHECK(!resting.in_flight);
  CHECK(resting.velocity == Approx(speed - level * 0.05).epsilon(1e-14));
}
