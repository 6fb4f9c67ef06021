// The C interface: the same bits as `advance`, and errors as codes.
#include "stickslip/stickslip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;

namespace {

double up(int m) { return 4 * 2.5 * std::cos(0.5 * m + 0.2); }

struct Destroy {
  void operator()(stickslip_model* model) const { stickslip_destroy(model); }
};
using Model = std::unique_ptr<stickslip_model, Destroy>;

Model create(const stickslip_slider& slider) {
  stickslip_model* model = nullptr;
  REQUIRE(stickslip_create(&slider, &model) == STICKSLIP_OK);
  return Model(model);
}

/// Advance by C++, by the slider's numbers and by a model over record A, segment by segment; how often it flew.
template <class Law>
int check_same_bits(const stickslip_slider& c, const Slider<Law>& slider, bool vertical, Contact contact) {
  const std::vector<double> n = record_a_samples();
  const Model model = create(c);
  stickslip_state state = {}, stepped = {};
  State expected;
  int flights = 0;
  for (int m = 0; m < 400; ++m) {
    const auto i = static_cast<std::size_t>(m);
    const stickslip_segment segment = {0.1, n[i], n[i + 1], vertical ? up(m) : 0, vertical ? up(m + 1) : 0};
    REQUIRE(stickslip_advance(&c, &segment, &state) == STICKSLIP_OK);
    REQUIRE(stickslip_step(model.get(), &segment, &stepped) == STICKSLIP_OK);
    REQUIRE(std::memcmp(&state, &stepped, sizeof state) == 0);
    const Segment horizontal{0.1, n[i], n[i + 1]};
    if (vertical)
      advance(slider, detail::load_segment(horizontal, slider.slope(), up(m), up(m + 1)), expected, NoObserver{},
              contact);
    else
      advance(slider, horizontal, expected, NoObserver{}, contact);
    REQUIRE(state.displacement == expected.displacement);
    REQUIRE(state.velocity == expected.velocity);
    REQUIRE(state.mode == static_cast<double>(expected.mode));
    REQUIRE(state.in_flight == (expected.in_flight ? 1.0 : 0.0));
    REQUIRE(state.gap == expected.gap);
    REQUIRE(state.gap_velocity == expected.gap_velocity);
    flights += expected.in_flight;
  }
  CHECK(state.displacement != 0);
  return flights;
}

/// The transverse component beside record A.
double across(int m) { return 1.5 * std::sin(0.9 * m + 1.1) + 0.8 * std::cos(2.3 * m); }

/// The same in the plane; how many segments end in flight, and how many along the stop.
struct Ends {
  int in_flight = 0, along_stop = 0;
};
template <class Law>
Ends check_same_bits_in_plane(const stickslip_slider& c, const Slider<Law>& slider, bool vertical = false,
                              Contact contact = Contact::flight) {
  const std::vector<double> n = record_a_samples();
  const PlanarSlider plane(slider);
  const Model model = create(c);
  stickslip_planar_state state = {}, stepped = {};
  PlanarState expected;
  Ends ends;
  for (int m = 0; m < 400; ++m) {
    const auto i = static_cast<std::size_t>(m);
    const PlanarSegment horizontal{0.1, {n[i], across(m)}, {n[i + 1], across(m + 1)}};
    const stickslip_planar_segment segment = {
        0.1, {n[i], across(m)}, {n[i + 1], across(m + 1)}, vertical ? up(m) : 0, vertical ? up(m + 1) : 0};
    REQUIRE(stickslip_advance_planar(&c, &segment, &state) == STICKSLIP_OK);
    REQUIRE(stickslip_step_planar(model.get(), &segment, &stepped) == STICKSLIP_OK);
    REQUIRE(std::memcmp(&state, &stepped, sizeof state) == 0);
    if (vertical)
      advance(plane, detail::load_segment(horizontal, plane.slope(), up(m), up(m + 1)), expected, NoPlanarObserver{},
              contact);
    else
      advance(plane, horizontal, expected, NoPlanarObserver{}, contact);
    REQUIRE(Vector2{state.displacement[0], state.displacement[1]} == expected.displacement);
    REQUIRE(Vector2{state.velocity[0], state.velocity[1]} == expected.velocity);
    REQUIRE(state.mode == static_cast<double>(expected.mode));
    REQUIRE(state.in_flight == (expected.in_flight ? 1.0 : 0.0));
    REQUIRE(state.gap == expected.gap);
    REQUIRE(state.gap_velocity == expected.gap_velocity);
    ends.in_flight += expected.in_flight;
    ends.along_stop += expected.mode == PlanarMode::along_stop;
  }
  CHECK(state.displacement[0] != 0);
  CHECK(state.displacement[1] != 0);
  return ends;
}

}  // namespace

