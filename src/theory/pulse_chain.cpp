#include "stickslip/theory/pulse_chain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "stickslip/error.hpp"
#include "stickslip/numerics/gauss_legendre.hpp"
#include "stickslip/theory/pulse_response.hpp"

namespace stickslip::theory {
namespace {

using detail::PairTable;
using detail::require;
using detail::shortest;

// Inside, the unit of acceleration is the slip level, that of time the step of the pulse.

const Slider<Coulomb> unit_block(Coulomb(1));

/// A pulse of equal steps.
struct Steps {
  std::vector<int> values{};  ///< of the steps, as multiples of the unit
  double unit = 1;            ///< of those multiples, as a part of the pulse's amplitude
};

/// Of a lattice of amplitudes on which the slip level is a node, `parts` to sigma or more.
double lattice_spacing(double sigma, double parts) {
  return sigma > 2 ? 1 : 1 / std::ceil(std::max(parts / sigma, 0.5 / (sigma * sigma)));
}

/// What is the same for all slots of a kind: where a slot leads from each node of the grid, spread over four nodes,
/// and the displacement and the integral of v^2 by the middle of the slot and by its end.
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

/// Sums of `count` Gaussian amplitudes, normalised on the lattice.
Weights gaussian(double sigma, double spacing, int reach, int count) {
  Weights law{spacing, reach, std::vector<double>(static_cast<std::size_t>(2 * reach + 1))};
  double sum = 0;
  for (int i = -reach; i <= reach; ++i) sum += law[i] = std::exp(-0.5 * std::pow(i * spacing / sigma, 2) / count);
  for (double& w : law.w) w /= sum;
  return law;
}

using Quantile = std::function<void(std::span<double>)>;

/// The amplitudes in the middle of equal parts of a law.
std::vector<double> amplitudes(const Quantile& quantile) {
  constexpr std::size_t count = 1 << 14;
  std::vector<double> u(count);
  for (std::size_t i = 0; i < count; ++i) u[i] = (static_cast<double>(i) + 0.5) / count;
  quantile(u);
  for (std::size_t i = 0; i < count; ++i)
    require(std::abs(u[i] + u[count - 1 - i]) <= 1e-9 * (1 + std::abs(u[i])),
            "PulseChain: amplitudes must be symmetric, quantile(u) = -quantile(1 - u)", u[i]);
  return u;
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

/// The law of the sum of two, what falls outside being dropped.
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

/// What the acceleration has to do with the slip level.
double strength_of(const Arrivals& arrivals) { return arrivals.sigma * std::sqrt(std::max(1.0, arrivals.rate / 2)); }

// ---- what pairs of pulses do

/// X^2 and int v^2.
using Moment = std::array<double, 2>;

/// How long two pulses have an effect, in steps: one that leaves no net velocity leaves at most what friction stops
/// within another length of it, after which a second one finds all at rest.
int reach_of(const Steps& steps) { return 4 * static_cast<int>(steps.values.size()); }

/// Both moments of two pulses, the second one `offset` later, after each half of a step.
void pair(const Steps& steps, double b1, double b2, double offset, std::span<Moment> found) {
  detail::Ride ride;
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
    moment = {ride.state.displacement * ride.state.displacement, ride.velocity_square};
    if (half >= ended && ride.state.velocity == 0) continue;
    // Within step i of the first pulse the second one goes from its step i - shift - 1 to the next.
    const int i = half / 2;
    const double change = std::clamp(part - 0.5 * (half % 2), 0.0, 0.5), n = b1 * value(i);
    if (change > 0) detail::hold(unit_block, n + b2 * value(i - shift - 1), change, ride, detail::NoKnot{});
    if (change < 0.5) detail::hold(unit_block, n + b2 * value(i - shift), 0.5 - change, ride, detail::NoKnot{});
    moment = {ride.state.displacement * ride.state.displacement, ride.velocity_square};
  }
}

/// What pairs do, by lattices of amplitudes: the chain's and one twice as fine, whose every second node is the chain's.
class Pairs {
 public:
  Pairs(const Steps& steps, Weights coarse, Weights fine)
      : steps_(steps),
        coarse_(std::move(coarse)),
        fine_(std::move(fine)),
        single_(static_cast<std::size_t>(2 * reach_of(steps) + 1)) {
    add_later(single_, 0, 1, 1);
  }

