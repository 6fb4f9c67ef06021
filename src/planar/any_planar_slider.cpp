// Sliders of any law in the plane.
#include "stickslip/planar/any_planar_slider.hpp"

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

namespace stickslip {
namespace {

/// Calls a function now and then.
struct Reporting {
  const std::function<void()>& progress;
  unsigned flows = 0;

  template <class Flow>
  void follow(const Flow&, double, double) {
    if (++flows % 4096 == 0 && progress) progress();
  }
  void event(EventKind, double, const PlanarState&) noexcept {}
};

template <class Law>
std::string name_of_law(const Law&) {
  if constexpr (requires { Law::class_name; })
    return Law::class_name;
  else
    return "a law from functions";
}
template <class Law>
std::string name_of_law(const StaticKinetic<Law>& law) {
  return "StaticKinetic(" + name_of_law(law.sliding()) + ")";
}

// Why a law cannot be the same in all directions, if it says so.
template <class Law>
std::string why_not(const Law&) {
  if constexpr (requires { Law::not_isotropic; })
    return std::string(": ") + Law::not_isotropic;
  else
    return "";
}
template <class Law>
std::string why_not(const StaticKinetic<Law>& law) {
  return why_not(law.sliding());
}

// The laws for the plane, for messages.
std::string planar_laws() {
  std::string names;
  PlanarLaws::for_each([&]<class Law>() {
    if constexpr (requires { Law::class_name; })
      names +=
          names.empty() ? std::string(Law::class_name) + " with equal levels" : std::string(", ") + Law::class_name;
  });
  return names + ", and StaticKinetic of these";
}

}  // namespace

AnyPlanarSlider planar(const AnySlider& slider) {
  const auto refuse = [](const std::string& why) {
    throw std::invalid_argument("PlanarSlider: " + why + "; laws for the plane are " + planar_laws());
  };
  return std::visit(
      [&]<class Law>(const Slider<Law>& one) -> AnyPlanarSlider {
        const std::string name = name_of_law(one.law());
        if constexpr (IsotropicLaw<Law>) {
          if (!one.law().isotropic())
            refuse(name + " must have equal levels forward and backward to be the same in all directions");
          return PlanarSlider<Law>(one);
        } else {
          refuse(name + " cannot be used, because its friction is not defined in all directions" + why_not(one.law()));
          throw;  // not reached
        }
      },
      slider);
}

AnySlider along_axis(const AnyPlanarSlider& slider) {
  return std::visit([](const auto& one) -> AnySlider { return one.along_axis(); }, slider);
}

namespace {

// The result of `use` with the engine of a slider. What is computed of whole motions is compiled once, not for each law.
template <class Use>
auto with_engine(const AnyPlanarSlider& slider, Use&& use) {
  return use(*std::visit(
      []<class Law>(const PlanarSlider<Law>& one) -> std::unique_ptr<const detail::PlanarEngine> {
        return std::make_unique<detail::PlanarEngineOf<Law>>(one);
      },
      slider));
}

}  // namespace

PlanarResponse integrate(const AnyPlanarSlider& slider, const GroundMotion& motion,
                         const PlanarIntegrateOptions& options, PlanarResponse storage) {
  return with_engine(slider, [&](const detail::PlanarEngine& engine) {
    return detail::integrate(engine, motion, options, std::move(storage));
  });
}

PlanarHistories histories(const AnyPlanarSlider& slider, const GroundMotion& motion,
                          const std::function<void()>& progress) {
  return with_engine(slider, [&](const auto& engine) { return detail::histories(engine, motion, progress); });
}

PlanarForces forces(const AnyPlanarSlider& slider, const GroundMotion& motion, const PlanarResponse& response) {
  return with_engine(slider, [&](const auto& engine) { return detail::forces(engine, motion, response); });
}

Margins margins(const AnyPlanarSlider& slider, const GroundMotion& motion, const PlanarResponse& response) {
  return with_engine(slider, [&](const auto& engine) { return detail::margins(engine, motion, response); });
}

PlanarFloorMotion floor_motion(const AnyPlanarSlider& slider, const GroundMotion& motion,
                               const PlanarResponse& response, double tolerance) {
  return with_engine(slider,
                     [&](const auto& engine) { return detail::floor_motion(engine, motion, response, tolerance); });
}

std::vector<PlanarState> states_at(const AnyPlanarSlider& slider, const GroundMotion& motion,
                                   const PlanarResponse& response, std::span<const double> times) {
  return with_engine(slider, [&](const auto& engine) { return detail::states_at(engine, motion, response, times); });
}

void advance(const AnyPlanarSlider& slider, const PlanarSegment& segment, PlanarState& state, Contact contact,
             const std::function<void()>& progress) {
  advance(slider, detail::load_segment(segment, mounting_of(slider).slope()), state, contact, progress);
}
void advance(const AnyPlanarSlider& slider, const PlanarLoadSegment& segment, PlanarState& state, Contact contact,
             const std::function<void()>& progress) {
  std::visit([&](const auto& one) { advance(one, segment, state, Reporting{progress}, contact); }, slider);
}

}  // namespace stickslip
