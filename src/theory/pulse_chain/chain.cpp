#include "theory/pulse_chain/chain.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "stickslip/base/error.hpp"
#include "stickslip/theory/pulse_response.hpp"

namespace stickslip::detail::pulse_chain {

namespace {

/// Moments to cumulants.
std::array<double, orders> cumulants(const std::array<double, orders>& m) {
  const auto [m1, m2, m3, m4] = m;
  return {m1, m2 - m1 * m1, m3 - m1 * (3 * m2 - 2 * m1 * m1),
          m4 - 4 * m1 * m3 - 3 * m2 * m2 + m1 * m1 * (12 * m2 - 6 * m1 * m1)};
}

}  // namespace

Chain::Chain(const Slider<Coulomb>& block, const Steps& steps, const Arrivals& arrivals, int slots, bool drifting)
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

Pairs Chain::pairs() const {
  const double spacing = batch_.spacing;
  const int reach = static_cast<int>(std::ceil(std::max(6 * arrivals_.sigma, 0.5 + 4 * arrivals_.sigma) / spacing));
  return {block_, steps_, mirrored_, arrivals_.single(spacing, reach), arrivals_.single(spacing / 2, 2 * reach)};
}

std::vector<detail::SlipExcursion::Example> Chain::excursions() const {
  constexpr int finer = 8;
  const double spacing = batch_.spacing / finer;
  const int reach = static_cast<int>(std::ceil(6 * arrivals_.sigma / spacing));
  return pairs().examples(arrivals_.rate, arrivals_.single(spacing, reach));
}

Passage Chain::passage(double v, double n, double still) const {
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

void Chain::tabulate() {
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

void Chain::compute(std::size_t newest, std::size_t tuple, std::vector<Passage>& passages) const {
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

void Chain::prune() {
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

template std::vector<Slot> Chain::solve<2>(const std::function<void()>&) const;
template std::vector<Slot> Chain::solve<4>(const std::function<void()>&) const;

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

}  // namespace stickslip::detail::pulse_chain
