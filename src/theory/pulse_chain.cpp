#include "stickslip/theory/pulse_chain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "stickslip/error.hpp"
#include "stickslip/numerics/gauss_legendre.hpp"
#include "stickslip/theory/pulse_response.hpp"
#include "theory/slip_excursion.hpp"
#include "theory/slip_walk.hpp"

namespace stickslip::theory {
namespace {

using detail::require;
using detail::shortest;

// Internally, the unit of acceleration is the slip level, the smaller of two; the unit of time is the step of the
// pulse.

/// A pulse of equal steps.
struct Steps {
  std::vector<int> values{};  ///< of the steps, as multiples of the unit
  double unit = 1;            ///< of those multiples, as a part of the pulse's amplitude
};

/// Of a lattice of amplitudes on which the slip level is a node, `parts` to sigma or more.
double lattice_spacing(double sigma, double parts) {
  return sigma > 2 ? 1 : 1 / std::ceil(std::max(parts / sigma, 0.5 / (sigma * sigma)));
}

/// The spacing of a lattice with at least `parts` nodes to sigma, of which the level 1 is a node, and the other level
/// as nearly as possible.
double lattice_spacing(double sigma, double parts, double other) {
  const double coarsest = lattice_spacing(sigma, parts);
  if (other == 1 || std::isinf(other)) return coarsest;
  double best = coarsest, least = 1;
  const double first = 1 / coarsest;
  for (double k = first; k <= std::max(1.5 * first, 4.0); ++k) {
    const double miss = std::abs(other * k - std::round(other * k));
    if (miss < least - 0.02) best = 1 / k, least = miss;
  }
  return best;
}

/// The quantities common to all slots of a kind: the destination of a slot from each node of the grid, spread over four
/// nodes, and the displacement and the integral of v^2 up to the middle of the slot and up to its end.
struct Passage {
  std::uint32_t first;
  std::array<double, 4> share;
  std::array<double, 2> displacement, square;
};

/// Lagrange's weights of the nodes at x[0..3] for the value at `at`.
std::array<double, 4> lagrange(const double* x, double at) {
  std::array<double, 4> w;
  for (std::size_t i = 0; i < 4; ++i) {
    w[i] = 1;
    for (std::size_t j = 0; j < 4; ++j)
      if (j != i) w[i] *= (at - x[j]) / (x[i] - x[j]);
  }
  return w;
}

constexpr std::size_t points = 4;  // of Gauss and Legendre, on each panel

// ---- amplitudes on a lattice

/// Weights of the nodes -reach..reach, `spacing` apart.
struct Weights {
  double spacing;
  int reach;
  std::vector<double> w;

  double& operator[](int i) { return w[static_cast<std::size_t>(i + reach)]; }
  double operator[](int i) const { return w[static_cast<std::size_t>(i + reach)]; }
};

/// Sums of `count` Gaussian amplitudes, normalized on the lattice.
Weights gaussian(double sigma, double spacing, int reach, int count) {
  Weights law{spacing, reach, std::vector<double>(static_cast<std::size_t>(2 * reach + 1))};
  double sum = 0;
  for (int i = -reach; i <= reach; ++i) sum += law[i] = std::exp(-0.5 * std::pow(i * spacing / sigma, 2) / count);
  for (double& w : law.w) w /= sum;
  return law;
}

using Quantile = std::function<void(std::span<double>)>;

/// The amplitudes in the middle of intervals of equal probability.
std::vector<double> amplitudes(const Quantile& quantile) {
  constexpr std::size_t count = 1 << 14;
  std::vector<double> u(count);
  for (std::size_t i = 0; i < count; ++i) u[i] = (static_cast<double>(i) + 0.5) / count;
  quantile(u);
  return u;
}

/// Whether the distribution of the amplitudes is symmetric.
bool symmetric(const std::vector<double>& amplitudes) {
  for (std::size_t i = 0, j = amplitudes.size() - 1; i < j; ++i, --j)
    if (!(std::abs(amplitudes[i] + amplitudes[j]) <= 1e-9 * (1 + std::abs(amplitudes[i])))) return false;
  return true;
}

/// Any law by its quantiles, each spread over the four nodes next to it.
Weights by_quantiles(const Quantile& quantile, double sigma, double spacing, int reach) {
  Weights law{spacing, reach, std::vector<double>(static_cast<std::size_t>(2 * reach + 1))};
  const std::vector<double> all = amplitudes(quantile);
  for (const double q : all) {
    const double place = std::clamp(sigma * q / spacing, -reach + 1.0, reach - 1.0);
    const int cell = std::clamp(static_cast<int>(std::floor(place)), 1 - reach, reach - 2);
    const double nodes[] = {cell - 1.0, cell + 0.0, cell + 1.0, cell + 2.0};
    const auto share = lagrange(nodes, place);
    for (int i = 0; i < 4; ++i)
      law[cell - 1 + i] += share[static_cast<std::size_t>(i)] / static_cast<double>(all.size());
  }
  return law;
}

/// The law of the sum of two; the probability that falls outside is dropped.
Weights convolved(const Weights& a, const Weights& b) {
  Weights sum{a.spacing, a.reach, std::vector<double>(a.w.size())};
  for (int i = -a.reach; i <= a.reach; ++i)
    for (int j = std::max(-a.reach, -a.reach - i); j <= std::min(a.reach, a.reach - i); ++j) sum[i + j] += a[i] * b[j];
  return sum;
}

/// The excitation as the chain sees it.
struct Arrivals {
  double rate;   ///< pulses to a step
  double sigma;  ///< rms amplitude
  Quantile quantile{};
  bool mirrored = true;  ///< amplitudes are as likely as their mirror images
  double fourth = 3;     ///< mean of the fourth power of the amplitudes, over sigma^4

  Weights single(double spacing, int reach) const {
    return quantile ? by_quantiles(quantile, sigma, spacing, reach) : gaussian(sigma, spacing, reach, 1);
  }

