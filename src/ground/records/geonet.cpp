// GeoNet V1A and V2A.
#include "ground/records/checks.hpp"
#include "ground/records/formats.hpp"
#include "ground/records/reader.hpp"

#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

namespace stickslip::records {

bool is_geonet(const Lines& lines) {
  return has(lines[0], "corrected accelerogram") && lines.size() > 12 && lines[12].starts_with("Component");
}

std::vector<Channel> read_geonet(const Lines& lines) {
  constexpr std::size_t columns = 10, width = 8;
  std::vector<Channel> components;
  Reader reader(lines);
  while (!reader.done()) {
    const Lines text = reader.block(16, "heading of 16 lines");
    const std::size_t heading = reader.last() - 15;
    if (!is_geonet(text)) refuse_line(heading, "expected the heading of another component, got " + quote(text[0]));
    if (std::string_view unit = trim(after(text[10], "in units of")); !unit.empty())
      if (take_number(unit) != 1 || !trim(unit).starts_with("mm/s/s"))
        refuse_line(heading + 10, "readings in units of 1.00 mm/s/s are needed, got " + quote(text[10]));

    const std::vector<double> integer = reader.numbers(40, "integers", width);
    const std::vector<double> real = reader.numbers(60, "reals", width);
    const auto samples = [&](std::size_t number) { return as_count(integer[number - 1], heading + 19, "samples"); };

    Channel component{.start = squeeze(text[7]), .units = "mm/s^2", .dt = real[25]};
    component.name = squeeze(before(trim(after(text[12], "Component")), " "));
    component.title =
        joined({squeeze(text[6]), squeeze(before(text[7], "  ")),
                squeeze(before(trim(after(text[1], "Site")), " ")) + " " + squeeze(text[2]), component.name});
    component.acceleration = reader.numbers(samples(34), "samples", width);
    std::string_view step = trim(after(text[10], " at "));
    if (const std::optional<double> seconds = take_number(step)) check_step(component, *seconds, heading + 10);
    std::string_view peak = trim(after(text[13], "peak"));
    const std::string_view number = peak;
    if (take_number(peak)) check_peak(component, number, first_word(peak), heading + 13);
    reader.block((samples(35) + columns - 1) / columns, "velocities");
    reader.block((samples(36) + columns - 1) / columns, "displacements");
    components.push_back(std::move(component));
  }
  return components;
}

}  // namespace stickslip::records
