// Motions made from a motion: exact integrals, targets that are met, lines that are kept, what is refused.
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
    CHECK_THROWS_WITH(scaled_to(motion, {.peak_acceleration = bad}), ContainsSubstring("positive and finite PGA, got"));
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
  CHECK_THROWS_WITH(cut(motion, -0.1, 1), ContainsSubstring("times within the motion, from 0 to 2 s, got -0.1 s"));
  CHECK_THROWS_WITH(cut(motion, 0, 2.1), ContainsSubstring("got 2.1 s"));
  CHECK_THROWS_WITH(cut(motion, 1, 1), ContainsSubstring("an end after the beginning, 1 s, got 1 s"));
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
      // Nothing is left, so that taking it away again changes nothing; and the ground comes to rest.
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
