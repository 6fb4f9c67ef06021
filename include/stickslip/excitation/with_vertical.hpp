// Random ground motion with a vertical component.
#pragma once

#include <cmath>
#include <concepts>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "stickslip/base/error.hpp"
#include "stickslip/excitation/excitation.hpp"
#include "stickslip/ground/ground_motion.hpp"

namespace stickslip {

namespace detail {

/// The seed of the vertical component: a function of the seed alone, so that both components of a member may come from
/// one excitation and are independent.
std::uint64_t vertical_seed(std::uint64_t seed);

/// The horizontal motion, which may have a transverse component, with `ratio` times the vertical one as its vertical
/// component. If the times differ, the result has those of both, and each component is as before between them.
/// @throws std::invalid_argument  different interpolations or durations; a horizontal motion that has a vertical
///                                component, or a vertical motion of several
GroundMotion with_vertical(GroundMotion horizontal, const GroundMotion& vertical, double ratio);

/// An excitation of pairs that names the excitation of its component along the axis, as `WithTransverse` does.
template <class E>
concept ExcitationOfPairs = Excitation<E> && requires(const E& pairs, std::uint64_t number) {
  { pairs.along_axis() } -> Excitation;
  { pairs.sample_along_axis(number, number) } -> std::same_as<GroundMotion>;
};

}  // namespace detail

/// An excitation whose motions also have a vertical component, drawn independently of the horizontal one:
///
///     run_ensemble(Coulomb(2), WithVertical(shaking, 2.0 / 3), {.members = 10'000});
///
/// The slider then moves under n(t) and a_z(t); friction is proportional to the normal force N = g + a_z. The same
/// (seed, member) always gives the same two components, the horizontal one with the same bits as without a vertical
/// one. A result with the vertical component can therefore be compared member by member with one without.
///
/// Earthquakes have vertical components that depend on the horizontal ones, and more of high frequencies. The model
/// leaves the dependence out; the frequencies are those of `vertical`.
///
/// Immutable; motions may be made on any number of threads at once.
///
/// @tparam H, V  excitations
template <Excitation H, Excitation V = H>
class WithVertical {
 public:
  /// @param horizontal  makes the horizontal component
  /// @param vertical    makes the vertical component, positive upward, before it is multiplied by the ratio
  /// @param ratio       factor on the vertical component, finite and at least 0
  /// @throws std::invalid_argument  a ratio out of range; durations that differ by more than 1e-9 of the duration.
  ///                                `sample` throws if one motion is made of lines and the other of held values
  WithVertical(H horizontal, V vertical, double ratio = 1)
      : horizontal_(std::move(horizontal)), vertical_(std::move(vertical)), ratio_(ratio) {
    detail::require(std::isfinite(ratio) && ratio >= 0, "WithVertical: ratio must be finite and at least 0", ratio);
    detail::require(std::abs(vertical_.duration() - duration()) <= 1e-9 * duration(),
                    "WithVertical: the vertical component must last as long as the horizontal one, " +
                        detail::shortest(duration()) + " s",
                    vertical_.duration(), "s");
  }

  /// Both components from one excitation, independently of each other.
  /// The vertical component from the same excitation; with all three components of a `WithTransverse`, from that of the
  /// component along the axis.
  /// @param ratio  vertical over horizontal rms acceleration, V/H, finite and at least 0
  WithVertical(H horizontal, double ratio) requires(std::same_as<H, V> || detail::ExcitationOfPairs<H>)
      : WithVertical(horizontal, alike(horizontal), ratio) {}

  const H& horizontal() const noexcept { return horizontal_; }
  const V& vertical() const noexcept { return vertical_; }
  double ratio() const noexcept { return ratio_; }

  double duration() const { return horizontal_.duration(); }

  /// Time between samples of the horizontal component [s].
  double dt() const requires requires(const H& h) { h.dt(); }
  { return horizontal_.dt(); }

  /// One motion with both components; of a `WithTransverse`, with all three.
  GroundMotion sample(std::uint64_t seed, std::uint64_t member) const {
    return detail::with_vertical(horizontal_.sample(seed, member),
                                 vertical_.sample(detail::vertical_seed(seed), member), ratio_);
  }

  /// The same motion without its transverse component.
  GroundMotion sample_along_axis(std::uint64_t seed, std::uint64_t member) const requires detail::ExcitationOfPairs<H> {
    return detail::with_vertical(horizontal_.sample_along_axis(seed, member),
                                 vertical_.sample(detail::vertical_seed(seed), member), ratio_);
  }

  /// Everything that the motions depend on, as JSON.
  std::string configuration() const { return configuration_of(horizontal_.configuration()); }

  /// The same with another horizontal excitation, given by its configuration.
  std::string configuration_of(const std::string& horizontal) const {
    return R"({"excitation": "WithVertical", "horizontal": )" + horizontal + R"(, "vertical": )" +
           std::string(vertical_.configuration()) + R"(, "ratio": )" + detail::shortest(ratio_) + "}";
  }

  friend bool operator==(const WithVertical& a, const WithVertical& b) {
    return a.configuration() == b.configuration();
  }

 private:
  static V alike(const H& horizontal) {
    if constexpr (std::same_as<H, V>)
      return horizontal;
    else
      return V(horizontal.along_axis());
  }

  H horizontal_;
  V vertical_;
  double ratio_;
};

template <detail::ExcitationOfPairs H>
WithVertical(H, double) -> WithVertical<H, std::remove_cvref_t<decltype(std::declval<const H&>().along_axis())>>;

}  // namespace stickslip
