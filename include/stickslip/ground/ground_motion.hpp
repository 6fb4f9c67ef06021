// The history of ground acceleration.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/base/extremes.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/ground/segment.hpp"

namespace stickslip {

/// The ground acceleration between two samples: a straight line, or the earlier value held constant.
enum class Interpolation { linear, constant };

/// A component of a ground motion: along the slider's axis, horizontal and perpendicular to it, or vertical.
enum class Component { axis, transverse, vertical };

inline const char* name_of(Component component) noexcept {
  return component == Component::axis ? "axis" : component == Component::transverse ? "transverse" : "vertical";
}

/// The acceleration history n(t) of the ground [m/s^2], at even or uneven times.
///
/// `acceleration()` is along the slider's axis. `with_components` adds the other horizontal and the vertical component
/// at the same times; without them a motion has one component. Peaks, integrals and intensity measures refer to the
/// component along the axis; `component` returns any other component as a motion along the axis.
///
/// N samples make N - 1 segments; the motion lasts from the first time to the last. With
/// `Interpolation::linear` the acceleration is a straight line between samples (thesis 4.56); with
/// `Interpolation::constant` each value holds until the next time, and the last value only marks the end of the motion
/// and does not act.
///
/// Immutable. The constructor checks that there are at least two samples, every sample is finite and at most
/// 1e100 m/s^2 in magnitude (so that no energy can overflow silently), `dt` is positive and `times` increase. With
/// `Interpolation::constant`, consecutive times may be equal (a segment of zero duration).
class GroundMotion {
 public:
  static constexpr double max_acceleration = 1e100;  ///< [m/s^2]

  /// Samples at times 0, dt, 2 dt, ...
  /// @param acceleration  n at the samples [m/s^2], at least two, finite
  /// @param dt            time between samples [s], positive and finite
  /// @param name          where the motion comes from; shown in plots and messages
  /// @throws std::invalid_argument names the invalid value (and its index)
  GroundMotion(std::vector<double> acceleration, double dt, Interpolation interpolation = Interpolation::linear,
               std::string name = {})
      : acceleration_(std::move(acceleration)), dt_(dt), interpolation_(interpolation), name_(std::move(name)) {
    detail::require(std::isfinite(dt) && dt > 0, "GroundMotion: dt must be positive and finite", dt, "s");
    check_samples();
    detail::require(std::isfinite(time(samples() - 1)), "GroundMotion: its duration must be finite", duration(), "s");
  }

  /// Samples at given times.
  /// @param times  [s], one per sample, finite and increasing (with `Interpolation::constant`, non-decreasing)
  /// @throws std::invalid_argument names the invalid value (and its index)
  GroundMotion(std::vector<double> acceleration, std::vector<double> times,
               Interpolation interpolation = Interpolation::linear, std::string name = {})
      : acceleration_(std::move(acceleration)),
        times_(std::move(times)),
        interpolation_(interpolation),
        name_(std::move(name)) {
    if (times_.size() != acceleration_.size())
      throw std::invalid_argument("GroundMotion: needs as many times as samples, got " + std::to_string(times_.size()) +
                                  " times for " + std::to_string(acceleration_.size()) + " samples");
    check_samples();
    for (std::size_t i = 0; i < times_.size(); ++i)
      if (!std::isfinite(times_[i]))
        detail::refuse("GroundMotion: " + element("times", i) + " must be finite", times_[i], "s");
    const bool held = interpolation_ == Interpolation::constant;
    for (std::size_t i = 1; i < times_.size(); ++i)
      if (held ? times_[i] < times_[i - 1] : times_[i] <= times_[i - 1])
        detail::refuse("GroundMotion: times must " + std::string(held ? "not decrease" : "increase") + ", " +
                           element("times", i) + " must come after " + detail::shortest(times_[i - 1]) + " s",
                       times_[i], "s");
    detail::require(std::isfinite(duration()) && duration() > 0,
                    "GroundMotion: its duration must be positive and finite", duration(), "s");
  }

