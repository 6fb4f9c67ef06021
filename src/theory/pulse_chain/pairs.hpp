// The effect of single pulses and of two that overlap.
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "stickslip/friction/coulomb.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/theory/pulse_chain.hpp"
#include "theory/pulse_chain/lattice.hpp"
#include "theory/slip_excursion.hpp"

namespace stickslip::detail::pulse_chain {

/// The number of moments of the displacement, without the integral of v^2 and the indicator of slip.
constexpr std::size_t orders = 4;

/// The effect of pulses: X to X^4, the integral of v^2, and 1 if the block has moved. Or the cumulants of X, E[v^2] and
/// the rate at which blocks begin to slip.
using Moment = std::array<double, orders + 2>;
constexpr std::size_t squared_velocity = orders, slipped = orders + 1;

/// The probability that a load moves a block at rest, for loads that are nodes of a lattice: one half at the level
/// itself, because the node represents all loads nearest to it.
double chance_to_move(const Coulomb& law, double load);

/// How long two pulses have an effect, in steps: a pulse that leaves no net velocity leaves at most what friction stops
/// within another pulse length, after which a second pulse finds the block at rest.
inline int reach_of(const Steps& steps) { return 4 * static_cast<int>(steps.values.size()); }

/// The effect of single pulses and of pairs, for each quantity.
using PairMoments = std::array<detail::PairCoefficients, orders + 2>;

/// The effect of pairs, on two lattices of amplitudes: the chain's, and one twice as fine, of which every second node
/// is the chain's.
class Pairs {
 public:
  /// @param mirrored  levels and amplitudes are symmetric
  Pairs(const Slider<Coulomb>& block, const Steps& steps, bool mirrored, Weights coarse, Weights fine)
      : block_(block),
        steps_(steps),
        mirrored_(mirrored),
        coarse_(std::move(coarse)),
        fine_(std::move(fine)),
        single_(alone(0, 1)) {}

  /// Moments of single pulses and of pairs; for pairs the integral over the delay, and its sum over the chain's lattice
  /// of times with `slots` points per step. That sum is taken on the chain's lattice of amplitudes, or with `limit`
  /// extrapolated as all else. Entry k counts pulses that began within k/2 steps; the last entry counts all.
  std::vector<PairMoments> table(int slots, bool limit);

  /// What one pulse alone does, and two that overlap.
  /// @param alone  amplitudes of one pulse, on a lattice of their own
  std::vector<detail::SlipExcursion::Example> examples(double rate, const Weights& alone);

 private:
  /// On either lattice.
  struct Sums {
    Moment coarse{}, fine{};
    /// Kinks cause errors of O(spacing^2) in both.
    double limit(std::size_t i) const { return (4 * fine[i] - coarse[i]) / 3; }
  };

  void add(std::vector<Sums>& sums, int i, int j, double fine, double coarse, double offset);

  /// The effect of a pulse that begins `offset` later.
  std::vector<Sums> alone(double offset, int step);

  /// Adds the effect of both beyond their separate effects, averaged over both amplitudes.
  void add_pairs(std::vector<Sums>& sums, double offset, double weight, bool fine);

  const Slider<Coulomb>& block_;
  const Steps& steps_;
  bool mirrored_;
  Weights coarse_, fine_;
  std::vector<Moment> both_{static_cast<std::size_t>(2 * reach_of(steps_) + 1)};
  std::vector<Sums> single_;
};

}  // namespace stickslip::detail::pulse_chain