TEST_CASE("the C interface moves a slider to the same bits") {
  SECTION("a block") { check_same_bits({.slip_level = 1}, Slider(Coulomb(1)), false, Contact::flight); }
  SECTION("static friction") {
    check_same_bits({.slip_level = 1, .static_level = 1.3}, Slider(StaticKinetic(Coulomb(1), 1.3)), false,
                    Contact::flight);
  }
  SECTION("spring and damper") {
    check_same_bits({.slip_level = 1, .natural_frequency = 2, .damping = 0.2}, Slider(Coulomb(1), 2, 0.2), false,
                    Contact::flight);
  }
  SECTION("stops") {
    check_same_bits({.slip_level = 0.5, .gap = 0.1, .backward_gap = 0.2, .restitution = 0.6},
                    Slider(Coulomb(0.5), {.stops = Stops(0.1, 0.2, 0.6)}), false, Contact::flight);
  }
  SECTION("one stop") {
    check_same_bits({.slip_level = 0.5, .gap = 0.1}, Slider(Coulomb(0.5), {.stops = Stops(0.1, infinity, 0)}), false,
                    Contact::flight);
  }
  SECTION("a slope, one way") {
    check_same_bits({.slip_level = 4, .slope_degrees = 20, .one_way = 1},
                    Slider(Coulomb(4), {.slope_degrees = 20, .one_way = true}), false, Contact::flight);
  }
  SECTION("vertical motion") {
    CHECK(check_same_bits({.slip_level = 1}, Slider(Coulomb(1)), true, Contact::flight) > 0);
    CHECK(check_same_bits({.slip_level = 1, .clipped = 1}, Slider(Coulomb(1)), true, Contact::clipped) == 0);
  }
}

TEST_CASE("the C interface moves a slider in the plane to the same bits", "[planar]") {
  SECTION("a block") { check_same_bits_in_plane({.slip_level = 1}, Slider(Coulomb(1))); }
  SECTION("static friction, spring and damper") {
    check_same_bits_in_plane({.slip_level = 1, .static_level = 1.3, .natural_frequency = 2, .damping = 0.2},
                             Slider(StaticKinetic(Coulomb(1), 1.3), 2, 0.2));
  }
  SECTION("a circular stop") {
    const Ends ends = check_same_bits_in_plane({.slip_level = 0.3, .gap = 0.02, .backward_gap = 0.02},
                                               Slider(Coulomb(0.3), {.stops = Stops(0.02, 0)}));
    CHECK(ends.along_stop > 0);
  }
  SECTION("a slope") {
    check_same_bits_in_plane({.slip_level = 4, .slope_degrees = 20}, Slider(Coulomb(4), {.slope_degrees = 20}));
  }
  SECTION("vertical motion") {
    CHECK(check_same_bits_in_plane({.slip_level = 1}, Slider(Coulomb(1)), true).in_flight > 0);
    CHECK(check_same_bits_in_plane({.slip_level = 1, .clipped = 1}, Slider(Coulomb(1)), true, Contact::clipped)
              .in_flight == 0);
  }
}

TEST_CASE("the C interface: on a line the plane is the axis", "[planar]") {
  const Model model = create({.slip_level = 1, .natural_frequency = 2});
  const std::vector<double> n = record_a_samples();
  stickslip_state on_axis = {};
  stickslip_planar_state in_plane = {};
  double largest = 0;
  for (std::size_t i = 0; i < 400; ++i) {
    const stickslip_segment segment = {0.1, n[i], n[i + 1], 0, 0};
    // Along (3, -4) / 5.
    const stickslip_planar_segment turned = {0.1, {0.6 * n[i], -0.8 * n[i]}, {0.6 * n[i + 1], -0.8 * n[i + 1]}, 0, 0};
    REQUIRE(stickslip_step(model.get(), &segment, &on_axis) == STICKSLIP_OK);
    REQUIRE(stickslip_step_planar(model.get(), &turned, &in_plane) == STICKSLIP_OK);
    largest = std::max(largest, std::abs(on_axis.displacement));
    CHECK(std::hypot(in_plane.displacement[0] - 0.6 * on_axis.displacement,
                     in_plane.displacement[1] + 0.8 * on_axis.displacement) <= 1e-12 * largest);
    CHECK((in_plane.mode == 0) == (on_axis.mode == 0));
  }
}

