// Motions made from a motion: exact integrals, targets that are met, straight lines that are preserved, rejected
// arguments.
#include "stickslip/ground/processing.hpp"

#include <cmath>
#include <stdexcept>
#include <vector>

#include "stickslip/ground/intensity_measures.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;

TEST_CASE("ground velocity and displacement are the integrals", "[processing]") {
  // n = 6 t: v = 3 t^2, d = t^3; held: by hand.
  const GroundHistory line_history = ground_history(GroundMotion({0, 3, 6, 18}, {0, 0.5, 1, 3}));
  CHECK(line_history.velocity == std::vector<double>{0, 0.75, 3, 27});
  CHECK(difference(line_history.displacement, std::vector<double>{0, 0.125, 1, 27}) <= 1e-14);
  const GroundHistory held_history = ground_history(steps({1, -2, 1}));
  CHECK(held_history.velocity == std::vector<double>{0, 1, -1, 0});
  CHECK(held_history.displacement == std::vector<double>{0, 0.5, 0.5, 0});
}

TEST_CASE("a scaled motion meets its target", "[processing]") {
  const GroundMotion motion = broadband(3, 200);
  CHECK(scaled_to(motion, {.peak_acceleration = 4}).peak_acceleration() == Approx(4).epsilon(1e-15));
  CHECK(arias_intensity(scaled_to(motion, {.arias_intensity = 1.5})) == Approx(1.5).epsilon(1e-14));
  CHECK(peak_velocity(scaled_to(motion, {.peak_velocity = 0.3})) == Approx(0.3).epsilon(1e-14));
  CHECK_THROWS_WITH(scaled_to(motion, {}), ContainsSubstring("exactly one of PGA, Arias intensity and PGV, got 0"));
  CHECK_THROWS_WITH(scaled_to(motion, {.peak_acceleration = 1, .peak_velocity = 1}), ContainsSubstring("got 2"));
  for (const double bad : {0.0, -1.0, infinity, not_a_number}) {
    CHECK_THROWS_WITH(scaled_to(motion, {.peak_acceleration = bad}),
                      ContainsSubstring("peak acceleration (pga_g) must be positive and finite, got"));
    CHECK_THROWS_AS(scaled_to(motion, {.arias_intensity = bad}), std::invalid_argument);
    CHECK_THROWS_AS(scaled_to(motion, {.peak_velocity = bad}), std::invalid_argument);
  }
  CHECK_THROWS_WITH(scaled_to(line(0, 0, 1), {.peak_acceleration = 1}), ContainsSubstring("got zeros only"));
}

TEST_CASE("a motion that is resampled finer is the same, whatever its times", "[processing]") {
  const GroundMotion uneven({0, 2, -1, 1}, {1, 1.5, 3, 4});
  const GroundMotion fine = resampled(uneven, 0.25);
  CHECK(fine.samples() == 13);
  CHECK(fine.dt() == 0.25);
  CHECK(peak_displacement(fine) == Approx(peak_displacement(uneven)).epsilon(1e-14));
  CHECK(fine.acceleration()[1] == 1);
  const GroundMotion blocks({3, 1, 0}, {0, 1, 2}, Interpolation::constant);
  CHECK(resampled(blocks, 0.5) == GroundMotion({3, 3, 1, 1, 0}, 0.5, Interpolation::constant));
  // The step in the file back again, though 40 / 0.1 is a little off.
  CHECK(resampled(record_a(), 0.1) == record_a());
  CHECK(resampled(record_a(), 0.3).samples() == 134);
  for (const double bad : {0.0, -1.0, infinity, not_a_number, 3.5})
    CHECK_THROWS_WITH(resampled(uneven, bad), ContainsSubstring("positive and at most the duration, 3 s, got"));
  CHECK_THROWS_WITH(resampled(uneven, 1e-12), ContainsSubstring("fewer than 10^9 samples"));
}