  /// At the chain's lattice of amplitudes, `slots` to a step; or, for none of it, by the limit of both. Of pulses that
  /// began within 0, 1/2, 1, ... steps, the last ones of all.
  std::vector<PairTable> table(int slots, bool limit) {
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
    std::vector<PairTable> tables(single_.size());
    for (std::size_t k = 0; k < tables.size(); ++k) {
      const auto coefficients = [&](std::size_t i) {
        return detail::PairCoefficients{single_[k].limit(i), integral[k].limit(i),
                                        limit ? lattice[k].limit(i) : lattice[k].coarse[i]};
      };
      tables[k] = {coefficients(0), coefficients(1)};
    }
    return tables;
  }

 private:
  /// Of X^2 and int v^2.
  struct Sums {
    Moment coarse{}, fine{};
    /// Kinks make both err by O(spacing^2).
    double limit(std::size_t i) const { return (4 * fine[i] - coarse[i]) / 3; }
  };

  void add(std::vector<Sums>& sums, int i, int j, double fine, double coarse, double offset) {
    pair(steps_, i * fine_.spacing, j * fine_.spacing, offset, both_);
    for (std::size_t k = 0; k < both_.size(); ++k)
      for (std::size_t m = 0; m < 2; ++m) {
        sums[k].fine[m] += fine * both_[k][m];
        sums[k].coarse[m] += coarse * both_[k][m];
      }
  }

  /// Adds what a second pulse does `offset` later, by itself.
  void add_later(std::vector<Sums>& sums, double offset, double weight, int step) {
    for (int j = -fine_.reach; j <= fine_.reach; j += step)
      add(sums, 0, j, weight * fine_[j], j % 2 == 0 ? weight * coarse_[j / 2] : 0, offset);
  }

  /// Adds the mean over both amplitudes less that of each by itself.
  void add_pairs(std::vector<Sums>& sums, double offset, double weight, bool fine) {
    const int step = fine ? 1 : 2;
    const double least = 1 / fine_.spacing;  // the sum of two amplitudes below which nothing moves
    for (int i = -fine_.reach; i <= fine_.reach; i += step)
      for (int j = 0; j <= fine_.reach; j += step) {  // and the mirror image
        if (std::abs(i) + j <= least) continue;
        const double twice = (j == 0 ? 1 : 2) * weight;
        const bool even = i % 2 == 0 && j % 2 == 0;
        add(sums, i, j, twice * fine_[i] * fine_[j], even ? twice * coarse_[i / 2] * coarse_[j / 2] : 0, offset);
      }
    add_later(sums, 0, -weight, step);
    add_later(sums, offset, -weight, step);
  }

  const Steps& steps_;
  Weights coarse_, fine_;
  std::vector<Sums> single_;
  std::vector<Moment> both_{single_.size()};
};

// ---- the chain

/// How a function of time rises within a slot.
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
  Rise displacement{};  ///< E[x^2]
  Rise velocity{};      ///< the integral of E[v^2]
  double rest = 0;      ///< chance to be at rest at the end

