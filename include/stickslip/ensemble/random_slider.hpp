// A slider whose parameters are random.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "stickslip/friction/law.hpp"
#include "stickslip/slider/identity.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/statistics/distribution.hpp"

namespace stickslip {

namespace detail {
/// Parameters of a member: parameter j is the quantile of distribution j at the uniform number j of a stream of random
/// numbers for this purpose.
void draw(std::span<const Distribution> distributions, std::uint64_t seed, std::uint64_t member,
          std::span<double> values);
std::string describe_random(std::span<const Distribution> distributions, const std::vector<std::string>& sliders);
}  // namespace detail

/// A slider with random parameters for each member of an ensemble. The parameters are independent of each other and of
/// the ground motions. (seed, member) determines them; a change of one distribution does not change the other
/// parameters:
///
///     RandomSlider blocks([](double mu) { return Coulomb::from_friction(mu); }, Lognormal(0.3, 0.3));
///
/// @tparam Make           creates a law or a slider from one number per distribution; called concurrently
/// @tparam Distributions  of these numbers; a plain number is a constant
template <class Make, std::convertible_to<Distribution>... Distributions>
class RandomSlider {
 public:
  static constexpr std::size_t parameters = sizeof...(Distributions);

  /// @throws  the exceptions of `make` at the quartiles of all parameters
  explicit RandomSlider(Make make, Distributions... distributions)
      : make_(std::move(make)), distributions_{Distribution(distributions)...} {
    // A function has no name; the sliders that it creates represent it.
    std::vector<std::string> sliders;
    for (const double probability : {0.25, 0.5, 0.75}) {
      std::array<double, parameters> values;
      for (std::size_t i = 0; i < parameters; ++i) values[i] = quantile(distributions_[i], probability);
      sliders.push_back(identity(make_from(values)));
    }
    configuration_ = detail::describe_random(distributions_, sliders);
  }

  /// The parameters of a member.
  std::array<double, parameters> values(std::uint64_t seed, std::uint64_t member) const {
    std::array<double, parameters> values;
    detail::draw(distributions_, seed, member, values);
    return values;
  }

  /// The slider of a member.
  /// @throws std::invalid_argument  parameters that the law rejects; names the member and the value
  auto sample(std::uint64_t seed, std::uint64_t member) const {
    try {
      return make_from(values(seed, member));
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument("RandomSlider: member " + std::to_string(member) + ": " + error.what());
    }
  }

  /// Everything that the members depend on, as JSON.
  const std::string& configuration() const noexcept { return configuration_; }

 private:
  auto make_from(const std::array<double, parameters>& values) const {
    auto made = std::apply(make_, values);
    if constexpr (FrictionLaw<decltype(made)>)
      return Slider(std::move(made));
    else
      return made;
  }

  Make make_;
  std::array<Distribution, parameters> distributions_;
  std::string configuration_;
};

}  // namespace stickslip
