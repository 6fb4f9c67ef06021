// PEER AT2.
#include "ground/records/formats.hpp"
#include "ground/records/reader.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stickslip::records {

bool is_peer(const Lines& lines) { return lines.size() > 3 && has(lines[3], "NPTS") && has(lines[3], "DT"); }

std::vector<Channel> read_peer(const Lines& lines) {
  if (!has(lines[2], "ACCELERATION"))
    refuse_line(2, "expected a PEER file of acceleration (AT2), got " + quote(lines[2]));
  std::string_view line = lines[3], rest;
  std::optional<double> count = labeled_number(line, "NPTS", rest), dt = labeled_number(line, "DT", rest);
  if (count && dt) {
    rest = trim(rest);
    const std::string_view unit = rest.substr(0, rest.find_first_of(" \t,;."));
    if (!unit.empty() && !is_second(unit)) refuse_line(3, "the time step must be in seconds, got " + quote(unit));
  } else if (!count && !dt) {
    rest = trim(line);
    count = take_number(rest);
    rest = after_separator(rest);
    dt = take_number(rest);
    if (!same(after_separator(rest).substr(0, 4), "NPTS")) dt.reset();
  }
  if (!count || !dt)
    refuse_line(3, "expected 'NPTS= 4096, DT= .0100 SEC' or '4096 .0100 NPTS, DT', got " + quote(line));
  const std::size_t samples = as_count(*count, 3, "samples");

  const std::string title = squeeze(lines[1]);
  const std::size_t comma = title.rfind(',');  // event, date, station, component
  Channel component{.name = comma == std::string::npos ? std::string() : squeeze(title.substr(comma + 1)),
                    .title = title,
                    .units = stated_units(lines[2]),
                    .dt = *dt};
  Reader reader(lines);
  reader.block(4, "header");
  component.acceleration = reader.numbers(samples, "samples");
  reader.require_end(samples);
  return {component};
}

}  // namespace stickslip::records
