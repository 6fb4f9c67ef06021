// The C interface of sliders. It needs the header-only core and the standard library, no more.
#include "stickslip/stickslip.h"

#include <cmath>
#include <cstddef>
#include <cstring>
#include <exception>
#include <limits>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "c_interface.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/friction/multi_pendulum.hpp"
#include "stickslip/friction/static_kinetic.hpp"
#include "stickslip/ground/segment.hpp"
#include "stickslip/planar/advance.hpp"
#include "stickslip/planar/segment.hpp"
#include "stickslip/planar/slider.hpp"
#include "stickslip/planar/state.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/slider/stops.hpp"
#include "stickslip/sliding/advance.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip {
namespace detail {
namespace {

constexpr std::size_t longest_message = 512;
thread_local char last_message[longest_message] = "";

}  // namespace

int c_failure() noexcept {
  const auto keep = [](const std::exception& error) {
    const std::size_t length = std::min(std::strlen(error.what()), longest_message - 1);
    std::memcpy(last_message, error.what(), length);
    last_message[length] = 0;
  };
  try {
    throw;
  } catch (const std::invalid_argument& error) {
    return keep(error), STICKSLIP_INVALID_ARGUMENT;
  } catch (const std::overflow_error& error) {
    return keep(error), STICKSLIP_OVERFLOW;
  } catch (const ConvergenceError& error) {
    return keep(error), STICKSLIP_NO_CONVERGENCE;
  } catch (const std::exception& error) {
    return keep(error), STICKSLIP_ERROR;
  }
}

}  // namespace detail

