// Derivatives of responses: reference values, differences of integrate, closed forms, refusals.
#include "stickslip/sliding/sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "stickslip/core.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;

namespace {

template <class Law>
Sensitivity derivative(const Slider<Law>& slider, const GroundMotion& motion, Parameter parameter,
                       const IntegrateOptions& options = {}) {
  return sensitivity(slider, motion, integrate(slider, motion, options), parameter);
}

GroundMotion with_vertical(double factor) {
  std::vector<double> up;
  for (int m = 0; m <= 400; ++m) up.push_back(factor * 2.5 * std::cos(0.5 * m + 0.2));
  return record_a().with_components({}, up);
}

/// The response with a parameter at a value.
using Answer = std::function<Response(double)>;

/// Central differences at two steps: the nearer one is off by a third of what they differ by, to leading order, and by
/// the round-off of the response over the step.
void check_differences(const Answer& answer, double at, double step, const Sensitivity& found) {
  const auto difference = [&](double h) {
    const Response above = answer(at + h), below = answer(at - h);
    REQUIRE(above.events.size() == below.events.size());  // else a decision changes within the step
    return Sensitivity{(above.peak - below.peak) / (2 * h), (above.residual - below.residual) / (2 * h),
                       (above.velocity.back() - below.velocity.back()) / (2 * h)};
  };
  const Sensitivity near = difference(step / 2), far = difference(step);
  const Response r = answer(at);
  const double round_off = 1e-12 / step;
  CHECK(std::abs(found.peak - near.peak) <= std::abs(far.peak - near.peak) + round_off * r.peak);
  CHECK(std::abs(found.residual - near.residual) <= std::abs(far.residual - near.residual) + round_off * r.peak);
  CHECK(std::abs(found.velocity - near.velocity) <= std::abs(far.velocity - near.velocity) + round_off);
}

}  // namespace

TEST_CASE("derivatives by the levels are those of the reference", "[sensitivity]") {
  // next_values.json H; the record is rounded to doubles, which its response shows with 1e-13.
  const Sensitivity coulomb = derivative(Slider(Coulomb(1)), record_a(), Parameter::slip_level);
  CHECK(std::abs(coulomb.residual - 0.0369442211152422060947586) < 1e-11);
  CHECK(std::abs(coulomb.velocity - 0.2826502237287907562626829) < 1e-11);

  const Sensitivity kinetic = derivative(Slider(StaticKinetic(Coulomb(1), 1.3)), record_a(), Parameter::kinetic);
  CHECK(std::abs(kinetic.residual - -0.005800506449603001092489243) < 1e-11);
  CHECK(std::abs(kinetic.velocity - 0.2820330604952225279172446) < 1e-11);

  const Slider stopped(Coulomb(0.5), {.stops = Stops(0.1, 0.7)});
  const Sensitivity stops = derivative(stopped, record_a(), Parameter::slip_level);
  CHECK(std::abs(stops.residual - 0.02719720013980316472404459) < 1e-9);
  CHECK(std::abs(stops.velocity - 0.1273957726095713824050136) < 1e-9);
  CHECK(stops.peak == 0);  // at a stop

  const Sensitivity damped = derivative(Slider(Coulomb(1), 5, 1), record_a(), Parameter::slip_level);
  CHECK(std::abs(damped.residual - 0.05566782222475651241968373) < 1e-11);
  CHECK(std::abs(damped.velocity - 0.4190548807616716596707476) < 1e-11);
  CHECK(std::abs(damped.peak - -0.06605024081606075327844513) < 1e-11);
}

