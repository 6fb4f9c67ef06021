// One slider along all horizontal directions of a station.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/function.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/friction/static_kinetic.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/sliding/any_slider.hpp"
#include "stickslip/sliding/integrate.hpp"
#include "stickslip/sweep/sweep.hpp"

namespace stickslip {

struct OrientationsOptions {
  bool settle = false;  ///< continue under zero ground acceleration after the last sample until the slider rests
  Contact contact = Contact::flight;                                         ///< the model used where N < 0
  unsigned threads = 0;                                                      ///< maximum number; 0: all cores
  std::function<void(std::size_t done, std::size_t directions)> progress{};  ///< called ten times a second; may throw
                                                                             ///< to stop the work
};

/// A direction that failed, and the reason.
struct OrientationFailure {
  std::size_t place;  ///< in the list of directions
  std::string message;
};

/// The responses of a slider along each of several directions. NaN for a direction that failed.
struct Orientations {
  std::vector<double> peak;                  ///< largest |x| over all time [m]
  std::vector<double> residual;              ///< x at the end [m], positive in the direction; final if the slider rests
  std::vector<OrientationFailure> failures;  ///< in order of directions
};

namespace detail {

Orientations orientations(const SweepSlider& slider, bool mirrored, const GroundMotion& station,
                          std::span<const double> degrees, const OrientationsOptions& options);

}  // namespace detail

/// Integrate a slider on one axis along each of several horizontal directions of a station, from rest at x = 0: at each
/// angle as `integrate` does under `rotated(station, angle)`, with the same bits.
///
/// @param slider   on one axis. On a slope the direction is downhill
/// @param station  ground motion with a transverse component; a vertical component acts as in `integrate`
/// @param degrees  angles from the station's axis to the slider's, clockwise seen from above (toward the transverse
///                 component) [degrees], finite, at least one. Angles that differ by half a turn are integrated once if
///                 the slider `mirrors`: the peak is equal and the residual has the other sign
/// @throws std::invalid_argument  no directions; an angle that is not finite; a station without a transverse component.
///                                A direction that fails is NaN, and `failures` has the reason
///
/// Cost: that of `integrate` for each direction, on all threads. Memory: three copies of the station for each thread.
/// The bits are the same for any number of threads.
template <class S>
Orientations orientations(const S& slider, const GroundMotion& station, std::span<const double> degrees,
                          const OrientationsOptions& options = {}) {
  if constexpr (FrictionLaw<S>)
    return orientations(Slider<S>(slider), station, degrees, options);
  else
    return detail::orientations(detail::sweep_slider(slider), mirrors(slider), station, degrees, options);
}

}  // namespace stickslip