TEST_CASE("a motion is cut where it is asked to be", "[processing]") {
  const GroundMotion motion({0, 2, -2, 1, 5}, 0.5, Interpolation::linear, "A");
  CHECK(cut(motion, 0.5, 1.5) == GroundMotion({2, -2, 1}, 0.5, Interpolation::linear, "A"));
  CHECK(cut(motion, 0.25, 1.25) == GroundMotion({1, 2, -2, -0.5}, {0, 0.25, 0.75, 1}, Interpolation::linear, "A"));
  CHECK(cut(motion, 0, 2) == motion);
  const GroundMotion blocks({3, 1, 0}, {1, 2, 3}, Interpolation::constant);
  CHECK(cut(blocks, 1.5, 2.5) == GroundMotion({3, 1, 1}, {0, 0.5, 1}, Interpolation::constant));
  // The parts have the velocity of the whole.
  const GroundMotion whole = record_a();
  const double middle = 17.345;
  CHECK(ground_history(cut(whole, 0, middle)).velocity.back() +
            ground_history(cut(whole, middle, 40)).velocity.back() ==
        Approx(ground_history(whole).velocity.back()).epsilon(1e-12));
  CHECK_THROWS_WITH(cut(motion, -0.1, 1),
                    ContainsSubstring("begin must be within the motion, from 0 to 2 s, got -0.1 s"));
  CHECK_THROWS_WITH(cut(motion, 0, 2.1), ContainsSubstring("end must be within the motion, from 0 to 2 s, got 2.1 s"));
  CHECK_THROWS_WITH(cut(motion, 1, 1), ContainsSubstring("end must be after begin, 1 s, got 1 s"));
  CHECK_THROWS_AS(cut(motion, not_a_number, 1), std::invalid_argument);
}

TEST_CASE("a trend that was added is taken away", "[processing]") {
  for (const Interpolation interpolation : {Interpolation::linear, Interpolation::constant})
    for (const int order : {0, 1}) {
      CAPTURE(order, static_cast<int>(interpolation));
      const GroundMotion clean = detrended(broadband(6, 300, false, interpolation), order);
      std::vector<double> n(clean.acceleration().begin(), clean.acceleration().end());
      // From steps an inclined trend is taken in steps, so that (1 / 300)^2 or so of it is left.
      const bool stepped = order == 1 && interpolation == Interpolation::constant;
      // No trend is left, so that removing it again changes nothing; and the ground comes to rest.
      CHECK(difference(detrended(clean, order).acceleration().first(299), clean.acceleration().first(299)) <=
            (stepped ? 1e-4 : 1e-14));
      CHECK(std::abs(ground_history(clean).velocity.back()) <= 1e-12);
      for (std::size_t i = 0; i < n.size(); ++i) n[i] += 0.3 + (order == 1 ? 0.01 * static_cast<double>(i) : 0);
      const GroundMotion found = detrended(GroundMotion(n, 0.1, interpolation), order);
      CHECK(difference(found.acceleration().first(299), clean.acceleration().first(299)) <= (stepped ? 1e-4 : 1e-13));
    }
  // Of order 2 and more the lines join the values of the polynomial: what is left is some (dt / T)^2 of it.
  std::vector<double> cubic;
  for (int i = 0; i <= 1000; ++i) cubic.push_back(std::pow(1e-3 * i, 3) - 2e-3 * i + 1);
  CHECK(detrended(GroundMotion(cubic, 0.01), 3).peak_acceleration() <= 1e-6);
  CHECK(detrended(GroundMotion({1, 2, 4}, {0, 1, 3}), 1).peak_acceleration() <= 1e-14);
  CHECK_THROWS_WITH(detrended(line(0, 1, 1), -1), ContainsSubstring("from 0 to 10, got -1"));
  CHECK_THROWS_WITH(detrended(line(0, 1, 1), 11), ContainsSubstring("got 11"));
}