  /// Sums of as many as arrive at a node of the lattice.
  Weights batch(double slot, double spacing, int reach) const {
    const double mean = rate * slot;
    Weights sum{spacing, reach, std::vector<double>(static_cast<std::size_t>(2 * reach + 1))};
    double probability = std::exp(-mean);
    sum[0] = probability;
    const Weights one = single(spacing, reach);
    Weights law = one;
    for (int k = 1; k < 2000; ++k) {
      probability *= mean / k;
      if (k > mean && probability < 1e-18) break;
      for (int i = -reach; i <= reach; ++i) sum[i] += probability * law[i];
      law = quantile ? convolved(law, one) : gaussian(sigma, spacing, reach, k + 1);
    }
    return sum;
  }
};

/// The strength of the acceleration relative to the slip level.
double strength_of(const Arrivals& arrivals) { return arrivals.sigma * std::sqrt(std::max(1.0, arrivals.rate / 2)); }

// ---- the effect of pairs of pulses

/// The number of moments of the displacement, without the integral of v^2 and the indicator of slip.
constexpr std::size_t orders = 4;

/// The effect of pulses: X to X^4, the integral of v^2, and 1 if the block has moved. Or the cumulants of X, E[v^2] and
/// the rate at which blocks begin to slip.
using Moment = std::array<double, orders + 2>;
constexpr std::size_t squared_velocity = orders, slipped = orders + 1;

/// The effect of two pulses: the final displacement and the largest one on the way, without its sign.
struct Farthest {
  double last = 0, largest = 0;
};

/// The probability that a load moves a block at rest, for loads that are nodes of a lattice: one half at the level
/// itself, because the node represents all loads nearest to it.
double chance_to_move(const Coulomb& law, double load) {
  constexpr double tiny = 1e-9;
  const double excess = std::max(-load - law.forward(), load - law.backward());
  return excess > tiny ? 1 : excess > -tiny ? 0.5 : 0;
}

/// The joint effect of two pulses if each acted alone: the part of their moments that involves both.
Moment crossed(const Moment& a, const Moment& b) {
  return {
      0, 2 * a[0] * b[0],         3 * (a[0] * b[1] + a[1] * b[0]), 4 * (a[0] * b[2] + a[2] * b[0]) + 6 * a[1] * b[1],
      0, -a[slipped] * b[slipped]};
}

/// How long two pulses have an effect, in steps: a pulse that leaves no net velocity leaves at most what friction stops
/// within another pulse length, after which a second pulse finds the block at rest.
int reach_of(const Steps& steps) { return 4 * static_cast<int>(steps.values.size()); }

/// The moments of two pulses, the second one `offset` later, after each half of a step.
void pair(const Slider<Coulomb>& block, const Steps& steps, double b1, double b2, double offset,
          std::span<Moment> found, Farthest* farthest = nullptr) {
  detail::Ride ride;
  double largest = 0;
  const auto look = [&](double, const detail::Ride& there) {
    largest = std::max(largest, std::abs(there.state.displacement));
  };
  double moved = 0;
  const auto moment_of = [&] {
    const double x = ride.state.displacement;
    return Moment{x, x * x, x * x * x, x * x * x * x, ride.velocity_square, moved};
  };
  const auto hold = [&](double n, double duration) {
    if (duration <= 0) return;
    moved = std::max(moved, chance_to_move(block.law(), n));
    detail::hold(block, n, duration, ride, look);
    look(0, ride);
  };
  const auto count = static_cast<int>(steps.values.size());
  const double whole = std::floor(offset), part = offset - whole;
  const auto value = [&](int i) {
    return i >= 0 && i < count ? steps.unit * steps.values[static_cast<std::size_t>(i)] : 0;
  };
  const int shift = static_cast<int>(whole);
  const int ended = 2 * (count + shift + 1);
  found.front() = {};
  for (int half = 0; static_cast<std::size_t>(half) + 1 < found.size(); ++half) {
    Moment& moment = found[static_cast<std::size_t>(half) + 1];
    moment = moment_of();
    if (half >= ended && ride.state.velocity == 0) continue;
    // Within step i of the first pulse the second one goes from its step i - shift - 1 to the next.
    const int i = half / 2;
    const double change = std::clamp(part - 0.5 * (half % 2), 0.0, 0.5), n = b1 * value(i);
    hold(n + b2 * value(i - shift - 1), change);
    hold(n + b2 * value(i - shift), 0.5 - change);
    moment = moment_of();
  }
  if (farthest) *farthest = {ride.state.displacement, largest};
}

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
  std::vector<PairMoments> table(int slots, bool limit) {
    std::vector<Sums> integral(single_.size()), lattice(single_.size());
    const int count = static_cast<int>(steps_.values.size()), most = 2 * count;
    for (double from = 0; from < most;) {
      const double length = from < count ? 0.5 : 1;
      numerics::gauss_points<points>(from, from + length,
                                     [&](double offset, double weight) { add_pairs(integral, offset, weight, true); });
      from += length;
    }
    for (int k = 0; k < most * slots; ++k)
      add_pairs(lattice, static_cast<double>(k) / slots, (k == 0 ? 0.5 : 1.0) / slots, limit);
    std::vector<PairMoments> tables(single_.size());
    for (std::size_t k = 0; k < tables.size(); ++k)
      for (std::size_t i = 0; i < tables[k].size(); ++i)
        tables[k][i] = {single_[k].limit(i), integral[k].limit(i), limit ? lattice[k].limit(i) : lattice[k].coarse[i]};
    return tables;
  }

  /// What one pulse alone does, and two that overlap.
  /// @param alone  amplitudes of one pulse, on a lattice of their own
  std::vector<detail::SlipExcursion::Example> examples(double rate, const Weights& alone) {
    std::vector<detail::SlipExcursion::Example> found;
    const auto add = [&](double b1, double b2, double offset, double weight) {
      Farthest farthest;
      pair(block_, steps_, b1, b2, offset, both_, &farthest);
      if (farthest.largest > 0 && weight > 0) found.push_back({farthest.last, farthest.largest, weight});
    };
    for (int i = -alone.reach; i <= alone.reach; ++i) add(i * alone.spacing, 0, 0, alone[i]);
    const int reach = coarse_.reach, length = static_cast<int>(steps_.values.size());
    for (int s = 0; s < length; ++s)
      numerics::gauss_points<points>(s, s + 1.0, [&](double offset, double weight) {
        for (int i = -reach; i <= reach; ++i)
          for (int j = -reach; j <= reach; ++j)
            add(i * coarse_.spacing, j * coarse_.spacing, offset, rate * weight * coarse_[i] * coarse_[j]);
      });
    return found;
  }

 private:
  /// On either lattice.
  struct Sums {
    Moment coarse{}, fine{};
    /// Kinks cause errors of O(spacing^2) in both.
    double limit(std::size_t i) const { return (4 * fine[i] - coarse[i]) / 3; }
  };

  void add(std::vector<Sums>& sums, int i, int j, double fine, double coarse, double offset) {
    pair(block_, steps_, i * fine_.spacing, j * fine_.spacing, offset, both_);
    for (std::size_t k = 0; k < both_.size(); ++k)
      for (std::size_t m = 0; m < both_[k].size(); ++m) {
        sums[k].fine[m] += fine * both_[k][m];
        sums[k].coarse[m] += coarse * both_[k][m];
      }
  }

  /// The effect of a pulse that begins `offset` later.
  std::vector<Sums> alone(double offset, int step) {
    std::vector<Sums> sums(both_.size());
    for (int j = -fine_.reach; j <= fine_.reach; j += step)
      add(sums, 0, j, fine_[j], j % 2 == 0 ? coarse_[j / 2] : 0, offset);
    return sums;
  }

