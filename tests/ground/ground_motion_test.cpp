// Ground motions: what they hold, and what they refuse.
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;

TEST_CASE("a motion knows its samples, times and pieces", "[ground_motion]") {
  const GroundMotion motion({1, -3, 2}, 0.5, Interpolation::linear, "Tolmezzo");
  CHECK(motion.samples() == 3);
  CHECK(motion.segments() == 2);
  CHECK(motion.dt() == 0.5);
  CHECK(motion.time(2) == 1);
  CHECK(motion.duration() == 1);
  CHECK(motion.name() == "Tolmezzo");
  CHECK(motion.peak_acceleration() == 3);
  CHECK(motion.acceleration()[1] == -3);
  const Segment last = motion.segment(1);
  CHECK((last.duration == 0.5 && last.start == -3 && last.end == 2));
}

TEST_CASE("held values act until the next time, and the last one never", "[ground_motion]") {
  const GroundMotion motion({1, -3, 20}, {0.5, 1, 3}, Interpolation::constant);
  CHECK(std::isnan(motion.dt()));
  CHECK(motion.duration() == 2.5);
  CHECK(motion.peak_acceleration() == 3);
  const Segment last = motion.segment(1);
  CHECK((last.duration == 2 && last.start == -3 && last.end == -3));
}

TEST_CASE("a scaled motion is the same but for the factor", "[ground_motion]") {
  const GroundMotion motion({1, -3, 2}, {0, 1, 5}, Interpolation::linear, "name");
  const GroundMotion mirrored = motion.scaled(-2);
  CHECK(mirrored.acceleration()[1] == 6);
  CHECK(mirrored.time(2) == 5);
  CHECK(mirrored.name() == "name");
  CHECK(motion.acceleration()[1] == -3);
}

TEST_CASE("motions are equal where all of them is the same", "[ground_motion]") {
  const std::vector<double> samples{1, -3, 2};
  const std::vector<GroundMotion> motions{{samples, 0.5},
                                          {samples, 0.25},
                                          {samples, 0.5, Interpolation::constant},
                                          {samples, 0.5, Interpolation::linear, "name"},
                                          {samples, {0, 0.5, 1}},
                                          {samples, {0, 0.5, 2}},
                                          {{1, -3, 4}, 0.5}};
  for (const GroundMotion& a : motions)
    for (const GroundMotion& b : motions) CHECK((a == b) == (&a == &b));
  CHECK(motions[4] == GroundMotion(samples, {0, 0.5, 1}));
}

TEST_CASE("a motion needs two samples", "[ground_motion][errors]") {
  CHECK_THROWS_WITH(GroundMotion({}, 0.01), "GroundMotion: needs at least two samples, got 0");
  CHECK_THROWS_WITH(GroundMotion({1}, 0.01), "GroundMotion: needs at least two samples, got 1");
  CHECK_THROWS_WITH(GroundMotion(std::vector<double>{1}, std::vector<double>{0}),
                    "GroundMotion: needs at least two samples, got 1");
  CHECK_THROWS_AS(GroundMotion({}, 0.01), std::invalid_argument);
}

TEST_CASE("samples must be finite and within 1e100", "[ground_motion][errors]") {
  const std::string rule = " must be finite and at most 1e100 m/s^2 in magnitude, got ";
  CHECK_THROWS_WITH(GroundMotion({1, 2, not_a_number}, 0.01), "GroundMotion: acceleration[2]" + rule + "nan m/s^2");
  CHECK_THROWS_WITH(GroundMotion({1, infinity}, 0.01), "GroundMotion: acceleration[1]" + rule + "inf m/s^2");
  CHECK_THROWS_WITH(GroundMotion({-infinity, 0}, 0.01), "GroundMotion: acceleration[0]" + rule + "-inf m/s^2");
  CHECK_THROWS_WITH(GroundMotion({0, 1e300}, 0.01), "GroundMotion: acceleration[1]" + rule + "1e+300 m/s^2");
  CHECK_NOTHROW(GroundMotion({-1e100, 1e100}, 0.01));
  CHECK_THROWS_WITH(GroundMotion({1, 2}, 0.01).scaled(1e100), "GroundMotion: acceleration[1]" + rule + "2e+100 m/s^2");
  CHECK_THROWS_WITH(GroundMotion({1, 2}, 0.01).scaled(not_a_number),
                    "GroundMotion: a scale factor must be finite, got nan");
}

