// One slider through one ground motion: histories, events, peak, energy, starts, settling, and hard input.
#include <stdexcept>
#include <utility>

#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;

namespace {

/// Runs `check` for a slider of each kind.
template <class Check>
void for_each_slider(Check check) {
  for (const double natural_frequency : {0.0, 1.3}) {
    check(Slider(Coulomb(1), natural_frequency));
    check(Slider(Coulomb(1, 1.6), natural_frequency));
    check(Slider(Coulomb(1, infinity), natural_frequency));
    check(Slider(Caster(1, 0.5), natural_frequency));
    check(Slider(Bump{1, 0.5}, natural_frequency));
  }
}

void same_up_to(double part, const Response& one, const Response& other, double length = 1, double time = 1) {
  CHECK(difference(one.displacement, [&] {
          std::vector<double> x = other.displacement;
          for (double& value : x) value /= length;
          return x;
        }()) <= part * one.peak);
  CHECK(std::abs(other.peak / length - one.peak) <= part * one.peak);
  REQUIRE(one.events.size() == other.events.size());
  double worst = 0;
  bool same = true;
  for (std::size_t i = 0; i < one.events.size(); ++i) {
    same = same && one.events[i].kind == other.events[i].kind;
    worst = std::max(worst, std::abs(other.events[i].time / time - one.events[i].time));
  }
  CHECK(same);
  // A stop at a slope a of the speed is known to a rounding of the speed over a; slopes down to 1e-3 occur.
  CHECK(worst <= 1e3 * part);
}

}  // namespace

