#include "stickslip/ground/processing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "stickslip/base/direction.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/ground/intensity_measures.hpp"
#include "stickslip/ground/orientation.hpp"
#include "stickslip/numerics/gauss_legendre.hpp"

namespace stickslip {
namespace {

constexpr int max_order = 10;

std::vector<double> times_of(const GroundMotion& motion) {
  std::vector<double> times(motion.samples());
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = motion.time(i);
  return times;
}

std::vector<double> acceleration_of(const GroundMotion& motion) {
  return {motion.acceleration().begin(), motion.acceleration().end()};
}

/// Evaluates a motion at times that do not decrease.
class Reader {
 public:
  explicit Reader(const GroundMotion& motion) : motion_(motion) {}

  double at(double time) {
    while (i_ + 1 < motion_.segments() && motion_.time(i_ + 1) <= time) ++i_;
    const Segment s = motion_.segment(i_);
    if (time >= motion_.time(i_ + 1)) return s.end;  // the last
    const double part = std::clamp((time - motion_.time(i_)) / s.duration, 0.0, 1.0);
    return s.start + part * (s.end - s.start);
  }

 private:
  const GroundMotion& motion_;
  std::size_t i_ = 0;
};

/// One component with these samples, on the times of a motion.
GroundMotion with_axis(const GroundMotion& motion, std::vector<double> samples) {
  if (std::isnan(motion.dt())) return {std::move(samples), times_of(motion), motion.interpolation(), motion.name()};
  return {std::move(samples), motion.dt(), motion.interpolation(), motion.name()};
}

/// Applies `work` to each component separately and combines the results.
template <class Work>
GroundMotion each_component(const GroundMotion& motion, Work&& work) {
  const auto samples = [&](bool there, Component which) {
    return there ? acceleration_of(work(motion.component(which))) : std::vector<double>();
  };
  return work(motion.component(Component::axis))
      .with_orientation(motion.orientation())
      .with_components(samples(motion.has_transverse(), Component::transverse),
                       samples(motion.has_vertical(), Component::vertical));
}

/// The Legendre polynomials up to an order.
std::array<double, max_order + 1> legendre(double s, int order) {
  std::array<double, max_order + 1> p{1, s};
  for (std::size_t k = 1; k < static_cast<std::size_t>(order); ++k) {
    const auto n = static_cast<double>(k);
    p[k + 1] = ((2 * n + 1) * s * p[k] - n * p[k - 1]) / (n + 1);
  }
  return p;
}

// ---- one component

GroundMotion resampled_alone(const GroundMotion& motion, double dt) {
  const double duration = motion.duration(), steps = std::floor(duration / dt * (1 + 1e-12));
  if (!(std::isfinite(dt) && dt > 0 && steps >= 1))
    detail::refuse(
        "GroundMotion: resampled: dt must be positive and at most the duration, " + detail::shortest(duration) + " s",
        dt, "s");
  detail::require(steps < 1e9, "GroundMotion: resampled must give fewer than 10^9 samples", steps + 1);
  std::vector<double> samples(static_cast<std::size_t>(steps) + 1);
  Reader reader(motion);
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = reader.at(motion.time(0) + static_cast<double>(i) * dt);
  if (motion.interpolation() == Interpolation::constant && samples.size() > 1 && steps * dt >= duration * (1 - 1e-12))
    samples.back() = motion.acceleration().back();
  return {std::move(samples), dt, motion.interpolation(), motion.name()};
}

GroundMotion cut_alone(const GroundMotion& motion, double begin, double end) {
  const double first = motion.time(0), last = motion.time(motion.samples() - 1);
  for (const bool at_end : {false, true})
    if (const double time = at_end ? end : begin; !(time >= first && time <= last))
      detail::refuse(std::string("GroundMotion: cut: ") + (at_end ? "end" : "begin") +
                         " must be within the motion, from " + detail::shortest(first) + " to " +
                         detail::shortest(last) + " s",
                     time, "s");
  if (!(begin < end))
    detail::refuse("GroundMotion: cut: end must be after begin, " + detail::shortest(begin) + " s", end, "s");
  const std::span<const double> n = motion.acceleration();
  if (const double dt = motion.dt(); !std::isnan(dt)) {
    const double from = std::round(begin / dt), to = std::round(end / dt);
    if (std::abs(begin / dt - from) <= 1e-6 && std::abs(end / dt - to) <= 1e-6 && from < to)
      return {std::vector<double>(n.begin() + static_cast<std::ptrdiff_t>(from),
                                  n.begin() + static_cast<std::ptrdiff_t>(to) + 1),
              dt, motion.interpolation(), motion.name()};
  }
  Reader at_begin(motion), at_end(motion);
  std::vector<double> samples{at_begin.at(begin)}, times{0};
  for (std::size_t i = 0; i < motion.samples(); ++i)
    if (motion.time(i) > begin && motion.time(i) < end) {
      samples.push_back(n[i]);
      times.push_back(motion.time(i) - begin);
    }
  samples.push_back(end < last ? at_end.at(end) : n.back());
  times.push_back(end - begin);
  return {std::move(samples), std::move(times), motion.interpolation(), motion.name()};
}

GroundMotion detrended_alone(const GroundMotion& motion, int order) {
  if (order < 0 || order > max_order)
    throw std::invalid_argument("GroundMotion: the order of detrended must be from 0 to " + std::to_string(max_order) +
                                ", got " + std::to_string(order));
  const auto count = static_cast<std::size_t>(order) + 1;
  const double first = motion.time(0), duration = motion.duration();
  const auto place = [&](double time) { return 2 * (time - first) / duration - 1; };
  std::array<double, max_order + 1> weight{};  // of each polynomial in the trend: they are orthogonal
  for (std::size_t i = 0; i < motion.segments(); ++i) {
    const Segment s = motion.segment(i);
    if (!(s.duration > 0)) continue;
    const double from = motion.time(i);
    numerics::gauss_points<8>(0, s.duration, [&](double t, double w) {  // exact for polynomials of degree 15
      const auto p = legendre(place(from + t), order);
      const double n = s.start + (s.end - s.start) * (t / s.duration);
      for (std::size_t k = 0; k < count; ++k) weight[k] += w * n * p[k] * static_cast<double>(2 * k + 1) / duration;
    });
  }
  const auto trend = [&](double time) {
    const auto p = legendre(place(time), order);
    double sum = 0;
    for (std::size_t k = 0; k < count; ++k) sum += weight[k] * p[k];
    return sum;
  };
  std::vector<double> samples = acceleration_of(motion);
  const bool held = motion.interpolation() == Interpolation::constant;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double duration_here = held && i < motion.segments() ? motion.segment(i).duration : 0;
    if (duration_here > 0) {
      double mean = 0;
      numerics::gauss_points<8>(motion.time(i), motion.time(i) + duration_here,
                                [&](double t, double w) { mean += w * trend(t) / duration_here; });
      samples[i] -= mean;
    } else {
      samples[i] -= trend(motion.time(i));
    }
  }
  return with_axis(motion, std::move(samples));
}

}  // namespace