namespace {

using detail::c_status_of;
using detail::require_pointer;
using detail::store;
using detail::vector;

// The rules are checked at each step: their messages are composed only for an error.
[[noreturn, gnu::noinline]] void refuse_flag(const char* name, int value) {
  detail::refuse(std::string("stickslip_slider: ") + name + " must be 0 or 1", value);
}
[[noreturn, gnu::noinline]] void refuse_gap(const char* name, double value) {
  detail::refuse(std::string("stickslip_slider: ") + name + " must be at least 0", value, "m");
}
[[noreturn, gnu::noinline]] void refuse_mode(double mode, double velocity) {
  detail::refuse("stickslip_state: mode must be the sign of the velocity, " + detail::shortest(velocity) + " m/s",
                 mode);
}

[[noreturn, gnu::noinline]] void refuse_member(const char* of, const char* rule, double value, const char* unit) {
  detail::refuse(std::string(of) + rule, value, unit);
}
[[noreturn, gnu::noinline]] void refuse_stuck_mode(Vector2 velocity) {
  throw std::invalid_argument("stickslip_planar_state: mode must be 1 or 2 with a velocity of " +
                              detail::description(velocity) + " m/s, got 0");
}

bool flag(int value, const char* name) {
  if (value != 0 && value != 1) refuse_flag(name, value);
  return value == 1;
}

/// The distance to a stop; infinite if there is none.
double gap(double given, const char* name) {
  if (!(given >= 0)) refuse_gap(name, given);
  return given > 0 ? given : std::numeric_limits<double>::infinity();
}

Mounting mounting(const stickslip_slider& s) {
  return {.natural_frequency = s.natural_frequency,
          .damping = s.damping,
          .slope_degrees = s.slope_degrees,
          .one_way = flag(s.one_way, "one_way"),
          .stops = Stops(gap(s.gap, "gap"), gap(s.backward_gap, "backward_gap"), s.restitution)};
}

/// Checks what both states say of a flight.
/// @param of  the name of the struct
template <class AnyState>
void check_flight(const AnyState& s, const char* of) {
  const auto check = [of](bool holds, const char* rule, double value, const char* unit = "") {
    if (!holds) [[unlikely]]
      refuse_member(of, rule, value, unit);
  };
  check(s.in_flight == 0 || s.in_flight == 1, ": in_flight must be 0 or 1", s.in_flight);
  check(s.gap >= 0 && std::isfinite(s.gap), ": gap must be finite and at least 0", s.gap, "m");
  check(std::isfinite(s.gap_velocity), ": gap_velocity must be finite", s.gap_velocity, "m/s");
}

State state_of(const stickslip_state& s) {
  const double sign = s.velocity > 0 ? 1 : s.velocity < 0 ? -1 : 0;
  detail::require(s.mode == 0 || s.mode == 1 || s.mode == -1, "stickslip_state: mode must be 0, 1 or -1", s.mode);
  if (sign != 0 && s.mode != sign) refuse_mode(s.mode, s.velocity);
  check_flight(s, "stickslip_state");
  return {s.displacement,   s.velocity, s.mode > 0 ? Mode::forward : s.mode < 0 ? Mode::backward : Mode::stuck,
          s.in_flight == 1, s.gap,      s.gap_velocity};
}

PlanarState state_of(const stickslip_planar_state& s) {
  detail::require(s.mode == 0 || s.mode == 1 || s.mode == 2, "stickslip_planar_state: mode must be 0, 1 or 2", s.mode);
  const Vector2 velocity = vector(s.velocity);
  if (s.mode == 0 && std::abs(velocity.axis) + std::abs(velocity.transverse) > 0) refuse_stuck_mode(velocity);
  check_flight(s, "stickslip_planar_state");
  return {.displacement = vector(s.displacement),
          .velocity = velocity,
          .mode = static_cast<PlanarMode>(static_cast<int>(s.mode)),
          .in_flight = s.in_flight == 1,
          .gap = s.gap,
          .gap_velocity = s.gap_velocity};
}

/// Calls `work` with the slider, and whether it flies where the normal force is negative.
template <class Work>
auto with_slider(const stickslip_slider* s, Work&& work) {
  require_pointer(s, "slider");
  const Contact contact = flag(s->clipped, "clipped") ? Contact::clipped : Contact::flight;
  const Coulomb sliding(s->slip_level);
  if (s->static_level == 0) return work(Slider(sliding, mounting(*s)), contact);
  return work(Slider(StaticKinetic(sliding, s->static_level), mounting(*s)), contact);
}

template <class Law>
void move(const Slider<Law>& slider, Contact contact, const stickslip_segment* segment, State& at) {
  require_pointer(segment, "segment");
  const stickslip_segment& s = *segment;
  const Segment horizontal{s.duration, s.start, s.end};
  NoObserver none;
  if (s.vertical_start == 0 && s.vertical_end == 0)
    advance(slider, horizontal, at, none, contact);
  else
    advance(slider, detail::load_segment(horizontal, slider.slope(), s.vertical_start, s.vertical_end), at, none,
            contact);
}

void store(const State& at, stickslip_state& state) {
  state.displacement = at.displacement;
  state.velocity = at.velocity;
  state.mode = static_cast<double>(at.mode);
  state.in_flight = at.in_flight ? 1 : 0;
  state.gap = at.gap;
  state.gap_velocity = at.gap_velocity;
}

template <class Law>
void step(const Slider<Law>& slider, Contact contact, const stickslip_segment* segment, stickslip_state* state) {
  require_pointer(state, "state");
  State at = state_of(*state);
  move(slider, contact, segment, at);
  store(at, *state);
}

MultiPendulum pendulum_of(const stickslip_pendulum& p) {
  constexpr int most = PendulumMemory::most_elements;
  detail::require(p.surfaces >= 1 && p.surfaces <= most, "stickslip_pendulum: surfaces must be from 1 to 8",
                  p.surfaces);
  if (p.nested != 0 && p.nested != 1) detail::refuse("stickslip_pendulum: nested must be 0 or 1", p.nested);
  const auto list = [&](const double* values) { return std::vector<double>(values, values + p.surfaces); };
  std::vector<double> capacities = list(p.capacities);
  for (double& capacity : capacities) capacity = gap(capacity, "capacities");
  return MultiPendulum(list(p.radii), list(p.mu), std::move(capacities), p.restitution, p.nested == 1);
}

// The memory as thirteen doubles: places, then force, direction, and three sets of elements.
PendulumMemory memory_of(const double* from) {
  PendulumMemory memory;
  for (double& place : memory.place) place = *from++;
  memory.force = *from++;
  const auto whole = [&](double least, double most) {
    const double value = *from++;
    detail::require(value >= least && value <= most, "stickslip_pendulum_state: memory must be that of a former step",
                    value);
    return static_cast<int>(value);
  };
  memory.direction = static_cast<std::int8_t>(whole(-1, 1));
  for (std::uint8_t* set : {&memory.moving, &memory.at_forward, &memory.at_backward})
    *set = static_cast<std::uint8_t>(whole(0, 255));
  return memory;
}
void store(const PendulumMemory& memory, double* to) {
  for (const double place : memory.place) *to++ = place;
  for (const double value : {memory.force, static_cast<double>(memory.direction), static_cast<double>(memory.moving),
                             static_cast<double>(memory.at_forward), static_cast<double>(memory.at_backward)})
    *to++ = value;
}

template <class Law>
void step(const Slider<Law>& slider, Contact contact, const stickslip_planar_segment* segment,
          stickslip_planar_state* state) {
  require_pointer(segment, "segment");
  require_pointer(state, "state");
  PlanarState at = state_of(*state);
  const stickslip_planar_segment& s = *segment;
  const PlanarSegment horizontal{s.duration, vector(s.start), vector(s.end)};
  advance(PlanarSlider(slider), detail::load_segment(horizontal, slider.slope(), s.vertical_start, s.vertical_end), at,
          NoPlanarObserver{}, contact);
  store(at.displacement, state->displacement);
  store(at.velocity, state->velocity);
  state->mode = static_cast<double>(at.mode);
  state->in_flight = at.in_flight ? 1 : 0;
  state->gap = at.gap;
  state->gap_velocity = at.gap_velocity;
}

}  // namespace
}  // namespace stickslip

