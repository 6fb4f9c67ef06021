#include "stickslip/sweep/planar_sweep.hpp"

#include <algorithm>
#include <cmath>

#include "sweep/combinations.hpp"

namespace stickslip::detail {
namespace {

/// Impacts on a circular stop. The slider touches it at r, so that the radial velocity is that along r.
SideImpacts radial_impacts(std::span<const PlanarEvent> events) {
  SideImpacts result;
  for (const PlanarEvent& event : events) {
    if (event.kind != EventKind::impact) continue;
    ++result.count;
    result.speed = std::max(result.speed, std::abs(dot(event.velocity, event.displacement)) / norm(event.displacement));
  }
  return result;
}

class PlanarSweep : Combinations<Vector2, SideImpacts> {
 public:
  PlanarSweep(std::span<const PlanarSweepSlider> sliders, std::span<const GroundMotion* const> motions,
              const SweepOptions& options)
      : Combinations(sliders.size(), std::ranges::any_of(sliders, &PlanarSweepSlider::has_stops), motions, options),
        sliders_(sliders) {}

  PlanarSweepTable run() {
    return Combinations::run(sliders_.size() * motions(), [&](const auto& next) {
      PlanarResponse storage;
      for (std::size_t task; next(task);) {
        const std::size_t record = task / sliders_.size(), slider = task % sliders_.size();
        const PlanarSweepSlider& one = sliders_[slider];
        for (const bool reversed : {false, true})
          if (one.mirrors ? !reversed : is_wanted(reversed))
            run_single(slider, one.integrate, record, reversed, one.mirrors, PlanarIntegrateOptions{}, storage,
                       radial_impacts);
      }
    });
  }

 private:
  std::span<const PlanarSweepSlider> sliders_;
};

}  // namespace

PlanarSweepTable sweep(std::span<const PlanarSweepSlider> sliders, std::span<const GroundMotion* const> motions,
                       const SweepOptions& options) {
  return PlanarSweep(sliders, motions, options).run();
}

}  // namespace stickslip::detail