TEST_CASE("errors of the C interface in the plane are codes with a message, and change nothing", "[planar]") {
  using Slip = stickslip_slider;
  using Seg = stickslip_planar_segment;
  using St = stickslip_planar_state;
  struct Case {
    std::function<void(Slip&, Seg&, St&)> spoil;
    std::string says;
    int code = STICKSLIP_INVALID_ARGUMENT;
  };
  const double nan = not_a_number;
  const std::vector<Case> cases = {
      {[](Slip& s, Seg&, St&) { s.slip_level = -1; }, "slip_level must be finite and at least 0, got -1 m/s^2"},
      {[](Slip& s, Seg&, St&) { s.one_way = 1; }, "one_way has no meaning in the plane"},
      {[](Slip& s, Seg&, St&) { s.gap = 0.1; }, "a circular stop has one gap; got stops with gaps of 0.1 m forward"},
      {[&](Slip&, Seg& s, St&) { s.duration = nan; }, "segment and state must be finite, got a duration of nan s"},
      {[&](Slip&, Seg& s, St&) { s.start[1] = nan; }, "nan) to (-3, -0) m/s^2"},
      {[&](Slip&, Seg& s, St&) { s.end[0] = infinity; }, "to (-inf, -0) m/s^2"},
      {[&](Slip&, Seg& s, St&) { s.vertical_end = nan; }, "to nan m/s^2"},
      {[&](Slip&, Seg&, St& s) { s.displacement[1] = nan; }, "r = (0, nan) m"},
      {[&](Slip&, Seg&, St& s) { s.velocity[0] = nan; }, "r' = (nan, 0) m/s"},
      {[](Slip&, Seg&, St& s) { s.mode = -1; }, "mode must be 0, 1 or 2, got -1"},
      {[&](Slip&, Seg&, St& s) { s.mode = nan; }, "mode must be 0, 1 or 2, got nan"},
      {[](Slip&, Seg&, St& s) { s.velocity[1] = -3; }, "mode must be 1 or 2 with a velocity of (0, -3) m/s, got 0"},
      {[](Slip&, Seg&, St& s) { s.mode = 2; }, "slides along its stop must be at |r| = inf m, got |r| = 0 m"},
      {[](Slip& s, Seg&, St& st) { s.gap = s.backward_gap = 0.1, st.mode = 2, st.displacement[1] = 0.05; },
       "slides along its stop must be at |r| = 0.1 m, got |r| = 0.05 m"},
      {[](Slip& s, Seg&, St& st) { s.gap = s.backward_gap = 0.1, st.displacement[0] = 1; },
       "within the stop at 0.1 m, got |r| = 1 m"},
      {[](Slip&, Seg&, St& s) { s.in_flight = 2; }, "stickslip_planar_state: in_flight must be 0 or 1, got 2"},
      {[](Slip&, Seg&, St& s) { s.gap = -1; }, "stickslip_planar_state: gap must be finite and at least 0, got -1 m"},
      {[&](Slip&, Seg&, St& s) { s.gap_velocity = infinity; }, "gap_velocity must be finite, got inf m/s"},
  };
  for (const Case& c : cases) {
    stickslip_slider slider = {.slip_level = 1};
    stickslip_planar_segment segment = {.duration = 0.1, .start = {2, 0}, .end = {3, 0}};
    stickslip_planar_state state = {};
    c.spoil(slider, segment, state);
    const stickslip_planar_state before = state;
    INFO(c.says);
    CHECK(stickslip_advance_planar(&slider, &segment, &state) == c.code);
    CHECK_THAT(std::string(stickslip_message()), ContainsSubstring(c.says));
    CHECK(std::memcmp(&state, &before, sizeof state) == 0);
    stickslip_model* made = nullptr;
    int code = stickslip_create(&slider, &made);
    const Model model(made);
    if (code == STICKSLIP_OK) code = stickslip_step_planar(made, &segment, &state);
    CHECK(code == c.code);
    CHECK_THAT(std::string(stickslip_message()), ContainsSubstring(c.says));
    CHECK(std::memcmp(&state, &before, sizeof state) == 0);
  }

  const Slip slider = {.slip_level = 1};
  const Seg segment = {.duration = 0.1};
  St state = {};
  CHECK(stickslip_advance_planar(nullptr, &segment, &state) == STICKSLIP_INVALID_ARGUMENT);
  CHECK_THAT(std::string(stickslip_message()), ContainsSubstring("slider must not be null"));
  CHECK(stickslip_step_planar(nullptr, &segment, &state) == STICKSLIP_INVALID_ARGUMENT);
  CHECK_THAT(std::string(stickslip_message()), ContainsSubstring("model must not be null"));
  CHECK(stickslip_advance_planar(&slider, nullptr, &state) == STICKSLIP_INVALID_ARGUMENT);
  CHECK_THAT(std::string(stickslip_message()), ContainsSubstring("segment must not be null"));
  CHECK(stickslip_advance_planar(&slider, &segment, nullptr) == STICKSLIP_INVALID_ARGUMENT);
  CHECK_THAT(std::string(stickslip_message()), ContainsSubstring("state must not be null"));
}

