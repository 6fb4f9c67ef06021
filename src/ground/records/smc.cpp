// USGS SMC.
#include "ground/records/checks.hpp"
#include "ground/records/formats.hpp"
#include "ground/records/reader.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "stickslip/base/error.hpp"

namespace stickslip::records {

bool is_smc(const Lines& lines) {
  const std::string_view type = trim(lines[0]);
  if (type.size() < 2 || type[0] < '0' || type[0] > '6' || type[1] != ' ') return false;
  constexpr std::string_view types[] = {"ACCELEROGRAM", "UNKNOWN", "VELOCITY", "DISPLACEMENT", "SPECTRA"};
  return std::ranges::any_of(types, [type](std::string_view name) { return has(type, name); });
}

std::vector<Channel> read_smc(const Lines& lines) {
  if (!has(lines[0], "ACCELEROGRAM")) refuse_line(0, "an accelerogram is needed, this file holds " + quote(lines[0]));
  Reader reader(lines);
  const Lines text = reader.block(11, "heading of 11 lines");
  const std::vector<double> integer = reader.numbers(48, "integers");
  const std::vector<double> real = reader.numbers(50, "reals");
  reader.block(as_count(integer[15], 12, "comments"), "comments");
  const std::size_t samples = as_count(integer[16], 13, "samples");
  if (const double unknown = real[0], rate = real[1]; !(rate > 0) || rate >= unknown)
    refuse_line(17, rate > 0 ? "this file has no sampling rate: its samples are uneven, and their times are not read"
                             : "the sampling rate must be positive, got " + detail::shortest(rate) + " 1/s");

  Channel component{.units = "cm/s^2", .dt = 1 / real[1]};
  component.name = squeeze(after(text[5], "component="));
  const auto known = [](std::string_view line) { return trim(line) == "*" ? std::string() : squeeze(line); };
  component.title =
      joined({known(text[3]), squeeze(before(after(text[5], "station ="), "component=")), component.name});
  component.acceleration = reader.numbers(samples, "samples");
  reader.require_end(samples);
  std::string_view peak = trim(after(text[6], "pk acc"));
  if (peak.starts_with('=')) peak = trim(peak.substr(1));
  if (std::string_view rest = peak; take_number(rest)) check_peak(component, peak, 6);
  // Reals 30 to 33: time and value of the maximum and the minimum.
  const auto largest = std::ranges::max_element(component.acceleration);
  const double at = static_cast<double>(largest - component.acceleration.begin()) * *component.dt;
  if (real[30] < real[0] && std::abs(real[30] - *largest) <= 0.01 * std::abs(*largest) &&
      std::abs(real[29] - at) > 0.25 * at + 2 * *component.dt)
    refuse_line(17, "the header states the maximum at " + detail::shortest(real[29]) +
                        " s, with its sampling rate it is at " + detail::shortest(at) + " s");
  return {component};
}

}  // namespace stickslip::records
