// The transport operator of a slender block that rocks: probabilities of the future, on a grid of states.
#pragma once

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "theory/transport/load_grid.hpp"
#include "theory/transport/panels.hpp"

namespace stickslip::detail {

/// A slender block without units: y = |theta| / alpha and v = dy / d(p t) on one side, alpha the larger of both, and
/// loads -n / (alpha g).
struct RockingScales {
  std::array<double, 2> alpha;  ///< of the right and the left side over the larger one
  double restitution;
  double lost;   ///< from v + y - alpha of its side on it is certain to overturn
  double level;  ///< y at which it counts as lost before, or infinity

  bool symmetric() const noexcept { return !(alpha[0] < alpha[1]) && !(alpha[1] < alpha[0]); }
};

/// Where a block is: on a side, 0 right and 1 left.
struct RockingPlace {
  std::size_t side;
  double y, v;
};

/// The exact motion over a time under a held load, from a place on. Nothing if it is lost on the way, or then.
/// @param load  -n / (alpha g), positive to the right
/// @param time  p t
std::optional<RockingPlace> rocked(const RockingScales& scales, RockingPlace from, double load, double time);

/// Functions of the place of a block and the state of the noise, which are 1 where the block is lost. A step carries a
/// function f backward: (T f)(y, v, z) is the mean of f a step after (y, v, z): first the motion under the load held at
/// its value in the middle of the step, then the step of the noise.
///
/// By symmetry a block with equal sides is a ball that bounces on a half line; each bounce changes the sign of the noise.
class RockingChain {
 public:
  using Values = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /// @param y, v  of either side
  /// @param unit  alpha g, of the loads of the grid [m/s^2]
  /// @param step    p times the step of the grid of loads
  /// @param kicked  the load acts as a push at the beginning of the step: white noise that is not held
  RockingChain(const RockingScales& scales, Panels y, Panels v, const LoadGrid& loads, double unit, double step,
               bool kicked, const std::function<void()>& progress);

  std::size_t size() const noexcept { return places() * loads_.size(); }

  /// The function that is 1 where the block is lost, else 0.
  Values lost() const;

  /// T f.
  Values carry(const Values& f) const;

  /// The mean of a function over the start: at rest, under stationary noise.
  double at_rest(const Values& f) const;

 private:
  std::size_t sides() const noexcept { return scales_.symmetric() ? 1 : 2; }
  std::size_t places() const noexcept { return sides() * y_.size() * v_.size(); }
  RockingPlace place(std::size_t i) const noexcept;
  bool is_lost(const RockingPlace& at) const noexcept;

  using Step = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  /// The motion under one load: the values it leads to, those after an odd number of bounces of a block with equal sides,
  /// and the share that is lost.
  struct Motion {
    Step same, mirrored;
    Eigen::VectorXd lost;
  };

  RockingScales scales_;
  Panels y_, v_;
  const LoadGrid& loads_;
  std::vector<Motion> motions_;  // of each load
};

}  // namespace stickslip::detail
