#include "excitation/join.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"

namespace stickslip::detail {
namespace {

bool same_times(const GroundMotion& a, const GroundMotion& b) {
  if (a.samples() != b.samples()) return false;
  if (equal(a.dt(), b.dt())) return true;
  for (std::size_t i = 0; i < a.samples(); ++i)
    if (!equal(a.time(i), b.time(i))) return false;
  return true;
}

/// Times from the first sample on that differ by less than this are merged [s].
double rounding(const GroundMotion& motion) {
  const double latest = std::max(std::abs(motion.time(0)), std::abs(motion.time(motion.segments())));
  return 4 * std::numeric_limits<double>::epsilon() * latest;
}

double since_start(const GroundMotion& motion, std::size_t i) { return motion.time(i) - motion.time(0); }

/// The values of a component at increasing times from the first sample on; where it jumps, those after the jump.
std::vector<double> values_at(std::span<const double> times, const GroundMotion& motion,
                              std::span<const double> component) {
  std::vector<double> values;
  if (component.empty()) return values;
  values.reserve(times.size());
  const double same = rounding(motion);
  std::size_t i = 0;
  for (const double time : times) {
    while (i < motion.segments() && since_start(motion, i + 1) <= time + same) ++i;
    if (i == motion.segments() || motion.interpolation() == Interpolation::constant) {
      values.push_back(component[i]);
      continue;
    }
    const double begin = since_start(motion, i), end = since_start(motion, i + 1);
    values.push_back(component[i] + (component[i + 1] - component[i]) * ((time - begin) / (end - begin)));
  }
  return values;
}

/// The times of both motions from the first sample on, without duplicates.
std::vector<double> times_of_both(const GroundMotion& motion, const GroundMotion& other) {
  std::vector<double> times;
  times.reserve(motion.samples() + other.samples());
  for (const GroundMotion* one : {&motion, &other})
    for (std::size_t i = 0; i < one->samples(); ++i) times.push_back(since_start(*one, i));
  std::ranges::sort(times);
  const double end = motion.duration(), same = std::min(rounding(motion), rounding(other));
  std::size_t kept = 0;
  for (const double time : times)
    if (kept == 0 || (time - times[kept - 1] > same && end - time > same)) times[kept++] = time;
  times.resize(kept);
  times.push_back(end);
  return times;
}

}  // namespace

Joined join(GroundMotion motion, const GroundMotion& other, const std::string& who, const std::string& which) {
  if (other.has_transverse() || other.has_vertical())
    throw std::invalid_argument(who + ": the " + which + " excitation must make motions of one component, got several");
  if (motion.interpolation() != other.interpolation())
    throw std::invalid_argument(
        who + ": both components must be lines between samples or both held values; one is of each kind");
  if (!(std::abs(other.duration() - motion.duration()) <= 1e-9 * motion.duration()))
    refuse(who + ": the " + which + " component must last as long as the horizontal one, " +
               shortest(motion.duration()) + " s",
           other.duration(), "s");
  const auto given = other.acceleration();
  if (same_times(motion, other)) return {std::move(motion), {given.begin(), given.end()}};
  std::vector<double> times = times_of_both(motion, other);
  std::vector<double> values = values_at(times, other, given), along = values_at(times, motion, motion.acceleration()),
                      across = values_at(times, motion, motion.transverse()),
                      up = values_at(times, motion, motion.vertical());
  for (double& time : times) time += motion.time(0);
  return {GroundMotion(std::move(along), std::move(times), motion.interpolation(), motion.name())
              .with_orientation(motion.orientation())
              .with_components(std::move(across), std::move(up)),
          std::move(values)};
}

}  // namespace stickslip::detail
