// Many sliders under many ground motions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/function.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/friction/static_kinetic.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/sliding/any_slider.hpp"
#include "stickslip/sliding/detail/linear_mover.hpp"
#include "stickslip/sliding/impacts.hpp"
#include "stickslip/sliding/integrate.hpp"

namespace stickslip {

/// The sign of the ground motion: n(t), -n(t), or both.
enum class Polarity { recorded, reversed, both };

struct SweepProgress {
  std::size_t done, combinations;  ///< of slider, record and polarity
};

struct SweepOptions {
  Polarity polarity = Polarity::both;
  bool settle = false;  ///< continue under zero ground acceleration after the last sample until the slider rests
  Contact contact = Contact::flight;                     ///< the model used where N < 0
  unsigned threads = 0;                                  ///< maximum number; 0: all cores
  std::function<void(const SweepProgress&)> progress{};  ///< called ten times a second; may throw to stop the work
};

/// A combination that failed, and the reason.
struct SweepFailure {
  std::size_t slider, record;  ///< their positions in the lists
  Polarity polarity;           ///< recorded or reversed
  std::string message;
};

/// The results of a sweep: arrays over [slider, record, polarity], with the last index varying fastest. NaN for a
/// failed combination.
/// @tparam Place  a number x on one axis, a Vector2 r in the plane
/// @tparam Hits   impacts on stops
template <class Place, class Hits>
struct SweepTableOf {
  std::size_t sliders = 0, records = 0, polarities = 0;
  Polarity polarity = Polarity::both;
  std::vector<double> peak;              ///< largest distance from the origin over all time [m]
  std::vector<Place> residual;           ///< displacement at the end [m]; final if the slider rests
  std::vector<double> sliding_distance;  ///< path length, on one axis in both directions [m]
  std::vector<std::uint64_t> events;     ///< breakaways, reversals, impacts and arrests; 0 for a failure
  std::vector<Hits> impacts;             ///< on stops; empty if no slider has any
  std::vector<std::uint8_t> airborne;    ///< whether the slider is in flight at the end
  std::vector<SweepFailure> failures;    ///< in order of slider, record and polarity