TEST_CASE("derivatives are the limits of differences", "[sensitivity]") {
  const GroundMotion quake = record_a(), shaken = with_vertical(1);
  SECTION("by the level") {
    check_differences([&](double a) { return integrate(Coulomb(a), quake); }, 1, 1e-4,
                      derivative(Slider(Coulomb(1)), quake, Parameter::slip_level));
    check_differences([&](double a) { return integrate(Slider(Coulomb(a), 2), shaken); }, 1, 1e-4,
                      derivative(Slider(Coulomb(1), 2), shaken, Parameter::slip_level));
  }
  SECTION("by static and kinetic levels, with a spring and a damper") {
    const auto slider = [](double held, double slides) { return Slider(StaticKinetic(Coulomb(slides), held), 5, 0.7); };
    check_differences([&](double a) { return integrate(slider(a, 0.8), quake); }, 1.3, 1e-5,
                      derivative(slider(1.3, 0.8), quake, Parameter::static_level));
    check_differences([&](double a) { return integrate(slider(1.3, a), quake); }, 0.8, 1e-5,
                      derivative(slider(1.3, 0.8), quake, Parameter::kinetic));
    check_differences([&](double d) { return integrate(slider(1.3 + d, 0.8 + d), quake); }, 0, 1e-5,
                      derivative(slider(1.3, 0.8), quake, Parameter::slip_level));
    check_differences([&](double f) { return integrate(slider(1.3, 0.8), quake.scaled(f)); }, 1, 1e-5,
                      derivative(slider(1.3, 0.8), quake, Parameter::scale));
  }
  SECTION("by the spring and the damper") {
    for (const double c : {0.0, 0.5, 4.0, 9.0}) {  // also critically damped and above
      INFO(c);
      const auto slider = [&](double wn, double damping) { return Slider(Coulomb(0.6), wn, damping); };
      check_differences([&](double wn) { return integrate(slider(wn, c), quake); }, 2, 1e-4,
                        derivative(slider(2, c), quake, Parameter::natural_frequency));
      if (c > 0)
        check_differences([&](double d) { return integrate(slider(2, d), quake); }, c, 1e-4,
                          derivative(slider(2, c), quake, Parameter::damping));
    }
    check_differences([&](double d) { return integrate(Slider(Coulomb(0.6), 0, d), quake); }, 1, 1e-4,
                      derivative(Slider(Coulomb(0.6), 0, 1), quake, Parameter::damping));
    check_differences([&](double wn) { return integrate(Slider(Coulomb(0.3), wn), shaken); }, 40, 1e-4,
                      derivative(Slider(Coulomb(0.3), 40), shaken, Parameter::natural_frequency));
  }
  SECTION("by the slope and the scale, under vertical motion") {
    const auto slider = [&](double degrees) { return Slider(Coulomb(4), {.slope_degrees = degrees, .one_way = true}); };
    check_differences([&](double degrees) { return integrate(slider(degrees), shaken); }, 20, 1e-4,
                      derivative(slider(20), shaken, Parameter::slope));
    check_differences([&](double f) { return integrate(slider(20), shaken.scaled(f)); }, 1, 1e-5,
                      derivative(slider(20), shaken, Parameter::scale));
  }
  SECTION("with stops that take all speed") {
    const auto slider = [&](double a) { return Slider(Coulomb(a), {.stops = Stops(0.1, 0)}); };
    check_differences([&](double a) { return integrate(slider(a), quake); }, 0.5, 1e-6,
                      derivative(slider(0.5), quake, Parameter::slip_level));
  }
  SECTION("without contact, clipped") {
    IntegrateOptions clipped;
    clipped.contact = Contact::clipped;
    const GroundMotion strong = with_vertical(5);
    check_differences([&](double a) { return integrate(Coulomb(a), strong, clipped); }, 1, 1e-5,
                      derivative(Slider(Coulomb(1)), strong, Parameter::slip_level, clipped));
  }
  SECTION("of held values, to the final rest") {
    IntegrateOptions settle;
    settle.settle = true;
    const GroundMotion held = record_a(Interpolation::constant);
    const auto slider = [](double a) { return Slider(StaticKinetic(Coulomb(a), 1.3 * a), 1); };
    check_differences([&](double a) { return integrate(slider(a), held, settle); }, 0.8, 1e-5,
                      [&] {
                        const Sensitivity one = derivative(slider(0.8), held, Parameter::kinetic, settle),
                                          other = derivative(slider(0.8), held, Parameter::static_level, settle);
                        return Sensitivity{one.peak + 1.3 * other.peak, one.residual + 1.3 * other.residual,
                                           one.velocity + 1.3 * other.velocity};
                      }());
  }
}

TEST_CASE("without vertical motion the derivatives of a pendulum are those of a spring", "[sensitivity]") {
  const GroundMotion quake = record_a();
  for (const double c : {0.0, 0.7})
    for (const Parameter parameter :
         {Parameter::slip_level, Parameter::static_level, Parameter::natural_frequency, Parameter::scale}) {
      const StaticKinetic law(Coulomb(0.5), 0.6);
      const Sensitivity spring = derivative(Slider(law, 2, c), quake, parameter);
      const Sensitivity pendulum =
          derivative(Slider(law, {.natural_frequency = 2, .damping = c, .pendulum = true}), quake, parameter);
      CHECK(pendulum.peak == Approx(spring.peak).epsilon(1e-9).margin(1e-11));
      CHECK(pendulum.residual == Approx(spring.residual).epsilon(1e-9).margin(1e-11));
      CHECK(pendulum.velocity == Approx(spring.velocity).epsilon(1e-9).margin(1e-11));
    }
}

