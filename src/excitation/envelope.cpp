#include "stickslip/excitation/envelope.hpp"

#include <cmath>
#include <utility>

#include "base/json.hpp"
#include "base/table.hpp"
#include "stickslip/base/error.hpp"

namespace stickslip {

Envelope::Envelope(double build_up, double strong_duration, double decay_rate)
    : build_up_(build_up), strong_duration_(strong_duration), decay_rate_(decay_rate) {
  detail::require(std::isfinite(build_up) && build_up >= 0, "Envelope: build_up must be finite and at least 0",
                  build_up, "s");
  detail::require(strong_duration >= 0, "Envelope: strong_duration must be at least 0", strong_duration, "s");
  detail::require(std::isfinite(decay_rate) && decay_rate >= 0, "Envelope: decay_rate must be finite and at least 0",
                  decay_rate, "1/s");
}

Envelope Envelope::from_table(std::vector<double> time, std::vector<double> factor) {
  detail::require_table("Envelope", time, {"time", "s"}, factor, {"factor", ""});
  Envelope result(0, 0, 0);
  result.time_ = std::move(time);
  result.factor_ = std::move(factor);
  return result;
}

double Envelope::operator()(double t) const noexcept {
  if (!time_.empty()) return detail::interpolated(time_, factor_, t);
  if (t < 0) return 0;
  if (!(t >= build_up_)) return (t / build_up_) * (t / build_up_);  // NaN of NaN
  const double decaying = t - build_up_ - strong_duration_;
  return decaying > 0 ? std::exp(-decay_rate_ * decaying) : 1;
}

std::string Envelope::configuration() const {
  if (!time_.empty())
    return R"({"kind": "table", "time": )" + detail::json(time_) + R"(, "factor": )" + detail::json(factor_) + "}";
  return R"({"kind": "jennings", "build_up": )" + detail::json(build_up_) + R"(, "strong_duration": )" +
         detail::json(strong_duration_) + R"(, "decay_rate": )" + detail::json(decay_rate_) + "}";
}

}  // namespace stickslip
