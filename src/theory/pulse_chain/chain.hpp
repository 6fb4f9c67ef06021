// The Markov chain of the velocity and the last few batches of pulses.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "theory/pulse_chain/lattice.hpp"
#include "theory/pulse_chain/pairs.hpp"

namespace stickslip::detail::pulse_chain {

/// The increase of a function of time within a slot.
struct Rise {
  double slope = 0;  ///< at the start
  double half = 0;   ///< by the middle
  double whole = 0;  ///< by the end

  void add(double weight, const Rise& other) {
    slope += weight * other.slope;
    half += weight * other.half;
    whole += weight * other.whole;
  }
};

struct Slot {
  std::array<Rise, orders> displacement{};  ///< cumulants of x, as many as are asked for
  Rise velocity{};                          ///< the integral of E[v^2]
  double rest = 0;                          ///< probability of rest at the end
  double slips = 0;                         ///< increase of -log of the probability that nothing has slipped yet

  void add(double weight, const Slot& other) {
    for (std::size_t i = 0; i < orders; ++i) displacement[i].add(weight, other.displacement[i]);
    velocity.add(weight, other.velocity);
    rest += weight * other.rest;
    slips += weight * other.slips;
  }
};

/// The quantities common to all slots of a kind: the destination of a slot from each node of the grid, spread over four
/// nodes, and the displacement and the integral of v^2 up to the middle of the slot and up to its end.
struct Passage {
  std::uint32_t first;
  std::array<double, 4> share;
  std::array<double, 2> displacement, square;
};

/// Its operator is our own: a node goes to four neighbors, by a table that all histories of batches of the same ground
/// acceleration share, where a sparse matrix would store each transition.
class Chain {
 public:
  Chain(const Slider<Coulomb>& block, const Steps& steps, const Arrivals& arrivals, int slots, bool drifting);

  /// From rest, slot by slot; the last slot is stationary.
  /// @tparam Order  cumulants of the displacement
  template <std::size_t Order>
  std::vector<Slot> solve(const std::function<void()>& progress) const;

  /// Adds to the slots the probability that nothing has slipped yet.
  void add_slips(std::vector<Slot>& slots) const;

  /// On the chain's own lattice of amplitudes, so that the lattice's error is corrected, too.
  Pairs pairs() const;

  /// Slips of one pulse, which are finely resolved, and of two that overlap.
  std::vector<detail::SlipExcursion::Example> excursions() const;

 private:
  std::size_t size() const { return grid_.size(); }
  int span() const { return 2 * batch_.reach + 1; }

  /// Moves from velocity v under a held ground acceleration to the velocity at the end, with `still` of it to come
  /// later.
  Passage passage(double v, double n, double still) const;

  /// Kinds of slots: on the grid of velocities, by the ground acceleration alone; on the grid of the velocities after
  /// the end of all pulses, by all batches.
  void tabulate();

  /// The destination of a slot from each node of the grid of u, for one newest batch and the earlier ones.
  void compute(std::size_t newest, std::size_t tuple, std::vector<Passage>& passages) const;

  /// Combinations less probable than this are omitted: together at most a thousandth of the probability to slip, in
  /// practice far less.
  void prune();

  double chance_to_move(std::ptrdiff_t n) const {
    return pulse_chain::chance_to_move(block_.law(), static_cast<double>(n) * batch_.spacing * unit_);
  }

  const Slider<Coulomb>& block_;
  const Steps& steps_;
  const Arrivals& arrivals_;
  int slots_;
  bool mirrored_ = true;         ///< the mirror image of each motion is equally probable
  bool drifting_;                ///< the grid is of u, else of v
  double min_chance_ = 0;        ///< chance of a combination of batches
  std::vector<int> values_{};    ///< of the slots of a pulse
  std::vector<double> still_{};  ///< velocity to come from the rest of a pulse, from slot i on
  double unit_ = 1;
  double tolerance_ = 0;
  std::vector<double> grid_{};
  Weights batch_{};
  int offset_ = 0;
  std::vector<Passage> passages_{};
};

}  // namespace stickslip::detail::pulse_chain
