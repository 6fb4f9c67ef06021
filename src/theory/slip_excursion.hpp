// How far a slider goes during a slip, beyond the point where the slip ends.
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace stickslip::detail {

/// The farthest point on the way of a slip, given the length of the slip: its distribution, from examples.
class SlipExcursion {
 public:
  /// A possible slip.
  struct Example {
    double slip;     ///< where it ends [m]
    double largest;  ///< the largest |x| on the way, at least |slip| [m]
    double weight;   ///< its probability up to a common factor, not negative
  };

  /// Means over intervals of equal probability, ascending.
  static constexpr std::size_t parts = 8;
  using Parts = std::array<double, parts>;

  explicit SlipExcursion(std::vector<Example> examples);

  /// The distances of the farthest point of a slip of this length, at least |slip| [m].
  Parts operator()(double slip) const;

 private:
  using Curve = std::vector<std::pair<double, Parts>>;  ///< by |slip|, ascending: the distances beyond it

  static Curve curve(const std::vector<Example>& examples, double direction);

  Curve forward_, backward_;
};

}  // namespace stickslip::detail
