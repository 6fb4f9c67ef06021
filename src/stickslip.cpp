// The C interface. It needs the header-only core and the standard library, no more.
#include "stickslip/stickslip.h"

#include <cmath>
#include <cstddef>
#include <cstring>
#include <exception>
#include <limits>
#include <stdexcept>
#include <string>

#include "stickslip/detail/min_max.hpp"
#include "stickslip/error.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/friction/static_kinetic.hpp"
#include "stickslip/ground/segment.hpp"
#include "stickslip/slider.hpp"
#include "stickslip/sliding/advance.hpp"
#include "stickslip/state.hpp"
#include "stickslip/stops.hpp"

namespace stickslip {
namespace {

constexpr std::size_t longest_message = 512;
thread_local char last_message[longest_message] = "";

/// Stores the message of the current exception and returns its status.
int failed() noexcept {
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

/// Calls `work` and returns its status.
template <class Work>
int guarded(Work&& work) noexcept {
  try {
    work();
    return STICKSLIP_OK;
  } catch (...) {
    return failed();
  }
}

void require_pointer(const void* pointer, const char* name) {
  if (pointer == nullptr) throw std::invalid_argument(std::string("stickslip: ") + name + " must not be null");
}

bool flag(int value, const char* name) {
  detail::require(value == 0 || value == 1, std::string("stickslip_slider: ") + name + " must be 0 or 1", value);
  return value == 1;
}

/// The distance to a stop; infinite if there is none.
double gap(double given, const char* name) {
  detail::require(given >= 0, std::string("stickslip_slider: ") + name + " must be at least 0", given, "m");
  return given > 0 ? given : std::numeric_limits<double>::infinity();
}

Mounting mounting(const stickslip_slider& s) {
  return {.natural_frequency = s.natural_frequency,
          .damping = s.damping,
          .slope_degrees = s.slope_degrees,
          .one_way = flag(s.one_way, "one_way"),
          .stops = Stops(gap(s.gap, "gap"), gap(s.backward_gap, "backward_gap"), s.restitution)};
}

/// Calls `work` with the slider.
template <class Work>
void with_slider(const stickslip_slider* s, Work&& work) {
  require_pointer(s, "slider");
  const Contact contact = flag(s->clipped, "clipped") ? Contact::clipped : Contact::flight;
  const Coulomb sliding(s->slip_level);
  if (s->static_level == 0)
    work(Slider(sliding, mounting(*s)), contact);
  else
    work(Slider(StaticKinetic(sliding, s->static_level), mounting(*s)), contact);
}

State state_of(const stickslip_state& s) {
  const double sign = s.velocity > 0 ? 1 : s.velocity < 0 ? -1 : 0;
  detail::require(s.mode == 0 || s.mode == 1 || s.mode == -1, "stickslip_state: mode must be 0, 1 or -1", s.mode);
  detail::require(sign == 0 || s.mode == sign,
                  "stickslip_state: mode must be the sign of the velocity, " + detail::shortest(s.velocity) + " m/s",
                  s.mode);
  detail::require(s.in_flight == 0 || s.in_flight == 1, "stickslip_state: in_flight must be 0 or 1", s.in_flight);
  detail::require(s.gap >= 0 && std::isfinite(s.gap), "stickslip_state: gap must be finite and at least 0", s.gap, "m");
  detail::require(std::isfinite(s.gap_velocity), "stickslip_state: gap_velocity must be finite", s.gap_velocity, "m/s");
  return {s.displacement,   s.velocity, static_cast<Mode>(static_cast<int>(s.mode)),
          s.in_flight == 1, s.gap,      s.gap_velocity};
}

}  // namespace
}  // namespace stickslip

extern "C" {

int stickslip_advance(const stickslip_slider* slider, const stickslip_segment* segment, stickslip_state* state) {
  using namespace stickslip;
  return guarded([&] {
    require_pointer(segment, "segment");
    require_pointer(state, "state");
    with_slider(slider, [&](const auto& moving, Contact contact) {
      State at = state_of(*state);
      const stickslip_segment& s = *segment;
      const Segment horizontal{s.duration, s.start, s.end};
      NoObserver none;
      if (s.vertical_start == 0 && s.vertical_end == 0)
        advance(moving, horizontal, at, none, contact);
      else
        advance(moving, detail::load_segment(horizontal, moving.slope(), s.vertical_start, s.vertical_end), at, none,
                contact);
      *state = {at.displacement,          at.velocity, static_cast<double>(at.mode),
                at.in_flight ? 1.0 : 0.0, at.gap,      at.gap_velocity};
    });
  });
}

int stickslip_check(const stickslip_slider* slider) {
  return stickslip::guarded([&] { stickslip::with_slider(slider, [](const auto&, stickslip::Contact) {}); });
}

const char* stickslip_message(void) { return stickslip::last_message; }

}  // extern "C"
