// A response together with its slider and ground motion.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "any_response.hpp"
#include "bindings.hpp"
#include "structured.hpp"

namespace stickslip::python {

/// Reuses the memory of deleted responses for new ones: touching fresh memory takes as long as integrating a record.
/// Guarded by the interpreter lock.
class Storage {
 public:
  static Response take() {
    if (spare().empty()) return {};
    Response response = std::move(spare().back());
    spare().pop_back();
    return response;
  }

  static void give_back(Response&& response) {
    constexpr std::size_t max_responses = 2, max_bytes = 64 << 20;
    const std::size_t bytes = (response.displacement.capacity() + response.velocity.capacity()) * sizeof(double) +
                              response.events.capacity() * sizeof(Event);
    if (bytes > 0 && bytes <= max_bytes && spare().size() < max_responses) spare().push_back(std::move(response));
  }

 private:
  static std::vector<Response>& spare() {
    static auto* const spare = new std::vector<Response>;  // outlives every response
    return *spare;
  }
};

/// A parameter and the factor from its derivative to the derivative by the quantity that a name stands for.
struct UnitParameter {
  stickslip::Parameter parameter;
  double factor;
  std::optional<std::size_t> surface{};
};
/// @param name  such as 'mu', or 'mu[1]' for one surface of a MultiPendulum
/// @throws std::invalid_argument  an unknown name; begins with `who`
UnitParameter parameter_of(const std::string& name, const std::string& who);

/// Of `peak_force` and `peak_force_time` of every response.
inline constexpr const char* peak_force_doc =
    R"(Largest |friction + damper + spring| over all time, not only at samples [m/s^2].

Of vectors their resultant, of a structure that of its interface per unit of the reference mass; the impulses of stops do
not count. On first access the motion is integrated once more, with a search within each slip; the force of friction
without a spring follows from samples and events. Accurate to 1e-9.)";
inline constexpr const char* peak_force_time_doc =
    "Time of `peak_force` [s], to 1e-6 of a slip; the first, where it is constant.";

/// The name of a kind of event, for structured arrays: at most ten characters.
constexpr const char32_t* name_of(EventKind kind) {
  switch (kind) {
    case EventKind::breakaway:
      return U"breakaway";
    case EventKind::reversal:
      return U"reversal";
    case EventKind::arrest:
      return U"arrest";
    case EventKind::end:
      return U"end";
    case EventKind::impact:
      return U"impact";
    case EventKind::liftoff:
      return U"liftoff";
    case EventKind::landing:
      return U"landing";
  }
  return U"";
}

/// Events of a slider as a structured array.
template <class AnyEvent>
py::array events_array(const std::vector<AnyEvent>& events) {
  struct Row {
    double time;
    decltype(AnyEvent::displacement) displacement, velocity;
    TextField<10> kind;
  };
  const auto row = [&](std::size_t i) -> Row {
    const AnyEvent& e = events[i];
    return {e.time, e.displacement, e.velocity, name_of(e.kind)};
  };
  return structured(events.size(), row, std::pair("time", &Row::time), std::pair("displacement", &Row::displacement),
                    std::pair("velocity", &Row::velocity), std::pair("kind", &Row::kind));
}

/// `at` of the response of a slider.
template <class Find>
py::object slider_at(const char* who, const py::object& times, Find&& find) {
  using State = typename std::invoke_result_t<Find, const std::vector<double>&>::value_type;
  using Place = decltype(State::displacement);
  struct Row {
    double time;
    Place displacement, velocity;
    double gap;
    bool stuck;
  };
  const auto row = [](double t, const State& s) {
    return Row{t, s.displacement, s.velocity, s.gap, detail::is_stuck(s)};
  };
  return at(who, times, find, row, std::pair("time", &Row::time), std::pair("displacement", &Row::displacement),
            std::pair("velocity", &Row::velocity), std::pair("gap", &Row::gap), std::pair("stuck", &Row::stuck));
}

/// The events of one kind.
template <class AnyEvent>
std::vector<AnyEvent> events_of_kind(const std::vector<AnyEvent>& events, EventKind kind) {
  std::vector<AnyEvent> found;
  std::ranges::copy_if(events, std::back_inserter(found), [&](const AnyEvent& e) { return e.kind == kind; });
  return found;
}

/// How often a slip begins.
template <class AnyEvent>
std::ptrdiff_t slips(const std::vector<AnyEvent>& events) {
  return std::ranges::count_if(
      events, [](const AnyEvent& e) { return e.kind == EventKind::breakaway || e.kind == EventKind::reversal; });
}

/// The remark on a pendulum that leaves its linear range; empty for others.
inline std::string pendulum_remark(const Mounting& mounting, double peak) {
  constexpr double most = 0.2;
  const double radius = standard_gravity / mounting.stiffness();
  if (!mounting.pendulum || peak <= most * radius) return "";
  return "the displacement reaches " + digits(peak) + " m, beyond 0.2 of the radius of " + digits(radius) +
         " m up to which a pendulum is linear to 2 %";
}

/// The same of a pendulum with several surfaces. No element turns farther than in one motion to the peak.
inline std::string angle_remark(const MultiPendulum& law, double peak) {
  constexpr double most = 0.2;
  State state = State::at(peak, 0);
  law.begin(state);
  double steepest = 0;
  for (std::size_t k = 0; k < law.elements().size(); ++k)
    steepest = std::max(steepest, law.displacement(state.pendulum, static_cast<int>(k)) / law.elements()[k].radius);
  if (steepest <= most) return "";
  return "a surface turns by " + digits(steepest) + " rad, beyond the 0.2 up to which a pendulum is linear to 2 %";
}

/// The remark on a slider of either kind.
inline std::string linear_remark(const AnySlider& slider, double peak) {
  if (const auto* bearing = std::get_if<Slider<MultiPendulum>>(&slider)) return angle_remark(bearing->law(), peak);
  return pendulum_remark(mounting_of(slider), peak);
}

struct ResponseWithInputs {
  Response response;
  py::object slider;
  py::object motion;
  py::object time{}, events{};     // arrays, made on first access
  std::optional<Forces> forces{};  // likewise
  std::optional<LargestForce> largest_force{};

  ResponseWithInputs(Response&& answer, py::object what, py::object under)
      : response(std::move(answer)), slider(std::move(what)), motion(std::move(under)) {}
  ResponseWithInputs(ResponseWithInputs&&) = default;
  ~ResponseWithInputs() { Storage::give_back(std::move(response)); }
};

/// Calls `work` with the slider, and the motion in its static type.
template <class Work>
auto with_inputs(const ResponseWithInputs& self, Work&& work) {
  const auto& slider = self.slider.cast<const AnySlider&>();
  if (py::isinstance<GroundMotion>(self.motion)) return work(slider, self.motion.cast<const GroundMotion&>());
  return work(slider, self.motion.cast<const HarmonicMotion&>());
}

}  // namespace stickslip::python