TEST_CASE("operations on a motion treat every component alike", "[processing][components]") {
  for (const Interpolation interpolation : {Interpolation::linear, Interpolation::constant}) {
    const GroundMotion n = broadband(3, 200, false, interpolation), t = broadband(5, 200, false, interpolation),
                       v = broadband(7, 200, false, interpolation);
    const auto values = [](const GroundMotion& m) {
      return std::vector<double>(m.acceleration().begin(), m.acceleration().end());
    };
    const GroundMotion all = n.with_components(values(t), values(v)).with_orientation("N28W");
    const auto check = [&](const auto& make) {
      CHECK(make(all) == make(n).with_components(values(make(t)), values(make(v))).with_orientation("N28W"));
    };
    check([](const GroundMotion& m) { return m.scaled(2.5); });
    check([](const GroundMotion& m) { return resampled(m, 0.07); });
    check([](const GroundMotion& m) { return cut(m, 0.3, 2.75); });
    check([](const GroundMotion& m) { return cut(m, 0.3, 12.7); });
    check([](const GroundMotion& m) { return detrended(m, 1); });
    const GroundMotion scaled = scaled_to(all, {.peak_acceleration = 4});
    CHECK(scaled == all.scaled(4 / n.peak_acceleration()));
    CHECK(difference(ground_history(all).velocity, ground_history(n).velocity) == 0);
  }
}

TEST_CASE("a rotated motion keeps its length in every direction", "[processing][components]") {
  const GroundMotion n = broadband(3, 200), t = broadband(5, 200), v = broadband(7, 200);
  const auto values = [](std::span<const double> m) { return std::vector<double>(m.begin(), m.end()); };
  const GroundMotion all = n.with_components(values(t.acceleration()), values(v.acceleration()));
  const double scale = n.peak_acceleration() + t.peak_acceleration();
  for (const double degrees : {-725.0, -30.0, 17.5, 45.0, 90.0, 200.0, 1e6}) {
    CAPTURE(degrees);
    const GroundMotion turned = rotated(all, degrees);
    double off = 0;
    for (std::size_t i = 0; i < all.samples(); ++i)
      off = std::max(off, std::abs(std::hypot(turned.acceleration()[i], turned.transverse()[i]) -
                                   std::hypot(all.acceleration()[i], all.transverse()[i])));
    CHECK(off <= 1e-15 * scale);
    CHECK(values(turned.vertical()) == values(all.vertical()));
    const GroundMotion back = rotated(turned, -degrees);
    CHECK(difference(back.acceleration(), all.acceleration()) <= 1e-15 * scale);
    CHECK(difference(back.transverse(), all.transverse()) <= 1e-15 * scale);
  }
  // A pulse at 30 degrees from the axis toward the transverse one lies along the axis that is turned there.
  const GroundMotion pulse = GroundMotion({0, std::sqrt(0.75), 0}, 0.1).with_components({0, 0.5, 0});
  CHECK(rotated(pulse, 30).acceleration()[1] == Approx(1).epsilon(1e-15));
  CHECK(std::abs(rotated(pulse, 30).transverse()[1]) <= 1e-15);
  // Quarters are exact: the axis becomes the transverse one, which becomes the other way of the axis.
  CHECK(values(rotated(all, 90).acceleration()) == values(all.transverse()));
  CHECK(values(rotated(all, 90).transverse()) == values(n.scaled(-1).acceleration()));
  CHECK(rotated(all, 360) == all);
  CHECK(rotated(all, -270) == rotated(all, 90));
  CHECK_THROWS_WITH(rotated(n, 30), ContainsSubstring("needs a transverse component"));
  CHECK_THROWS_WITH(rotated(all, infinity), ContainsSubstring("must be finite, got inf degrees"));
}

TEST_CASE("a rotated motion stores the azimuth of its axis", "[processing][components]") {
  const GroundMotion all = GroundMotion({0, 1, 0}, 0.1).with_components({0, 2, 0}).with_orientation("N28W");
  CHECK(rotated(all, 30).orientation() == "2");
  CHECK(rotated(all, -32.5).orientation() == "299.5");
  CHECK(rotated(all, 720).orientation() == "N28W");
  CHECK(rotated(all.with_orientation("fault normal"), 30).orientation().empty());
}
