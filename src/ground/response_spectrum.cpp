#include "stickslip/ground/response_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "lanes/oscillator_lanes.hpp"
#include "stickslip/flow/damped.hpp"
#include "stickslip/lanes/row.hpp"
#include "stickslip/numerics/root.hpp"

namespace stickslip {
namespace {

/// One oscillator, and the quantity f = of_x x + of_v x' whose maximum magnitude is computed.
struct Oscillator {
  double period, ratio;
  double wn, c, k;  // x'' + c x' + k x = -n
  double of_x = 1, of_v = 0;

  Oscillator(double period_, double ratio_, SpectrumKind kind)
      : period(period_), ratio(ratio_), wn(2 * std::numbers::pi / period), c(2 * ratio * wn), k(wn * wn) {
    if (kind == SpectrumKind::velocity) {
      of_x = 0;
      of_v = 1;
    } else if (kind == SpectrumKind::acceleration) {  // x'' + n
      of_x = -k;
      of_v = -c;
    }
  }

  /// Factor that multiplies the maximum |f|.
  double factor(SpectrumKind kind) const {
    return kind == SpectrumKind::pseudo_acceleration ? k : kind == SpectrumKind::pseudo_velocity ? wn : 1;
  }
};

/// f within a segment: f'' is a free oscillation, because n is linear in time.
class Course {
 public:
  Course(const Oscillator& o, const Segment& s, double x, double v) : o_(o), f_(o.of_x * x + o.of_v * v) {
    const double a = -(s.start + o.c * v + o.k * x);
    const double j = -(s.end - s.start) / s.duration - o.c * a - o.k * v;
    slope_ = o.of_x * v + o.of_v * a;
    curvature_ = o.of_x * a + o.of_v * j;
    rise_ = o.of_x * j - o.of_v * (o.c * j + o.k * a) + o.c * curvature_;
  }

  double slope(double t) const {
    const DampedBasis b(o_.c, o_.wn, t);
    return slope_ + curvature_ * b.impulse + rise_ * b.step;
  }
  double value(double t) const {
    const DampedBasis b(o_.c, o_.wn, t);
    return f_ + t * slope_ + curvature_ * b.step + rise_ * b.ramp;
  }

  /// The maximum |f| where f' = 0. Between consecutive zeros of f'', which are known, f' is monotonic.
  ///
  /// If there are many maxima, those of the first and the last period suffice. f is a straight line plus a free
  /// oscillation. While the line rises, the heights of the maxima are a convex function of their index; while it falls,
  /// no maximum exceeds both the previous one and the height of the line in the first period, which f reaches there.
  double largest(double duration) const {
    const Damped damped(o_.c, o_.wn);
    const double first = damped.turn(curvature_, rise_), half = damped.half_period();
    const double turns = first < duration ? half < duration ? std::floor((duration - first) / half) + 1 : 1 : 0;
    double result = 0, from = 0, from_slope = slope_;
    const auto to = [&](double time) {
      const double there = slope(time);
      if ((from_slope < 0) != (there < 0) && from < time) {
        const double zero = numerics::root([&](double t) { return slope(t); }, from, from_slope, time, there);
        result = std::max(result, std::abs(value(zero)));
      }
      from = time;
      from_slope = there;
    };
    const auto turn = [&](double i) { return i == 0 ? first : std::min(first + i * half, duration); };
    for (double i = 0; i < turns; ++i) {
      if (i == 4 && turns > 8) {
        i = turns - 4;
        from = turn(i - 1);
        from_slope = slope(from);
      }
      to(turn(i));
    }
    to(duration);
    return result;
  }

