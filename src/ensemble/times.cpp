#include "stickslip/ensemble/times.hpp"

#include <cmath>

#include "stickslip/base/error.hpp"
#include "stickslip/ensemble/ensemble.hpp"

namespace stickslip::detail {

EnsembleTimes ensemble_times(double dt, const std::optional<TimeBase>& base) {
  require(std::isfinite(dt) && dt >= 0, "run_ensemble: dt must be finite and at least 0", dt, "s");
  if (!base) {
    require(dt == 0,
            "run_ensemble: dt must not be given where ground motions differ in duration: no statistics by time", dt,
            "s");
    return {};
  }
  const auto [duration, sample_dt] = *base;
  if (dt == 0) dt = sample_dt > 0 ? sample_dt : duration / 512;
  require(dt <= duration, "run_ensemble: dt must be at most the duration, " + shortest(duration) + " s", dt, "s");
  if (sample_dt > 0) {
    const double samples = std::round(dt / sample_dt);
    require(samples >= 1 && std::abs(dt / sample_dt - samples) < 1e-9 * samples,
            "run_ensemble: dt must be a multiple of the excitation's " + shortest(sample_dt) + " s", dt, "s");
    dt = samples * sample_dt;
  }
  constexpr double most = Ensemble::max_times;
  const double steps = std::floor(duration / dt * (1 + 1e-12));
  require(steps < most,
          "run_ensemble: dt must leave at most " + shortest(most) + " times in " + shortest(duration) + " s", dt, "s");
  return {dt, static_cast<std::size_t>(steps) + 1};
}

}  // namespace stickslip::detail
