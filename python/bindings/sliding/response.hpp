// A response together with what it came from.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "bindings.hpp"

namespace stickslip::python {

/// Memory of responses that are gone, for those to come: to touch fresh memory takes as long as to slide through a
/// record. Guarded by the interpreter lock.
class Storage {
 public:
  static Response take() {
    if (spare().empty()) return {};
    Response response = std::move(spare().back());
    spare().pop_back();
    return response;
  }

  static void give_back(Response&& response) {
    constexpr std::size_t most_responses = 2, most_bytes = 64 << 20;
    const std::size_t bytes = (response.displacement.capacity() + response.velocity.capacity()) * sizeof(double) +
                              response.events.capacity() * sizeof(Event);
    if (bytes > 0 && bytes <= most_bytes && spare().size() < most_responses) spare().push_back(std::move(response));
  }

 private:
  static std::vector<Response>& spare() {
    static auto* const spare = new std::vector<Response>;  // outlives every response
    return *spare;
  }
};

/// Events as the structured array that `Response.events` is.
py::array events_array(const std::vector<Event>& events);

struct Recording {
  Response response;
  py::object slider;
  py::object motion;
  py::object time{}, events{};     // arrays, made when first asked for
  std::optional<Forces> forces{};  // and these

  Recording(Response&& answer, py::object what, py::object under)
      : response(std::move(answer)), slider(std::move(what)), motion(std::move(under)) {}
  Recording(Recording&&) = default;
  ~Recording() { Storage::give_back(std::move(response)); }
};

/// What `work` gives with the slider and the motion in their own types.
template <class Work>
auto with_inputs(const Recording& recording, Work&& work) {
  return std::visit(
      [&](const auto& slider) {
        if (py::isinstance<GroundMotion>(recording.motion))
          return work(slider, recording.motion.cast<const GroundMotion&>());
        return work(slider, recording.motion.cast<const HarmonicMotion&>());
      },
      recording.slider.cast<const AnySlider&>());
}

}  // namespace stickslip::python
