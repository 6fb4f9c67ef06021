// How strong a random motion is as time goes on.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "stickslip/detail/requirements.hpp"

namespace stickslip {

/// What a stationary acceleration is multiplied by to become an earthquake: it builds up, stays strong, decays.
///
///     e(t) = (t / build_up)^2                      for 0 <= t < build_up
///     e(t) = 1                                     for build_up <= t <= build_up + strong
///     e(t) = exp(-decay_rate (t - build_up - strong))  after that;  0 for t < 0
///
/// Reference: P. C. Jennings, G. W. Housner, N. C. Tsai, Simulated earthquake motions, Caltech (1968).
class Envelope {
 public:
  /// @param build_up    [s], finite and at least 0; 0 starts at full strength
  /// @param strong      duration of the strong phase [s], at least 0, may be infinite
  /// @param decay_rate  [1/s], finite and at least 0
  /// @throws std::invalid_argument naming the value
  Envelope(double build_up, double strong, double decay_rate);

  /// Straight lines between the points given, zero outside.
  /// @param time    [s], at least two, finite and increasing
  /// @param factor  as many, finite and at least 0
  /// @throws std::invalid_argument naming the value refused and its index
  static Envelope from_table(std::vector<double> time, std::vector<double> factor);

  /// The factor at time t [s], at least 0; NaN of NaN.
  double operator()(double t) const noexcept;

  double build_up() const noexcept { return build_up_; }
  double strong() const noexcept { return strong_; }
  double decay_rate() const noexcept { return decay_rate_; }

  /// The table's points; empty where there is none.
  std::span<const double> time() const noexcept { return time_; }
  std::span<const double> factor() const noexcept { return factor_; }

  /// All of it as one JSON object, numbers in the shortest form that reads back the same.
  std::string configuration() const;

  friend bool operator==(const Envelope&, const Envelope&) = default;

 private:
  double build_up_;
  double strong_;
  double decay_rate_;
  std::vector<double> time_;
  std::vector<double> factor_;
};

}  // namespace stickslip
