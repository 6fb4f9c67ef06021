#include "theory/slip_walk.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <ranges>
#include <vector>

#include "stickslip/numerics/root.hpp"

namespace stickslip::detail {
namespace {

constexpr int half = 150;           ///< nodes of the grid either side of 0
constexpr double max_steps = 1000;  ///< of the walk; with more slips, several are combined in a step

using Farthest = std::function<SlipExcursion::Parts(double)>;

/// The walk between -L and L.
class Walk {
 public:
  Walk(const Slips& slips, const Farthest& farthest, double together, double bound)
      : step_(bound / (half + 0.5)), rate_(slips.count / together) {
    const auto lay = [&](double length,
                         double count) {  // on three nodes, so that its mean and its square are preserved
      const double place = length / step_, node = std::round(place), u = place - node;
      if (std::abs(node) >= reach) return;  // it leaves the bound from anywhere
      const int i = static_cast<int>(node);
      at(i - 1) += count * (u * u - u) / 2;
      at(i) += count * (1 - u * u);
      at(i + 1) += count * (u * u + u) / 2;
    };
    for (const SlipPiece& piece : slips.pieces) lay((piece.from + piece.to) / 2, piece.count / slips.count);
    for (double doubled = 1; doubled < together; doubled *= 2) {
      std::vector<double> both(law_.size());
      for (int i = -reach; i <= reach; ++i)
        for (int j = std::max(-reach, -reach - i); j <= std::min(reach, reach - i); ++j)
          both[static_cast<std::size_t>(i + j + reach)] += at(i) * at(j);
      law_ = both;
    }
    for (int i = -reach; i <= reach; ++i) {
      out_.push_back(farthest(i * step_));
      if (together > 1) out_.back().fill(std::abs(i * step_));
    }
  }

  /// The probability of having stayed within the bound.
  double within(double bound) {
    std::vector<double> here(2 * half + 1), next(here.size());
    here[half] = 1;
    double total = 0, log_chance = -rate_;
    for (int n = 0;; ++n) {
      double stays = 0;
      for (const double p : here) stays += p;
      total += std::exp(log_chance) * stays;
      if (n > rate_ && (log_chance < -40 || stays < 1e-12)) break;
      log_chance += std::log(rate_ / (n + 1));
      std::ranges::fill(next, 0);
      for (int m = -2 * half; m <= 2 * half; ++m) {
        if (at(m) == 0) continue;
        // From x to x + m, by way of x + out for each part of the probability: where x leaves room for it.
        double chance = at(m);
        int from = -half;  // counted in the direction of the slip
        for (const double out : out_[static_cast<std::size_t>(m + reach)] | std::views::reverse) {
          const double room = (bound - out) / step_;
          const int last = room < -half ? -half - 1 : std::min(half - std::abs(m), static_cast<int>(std::floor(room)));
          if (m >= 0)
            for (int x = from; x <= last; ++x)
              next[static_cast<std::size_t>(x + m + half)] += chance * here[static_cast<std::size_t>(x + half)];
          else
            for (int x = -last; x <= -from; ++x)
              next[static_cast<std::size_t>(x + m + half)] += chance * here[static_cast<std::size_t>(x + half)];
          chance -= at(m) / static_cast<double>(SlipExcursion::parts);
          from = std::max(from, last + 1);
        }
      }
      here.swap(next);
    }
    return total;
  }

 private:
  static constexpr int reach = 2 * half + 2;

  double& at(int i) { return law_[static_cast<std::size_t>(i + reach)]; }

  double step_, rate_;
  std::vector<double> law_ = std::vector<double>(2 * reach + 1);  ///< of a slip
  std::vector<SlipExcursion::Parts> out_{};                       ///< distances on the way of a slip
};

}  // namespace

double slip_walk_peak(const Slips& slips, const Farthest& farthest, double probability) {
  if (!(slips.count > 0 && slips.moments[1] > 0) || std::exp(-slips.count) >= probability) return 0;
  double together = 1;
  while (slips.count / together > max_steps) together *= 2;
  // Between its steps a walk of many goes farther by as much again as a step has: D. Siegmund's 0.583.
  const double between = together > 1 ? 0.5826 * std::sqrt(slips.moments[1] * together / slips.count) : 0;
  const auto enough = [&](double bound) {
    return bound > 0 && Walk(slips, farthest, together, bound).within(bound) >= probability;
  };
  double high = std::sqrt(slips.moments[1]);
  while (!enough(high)) high *= 1.5;
  double low = 0;
  while (high - low > 1e-4 * high) {
    const double middle = low == 0 ? high / 2 : (low + high) / 2;
    (enough(middle) ? high : low) = middle;
    if (low == 0 && high < 1e-12 * std::sqrt(slips.moments[1])) return 0;
  }
  return high + between;
}

}  // namespace stickslip::detail
