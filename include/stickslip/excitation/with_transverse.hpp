// Random ground motion with two horizontal components.
#pragma once

#include <cmath>
#include <concepts>
#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/excitation/excitation.hpp"
#include "stickslip/excitation/with_vertical.hpp"
#include "stickslip/ground/ground_motion.hpp"

namespace stickslip {

/// When the pulses of two horizontal components arrive.
enum class Arrivals {
  common,      ///< together: pulse k has a random amplitude along each component, thus a random direction
  independent  ///< each component has its own pulses
};

inline const char* name_of(Arrivals arrivals) noexcept {
  return arrivals == Arrivals::common ? "common" : "independent";
}

namespace detail {

/// The seed of the transverse component: a function of the seed alone, so that both components of a member may come
/// from one excitation and are independent, of each other and of the vertical one.
std::uint64_t transverse_seed(std::uint64_t seed);

/// transverse component = ratio * (horizontal * n + transverse * t), of the motions n and t.
struct TransverseWeights {
  double ratio, horizontal, transverse;
};

/// The horizontal motion, which may have a vertical component, with a transverse one. If the times differ, the result
/// has those of both, and each component is as before between them.
/// @param transverse  makes the motion t; not called if its weight is 0
/// @throws std::invalid_argument  different interpolations or durations; a horizontal motion that has a transverse
///                                component, or a transverse motion of several
GroundMotion with_transverse(GroundMotion horizontal, const TransverseWeights& weights,
                             const std::function<GroundMotion()>& transverse);

/// The horizontal excitation of a `WithVertical`; otherwise the excitation itself.
template <class E>
const E& without_vertical(const E& excitation) {
  return excitation;
}
template <class H, class V>
const H& without_vertical(const WithVertical<H, V>& excitation) {
  return excitation.horizontal();
}
template <class E>
using WithoutVertical = std::remove_cvref_t<decltype(without_vertical(std::declval<const E&>()))>;

/// Whether an excitation consists of pulses whose arrivals another component may share.
template <class E>
bool made_of_pulses(const E& excitation) {
  if constexpr (requires { excitation.made_of_pulses(); })
    return excitation.made_of_pulses();
  else
    return requires(std::uint64_t number) { excitation.sample(number, number, number); };
}

}  // namespace detail

/// An excitation whose motions also have a transverse component, 90 degrees clockwise of the axis (seen from above):
///
///     transverse = ratio (coherence (s_t / s_n) n + sqrt(1 - coherence^2) t)
///
/// n is the component along the axis, a motion of `horizontal`; t is an independent motion of `transverse`; s_n and s_t
/// are their rms accelerations without envelopes, sqrt(variance()). The transverse component then has the rms
/// acceleration ratio s_t, and `coherence` is its correlation with n at equal times, at any time in a stationary motion
/// and wherever the envelopes of both excitations are equal. For two equal excitations s_t / s_n is exactly 1. If the
/// excitations differ, the spectral density of the transverse component is ratio^2 times the sum of both, weighted by
/// coherence^2 (s_t / s_n)^2 and 1 - coherence^2. With a coherence of 1 or -1 no t is drawn.
///
/// Pulses: if both excitations are the same PoissonPulses, pulses of both components arrive together, unless `arrivals`
/// says otherwise. Pulse k then has the amplitude vector (b_k, ratio (coherence b_k + sqrt(1 - coherence^2) b'_k)),
/// with independent b_k and b'_k. With Gaussian amplitudes, ratio 1 and coherence 0 all azimuths are equally likely and
/// independent of the magnitude (a Rayleigh variable), and the component along any azimuth is again a process of these
/// PoissonPulses.
///
/// The same (seed, member) always gives the same components; the one along the axis has the same bits as without a
/// transverse one. Nests with `WithVertical` in either order: both give the same motions to the bit and have the same
/// configuration. The vertical component is independent of both others.
///
/// An ensemble of sliders on one axis does not generate the transverse component, which they do not feel.
///
/// Immutable; motions may be made on any number of threads at once.
///
/// @tparam H, T  excitations; H may be a WithVertical
template <Excitation H, Excitation T = detail::WithoutVertical<H>>
class WithTransverse {
 public:
  /// @param horizontal  makes the component along the axis, and possibly a vertical one
  /// @param transverse  makes t
  /// @param ratio       factor on the transverse component, finite and at least 0
  /// @param coherence   correlation of the two horizontal components, from -1 to 1
  /// @param arrivals    of pulses; default: common if both excitations are the same PoissonPulses
  /// @throws std::invalid_argument  a value out of range; durations that differ by more than 1e-9 of the duration; a
  ///                                coherence of different excitations without `variance()`; common arrivals of
  ///                                excitations that are not the same PoissonPulses. `sample` throws if one motion is
  ///                                made of lines and the other of held values
  WithTransverse(H horizontal, T transverse, double ratio = 1, double coherence = 0,
                 std::optional<Arrivals> arrivals = {})
      : horizontal_(std::move(horizontal)), transverse_(std::move(transverse)), coherence_(coherence) {
    detail::require(std::isfinite(ratio) && ratio >= 0, "WithTransverse: ratio must be finite and at least 0", ratio);
    detail::require(coherence >= -1 && coherence <= 1, "WithTransverse: coherence must be from -1 to 1", coherence);
    detail::require(std::abs(transverse_.duration() - duration()) <= 1e-9 * duration(),
                    "WithTransverse: the transverse component must last as long as the horizontal one, " +
                        detail::shortest(duration()) + " s",
                    transverse_.duration(), "s");
    const auto& axis = detail::without_vertical(horizontal_);
    const bool alike = std::string(axis.configuration()) == std::string(transverse_.configuration());
    const bool pulses = alike && detail::made_of_pulses(axis) && detail::made_of_pulses(transverse_);
    arrivals_ = arrivals.value_or(pulses ? Arrivals::common : Arrivals::independent);
    if (arrivals_ == Arrivals::common && !pulses)
      throw std::invalid_argument(
          "WithTransverse: common arrivals need the same PoissonPulses for both components; pass arrivals = "
          "independent, or one excitation");
    weights_ = {ratio, coherence, std::sqrt((1 - coherence) * (1 + coherence))};
    if (!alike && !detail::equal(coherence, 0)) weights_.horizontal *= relative_rms(axis, transverse_);
  }

