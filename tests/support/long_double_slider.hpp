// A second opinion on Coulomb friction: long double, and from the physics alone. Slow and plain.
//
// While it slides in direction s, x'' = p0 + r t - s level - wn^2 x under the load p = -n. The speed is monotone
// between the zeros of x'', which are written down; a stop is a change of sign across such a piece, and is bisected. At
// rest, the load is monotone, and breaking away is bisected as well.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace test {

class LongDoubleSlider {
 public:
  using Real = long double;

  LongDoubleSlider(Real forward, Real backward, Real natural_frequency)
      : forward_(forward), backward_(backward), w_(natural_frequency) {}

  Real displacement = 0, velocity = 0, peak = 0, dissipated = 0;
  int direction = 0;  // 0 at rest
  int breakaways = 0, arrests = 0, reversals = 0;

  /// The ground acceleration runs straight from `start` to `end`.
  void advance(Real duration, Real start, Real end) {
    const Real rate = (start - end) / duration;
    const auto load = [&](Real t) { return rate * t - start; };
    Real now = 0;
    bool just_stopped = false;
    int came_from = 0;
    while (now < duration) {
      if (direction == 0) {
        const auto released = [&](Real t) {
          const Real net = load(t) - w_ * w_ * displacement;
          return net > forward_ ? 1 : net < -backward_ ? -1 : 0;
        };
        Real release = now;
        if (released(now) == 0) {
          if (just_stopped) ++arrests;
          just_stopped = false;
          if (released(duration) == 0) return;
          release = bisect(now, duration, [&](Real t) { return released(t) != 0; });
        }
        direction = released(release);
        if (!just_stopped)
          ++breakaways;
        else if (direction != came_from)
          ++reversals;
        just_stopped = false;
        now = release;
      }
      const Slip slip{*this, load(now), rate};
      const Real left = duration - now, stop = slip.first_stop(left), step = std::min(stop, left);
      const Real way = slip.way(step);
      dissipated += (direction > 0 ? forward_ : backward_) * std::abs(way);
      displacement += way;
      peak = std::max(peak, std::abs(displacement));
      if (stop <= left) {
        velocity = 0;
        came_from = std::exchange(direction, 0);
        just_stopped = true;
      } else {
        velocity = slip.velocity(step);
      }
      now += step;
    }
    if (just_stopped) {  // stopped at the very end: the next segment decides; random input never does
      ++arrests;
    }
  }

 private:
  template <class Predicate>
  static Real bisect(Real low, Real high, Predicate holds) {  // holds(high), not holds(low)
    for (;;) {
      const Real middle = low + (high - low) / 2;
      if (middle <= low || middle >= high) return high;
      (holds(middle) ? high : low) = middle;
    }
  }

  struct Slip {
    Real s, w, v0, c, r, cosine = 0, sine = 0;  // c: x''(0)

    Slip(const LongDoubleSlider& slider, Real load, Real rate)
        : s(slider.direction),
          w(slider.w_),
          v0(slider.velocity),
          c(load - (s > 0 ? slider.forward_ : -slider.backward_) - w * w * slider.displacement),
          r(rate) {
      // v = r / w^2 + cosine cos(w t) + sine sin(w t)
      if (w > 0) cosine = v0 - r / (w * w), sine = c / w;
    }

    Real velocity(Real t) const {
      if (w > 0) return r / (w * w) + cosine * std::cos(w * t) + sine * std::sin(w * t);
      return v0 + t * (c + t * r / 2);
    }

    Real way(Real t) const {
      if (w > 0) return r / (w * w) * t + (cosine * std::sin(w * t) + sine * (1 - std::cos(w * t))) / w;
      return t * (v0 + t * (c / 2 + t * r / 6));
    }

    Real first_stop(Real left) const {
      std::vector<Real> ends;  // of the monotone pieces
      if (w > 0) {             // x'' = 0: tan(w t) = sine / cosine
        Real t = std::atan2(sine, cosine) / w;
        const Real half_period = std::numbers::pi_v<Real> / w;
        while (t > 0) t -= half_period;
        for (t += half_period; t < left; t += half_period) ends.push_back(t);
      } else if (const Real t = -c / r; t > 0 && t < left) {
        ends.push_back(t);
      }
      ends.push_back(left);
      Real begin = 0;
      for (const Real end : ends) {
        if (s * velocity(end) <= 0) return bisect(begin, end, [&](Real t) { return s * velocity(t) <= 0 && t > 0; });
        begin = end;
      }
      return 2 * left + 1;
    }
  };

  Real forward_, backward_, w_;
};

}  // namespace test