TEST_CASE("errors of the C interface are codes with a message, and change nothing") {
  struct Case {
    std::function<void(stickslip_slider&, stickslip_segment&, stickslip_state&)> spoil;
    std::string says;
    int code = STICKSLIP_INVALID_ARGUMENT;
  };
  using Slip = stickslip_slider;
  using Seg = stickslip_segment;
  using St = stickslip_state;
  const double nan = not_a_number;
  const std::vector<Case> cases = {
      {[](Slip& s, Seg&, St&) { s.slip_level = -1; }, "slip_level must be finite and at least 0, got -1 m/s^2"},
      {[&](Slip& s, Seg&, St&) { s.slip_level = nan; }, "slip_level must be finite and at least 0, got nan"},
      {[](Slip& s, Seg&, St&) { s.static_level = 0.5; }, "at least the kinetic one of 1 m/s^2, got 0.5"},
      {[&](Slip& s, Seg&, St&) { s.static_level = nan; }, "got nan"},
      {[](Slip& s, Seg&, St&) { s.natural_frequency = -2; }, "natural_frequency must be finite and at least 0, got -2"},
      {[](Slip& s, Seg&, St&) { s.damping = -2; }, "damping and its square must be finite and at least 0, got -2"},
      {[](Slip& s, Seg&, St&) { s.slope_degrees = 90; }, "slope_degrees must be from 0 to less than 90, got 90"},
      {[](Slip& s, Seg&, St&) { s.slope_degrees = 30; }, "slides under its own weight"},
      {[](Slip& s, Seg&, St&) { s.gap = -0.1; }, "gap must be at least 0, got -0.1 m"},
      {[&](Slip& s, Seg&, St&) { s.backward_gap = nan; }, "backward_gap must be at least 0, got nan m"},
      {[](Slip& s, Seg&, St&) { s.restitution = 2; }, "restitution must be from 0 to 1, got 2"},
      {[](Slip& s, Seg&, St&) { s.one_way = 7; }, "one_way must be 0 or 1, got 7"},
      {[](Slip& s, Seg&, St&) { s.clipped = -1; }, "clipped must be 0 or 1, got -1"},
      {[&](Slip&, Seg& s, St&) { s.duration = nan; }, "segment and state must be finite, got a duration of nan s"},
      {[&](Slip&, Seg& s, St&) { s.end = nan; }, "end nan m/s^2"},
      {[&](Slip&, Seg& s, St&) { s.vertical_start = nan; }, "normal force nan to"},
      {[&](Slip&, Seg& s, St&) { s.vertical_end = infinity; }, "to inf m/s^2"},
      {[&](Slip&, Seg&, St& s) { s.displacement = nan; }, "x = nan m"},
      {[](Slip&, Seg&, St& s) { s.mode = 0.5; }, "mode must be 0, 1 or -1, got 0.5"},
      {[&](Slip&, Seg&, St& s) { s.mode = nan; }, "mode must be 0, 1 or -1, got nan"},
      {[](Slip&, Seg&, St& s) { s.velocity = -3; }, "mode must be the sign of the velocity, -3 m/s, got 0"},
      {[](Slip&, Seg&, St& s) { s.in_flight = 2; }, "in_flight must be 0 or 1, got 2"},
      {[](Slip&, Seg&, St& s) { s.gap = -1; }, "gap must be finite and at least 0, got -1 m"},
      {[&](Slip&, Seg&, St& s) { s.gap_velocity = infinity; }, "gap_velocity must be finite, got inf m/s"},
      {[](Slip& s, Seg&, St& st) { s.gap = 0.1, st.displacement = 1; }, "between the stops"},
      {[](Slip&, Seg& s, St&) { s.duration = 1e300, s.start = s.end = 1e300; }, "leaves the range of doubles",
       STICKSLIP_OVERFLOW},
      {[](Slip& s, Seg& seg, St& st) {
         s.natural_frequency = 1e17, seg = {10, 5, -3, 0, 0}, st.displacement = 1e-3;
       },
       "the spring or damper is too stiff", STICKSLIP_NO_CONVERGENCE},
  };
  for (const Case& c : cases) {
    stickslip_slider slider = {.slip_level = 1};
    stickslip_segment segment = {.duration = 0.1, .start = 2, .end = 3};
    stickslip_state state = {};
    c.spoil(slider, segment, state);
    const stickslip_state before = state;
    INFO(c.says);
    CHECK(stickslip_advance(&slider, &segment, &state) == c.code);
    CHECK_THAT(std::string(stickslip_message()), ContainsSubstring(c.says));
    CHECK(std::memcmp(&state, &before, sizeof state) == 0);
    stickslip_model* made = nullptr;
    int code = stickslip_create(&slider, &made);  // what is wrong with the slider is found here, the rest by each step
    const Model model(made);
    CHECK((code == STICKSLIP_OK) == (made != nullptr));
    CHECK(code == stickslip_check(&slider));
    if (code == STICKSLIP_OK) code = stickslip_step(made, &segment, &state);
    CHECK(code == c.code);
    CHECK_THAT(std::string(stickslip_message()), ContainsSubstring(c.says));
    CHECK(std::memcmp(&state, &before, sizeof state) == 0);
  }
}

