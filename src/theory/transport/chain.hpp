// The transport operator: the motion of a slider under a load that is held over each step, on a grid of states.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "stickslip/friction/coulomb.hpp"
#include "stickslip/slider.hpp"
#include "theory/transport/load_grid.hpp"
#include "theory/transport/panels.hpp"

namespace stickslip::detail {

/// One step T = S Z of a slider under noise, on functions of its state: S, its exact motion under the load held at its
/// value in the middle of the step, and Z, the exact step of the noise. Functions have values at nodes (x, v, load);
/// probability is carried by the adjoint, as the weights of those nodes in means: docs/transport.md.
///
/// Without a spring, displacements are sums of independent increments and x is not part of the state. If the levels
/// are equal, states with v < 0 are represented by their mirror images; functions are then even or odd.
class Chain {
 public:
  using Vector = Eigen::VectorXd;

  /// How a function of the state and its mirror image are related.
  enum class Parity : std::int8_t { even = 1, odd = -1 };

  /// Means over the end of a step of products of displacement and velocity; without a spring of the displacement
  /// during the step.
  struct Means {
    double x = 0, xx = 0, xv = 0, v = 0, vv = 0;
  };

  /// @param slider  level, plain
  /// @param x       panels in the displacement [m], or `Panels()`
  /// @param v       panels in the velocity [m/s], from 0 on if `mirrors(slider)`
  /// @param step    [s]
  /// @param wall    probability with a larger |x| on the way is lost [m]
  Chain(const Slider<Coulomb>& slider, Panels x, Panels v, LoadGrid load, double step,
        double wall = std::numeric_limits<double>::infinity());

  /// Whether its motion under the opposite load is the opposite motion.
  static bool mirrors(const Slider<Coulomb>& slider) noexcept;
  bool mirrored() const noexcept { return mirrors(slider_); }

  double step() const noexcept { return step_; }
  std::size_t size() const noexcept { return places() * load_.size(); }

  /// The weights of the start: at rest at x = 0, under stationary noise.
  const Vector& start() const noexcept { return start_; }

  /// The weights a step later, T'p.
  Vector carry(const Vector& p, Parity parity = Parity::even) const;

  /// T'(q + (X - drift) p), where X is the displacement during the step. With q the weights p times x, those of a step
  /// later.
  Vector carry(const Vector& q, const Vector& p, double drift, Parity parity) const;

  /// The weights times exp(i wave X) a step later, of weights with the parts even (real) and odd (imaginary): without a
  /// spring, the sum of weights is the characteristic function of the displacement.
  class Turn;
  struct Complex {
    Vector re, im;
  };
  Complex carry(const Complex& p, const Turn& turn) const;

  Means means(const Vector& p) const;

  /// E[exp(i wave x)] at the end of a step, if x is part of the state.
  std::complex<double> characteristic(const Vector& p, double wave) const;

  /// P(velocity <= v) two steps later, and with `or_equal` false P(velocity < v); of the states that the weights
  /// represent, not of their mirror images.
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
  using Row = std::map<std::pair<std::size_t, bool>, std::array<double, 2>>;

  std::size_t places() const noexcept { return x_.size() * v_.size(); }
  std::size_t rows() const noexcept { return means_.size(); }
  template <class Use>
  void each_place(const Landing& landing, const Use& use) const;
  Vector carry(std::initializer_list<Term> terms, Parity parity) const;
  void land(double x, double v, double load, double weight, Row& row);
  void keep(const Row& row);
  double speed_after(double x, double v, double load) const;
  double load_for(double x, double v, double speed, bool or_equal) const;

  Slider<Coulomb> slider_;
  Panels x_, v_;
  LoadGrid load_;
  double step_, wall_;
  // Of each row: its landings and their means, and its entries, the weights of the places to which it leads; those of
  // mirrored places come last.
  std::vector<Landing> landings_;
  std::vector<Means> means_;
  std::vector<std::size_t> first_landing_{0}, first_entry_{0}, first_mirrored_;
  std::vector<std::uint32_t> place_;
  std::vector<double> weight_, moving_;  // moving_: times the displacement, without a spring
  Vector start_;
};

/// The entries of a chain times cos(wave X) and sin(wave X).
class Chain::Turn {
 public:
  Turn(const Chain& chain, double wave);

 private:
  friend class Chain;
  std::vector<double> cosine_, sine_;
};

}  // namespace stickslip::detail
