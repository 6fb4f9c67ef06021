#include "ground/records/times.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>

#include "ground/records/text.hpp"

namespace stickslip::records {
namespace {

/// The smallest step for which even times can lie within their bounds.
///
/// It is the steepest line from an upper bound to a later lower bound. A line that is not steep enough is replaced by
/// the one that exceeds it most, until none does.
double smallest_step(const std::vector<double>& lower, const std::vector<double>& upper) {
  const std::size_t last = lower.size() - 1;
  for (double step = (lower[last] - upper[0]) / static_cast<double>(last);;) {
    double steeper = step, most = 0, lowest = upper[0];
    for (std::size_t i = 1, from = 0; i <= last; ++i) {
      const double line = static_cast<double>(i) * step;
      if (const double excess = lower[i] - line - lowest; excess > most) {
        most = excess;
        steeper = (lower[i] - upper[from]) / static_cast<double>(i - from);
      }
      if (const double top = upper[i] - line; top < lowest) {
        lowest = top;
        from = i;
      }
    }
    if (!(steeper > step)) return step;
    step = steeper;
  }
}

/// The step of times that are even within their printed precision: the shortest decimal that fits them all.
std::optional<double> even_step(const std::vector<double>& times, const std::vector<double>& units) {
  const std::size_t count = times.size();
  const double length = times.back() - times.front(), mean = length / static_cast<double>(count - 1);
  const double coarsest = *std::ranges::max_element(units);
  const double farthest = std::max(std::abs(times.front()), std::abs(times.back()));
  const double sums =
      2 * static_cast<double>(count) * std::numeric_limits<double>::epsilon() * farthest;  // if accumulated
  if (!std::isfinite(length)) return std::nullopt;
  // Rounding explains uneven steps only where it is too small to hide a missing sample, and only in records that are
  // long against it. The margin exceeds the rounding of a print by a tenth, for times computed in single precision.
  for (const double rounding : {0., 0.55}) {
    if (rounding > 0 && (mean < 2 * coarsest || length < 100 * coarsest)) break;
    std::vector<double> lower(count), upper(count), minus_lower(count), minus_upper(count);
    for (std::size_t i = 0; i < count; ++i) {
      const double margin = rounding * units[i] + sums;
      minus_lower[i] = -(lower[i] = times[i] - times[0] - margin);
      minus_upper[i] = -(upper[i] = times[i] - times[0] + margin);
    }
    const double smallest = smallest_step(lower, upper), largest = -smallest_step(minus_upper, minus_lower);
    if (!(smallest <= largest)) continue;
    const double middle = smallest / 2 + largest / 2;
    for (double power = 1; std::abs(middle) * power < 1e15; power *= 10)
      if (const double dt = std::round(middle * power) / power; smallest <= dt && dt <= largest)
        return dt + 0.;  // no -0
    return middle;
  }
  return std::nullopt;
}

}  // namespace

void Resolution::add(std::string_view token) {
  const Numeral numeral(token);
  const std::string_view mantissa = token.substr(0, numeral.mantissa);
  std::string_view power = token.substr(numeral.exponent);
  if (power.starts_with('+')) power.remove_prefix(1);
  int exponent = 0;
  std::from_chars(power.data(), power.data() + power.size(), exponent);

  const auto position = [](std::size_t at) { return static_cast<int>(at); };
  const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
  const int places = position(mantissa.size() - std::min(point + 1, mantissa.size()));
  max_places_ = std::max(max_places_, places - exponent);
  const std::size_t first = mantissa.find_first_of("123456789");
  if (first == std::string_view::npos) return decades_.push_back(std::numeric_limits<int>::min() / 2);
  const int before = position(point) - position(first);  // digits before the point; negative: zeros after it
  decades_.push_back((before > 0 ? before - 1 : before) + exponent);
  max_digits_ = std::max(max_digits_, (before > 0 ? before : before + 1) + places);
}

std::vector<double> Resolution::units() const {
  std::vector<double> units;
  units.reserve(decades_.size());
  for (int previous = 0; const int decade : decades_) {
    const int exponent = std::max(-max_places_, decade + 1 - max_digits_);
    units.push_back(!units.empty() && exponent == previous ? units.back() : std::pow(10., exponent));
    previous = exponent;
  }
  return units;
}

void set_times(Channel& channel, const std::vector<double>& times, const std::vector<double>& units) {
  channel.dt = even_step(times, units);
  if (!channel.dt) channel.times = times;
}

}  // namespace stickslip::records
