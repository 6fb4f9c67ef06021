// A slider of any law: the same answers as in its own type.
#include "stickslip/sliding/any_slider.hpp"

#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "stickslip/ensemble/run.hpp"
#include "stickslip/excitation/gaussian.hpp"
#include "stickslip/excitation/spectrum.hpp"
#include "stickslip/sliding/effective.hpp"
#include "stickslip/sliding/floor_motion.hpp"
#include "stickslip/sliding/forces.hpp"
#include "stickslip/sliding/margins.hpp"
#include "stickslip/sweep/sweep.hpp"
#include "support/catch.hpp"
#include "support/laws.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;

namespace {

// A law of the list in the type by which the library knows it.
template <class Law>
Slider<Law> known(const Law& law, const Mounting& mounting) {
  return {law, mounting};
}
Slider<FunctionLaw> known(const ByNumbers& law, const Mounting& mounting) {
  return {FunctionLaw([law](double x, double v, Direction to) { return law.resist(x, v, to); }), mounting};
}

// The compiler may round the same code differently where it is instantiated; 1e-9 is far above that.
void same_values(std::span<const double> one, std::span<const double> other, double scale) {
  REQUIRE(one.size() == other.size());
  double worst = 0;
  for (std::size_t i = 0; i < one.size(); ++i) worst = std::max(worst, std::abs(one[i] - other[i]));
  CHECK(worst <= 1e-9 * scale);
}

const Mounting bearing{.natural_frequency = 2.5, .stops = Stops(0.04, 0.06, 0.5), .pendulum = true};

template <class Work>
void for_each_known_law(Work&& work) {
  for_each_law([&](const auto& example) {
    if constexpr (!std::is_same_v<std::decay_t<decltype(example.law)>, Bump>) {  // its type is known to the test only
      CAPTURE(example.name);
      work(example.law);
    }
  });
}

}  // namespace

TEST_CASE("a slider of any law moves as in its own type", "[any_slider]") {
  const GroundMotion level(gaussian(5, 80, 2, true), 0.05);
  std::vector<double> up = gaussian(6, 80, 1, true);
  const GroundMotion shaken = level.with_components({}, up);
  for_each_known_law([&](const auto& law) {
    const Mounting on = taken_by(law, bearing);
    const Slider slider(law, on);
    const AnySlider any = known(law, on);
    CHECK(mounting_of(any) == on);

    const Response one = integrate(slider, shaken), other = integrate(any, shaken);
    same_values(one.displacement, other.displacement, one.peak);
    CHECK(one.events.size() == other.events.size());
    same_values(histories(any, shaken).displacement, one.displacement, one.peak);

    State here = State::at(0.01, 0.2), there = here;
    advance(slider, Segment{0.3, -1, 1}, here);
    advance(any, Segment{0.3, -1, 1}, there);
    CHECK(std::abs(here.displacement - there.displacement) <= 1e-9 * 0.01);
    const LoadSegment load = detail::load_segment(Segment{0.3, -1, 1}, 0, -3, 2);
    advance(slider, load, here);
    advance(any, load, there);
    CHECK(std::abs(here.displacement - there.displacement) <= 1e-9 * 0.01);
    CHECK(there.sliding_distance == Approx(here.sliding_distance).epsilon(1e-9));

    const Forces f = forces(slider, shaken, one), g = forces(any, shaken, one);
    same_values(f.friction, g.friction, 1);
    CHECK(margins(any, shaken, one).load == Approx(margins(slider, shaken, one).load).epsilon(1e-9));
    CHECK(largest_loop(any, shaken, one).area == Approx(largest_loop(slider, shaken, one).area).epsilon(1e-9));
    CHECK(floor_motion(any, shaken, one).segments.size() == floor_motion(slider, shaken, one).segments.size());
  });
}

TEST_CASE("a slider of any law moves under harmonic motion as in its own type", "[any_slider]") {
  const HarmonicMotion motion(2, 7, 3);
  for_each_known_law([&](const auto& law) {
    const Mounting spring{.natural_frequency = 4, .damping = 0.2};
    if constexpr (std::is_same_v<std::decay_t<decltype(law)>, MultiPendulum>) return;  // its stops are refused
    const Response one = integrate(Slider(law, spring), motion), other = integrate(known(law, spring), motion);
    same_values(one.displacement, other.displacement, one.peak);
    const AnySlider any = known(law, spring);
    same_values(integrate(any, motion).displacement, one.displacement, one.peak);
  });
}

TEST_CASE("a list of sliders of any law is swept and simulated as each alone", "[any_slider]") {
  std::vector<AnySlider> all;
  for_each_known_law([&](const auto& law) { all.push_back(known(law, taken_by(law, bearing))); });
  const std::vector<GroundMotion> motions{GroundMotion(gaussian(5, 80, 2, true), 0.05)};
  const SweepTable table = sweep(all, motions);
  for (std::size_t i = 0; i < all.size(); ++i)
    CHECK(table.peak[table.at(i, 0)] == Approx(integrate(all[i], motions[0]).peak).epsilon(1e-12));

  const Ensemble e = run_ensemble(OneOf(all), OneOf(motions), {.members = all.size()});
  for (std::size_t i = 0; i < all.size(); ++i)
    CHECK(e.peak()[i] == Approx(integrate(all[i], motions[0]).peak).epsilon(1e-9));
}

TEST_CASE("a sensitivity of a slider of any law is that of its law, or is refused", "[any_slider]") {
  const GroundMotion motion(gaussian(5, 80, 2, true), 0.05);
  for_each_known_law([&](const auto& law) {
    const AnySlider any = known(law, {});
    const Response response = integrate(any, motion);
    const Slider slider(law);
    if constexpr (requires { requires detail::DifferentiableLaw<std::decay_t<decltype(law)>>; })
      CHECK(sensitivity(any, motion, response, Parameter::slip_level).residual ==
            Approx(sensitivity(slider, motion, response, Parameter::slip_level).residual).epsilon(1e-9));
    else
      CHECK_THROWS_AS(sensitivity(any, motion, response, Parameter::slip_level), std::invalid_argument);
  });
}

TEST_CASE("a long segment of a slider of any law can be broken off", "[any_slider]") {
  struct Enough {};
  State state = State::at(0, 1);
  const State before = state;
  const auto end = [] { throw Enough(); };
  CHECK_THROWS_AS(advance(AnySlider(Slider(Coulomb(1e-9), 1e6)), Segment{100, 0, 0}, state, Contact::flight, end),
                  Enough);
  CHECK(state.displacement == before.displacement);
}
