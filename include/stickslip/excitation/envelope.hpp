// The envelope of a random motion: its strength as a function of time.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "stickslip/base/requirements.hpp"

namespace stickslip {

/// A factor on a stationary acceleration that makes it resemble an earthquake: it builds up, stays strong and decays.
///
///     e(t) = (t / build_up)^2                                    for 0 <= t < build_up
///     e(t) = 1                                                   for build_up <= t <= build_up + strong_duration
///     e(t) = exp(-decay_rate (t - build_up - strong_duration))  after that;  0 for t < 0
///
/// Reference: P. C. Jennings, G. W. Housner, N. C. Tsai, Simulated earthquake motions, Caltech (1968).
class Envelope {
 public:
  /// @param build_up         [s], finite and at least 0; 0 starts at full strength
  /// @param strong_duration  duration of the strong phase [s], at least 0, may be infinite
  /// @param decay_rate       [1/s], finite and at least 0
  /// @throws std::invalid_argument naming the value
  Envelope(double build_up, double strong_duration, double decay_rate);

  /// An envelope that is linear between the given points and zero outside.
  /// @param time    [s], at least two values, finite and increasing
  /// @param factor  one value per time, finite and at least 0
  /// @throws std::invalid_argument naming the value refused and its index
  static Envelope from_table(std::vector<double> time, std::vector<double> factor);

  /// The factor at time t [s], at least 0; NaN if t is NaN.
  double operator()(double t) const noexcept;

  double build_up() const noexcept { return build_up_; }
  double strong_duration() const noexcept { return strong_duration_; }
  double decay_rate() const noexcept { return decay_rate_; }

  /// The points of the table; empty if there is none.
  std::span<const double> time() const noexcept { return time_; }
  std::span<const double> factor() const noexcept { return factor_; }

  /// The parameters as one JSON object, with numbers in the shortest form that reads back exactly.
  std::string configuration() const;

  friend bool operator==(const Envelope&, const Envelope&) = default;

 private:
  double build_up_;
  double strong_duration_;
  double decay_rate_;
  std::vector<double> time_;
  std::vector<double> factor_;
};

}  // namespace stickslip