  /// Adds the effect of both beyond their separate effects, averaged over both amplitudes.
  void add_pairs(std::vector<Sums>& sums, double offset, double weight, bool fine) {
    const int step = fine ? 1 : 2;
    const double least = 1 / fine_.spacing;  // the sum of two amplitudes below which nothing moves
    for (int i = -fine_.reach; i <= fine_.reach; i += step)
      for (int j = mirrored_ ? 0 : -fine_.reach; j <= fine_.reach; j += step) {
        if (std::abs(i) + std::abs(j) < least - 1e-6) continue;
        const double twice = (mirrored_ && j != 0 ? 2 : 1) * weight;  // the mirror image
        const bool even = i % 2 == 0 && j % 2 == 0;
        add(sums, i, j, twice * fine_[i] * fine_[j], even ? twice * coarse_[i / 2] * coarse_[j / 2] : 0, offset);
      }
    const std::vector<Sums> first = alone(0, step), later = alone(offset, step);
    for (std::size_t k = 0; k < sums.size(); ++k)
      for (Moment Sums::*const part : {&Sums::coarse, &Sums::fine}) {
        const Moment cross = crossed(first[k].*part, later[k].*part);
        for (std::size_t m = 0; m < cross.size(); ++m) {
          (sums[k].*part)[m] -= weight * ((first[k].*part)[m] + (later[k].*part)[m] + cross[m]);
          if (mirrored_ && m < orders && m % 2 == 0) (sums[k].*part)[m] = 0;
        }
      }
  }

  const Slider<Coulomb>& block_;
  const Steps& steps_;
  bool mirrored_;
  Weights coarse_, fine_;
  std::vector<Moment> both_{static_cast<std::size_t>(2 * reach_of(steps_) + 1)};
  std::vector<Sums> single_;
};

// ---- the chain

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

/// Moments to cumulants.
std::array<double, orders> cumulants(const std::array<double, orders>& m) {
  const auto [m1, m2, m3, m4] = m;
  return {m1, m2 - m1 * m1, m3 - m1 * (3 * m2 - 2 * m1 * m1),
          m4 - 4 * m1 * m3 - 3 * m2 * m2 + m1 * m1 * (12 * m2 - 6 * m1 * m1)};
}

class Chain {
 public:
  Chain(const Slider<Coulomb>& block, const Steps& steps, const Arrivals& arrivals, int slots, bool drifting)
      : block_(block), steps_(steps), arrivals_(arrivals), slots_(slots), drifting_(drifting) {
    const Coulomb& law = block.law();
    mirrored_ = arrivals.mirrored && law.forward() == law.backward();
    const double other = std::max(law.forward(), law.backward());
    for (const int value : steps.values) values_.insert(values_.end(), static_cast<std::size_t>(slots), value);
    const double sigma = arrivals.sigma, slot = 1.0 / slots, unit = steps.unit;
    const bool fine = values_.size() == 2;
    const double wide = 1 + arrivals.rate * slot;
    // How far a pulse takes the velocity, and how much of it is still to come after each slot.
    double swing = 0, sum = 0;
    for (const int value : values_) swing = std::max(swing, std::abs(sum += value * unit * slot));
    for (std::size_t i = 0; i < values_.size(); ++i) {
      double rest = 0;
      for (std::size_t j = i; j < values_.size(); ++j) rest -= values_[j] * unit * slot;
      still_.push_back(rest);
    }
    double spacing;
    int reach;
    if (!drifting_) {
      // Lattice and slip level fit: |n| = 1 is a node.
      spacing = lattice_spacing(sigma, fine ? 3 : 2, other);
      reach = static_cast<int>(std::ceil(std::max(5.5 * sigma * std::sqrt(wide), 0.5 + 4 * sigma) / spacing));
      const int n = fine ? 24 : 14;
      const double alpha = fine ? 3.5 : 3;
      const double most = swing * slots * std::max((fine ? 5 : 4.5) * sigma * std::sqrt(1 + arrivals.rate) - 0.7, 0.6);
      for (int i = -n; i <= n; ++i) grid_.push_back(most * std::sinh(alpha * i / n) / std::sinh(alpha));
    } else {
      const double ground = sigma * std::sqrt(2 * arrivals.rate / 3);
      const double strength = strength_of(arrivals), part = strength / (fine ? 3 : 2);
      spacing = strength > 6 ? part : std::max(1.0, std::round(part));
      reach = static_cast<int>(std::ceil((fine ? 5 : 4.5) * sigma * std::sqrt(wide) / spacing));
      const double most = 2 + 4.5 * std::sqrt(1 + 0.7 * ground) + (other - 1) * (1 + 0.5 * ground);
      const double step = spacing / std::max(1.0, std::round(spacing / (0.5 * std::sqrt(1 + 0.1 * ground))));
      const int n = static_cast<int>(std::ceil(most / step));
      for (int i = -n; i <= n; ++i) grid_.push_back(i * step);
    }
    tolerance_ = drifting_ ? 1e-4 / (1 + sigma * std::sqrt(arrivals.rate)) : 1e-6;
    batch_ = arrivals.batch(slot, spacing, reach);
    unit_ = unit;
    prune();
    if (!drifting_ || fine) tabulate();
  }

  /// From rest, slot by slot; the last slot is stationary.
  /// @tparam Order  cumulants of the displacement
  template <std::size_t Order>
  std::vector<Slot> solve(const std::function<void()>& progress) const;

  /// Adds to the slots the probability that nothing has slipped yet.
  void add_slips(std::vector<Slot>& slots) const;

  /// On the chain's own lattice of amplitudes, so that the lattice's error is corrected, too.
  Pairs pairs() const {
    const double spacing = batch_.spacing;
    const int reach = static_cast<int>(std::ceil(std::max(6 * arrivals_.sigma, 0.5 + 4 * arrivals_.sigma) / spacing));
    return {block_, steps_, mirrored_, arrivals_.single(spacing, reach), arrivals_.single(spacing / 2, 2 * reach)};
  }

  /// Slips of one pulse, which are finely resolved, and of two that overlap.
  std::vector<detail::SlipExcursion::Example> excursions() const {
    constexpr int finer = 8;
    const double spacing = batch_.spacing / finer;
    const int reach = static_cast<int>(std::ceil(6 * arrivals_.sigma / spacing));
    return pairs().examples(arrivals_.rate, arrivals_.single(spacing, reach));
  }

 private:
  std::size_t size() const { return grid_.size(); }
  int span() const { return 2 * batch_.reach + 1; }

