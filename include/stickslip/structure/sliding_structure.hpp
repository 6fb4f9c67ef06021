// Linear structures in which one interface slides, and the integration of their motion.
#pragma once

#include <functional>
#include <memory>

#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/ground/segment.hpp"
#include "stickslip/sliding/any_slider.hpp"
#include "stickslip/structure/response.hpp"
#include "stickslip/structure/structure.hpp"

namespace stickslip {
namespace detail {
struct ModalInterface;
class LinearSteps;
}  // namespace detail

/// A linear structure with one sliding interface: the base of IsolatedStructure, EquipmentOnFloor and FlexibleSlope.
/// Everything is per reference mass: x the displacement of the interface [m], q the force that a bond would have to
/// carry [m/s^2]. The interface is stuck while
///     -hold_backward N+/g <= q <= hold_forward N+/g,
/// and slides against the resistance of its law; between events the structure and the interface obey linear equations,
/// which are expanded into power series over steps of at most 3 / fastest(). N = g + a_z; where it is negative the
/// interface slides without friction (Contact::clipped), because the structure does not move vertically.
/// Immutable; copies share their data.
class SlidingStructure {
 public:
  const Structure& structure() const noexcept;
  /// The law, spring, damper and stops of the interface, per reference mass.
  const AnySlider& slider() const noexcept;

  /// The mass that the interface feels when it starts to slide, as a fraction of the reference mass.
  double interface_mass() const noexcept;
  /// Largest magnitude of an eigenvalue of the motion, stuck or sliding [rad/s].
  double fastest() const noexcept;
  /// A segment takes fastest() dt / 3 expansions. Above this product of fastest() and the mean time step of the ground
  /// motion, at which a sample takes some 10 ms with one mode, the structure is refused.
  static constexpr double most_rate_per_step = 10000;

  /// At rest at x = 0.
  StructureState rest() const;
  /// The force that the bond would have to carry, per reference mass [m/s^2].
  /// @param ground  acceleration n of the ground [m/s^2]
  /// @param weight  N+/g
  double demand(const StructureState& state, double ground, double weight = 1) const;

  const detail::ModalInterface& modal() const noexcept;  ///< for the library
  detail::LinearSteps& steps() const noexcept;           ///< for the library

 protected:
  /// @param name  of the class, for messages
  SlidingStructure(const char* name, AnySlider slider, Structure structure, detail::ModalInterface modal);

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

struct StructureIntegrateOptions {
  double displacement = 0;  ///< x at the start [m], finite
  double velocity = 0;      ///< x' at the start [m/s], finite; the structure is at rest relative to its base
  /// Continue without ground motion after the last sample, until it is certain that the interface will not slide again.
  bool settle = false;
  std::function<void()> progress{};  ///< called about once per second or more often; may throw to stop the work
  double sliding_distance = 0;       ///< before the start [m], finite and at least 0; used by laws with memory
  bool floors = true;                ///< whether to compute `floors`
  SurfaceHeat heat{};  ///< of the sliding surface at the start; used by laws that depend on its temperature

  /// Those that settle.
  static StructureIntegrateOptions settled() {
    StructureIntegrateOptions options;
    options.settle = true;
    return options;
  }
};

/// Integrate the motion of a structure with one sliding interface under a ground motion, from rest or from a given
/// motion of the interface.
/// @return the response at the samples, with events, energy and floors
/// @throws std::invalid_argument  a start that is not finite or beyond a stop; fastest() times the mean time step above
///                                SlidingStructure::most_rate_per_step
/// @throws std::overflow_error    a displacement, velocity or energy beyond the range of doubles
/// @throws ConvergenceError       more events than 1,000,000 plus eight per segment; with `settle`, the interface does
///                                not come to rest within a million steps: an undamped structure can make it slide
///                                again
/// Exact to round-off with constant friction, also between samples: peaks and events are zeros of power series within
/// certified bounds. Cost: proportional to the number of modes, to the number of steps (a segment takes
/// fastest() dt / 3 of them, at least one) and to the number of floors.
StructureResponse integrate(const SlidingStructure& system, const GroundMotion& motion,
                            const StructureIntegrateOptions& options = {});

/// Integrate over one segment, for codes with their own time loop.
/// @param segment  load and normal force per unit mass on level ground: load = -n, normal = g + a_z
/// @param state    replaced by the state at the end; unchanged on an error
/// @throws as `integrate`
void advance(const SlidingStructure& system, const LoadSegment& segment, StructureState& state);

/// The same under a segment of horizontal ground motion.
void advance(const SlidingStructure& system, const Segment& segment, StructureState& state);

}  // namespace stickslip
