// The transport operator: the motion of a slider under a load that is held over each step, on a grid of states.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "theory/transport/held_motion.hpp"
#include "theory/transport/load_grid.hpp"
#include "theory/transport/panels.hpp"

namespace stickslip::detail {

/// One step T = S Z of a slider under noise, on functions of its state: S, its exact motion under the load held at its
/// value in the middle of the step, and Z, the exact step of the noise. Functions have values at nodes (x, v, load);
/// probability is carried by the adjoint, as the weights of those nodes in means: docs/transport.md. Rest is a node of
/// its own: where friction at rest exceeds that of sliding, a slow slip does not lead to what rest leads to.
///
/// If neither a spring nor friction depends on x, it is the sum of what is slid in each step, and not part of the
/// state. If the levels are equal, states with v < 0 are represented by their mirror images; functions are then even or
/// odd.
class Chain {
 public:
  using Vector = Eigen::VectorXd;

  /// How a function of the state and its mirror image are related.
  enum class Parity : std::int8_t { even = 1, odd = -1 };

  /// Means of products of displacement and velocity; if x is not part of the state, of the displacement during a step.
  struct Means {
    double x = 0, xx = 0, xv = 0, v = 0, vv = 0;
    double rest = 0;  ///< the probability of v = 0
  };

  /// @param x       panels in the displacement [m], or `Panels()`
  /// @param v       panels in the velocity [m/s], with a jump at 0; from 0 on if the motion mirrors
  /// @param step    [s]
  /// @param wall    probability with a larger |x| on the way is lost [m]
  Chain(HeldMotion motion, Panels x, Panels v, LoadGrid load, double step,
        double wall = std::numeric_limits<double>::infinity());

  bool mirrored() const noexcept { return motion_.mirrors(); }
  bool with_displacement() const noexcept { return x_.degree() > 0; }

  const LoadGrid& load() const noexcept { return load_; }
  bool pulses() const noexcept { return load_.pulses(); }
  double step() const noexcept { return step_; }
  std::size_t size() const noexcept { return places() * load_.size(); }

  /// The largest x of the grid [m].
  double farthest() const noexcept { return x_.edges().back(); }

  /// The weights of the start: at rest at x = 0, under stationary noise.
  const Vector& start() const noexcept { return start_; }

  /// The weights a step later, T'p.
  Vector carry(const Vector& p, Parity parity = Parity::even) const;

  /// T'(q + (X - drift) p), where X is the displacement during the step. With q the weights p times x, those of a step
  /// later.
  Vector carry(const Vector& q, const Vector& p, double drift, Parity parity) const;

  /// At the end of a step that begins with the weights p.
  Means end(const Vector& p) const { return sum(ends_, p); }

  /// Of what is seen of such a step: its end under noise; under pulses, whose lattice has a random phase, the mean over
  /// its duration.
  Means seen(const Vector& p) const { return sum(load_.pulses() ? seen_means_ : ends_, p); }

  /// P(x <= a point) of what is seen of such a step, for each of some points, with x part of the state.
  std::vector<double> below(const Vector& p, std::span<const double> points) const;

  /// Probabilities of the velocity of what is seen of such a step under pulses.
  struct Speeds {
    double rest = 0, forward = 0, backward = 0;       ///< of v = 0, v > 0 and v < 0
    std::vector<double> forward_to{}, backward_to{};  ///< of 0 < v <= each of some speeds, and of -speed <= v < 0
  };
  Speeds speeds(const Vector& p, std::span<const double> sizes) const;

  /// P(velocity <= v) some steps later, and with `or_equal` false P(velocity < v); of the states that the weights
  /// represent, not of their mirror images. The last load is integrated over exactly: that of filtered noise a step
  /// after the load that is part of the state, that of white noise at once.
  std::size_t steps_to_below() const noexcept { return load_.white() ? 1 : 2; }
  double below(const Vector& p, double v, bool or_equal) const;

 private:
  /// Where the motion of a row, a place (x, v) under a load, leads.
  struct Landing {
    double weight;     // of the load
    double to, speed;  // displacement and velocity at the end
  };
  struct Term {
    const Vector& nodes;                 // weights of nodes
    const std::vector<double>& entries;  // weights of entries
  };
  /// The places to which a row leads, of which the mirrored ones come last, and their weights.
  struct Row {
    std::vector<std::array<double, 2>> weights;  // by place; 0 where it does not lead
    std::vector<std::size_t> places;
  };

  std::size_t speeds() const noexcept { return v_.size() + 1; }  // the last one is rest
  std::size_t places() const noexcept { return x_.size() * speeds(); }
  std::size_t rows() const noexcept { return ends_.size(); }
  static constexpr std::size_t views = 5;

  std::pair<double, double> at(std::size_t place) const;
  template <class Use>
  void each_place(const Landing& landing, const Use& use) const;
  Vector carry(std::initializer_list<Term> terms, Parity parity) const;
  void land(double x, double v, double load, double weight, Row& row);
  void see(double x, double v, double load);
  double weight(std::size_t row, const Vector& p) const;
  Means sum(const std::vector<Means>& of_rows, const Vector& p) const;
  void keep(Row& row);
  std::vector<double> corners(double x, double v, std::size_t load) const;
  double load_for(double x, double v, double speed, bool or_equal) const;

  HeldMotion motion_;
  Panels x_, v_;
  LoadGrid load_;
  double step_, wall_;
  // Of each row: its landings and their means, and its entries, the weights of the places to which it leads; those of
  // mirrored places come last.
  std::vector<Landing> landings_;
  std::vector<Means> ends_;
  std::vector<Landing> seen_;  // of each row under pulses, `views` of them
  std::vector<Means> seen_means_;
  std::vector<std::size_t> first_landing_{0}, first_entry_{0}, first_mirrored_;
  std::vector<std::uint32_t> place_;
  std::vector<double> weight_, moving_;  // moving_: times the displacement, if it is not a state
  Vector start_;
};

}  // namespace stickslip::detail