  void add(double weight, const Slot& other) {
    displacement.add(weight, other.displacement);
    velocity.add(weight, other.velocity);
    rest += weight * other.rest;
  }
};

struct Solution {
  std::vector<Slot> slots{};  ///< from rest on, the last one stationary
  double growth, variance;    ///< of x^2 per unit of time, of v, once stationary
};

class Chain {
 public:
  Chain(const Steps& steps, const Arrivals& arrivals, int slots, bool drifting)
      : steps_(steps), arrivals_(arrivals), slots_(slots), drifting_(drifting) {
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
      spacing = lattice_spacing(sigma, fine ? 3 : 2);
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
      const double most = 2 + 4.5 * std::sqrt(1 + 0.7 * ground);
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

  Solution solve(const std::function<void()>& heartbeat) const;

  /// By the chain's own lattice of amplitudes, that its error goes too.
  Pairs pairs() const {
    const double spacing = batch_.spacing;
    const int reach = static_cast<int>(std::ceil(std::max(6 * arrivals_.sigma, 0.5 + 4 * arrivals_.sigma) / spacing));
    return {steps_, arrivals_.single(spacing, reach), arrivals_.single(spacing / 2, 2 * reach)};
  }

 private:
  std::size_t size() const { return grid_.size(); }
  int span() const { return 2 * batch_.reach + 1; }

  /// From velocity v under a held ground acceleration; where the velocity ends, with `still` of it to come later.
  Passage passage(double v, double n, double still) const {
    detail::Ride ride;
    ride.state.velocity = v;
    Passage passage{};
    for (std::size_t half = 0; half < 2; ++half) {
      detail::hold(unit_block, n, 0.5 / slots_, ride, detail::NoKnot{});
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

  /// Kinds of slots: on the grid of velocities by the ground acceleration alone; on that of what the velocity will be
  /// once all pulses are over, by all the batches.
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

  /// Where a slot leads from each node of the grid of u, for one newest batch and those before it.
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

  /// All that is more unlikely than this is left out: together a thousandth of the chance to slip at most, and in fact
  /// far less.
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
      if (std::abs(n) * batch_.spacing * unit_ > 1) slips += law[static_cast<std::size_t>(n + offset_)];
    least_ = 1e-3 * slips / std::pow(span(), static_cast<double>(values_.size()));
  }

  const Steps& steps_;
  const Arrivals& arrivals_;
  int slots_;
  bool drifting_;                ///< the grid is of u, else of v
  double least_ = 0;             ///< chance of a combination of batches
  std::vector<int> values_{};    ///< of the slots of a pulse
  std::vector<double> still_{};  ///< velocity to come from the rest of a pulse, from slot i on
  double unit_ = 1;
  double tolerance_ = 0;
  std::vector<double> grid_{};
  Weights batch_{};
  int offset_ = 0;
  std::vector<Passage> passages_{};
};

Solution Chain::solve(const std::function<void()>& heartbeat) const {
  constexpr int most_slots = 20'000;
  const auto reach = static_cast<std::ptrdiff_t>(batch_.reach);
  const std::size_t width = static_cast<std::size_t>(span()), nodes = size(), past = values_.size() - 1;
  std::size_t heads = 1;  // of the past batches, all but the oldest
  for (std::size_t i = 1; i < past; ++i) heads *= width;
  const std::size_t tuples = heads * width;

  // The law of the state, and the mean displacement at each state times its chance: even and odd in all signs at once.
  std::vector<double> law(tuples * nodes), mean(tuples * nodes), next_law(tuples * nodes), next_mean(tuples * nodes);
  law[law.size() / 2] = 1;              // at rest, and no pulse before
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

  // Velocity that the past batches have still to give, which the grid of u has in it.
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

  std::vector<Passage> computed;
  Solution solution{};
  double growth = 0, variance = 0;
  int steady = 0;
  for (int slot = 0; steady < 2; ++slot) {
    if (slot == most_slots)
      throw ConvergenceError("PulseChain: not stationary after " + std::to_string(most_slots) + " slots");
    if (heartbeat) heartbeat();
    Slot sums;
    double total = 0;
    Slot& found = solution.slots.emplace_back();
    for (std::size_t tuple = 0; tuple < tuples; ++tuple)
      for (std::size_t i = 0; i < nodes; ++i) {
        const double v = grid_[i] - coming[tuple];
        found.displacement.slope += 2 * v * mean[tuple * nodes + i];
        found.velocity.slope += v * v * law[tuple * nodes + i];
      }
    // Newest batches below 0 are the mirror images of those above.
    for (std::size_t k = static_cast<std::size_t>(reach); k < width; ++k) {
      const double chance = batch_.w[k], twice = k == static_cast<std::size_t>(reach) ? 1 : 2;
      for (std::size_t head = 0; head < heads; ++head) {
        double* const to_law = next_law.data() + (k * heads + head) * nodes;
        double* const to_mean = next_mean.data() + (k * heads + head) * nodes;
        std::fill_n(to_law, nodes, 0);
        std::fill_n(to_mean, nodes, 0);
        Slot part;
        for (std::size_t oldest = 0; oldest < width; ++oldest) {
          const std::size_t tuple = head * width + oldest;
          if (chances[tuple] * std::abs(chance) < least_) continue;
          const double* const from_law = law.data() + tuple * nodes;
          const double* const from_mean = mean.data() + tuple * nodes;
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
            const double a = from_law[i], m = from_mean[i];
            const auto [halfway, x] = p.displacement;
            const double b = m + x * a;
            for (std::size_t j = 0; j < 4; ++j) {
              to_law[p.first + j] += p.share[j] * a;
              to_mean[p.first + j] += p.share[j] * b;
            }
            part.displacement.half += halfway * (halfway * a + 2 * m);
            part.displacement.whole += x * (b + m);
            part.velocity.half += p.square[0] * a;
            part.velocity.whole += p.square[1] * a;
          }
        }
        for (std::size_t i = 0; i < nodes; ++i) {
          to_law[i] *= chance;
          to_mean[i] *= chance;
          total += twice * to_law[i];
        }
        sums.add(twice * chance, part);
      }
    }
    const std::size_t all = tuples * nodes, half = static_cast<std::size_t>(reach) * heads * nodes;
    for (std::size_t i = 0; i < half; ++i) {
      next_law[i] = next_law[all - 1 - i];
      next_mean[i] = -next_mean[all - 1 - i];
    }
    law.swap(next_law);
    mean.swap(next_mean);
    for (double& l : law) l /= total;  // but for what was left out it is 1
    for (double& l : mean) l /= total;
    found.add(1 / total, sums);
    if (!drifting_)
      for (std::size_t tuple = 0; tuple < tuples; ++tuple) found.rest += law[tuple * nodes + nodes / 2];
    const double square = found.displacement.whole, velocity = found.velocity.whole;
    const bool still = std::abs(square - growth) <= tolerance_ * std::abs(square) &&
                       std::abs(velocity - variance) <= tolerance_ * velocity;
    steady = still && slot > static_cast<int>(past) ? steady + 1 : 0;
    growth = square;
    variance = velocity;
  }
  solution.growth = growth * slots_;
  solution.variance = variance * slots_;
  return solution;
}

/// Above this sigma / a the answers are those without friction less a part that falls as a / sigma: growth right to 3 %
/// where pulses are one to a step at most, or friction next to nothing.
constexpr double strongest = 256;
constexpr double weakest = 0.05;
constexpr double most_arrivals = 50;

/// The same lattice without friction, one slot to a step.
Solution frictionless(const Steps& steps, const Arrivals& arrivals, std::size_t slots) {
  const Slider<Coulomb> free(Coulomb(0));
  const double each = arrivals.rate * arrivals.sigma * arrivals.sigma;
  Solution solution{};
  detail::Ride ride;
  Slot sum;
  for (std::size_t i = 0; i < slots; ++i) {
    if (i < steps.values.size()) {
      const double x = ride.state.displacement, v = ride.state.velocity, before = ride.velocity_square;
      Slot slot{{2 * x * v, 0, 0}, {v * v, 0, 0}};
      for (double Rise::*const end : {&Rise::half, &Rise::whole}) {
        detail::hold(free, steps.unit * steps.values[i], 0.5, ride, detail::NoKnot{});
        slot.displacement.*end = ride.state.displacement * ride.state.displacement - x * x;
        slot.velocity.*end = ride.velocity_square - before;
      }
      sum.add(each, slot);
    }
    solution.slots.push_back(sum);
  }
  solution.growth = sum.displacement.whole;
  solution.variance = sum.velocity.whole;
  return solution;
}

/// A sum over slots as a function of time, by polynomials of the fourth degree.
class Curve {
 public:
  /// @param length  of a slot
  /// @param power   of time in the first slot, where all that moves began at rest under a held load
  Curve(double length, const std::vector<Slot>& slots, Rise Slot::*part, std::size_t power) : length_(length) {
    double value = 0, integral = 0;
    for (std::size_t i = 0; i < slots.size(); ++i) {
      const Rise& rise = slots[i].*part;
      const double slope = length * rise.slope;
      const double bend = length * (slots[std::min(i + 1, slots.size() - 1)].*part).slope - slope;
      const double whole = rise.whole - slope, half = rise.half - slope / 2;
      const double fourth = 16 * half - 8 * whole + 2 * bend;
      Piece& piece = pieces_.emplace_back();
      piece.c = {value, slope, 3 * whole - bend + fourth, bend - 2 * whole - 2 * fourth, fourth};
      if (i == 0) {
        piece.c = {};
        piece.c[power] = rise.whole;
      }
      piece.before = integral;
      value += rise.whole;
      integral += length * piece.integral(1);
    }
  }