GroundHistory ground_history(const GroundMotion& motion) {
  GroundHistory result{std::vector<double>(motion.samples()), std::vector<double>(motion.samples())};
  double v = 0, d = 0;
  for (std::size_t i = 0; i < motion.segments(); ++i) {
    const Segment s = motion.segment(i);
    d += s.duration * (v + s.duration * (2 * s.start + s.end) / 6);
    v += s.duration * (s.start + s.end) / 2;
    result.velocity[i + 1] = v;
    result.displacement[i + 1] = d;
  }
  return result;
}

GroundMotion scaled_to(const GroundMotion& motion, const ScaleTarget& target) {
  const int given =
      target.peak_acceleration.has_value() + target.arias_intensity.has_value() + target.peak_velocity.has_value();
  if (given != 1)
    throw std::invalid_argument("GroundMotion: scaled_to needs exactly one of PGA, Arias intensity and PGV, got " +
                                std::to_string(given));
  const auto check = [](const char* what, double value, const char* unit) {
    detail::require(std::isfinite(value) && value > 0,
                    "GroundMotion: scaled_to: " + std::string(what) + " must be positive and finite", value, unit);
  };
  if (!(motion.peak_acceleration() > 0))
    throw std::invalid_argument("GroundMotion: scaled_to needs a motion with an acceleration, got zeros only");
  if (target.peak_acceleration) {
    check("peak acceleration (pga_g)", *target.peak_acceleration, "m/s^2");
    return motion.scaled(*target.peak_acceleration / motion.peak_acceleration());
  }
  if (target.arias_intensity) {
    check("Arias intensity (arias)", *target.arias_intensity, "m/s");
    return motion.scaled(std::sqrt(*target.arias_intensity / arias_intensity(motion)));
  }
  check("peak velocity (pgv)", *target.peak_velocity, "m/s");
  return motion.scaled(*target.peak_velocity / peak_velocity(motion));
}

GroundMotion resampled(const GroundMotion& motion, double dt) {
  return each_component(motion, [&](const GroundMotion& one) { return resampled_alone(one, dt); });
}

GroundMotion cut(const GroundMotion& motion, double begin, double end) {
  return each_component(motion, [&](const GroundMotion& one) { return cut_alone(one, begin, end); });
}

GroundMotion rotated(const GroundMotion& motion, double degrees) {
  detail::require(std::isfinite(degrees), "GroundMotion: rotated: degrees must be finite", degrees, "degrees");
  if (!motion.has_transverse())
    throw std::invalid_argument("GroundMotion: rotated needs a transverse component; this motion has none");
  const auto [c, s] = detail::cos_sin(degrees);
  std::vector<double> n = acceleration_of(motion), t(motion.transverse().begin(), motion.transverse().end());
  for (std::size_t i = 0; i < n.size(); ++i) {
    const double along = n[i], across = t[i];
    n[i] = along * c + across * s;
    t[i] = across * c - along * s;
  }
  std::string orientation = motion.orientation();
  if (!(c > 0) || s != 0) {
    const std::optional<double> azimuth = azimuth_of(orientation);
    orientation = azimuth ? orientation_at(*azimuth + degrees) : std::string();
  }
  return with_axis(motion, std::move(n))
      .with_orientation(std::move(orientation))
      .with_components(std::move(t), {motion.vertical().begin(), motion.vertical().end()});
}

GroundMotion detrended(const GroundMotion& motion, int order) {
  return each_component(motion, [&](const GroundMotion& one) { return detrended_alone(one, order); });
}

}  // namespace stickslip