  /// The position of a combination in the arrays.
  /// @param p  0 or, with both polarities, 1 for the reversed one
  std::size_t at(std::size_t slider, std::size_t record, std::size_t p = 0) const noexcept {
    return (slider * records + record) * polarities + p;
  }
};
using SweepTable = SweepTableOf<double, Impacts>;

namespace detail {

/// Whether a law resists equally in both directions, as far as is known.
template <FrictionLaw Law>
bool resists_alike(const Law& law) {
  if constexpr (requires { law.isotropic(); })
    return law.isotropic();
  else
    return SymmetricLaw<Law>;
}
template <class Law>
bool resists_alike(const StaticKinetic<Law>& law) {
  return resists_alike(law.sliding()) && equal(law.static_forward(), law.static_backward());
}

}  // namespace detail

/// Whether the response to -n(t) is known to be minus the response to n(t): the law is equal in both directions, and so
/// are the stops; the ground is level and the slider slides both ways. False of a `FunctionLaw`, which may be anything.
template <FrictionLaw Law>
bool mirrors(const Slider<Law>& slider) {
  const Mounting& on = slider.mounting();
  return detail::equal(on.slope_degrees, 0) && !on.one_way && detail::equal(on.stops.forward(), on.stops.backward()) &&
         detail::resists_alike(slider.law());
}
inline bool mirrors(const AnySlider& slider) {
  return std::visit([](const auto& one) { return mirrors(one); }, slider);
}

namespace detail {

/// A block with constant friction only. A one-way block has an infinite level in the other direction.
struct LevelBlock {
  StaticKinetic<Coulomb> law;
  double slope_degrees;
};

template <FrictionLaw Law>
std::optional<LevelBlock> level_block(const Slider<Law>&) {
  return {};
}
inline std::optional<LevelBlock> level_block(const Slider<StaticKinetic<Coulomb>>& slider) {
  const Mounting& mounting = slider.mounting();
  if (slider.stiffness() > 0 || slider.damping() > 0 || mounting.stops) return {};
  const StaticKinetic<Coulomb>& law = slider.law();
  if (!mounting.one_way) return LevelBlock{law, mounting.slope_degrees};
  return LevelBlock{{Coulomb(law.sliding().forward(), never), law.static_forward(), never}, mounting.slope_degrees};
}
inline std::optional<LevelBlock> level_block(const Slider<Coulomb>& slider) {
  const Coulomb& law = slider.law();
  return level_block(Slider(StaticKinetic(law, law.forward(), law.backward()), slider.mounting()));
}

/// One slider of a sweep, with the method that suits its law.
struct SweepSlider {
  std::optional<LevelBlock> block;  ///< for the vector lanes
  bool has_stops;
  std::function<Response(const GroundMotion&, const IntegrateOptions&, Response)> integrate;
  bool mirrors = false;  ///< see `mirrors`
  /// Its mover for segments of one duration, for the vector lanes; null if it has none.
  std::function<std::unique_ptr<LinearMover>(double)> mover{};
};

/// @param integrate  `integrate(motion, options, storage)`
template <FrictionLaw Law, class Integrate>
SweepSlider sweep_slider(const Slider<Law>& slider, Integrate&& integrate) {
  SweepSlider result{level_block(slider), static_cast<bool>(slider.mounting().stops),
                     std::forward<Integrate>(integrate), stickslip::mirrors(slider)};
  if constexpr (moves_linearly<Law>)
    if (equal(slider.mounting().slope_degrees, 0))
      result.mover = [&slider](double duration) { return linear_mover(slider, duration); };
  return result;
}
template <FrictionLaw Law>
SweepSlider sweep_slider(const Slider<Law>& slider) {
  return sweep_slider(slider, [&slider](const GroundMotion& motion, const IntegrateOptions& options, Response storage) {
    return stickslip::integrate(slider, motion, options, std::move(storage));
  });
}
inline SweepSlider sweep_slider(const AnySlider& slider) {
  const auto integrate = [&slider](const GroundMotion& motion, const IntegrateOptions& options, Response storage) {
    return stickslip::integrate(slider, motion, options, std::move(storage));
  };
  return std::visit([&](const auto& one) { return sweep_slider(one, integrate); }, slider);
}
template <class... Sliders>
SweepSlider sweep_slider(const std::variant<Sliders...>& slider) {
  return std::visit([](const auto& one) { return sweep_slider(one); }, slider);
}

SweepTable sweep(std::span<const SweepSlider> sliders, std::span<const GroundMotion* const> motions,
                 const SweepOptions& options);

}  // namespace detail

/// Integrate many sliders under many ground motions, from rest at x = 0:
///     x'' + resist sgn(x') + c x' + wn^2 x = -n(t),                    thesis (4.51) to (4.53), (2.44), (2.50), (4.2)
/// each combination as by `integrate`.
///
/// @param sliders  Sliders of one law, or each an AnySlider
/// @param motions  records, of any lengths and steps
/// @param options  polarity, whether to continue until the sliders rest, threads
/// @return peak, residual, sliding distance, number of events and impacts on stops of each. A slider that is in flight
///         at the end of the motion counts with its state there. A combination that fails (a slider that does
///         not come to rest, a motion beyond the range of doubles) is NaN, and `failures` has the reason; the sweep
///         continues
///
/// Blocks with Coulomb friction, also with a higher static level, without spring, damper and stops, under a record with
/// a constant time step, are integrated in vectors of slip levels: exact to round-off, 1e-13 of the scale of x; 0.05 to
/// 0.3 ns per sample and slider, compared with 12 to 40 ns for `integrate`. Slopes and vertical motion add a half. On
/// level ground without vertical motion, all other sliders with constant friction, or with friction that is linear in
/// the distance slid, also on springs, with dampers and stops, and pendulums with several surfaces, are integrated in
/// vectors of sliders, in which only segments with events are integrated one by one: 1 to 7 ns; 1e-12 of the scale of x,
/// unless the motion itself amplifies round-off, as many bounces do. All other combinations are integrated one by one on
/// all threads. A slider that resists equally in both directions (`mirrors`) is integrated once for both polarities. The
/// bits are the same for any number of threads, and for any other sliders.
template <class S>
SweepTable sweep(const std::vector<S>& sliders, const std::vector<const GroundMotion*>& motions,
                 const SweepOptions& options = {}) {
  std::vector<detail::SweepSlider> these;
  for (const S& slider : sliders) these.push_back(detail::sweep_slider(slider));
  return detail::sweep(these, motions, options);
}
template <class S>
SweepTable sweep(const std::vector<S>& sliders, const std::vector<GroundMotion>& motions,
                 const SweepOptions& options = {}) {
  std::vector<const GroundMotion*> these;
  for (const GroundMotion& motion : motions) these.push_back(&motion);
  return sweep(sliders, these, options);
}
template <FrictionLaw Law>
SweepTable sweep(const std::vector<Law>& laws, const std::vector<GroundMotion>& motions,
                 const SweepOptions& options = {}) {
  std::vector<Slider<Law>> sliders;
  for (const Law& law : laws) sliders.emplace_back(law);
  return sweep(sliders, motions, options);
}

}  // namespace stickslip
