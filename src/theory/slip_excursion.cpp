#include "theory/slip_excursion.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace stickslip::detail {
namespace {

using Example = SlipExcursion::Example;

double excess(const Example& e) { return e.largest - std::abs(e.slip); }

/// Means of the excess over intervals of equal probability, of examples in ascending order of it.
SlipExcursion::Parts parts_of(const std::vector<Example>& examples, double weight) {
  SlipExcursion::Parts parts{};
  const double part = weight / SlipExcursion::parts;
  double passed = 0;
  for (const Example& e : examples)
    for (double left = e.weight; left > 0;) {
      const auto i = std::min(static_cast<std::size_t>(passed / part), SlipExcursion::parts - 1);
      const double room = static_cast<double>(i + 1) * part - passed;
      const double taken = i + 1 == SlipExcursion::parts || room <= 0 ? left : std::min(left, room);
      parts[i] += excess(e) * taken / part;
      passed = taken < left ? std::max(static_cast<double>(i + 1) * part, passed + taken) : passed + taken;
      left -= taken;
    }
  return parts;
}

}  // namespace

SlipExcursion::SlipExcursion(std::vector<Example> examples) {
  std::erase_if(examples, [](const Example& e) { return !(e.largest > 0 && e.weight > 0); });
  std::ranges::sort(examples, {}, excess);
  forward_ = curve(examples, 1);
  backward_ = curve(examples, -1);
}

SlipExcursion::Curve SlipExcursion::curve(const std::vector<Example>& examples, double direction) {
  double square = 0, weight = 0, longest = 0;
  for (const Example& e : examples) {
    square += e.weight * e.slip * e.slip;
    weight += e.weight;
    longest = std::max(longest, std::abs(e.slip));
  }
  if (!(square > 0)) return {};
  // Classes of lengths that grow by a constant factor; slips much shorter than the rest are one class, either way.
  constexpr double growth = 1.3;
  const double shortest = 0.01 * std::sqrt(square / weight);
  const auto place = [&](double length) {
    return length <= shortest ? 0 : 1 + static_cast<std::size_t>(std::log(length / shortest) / std::log(growth));
  };
  std::vector<std::vector<Example>> classes(1 + place(longest));
  for (const Example& e : examples)
    if (const std::size_t i = place(std::abs(e.slip)); i == 0 || direction * e.slip > 0) classes[i].push_back(e);
  Curve curve;
  for (const std::vector<Example>& members : classes) {
    double all = 0, length = 0;
    for (const Example& e : members) {
      all += e.weight;
      length += e.weight * std::abs(e.slip);
    }
    if (all > 0) curve.emplace_back(length / all, parts_of(members, all));
  }
  return curve;
}

SlipExcursion::Parts SlipExcursion::operator()(double slip) const {
  const Curve& curve = slip < 0 ? backward_ : forward_;
  const double length = std::abs(slip);
  Parts result{};
  if (!curve.empty()) {
    const auto next = std::ranges::lower_bound(curve, length, {}, [](const auto& point) { return point.first; });
    const auto& [to, after] = next == curve.end() ? curve.back() : *next;
    const auto& [from, before] = next == curve.begin() ? *next : *(next - 1);
    const double u = to > from && next != curve.end() ? (length - from) / (to - from) : 1;
    for (std::size_t i = 0; i < parts; ++i) result[i] = before[i] + u * (after[i] - before[i]);
  }
  for (double& distance : result) distance += length;
  return result;
}

}  // namespace stickslip::detail