  std::size_t samples() const noexcept { return acceleration_.size(); }
  std::size_t segments() const noexcept { return acceleration_.size() - 1; }

  /// Ground acceleration along the axis at the samples [m/s^2].
  std::span<const double> acceleration() const noexcept { return acceleration_; }

  /// The horizontal component perpendicular to the axis at the samples [m/s^2]; empty if there is none.
  std::span<const double> transverse() const noexcept { return transverse_; }

  /// The vertical component at the samples [m/s^2], positive upward; empty if there is none.
  std::span<const double> vertical() const noexcept { return vertical_; }

  bool has_transverse() const noexcept { return !transverse_.empty(); }
  bool has_vertical() const noexcept { return !vertical_.empty(); }

  /// Time of sample i [s]; after the last sample, times continue with the last step.
  double time(std::size_t i) const noexcept {
    if (times_.empty() || i < samples()) return Pieces(*this).time(i);
    return times_.back() + static_cast<double>(i - segments()) * last_step();
  }

  /// Time between samples [s]; NaN if the times are uneven.
  double dt() const noexcept { return dt_; }

  /// The last nonzero time between samples [s].
  double last_step() const noexcept {
    if (times_.empty()) return dt_;
    std::size_t i = segments() - 1;
    while (detail::equal(times_[i], times_.back())) --i;  // the duration is positive
    return times_.back() - times_[i];
  }

  /// Time from the first sample to the last [s].
  double duration() const noexcept { return time(samples() - 1) - time(0); }

  Interpolation interpolation() const noexcept { return interpolation_; }
  const std::string& name() const noexcept { return name_; }

  /// Orientation of the axis: an azimuth such as "N28W" or "332" [degrees clockwise from north], or "up"; empty if
  /// unknown. The transverse component points 90 degrees clockwise from the axis.
  const std::string& orientation() const noexcept { return orientation_; }

  /// Largest magnitude of the ground acceleration along the axis [m/s^2], the PGA.
  double peak_acceleration() const noexcept { return peak_; }

  /// Fast access to the segments in a loop: the interpolation and the kind of times are looked up once. Holds pointers
  /// into the motion, which must outlive it.
  class Pieces {
   public:
    explicit Pieces(const GroundMotion& motion) noexcept
        : starts_(motion.acceleration_.data()),
          ends_(starts_ + (motion.interpolation_ == Interpolation::linear ? 1 : 0)),
          times_(motion.times_.empty() ? nullptr : motion.times_.data()),
          dt_(motion.dt_) {}

    double time(std::size_t i) const noexcept {
      const auto steps = static_cast<std::ptrdiff_t>(i);  // conversion to double needs no branch if signed
      return times_ == nullptr ? static_cast<double>(steps) * dt_ : times_[i];
    }
    Segment segment(std::size_t i) const noexcept {
      return {times_ == nullptr ? dt_ : times_[i + 1] - times_[i], starts_[i], ends_[i]};
    }
    /// The samples.
    const double* samples() const noexcept { return starts_; }
    /// Segments that contain all values of `count` segments from the i-th one on: all their loads are between those at the
    /// ends of these.
    std::array<Segment, 1> around(std::size_t i, std::size_t count) const noexcept {
      const auto [least, most] = detail::extremes(starts_ + i, count + 1);
      return {{{dt_, least, most}}};
    }

   private:
    const double *starts_, *ends_, *times_;
    double dt_;
  };

  /// The i-th segment, between samples i and i + 1.
  Segment segment(std::size_t i) const noexcept { return Pieces(*this).segment(i); }

  /// A copy of the motion with these additional components, at the same times and with the same interpolation.
  /// @param transverse  the other horizontal component at the samples [m/s^2], finite; empty for none
  /// @param vertical    the vertical component [m/s^2], positive upward, finite; empty for none
  /// @throws std::invalid_argument  the number of samples differs from that of the axis; a value is invalid (the
  ///                                message names it and its index)
  GroundMotion with_components(std::vector<double> transverse, std::vector<double> vertical = {}) const {
    GroundMotion result = *this;
    result.transverse_ = std::move(transverse);
    result.vertical_ = std::move(vertical);
    result.check_samples();
    return result;
  }

