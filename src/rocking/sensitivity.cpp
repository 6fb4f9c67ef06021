#include "stickslip/rocking/sensitivity.hpp"

#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "rocking/leg.hpp"
#include "rocking/run.hpp"
#include "rocking/system.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/rocking/state.hpp"

namespace stickslip {
namespace detail {
namespace {

/// Follows a motion with its variation by one parameter.
class Variation final : public RockingSink {
 public:
  Variation(const SlenderBlock& block, RockingParameter parameter, const RockingState& start)
      : block_(block),
        square_(block.p() * block.p() / standard_gravity),
        parameter_(parameter),
        highest_(std::abs(start.rotation)) {}

  void begin_segment(const RockingSegment& ground) noexcept { ground_ = ground; }

  void follow(const RockingLeg& leg, double begin, double duration, const RockingPlace& end) override {
    leg.for_each_turn(duration, end, [&](const RockingPlace& at, double t) { reach(at, vary(leg, begin, t)); });
    now_ = vary(leg, begin, duration);
    reach(end, now_);
    arrives_ = leg.acceleration(end.rotation, duration);
  }

  void event(EventKind kind, double time, const RockingState& state) override {
    if (kind == EventKind::impact) {
      now_ = after_impact(block_, ground_, time, state, arrives_, now_);
      if (parameter_ == RockingParameter::restitution) now_.rate += state.rate;
    } else if (kind != EventKind::end) {
      now_ = {0, 0};
    }
  }

  RockingSensitivity found(const RockingState& end) const noexcept {
    if (end.mode == RockingMode::rest) return {peak_, 0, 0};
    return {peak_, now_.rotation, now_.rate};
  }

 private:
  // The variation at a time of a leg that begins at a time of the segment, from that at its start.
  RockingPlace vary(const RockingLeg& leg, double begin, double t) const {
    const double p = block_.p(), n0 = ground_.n(begin), side = leg.side();
    const double n1 = ground_.duration > 0 ? (ground_.n_end - ground_.n_start) / ground_.duration : 0;
    const HyperbolicSums sums(p, t);
    // The force on it, constant and linear in time.
    double force = 0, slope = 0;
    switch (parameter_) {
      case RockingParameter::scale:
        force = -square_ * n0, slope = -square_ * n1;
        break;
      case RockingParameter::alpha:
        force = -p * p * side;
        break;
      case RockingParameter::alpha_right:
        force = side > 0 ? -p * p : 0;
        break;
      case RockingParameter::alpha_left:
        force = side < 0 ? p * p : 0;
        break;
      case RockingParameter::p:
      case RockingParameter::restitution:
        break;
    }
    RockingPlace place = HyperbolicMotion{now_, p * p * now_.rotation + force, -slope / (p * p), p}.at(sums);
    if (parameter_ != RockingParameter::p) return place;
    // Of 2 theta''/p, with theta'' = a cosh(pt) + b sinh(pt)/p: t (a sinh(pt) + b cosh(pt)/p)/p^2 - b sinh(pt)/p^4.
    const double a = leg.acceleration(leg.start().rotation, 0), b = p * p * leg.start().rate - square_ * n1;
    place.rotation += (a * t * sums.first + b / (p * p) * (t * sums.cosh - sums.first)) / p;
    place.rate += (a * (sums.first + t * sums.cosh) + b * t * sums.first) / p;
    return place;
  }
  void reach(const RockingPlace& place, const RockingPlace& variation) noexcept {
    if (!(std::abs(place.rotation) > highest_)) return;
    highest_ = std::abs(place.rotation);
    peak_ = place.rotation > 0 ? variation.rotation : -variation.rotation;
  }

  const SlenderBlock& block_;
  const double square_;  // p^2 / g
  const RockingParameter parameter_;
  RockingSegment ground_{};
  RockingPlace now_{0, 0};  // the variation
  double arrives_ = 0;      // theta'' at the end of the last leg
  double highest_;          // |theta| so far
  double peak_ = 0;         // its derivative
};

}  // namespace
}  // namespace detail

RockingSensitivity sensitivity(const SlenderBlock& block, const GroundMotion& motion, const RockingResponse& response,
                               RockingParameter parameter) {
  if (response.overturned != 0)
    throw std::invalid_argument("sensitivity: the block has overturned; its rotation depends on no parameter");
  if (motion.has_vertical())
    throw std::invalid_argument(
        "sensitivity: covers a slender block without vertical motion; take differences of two responses");
  if (response.rotation.empty())
    throw std::invalid_argument("sensitivity: needs a response of integrate, with its samples");
  RockingState state = RockingState::at(response.rotation.front(), response.rate.front());
  detail::Variation variation(block, parameter, state);
  const auto go = [&](const detail::RockingSegment& ground) {
    variation.begin_segment(ground);
    detail::rock(block, ground, state, variation);
  };
  for (std::size_t i = 0; i < motion.segments(); ++i) go(detail::segment_of(motion, i));
  // After it as far as the response goes, which is to rest.
  const bool settled = response.events.back().time > motion.time(motion.segments());
  while (settled && state.mode != RockingMode::rest && state.overturned == 0) go(detail::calm_for(64 / block.p()));
  return variation.found(state);
}

}  // namespace stickslip
