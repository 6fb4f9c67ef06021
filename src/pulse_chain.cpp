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

/// What is the same for all slots of a kind: where a slot leads from each node of the grid, spread over four nodes, the
/// way on it and the integral of v^2.
struct Passage {
  std::uint32_t first;
  std::array<double, 4> share;
  double way, square;
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

/// Any law by its quantiles, each spread over the four nodes next to it.
Weights by_quantiles(const std::function<void(std::span<double>)>& quantile, double sigma, double spacing, int reach) {
  Weights law{spacing, reach, std::vector<double>(static_cast<std::size_t>(2 * reach + 1))};
  constexpr std::size_t count = 1 << 14;
  std::vector<double> u(count);
  for (std::size_t i = 0; i < count; ++i) u[i] = (static_cast<double>(i) + 0.5) / count;
  quantile(u);
  for (std::size_t i = 0; i < count; ++i)
    require(std::abs(u[i] + u[count - 1 - i]) <= 1e-9 * (1 + std::abs(u[i])),
            "PulseChain: amplitudes must be symmetric, quantile(u) = -quantile(1 - u)", u[i]);
  for (const double q : u) {
    const double place = std::clamp(sigma * q / spacing, -reach + 1.0, reach - 1.0);
    const int cell = std::clamp(static_cast<int>(std::floor(place)), 1 - reach, reach - 2);
    const double nodes[] = {cell - 1.0, cell + 0.0, cell + 1.0, cell + 2.0};
    const auto share = lagrange(nodes, place);
    for (int i = 0; i < 4; ++i) law[cell - 1 + i] += share[static_cast<std::size_t>(i)] / count;
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
  std::function<void(std::span<double>)> quantile{};

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

/// Both moments of two pulses, the second one `offset` later: X^2 and int v^2.
std::array<double, 2> pair(const Steps& steps, double b1, double b2, double offset) {
  detail::Ride ride;
  const auto count = static_cast<int>(steps.values.size());
  const double whole = std::floor(offset), part = offset - whole;
  const auto value = [&](int i) {
    return i >= 0 && i < count ? steps.unit * steps.values[static_cast<std::size_t>(i)] : 0;
  };
  const int shift = static_cast<int>(whole), last = count + shift + 1;
  for (int i = 0; i < last; ++i) {
    // Within step i of the first pulse the second one goes from its step i - shift - 1 to the next.
    const double n = b1 * value(i);
    if (part > 0) detail::hold(unit_block, n + b2 * value(i - shift - 1), part, ride, detail::NoKnot{});
    detail::hold(unit_block, n + b2 * value(i - shift), 1 - part, ride, detail::NoKnot{});
  }
  detail::coast(unit_block, ride);
  return {ride.state.displacement * ride.state.displacement, ride.velocity_square};
}

/// What pairs do, by lattices of amplitudes: the chain's and one twice as fine, whose every second node is the chain's.
class Pairs {
 public:
  Pairs(const Steps& steps, Weights coarse, Weights fine)
      : steps_(steps), coarse_(std::move(coarse)), fine_(std::move(fine)) {
    for (int i = -fine_.reach; i <= fine_.reach; ++i) add(single_, i, 0, fine_[i], i % 2 == 0 ? coarse_[i / 2] : 0, 0);
  }

  /// At the chain's lattice of amplitudes, `slots` to a step; or, for none of it, by the limit of both.
  PairTable table(int slots, bool limit) const {
    // A pulse that leaves no net velocity leaves at most what friction stops within another length of it.
    const int count = static_cast<int>(steps_.values.size()), most = 2 * count;
    constexpr std::array<double, 4> nodes = {0.069431844202973712, 0.33000947820757187, 0.66999052179242813,
                                             0.93056815579702629};
    constexpr std::array<double, 4> weights = {0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                                               0.17392742256872693};
    Sums integral{}, lattice{};
    for (double from = 0; from < most;) {
      const double length = from < count ? 0.5 : 1;
      for (std::size_t i = 0; i < 4; ++i) add_pairs(integral, from + length * nodes[i], length * weights[i], true);
      from += length;
    }
    for (int k = 0; k < most * slots; ++k)
      add_pairs(lattice, static_cast<double>(k) / slots, (k == 0 ? 0.5 : 1.0) / slots, limit);
    const auto coefficients = [&](std::size_t i) {
      return detail::PairCoefficients{single_.limit(i), integral.limit(i),
                                      limit ? lattice.limit(i) : lattice.coarse[i]};
    };
    return {coefficients(0), coefficients(1)};
  }

 private:
  /// Of X^2 and int v^2.
  struct Sums {
    std::array<double, 2> coarse, fine;
    /// Kinks make both err by O(spacing^2).
    double limit(std::size_t i) const { return (4 * fine[i] - coarse[i]) / 3; }
  };

  void add(Sums& sums, int i, int j, double fine, double coarse, double offset) const {
    const auto both = pair(steps_, i * fine_.spacing, j * fine_.spacing, offset);
    for (std::size_t k = 0; k < 2; ++k) {
      sums.fine[k] += fine * both[k];
      sums.coarse[k] += coarse * both[k];
    }
  }

  /// Adds the mean over both amplitudes less that of two pulses far apart.
  void add_pairs(Sums& sums, double offset, double weight, bool fine) const {
    Sums mean{};
    const int step = fine ? 1 : 2;
    const double least = 1 / fine_.spacing;  // the sum of two amplitudes below which nothing moves
    for (int i = -fine_.reach; i <= fine_.reach; i += step)
      for (int j = 0; j <= fine_.reach; j += step) {  // and the mirror image
        if (std::abs(i) + j <= least) continue;
        const double twice = j == 0 ? 1 : 2;
        const bool even = i % 2 == 0 && j % 2 == 0;
        add(mean, i, j, twice * fine_[i] * fine_[j], even ? twice * coarse_[i / 2] * coarse_[j / 2] : 0, offset);
      }
    for (std::size_t k = 0; k < 2; ++k) {
      sums.fine[k] += weight * (mean.fine[k] - 2 * single_.fine[k]);
      sums.coarse[k] += weight * (mean.coarse[k] - 2 * single_.coarse[k]);
    }
  }

  const Steps& steps_;
  Weights coarse_, fine_;
  Sums single_{};
};

// ---- the chain

struct Solution {
  std::vector<double> square;    ///< E[x^2] after each slot, from 0
  std::vector<double> velocity;  ///< integral of E[v^2] until then
  double growth, variance;       ///< of x^2 per unit of time, of v, once stationary
  double rest;                   ///< chance to be at rest then
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
    detail::hold(unit_block, n, 1.0 / slots_, ride, detail::NoKnot{});
    const double at = std::clamp(ride.state.velocity + still, grid_.front(), grid_.back());
    const auto last = static_cast<std::ptrdiff_t>(size()) - 1, middle = last / 2;
    std::ptrdiff_t cell = std::upper_bound(grid_.begin(), grid_.end(), at) - grid_.begin() - 1;
    std::ptrdiff_t low = 0, high = last - 3;
    if (!drifting_) (at < 0 ? high : low) = at < 0 ? middle - 3 : middle;  // the law of v has a kink and a mass at 0
    const std::ptrdiff_t first = std::clamp(cell - 1, low, high);
    return {static_cast<std::uint32_t>(first), lagrange(grid_.data() + first, at), ride.state.displacement,
            ride.velocity_square};
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
  Solution solution;
  solution.square = {0};
  solution.velocity = {0};
  double growth = 0, variance = 0;
  int steady = 0;
  for (int slot = 0; steady < 2; ++slot) {
    if (slot == most_slots)
      throw ConvergenceError("PulseChain: not stationary after " + std::to_string(most_slots) + " slots");
    if (heartbeat) heartbeat();
    double square = 0, velocity = 0, total = 0;
    // Newest batches below 0 are the mirror images of those above.
    for (std::size_t k = static_cast<std::size_t>(reach); k < width; ++k) {
      const double chance = batch_.w[k], twice = k == static_cast<std::size_t>(reach) ? 1 : 2;
      for (std::size_t head = 0; head < heads; ++head) {
        double* const to_law = next_law.data() + (k * heads + head) * nodes;
        double* const to_mean = next_mean.data() + (k * heads + head) * nodes;
        std::fill_n(to_law, nodes, 0);
        std::fill_n(to_mean, nodes, 0);
        double way_square = 0, way_mean = 0, integral = 0;
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
            const double a = from_law[i], moved = p.way * a, b = from_mean[i] + moved;
            for (std::size_t j = 0; j < 4; ++j) {
              to_law[p.first + j] += p.share[j] * a;
              to_mean[p.first + j] += p.share[j] * b;
            }
            way_square += p.way * moved;
            way_mean += p.way * from_mean[i];
            integral += p.square * a;
          }
        }
        for (std::size_t i = 0; i < nodes; ++i) {
          to_law[i] *= chance;
          to_mean[i] *= chance;
          total += twice * to_law[i];
        }
        square += twice * chance * (way_square + 2 * way_mean);
        velocity += twice * chance * integral;
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
    square /= total;
    velocity /= total;
    solution.square.push_back(solution.square.back() + square);
    solution.velocity.push_back(solution.velocity.back() + velocity);
    const bool still = std::abs(square - growth) <= tolerance_ * std::abs(square) &&
                       std::abs(velocity - variance) <= tolerance_ * velocity;
    steady = still && slot > static_cast<int>(past) ? steady + 1 : 0;
    growth = square;
    variance = velocity;
  }
  solution.growth = growth * slots_;
  solution.variance = variance * slots_;
  solution.rest = 0;
  if (!drifting_)
    for (std::size_t tuple = 0; tuple < tuples; ++tuple) solution.rest += law[tuple * nodes + nodes / 2];
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
  Solution solution{{0}, {0}, 0, 0, 0};
  detail::Ride ride;
  for (std::size_t i = 0; i + 1 < slots; ++i) {
    if (i < steps.values.size()) detail::hold(free, steps.unit * steps.values[i], 1, ride, detail::NoKnot{});
    solution.growth = each * ride.state.displacement * ride.state.displacement;
    solution.variance = each * ride.velocity_square;
    solution.square.push_back(solution.square.back() + solution.growth);
    solution.velocity.push_back(solution.velocity.back() + solution.variance);
  }
  return solution;
}

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

void remark(Moments& moments, const std::string& sentence) {
  moments.remark += (moments.remark.empty() ? "" : " ") + sentence;
}

}  // namespace

Moments PulseChain::predict(const Slider<Coulomb>& slider, const PoissonPulses& pulses, std::span<const double> times,
                            const std::function<void()>& heartbeat) const {
  const double level = slider.law().forward();
  const PoissonOptions& options = pulses.options();
  detail::require_no_spring(slider.natural_frequency(), "PulseChain");
  require(slider.law().backward() == level, "PulseChain: both slip levels must be " + shortest(level) + " m/s^2",
          slider.law().backward(), "m/s^2");
  if (options.envelope) throw std::invalid_argument("PulseChain: an envelope is not covered; PulseSuperposition does");
  for (const double time : times)
    require(std::isfinite(time) && time >= 0, "PulseChain: times must be finite and at least 0", time, "s");
  double largest = 0;
  for (const double value : options.shape.values()) largest = std::max(largest, std::abs(value));
  const double step = options.shape.times()[1] * pulses.half_width(), sigma = pulses.sigma() * largest / level;
  const int slots = refined_ && sigma <= 1 ? 2 : 1;  // above, the coarser grid errs by more than one slot to a step
  const Steps steps = steps_of(options.shape, slots);
  const Arrivals arrivals{pulses.rate() * step, std::min(sigma, strongest), options.quantile};
  require(arrivals.rate <= most_arrivals, "PulseChain: pulses to a step of the pulse must be at most 50",
          arrivals.rate);
  if (sigma > strongest)
    require(arrivals.rate <= 1 || sigma >= 1000 * std::exp(3 * arrivals.rate),
            "PulseChain: with " + shortest(arrivals.rate) +
                " pulses to a step of the pulse, sigma must be at most 256 slip levels or so many that nothing is left "
                "of friction, 1000 exp(3 x " +
                shortest(arrivals.rate) + ")",
            sigma);
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
    const double chance = options.quantile ? 1 : chance_to_slip(arrivals, static_cast<double>(steps.values.size()));
    require(chance < 1e-12,
            "PulseChain: sigma must be at least a twentieth of the slip level where pulses are this many", sigma);
    remark(moments, "Nothing slips: the slip level is " + shortest(1 / sigma) +
                        " times sigma, and the chance that the ground's acceleration exceeds it is " +
                        shortest(chance) + ".");
    return moments;
  }

  const Chain chain(steps, arrivals, slots, drifting);
  Solution solution = chain.solve(heartbeat);
  double growth = solution.growth, variance = solution.variance;
  if (!drifting) {
    // Q = Q_m - p^2 (c2(m) - c2) D P0, D = Q_m / (c1 p + c2(m) p^2)
    const PairTable pairs = chain.pairs().table(slots, false);
    const double p = arrivals.rate;
    const auto correct = [&](double& q, const detail::PairCoefficients& c) {
      q *= 1 - p * (c.lattice - c.pair) / (c.single + c.lattice * p) * solution.rest;
    };
    correct(growth, pairs.growth);
    correct(variance, pairs.velocity);
  }
  if (sigma > strongest) {
    const Solution free = frictionless(steps, arrivals, solution.square.size());
    const auto fade = [&](double& q, double without) { q = without - (without - q) * (strongest / sigma); };
    for (std::size_t i = 0; i < solution.square.size(); ++i) {
      fade(solution.square[i], free.square[i]);
      fade(solution.velocity[i], free.velocity[i]);
    }
    fade(solution.growth, free.growth);
    fade(solution.variance, free.variance);
    growth = solution.growth;
    variance = solution.variance;
  }
  const double acceleration = pulses.sigma() * largest / arrivals.sigma;  // the slip level, unless it is too small
  const double v_unit = std::pow(acceleration * step, 2), x_unit = v_unit * step * step;

  // Of a lattice with a random phase, pulses begin at t = phase, phase + h, ...: means over the slot before t.
  const double h = 1.0 / slots, last = static_cast<double>(solution.square.size() - 1) * h;
  const auto at = [&](const std::vector<double>& sums, double rate, double t) {  // and its integral from 0
    if (t <= 0) return std::pair{0.0, 0.0};
    double integral = 0;
    const auto whole = static_cast<std::size_t>(std::min(t, last) / h);
    for (std::size_t i = 0; i < whole; ++i) integral += (sums[i] + sums[i + 1]) / 2 * h;
    const double left = t - static_cast<double>(whole) * h;
    const double slope = whole + 1 < sums.size() ? (sums[whole + 1] - sums[whole]) / h : rate;
    return std::pair{sums[whole] + slope * left, integral + (sums[whole] + slope * left / 2) * left};
  };
  const double growth_ratio = solution.growth > 0 ? growth / solution.growth : 1;
  const double variance_ratio = solution.variance > 0 ? variance / solution.variance : 1;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = times[i] / step;
    const auto [x, x_sum] = at(solution.square, solution.growth, t);
    const auto [x_before, x_sum_before] = at(solution.square, solution.growth, t - h);
    const double v = at(solution.velocity, solution.variance, t).first;
    const double v_before = at(solution.velocity, solution.variance, t - h).first;
    moments.displacement_variance.value[i] = x_unit * growth_ratio * (x_sum - x_sum_before) / h;
    moments.covariance.value[i] = x_unit / step * growth_ratio * (x - x_before) / (2 * h);
    moments.velocity_variance.value[i] = v_unit * variance_ratio * (v - v_before) / h;
  }
  moments.growth_rate = {x_unit / step * growth, 0};

  const std::string ratio = "sigma / slip level = " + shortest(std::round(sigma * 1e4) / 1e4);
  if (!refined_ && sigma < 0.3)
    remark(moments, ratio + " is below 0.3, where more than two pulses at once matter: refined is needed.");
  else if (!refined_ && sigma < 0.5 && arrivals.rate > 2)
    remark(moments, ratio + " is below 0.5, with more than two pulses to a step: refined is needed.");
  if (refined_ && sigma < 0.2) remark(moments, ratio + ": nothing was tried below 0.2.");
  if (arrivals.rate > 4)
    remark(moments, shortest(arrivals.rate) + " pulses to a step of the pulse: nothing was tried above 4.");
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
      .table(slots, true);
}

}  // namespace stickslip::detail