  /// Moves from velocity v under a held ground acceleration to the velocity at the end, with `still` of it to come
  /// later.
  Passage passage(double v, double n, double still) const {
    detail::Ride ride;
    ride.state.velocity = v;
    Passage passage{};
    for (std::size_t half = 0; half < 2; ++half) {
      detail::hold(block_, n, 0.5 / slots_, ride, detail::NoKnot{});
      passage.displacement[half] = ride.state.displacement;
      passage.square[half] = ride.velocity_square;
    }
    const double at = std::clamp(ride.state.velocity + still, grid_.front(), grid_.back());
    const auto last = static_cast<std::ptrdiff_t>(size()) - 1, middle = last / 2;
    std::ptrdiff_t cell = std::upper_bound(grid_.begin(), grid_.end(), at) - grid_.begin() - 1;
    std::ptrdiff_t low = 0, high = last - 3;
    if (!drifting_) (at < 0 ? high : low) = at < 0 ? middle - 3 : middle;  // the law of v has a kink and a mass at 0
    const std::ptrdiff_t first = std::clamp(cell - 1, low, high);
    passage.first = static_cast<std::uint32_t>(first);
    passage.share = lagrange(grid_.data() + first, at);
    return passage;
  }

  /// Kinds of slots: on the grid of velocities, by the ground acceleration alone; on the grid of the velocities after
  /// the end of all pulses, by all batches.
  void tabulate() {
    const double unit = batch_.spacing;
    if (!drifting_) {
      for (int n = -offset_; n <= offset_; ++n)
        for (const double v : grid_) passages_.push_back(passage(v, n * unit_ * unit, 0));
      return;
    }
    const auto width = static_cast<std::size_t>(span());
    for (std::size_t newest = 0; newest < width; ++newest)
      for (std::size_t tuple = 0; tuple < width; ++tuple) compute(newest, tuple, passages_);
  }

  /// The destination of a slot from each node of the grid of u, for one newest batch and the earlier ones.
  void compute(std::size_t newest, std::size_t tuple, std::vector<Passage>& passages) const {
    double n = 0, before = 0, after = 0;
    const auto take = [&](std::size_t i, std::size_t s) {
      const double amplitude = (static_cast<int>(s) - batch_.reach) * batch_.spacing;
      n += values_[i] * unit_ * amplitude;
      before += still_[i] * amplitude;  // of the newest one nothing: the whole pulse leaves no velocity
      if (i + 1 < values_.size()) after += still_[i + 1] * amplitude;
    };
    take(0, newest);
    for (std::size_t i = values_.size() - 1; i > 0; --i) {
      take(i, tuple % static_cast<std::size_t>(span()));
      tuple /= static_cast<std::size_t>(span());
    }
    for (const double u : grid_) passages.push_back(passage(u - before, n, after));
  }

  /// Combinations less probable than this are omitted: together at most a thousandth of the probability to slip, in
  /// practice far less.
  void prune() {
    int most = 0;
    for (const int value : values_) most += std::abs(value);
    offset_ = most * batch_.reach;
    std::vector<double> law(static_cast<std::size_t>(2 * offset_ + 1)), next(law.size());  // of n
    law[static_cast<std::size_t>(offset_)] = 1;
    for (const int value : values_) {
      std::ranges::fill(next, 0);
      for (int n = -offset_; n <= offset_; ++n)
        if (const double chance = law[static_cast<std::size_t>(n + offset_)]; chance > 0)
          for (int s = -batch_.reach; s <= batch_.reach; ++s)
            next[static_cast<std::size_t>(n + value * s + offset_)] += chance * std::abs(batch_[s]);
      law.swap(next);
    }
    double slips = 0;
    for (int n = -offset_; n <= offset_; ++n)
      if (chance_to_move(n) == 1) slips += law[static_cast<std::size_t>(n + offset_)];
    min_chance_ = 1e-3 * slips / std::pow(span(), static_cast<double>(values_.size()));
  }