  double operator()(double t) const {
    const auto [piece, u, more] = at(t);
    return piece.value(u) + more * piece.rise();
  }

  /// From 0 to t.
  double integral(double t) const {
    const auto [piece, u, more] = at(t);
    return piece.before +
           length_ * (piece.integral(u) + more * (piece.integral(1) + (u + (more - 1) / 2) * piece.rise()));
  }

 private:
  struct Piece {
    std::array<double, 5> c{};
    double before = 0;  ///< integral up to its start

    double value(double u) const { return c[0] + u * (c[1] + u * (c[2] + u * (c[3] + u * c[4]))); }
    double integral(double u) const {
      return u * (c[0] + u * (c[1] / 2 + u * (c[2] / 3 + u * (c[3] / 4 + u * c[4] / 5))));
    }
    double rise() const { return c[1] + c[2] + c[3] + c[4]; }
  };
  struct Place {
    const Piece& piece;
    double u, more;  ///< place within it, and how often it was repeated: beyond the last slot all goes on as there
  };

  Place at(double t) const {
    const double place = std::max(t, 0.0) / length_, whole = std::floor(place);
    const double more = std::max(whole - static_cast<double>(pieces_.size() - 1), 0.0);
    return {pieces_[static_cast<std::size_t>(whole - more)], place - whole, more};
  }

