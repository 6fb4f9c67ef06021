// A response together with its slider and ground motion.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "bindings.hpp"

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
};
/// @throws std::invalid_argument  an unknown name; begins with `who`
UnitParameter parameter_of(const std::string& name, const std::string& who);

/// Events as a structured array, that of `Response.events`.
py::array events_array(const std::vector<Event>& events);

struct ResponseWithInputs {
  Response response;
  py::object slider;
  py::object motion;
  py::object time{}, events{};     // arrays, made on first access
  std::optional<Forces> forces{};  // likewise

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