TEST_CASE("the time between samples must be positive and finite", "[ground_motion][errors]") {
  CHECK_THROWS_WITH(GroundMotion({1, 2}, -0.01), "GroundMotion: dt must be positive and finite, got -0.01 s");
  CHECK_THROWS_WITH(GroundMotion({1, 2}, 0), "GroundMotion: dt must be positive and finite, got 0 s");
  CHECK_THROWS_WITH(GroundMotion({1, 2}, not_a_number), "GroundMotion: dt must be positive and finite, got nan s");
  CHECK_THROWS_WITH(GroundMotion({1, 2}, infinity), "GroundMotion: dt must be positive and finite, got inf s");
  CHECK_THROWS_WITH(GroundMotion({1, 2, 3}, 1e308), "GroundMotion: its duration must be finite, got inf s");
}

TEST_CASE("times must be as many as samples, finite, and go on", "[ground_motion][errors]") {
  CHECK_THROWS_WITH(GroundMotion({1, 2, 3}, {0, 1}),
                    "GroundMotion: needs as many times as samples, got 2 times for 3 samples");
  CHECK_THROWS_WITH(GroundMotion({1, 2, 3}, {0, 1, not_a_number}),
                    ContainsSubstring("times[2] must be finite, got nan s"));
  CHECK_THROWS_WITH(GroundMotion({1, 2, 3}, {0, 1, infinity}), ContainsSubstring("times[2] must be finite, got inf s"));
  CHECK_THROWS_WITH(GroundMotion({1, 2, 3}, {0, 2, 1}),
                    ContainsSubstring("must increase") && ContainsSubstring("times[2]") &&
                        ContainsSubstring("after 2 s") && ContainsSubstring("got 1 s"));
  CHECK_THROWS_WITH(GroundMotion({1, 2, 3}, {0, 1, 1}),
                    ContainsSubstring("must increase") && ContainsSubstring("times[2]"));
  CHECK_THROWS_WITH(
      GroundMotion({1, 2, 3}, {0, 1, 0.5}, Interpolation::constant),
      ContainsSubstring("must not decrease") && ContainsSubstring("times[2]") && ContainsSubstring("got 0.5 s"));
  CHECK_THROWS_WITH(GroundMotion({1, 2}, {-1e308, 1e308}),
                    ContainsSubstring("duration must be positive and finite, got inf s"));
  CHECK_THROWS_WITH(GroundMotion({1, 2}, {3, 3}, Interpolation::constant),
                    ContainsSubstring("duration must be positive and finite, got 0 s"));
}

TEST_CASE("held values may share a time: a piece of no length does nothing", "[ground_motion]") {
  const GroundMotion with({2, 50, -2, 0}, {0, 1, 1, 2}, Interpolation::constant);
  const GroundMotion without({2, -2, 0}, {0, 1, 2}, Interpolation::constant);
  const Response one = integrate(Coulomb(1), with), other = integrate(Coulomb(1), without);
  CHECK(one.residual == other.residual);
  CHECK(one.displacement[1] == one.displacement[2]);
  CHECK(one.events.size() == other.events.size());
}

TEST_CASE("past the last sample times continue with the last step", "[ground_motion]") {
  const GroundMotion even({1, 2, 3}, 0.1);
  CHECK(even.last_step() == 0.1);
  CHECK(even.time(7) == 7 * 0.1);
  const GroundMotion uneven({1, 2, 3}, {1, 2, 2.5});
  CHECK(uneven.last_step() == 0.5);
  CHECK(uneven.time(2) == 2.5);
  CHECK(uneven.time(5) == 4);
  CHECK(GroundMotion({1, 2, 3, 4}, {0, 1, 2, 2}, Interpolation::constant).last_step() == 1);
}