 private:
  const Oscillator& o_;
  double f_, slope_, curvature_, rise_;
};

/// The maximum |f| of the free vibration from a state: its first extremum, because each later one is smaller or,
/// undamped, equal.
double largest_free(const Oscillator& o, double x, double v) {
  const double f = o.of_x * x + o.of_v * v, slope = o.of_x * v - o.of_v * (o.c * v + o.k * x);
  const double time = Damped(o.c, o.wn).turn(slope, -o.k * f);
  if (!(time < never)) return std::abs(f);
  const DampedBasis b(o.c, o.wn, time);
  return std::max(std::abs(f), std::abs(f * (b.decay + o.c * b.impulse) + slope * b.impulse));
}

/// The effect of a segment of given duration on each oscillator.
void set_duration(detail::OscillatorLanes& lanes, const std::vector<Oscillator>& oscillators, double h) {
  for (std::size_t i = 0; i < lanes.peak.size(); ++i) {
    const Oscillator& o = oscillators[std::min(i, oscillators.size() - 1)];
    const DampedBasis b(o.c, o.wn, h);
    const double x_of[] = {1 - o.k * b.step, b.impulse, b.ramp / h - b.step, -b.ramp / h};
    const double v_of[] = {-o.k * b.impulse, b.decay, b.step / h - b.impulse, -b.step / h};
    for (std::size_t part = 0; part < 4; ++part) {
      lanes.x_of[part][i] = x_of[part];
      lanes.v_of[part][i] = v_of[part];
    }
    // |f''| <= |f''_0| + |f'''_0| min(h, 1 / wn), by the energy of the free oscillation. f deviates from its chord by
    // at most h^2 / 8 times this bound; and by at most twice the amplitude of the free oscillation of which f'' is the
    // second derivative.
    const double z = o.ratio, soon = std::min(h, 1 / o.wn);
    lanes.rise[0][i] = std::min(h * h / 8, 2 * (1 + 2 * z + 4 * z * z) / o.k);
    lanes.rise[1][i] = std::min(h * h / 8 * soon, 2 * (1 + 2 * z) / (o.k * o.wn));
    lanes.soon[i] = soon;
  }
}

/// Runs of segments of one duration.
std::vector<detail::SegmentRow> rows_of(const GroundMotion& motion) {
  std::vector<detail::SegmentRow> rows;
  const double *start = motion.acceleration().data(),
               *end = start + (motion.interpolation() == Interpolation::linear ? 1 : 0);
  const GroundMotion::Pieces pieces(motion);
  for (std::size_t i = 0, next = 0; i < motion.segments(); i = next) {
    const double duration = pieces.segment(i).duration;
    if (std::isnan(motion.dt()))
      for (next = i + 1; next < motion.segments() && pieces.segment(next).duration == duration;) ++next;
    else
      next = motion.segments();
    if (duration > 0) rows.push_back({duration, start + i, end + i, next - i});
  }
  return rows;
}

void check(const std::vector<double>& periods, const std::vector<double>& damping) {
  const auto element = [](const char* array, std::size_t i) {
    return "response_spectrum: " + std::string(array) + "[" + std::to_string(i) + "]";
  };
  if (periods.empty()) throw std::invalid_argument("response_spectrum: needs at least one period, got none");
  if (damping.empty()) throw std::invalid_argument("response_spectrum: needs at least one damping ratio, got none");
  for (std::size_t i = 0; i < periods.size(); ++i)
    if (!(periods[i] == 0 || (periods[i] >= 1e-6 && periods[i] <= 1e6)))
      detail::refuse(element("periods", i) + " must be 0 or from 1e-6 to 1e6 s", periods[i], "s");
  for (std::size_t i = 0; i < damping.size(); ++i)
    if (!(damping[i] >= 0 && damping[i] < 2))
      detail::refuse(
          element("damping", i) + " must be at least 0 and below 2, a ratio of critical damping (5 % is 0.05)",
          damping[i]);
}

/// @param peak   the largest magnitude of the ground acceleration [m/s^2]
/// @param jumps  of the ground velocity before each row and after the last one [m/s]; empty for none
ResponseSpectrum spectrum_of(const std::vector<detail::SegmentRow>& rows, double peak, std::vector<double> periods,
                             std::vector<double> damping, SpectrumKind kind, const std::vector<double>& jumps = {}) {
  const bool of_acceleration = kind == SpectrumKind::pseudo_acceleration || kind == SpectrumKind::acceleration;
  const double rigid = of_acceleration ? peak : 0;
  ResponseSpectrum result{kind, std::move(periods), std::move(damping), {}};
  result.values.assign(result.periods.size() * result.damping.size(), rigid);

  std::vector<Oscillator> oscillators;
  std::vector<std::size_t> places;
  for (std::size_t d = 0; d < result.damping.size(); ++d)
    for (std::size_t p = 0; p < result.periods.size(); ++p)
      if (result.periods[p] > 0) {
        oscillators.emplace_back(result.periods[p], result.damping[d], kind);
        places.push_back(d * result.periods.size() + p);
      }
  if (oscillators.empty()) return result;

  const std::size_t padding = detail::row_padding;
  detail::OscillatorLanes lanes((oscillators.size() + padding - 1) / padding * padding);
  for (std::size_t i = 0; i < lanes.peak.size(); ++i) {
    const Oscillator& o = oscillators[std::min(i, oscillators.size() - 1)];
    lanes.damping[i] = o.c;
    lanes.stiffness[i] = o.k;
    lanes.softness[i] = 1 / o.k;
    lanes.of_displacement[i] = o.of_x;
    lanes.of_velocity[i] = o.of_v;
  }
  const auto start = lanes.state;

  // First the maxima at the samples and after the motion: few segments then remain within which f may exceed them.
  double duration = 0;  // for which the lanes are set up
  const auto set = [&](const detail::SegmentRow& row) {
    if (row.duration != duration) set_duration(lanes, oscillators, row.duration);
    duration = row.duration;
  };
  const auto jump_before = [&](std::size_t row) {
    if (jumps.empty() || jumps[row] == 0) return;
    for (double& v : lanes.state.v) v -= jumps[row];
    for (std::size_t i = 0; i < oscillators.size(); ++i) {
      const Oscillator& o = oscillators[i];
      lanes.peak[i] = std::max(lanes.peak[i], std::abs(o.of_x * lanes.state.x[i] + o.of_v * lanes.state.v[i]));
    }
  };
  for (std::size_t r = 0; r < rows.size(); ++r) {
    jump_before(r);
    set(rows[r]);
    sweep_ends(lanes, rows[r]);
  }
  jump_before(rows.size());
  for (std::size_t i = 0; i < oscillators.size(); ++i)
    lanes.peak[i] = std::max(lanes.peak[i], largest_free(oscillators[i], lanes.state.x[i], lanes.state.v[i]));
  for (std::size_t i = oscillators.size(); i < lanes.peak.size(); ++i)
    lanes.peak[i] = std::numeric_limits<double>::infinity();  // padding is not examined

  lanes.state = start;
  const detail::Inspector inspector{
      [](const void* context, std::size_t lane, const detail::SegmentRow& row, std::size_t i, double x, double v) {
        const Oscillator& o = (*static_cast<const std::vector<Oscillator>*>(context))[lane];
        return Course(o, {row.duration, row.start[i], row.end[i]}, x, v).largest(row.duration);
      },
      &oscillators};
  for (std::size_t r = 0; r < rows.size(); ++r) {
    jump_before(r);
    set(rows[r]);
    sweep_within(lanes, rows[r], inspector);
  }
  for (std::size_t i = 0; i < oscillators.size(); ++i)
    result.values[places[i]] = lanes.peak[i] * oscillators[i].factor(kind);
  return result;
}

}  // namespace

ResponseSpectrum response_spectrum(const GroundMotion& motion, std::vector<double> periods, std::vector<double> damping,
                                   SpectrumKind kind) {
  check(periods, damping);
  ResponseSpectrum result =
      spectrum_of(rows_of(motion), motion.peak_acceleration(), std::move(periods), std::move(damping), kind);
  result.name = motion.name();
  return result;
}

ResponseSpectrum response_spectrum(const std::vector<Segment>& motion, std::vector<double> periods,
                                   std::vector<double> damping, SpectrumKind kind,
                                   const std::vector<Impulse>& impulses) {
  check(periods, damping);
  std::vector<double> jump_before(motion.size() + 1, 0.0);
  for (std::size_t i = 0; i < impulses.size(); ++i) {
    const auto [before, velocity] = impulses[i];
    const std::string impulse = "response_spectrum: impulses[" + std::to_string(i) + "]";
    if (before > motion.size())
      throw std::invalid_argument(impulse + ".before must be at most the number of segments, " +
                                  std::to_string(motion.size()) + ", got " + std::to_string(before));
    if (!std::isfinite(velocity)) detail::refuse(impulse + ".velocity must be finite", velocity, "m/s");
    jump_before[before] += velocity;
  }
  if (!impulses.empty() && (kind == SpectrumKind::pseudo_acceleration || kind == SpectrumKind::acceleration) &&
      std::ranges::find(periods, 0.0) != periods.end())
    throw std::invalid_argument(
        "response_spectrum: the acceleration of a rigid oscillator must be finite, but an impact on a stop or a "
        "landing is an impulse; give periods above 0");
  std::vector<double> start(motion.size()), end(motion.size());
  std::vector<detail::SegmentRow> rows;
  std::vector<double> jumps(1, 0.0);
  double peak = 0, duration = 0;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const Segment& s = motion[i];
    const auto piece = [i] { return "response_spectrum: motion[" + std::to_string(i) + "]"; };
    if (!(s.duration >= 0 && std::isfinite(s.duration)))
      detail::refuse(piece() + ".duration must be finite and at least 0", s.duration, "s");
    for (const double n : {s.start, s.end})
      if (!(std::abs(n) <= GroundMotion::max_acceleration))
        detail::refuse(piece() + " must be finite and at most 1e100 m/s^2 in magnitude", n, "m/s^2");
    start[i] = s.start;
    end[i] = s.end;
    jumps.back() += jump_before[i];
    if (!(s.duration > 0)) continue;
    duration += s.duration;
    peak = std::max({peak, std::abs(s.start), std::abs(s.end)});
    const bool same = i > 0 && jumps.back() == 0 && !rows.empty() && rows.back().duration == s.duration &&
                      rows.back().start + rows.back().count == &start[i];
    if (same)
      ++rows.back().count;
    else {
      rows.push_back({s.duration, &start[i], &end[i], 1});
      jumps.push_back(0);
    }
  }
  jumps.back() += jump_before.back();
  detail::require(duration > 0 && std::isfinite(duration),
                  "response_spectrum: the durations of motion must have a positive, finite sum", duration, "s");
  return spectrum_of(rows, peak, std::move(periods), std::move(damping), kind, jumps);
}

}  // namespace stickslip
