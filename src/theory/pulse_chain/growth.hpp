// The growth of the cumulants by time, from chains corrected for pairs.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "stickslip/numerics/gauss_legendre.hpp"
#include "theory/pulse_chain/chain.hpp"
#include "theory/pulse_chain/pairs.hpp"
#include "theory/pulse_chain/problem.hpp"

namespace stickslip::detail::pulse_chain {

/// A sum over slots as a function of time, by polynomials of degree four: its mean over the phase of the lattice, whose
/// pulses begin at t = phase, phase + h, ..., and the growth rate of this mean.
class Curve {
 public:
  Curve() = default;

  /// @param length  of a slot, h
  /// @param power   of time in the first slot, where all that moves began at rest under a held load
  template <class Part>
  Curve(double length, const std::vector<Slot>& slots, const Part& part, int power) : length_(length), power_(power) {
    double value = 0, integral = 0;
    for (std::size_t i = 0; i < slots.size(); ++i) {
      const Rise& rise = part(slots[i]);
      const double slope = length * rise.slope;
      const double bend = length * part(slots[std::min(i + 1, slots.size() - 1)]).slope - slope;
      const double whole = rise.whole - slope, half = rise.half - slope / 2;
      const double fourth = 16 * half - 8 * whole + 2 * bend;
      Piece& piece = pieces_.emplace_back();
      piece.c = {value, slope, 3 * whole - bend + fourth, bend - 2 * whole - 2 * fourth, fourth};
      if (i == 0) piece.c = {0, rise.whole, 0, 0, 0};
      piece.before = integral;
      value += rise.whole;
      integral += length * piece.integral(1, i == 0 ? power : 1);
    }
  }

  double growth(double t) const { return ((*this)(t) - (*this)(t - length_)) / length_; }
  double mean(double t) const { return (integral(t) - integral(t - length_)) / length_; }

 private:
  struct Piece {
    std::array<double, 5> c{};
    double before = 0;  ///< integral up to its start

    /// @param power  of what is linear
    double value(double u, int power) const {
      return c[0] + c[1] * std::pow(u, power) + u * u * (c[2] + u * (c[3] + u * c[4]));
    }
    double integral(double u, int power) const {
      return u * (c[0] + c[1] * std::pow(u, power) / (power + 1) + u * u * (c[2] / 3 + u * (c[3] / 4 + u * c[4] / 5)));
    }
    double rise() const { return c[1] + c[2] + c[3] + c[4]; }
  };
  struct Place {
    const Piece& piece;
    int power;
    double u,
        more;  ///< position within it, and number of repetitions: beyond the last slot all growth continues as there
  };

  double operator()(double t) const {
    const auto [piece, power, u, more] = at(t);
    return piece.value(u, power) + more * piece.rise();
  }

  /// From 0 to t.
  double integral(double t) const {
    const auto [piece, power, u, more] = at(t);
    return piece.before + length_ * (piece.integral(u, power) +
                                     more * (piece.integral(1, power) + (u + (more - 1) / 2) * piece.rise()));
  }

  Place at(double t) const {
    const double place = std::max(t, 0.0) / length_, whole = std::floor(place);
    const double more = std::max(whole - static_cast<double>(pieces_.size() - 1), 0.0);
    const auto i = static_cast<std::size_t>(whole - more);
    return {pieces_[i], i == 0 ? power_ : 1, place - whole, more};
  }

  double length_ = 1;
  int power_ = 1;
  std::vector<Piece> pieces_{};
};

/// The correction for pairs in the growth of each quantity: factors by time,
///     1 - p (c2(m) - c2) / (c1 + |c2(m)| p) P0
/// (c1 > 0), with the coefficients of pulses that began within it and the probability P0 of rest by then.
class Correction {
 public:
  Correction() { factors_.front().fill(1); }

  Correction(const std::vector<PairMoments>& pairs, double rate, const std::vector<Slot>& chain, int slots) {
    factors_.clear();
    const auto rest = [&](std::size_t end) { return end == 0 ? 1 : chain[std::min(end, chain.size()) - 1].rest; };
    for (std::size_t half = 0; half < pairs.size(); ++half) {
      const std::size_t end = half * static_cast<std::size_t>(slots);
      const bool last = half + 1 == pairs.size();
      const double chance = last ? chain.back().rest : (rest(end / 2) + rest((end + 1) / 2)) / 2;
      Moment& factors = factors_.emplace_back();
      for (std::size_t i = 0; i < factors.size(); ++i) {
        const detail::PairCoefficients& c = pairs[std::max(half, std::size_t{1})][i];
        // At the very start no second pulse has begun, except those that the lattice starts at the same time.
        const double pair = half == 0 ? 0 : c.pair;
        const double whole = c.single + std::copysign(c.lattice, c.single) * rate;  // never close to 0
        factors[i] = whole == 0 ? 1 : 1 - rate * (c.lattice - pair) / whole * chance;
      }
    }
  }