TEST_CASE("null pointers are named, and a slider can be checked alone") {
  const stickslip_slider slider = {.slip_level = 1}, bad = {.slip_level = -1};
  const stickslip_segment segment = {.duration = 0.1};
  stickslip_state state = {};
  CHECK(stickslip_advance(nullptr, &segment, &state) == STICKSLIP_INVALID_ARGUMENT);
  CHECK_THAT(std::string(stickslip_message()), ContainsSubstring("slider must not be null"));
  CHECK(stickslip_advance(&slider, nullptr, &state) == STICKSLIP_INVALID_ARGUMENT);
  CHECK_THAT(std::string(stickslip_message()), ContainsSubstring("segment must not be null"));
  CHECK(stickslip_advance(&slider, &segment, nullptr) == STICKSLIP_INVALID_ARGUMENT);
  CHECK_THAT(std::string(stickslip_message()), ContainsSubstring("state must not be null"));
  CHECK(stickslip_check(&slider) == STICKSLIP_OK);
  CHECK(stickslip_check(&bad) == STICKSLIP_INVALID_ARGUMENT);
  CHECK_THAT(std::string(stickslip_message()), ContainsSubstring("got -1 m/s^2"));
  CHECK(stickslip_check(nullptr) == STICKSLIP_INVALID_ARGUMENT);

  const Model model = create(slider);
  CHECK(stickslip_step(nullptr, &segment, &state) == STICKSLIP_INVALID_ARGUMENT);
  CHECK_THAT(std::string(stickslip_message()), ContainsSubstring("model must not be null"));
  CHECK(stickslip_step(model.get(), nullptr, &state) == STICKSLIP_INVALID_ARGUMENT);
  CHECK_THAT(std::string(stickslip_message()), ContainsSubstring("segment must not be null"));
  CHECK(stickslip_step(model.get(), &segment, nullptr) == STICKSLIP_INVALID_ARGUMENT);
  CHECK_THAT(std::string(stickslip_message()), ContainsSubstring("state must not be null"));
  CHECK(stickslip_create(&slider, nullptr) == STICKSLIP_INVALID_ARGUMENT);
  CHECK_THAT(std::string(stickslip_message()), ContainsSubstring("model must not be null"));
  stickslip_model* none = model.get();
  CHECK(stickslip_create(nullptr, &none) == STICKSLIP_INVALID_ARGUMENT);
  CHECK(none == nullptr);
  stickslip_destroy(nullptr);
}