TEST_CASE("nothing moves while the ground acceleration stays within the slip level", "[integrate]") {
  const GroundMotion strong = broadband(40, 1'000);
  const GroundMotion weak = strong.scaled(1 / strong.peak_acceleration() * (1 - 1e-15));
  for (const Response& r :
       {integrate(Coulomb(1), weak), integrate(Slider(Coulomb(1), 2), weak), integrate(Caster(1, 0.5), weak)}) {
    CHECK(largest(r.displacement) == 0);
    CHECK(largest(r.velocity) == 0);
    CHECK(r.peak == 0);
    CHECK(r.sliding_distance == 0);
    CHECK(r.time_sliding == 0);
    CHECK(r.energy.dissipated == 0);
    CHECK(r.events.size() == 1);
    CHECK(r.events[0].kind == EventKind::end);
    CHECK(r.events[0].time == weak.duration());
  }
}

TEST_CASE("ground that just reaches the slip level moves nothing", "[integrate][edge]") {
  // values.json edge.tangent_n_equals_a, edge.constant_n_equals_a_at_rest
  CHECK(integrate(Coulomb(1), GroundMotion({0, 1, 0}, 1)).events.size() == 1);
  CHECK(integrate(Coulomb(1), GroundMotion({1, 1, 1}, 1)).events.size() == 1);
  CHECK(integrate(Caster(1, 0.5), GroundMotion({0, 1, 0}, 1)).events.size() == 1);
  CHECK(integrate(Disguised{1}, GroundMotion({1, 1, 1}, 1)).events.size() == 1);
}

TEST_CASE("a push that just balances friction keeps a slider moving", "[integrate][edge]") {
  // values.json edge.constant_n_equals_minus_a_moving
  const auto keeps = [](const auto& law) {
    const Response r = integrate(law, GroundMotion({-1, -1, -1}, 1), from(0, 1));
    CHECK(r.residual == 2);
    CHECK(r.state.velocity == 1);
    CHECK(r.peak == 2);
    CHECK(count(r.events) == Counts{1, 0, 0});
  };
  keeps(Coulomb(1));
  keeps(Disguised{1});
}

TEST_CASE("a speed that touches zero goes on, or stays if nothing pushes it", "[integrate][edge]") {
  // values.json edge.graze_continue: v = (1 - t)^2; edge.graze_then_stick: from there on the push only balances
  // friction
  const auto grazes = [](const auto& law) {
    const Response on = integrate(law, line(1, -3, 2), from(0, 1));
    CHECK(std::abs(on.residual - 2.0 / 3) <= 1e-15);
    CHECK(std::abs(on.state.velocity - 1) <= 1e-15);
    const Response stays = integrate(law, GroundMotion({1, -1, -1}, 1), from(0, 1));
    CHECK(std::abs(stays.residual - 1.0 / 3) <= 1e-15);
    CHECK(stays.state.velocity == 0);
    CHECK(stays.state.mode == Mode::stuck);
    CHECK(count(stays.events) == Counts{1, 1, 0});
  };
  grazes(Coulomb(1));
  grazes(Disguised{1});
  CHECK(count(integrate(Coulomb(1), line(1, -3, 2), from(0, 1)).events) == Counts{1, 0, 0});
}

TEST_CASE("a stop exactly at a node is a stop", "[integrate][edge]") {
  // values.json edge.stop_exactly_at_node: v = 1, 2, 1, 0
  const auto stops = [](const auto& law) {
    const Response r = integrate(law, steps({-2, -2, 0, 0}));
    CHECK(r.velocity == std::vector<double>{0, 1, 2, 1, 0});
    CHECK(r.residual == 4);
    CHECK(r.state.mode == Mode::stuck);
    CHECK(count(r.events) == Counts{1, 1, 0});
  };
  stops(Coulomb(1));
  stops(Disguised{1});
}

TEST_CASE("unequal levels turn a steady shaking into a drift", "[integrate][edge]") {
  // values.json edge.asym_const (mpmath, 48 digits)
  const Response r = integrate(Coulomb(1, 1.6), steps({2, -2, 2, -2}));
  CHECK(std::abs(r.residual - 0.619350031329912445596030415418) <= 1e-15);
  CHECK(std::abs(r.state.velocity - 0.921810699588477366255144032922) <= 1e-15);
  CHECK(count(r.events) == Counts{1, 0, 3});
}

TEST_CASE("two reversals within one piece leave the reference's place and speed", "[integrate][edge]") {
  // values.json edge.two_reversals_one_segment (mpmath, 50 digits)
  const Response r = integrate(Coulomb(1), line(4, -6, 1), from(0, 0.02));
  CHECK(std::abs(r.residual - 0.01542150464203804175432394215294192359768) <= 1e-15);
  CHECK(std::abs(r.state.velocity - 1.203935482821959107268081822123250367044) <= 4e-15);
  CHECK(count(r.events) == Counts{1, 0, 2});
}

TEST_CASE("the energy ledger closes, whatever slides and however it starts", "[integrate]") {
  for_each_slider([](const auto& slider) {
    for (const auto& start : {from(0), from(0.4), from(-0.2, 1.5), from(0.1, 0.3)})
      for (const bool smooth : {false, true}) {
        const Response r = integrate(slider, broadband(41, 2'000, smooth), start);
        CHECK(std::abs(r.energy.imbalance()) <= 1e-12 * turnover(r.energy));
        CHECK(grammatical(r));
        CHECK(r.peak >= largest(r.displacement));
        CHECK(r.sliding_distance >= (r.peak - std::abs(start.displacement)) * (1 - 1e-13));
      }
  });
}

TEST_CASE("the peak is at a zero of the velocity: finer samples never pass it", "[integrate]") {
  for_each_slider([](const auto& slider) {
    const GroundMotion coarse = broadband(42, 200);
    std::vector<double> fine;
    for (std::size_t i = 0; i < coarse.segments(); ++i)
      for (int k = 0; k < 32; ++k)
        fine.push_back(coarse.segment(i).start + (coarse.segment(i).end - coarse.segment(i).start) * k / 32);
    fine.push_back(coarse.acceleration().back());
    const Response one = integrate(slider, coarse), many = integrate(slider, GroundMotion(fine, 0.1 / 32));
    CHECK(largest(many.displacement) <= one.peak * (1 + 1e-12));
    CHECK(std::abs(one.peak - many.peak) <= 1e-12 * one.peak);
    CHECK(std::abs(one.residual - many.residual) <= 1e-12 * one.peak);
    CHECK(count(one.events) == count(many.events));
  });
}

TEST_CASE("a stronger ground on a stronger friction moves farther in the same time", "[integrate]") {
  // Thesis (4.26): all accelerations and lengths times c. A power of two leaves every bit; any other rounds anew.
  const GroundMotion motion = broadband(43, 500);
  for (const double frequency : {0.0, 1.3})
    for (const double c : {0x1p-40, 4.0, 3.0, 0.1}) {
      const double part = std::exp2(std::rint(std::log2(c))) == c ? 0 : 1e-12;
      same_up_to(part, integrate(Slider(Coulomb(1, 1.5), frequency), motion),
                 integrate(Slider(Coulomb(c, 1.5 * c), frequency), motion.scaled(c)), c);
      same_up_to(part, integrate(Slider(Caster(1, 0.5), frequency), motion),
                 integrate(Slider(Caster(c, 0.5 * c), frequency), motion.scaled(c)), c);
    }
}

TEST_CASE("a slower ground moves a slider farther by the square of the time", "[integrate]") {
  const std::vector<double> n = gaussian(44, 500, 2);
  for (const double frequency : {0.0, 1.3})
    for (const double c : {8.0, 0x1p-30, 3.0}) {
      const double part = c == 3 ? 1e-12 : 0;
      same_up_to(part, integrate(Slider(Coulomb(1, 1.5), frequency), GroundMotion(n, 0.125)),
                 integrate(Slider(Coulomb(1, 1.5), frequency / c), GroundMotion(n, 0.125 * c)), c * c, c);
      same_up_to(part, integrate(Slider(Caster(1, 0.5), frequency), GroundMotion(n, 0.125)),
                 integrate(Slider(Caster(1, 0.5 * c * c), frequency / c), GroundMotion(n, 0.125 * c)), c * c, c);
    }
}

TEST_CASE("left alone, a block stops after v^2 / 2a", "[integrate][settle]") {
  for (const double v : {1e-3, 1.0, 250.0}) {
    const Response r = integrate(Coulomb(2), held(0, 0.01), from(1, v, true));
    CHECK(std::abs(r.residual - (1 + v * v / 4)) <= 4e-16 * r.peak * 2);
    CHECK(r.state.mode == Mode::stuck);
    CHECK(std::abs(r.events.back().time - std::max(0.01, v / 2)) <= 1e-15 * (1 + v) * 2);
    CHECK(r.events.back().kind == EventKind::end);
    CHECK(r.peak == r.residual);
    CHECK(std::abs(r.energy.imbalance()) <= 1e-14 * r.energy.initial);
  }
  const Response rest = integrate(Coulomb(2), held(0, 3), from(1, 0, true));
  CHECK(rest.events.size() == 1);
  CHECK(rest.events[0].time == 3);
}

TEST_CASE("while it settles the samples continue, up to the first at or after rest", "[integrate][settle]") {
  const GroundMotion motion = record_a();
  const Response plain = integrate(Coulomb(1), motion), settled = integrate(Coulomb(1), motion, from(0, 0, true));
  const std::size_t n = motion.samples();
  const double x = plain.state.displacement, v = plain.state.velocity, h = motion.dt();
  CHECK(plain.displacement.size() == n);
  CHECK(std::equal(plain.displacement.begin(), plain.displacement.end(), settled.displacement.begin()));
  CHECK(std::equal(plain.velocity.begin(), plain.velocity.end(), settled.velocity.begin()));
  CHECK(std::abs(settled.residual - (x + v * std::abs(v) / 2)) <= 1e-15);
  CHECK(settled.state.mode == Mode::stuck);
  CHECK(settled.events.size() == plain.events.size() + 1);
  CHECK(grammatical(settled));

  REQUIRE(settled.displacement.size() == n + static_cast<std::size_t>(std::ceil(std::abs(v) / h)));
  REQUIRE(settled.velocity.size() == settled.displacement.size());
  CHECK_FALSE(settled.truncated);
  CHECK(settled.displacement.back() == settled.residual);
  CHECK(settled.velocity.back() == 0);
  for (std::size_t i = n; i + 1 < settled.displacement.size(); ++i) {
    const double t = h * static_cast<double>(i - n + 1), a = std::copysign(1, v);
    CHECK(std::abs(settled.velocity[i] - (v - a * t)) <= 1e-15);
    CHECK(std::abs(settled.displacement[i] - (x + v * t - a * t * t / 2)) <= 1e-15);
  }
}

TEST_CASE("samples after the end follow the last step of the motion", "[integrate][settle]") {
  const GroundMotion even({0, 6, 6, 6}, 0.1), uneven({0, 6, 6, 6}, {0, 0.1, 0.2, 0.3});
  const GroundMotion held({0, 6, 6, 0, 0}, {0, 0.1, 0.2, 0.3, 0.3}, Interpolation::constant);
  for (const GroundMotion* motion : {&even, &uneven, &held}) {
    const Response r = integrate(Coulomb(0.05 * standard_gravity), *motion, from(0, 0, true));
    const double rest = r.events.back().time;
    const std::size_t last = r.displacement.size() - 1;
    CHECK(motion->time(last) >= rest);
    CHECK(motion->time(last - 1) < rest);
    CHECK(std::abs(motion->time(last) - motion->time(last - 1) - 0.1) <= 1e-15);
    CHECK(r.displacement.back() == r.residual);
    CHECK_FALSE(r.truncated);
  }
}

TEST_CASE("samples end at ten times the length of the motion, and the response says so", "[integrate][settle]") {
  const Response r = integrate(Coulomb(0.01), held(0, 1), from(0, 3, true));  // rests after 300 s
  CHECK(r.truncated);
  CHECK(r.displacement.size() == 20);
  CHECK(r.velocity.back() == Approx(3 - 0.01 * 19));
  CHECK(r.residual == Approx(450));
  CHECK(r.events.back().time == Approx(300));
  const Response whole = integrate(Coulomb(0.2), held(0, 1), from(0, 3, true));  // after 15 s
  CHECK_FALSE(whole.truncated);
  CHECK(whole.displacement.size() == 16);
  CHECK_FALSE(
      integrate(Coulomb(0.01), held(0, 1), from(0, 3, false), integrate(Coulomb(0.01), held(0, 1), from(0, 3, true)))
          .truncated);
}

TEST_CASE("what can not settle says so", "[integrate][settle][errors]") {
  CHECK_THROWS_AS(integrate(Coulomb(0), held(0, 1), from(0, 1, true)), ConvergenceError);
  CHECK_THROWS_WITH(integrate(Coulomb(0), held(0, 1), from(0, 1, true)),
                    ContainsSubstring("does not come to rest") && ContainsSubstring("settle = false"));
  CHECK_THROWS_AS(integrate(Slider(Coulomb(0), 1), held(0, 1), from(1, 0, true)), ConvergenceError);
}

TEST_CASE("a motion may be continued from the state it left", "[integrate]") {
  const std::vector<double> n = gaussian(45, 401, 2);
  const Response whole = integrate(Coulomb(1), GroundMotion(n, 0.1));
  const Response first = integrate(Coulomb(1), GroundMotion({n.begin(), n.begin() + 201}, 0.1));
  const Response second = integrate(Coulomb(1), GroundMotion({n.begin() + 200, n.end()}, 0.1),
                                    from(first.state.displacement, first.state.velocity));
  CHECK(second.residual == whole.residual);
  CHECK(second.state.velocity == whole.state.velocity);
}

TEST_CASE("times count from the motion's own beginning", "[integrate]") {
  const GroundMotion late({-2, 0, 0}, {100, 101, 110}, Interpolation::constant);
  const Response r = integrate(Coulomb(1), late, from(0, 1));
  REQUIRE(r.events.size() == 3);
  CHECK(r.events[0].time == 100);
  CHECK(r.events[1].time == 103);  // v = 1, 2, then down by 1 a second
  CHECK(r.events[2].time == 110);
  CHECK(r.time_sliding == 3);
  CHECK(r.sliding_distance == 3.5);
}

TEST_CASE("integrate names the arguments that it rejects", "[integrate][errors]") {
  const GroundMotion motion = held(0, 1);
  CHECK_THROWS_WITH(integrate(Coulomb(1), motion, from(not_a_number)),
                    "integrate: displacement must be finite, got nan m");
  CHECK_THROWS_WITH(integrate(Coulomb(1), motion, from(0, infinity)),
                    "integrate: velocity must be finite, got inf m/s");
  CHECK_THROWS_WITH(integrate(Coulomb(1, infinity), motion, from(0, -2)),
                    "integrate: velocity must not point where the slip level is infinite, got -2 m/s");
  CHECK_NOTHROW(integrate(Coulomb(1, infinity), motion, from(0, 2)));
  CHECK_THROWS_AS(integrate(Coulomb(1), motion, from(infinity)), std::invalid_argument);
}

TEST_CASE("in the memory of another response the answer is the same to the bit", "[integrate]") {
  const Slider slider(Coulomb(1, 1.6), 1.3);
  const GroundMotion motion = broadband(47, 300);
  const Response fresh = integrate(slider, motion);
  for (const int pieces : {10, 300, 1000}) {
    Response used = integrate(Coulomb(0.1), broadband(48, pieces));
    const Response reused = integrate(slider, motion, {}, std::move(used));
    CHECK(reused.displacement == fresh.displacement);
    CHECK(reused.velocity == fresh.velocity);
    CHECK(reused.events.size() == fresh.events.size());
    CHECK(reused.peak == fresh.peak);
    CHECK(reused.sliding_distance == fresh.sliding_distance);
    CHECK(reused.energy.imbalance() == fresh.energy.imbalance());
  }
}

TEST_CASE("a progress callback is felt, and may end the work", "[integrate]") {
  IntegrateOptions options;
  int calls = 0;
  options.progress = [&] { ++calls; };
  const GroundMotion calm(std::vector<double>(200'001, 0.0), 0.01);
  integrate(Coulomb(1), calm, options);
  CHECK(calls == 12);  // 16,384 segments each
  options.progress = [] { throw std::runtime_error("enough"); };
  CHECK_THROWS_WITH(integrate(Coulomb(1), calm, options), "enough");
}

TEST_CASE("a progress callback is felt within one segment, and more events than anyone can use are refused",
          "[integrate]") {
  // 1e6 s at 50 rad/s under a growing load: a reversal or a graze every 63 ms.
  const Slider slider(Coulomb(0.001), 50);
  IntegrateOptions options{.displacement = 1e6};
  CHECK_THROWS_WITH(integrate(slider, held(0, 1e6), options), ContainsSubstring("more than 1000008 events"));
  int calls = 0;
  options.progress = [&] {
    if (++calls == 3) throw std::runtime_error("enough");
  };
  CHECK_THROWS_WITH(integrate(slider, held(0, 1e6), options), "enough");
}

TEST_CASE("tiny accelerations move a slider with a tiny slip level just as far in proportion", "[integrate][range]") {
  const GroundMotion motion = broadband(46, 300);
  for (const double c : {1e-300, 1e-150, 1e99}) {
    INFO("scale " << c);
    for (const double frequency : {0.0, 1.3}) {
      same_up_to(1e-10, integrate(Slider(Coulomb(1, 1.5), frequency), motion),
                 integrate(Slider(Coulomb(c, 1.5 * c), frequency), motion.scaled(c)), c);
    }
    if (c > 1e-290) {
      same_up_to(1e-10, integrate(Caster(1, 0.5), motion), integrate(Caster(c, 0.5 * c), motion.scaled(c)), c);
    }
  }
  CHECK(integrate(Coulomb(1), motion.scaled(1e-300)).peak == 0);
}

TEST_CASE("what leaves the range of doubles is an error, not a NaN", "[integrate][range]") {
  const auto right_or_refused = [](const auto& slider, const GroundMotion& motion) {
    try {
      const Response r = integrate(slider, motion);
      CHECK(std::isfinite(r.peak));
      CHECK(std::isfinite(r.energy.imbalance()));
      CHECK(std::isfinite(largest(r.displacement)));
      CHECK(grammatical(r));
    } catch (const std::overflow_error& error) {
      CHECK_THAT(error.what(), ContainsSubstring("range of doubles"));
    } catch (const ConvergenceError& error) {
      CHECK_THAT(error.what(), ContainsSubstring("power series"));
    }
  };
  for (const double n : {1e99, 1e100, 1e-300})
    for (const double dt : {1e-9, 1.0, 1e60, 1e200}) {
      const GroundMotion motion({n, -n, 2 * n / 3, -n / 5}, dt);
      for (const double frequency : {0.0, 1e-160, 1.0, 1e150}) {
        if (frequency * dt > 1e3) continue;  // more swings than can be followed one by one
        right_or_refused(Slider(Caster(1, 0.5), frequency), motion);
        right_or_refused(Slider(Coulomb(1, 2), frequency), motion);
      }
    }
}

TEST_CASE("a spring too stiff for a Taylor series is refused", "[integrate][range][errors]") {
  // 1e150 rad/s for 0.1 s: steps would be shorter than 2^-200 of the segment.
  CHECK_THROWS_AS(integrate(Slider(Caster(1, 0.5), 1e150), record_a()), ConvergenceError);
}

TEST_CASE("a million samples a nanosecond apart are a millisecond", "[integrate][range]") {
  // n = -3 with a = 1 from rest: x = t^2, v = 2 t; each of a million steps rounds both: 1e6 * 1.1e-16 at most.
  const Response r = integrate(Coulomb(1), GroundMotion(std::vector<double>(1'000'001, -3.0), 1e-9));
  CHECK(std::abs(r.residual - 1e-6) <= 2.2e-10 * 1e-6);
  CHECK(std::abs(r.state.velocity - 2e-3) <= 1.1e-10 * 2e-3);
  CHECK(r.events.size() == 2);
  CHECK(std::abs(r.time_sliding - 1e-3) <= 1.1e-10 * 1e-3);
}

TEST_CASE("events are in order of time also where segments meet", "[integrate]") {
  // A velocity that comes to zero at the end of a segment: i dt + dt is one rounding above (i + 1) dt.
  for (const std::vector<double>& tail : {std::vector<double>{-2, 0, -2, 0}, std::vector<double>{-2, 0, 0}}) {
    std::vector<double> n(11, 0.0);
    n.insert(n.end(), tail.begin(), tail.end());
    const GroundMotion motion(n, 0.1, Interpolation::constant);
    const Response r = integrate(Coulomb(1), motion);
    CHECK(grammatical(r));
    REQUIRE(r.events.size() == tail.size());
    CHECK(r.events[1].kind == EventKind::arrest);
    CHECK(r.events[1].time == motion.time(13));
    CHECK(r.events.back().time == motion.time(motion.segments()));
  }
}

TEST_CASE("an event loop whose slips underflow still counts, and ends", "[integrate][range]") {
  const GroundMotion ramps({-5e-324, 100, 0}, 0.1);
  const auto went_back = [](const Response& r) {
    CHECK(grammatical(r));
    REQUIRE(r.events.size() == 3);
    CHECK(r.events[1].kind == EventKind::reversal);
    CHECK(r.events[1].time == 0);
    CHECK(r.residual < -0.99);
  };
  went_back(integrate(Slider(Coulomb(0), 1), ramps));
  went_back(integrate(Coulomb(0), ramps));
  went_back(integrate(Caster(0, 1), ramps));
}

TEST_CASE("a slow spring that friction nearly balances comes to rest within its first cycle") {
  // Its energy is that of where it will rest: what it loses in hours is a tiny part of it.
  const double wn = 1e-6, level = 0.5, far = 0.99 * level / (wn * wn);
  IntegrateOptions options;
  options.displacement = -far;
  options.velocity = 0.005;
  options.settle = true;
  const Response r = integrate(Slider(Coulomb(level), wn), GroundMotion({0, 0}, 0.01), options);
  CHECK(r.state.mode == Mode::stuck);
  // Friction exceeds the pull by a hundredth: it goes on over v^2 / (2 level / 100), within the resolution of x.
  CHECK(r.residual + far == Approx(0.005 * 0.005 / (0.02 * level)).margin(2e-4));
}