  double length_;
  std::vector<Piece> pieces_{};
};

/// What puts pairs right in the growth of E[x^2] and in E[v^2]: factors by time,
///     1 - p (c2(m) - c2) / (c1 + c2(m) p) P0,
/// the coefficients those of pulses that began within it, P0 the chance to be at rest by then.
class Correction {
 public:
  Correction() = default;

  Correction(const std::vector<PairTable>& pairs, double rate, const std::vector<Slot>& chain, int slots) {
    factors_.clear();
    const auto rest = [&](std::size_t end) { return end == 0 ? 1 : chain[std::min(end, chain.size()) - 1].rest; };
    for (std::size_t half = 0; half < pairs.size(); ++half) {
      const std::size_t end = half * static_cast<std::size_t>(slots);
      const bool last = half + 1 == pairs.size();
      const double chance = last ? chain.back().rest : (rest(end / 2) + rest((end + 1) / 2)) / 2;
      const auto factor = [&](const detail::PairCoefficients& c) {
        // At the very start no second pulse has begun, but for those that the lattice has begin at once.
        const double pair = half == 0 ? 0 : c.pair;
        return 1 - rate * (c.lattice - pair) / (c.single + c.lattice * rate) * chance;
      };
      const PairTable& table = pairs[std::max(half, std::size_t{1})];
      factors_.push_back({factor(table.growth), factor(table.velocity)});
    }
  }

  /// When the factors have become constant.
  double settled() const { return 0.5 * static_cast<double>(factors_.size() - 1); }
  const Moment& late() const { return factors_.back(); }

  Moment operator()(double t) const {
    if (t >= settled()) return late();
    const auto k = static_cast<std::size_t>(2 * t);
    const double u = 2 * t - static_cast<double>(k);
    const Moment &from = factors_[k], &to = factors_[k + 1];
    return {from[0] + u * (to[0] - from[0]), from[1] + u * (to[1] - from[1])};
  }

