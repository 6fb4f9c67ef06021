// Ground motions: their contents, and the arguments that they reject.
#include "stickslip/stickslip.hpp"

#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;

TEST_CASE("a motion has its samples, times and segments", "[ground_motion]") {
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

TEST_CASE("a motion may have a transverse and a vertical component on its times", "[ground_motion][components]") {
  const GroundMotion axis({1, -3, 2}, {0, 1, 5}, Interpolation::linear, "name");
  CHECK(!axis.has_transverse());
  CHECK(!axis.has_vertical());
  CHECK(axis.transverse().empty());
  const GroundMotion all = axis.with_components({4, 5, 6}, {-7, 8, -9}).with_orientation("N28W");
  CHECK(all.transverse()[2] == 6);
  CHECK(all.vertical()[0] == -7);
  CHECK(all.peak_acceleration() == 3);
  CHECK(all.component(Component::axis) == axis.with_orientation("N28W"));
  CHECK(all.component(Component::transverse) == GroundMotion({4, 5, 6}, {0, 1, 5}, Interpolation::linear, "name"));
  CHECK(all.component(Component::transverse).peak_acceleration() == 6);
  CHECK(all.component(Component::vertical).orientation() == "up");
  CHECK(all.with_components({}) == axis.with_orientation("N28W"));
  CHECK_THROWS_WITH(axis.component(Component::vertical), "GroundMotion: has no vertical component");
  CHECK_THROWS_WITH(all.component(Component::axis).component(Component::transverse),
                    "GroundMotion: has no transverse component");
}

TEST_CASE("a negative factor turns the horizontal components and never the vertical one",
          "[ground_motion][components]") {
  const GroundMotion all = GroundMotion({1, -3, 2}, 0.1).with_components({4, 5, 6}, {-7, 8, -9});
  CHECK(all.scaled(-2) == GroundMotion({-2, 6, -4}, 0.1).with_components({-8, -10, -12}, {-14, 16, -18}));
  CHECK(all.scaled(-1).scaled(-1) == all);
}

TEST_CASE("each component is checked as the first one", "[ground_motion][components][errors]") {
  const GroundMotion axis({1, 2, 3}, 0.01);
  const std::string rule = " must be finite and at most 1e100 m/s^2 in magnitude, got ";
  CHECK_THROWS_WITH(axis.with_components({1, 2}),
                    "GroundMotion: transverse must have as many samples as acceleration, 3, got 2");
  CHECK_THROWS_WITH(axis.with_components({}, {1, 2, 3, 4}),
                    "GroundMotion: vertical must have as many samples as acceleration, 3, got 4");
  CHECK_THROWS_WITH(axis.with_components({1, not_a_number, 3}), "GroundMotion: transverse[1]" + rule + "nan m/s^2");
  CHECK_THROWS_WITH(axis.with_components({1, 2, 3}, {1, 2, -infinity}),
                    "GroundMotion: vertical[2]" + rule + "-inf m/s^2");
  CHECK_THROWS_WITH(axis.with_components({1, 2, 3}, {2, 1, 1}).scaled(-1e100),
                    "GroundMotion: acceleration[1]" + rule + "-2e+100 m/s^2");
  CHECK_THROWS_WITH(axis.with_components({}, {20, 1, 1}).scaled(-1e99),
                    "GroundMotion: vertical[0]" + rule + "2e+100 m/s^2");
}

TEST_CASE("a vertical component acts, a transverse one never does", "[ground_motion][components][integrate]") {
  const GroundMotion axis = record_a(), across = axis.with_components(std::vector<double>(axis.samples(), 3.0));
  const GroundMotion up = axis.with_components({}, std::vector<double>(axis.samples(), 3.0));
  const GroundMotion record = resampled(up, axis.dt() / 32);  // long enough to be cut in pieces
  REQUIRE(record.samples() > 8192);
  // 3 m/s^2 upward all the time: the level is mu (g + 3).
  const double part = 1 + 3 / standard_gravity;
  for (const GroundMotion& motion : {up, record}) {
    const Response heavy = integrate(Coulomb(1), motion);
    const Response same = integrate(Coulomb(part), motion.component(Component::axis));
    CHECK(difference(heavy.displacement, same.displacement) <= 1e-12 * same.peak);
    CHECK(heavy.components == "axis + vertical");
    CHECK(difference(histories(Coulomb(1), motion).displacement, heavy.displacement) == 0);
    const Ensemble e = run_ensemble(Coulomb(1), OneOf(std::vector{motion}), {.members = 2});
    CHECK(std::abs(e.residual()[1] - heavy.residual) <= 1e-12 * heavy.peak);
  }
  const Response with = integrate(Coulomb(1), across), without = integrate(Coulomb(1), axis);
  CHECK(with.displacement == without.displacement);
  CHECK(with.components == "axis");
  CHECK(integrate(Coulomb(1), HarmonicMotion(2, 3, 4)).components == "axis");
}

TEST_CASE("ensembles tell motions apart by all their components", "[ground_motion][components]") {
  const GroundMotion axis({1, 2, 3}, 0.01);
  const std::vector<GroundMotion> motions{axis, axis.with_components({1, 2, 3}), axis.with_components({}, {1, 2, 3})};
  for (const GroundMotion& a : motions)
    for (const GroundMotion& b : motions)
      CHECK((OneOf(std::vector{a}).configuration() == OneOf(std::vector{b}).configuration()) == (&a == &b));
}

TEST_CASE("motions are equal where all of them is the same", "[ground_motion]") {
  const std::vector<double> samples{1, -3, 2};
  const std::vector<GroundMotion> motions{{samples, 0.5},
                                          {samples, 0.25},
                                          {samples, 0.5, Interpolation::constant},
                                          {samples, 0.5, Interpolation::linear, "name"},
                                          {samples, {0, 0.5, 1}},
                                          {samples, {0, 0.5, 2}},
                                          {{1, -3, 4}, 0.5},
                                          GroundMotion(samples, 0.5).with_components({1, 2, 3}),
                                          GroundMotion(samples, 0.5).with_components({}, {1, 2, 3}),
                                          GroundMotion(samples, 0.5).with_orientation("90")};
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