  /// Both components from one excitation.
  /// @param ratio  transverse over horizontal rms acceleration, finite and at least 0
  explicit WithTransverse(H horizontal, double ratio = 1, double coherence = 0,
                          std::optional<Arrivals> arrivals = {}) requires std::same_as<T, detail::WithoutVertical<H>>
      : WithTransverse(horizontal, detail::without_vertical(horizontal), ratio, coherence, arrivals) {}

  const H& horizontal() const noexcept { return horizontal_; }
  const T& transverse() const noexcept { return transverse_; }
  double ratio() const noexcept { return weights_.ratio; }
  double coherence() const noexcept { return coherence_; }
  Arrivals arrivals() const noexcept { return arrivals_; }

  double duration() const { return horizontal_.duration(); }

  /// Time between samples of the component along the axis [s].
  double dt() const requires requires(const H& h) { h.dt(); }
  { return horizontal_.dt(); }

  /// One motion with both horizontal components.
  GroundMotion sample(std::uint64_t seed, std::uint64_t member) const {
    const auto& axis = detail::without_vertical(horizontal_);
    const auto t = [&]() -> GroundMotion {
      const std::uint64_t other = detail::transverse_seed(seed);
      if constexpr (requires { transverse_.sample(seed, member, other); })
        if (arrivals_ == Arrivals::common) return transverse_.sample(seed, member, other);
      return transverse_.sample(other, member);
    };
    GroundMotion pair = detail::with_transverse(axis.sample(seed, member), weights_, t);
    if constexpr (std::same_as<H, detail::WithoutVertical<H>>)
      return pair;
    else
      return detail::with_vertical(std::move(pair), horizontal_.vertical().sample(detail::vertical_seed(seed), member),
                                   horizontal_.ratio());
  }

  /// The excitation of the same motions without a transverse component.
  const H& along_axis() const noexcept { return horizontal_; }
  GroundMotion sample_along_axis(std::uint64_t seed, std::uint64_t member) const {
    return horizontal_.sample(seed, member);
  }

  /// Everything that the motions depend on, as JSON.
  std::string configuration() const {
    const auto pair = [this](const std::string& axis) {
      return R"({"excitation": "WithTransverse", "horizontal": )" + axis + R"(, "transverse": )" +
             std::string(transverse_.configuration()) + R"(, "ratio": )" + detail::shortest(ratio()) +
             R"(, "coherence": )" + detail::shortest(coherence_) + R"(, "arrivals": ")" + name_of(arrivals_) + "\"}";
    };
    if constexpr (std::same_as<H, detail::WithoutVertical<H>>)
      return pair(horizontal_.configuration());
    else
      return horizontal_.configuration_of(pair(horizontal_.horizontal().configuration()));
  }

  friend bool operator==(const WithTransverse& a, const WithTransverse& b) {
    return a.configuration() == b.configuration();
  }

 private:
  template <class A>
  static double relative_rms(const A& axis, const T& transverse) {
    if constexpr (requires { std::sqrt(transverse.variance() / axis.variance()); }) {
      const double ratio = std::sqrt(transverse.variance() / axis.variance());
      if (std::isfinite(ratio)) return ratio;
    }
    throw std::invalid_argument(
        "WithTransverse: a coherence other than 0 of different excitations needs the variance of both");
  }

  H horizontal_;
  T transverse_;
  double coherence_;
  Arrivals arrivals_ = Arrivals::independent;
  detail::TransverseWeights weights_{};
};

}  // namespace stickslip