TEST_CASE("derivatives of a pendulum whose weight varies are the limits of differences", "[sensitivity]") {
  IntegrateOptions clipped;
  clipped.contact = Contact::clipped;
  for (const double factor : {1.0, 2.5, 5.0}) {  // at 5 the normal force reaches zero
    const GroundMotion shaken = with_vertical(factor);
    const auto slider = [](double level, double held, double wn, double c, double degrees) {
      return Slider(StaticKinetic(Coulomb(level), held),
                    {.natural_frequency = wn, .damping = c, .slope_degrees = degrees, .pendulum = true});
    };
    const auto answer = [&](auto make) { return [=](double at) { return integrate(make(at), shaken, clipped); }; };
    const auto check = [&](auto make, double at, Parameter parameter) {
      check_differences(answer(make), at, 1e-5, derivative(make(at), shaken, parameter, clipped));
    };
    check([&](double a) { return slider(a, 0.7, 2.5, 0, 0); }, 0.5, Parameter::kinetic);
    check([&](double a) { return slider(0.5, a, 2.5, 0, 0); }, 0.7, Parameter::static_level);
    check([&](double wn) { return slider(0.5, 0.5, wn, 0, 0); }, 2.5, Parameter::natural_frequency);
    check([&](double c) { return slider(0.5, 0.5, 2.5, c, 0); }, 0.6, Parameter::damping);
    check([&](double degrees) { return slider(0.5, 0.6, 2.5, 0.3, degrees); }, 5, Parameter::slope);
    check_differences([&](double f) { return integrate(slider(0.5, 0.7, 2.5, 0.3, 0), shaken.scaled(f), clipped); }, 1,
                      1e-5, derivative(slider(0.5, 0.7, 2.5, 0.3, 0), shaken, Parameter::scale, clipped));
  }
}

TEST_CASE("the derivative of a rebound that reverses is known", "[sensitivity]") {
  // Under a load of 3 m/s^2 against 1 m/s^2 it hits a stop, rebounds against their sum, and turns round before the end.
  const double gap = 0.1, e = 0.5, end = 0.4, forward = 2, backward = 4;
  const double hit = std::sqrt(2 * gap / forward), speed = e * forward * hit;
  const double turn = hit + speed / backward;
  REQUIRE(turn < end);
  const auto derivatives = [&](double d_forward, double d_backward) {  // by a change of the two accelerations
    const double d_hit = -hit / (2 * forward) * d_forward, d_speed = speed / (2 * forward) * d_forward;
    const double d_turn = d_hit + d_speed / backward - speed / (backward * backward) * d_backward;
    const double d_turned_at = -speed * d_speed / backward + speed * speed / (2 * backward * backward) * d_backward;
    const double rest = end - turn;
    return Sensitivity{0, d_turned_at + d_forward * rest * rest / 2 - forward * rest * d_turn,
                       d_forward * rest - forward * d_turn};
  };
  const Slider slider(Coulomb(1), {.stops = Stops(gap, e)});
  const GroundMotion motion = line(-3, -3, end);
  for (const auto& [parameter, expected] :
       {std::pair{Parameter::slip_level, derivatives(-1, 1)}, std::pair{Parameter::scale, derivatives(3, 3)}}) {
    const Sensitivity found = derivative(slider, motion, parameter);
    CHECK(found.residual == Approx(expected.residual).epsilon(1e-12));
    CHECK(found.velocity == Approx(expected.velocity).epsilon(1e-12));
    CHECK(found.peak == 0);
  }
}

