// Figures of the transport operator by refinement of step and grid together, with their errors.
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "stickslip/sliding/any_slider.hpp"
#include "stickslip/statistics/tally.hpp"
#include "stickslip/theory/transport.hpp"
#include "theory/transport/chain.hpp"
#include "theory/transport/held_motion.hpp"
#include "theory/transport/load_grid.hpp"

namespace stickslip::detail {

/// A slider, what excites it, and the scales of its motion.
class TransportProblem {
 public:
  TransportProblem(const AnySlider& slider, const theory::TransportExcitation& excitation);

  const HeldMotion& motion() const noexcept { return motion_; }
  bool sprung() const noexcept { return motion_.stiffness() > 0; }
  /// Whether the displacement is part of the state.
  bool with_displacement() const noexcept { return sprung() || std::isfinite(motion_.reach()); }
  /// Whether it leaves the reach of its friction in the long run, so that it never becomes stationary.
  bool wanders() const noexcept { return with_displacement() && !sprung(); }
  /// Whether it cannot slide backward.
  bool one_way() const noexcept { return !std::isfinite(motion_.start(Direction::backward)); }

  /// The higher level at the beginning of a slip over the lower one.
  double levels_apart() const noexcept;

  /// Whether two slots to the half width of a pulse are a chain of moderate size.
  bool can_halve_slots(bool with_x) const;
  /// A bound of the relative error of one slot, measured: docs/transport.md.
  double error_of_one_slot() const;
  /// A bound of the relative error of displacements, if pulses that began before the start are on one slot.
  double error_of_start(double time) const;

  /// How long each value of the noise is held [s]; 0 for continuous noise.
  double held() const noexcept { return held_; }
  bool white() const noexcept { return s0_ > 0; }
  bool pulses() const noexcept { return pulses_.has_value(); }

  /// The probability that a slider at rest has not slipped by a time [s].
  Estimate resting(double time) const;

  /// A step with which errors are some percent [s].
  double first_step() const noexcept;

  /// The window of a grid.
  struct Window {
    double x = 0, v = 0;  ///< rms, estimated
    bool graded = false;  ///< panels in x become narrow towards the start, for the law of x
  };
  Window first_window() const noexcept;
  /// Of a mass without friction that starts at rest, under white noise.
  Window free_window(double time) const noexcept;

  /// @param fineness  of the grid, from 0
  /// @param wall      as of `Chain`; x is then part of the state in any case
  Chain chain(double step, std::size_t fineness, const Window& window,
              double wall = std::numeric_limits<double>::infinity()) const;

  /// How steps from rest to a time are counted: the longest step, which divides the time unless it is that of held
  /// noise or pulses.
  struct Steps {
    double step;
    std::size_t count;
  };
  /// @throws std::invalid_argument for a million steps and more
  Steps steps_to(double time) const;

  /// The earliest time [s] that such steps resolve; before it, steps must be shorter, and under pulses there are none.
  double earliest(double step) const noexcept {
    return pulses_ ? (pulses_->stationary ? 3 : 2) * step : held_ > 0 ? 0 : least_steps() / 3 * step;
  }

 private:
  double ground_velocity() const noexcept;
  /// Whether the step is that of held noise or pulses.
  bool fixed_step() const noexcept { return held_ > 0 || pulses_; }
  double least_steps() const noexcept { return white() ? 24 : 8; }  // to a time
  double level() const noexcept;                                    // the smaller one at the beginning of a slip
  Panels velocities(double step, std::size_t degree, double rms, double reach) const;

  /// Pulses of two equal steps, up and down.
  struct Pulses {
    double half_width;               // [s]
    pulse_chain::Arrivals arrivals;  // to a half width; in m/s^2
    bool stationary;
    double velocity;  // rms of the ground [m/s]
  };

  /// Of amplitudes of batches.
  struct Lattice {
    double spacing;  // [m/s^2]
    int reach;       // in spacings
    std::size_t slots;
    double arriving;  // mean number in a step
  };
  Lattice lattice(double step, std::size_t fineness) const;
  LoadGrid batches(double step, std::size_t fineness) const;
  /// What the strongest pulses give to a slider at rest: it does not count in an rms if they are rare.
  struct Slip {
    double displacement, velocity;
  };
  Slip strong_pulse(double reach) const;

  HeldMotion motion_;
  std::optional<FilterStates> filtered_;
  std::optional<Pulses> pulses_;
  double s0_ = 0;     // of white noise
  double power_ = 0;  // that the noise gives to a free mass, per unit mass: half the growth of E[v^2] [m^2/s^3]
  double held_ = 0;
};

/// What is computed with one chain: all figures, in any units.
using Figures = Eigen::VectorXd;

struct Accuracy {
  double tolerance;                  ///< relative
  std::vector<Eigen::Index> judged;  ///< the figures whose errors must be below it
  std::size_t levels = 4;            ///< of refinement, at most
  std::vector<Eigen::Index>
      slow{};  ///< probabilities of rest, or near it, whose error is not of second order in the step
};

struct Refined {
  Figures value, error;
  Figures lattice{};       ///< a further error, which no grid of this size reduces: that of the lattice of pulses
  std::size_t nodes = 0;   ///< of the finest grid
  std::size_t levels = 0;  ///< of refinement

  bool within(const Accuracy& accuracy) const;
  double whole_error(Eigen::Index i) const { return error[i] + lattice[i]; }
};

/// The figures as the step goes to zero. Their errors are the last change of the extrapolation or half of the one
/// before, plus the change from the grid before. Ends at the largest grid, also if the errors are larger than they must be.
/// @param compute  the figures of a chain
Refined refine(const TransportProblem& problem, const TransportProblem::Window& window, double first_step,
               const Accuracy& accuracy, const std::function<Figures(const Chain&)>& compute,
               double wall = std::numeric_limits<double>::infinity());

}  // namespace stickslip::detail