struct stickslip_model {
  std::variant<stickslip::Slider<stickslip::Coulomb>, stickslip::Slider<stickslip::StaticKinetic<>>> slider;
  stickslip::Contact contact;
};

namespace stickslip {
namespace {

/// Steps a model.
template <class AnySegment, class AnyState>
int step(const stickslip_model* model, const AnySegment* segment, AnyState* state) noexcept {
  return c_status_of([&] {
    require_pointer(model, "model");
    if (const auto* slider = std::get_if<Slider<Coulomb>>(&model->slider))
      step(*slider, model->contact, segment, state);
    else
      step(std::get<Slider<StaticKinetic<>>>(model->slider), model->contact, segment, state);
  });
}

/// Steps a slider.
template <class AnySegment, class AnyState>
int step(const stickslip_slider* slider, const AnySegment* segment, AnyState* state) noexcept {
  return c_status_of([&] {
    with_slider(slider, [&](const auto& checked, Contact contact) { step(checked, contact, segment, state); });
  });
}

}  // namespace
}  // namespace stickslip

extern "C" {

int stickslip_create(const stickslip_slider* slider, stickslip_model** model) {
  using namespace stickslip;
  return c_status_of([&] {
    require_pointer(model, "model");
    *model = nullptr;
    *model = with_slider(slider, [](const auto& checked, Contact contact) {
      return new stickslip_model{checked, contact};
    });
  });
}

int stickslip_step(const stickslip_model* model, const stickslip_segment* segment, stickslip_state* state) {
  return stickslip::step(model, segment, state);
}

void stickslip_destroy(stickslip_model* model) { delete model; }

int stickslip_advance(const stickslip_slider* slider, const stickslip_segment* segment, stickslip_state* state) {
  return stickslip::step(slider, segment, state);
}

int stickslip_step_planar(const stickslip_model* model, const stickslip_planar_segment* segment,
                          stickslip_planar_state* state) {
  return stickslip::step(model, segment, state);
}

int stickslip_advance_planar(const stickslip_slider* slider, const stickslip_planar_segment* segment,
                             stickslip_planar_state* state) {
  return stickslip::step(slider, segment, state);
}

int stickslip_advance_pendulum(const stickslip_pendulum* pendulum, const stickslip_segment* segment,
                               stickslip_pendulum_state* state, double* displacements) {
  using namespace stickslip;
  return c_status_of([&] {
    require_pointer(pendulum, "pendulum");
    require_pointer(state, "state");
    const Slider slider(pendulum_of(*pendulum), Mounting{.damping = pendulum->damping});
    State at = state_of(state->motion);
    at.pendulum = memory_of(state->memory);
    move(slider, flag(pendulum->clipped, "clipped") ? Contact::clipped : Contact::flight, segment, at);
    store(at, state->motion);
    store(at.pendulum, state->memory);
    if (displacements != nullptr)
      for (const double u : slider.law().displacements(at.pendulum)) *displacements++ = u;
  });
}

int stickslip_check(const stickslip_slider* slider) {
  return stickslip::detail::c_status_of(
      [&] { stickslip::with_slider(slider, [](const auto&, stickslip::Contact) {}); });
}

const char* stickslip_message(void) { return stickslip::detail::last_message; }

}  // extern "C"
