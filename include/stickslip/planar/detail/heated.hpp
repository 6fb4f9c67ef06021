// Friction in the plane that depends on the temperature of a surface that it heats.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "stickslip/base/min_max.hpp"
#include "stickslip/flow/collocation.hpp"
#include "stickslip/flow/detail/heated_level.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/planar/flow.hpp"
#include "stickslip/planar/state.hpp"

namespace stickslip {
namespace detail {

/// The law during a step: the factor of normal force and heat is a polynomial in time, whose powers are in units of the
/// step.
template <SeparableHeatedLaw Law>
class HeatedStep {
 public:
  HeatedStep(const Law& law, const Nodes::Values& powers, double step) : law_(&law), step_(step), powers_(powers) {}

  template <class Time, class Speed>
  auto resist_at(const Time& time, const Speed& speed) const {
    return law_->speed_factor(speed) * polynomial<Nodes::points - 1>(time * (1 / step_));
  }

 private:
  // Horner's rule, for numbers and series.
  template <std::size_t k, class Part>
  auto polynomial(const Part& part) const {
    if constexpr (k == 1)
      return part * powers_[1] + powers_[0];
    else
      return part * lower<k, 1>(part) + powers_[0];
  }
  template <std::size_t k, std::size_t i, class Part>
  auto lower(const Part& part) const {
    if constexpr (i + 1 == k)
      return part * powers_[k] + powers_[i];
    else
      return part * lower<k, i + 1>(part) + powers_[i];
  }

  const Law* law_;
  double step_;
  Nodes::Values powers_;
};

/// Makes the slips of a heated law: the heat generated in a step acts back on the level in it, which is found by
/// iteration, to 1e-9 of the level. A step is shortened until what the last terms of the polynomial contribute to the
/// speed is below 1e-8 of it, as on one axis.
template <SeparableHeatedLaw Law>
class Heating {
 public:
  explicit Heating(const Law& law) : law_(law) {}

  /// @param make    `make(law, step)` computes the slip over a step, a PlanarSlide
  /// @param weight  `weight(time)` is N+/g at a time from now [s]
  /// @param covers  whether friction heats the surface
  template <class Slide, class Make, class Weight>
  Slide slide(const PlanarState& state, double left, bool covers, Make&& make, Weight&& weight) {
    const Nodes& nodes = Nodes::get();
    const double heating = covers ? law_.heating(State{}, Direction::forward) : 0;
    std::optional<Slide> slip;
    double step = std::min(left, 16 * last_step_);
    // A slow slip follows the load for a long time, which a short step would hide.
    const double resists = weight(0) * law_.level_at_high_speed(weight(0), state.heat.half_integral());
    if (256 * norm(state.velocity) < resists * left) step = left;
    // A speed that displaces nothing: where the weight begins at zero, no step would be short enough for its level.
    const double slowest =
        0x1p-40 * left * weight(left) * law_.level_at_high_speed(weight(left), state.heat.half_integral());
    for (int shortened = 0;; ++shortened) {
      HeatedLevel<Law> level(law_, heating, cooling_.half_integrals(state.heat, step),
                             nodes.at_nodes([&](double part) { return weight(part * step); }), step,
                             nodes.at_nodes([&](double) { return norm(state.velocity); }));
      bool settled = false;
      double fastest = 0;  // [m/s]
      for (int sweep = 0; sweep < 30 && !settled; ++sweep) {
        slip.emplace(make(HeatedStep<Law>(law_, level.powers(), step), step));
        const auto& flow = slip->flow;
        if (!flow.is_series() || !(flow.end.time > 0)) {  // so close to a stop that no heat matters
          heats_ = false;
          return *slip;
        }
        if (!covers_whole(flow, step)) break;
        const auto speeds = nodes.at_nodes([&](double part) { return norm(flow.at(part * step).velocity); });
        fastest = *std::max_element(speeds.begin(), speeds.end());
        settled = level.follow(speeds);
      }
      const double heaviest = std::max(weight(0), weight(step));
      const bool resolved = settled && step * heaviest * level.error() <= 1e-8 * std::max(fastest, slowest);
      const double reached = slip->flow.end.time;
      const bool whole = covers_whole(slip->flow, step);
      if ((resolved && whole) || shortened > 60) {
        heat_ = level.heat();
        step_ = step;
        heats_ = heating > 0;
        last_step_ = step < left ? step : std::max(step, last_step_);
        return *slip;
      }
      if (whole)
        step /= 2;
      else
        step = (slip->flow.stop() < never || slip->flow.leaves ? 1.02 : 0.98) *
               reached;  // where it stops, no heat follows
    }
  }

  /// Update the surface with the heat of the last slip up to a time.
  void heat(double time, SurfaceHeat& surface) {
    if (heats_ && time > 0)
      cooling_.heat(surface, heat_, step_, std::min(time / step_, 1.0));
    else
      surface.rest(time);
  }

  /// The time at which the level falls below the load of a slider at rest: `excess(time, level)` is the square of the
  /// load minus that of the level, which is positive after the departure. The margin is approximated by polynomials on
  /// successive parts of the time, to 1e-9 of its terms. The surface cools until then.
  /// @return the time [s]; `never` if it is held
  template <class Weight, class Excess>
  double departure(SurfaceHeat& surface, double left, Weight&& weight, Excess&& excess) {
    const Nodes& nodes = Nodes::get();
    for (double passed = 0, step = left;;) {
      const Nodes::Values half = cooling_.half_integrals(surface, step);
      Nodes::Values margin, powers;
      double scale = 0;
      for (std::size_t i = 0; i < margin.size(); ++i) {
        const double then = passed + nodes.nodes[i] * step, w = weight(then), level = w * law_.level(0, w, half[i]);
        margin[i] = -excess(then, level);
        scale = std::max(scale, std::abs(margin[i]) + level * level);
      }
      if (margin[0] < 0 && !(passed > 0)) return 0;  // the load already exceeds the level, as after a stop
      const Nodes::Values c = nodes.chebyshev(margin);
      if (std::abs(c[c.size() - 1]) + std::abs(c[c.size() - 2]) > 1e-9 * scale && step > 0x1p-40 * left) {
        step /= 2;
        continue;
      }
      int degree = Nodes::powers(c, 1e-15 * scale, powers);
      const double* from = powers.data();
      if (!(margin[0] > 0))  // a load equal to the level is held
        for (++from, --degree; degree >= 0 && equal(*from, 0);) ++from, --degree;
      const double part = degree < 0 ? never : *from > 0 ? FirstRoot(from, degree).find() : 0;
      if (part <= 1) {
        surface.rest(part * step);
        return passed + part * step;
      }
      surface.rest(step);
      passed += step;
      if (!(passed < left && step > 0)) return never;
      step = std::min(2 * step, left - passed);
    }
  }

 private:
  // Whether a slip lasts for a step, or stops, or leaves a stop, shortly before its end.
  template <class Flow>
  static bool covers_whole(const Flow& flow, double step) noexcept {
    return flow.end.time >= step * (flow.stop() < never || flow.leaves ? 0.9 : 1 - 1e-9);
  }

  const Law& law_;
  Cooling cooling_;
  Nodes::Values heat_{};  // of the last slip, in powers of time per step
  double step_ = 0, last_step_ = never;
  bool heats_ = false;
};

/// The heating of a law; of one that does not depend on it, nothing.
template <class Law>
struct HeatingOf {
  explicit HeatingOf(const Law&) {}
};
template <HeatedLaw Law>
struct HeatingOf<Law> : Heating<Law> {
  using Heating<Law>::Heating;
};

}  // namespace detail
}  // namespace stickslip
