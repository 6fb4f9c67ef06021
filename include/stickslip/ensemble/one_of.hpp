// A list of sliders or ground motions for the members of an ensemble.
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "stickslip/ensemble/times.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/slider/identity.hpp"

namespace stickslip {

/// The choice of an item for a member.
enum class Order {
  in_turn,  ///< member i has item i modulo the length of the list
  drawn     ///< drawn at random with equal probabilities, determined by (seed, i)
};

namespace detail {
/// The time base of motions of equal duration (to 1e-9 of it), with their common time step, if any.
std::optional<TimeBase> common_time_base(std::span<const GroundMotion> motions);
/// A position in a list, drawn from a stream of random numbers for this purpose.
std::size_t drawn_place(std::uint64_t seed, std::uint64_t member, bool of_motions, std::size_t length);
/// Everything that the members depend on, as JSON.
/// @param order  "in turn" or "drawn"
std::string describe_list(const std::vector<std::string>& sliders, const char* order);
std::string describe_list(std::span<const GroundMotion> motions, const char* order);
}  // namespace detail

/// A list of sliders or of ground motions, one of which each member of an ensemble uses. Motions may differ in duration
/// and time step. They are stored once, and members refer to them.
///
/// If a list of sliders and a list of motions of the same length are both used in turn, member i has item i of both.
/// @tparam T  a Slider, an AnySlider, or GroundMotion
template <class T>
class OneOf {
 public:
  /// @throws std::invalid_argument  no items
  explicit OneOf(std::vector<T> items, Order order = Order::in_turn) : items_(std::move(items)), order_(order) {
    if (items_.empty()) throw std::invalid_argument("OneOf: needs at least one item, got an empty list");
    const char* const name = order == Order::drawn ? "drawn" : "in turn";
    if constexpr (of_motions) {
      time_base_ = detail::common_time_base(items_);
      configuration_ = detail::describe_list(items_, name);
    } else {
      std::vector<std::string> each;
      for (const T& item : items_) each.push_back(identity(item));
      configuration_ = detail::describe_list(each, name);
    }
  }

  std::span<const T> items() const noexcept { return items_; }
  Order order() const noexcept { return order_; }

  /// The item of a member.
  const T& sample(std::uint64_t seed, std::uint64_t member) const {
    return items_[order_ == Order::drawn ? detail::drawn_place(seed, member, of_motions, items_.size())
                                         : static_cast<std::size_t>(member % items_.size())];
  }

  /// The common times of all motions; nothing if their durations differ.
  std::optional<TimeBase> time_base() const noexcept requires std::same_as<T, GroundMotion> { return time_base_; }

  /// Everything that the members depend on, as JSON.
  const std::string& configuration() const noexcept { return configuration_; }

 private:
  static constexpr bool of_motions = std::same_as<T, GroundMotion>;
  std::vector<T> items_;
  Order order_;
  std::optional<TimeBase> time_base_;
  std::string configuration_;
};

}  // namespace stickslip