TEST_CASE("a model outlives the numbers that it was made of, and many threads step it") {
  stickslip_slider slider = {.slip_level = 1, .static_level = 1.2, .natural_frequency = 2};
  const Model model = create(slider);
  const stickslip_slider copy = slider;
  slider = {};
  const std::vector<double> n = record_a_samples();
  const auto run = [&](auto&& step) {
    stickslip_state state = {};
    for (std::size_t i = 0; i < 400; ++i) {
      const stickslip_segment segment = {0.1, n[i], n[i + 1], 0, 0};
      if (step(&segment, &state) != STICKSLIP_OK) return stickslip_state{not_a_number, 0, 0, 0, 0, 0};
    }
    return state;
  };
  const stickslip_state alone = run([&](auto* g, auto* at) { return stickslip_advance(&copy, g, at); });
  CHECK(alone.displacement != 0);
  std::array<stickslip_state, 4> states{};
  std::vector<std::thread> threads;
  for (stickslip_state& state : states)
    threads.emplace_back([&] { state = run([&](auto* g, auto* at) { return stickslip_step(model.get(), g, at); }); });
  for (std::thread& thread : threads) thread.join();
  for (const stickslip_state& state : states) CHECK(std::memcmp(&state, &alone, sizeof state) == 0);
}

TEST_CASE("each thread has its own message") {
  const stickslip_slider bad = {.slip_level = -1};
  REQUIRE(stickslip_check(&bad) == STICKSLIP_INVALID_ARGUMENT);
  std::string other = "unset";
  std::thread([&] { other = stickslip_message(); }).join();
  CHECK(other.empty());
  CHECK_THAT(std::string(stickslip_message()), ContainsSubstring("got -1"));
}

TEST_CASE("the C interface moves a pendulum with several surfaces to the same bits") {
  const MultiPendulum law({0.4, 2, 2.5}, {0.02, 0.04, 0.08}, {0.2, 0.4, 0.5}, 0.3, true);
  const Slider slider(law, Mounting{.damping = 0.2});
  stickslip_pendulum c = {};
  c.surfaces = 3, c.nested = 1, c.restitution = 0.3, c.damping = 0.2;
  for (int k = 0; k < 3; ++k) c.radii[k] = law.radii()[k], c.mu[k] = law.mu()[k], c.capacities[k] = law.capacities()[k];
  stickslip_pendulum_state state = {};
  State at;
  for (int i = 0; i < 200; ++i) {
    const double start = 3 * std::sin(0.7 * i), end = 3 * std::sin(0.7 * (i + 1)), up = 2 * std::cos(0.3 * i);
    const stickslip_segment segment = {0.1, start, end, up, up};
    double u[8] = {};
    REQUIRE(stickslip_advance_pendulum(&c, &segment, &state, u) == STICKSLIP_OK);
    advance(slider, detail::load_segment(Segment{0.1, start, end}, 0, up, up), at);
    REQUIRE(state.motion.displacement == at.displacement);
    REQUIRE(u[2] == law.displacement(at.pendulum, 2));
  }
  CHECK(std::abs(at.displacement) > 1e-3);
  const stickslip_segment segment = {0.1, 0, 0, 0, 0};
  c.mu[1] = 0.01;
  const double before = state.motion.displacement;
  CHECK(stickslip_advance_pendulum(&c, &segment, &state, nullptr) == STICKSLIP_INVALID_ARGUMENT);
  CHECK(std::string(stickslip_message()).find("mu[1]") != std::string::npos);
  CHECK(state.motion.displacement == before);
  c.mu[1] = 0.04, state.memory[9] = 3;
  CHECK(stickslip_advance_pendulum(&c, &segment, &state, nullptr) == STICKSLIP_INVALID_ARGUMENT);
  CHECK(stickslip_advance_pendulum(nullptr, &segment, &state, nullptr) == STICKSLIP_INVALID_ARGUMENT);
}
