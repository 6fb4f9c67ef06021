#include "stickslip/statistics/tally.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "lanes/row_moments.hpp"

namespace stickslip::detail {

void Tally::merge(const Tally& right) {
  if (right.count == 0) return;
  if (count == 0) {
    *this = right;
    return;
  }
  assert(times_ == right.times_ && frequencies_ == right.frequencies_ && ground_times_ == right.ground_times_ &&
         pairs_ == right.pairs_);
  const auto members_left = static_cast<double>(count), members_right = static_cast<double>(right.count),
             members = members_left + members_right;
  for (std::size_t pair = 0; pair < pairs_; ++pair) {
    const std::size_t from = pair * moments * times_;
    merge_moments(members_left, members_right, sums_.data() + from, right.sums_.data() + from, times_);
  }

  const double share = members_right / members, weight = members_left * share;
  const std::span<double> mean_density = density_mean(), scatter_density = density_scatter();
  for (std::size_t i = 0; i < frequencies_; ++i) {
    const double difference = right.density_mean()[i] - mean_density[i];
    mean_density[i] += share * difference;
    scatter_density[i] += right.density_scatter()[i] + weight * difference * difference;
  }
  double difference[features];
  for (std::size_t a = 0; a < features; ++a) difference[a] = right.mean(a) - mean(a);
  for (std::size_t a = 0; a < features; ++a) {
    mean(a) += share * difference[a];
    for (std::size_t b = 0; b < features; ++b)
      scatter(a, b) += right.scatter(a, b) + weight * difference[a] * difference[b];
  }
  for (std::size_t i = 0; i < ground_times_; ++i) {
    const double d = right.moment(n)[i] - moment(n)[i], a = members_left / members, b = share;
    const double left_2 = moment(nn)[i], right_2 = right.moment(nn)[i], left_3 = moment(nnn)[i],
                 right_3 = right.moment(nnn)[i];
    moment(n)[i] += b * d;
    moment(nn)[i] += right_2 + weight * d * d;
    moment(nnn)[i] += right_3 + weight * (a - b) * d * d * d + 3 * d * (a * right_2 - b * left_2);
    moment(nnnn)[i] += right.moment(nnnn)[i] + weight * (a * a - a * b + b * b) * d * d * d * d +
                       6 * d * d * (a * a * right_2 + b * b * left_2) + 4 * d * (a * right_3 - b * left_3);
  }
  count += right.count;
}

namespace {

// The mean square of a union lies between those of its parts: merging keeps it within its bound.
bool is_bounded(double mean, double squares, double members, double largest) {
  return mean * mean + squares / members <= largest * largest;  // false for NaN
}

}  // namespace

std::optional<std::size_t> Tally::out_of_range() const {
  const auto members = static_cast<double>(count);
  for (std::size_t i = 0; i < times_; ++i)
    for (std::size_t p = 0; p < pairs_; ++p) {
      const auto pair = static_cast<Pair>(p);
      if (!is_bounded(moment(x, pair)[i], moment(xx, pair)[i], members, max_motion) ||
          !is_bounded(moment(v, pair)[i], moment(vv, pair)[i], members, max_motion))
        return i;
    }
  for (std::size_t i = 0; i < ground_times_; ++i)
    if (!is_bounded(moment(Tally::n)[i], moment(nn)[i], members, max_motion)) return i;
  for (std::size_t k = 0; k < frequencies_; ++k)
    if (!is_bounded(density_mean()[k], density_scatter()[k], members, max_feature)) return times_;
  for (std::size_t a = 0; a < features; ++a)
    if (!is_bounded(mean(a), scatter(a, a), members, max_feature)) return times_;
  return std::nullopt;
}

bool Tally::is_possible() const {
  const auto members = static_cast<double>(count);
  constexpr double slack = 2;  // for round-off on the bounds of `out_of_range`
  const auto is_at_most = [](std::span<const double> values, double largest) {
    return std::ranges::all_of(values, [largest](double value) { return std::abs(value) <= largest; });
  };
  const auto is_positive = [](std::span<const double> values) {
    // Merged fourth powers can round to less than 0 where they underflow.
    return std::ranges::all_of(values, [](double value) { return value >= -std::numeric_limits<double>::min(); });
  };
  for (std::size_t one = 0; one < pairs_ * moments; ++one) {
    const std::size_t m = one % moments;
    const std::span<const double> values = moment(static_cast<Moment>(m), static_cast<Pair>(one / moments));
    const double largest = m <= v    ? slack * max_motion
                           : m <= vv ? slack * slack * max_motion * max_motion * members
                                     : max_feature * members;
    if (!is_at_most(values, largest)) return false;
    if ((m == xx || m == vv || m >= xxxx) && !is_positive(values)) return false;
  }
  if (ground_times_ > 0 && !(is_at_most(moment(Tally::n), slack * max_motion) &&
                             is_at_most(moment(nn), slack * slack * max_motion * max_motion * members) &&
                             is_positive(moment(nn)) && is_at_most(moment(nnn), max_feature * members) &&
                             is_at_most(moment(nnnn), max_feature * members) && is_positive(moment(nnnn))))
    return false;
  const double largest_scatter = slack * slack * max_feature * max_feature * members;
  if (!is_at_most(density_mean(), slack * max_feature) || !is_positive(density_mean()) ||
      !is_at_most(density_scatter(), largest_scatter) || !is_positive(density_scatter()))
    return false;
  for (std::size_t a = 0; a < features; ++a)
    if (!(scatter(a, a) >= 0)) return false;
  return is_at_most({tail(), features}, slack * max_feature) &&
         is_at_most({tail() + features, features * features}, largest_scatter);
}

void TallyTree::insert(Place place, Tally tally) {
  for (;;) {
    const auto sibling = nodes_.find({place.level, place.number ^ 1});
    if (sibling == nodes_.end()) break;
    if (place.number % 2 == 0) {
      tally.merge(sibling->second);
    } else {
      std::swap(tally, sibling->second);
      tally.merge(sibling->second);
    }
    nodes_.erase(sibling);
    place = {place.level + 1, place.number / 2};
  }
  nodes_.emplace(place, std::move(tally));
}

bool TallyTree::overlaps(Place place) const {
  return std::any_of(nodes_.begin(), nodes_.end(), [place](const auto& node) {
    const Place& other = node.first;
    return place.level >= other.level ? place.number == other.number >> (place.level - other.level)
                                      : other.number == place.number >> (other.level - place.level);
  });
}

std::uint64_t TallyTree::count() const {
  std::uint64_t total = 0;
  for (const auto& [place, tally] : nodes_) total += tally.count;
  return total;
}

Tally TallyTree::total() const {
  std::map<std::uint64_t, const Tally*> in_order;
  for (const auto& [place, tally] : nodes_) in_order.emplace(place.number << place.level, &tally);
  Tally sum;
  for (const auto& [first, tally] : in_order) sum.merge(*tally);
  return sum;
}

namespace {

constexpr std::int32_t zeros = std::numeric_limits<std::int32_t>::min();
const double bin_width = std::log((1 + Sketch::accuracy) / (1 - Sketch::accuracy));

std::int32_t bin_of(double value) {
  return value == 0 ? zeros : static_cast<std::int32_t>(std::ceil(std::log(value) / bin_width));
}

// The middle of a bin: its ratio to the lower end equals that of the upper end to it.
double value_of(std::int32_t bin) { return bin == zeros ? 0 : std::exp(bin * bin_width) * (1 - Sketch::accuracy); }

}  // namespace

void Sketch::add(double value) {
  ++bins_[bin_of(value)];
  ++count_;
}

void Sketch::merge(const Sketch& other) {
  for (const auto& [bin, count] : other.bins_) bins_[bin] += count;
  count_ += other.count_;
}

double Sketch::value_at(std::uint64_t rank) const {
  assert(rank < count_);
  std::uint64_t passed = 0;
  for (const auto& [bin, count] : bins_)
    if ((passed += count) > rank) return value_of(bin);
  return std::numeric_limits<double>::quiet_NaN();
}

std::uint64_t Sketch::above(double level) const {
  std::uint64_t total = 0;
  for (auto bin = bins_.upper_bound(bin_of(level)); bin != bins_.end(); ++bin) total += bin->second;
  return total;
}

Sketch Sketch::from_bins(std::map<std::int32_t, std::uint64_t> bins) {
  Sketch sketch;
  const std::int32_t lowest = bin_of(std::numeric_limits<double>::denorm_min()),
                     highest = bin_of(std::numeric_limits<double>::max());
  for (const auto& [bin, count] : bins) {
    if (bin != zeros && (bin < lowest || bin > highest))
      throw std::invalid_argument("Sketch: a bin must be " + std::to_string(lowest) + " to " + std::to_string(highest) +
                                  ", got " + std::to_string(bin));
    if (count == 0 || count > UINT64_MAX - sketch.count_)
      throw std::invalid_argument("Sketch: counts must be positive and add up to less than 2^64, got " +
                                  std::to_string(count));
    sketch.count_ += count;
  }
  sketch.bins_ = std::move(bins);
  return sketch;
}

}  // namespace stickslip::detail
