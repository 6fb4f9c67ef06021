// The event loop in the plane of one friction law, behind an interface that does not know the law.
#pragma once

#include <limits>

#include "stickslip/friction/law.hpp"
#include "stickslip/planar/advance.hpp"
#include "stickslip/planar/detail/sink.hpp"
#include "stickslip/planar/segment.hpp"
#include "stickslip/planar/slider.hpp"
#include "stickslip/planar/state.hpp"
#include "stickslip/run/detail/run.hpp"
#include "stickslip/run/response.hpp"
#include "stickslip/sliding/detail/engine.hpp"

namespace stickslip::detail {

/// Moves a slider in the plane, and answers what depends on its law. All that is computed of whole motions is written
/// over it, and compiled once.
class PlanarEngine {
 public:
  virtual ~PlanarEngine() = default;
  PlanarEngine(const PlanarEngine&) = delete;
  PlanarEngine& operator=(const PlanarEngine&) = delete;

  const Mounting& mounting() const noexcept { return mounting_; }
  const LawTraits& law() const noexcept { return law_; }

  /// Move a state through a segment.
  virtual void move(const PlanarLoadSegment& segment, Contact contact, PlanarState& state, PlanarSink& sink) const = 0;
  /// The same over a time without ground acceleration.
  void calm(double duration, Contact contact, PlanarState& state, PlanarSink& sink) const {
    move(load_segment(PlanarSegment{duration, {}, {}}, Slope(mounting_.slope())), contact, state, sink);
  }

  /// What friction holds at rest, and what resists sliding at a speed [m/s], under a normal force of `weight` times g,
  /// divided by the weight [m/s^2].
  virtual double hold(const PlanarState& state, double weight) const = 0;
  virtual double resist(const PlanarState& state, double weight, double speed) const = 0;
  /// Temperature of the sliding surface [degrees Celsius]; NaN if the law does not depend on it.
  virtual double temperature(const PlanarState& state) const = 0;

  /// The level against which it slides, under its weight [m/s^2].
  double level(const PlanarState& state) const { return resist(state, 1, norm(state.velocity)); }
  /// What can keep it from rest. A damper above the critical one lets a slider creep, too.
  Unrest unrest(const PlanarState& state) const {
    return {mounting_.natural_frequency, law_.constant && !is_stuck(state) && !(hold(state, 1) > 0),
            !law_.position || mounting_.damping > 0, standard_gravity * std::sin(mounting_.slope()),
            mounting_.stops.forward()};
  }
  /// Energy of springs in the law: none.
  double elastic(const PlanarState&) const noexcept { return 0; }

 protected:
  /// @param mounting  held by reference
  PlanarEngine(const Mounting& mounting, const LawTraits& law) noexcept : mounting_(mounting), law_(law) {}

 private:
  const Mounting& mounting_;
  LawTraits law_;
};

template <IsotropicLaw Law>
class PlanarEngineOf final : public PlanarEngine {
 public:
  /// @param slider  held by reference
  explicit PlanarEngineOf(const PlanarSlider<Law>& slider) noexcept
      : PlanarEngine(
            slider.mounting(),
            {.constant = form_of<Law> == Form::constant, .position = PositionLaw<Law>, .heated = HeatedLaw<Law>}),
        slider_(slider) {}

  void move(const PlanarLoadSegment& segment, Contact contact, PlanarState& state, PlanarSink& sink) const override {
    advance_plane(slider_, segment, contact, state, sink);
  }
  double hold(const PlanarState& state, double weight) const override { return hold_at(slider_, state, weight); }
  double resist(const PlanarState& state, double weight, double speed) const override {
    return resist_at(slider_, state, weight, speed);
  }
  double temperature([[maybe_unused]] const PlanarState& state) const override {
    if constexpr (HeatedLaw<Law>)
      return slider_.law().temperature(on_path<Law>(state));
    else
      return std::numeric_limits<double>::quiet_NaN();
  }

 private:
  const PlanarSlider<Law>& slider_;
};

}  // namespace stickslip::detail
