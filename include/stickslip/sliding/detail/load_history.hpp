// The load on a slider and the normal force under it, at any time of a motion and after it.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/ground/harmonic_motion.hpp"
#include "stickslip/ground/segment.hpp"
#include "stickslip/sliding/detail/run.hpp"
#include "stickslip/units.hpp"

namespace stickslip::detail {

/// The load p and the normal force N, per unit mass [m/s^2].
struct Load {
  double load, normal;
};

/// Load and normal force of a slider on a slope [rad]. After the motion the ground acceleration is zero.
class GroundLoad {
 public:
  GroundLoad(const GroundMotion& motion, double slope) noexcept
      : pieces_(motion, slope), segments_(motion.segments()), still_(load_segment(Segment{1, 0, 0}, slope)) {}

  /// Call `node(load)` at the times between which both are monotonic, and N has one sign: just after `from`, at both
  /// ends of each segment, where N crosses zero, and just before `to`, until it returns false.
  /// @param from  [s], not before the motion
  /// @param to    [s], after `from`; may be infinite
  template <class Node>
  void nodes(double from, double to, Node&& node) const {
    double time = from;
    for (std::size_t i = segment_at(from); i < segments_; ++i) {
      const double begin = pieces_.time(i), end = pieces_.time(i + 1);
      if (!(time < end)) continue;
      const LoadSegment s = pieces_.segment(i);
      const Load first{s.load(time - begin), s.normal(time - begin)};
      const Load last = to < end ? Load{s.load(to - begin), s.normal(to - begin)} : Load{s.load_end, s.normal_end};
      if (!node(first)) return;
      if (first.normal * last.normal < 0) {
        const double part = first.normal / (first.normal - last.normal);
        if (!node(Load{first.load + part * (last.load - first.load), 0})) return;
      }
      if (!node(last) || to < end) return;
      if (!(end < to)) return;
      time = end;
    }
    node(Load{still_.load_start, still_.normal_start});
  }

  /// Load and normal force just after a time.
  Load after(double time) const {
    Load result{};
    nodes(time, std::numeric_limits<double>::infinity(), [&](const Load& load) {
      result = load;
      return false;
    });
    return result;
  }

 private:
  /// The last segment that begins at or before a time.
  std::size_t segment_at(double time) const {
    std::size_t first = 0, last = segments_;
    while (last - first > 1) {
      const std::size_t middle = first + (last - first) / 2;
      (pieces_.time(middle) <= time ? first : last) = middle;
    }
    return first;
  }

  LoadPieces pieces_;
  std::size_t segments_;
  LoadSegment still_;
};

/// The same for a harmonic motion, on level ground.
class HarmonicLoad {
 public:
  HarmonicLoad(const HarmonicMotion& motion, double /*slope*/) noexcept : motion_(motion) {}

  template <class Node>
  void nodes(double from, double to, Node&& node) const {
    const double half = motion_.period() / 2, last = std::min(to, motion_.duration());
    const auto at = [&](double time) { return Load{-motion_.acceleration(time), standard_gravity}; };
    if (from < last) {
      if (!node(at(from))) return;
      const double first_crest = std::floor(from / half) + 1, crests = std::ceil(last / half);
      int shown = 0;
      for (double k = first_crest; k < crests; ++k) {
        if (!node(Load{equal(std::fmod(k, 2), 0) ? motion_.amplitude() : -motion_.amplitude(), standard_gravity}))
          return;
        if (++shown == 4) k = std::max(k, crests - 4);  // all crests are equal
      }
      if (!node(at(last)) || !(last < to)) return;
    }
    node(Load{0, standard_gravity});
  }

  Load after(double time) const {
    return {time < motion_.duration() ? -motion_.acceleration(time) : 0, standard_gravity};
  }

 private:
  const HarmonicMotion& motion_;
};

inline GroundLoad load_history(const GroundMotion& motion, double slope) { return {motion, slope}; }
inline HarmonicLoad load_history(const HarmonicMotion& motion, double slope) { return {motion, slope}; }

}  // namespace stickslip::detail