  /// A copy of the motion with this orientation of its axis (see `orientation`). The text is not checked.
  GroundMotion with_orientation(std::string orientation) const {
    GroundMotion result = *this;
    result.orientation_ = std::move(orientation);
    return result;
  }

  /// One component alone, as a motion along the axis. The orientation of a transverse component is left empty.
  /// @throws std::invalid_argument  a component that the motion does not have
  GroundMotion component(Component which) const {
    GroundMotion result = *this;
    if (which != Component::axis) {
      result.acceleration_ = which == Component::transverse ? transverse_ : vertical_;
      if (result.acceleration_.empty())
        throw std::invalid_argument(std::string("GroundMotion: has no ") + name_of(which) + " component");
      result.orientation_ = which == Component::vertical ? "up" : "";
    }
    return result.with_components({});
  }

  /// A copy of the motion with every acceleration multiplied by `factor` (finite). A negative factor reverses the
  /// horizontal components but not the vertical one, which is multiplied by the magnitude of the factor.
  GroundMotion scaled(double factor) const {
    detail::require(std::isfinite(factor), "GroundMotion: a scale factor must be finite", factor);
    GroundMotion result = *this;
    for (auto* horizontal : {&result.acceleration_, &result.transverse_})
      for (double& n : *horizontal) n *= factor;
    for (double& n : result.vertical_) n *= std::abs(factor);
    result.check_samples();
    return result;
  }

  /// True if the samples of all components, times, interpolation, name and orientation are equal. A motion with `dt`
  /// never equals one with a list of times, even if the times are the same.
  friend bool operator==(const GroundMotion& a, const GroundMotion& b) {
    const bool same_dt = detail::equal(a.dt_, b.dt_) || (std::isnan(a.dt_) && std::isnan(b.dt_));
    return same_dt && a.times_ == b.times_ && a.acceleration_ == b.acceleration_ && a.transverse_ == b.transverse_ &&
           a.vertical_ == b.vertical_ && a.interpolation_ == b.interpolation_ && a.name_ == b.name_ &&
           a.orientation_ == b.orientation_;
  }

 private:
  void check_samples() {
    if (samples() < 2)
      throw std::invalid_argument("GroundMotion: needs at least two samples, got " + std::to_string(samples()));
    check("acceleration", acceleration_);
    if (has_transverse()) check("transverse", transverse_);
    if (has_vertical()) check("vertical", vertical_);
    peak_ = 0;
    const std::size_t acting = samples() - (interpolation_ == Interpolation::constant ? 1 : 0);
    for (std::size_t i = 0; i < acting; ++i) peak_ = std::max(peak_, std::abs(acceleration_[i]));
  }

  void check(const char* array, const std::vector<double>& values) const {
    if (values.size() != samples())
      throw std::invalid_argument(std::string("GroundMotion: ") + array +
                                  " must have as many samples as acceleration, " + std::to_string(samples()) +
                                  ", got " + std::to_string(values.size()));
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!(std::abs(values[i]) <= max_acceleration))
        detail::refuse("GroundMotion: " + element(array, i) + " must be finite and at most 1e100 m/s^2 in magnitude",
                       values[i], "m/s^2");
  }

  static std::string element(const char* array, std::size_t i) {
    return std::string(array) + "[" + std::to_string(i) + "]";
  }

  std::vector<double> acceleration_;
  std::vector<double> transverse_{}, vertical_{};  // empty if there are none
  std::vector<double> times_{};                    // empty if samples are evenly spaced
  double dt_ = std::numeric_limits<double>::quiet_NaN();
  double peak_ = 0;
  Interpolation interpolation_;
  std::string name_, orientation_{};
};

}  // namespace stickslip
