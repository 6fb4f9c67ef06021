// The motion in the plane at the samples only: faster than a full response.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <vector>

#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/planar/integrate.hpp"
#include "stickslip/planar/slider.hpp"
#include "stickslip/planar/state.hpp"
#include "stickslip/planar/vector.hpp"
#include "stickslip/sliding/detail/recorder.hpp"
#include "stickslip/sliding/detail/run.hpp"

namespace stickslip {

/// The motion in the plane at the samples of a ground motion.
struct PlanarHistories {
  std::vector<Vector2> displacement;  ///< r [m]
  std::vector<Vector2> velocity;      ///< r' [m/s]
};

namespace detail {

/// Records nothing of a motion in the plane; counts its events, and reports progress.
class NoPlanarRecorder final : public PlanarSink {
 public:
  static constexpr std::uint32_t work_per_report = 4096;  // events or flows

  NoPlanarRecorder(std::size_t event_limit, const std::function<void()>& progress)
      : event_limit_(event_limit), progress_(progress) {}

  void report_progress() const {
    if (progress_) progress_();
  }
  void follow(const PlanarSlipFlow&, double, double) override { count_work(); }
  void event(EventKind, double, const PlanarState&) override {
    count_work();
    if (++events_ > event_limit_) refuse_more_events(event_limit_);
  }

 private:
  void count_work() {
    if (++work_ % work_per_report == 0) report_progress();
  }

  std::size_t event_limit_, events_ = 0;
  std::uint32_t work_ = 0;
  const std::function<void()>& progress_;
};

}  // namespace detail

/// Integrate the motion in the plane from rest at r = 0 and return only displacement and velocity at the samples,
/// without the events, peak and energy that `integrate` returns; see PlanarSlider for the equation.
/// @param slider    any law for the plane, with or without a spring, a damper, a slope and a stop
/// @param motion    the ground acceleration, with a transverse component; a vertical one acts, too
/// @param progress  called about once per second or more often; may throw to stop the work; optional
/// @throws std::invalid_argument  a motion without a transverse component; a vertical motion under which the slider
///                                never lands
/// @throws std::overflow_error    a displacement or velocity beyond the range of doubles
/// @throws ConvergenceError       as `integrate`
/// The same bits as `integrate`. Cost: 2 to 10 ns a sample at rest; while it slides, about half of that of `integrate`.
template <IsotropicLaw Law>
PlanarHistories histories(const PlanarSlider<Law>& slider, const GroundMotion& motion,
                          const std::function<void()>& progress = {}) {
  const detail::PlanarPieces pieces(motion, slider.slope());
  detail::check_landing(motion, slider.slope());
  PlanarHistories result{std::vector<Vector2>(motion.samples()), std::vector<Vector2>(motion.samples())};
  PlanarState state;
  detail::NoPlanarRecorder none(detail::max_events(motion.segments()), progress);
  const auto go = [&](std::size_t, double, double, const PlanarLoadSegment& segment) {
    detail::advance_plane(slider, segment, Contact::flight, state, none);
  };
  detail::walk_plane(slider, motion, pieces, state, result.displacement, result.velocity, go,
                     [&] { none.report_progress(); });
  for (const auto* values : {&result.displacement, &result.velocity})
    for (const Vector2 v : *values)
      if (!std::isfinite(norm(v))) throw std::overflow_error("histories: the motion leaves the range of doubles");
  return result;
}

}  // namespace stickslip