 private:
  std::vector<Moment> factors_{{1, 1}};
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

/// The chance that the acceleration of Gaussian pulses exceeds the slip level, or more.
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
  int slots;     ///< to a step
  Steps steps;
  Arrivals arrivals;
  double chance;  ///< that anything slips, or more; 1 where sigma is not below `weakest`

  /// @throws std::invalid_argument for what the chain does not cover
  Problem(const Slider<Coulomb>& slider, const PoissonPulses& pulses, bool refined);
};

Problem::Problem(const Slider<Coulomb>& slider, const PoissonPulses& pulses, bool refined) {
  const double level = slider.law().forward();
  const PoissonOptions& options = pulses.options();
  detail::require_no_spring(slider.natural_frequency(), "PulseChain");
  detail::require_plain(slider, "PulseChain");
  require(slider.law().backward() == level, "PulseChain: both slip levels must be " + shortest(level) + " m/s^2",
          slider.law().backward(), "m/s^2");
  if (options.envelope) throw std::invalid_argument("PulseChain: an envelope is not covered; PulseSuperposition does");
  double largest = 0;
  for (const double value : options.shape.values()) largest = std::max(largest, std::abs(value));
  step = options.shape.times()[1] * pulses.half_width();
  push = pulses.sigma() * largest;
  sigma = push / level;
  slots = refined && sigma <= 1 ? 2 : 1;  // above, the coarser grid errs by more than one slot to a step
  steps = steps_of(options.shape, slots);
  arrivals = {pulses.rate() * step, std::min(sigma, strongest), options.quantile};
  require(arrivals.rate <= most_arrivals, "PulseChain: pulses to a step of the pulse must be at most 50",
          arrivals.rate);
  if (sigma > strongest)
    require(arrivals.rate <= 1 || sigma >= 1000 * std::exp(3 * arrivals.rate),
            "PulseChain: with " + shortest(arrivals.rate) +
                " pulses to a step of the pulse, sigma must be at most 256 slip levels or so many that nothing is left "
                "of friction, 1000 exp(3 x " +
                shortest(arrivals.rate) + ")",
            sigma);
  chance =
      options.quantile || sigma >= weakest ? 1 : chance_to_slip(arrivals, static_cast<double>(steps.values.size()));
  if (sigma < weakest)
    require(chance < 1e-12,
            "PulseChain: sigma must be at least a twentieth of the slip level where pulses are this many", sigma);
}

void remark(Moments& moments, const std::string& sentence) {
  moments.remark += (moments.remark.empty() ? "" : " ") + sentence;
}

}  // namespace

void PulseChain::check(const Slider<Coulomb>& slider, const PoissonPulses& pulses) const {
  const Problem problem(slider, pulses, refined_);
  if (problem.arrivals.quantile) amplitudes(problem.arrivals.quantile);
}

Moments PulseChain::predict(const Slider<Coulomb>& slider, const PoissonPulses& pulses, std::span<const double> times,
                            const std::function<void()>& heartbeat) const {
  const Problem problem(slider, pulses, refined_);
  const auto& [step, push, sigma, slots, steps, arrivals, chance] = problem;
  const PoissonOptions& options = pulses.options();
  for (const double time : times)
    require(std::isfinite(time) && time >= 0, "PulseChain: times must be finite and at least 0", time, "s");
  const bool drifting = strength_of(arrivals) > 3;
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

  const Chain chain(steps, arrivals, slots, drifting);
  Solution solution = chain.solve(heartbeat);
  Correction correction;
  if (!drifting) correction = {chain.pairs().table(slots, false), arrivals.rate, solution.slots, slots};
  if (sigma > strongest) {
    const Solution free = frictionless(steps, arrivals, solution.slots.size());
    const double part = strongest / sigma;
    for (std::size_t i = 0; i < solution.slots.size(); ++i) {
      Slot faded;
      faded.add(part, solution.slots[i]);
      faded.add(1 - part, free.slots[i]);
      solution.slots[i] = faded;
    }
    solution.growth = part * solution.growth + (1 - part) * free.growth;
    solution.variance = part * solution.variance + (1 - part) * free.variance;
  }
  const double acceleration = push / arrivals.sigma;  // the slip level, unless it is too small
  const double v_unit = std::pow(acceleration * step, 2), x_unit = v_unit * step * step;

  // Of a lattice with a random phase, pulses begin at t = phase, phase + h, ...: means over the slot before t.
  const double h = 1.0 / slots;
  const Curve square(h, solution.slots, &Slot::displacement, 4), velocity(h, solution.slots, &Slot::velocity, 3);
  const auto growth = [&](double t) { return (square(t) - square(t - h)) / h; };
  const auto sum = [&](double t) { return (square.integral(t) - square.integral(t - h)) / h; };  // of growth
  for (std::size_t i = 0; i < count; ++i) {
    const double t = times[i] / step, early = std::min(t, correction.settled());
    double x = correction.late()[0] * (sum(t) - sum(early));
    for (double from = 0; from < early; from += 0.5)
      numerics::gauss_points<points>(from, std::min(from + 0.5, early),
                                     [&](double at, double w) { x += w * correction(at)[0] * growth(at); });
    const auto [of_growth, of_variance] = correction(t);
    moments.displacement_variance.value[i] = x_unit * x;
    moments.covariance.value[i] = x_unit / step * of_growth * growth(t) / 2;
    moments.velocity_variance.value[i] = v_unit * of_variance * (velocity(t) - velocity(t - h)) / h;
  }
  moments.growth_rate = {x_unit / step * correction.late()[0] * solution.growth, 0};

  const std::string ratio = "sigma / slip level = " + shortest(std::round(sigma * 1e4) / 1e4);
  if (!refined_ && sigma < 0.3)
    remark(moments, ratio +
                        " is below 0.3, where more than two pulses at once matter: the growth rate is up to 19 % too "
                        "high at 1/4 and 41 % at 1/5; refined, 7 % and 17 %.");
  else if (!refined_ && sigma < 0.5 && arrivals.rate > 2)
    remark(moments, ratio + " is below 0.5, with more than two pulses to a step: refined is needed.");
  if (refined_ && sigma < 0.2) remark(moments, ratio + ": nothing was tried below 0.2.");
  if (arrivals.rate > 4)
    remark(moments, shortest(arrivals.rate) + " pulses to a step of the pulse: nothing was tried above 4.");
  const double length = options.shape.length() * pulses.half_width();
  if (const auto n = std::ranges::count_if(times, [&](double t) { return t > 0 && t < length; });
      n > 0 && (sigma < 0.5 || arrivals.rate > 2))
    remark(moments,
           std::to_string(n) + " of the times are below " + shortest(length) +
               " s, the length of a pulse: with sigma / slip level below 0.5 or more than two pulses to a step "
               "simulations differ there by up to a factor of 2.4.");
  if (options.stationary_start)
    remark(moments, "From rest as if no pulse had arrived before time zero: a stationary start is not followed.");
  if (options.shape.values().size() != 2 || options.quantile)
    remark(moments, "Errors were measured for the symmetric rectangular pulse and Gaussian amplitudes only.");
  return moments;
}

double PulseChain::final_rms(const Slider<Coulomb>& slider, const PoissonPulses& pulses,
                             const std::function<void()>& heartbeat) const {
  const double end[] = {pulses.duration()};
  return std::sqrt(predict(slider, pulses, end, heartbeat).displacement_variance.value[0]);
}

}  // namespace stickslip::theory

namespace stickslip::detail {

PairTable pair_coefficients(double sigma, int slots) {
  using namespace theory;
  const double spacing = lattice_spacing(sigma, 3);
  const int reach = static_cast<int>(std::ceil(6 * sigma / spacing));
  const Steps steps{{1, -1}, 1};
  return Pairs(steps, gaussian(sigma, spacing, reach, 1), gaussian(sigma, spacing / 2, 2 * reach, 1))
      .table(slots, true)
      .back();
}

}  // namespace stickslip::detail
