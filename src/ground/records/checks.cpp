#include "ground/records/checks.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>

#include "ground/records/text.hpp"
#include "ground/records/times.hpp"
#include "ground/records/units.hpp"
#include "stickslip/base/error.hpp"

namespace stickslip::records {
namespace {

constexpr double tolerance = 0.25;  // between statements of the same: no other unit is that close

}  // namespace

void check_peak(const Channel& channel, std::string_view stated, std::string_view unit, std::size_t line) {
  std::string_view rest = stated = trim(stated);
  const auto of_header = find_acceleration_unit(unit), of_samples = find_acceleration_unit(channel.units);
  if (stated.empty() || !of_header || !of_samples || channel.acceleration.empty()) return;
  const std::optional<double> value = take_number(rest);
  if (!value) refuse_line(line, "expected a peak value, got " + quote(stated));
  Resolution printed;
  printed.add(stated.substr(0, stated.size() - rest.size()));

  const std::vector<double>& n = channel.acceleration;
  const double mean = std::accumulate(n.begin(), n.end(), 0.) / static_cast<double>(n.size());
  double raw = 0, corrected = 0;
  for (const double sample : n) {
    raw = std::max(raw, std::abs(sample));
    corrected = std::max(corrected, std::abs(sample - mean));
  }
  const double scale = of_samples->value / of_header->value, said = std::abs(*value);
  const double margin = std::max(tolerance * said, printed.units()[0]);
  if (std::abs(scale * raw - said) > margin && std::abs(scale * corrected - said) > margin)
    refuse_line(line, "the header states a peak of " + detail::shortest(*value) + " " + std::string(trim(unit)) +
                          ", the samples have " + detail::shortest(raw) + " " + channel.units);
}

void check_duration(const Channel& channel, double seconds, std::size_t line) {
  if (!channel.dt || !(seconds > 0)) return;
  const double read = *channel.dt * static_cast<double>(channel.acceleration.size());
  if (std::abs(read - seconds) > std::max(tolerance * seconds, 1.))
    refuse_line(line, "the header states a duration of " + detail::shortest(seconds) + " s, the samples have " +
                          detail::shortest(read) + " s");
}

void check_step(const Channel& channel, double seconds, std::size_t line) {
  if (channel.dt && std::abs(*channel.dt - seconds) > 1e-3 * seconds)
    refuse_line(line, "the header states a time step of " + detail::shortest(seconds) + " s, elsewhere it is " +
                          detail::shortest(*channel.dt) + " s");
}

double checked_step(double seconds, std::size_t line) {
  constexpr double longest = 1;
  if (!(seconds > 0 && seconds <= longest))
    refuse_line(line, "expected a time step above 0 and up to 1 s, got " + detail::shortest(seconds) + " s");
  return seconds;
}

}  // namespace stickslip::records