TEST_CASE("derivatives between stops are the limits of differences", "[sensitivity]") {
  std::mt19937_64 bits(20);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto between = [&](double low, double high) { return low + (high - low) * uniform(bits); };
  int compared = 0, reversed = 0;
  for (int problem = 0; problem < 400; ++problem) {
    CAPTURE(problem);
    std::vector<double> n(8);
    for (double& value : n) value = between(-4, 4);
    const GroundMotion motion(n, 0.2);
    const bool sprung = uniform(bits) < 0.3, damped = uniform(bits) < 0.3, held = uniform(bits) < 0.3;
    const double level = between(0.3, 1.5), static_level = level * (held ? between(1, 1.4) : 1);
    const Mounting mounting{.natural_frequency = sprung ? between(1, 6) : 0,
                            .damping = damped ? between(0.1, 2) : 0,
                            .stops = Stops(between(0.02, 0.1), between(0.02, 0.1), between(0.1, 0.95))};
    const bool by_level = uniform(bits) < 0.5;
    const auto slider = [&](double change) {
      return Slider(StaticKinetic(Coulomb(level + change), static_level + change), mounting);
    };
    const auto answer = [&](double change) {
      return by_level ? integrate(slider(change), motion) : integrate(slider(0), motion.scaled(1 + change));
    };
    const Response r = answer(0);
    // Differences are of use where all have the same events, and their error shrinks as the square of the step.
    const double h = 1e-6;
    const Response responses[] = {answer(h / 2), answer(-h / 2), answer(h), answer(-h)};
    const bool same = std::ranges::all_of(responses, [&](const Response& other) {
      return std::ranges::equal(r.events, other.events, {}, &Event::kind, &Event::kind);
    });
    if (!same || std::ranges::count(r.events, EventKind::impact, &Event::kind) == 0) continue;
    const auto difference = [&](std::size_t i, auto value) {
      return (value(responses[i]) - value(responses[i + 1])) / (i == 0 ? h : 2 * h);
    };
    const auto residual = [](const Response& one) { return one.residual; };
    const auto velocity = [](const Response& one) { return one.state.velocity; };
    const double near_x = difference(0, residual), far_x = difference(2, residual);
    const double near_v = difference(0, velocity), far_v = difference(2, velocity);
    const double scale = 1 + std::abs(near_x) + std::abs(near_v), allowed = 1e-6 * scale;
    if (std::abs(far_x - near_x) + std::abs(far_v - near_v) > allowed) continue;  // nearly a graze
    const Sensitivity found = sensitivity(slider(0), motion, r, by_level ? Parameter::slip_level : Parameter::scale);
    CHECK(std::abs(found.residual - near_x) <= 2 * allowed);
    CHECK(std::abs(found.velocity - near_v) <= 2 * allowed);
    ++compared;
    for (std::size_t i = 1; i < r.events.size(); ++i)
      if (r.events[i].kind == EventKind::reversal && r.events[i - 1].kind == EventKind::impact &&
          r.events[i].time > r.events[i - 1].time) {
        ++reversed;  // a rebound that turned round
        break;
      }
  }
  CHECK(compared >= 200);
  CHECK(reversed >= 100);
}

TEST_CASE("derivatives follow the laws of scaling", "[sensitivity]") {
  // x is homogeneous of degree one in level and ground motion together, and without a spring x(a, f n) = f x(a / f, n).
  const GroundMotion quake = record_a();
  for (const double level : {0.5, 1.0, 1.7}) {
    const Slider slider(Coulomb(level), 1.5);
    const Response r = integrate(slider, quake);
    const Sensitivity a = sensitivity(slider, quake, r, Parameter::slip_level),
                      f = sensitivity(slider, quake, r, Parameter::scale);
    CHECK(std::abs(level * a.residual + f.residual - r.residual) < 1e-10 * r.peak);
    CHECK(std::abs(level * a.peak + f.peak - r.peak) < 1e-10 * r.peak);
    CHECK(std::abs(level * a.velocity + f.velocity - r.state.velocity) < 1e-10);
  }
}

TEST_CASE("the derivative of one slip is known", "[sensitivity]") {
  // Thrown at v against a it goes v^2 / (2 a).
  IntegrateOptions thrown;
  thrown.velocity = 2;
  const Sensitivity s = derivative(Slider(Coulomb(0.5)), held(0, 10), Parameter::slip_level, thrown);
  CHECK(s.residual == Approx(-8).epsilon(1e-13));
  CHECK(s.peak == Approx(-8).epsilon(1e-13));
  CHECK(s.velocity == 0);
  // At rest all the time.
  CHECK(derivative(Slider(Coulomb(9)), record_a(), Parameter::slip_level) == Sensitivity{});
}

TEST_CASE("what has no derivative is refused with the reason", "[sensitivity]") {
  const GroundMotion quake = record_a();
  const auto refused = [&](const auto& slider, const GroundMotion& motion, Parameter parameter, const char* reason) {
    CHECK_THROWS_WITH(derivative(slider, motion, parameter), ContainsSubstring(reason));
  };
  refused(Slider(Caster(1, 0.5)), quake, Parameter::slip_level, "covers Coulomb friction");
  refused(Slider(VelocityDependent(0.5, 1, 3)), quake, Parameter::slip_level, "covers Coulomb friction");
  refused(Slider(Coulomb(1)), quake, Parameter::static_level, "has one level for sliding and rest");
  refused(Slider(Coulomb(1)), quake, Parameter::natural_frequency, "without a spring");
  refused(Slider(Coulomb(1)), with_vertical(5), Parameter::slip_level, "must not leave the ground");
  refused(Slider(Coulomb(1)), quake, Parameter::radius, "only a MultiPendulum has surfaces");
}
