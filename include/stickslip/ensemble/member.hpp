// Sources of the members of an ensemble.
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include "stickslip/ensemble/configuration.hpp"
#include "stickslip/ensemble/times.hpp"
#include "stickslip/excitation/excitation.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/planar/identity.hpp"
#include "stickslip/planar/slider.hpp"
#include "stickslip/slider/identity.hpp"

namespace stickslip {

/// A member of an ensemble: a slider and its ground motion.
/// @tparam S, M  a slider and a GroundMotion, or references to those in the source
template <class S, class M>
struct Member {
  S slider;
  M motion;
};

/// A source of members: the same (seed, index) always gives the same member.
///
/// `time_base()` contains the common times of all ground motions, or nothing if their durations differ; there are then
/// no statistics by time. `configuration()` contains everything that the members depend on, so that only parts of the
/// same ensemble are merged. Several threads call the source concurrently.
template <class T>
concept MemberSource = requires(const T& source, std::uint64_t number) {
  source.member(number, number).slider;
  { source.member(number, number).motion } -> std::convertible_to<const GroundMotion&>;
  { source.time_base() } -> std::convertible_to<std::optional<TimeBase>>;
  { source.configuration() } -> std::convertible_to<EnsembleConfiguration>;
};

/// A source of ground motions: an Excitation, or motions of different durations, as OneOf<GroundMotion>.
template <class T>
concept MotionSource = Excitation<T> || requires(const T& motions, std::uint64_t number) {
  { motions.sample(number, number) } -> std::convertible_to<const GroundMotion&>;
  { motions.time_base() } -> std::convertible_to<std::optional<TimeBase>>;
  { motions.configuration() } -> std::convertible_to<std::string>;
};

/// A source of sliders: RandomSlider, OneOf<Slider<Coulomb>>, or a user-defined one. `configuration()` is as above.
template <class T>
concept SliderSource = !MotionSource<T> && requires(const T& sliders, std::uint64_t number) {
  sliders.sample(number, number);
  { sliders.configuration() } -> std::convertible_to<std::string>;
};

/// Whether sliders of a type feel the transverse component of a ground motion. Those on one axis do not, and an
/// ensemble of them does not generate it.
template <class S>
inline constexpr bool feels_transverse = false;
template <IsotropicLaw Law>
inline constexpr bool feels_transverse<PlanarSlider<Law>> = true;
template <IsotropicLaw... Laws>
inline constexpr bool feels_transverse<std::variant<PlanarSlider<Laws>...>> = true;

namespace detail {

/// The same of the sliders of a source.
template <class S>
constexpr bool members_feel_transverse() {
  if constexpr (SliderSource<S>)
    return feels_transverse<std::remove_cvref_t<decltype(std::declval<const S&>().sample(0, 0))>>;
  else
    return feels_transverse<S>;
}

/// The common times of the motions of a source; nothing if their durations differ.
template <class M>
std::optional<TimeBase> time_base_of(const M& motions) {
  if constexpr (requires { motions.time_base(); }) {
    return motions.time_base();
  } else {
    TimeBase base{motions.duration()};
    if constexpr (requires { motions.dt(); }) base.dt = motions.dt();
    return base;
  }
}

/// The motion of a member, without a component that its slider does not feel.
template <bool with_transverse, class M>
decltype(auto) motion_of(const M& motions, std::uint64_t seed, std::uint64_t index) {
  if constexpr (!with_transverse && requires { motions.sample_along_axis(seed, index); })
    return motions.sample_along_axis(seed, index);
  else
    return motions.sample(seed, index);
}

}  // namespace detail

/// Members by index: a slider, or the sliders of a source, under the motions of a source.
/// @tparam S  a Slider for all members, or a SliderSource
template <class S, MotionSource M>
class PairedMembers {
 public:
  /// Holds references to both, which must outlive it.
  PairedMembers(const S& sliders, const M& motions) : sliders_(sliders), motions_(motions) {}

  const S& sliders() const noexcept { return sliders_; }
  const M& motions() const noexcept { return motions_; }

  auto member(std::uint64_t seed, std::uint64_t index) const {
    constexpr bool pairs = detail::members_feel_transverse<S>();
    using Motion = decltype(detail::motion_of<pairs>(motions_, seed, index));
    if constexpr (SliderSource<S>)
      return Member<decltype(sliders_.sample(seed, index)), Motion>{sliders_.sample(seed, index),
                                                                    detail::motion_of<pairs>(motions_, seed, index)};
    else
      return Member<const S&, Motion>{sliders_, detail::motion_of<pairs>(motions_, seed, index)};
  }

  std::optional<TimeBase> time_base() const { return detail::time_base_of(motions_); }

  EnsembleConfiguration configuration() const {
    const auto slider = [this] {
      if constexpr (SliderSource<S>)
        return sliders_.configuration();
      else
        return identity(sliders_);
    };
    return {{"slider", slider()}, {"excitation", motions_.configuration()}};
  }

 private:
  const S& sliders_;
  const M& motions_;
};

}  // namespace stickslip