  double chance_to_move(std::ptrdiff_t n) const {
    return theory::chance_to_move(block_.law(), static_cast<double>(n) * batch_.spacing * unit_);
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

template <std::size_t Order>
std::vector<Slot> Chain::solve(const std::function<void()>& progress) const {
  constexpr int max_slots = 20'000;
  const auto reach = static_cast<std::ptrdiff_t>(batch_.reach);
  const std::size_t width = static_cast<std::size_t>(span()), nodes = size(), past = values_.size() - 1;
  std::size_t heads = 1;  // of the past batches, all but the oldest
  for (std::size_t i = 1; i < past; ++i) heads *= width;
  const std::size_t tuples = heads * width, all = tuples * nodes;

  // With y the displacement minus its mean, E[exp(k y); state] / E[exp(k y)] as a power series in k, times n!: the law
  // of the state, and the growth of the cumulants of the displacement. All stay bounded. If levels and amplitudes are
  // symmetric, the terms of even order are even under a change of all signs, the others odd.
  std::array<std::vector<double>, Order> fields, next;
  for (std::vector<double>& field : fields) field.resize(all);
  for (std::vector<double>& field : next) field.resize(all);
  fields[0][all / 2] = 1;               // at rest, and no pulse before
  std::vector<double> chances(tuples);  // of the past batches, once there are as many
  for (std::size_t tuple = 0; tuple < tuples; ++tuple) {
    double chance = 1;
    std::size_t left = tuple;
    for (std::size_t i = past; i > 0; --i) {
      chance *= std::abs(batch_.w[left % width]);
      left /= width;
    }
    chances[tuple] = chance;
  }

  // The velocity still to come from the past batches, which the grid of u includes.
  std::vector<double> coming(tuples);
  if (drifting_)
    for (std::size_t tuple = 0; tuple < tuples; ++tuple)
      for (std::size_t i = past, left = tuple; i > 0; --i, left /= width)
        coming[tuple] += still_[i] * (static_cast<int>(left % width) - batch_.reach) * batch_.spacing;

  // The integer n of a slot, without the newest and the oldest batch.
  std::vector<std::ptrdiff_t> middle(heads);
  for (std::size_t head = 0; head < heads; ++head) {
    std::size_t left = head;
    for (std::size_t i = past - 1; i > 0; --i) {
      middle[head] += values_[i] * (static_cast<std::ptrdiff_t>(left % width) - reach);
      left /= width;
    }
  }

  using Raw = std::array<double, orders>;
  struct Sums {
    Raw half{}, whole{};
    std::array<double, 2> square{};
  };
  std::vector<Passage> computed;
  std::vector<Slot> slots;
  int steady = 0;
  for (int slot = 0; steady < 2; ++slot) {
    if (slot == max_slots)
      throw ConvergenceError("PulseChain: not stationary after " + std::to_string(max_slots) + " slots");
    if (progress) progress();
    Sums sums;
    double total = 0;
    Slot found;
    for (std::size_t tuple = 0; tuple < tuples; ++tuple)
      for (std::size_t i = 0; i < nodes; ++i) {
        const double v = grid_[i] - coming[tuple];
        for (std::size_t n = mirrored_ ? 1 : 0; n < Order; n += mirrored_ ? 2 : 1)
          found.displacement[n].slope += static_cast<double>(n + 1) * v * fields[n][tuple * nodes + i];
        found.velocity.slope += v * v * fields[0][tuple * nodes + i];
      }
    // Newest batches below 0 may be the mirror images of those above.
    for (std::size_t k = mirrored_ ? static_cast<std::size_t>(reach) : 0; k < width; ++k) {
      const double chance = batch_.w[k], twice = mirrored_ && k != static_cast<std::size_t>(reach) ? 2 : 1;
      for (std::size_t head = 0; head < heads; ++head) {
        std::array<double*, Order> to;
        for (std::size_t n = 0; n < Order; ++n) {
          to[n] = next[n].data() + (k * heads + head) * nodes;
          std::fill_n(to[n], nodes, 0);
        }
        Sums part;
        for (std::size_t oldest = 0; oldest < width; ++oldest) {
          const std::size_t tuple = head * width + oldest;
          if (chances[tuple] * std::abs(chance) < min_chance_) continue;
          const std::size_t kind =
              drifting_
                  ? k * tuples + tuple
                  : static_cast<std::size_t>(values_.front() * (static_cast<std::ptrdiff_t>(k) - reach) + middle[head] +
                                             values_.back() * (static_cast<std::ptrdiff_t>(oldest) - reach) + offset_);
          const Passage* passages = passages_.data() + kind * nodes;
          if (passages_.empty()) {
            computed.clear();
            compute(k, tuple, computed);
            passages = computed.data();
          }
          for (std::size_t i = 0; i < nodes; ++i) {
            const Passage& p = passages[i];
            std::array<double, Order> f;
            for (std::size_t n = 0; n < Order; ++n) f[n] = fields[n][tuple * nodes + i];
            const auto raise = [&f](double x, Raw& raw) {  // adds a displacement to the moments
              raw[0] += x * f[0];
              raw[1] += x * (2 * f[1] + x * f[0]);
              if constexpr (Order == 4) {
                raw[2] += x * (3 * f[2] + x * (3 * f[1] + x * f[0]));
                raw[3] += x * (4 * f[3] + x * (6 * f[2] + x * (4 * f[1] + x * f[0])));
              }
            };
            const double x = p.displacement[1];
            raise(p.displacement[0], part.half);
            raise(x, part.whole);
            part.square[0] += p.square[0] * f[0];
            part.square[1] += p.square[1] * f[0];
            if constexpr (Order == 4) {
              f[3] += x * (3 * f[2] + x * (3 * f[1] + x * f[0]));
              f[2] += x * (2 * f[1] + x * f[0]);
            }
            f[1] += x * f[0];
            for (std::size_t j = 0; j < 4; ++j)
              for (std::size_t n = 0; n < Order; ++n) to[n][p.first + j] += p.share[j] * f[n];
          }
        }
        for (std::size_t i = 0; i < nodes; ++i) {
          for (std::size_t n = 0; n < Order; ++n) to[n][i] *= chance;
          total += twice * to[0][i];
        }
        for (std::size_t n = mirrored_ ? 1 : 0; n < Order; n += mirrored_ ? 2 : 1) {
          sums.half[n] += twice * chance * part.half[n];
          sums.whole[n] += twice * chance * part.whole[n];
        }
        for (std::size_t i = 0; i < 2; ++i) sums.square[i] += twice * chance * part.square[i];
      }
    }
    if (mirrored_)
      for (std::size_t n = 0; n < Order; ++n)
        for (std::size_t i = 0, half = static_cast<std::size_t>(reach) * heads * nodes; i < half; ++i)
          next[n][i] = (n % 2 == 0 ? 1 : -1) * next[n][all - 1 - i];
    // The total is 1, except for the omitted probability.
    for (Raw* const raw : {&sums.half, &sums.whole})
      for (double& m : *raw) m /= total;
    Raw s{};  // sums of the fields; subtracting them keeps the omitted probability from adding up over the steps
    for (std::size_t n = mirrored_ ? 2 : 1; n < Order; n += mirrored_ ? 2 : 1) {
      for (const double f : next[n]) s[n - 1] += f;
      s[n - 1] /= total;
    }
    for (std::size_t i = 0; i < all; ++i) {
      std::array<double, Order> f;
      for (std::size_t n = 0; n < Order; ++n) f[n] = next[n][i] / total;
      if constexpr (Order == 4) {
        f[3] +=
            -3 * s[0] * f[2] + 3 * (2 * s[0] * s[0] - s[1]) * f[1] + (-s[2] + 6 * s[0] * (s[1] - s[0] * s[0])) * f[0];
        f[2] += -2 * s[0] * f[1] + (2 * s[0] * s[0] - s[1]) * f[0];
      }
      f[1] -= s[0] * f[0];
      for (std::size_t n = 0; n < Order; ++n) fields[n][i] = f[n];
    }
    const auto half = cumulants(sums.half), whole = cumulants(sums.whole);
    for (std::size_t n = 0; n < Order; ++n) {
      found.displacement[n].half = half[n];
      found.displacement[n].whole = whole[n];
    }
    found.velocity.half = sums.square[0] / total;
    found.velocity.whole = sums.square[1] / total;
    if (!drifting_)
      for (std::size_t tuple = 0; tuple < tuples; ++tuple) found.rest += fields[0][tuple * nodes + nodes / 2];
    bool still = !slots.empty();
    if (still) {
      const Slot& last = slots.back();
      const double spread = std::sqrt(std::abs(whole[1]));
      const auto same = [&](double now, double before, double scale) {
        return std::abs(now - before) <= tolerance_ * (std::abs(now) + scale);
      };
      for (std::size_t n = 0; n < Order; ++n)
        still = still &&
                same(whole[n], last.displacement[n].whole, n == 1 ? 0 : std::pow(spread, static_cast<double>(n + 1)));
      still = still && same(found.velocity.whole, last.velocity.whole, 0);
    }
    slots.push_back(found);
    steady = still && slot > static_cast<int>(past) ? steady + 1 : 0;
  }
  return slots;
}

void Chain::add_slips(std::vector<Slot>& slots) const {
  const auto reach = static_cast<std::ptrdiff_t>(batch_.reach);
  const std::size_t width = static_cast<std::size_t>(span()), past = values_.size() - 1;
  std::size_t heads = 1;
  for (std::size_t i = 1; i < past; ++i) heads *= width;
  std::vector<double> law(heads * width), next(law.size());
  for (const double at_level : {0.0, 1.0}) {  // chances at the level itself, of which the mean is taken
    std::ranges::fill(law, 0);
    law[law.size() / 2] = 1;
    for (Slot& slot : slots) {
      double total = 0;
      for (std::size_t head = 0; head < heads; ++head) {
        std::ptrdiff_t middle = 0;
        std::size_t left = head;
        for (std::size_t i = past - 1; i > 0; --i, left /= width)
          middle += values_[i] * (static_cast<std::ptrdiff_t>(left % width) - reach);
        for (std::size_t k = 0; k < width; ++k) {
          double sum = 0;
          for (std::size_t oldest = 0; oldest < width; ++oldest) {
            const double chance = chance_to_move(values_.front() * (static_cast<std::ptrdiff_t>(k) - reach) + middle +
                                                 values_.back() * (static_cast<std::ptrdiff_t>(oldest) - reach));
            if (chance == 0 || (chance == 0.5 && at_level == 0)) sum += law[head * width + oldest];
          }
          total += next[k * heads + head] = batch_.w[k] * sum;
        }
      }
      slot.slips -= std::log(total) / 2;
      for (std::size_t i = 0; i < law.size(); ++i) law[i] = next[i] / total;
    }
  }
}

/// Above this sigma / a, the results are those without friction minus a part that falls as a / sigma: growth is
/// accurate to 3 % if at most one pulse arrives per step, or if friction is negligible.
constexpr double strongest = 256;
constexpr double weakest = 0.05, min_refined_sigma = 0.12;
constexpr double max_arrivals = 50;
/// With unequal levels or asymmetric amplitudes nothing is known beyond these limits.
constexpr double strongest_drift = 20, greatest_ratio = 4;

/// The same lattice without friction, one slot to a step.
std::vector<Slot> frictionless(const Steps& steps, const Arrivals& arrivals, std::size_t slots) {
  const Slider<Coulomb> free(Coulomb(0));
  const double second = arrivals.rate * arrivals.sigma * arrivals.sigma;
  const double fourth = arrivals.rate * arrivals.fourth * std::pow(arrivals.sigma, 4);
  std::vector<Slot> found;
  detail::Ride ride;
  Slot sum;
  sum.slips = arrivals.rate;
  for (std::size_t i = 0; i < slots; ++i) {
    if (i < steps.values.size()) {
      const double x = ride.state.displacement, v = ride.state.velocity, before = ride.velocity_square;
      sum.displacement[1].slope += second * 2 * x * v;
      sum.displacement[3].slope += fourth * 4 * x * x * x * v;
      sum.velocity.slope += second * v * v;
      for (double Rise::*const end : {&Rise::half, &Rise::whole}) {
        detail::hold(free, steps.unit * steps.values[i], 0.5, ride, detail::NoKnot{});
        const double y = ride.state.displacement;
        sum.displacement[1].*end += second * (y * y - x * x);
        sum.displacement[3].*end += fourth * (y * y * y * y - x * x * x * x);
        sum.velocity.*end += second * (ride.velocity_square - before);
      }
    }
    found.push_back(sum);
  }
  return found;
}

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

Steps steps_of(const PulseShape& shape, int slots) {
  const auto times = shape.times();
  const auto values = shape.values();
  const double step = times[1];
  for (std::size_t i = 1; i + 1 < times.size(); ++i)
    require(std::abs(times[i + 1] - times[i] - step) <= 1e-9 * step, "PulseChain: the pulse must have equal steps",
            times[i + 1] - times[i]);
  const std::size_t most = slots == 1 ? 4 : 2;
  require(values.size() >= 2 && values.size() <= most,
          "PulseChain: the pulse must have 2 to " + std::to_string(most) + " steps",
          static_cast<double>(values.size()));
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  constexpr int finest = 12;
  for (int parts = 1; parts <= finest; ++parts) {
    Steps steps{{}, 1.0 / parts};
    int net = 0;
    bool fits = true;
    for (const double value : values) {
      const double multiple = value / largest * parts;
      steps.values.push_back(static_cast<int>(std::lround(multiple)));
      net += steps.values.back();
      fits = fits && std::abs(multiple - steps.values.back()) < 1e-9;
    }
    if (!fits) continue;
    require(net == 0, "PulseChain: the pulse must leave no net velocity", net * largest / parts);
    return steps;
  }
  throw std::invalid_argument(
      "PulseChain: the values of the pulse must be multiples of a twelfth, or of a greater "
      "part, of the largest one");
}

/// An upper bound of the probability that the acceleration of Gaussian pulses exceeds the slip level.
double chance_to_slip(const Arrivals& arrivals, double length) {
  const double mean = arrivals.rate * length;
  double probability = std::exp(-mean), sum = 0;
  for (int k = 1; k < 2000; ++k) {
    probability *= mean / k;
    sum += probability * std::erfc(1 / (arrivals.sigma * std::sqrt(2.0 * k)));
  }
  return sum;
}

/// A slider under pulses, in the units of the chain.
struct Problem {
  double step;   ///< of the pulse [s]
  double push;   ///< rms of the largest acceleration of a pulse [m/s^2]
  double sigma;  ///< the same in slip levels; the chain's own, in `arrivals`, is at most `strongest`
  Slider<Coulomb> block;
  Arrivals arrivals;
  double chance;  ///< upper bound of the probability that anything slips; 1 where sigma is not below `weakest`
  const PulseShape& shape;

  /// @throws std::invalid_argument if the chain does not cover the arguments
  Problem(const Slider<Coulomb>& slider, const PoissonPulses& pulses);

  bool drifting() const { return strength_of(arrivals) > 3; }
  double acceleration() const { return push / arrivals.sigma; }  ///< the slip level, unless it is too small
};

/// The levels in units of the smaller one.
Slider<Coulomb> unit_block(const Coulomb& law) {
  const double level = std::min(law.forward(), law.backward());
  return Slider(law.forward() == law.backward() ? Coulomb(1) : Coulomb(law.forward() / level, law.backward() / level));
}

Problem::Problem(const Slider<Coulomb>& slider, const PoissonPulses& pulses)
    : block(Coulomb(1)), shape(pulses.options().shape) {
  const Coulomb& law = slider.law();
  const double level = std::min(law.forward(), law.backward()), other = std::max(law.forward(), law.backward());
  const PoissonOptions& options = pulses.options();
  detail::require_no_spring(slider.natural_frequency(), "PulseChain");
  detail::require_plain(slider, "PulseChain");
  if (options.envelope) throw std::invalid_argument("PulseChain: an envelope is not covered; PulseSuperposition does");
  double largest = 0;
  for (const double value : options.shape.values()) largest = std::max(largest, std::abs(value));
  step = options.shape.times()[1] * pulses.half_width();
  push = pulses.sigma() * largest;
  sigma = push / level;
  arrivals = {pulses.rate() * step, std::min(sigma, strongest), options.quantile};
  if (options.quantile) {
    const std::vector<double> all = amplitudes(options.quantile);
    arrivals.mirrored = symmetric(all);
    arrivals.fourth = 0;
    for (const double b : all) arrivals.fourth += b * b * b * b / static_cast<double>(all.size());
  }
  if (level != other || !arrivals.mirrored)
    require(sigma <= strongest_drift,
            "PulseChain: with slip levels or amplitudes that differ both ways sigma must be at most 20 slip levels",
            sigma);
  if (level != other) {
    require(arrivals.mirrored,
            "PulseChain: amplitudes must be symmetric, quantile(u) = -quantile(1 - u), where slip levels differ: their "
            "ratio must then be 1",
            other / level);
    block = unit_block(law);
    require(other <= greatest_ratio * level || !drifting(),
            "PulseChain: where sigma exceeds 3 times the smaller slip level the other one must be at most 4 times it",
            other / level);
  }
  require(arrivals.rate <= max_arrivals, "PulseChain: pulses to a step of the pulse must be at most 50", arrivals.rate);
  if (sigma > strongest)
    require(arrivals.rate <= 1 || sigma >= 1000 * std::exp(3 * arrivals.rate),
            "PulseChain: with " + shortest(arrivals.rate) +
                " pulses to a step of the pulse, sigma must be at most 256 slip levels or so many that nothing is left "
                "of friction, 1000 exp(3 x " +
                shortest(arrivals.rate) + ")",
            sigma);
  chance = options.quantile || sigma >= weakest ? 1 : chance_to_slip(arrivals, options.shape.length());
  if (sigma < weakest)
    require(chance < 1e-12,
            "PulseChain: sigma must be at least a twentieth of the slip level where pulses are this many", sigma);
}

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
      numerics::gauss_points<points>(from, std::min(from + 0.5, early),
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

/// @tparam Order  number of cumulants of the displacement
/// @param slots   number per step
template <std::size_t Order>
ChainGrowth chain_growth(const Problem& problem, int slots, const std::function<void()>& progress) {
  const Steps steps = steps_of(problem.shape, slots);
  const Chain chain(problem.block, steps, problem.arrivals, slots, problem.drifting());
  std::vector<Slot> solution = chain.solve<Order>(progress);
  if (Order > 2) chain.add_slips(solution);
  Correction correction;
  if (!problem.drifting()) correction = {chain.pairs().table(slots, false), problem.arrivals.rate, solution, slots};
  if (problem.sigma > strongest) {
    const std::vector<Slot> free = frictionless(steps, problem.arrivals, solution.size());
    const double part = strongest / problem.sigma;
    for (std::size_t i = 0; i < solution.size(); ++i) {
      Slot faded;
      faded.add(part, solution[i]);
      faded.add(1 - part, free[i]);
      solution[i] = faded;
    }
  }
  return {std::move(solution), 1.0 / slots, std::move(correction)};
}

/// Two slots per step: above this range, the error of their coarser grid exceeds that of one slot; below it they take
/// minutes.
bool two_slots(double sigma, bool refined) { return refined && sigma >= min_refined_sigma && sigma <= 1; }

/// Weight of Richardson's extrapolation: the error of the effect of three or more pulses is of second order in the
/// slot. Full where these cause the slips, zero where the errors of the grids are as large.
double extrapolation(double sigma) { return std::clamp((0.5 - sigma) / (0.5 - 1.0 / 3), 0.0, 1.0) / 3; }

template <std::size_t Order>
Growth growth_of(const Problem& problem, bool refined, const std::function<void()>& progress) {
  Growth growth;
  const bool two = two_slots(problem.sigma, refined);
  const double more = two ? extrapolation(problem.sigma) : -1;
  if (more != 0) growth.add(-more, chain_growth<Order>(problem, 1, progress));
  if (two) growth.add(1 + more, chain_growth<Order>(problem, 2, progress));
  return growth;
}

void append(std::string& text, const std::string& sentence) { text += (text.empty() ? "" : " ") + sentence; }

void remark(Moments& moments, const std::string& sentence) { append(moments.remark, sentence); }

std::string strength_text(double sigma) { return "sigma / slip level = " + shortest(std::round(sigma * 1e4) / 1e4); }

/// Whether the levels differ by less than a third.
bool nearly_equal(const Coulomb& law) {
  const double ratio = std::max(law.forward(), law.backward()) / std::min(law.forward(), law.backward());
  return ratio > 1 && ratio < 4.0 / 3;
}

/// Parameters for which no error was measured.
std::string range_remark(const Problem& problem, const PoissonOptions& options) {
  const auto& [step, push, sigma, block, arrivals, chance, shape] = problem;
  std::string text;
  if (!(arrivals.mirrored && block.law().forward() == block.law().backward()) && (arrivals.rate > 2 || sigma < 1.0 / 3))
    append(
        text,
        "Slip levels or amplitudes that differ both ways were tried for sigma / slip level from 1/3 on and up to two "
        "pulses to a step only.");
  if (arrivals.rate > 4)
    append(text, shortest(arrivals.rate) + " pulses to a step of the pulse: nothing was tried above 4.");
  if (sigma < 0.125) append(text, strength_text(sigma) + ": nothing was tried below 0.125.");
  if (options.shape.values().size() != 2 || options.quantile)
    append(text, "Errors were measured for the symmetric rectangular pulse and Gaussian amplitudes only.");
  return text;
}

}  // namespace

void PulseChain::check(const Slider<Coulomb>& slider, const PoissonPulses& pulses) const {
  const Problem problem(slider, pulses);
  steps_of(problem.shape, two_slots(problem.sigma, refined_) ? 2 : 1);
}

namespace {

/// Of the displacement at a time [s], by the chain's cumulants.
detail::Slips slips_of(const Problem& problem, double time, bool refined, const std::function<void()>& progress) {
  if (problem.sigma < weakest || time == 0) return {};
  require(
      problem.sigma >= min_refined_sigma,
      "PulseChain: a distribution is known for sigma of at least 0.12 slip levels, or below 0.05 where nothing slips",
      problem.sigma);
  require(problem.arrivals.rate <= 4, "PulseChain: a distribution is known for at most 4 pulses to a step of the pulse",
          problem.arrivals.rate);
  const double length = problem.shape.length() / problem.shape.times()[1] * problem.step;
  require(time >= length,
          "PulseChain: a distribution is known at time 0 and from the length of a pulse on, " + shortest(length) + " s",
          time, "s");
  const Growth growth = growth_of<orders>(problem, refined, progress);
  const double t = time / problem.step, unit = problem.acceleration() * problem.step * problem.step;
  std::array<double, orders> found;
  double power = 1;
  for (std::size_t n = 0; n < orders; ++n) found[n] = (power *= unit) * growth.sum(n, t);
  return detail::gamma_slips(growth.sum(slipped, t), found);
}

}  // namespace

Interval PulseChain::peak(const Slider<Coulomb>& slider, const PoissonPulses& pulses, double probability,
                          const std::function<void()>& progress) const {
  const Problem problem(slider, pulses);
  require(probability > 0 && probability < 1, "PulseChain: probability must lie in (0, 1)", probability);
  const detail::Slips slips = slips_of(problem, pulses.duration(), refined_, progress);
  if (slips.count == 0) return {};
  const Steps steps = steps_of(problem.shape, 1);
  const Chain chain(problem.block, steps, problem.arrivals, 1, problem.drifting());
  const detail::SlipExcursion excursion(chain.excursions());
  const double unit = problem.acceleration() * problem.step * problem.step;
  const double peak = detail::slip_walk_peak(
      slips,
      [&](double slip) {
        detail::SlipExcursion::Parts farthest = excursion(slip / unit);
        for (double& distance : farthest) distance *= unit;
        return farthest;
      },
      probability);
  const bool known = problem.sigma > 0.333 && problem.sigma <= 20 && range_remark(problem, pulses.options()).empty() &&
                     problem.arrivals.rate <= 2 && probability >= 0.5 && probability <= 0.99 &&
                     pulses.duration() >= 10 * problem.step;
  const detail::RatioRange ratio =
      !known ? detail::RatioRange{0, std::numeric_limits<double>::infinity()} : detail::peak_ratio(slips.count);
  return {peak, peak / ratio.largest,
          ratio.smallest > 0 ? peak / ratio.smallest : std::numeric_limits<double>::infinity()};
}

DisplacementDistribution PulseChain::distribution(const Slider<Coulomb>& slider, const PoissonPulses& pulses,
                                                  double time, const std::function<void()>& progress) const {
  const Problem problem(slider, pulses);
  require(std::isfinite(time) && time >= 0, "PulseChain: time must be finite and at least 0", time, "s");
  std::string text = range_remark(problem, pulses.options());
  if (problem.sigma >= weakest && time > 0) {
    const bool two = two_slots(problem.sigma, refined_);
    if (problem.sigma < (two ? 0.2 : 1.0 / 3) - 1e-9)
      append(text, strength_text(problem.sigma) + ". " + detail::pulse_accuracy().weakest);
    if (two && nearly_equal(problem.block.law())) append(text, detail::pulse_accuracy().near_levels);
  }
  return DisplacementDistribution(slips_of(problem, time, refined_, progress), text);
}

Moments PulseChain::predict(const Slider<Coulomb>& slider, const PoissonPulses& pulses, std::span<const double> times,
                            const std::function<void()>& progress) const {
  const Problem problem(slider, pulses);
  const auto& [step, push, sigma, block, arrivals, chance, shape] = problem;
  const PoissonOptions& options = pulses.options();
  for (const double time : times)
    require(std::isfinite(time) && time >= 0, "PulseChain: times must be finite and at least 0", time, "s");
  Moments moments;
  const std::size_t count = times.size();
  moments.time.assign(times.begin(), times.end());
  for (Estimates* e : {&moments.displacement_mean, &moments.displacement_variance, &moments.covariance,
                       &moments.velocity_mean, &moments.velocity_variance}) {
    e->value.assign(count, 0);
    e->error.assign(count, 0);
  }
  if (sigma < weakest) {
    remark(moments, "Nothing slips: the slip level is " + shortest(1 / sigma) +
                        " times sigma, and the chance that the ground's acceleration exceeds it is " +
                        shortest(chance) + ".");
    return moments;
  }

  const Growth growth = growth_of<2>(problem, refined_, progress);
  const double v_unit = problem.acceleration() * step, x_unit = v_unit * step;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = times[i] / step, drift = growth.rate(0, t);
    moments.displacement_mean.value[i] = x_unit * growth.sum(0, t);
    moments.velocity_mean.value[i] = v_unit * drift;
    moments.displacement_variance.value[i] = x_unit * x_unit * growth.sum(1, t);
    moments.covariance.value[i] = x_unit * v_unit * growth.rate(1, t) / 2;
    moments.velocity_variance.value[i] = v_unit * v_unit * (growth.rate(squared_velocity, t) - drift * drift);
  }
  moments.growth_rate = {x_unit * v_unit * growth.rate(1, std::numeric_limits<double>::infinity()), 0};

  moments.remark = range_remark(problem, options);
  const bool two = two_slots(sigma, refined_);
  if (!two && sigma < 0.3)
    remark(moments, strength_text(sigma) + " is below 0.3. " + detail::pulse_accuracy().weak);
  else if (!two && sigma < 0.5 && arrivals.rate > 2)
    remark(moments, strength_text(sigma) + " is below 0.5, with more than two pulses to a step: refined is needed.");
  if (two && nearly_equal(block.law())) remark(moments, detail::pulse_accuracy().near_levels);
  const double length = options.shape.length() * pulses.half_width();
  if (const auto n = std::ranges::count_if(times, [&](double t) { return t > 0 && t < length; });
      n > 0 && (sigma < 0.5 || arrivals.rate > 2))
    remark(moments,
           std::to_string(n) + " of the times " + (n == 1 ? "is" : "are") + " below " + shortest(length) +
               " s, the length of a pulse: with sigma / slip level below 0.5 or more than two pulses to a step "
               "simulations differ there by up to a factor of 2.4.");
  if (options.stationary_start)
    remark(moments, "From rest as if no pulse had arrived before time zero: a stationary start is not followed.");
  return moments;
}

double PulseChain::final_rms(const Slider<Coulomb>& slider, const PoissonPulses& pulses,
                             const std::function<void()>& progress) const {
  const double end[] = {pulses.duration()};
  const Moments moments = predict(slider, pulses, end, progress);
  return std::hypot(std::sqrt(moments.displacement_variance.value[0]), moments.displacement_mean.value[0]);
}

}  // namespace stickslip::theory

namespace stickslip::detail {

PairTable pair_coefficients(double sigma, int slots) {
  using namespace theory;
  const double spacing = lattice_spacing(sigma, 3);
  const int reach = static_cast<int>(std::ceil(6 * sigma / spacing));
  const Steps steps{{1, -1}, 1};
  const Slider<Coulomb> block(Coulomb(1));
  const PairMoments found =
      Pairs(block, steps, true, gaussian(sigma, spacing, reach, 1), gaussian(sigma, spacing / 2, 2 * reach, 1))
          .table(slots, true)
          .back();
  return {found[1], found[squared_velocity]};
}

}  // namespace stickslip::detail