  /// The time at which the factors have become constant.
  double settled() const { return 0.5 * static_cast<double>(factors_.size() - 1); }
  double late(std::size_t i) const { return factors_.back()[i]; }

  double operator()(double t, std::size_t i) const {
    if (t >= settled()) return late(i);
    const auto k = static_cast<std::size_t>(2 * t);
    const double u = 2 * t - static_cast<double>(k);
    return factors_[k][i] + u * (factors_[k + 1][i] - factors_[k][i]);
  }

 private:
  std::vector<Moment> factors_{1};
};

/// The quantities of one chain as functions of time, corrected for pairs.
class ChainGrowth {
 public:
  ChainGrowth(std::vector<Slot> slots, double length, Correction correction)
      : slots_(std::move(slots)), length_(length), correction_(std::move(correction)) {
    for (std::size_t n = 0; n < orders; ++n)
      curves_[n] = Curve(
          length, slots_, [n](const Slot& slot) -> const Rise& { return slot.displacement[n]; },
          static_cast<int>(2 * (n + 1)));
    curves_[squared_velocity] = Curve(
        length, slots_, [](const Slot& slot) -> const Rise& { return slot.velocity; }, 3);
  }

  /// Growth per unit of time at t, infinite once stationary.
  double rate(std::size_t i, double t) const {
    return correction_(t, i) * (std::isinf(t) ? late(i) : chain_rate(i, t));
  }

  /// Its integral from 0 to t.
  double sum(std::size_t i, double t) const {
    const double early = std::min(t, correction_.settled());
    double sum = correction_.late(i) * (chain_sum(i, t) - chain_sum(i, early));
    for (double from = 0; from < early; from += 0.5)
      numerics::gauss_points<4>(from, std::min(from + 0.5, early),
                                [&](double at, double w) { sum += w * rate(i, at); });
    return sum;
  }

 private:
  double late(std::size_t i) const {
    const Slot& last = slots_.back();
    return (i == slipped            ? last.slips
            : i == squared_velocity ? last.velocity.whole
                                    : last.displacement[i].whole) /
           length_;
  }
  /// The first slip occurs at the start of a slot: at a constant rate, over all phases of the lattice.
  double chain_rate(std::size_t i, double t) const {
    if (i != slipped) return curves_[i].growth(t);
    return slots_[std::min(static_cast<std::size_t>(t / length_), slots_.size() - 1)].slips / length_;
  }
  double chain_sum(std::size_t i, double t) const {
    if (i != slipped) return curves_[i].mean(t);
    double sum = 0, left = t / length_;
    for (std::size_t k = 0; k < slots_.size() && left > 0; ++k) {
      sum += slots_[k].slips * (k + 1 < slots_.size() ? std::min(left, 1.0) : left);
      left -= 1;
    }
    return sum;
  }

  std::vector<Slot> slots_;
  double length_;
  Correction correction_;
  std::array<Curve, orders + 1> curves_{};
};

/// The weighted sum of several chains.
class Growth {
 public:
  void add(double weight, ChainGrowth growth) { parts_.emplace_back(weight, std::move(growth)); }

  double rate(std::size_t i, double t) const {
    double rate = 0;
    for (const auto& [weight, growth] : parts_) rate += weight * growth.rate(i, t);
    return rate;
  }
  double sum(std::size_t i, double t) const {
    double sum = 0;
    for (const auto& [weight, growth] : parts_) sum += weight * growth.sum(i, t);
    return sum;
  }

 private:
  std::vector<std::pair<double, ChainGrowth>> parts_{};
};

/// Two slots per step: above this range, the error of their coarser grid exceeds that of one slot; below it they take
/// minutes.
inline bool two_slots(double sigma, bool refined) { return refined && sigma >= min_refined_sigma && sigma <= 1; }

/// @tparam Order  number of cumulants of the displacement, 2 or 4
template <std::size_t Order>
Growth growth_of(const Problem& problem, bool refined, const std::function<void()>& progress);

}  // namespace stickslip::detail::pulse_chain
