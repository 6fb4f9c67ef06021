#include "stickslip/excitation/with_vertical.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "stickslip/base/equal.hpp"
#include "stickslip/excitation/random.hpp"

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

/// The acceleration at increasing times from the first sample on; where it jumps, that after the jump.
class Reading {
 public:
  explicit Reading(const GroundMotion& motion) : motion_(motion), rounding_(rounding(motion)) {}

  double at(double time) {
    const auto n = motion_.acceleration();
    while (sample_ < motion_.segments() && since_start(sample_ + 1) <= time + rounding_) ++sample_;
    if (sample_ == motion_.segments() || motion_.interpolation() == Interpolation::constant) return n[sample_];
    const double begin = since_start(sample_), end = since_start(sample_ + 1);
    return n[sample_] + (n[sample_ + 1] - n[sample_]) * ((time - begin) / (end - begin));
  }

 private:
  double since_start(std::size_t i) const { return motion_.time(i) - motion_.time(0); }

  const GroundMotion& motion_;
  double rounding_;
  std::size_t sample_ = 0;
};

/// The times of both components from the first sample on, without duplicates.
std::vector<double> times_of_both(const GroundMotion& horizontal, const GroundMotion& vertical) {
  std::vector<double> times;
  times.reserve(horizontal.samples() + vertical.samples());
  for (const GroundMotion* motion : {&horizontal, &vertical})
    for (std::size_t i = 0; i < motion->samples(); ++i) times.push_back(motion->time(i) - motion->time(0));
  std::ranges::sort(times);
  const double end = horizontal.duration(), same = std::min(rounding(horizontal), rounding(vertical));
  std::size_t kept = 0;
  for (const double time : times)
    if (kept == 0 || (time - times[kept - 1] > same && end - time > same)) times[kept++] = time;
  times.resize(kept);
  times.push_back(end);
  return times;
}

}  // namespace

std::uint64_t vertical_seed(std::uint64_t seed) {
  constexpr std::uint32_t purpose = 0x76657274;  // "vert"
  std::array<std::uint32_t, 2> words{};
  random_words({seed, 0, purpose}, 0, words);
  return words[0] | (std::uint64_t{words[1]} << 32);
}

GroundMotion with_vertical(GroundMotion horizontal, const GroundMotion& vertical, double ratio) {
  if (horizontal.has_vertical())
    throw std::invalid_argument(
        "WithVertical: the horizontal excitation must make motions without a vertical component, got one that has it");
  if (vertical.has_transverse() || vertical.has_vertical())
    throw std::invalid_argument(
        "WithVertical: the vertical excitation must make motions of one component, got several");
  if (horizontal.interpolation() != vertical.interpolation())
    throw std::invalid_argument(
        "WithVertical: both components must be lines between samples or both held values; one is of each kind");
  if (!(std::abs(vertical.duration() - horizontal.duration()) <= 1e-9 * horizontal.duration()))
    refuse("WithVertical: the vertical component must last as long as the horizontal one, " +
               shortest(horizontal.duration()) + " s",
           vertical.duration(), "s");
  std::vector<double> up(vertical.acceleration().begin(), vertical.acceleration().end());
  if (!same_times(horizontal, vertical)) {
    const std::vector<double> times = times_of_both(horizontal, vertical);
    std::vector<double> along, across, shifted;
    up.clear();
    const GroundMotion transverse =
        horizontal.has_transverse() ? horizontal.component(Component::transverse) : horizontal;
    Reading n(horizontal), a_y(transverse), a_z(vertical);
    for (const double time : times) {
      along.push_back(n.at(time));
      if (horizontal.has_transverse()) across.push_back(a_y.at(time));
      up.push_back(a_z.at(time));
      shifted.push_back(horizontal.time(0) + time);
    }
    horizontal = GroundMotion(std::move(along), std::move(shifted), horizontal.interpolation(), horizontal.name())
                     .with_orientation(horizontal.orientation())
                     .with_components(std::move(across));
  }
  for (double& a : up) a *= ratio;
  return horizontal.with_components({horizontal.transverse().begin(), horizontal.transverse().end()}, std::move(up));
}

}  // namespace stickslip::detail
