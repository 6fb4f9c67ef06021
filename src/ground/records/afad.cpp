// AFAD and its predecessors, Turkiye: lines `KEY : value`, the names of the columns, one row a sample. From about 2019
// on AFAD writes the files of ESM, see dyna.cpp.
//
// Source: files of the Strong Ground Motion Database of Turkiye (kyhdata.deprem.gov.tr); gmprocess, nsmn. The unit is
// that of RAW PGA VALUES. These values themselves are not compared: they are of the record before processing. Not used:
// coordinates, depth, magnitude, altitude, recorder.
#include "ground/records/checks.hpp"
#include "ground/records/formats.hpp"
#include "ground/records/keys.hpp"
#include "ground/records/reader.hpp"
#include "ground/records/rows.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stickslip::records {
namespace {

constexpr std::size_t longest_header = 40;
constexpr const char *step_key = "SAMPLING INTERVAL (sec)", *count_key = "NUMBER OF DATA", *peak_key = "RAW PGA VALUES";

}  // namespace

bool is_afad(const Lines& lines) {
  const Keys header(lines, longest_header);
  return header.has(step_key) && header.has(count_key) && header.has("STATION ID");
}

std::vector<Channel> read_afad(const Lines& lines) {
  const Keys header(lines, longest_header);
  const double dt = checked_step(header.number(step_key), header.line(step_key));
  const std::size_t samples = header.samples(count_key);
  const std::string event = header.text("EARTHQUAKE DATE"), start = header.text("RECORD TIME"),
                    station = squeeze(header.text("STATION ID") + " " + header.text("PLACE"));
  std::string units;
  if (header.has(peak_key)) units = squeeze(before(after(before(lines[header.line(peak_key)], ":"), "("), ")"));

  Reader reader(lines);
  reader.block(header.line(step_key), "header");
  std::string_view line;
  while (is_text(reader.peek())) line = reader.line("samples");
  std::vector<Channel> channels;
  if (line.find(':') == std::string_view::npos)
    for (std::string_view rest = trim(line); !rest.empty();) {
      const std::string name = squeeze(rest.substr(0, rest.find_first_of(" \t")));
      rest = trim(rest.substr(std::min(rest.find_first_of(" \t"), rest.size())));
      channels.push_back(
          {.name = name, .title = joined({event, station, name}), .start = start, .units = units, .dt = dt});
    }
  if (channels.empty())
    refuse_line(reader.last(), "expected the names of the columns, such as 'N-S E-W U-D', got " + quote(line));

  Rows rows = read_rows(reader, channels.size());
  rows.require_size(samples);
  for (std::size_t k = 0; k < channels.size(); ++k) channels[k].acceleration = std::move(rows.columns[k]);
  return channels;
}

}  // namespace stickslip::records
