// ASA 2.0, the standard file of acceleration in Mexico (UNAM, CICESE, CIRES): lines `KEY : value` in sections, one row
// a sample.
//
// Source: Instituto de Ingenieria, UNAM, description of the ASA file, version 2.0; gmprocess, unam; GEM gmpe-smtk, asa.
// The header has 109 lines, which some writers change: the section DATOS DE ACELERACION is searched for. Writers repeat
// the last row once or twice beyond the number of samples: such rows are left out. A factor of decimation other than 1
// is accepted if duration, step and number of samples agree. A direction with the sign - is refused, as in cwb.cpp.
// Not used: places, soil, instrument (channels, range, frequency, damping, threshold, memory), magnitudes, accuracy of
// time, sample of the peak, quality, comments.
#include "ground/records/checks.hpp"
#include "ground/records/formats.hpp"
#include "ground/records/keys.hpp"
#include "ground/records/reader.hpp"
#include "ground/records/rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "stickslip/ground/records.hpp"

namespace stickslip::records {
namespace {

constexpr std::size_t longest_header = 200;
constexpr const char *file_line = "ARCHIVO ESTANDAR DE", *data_line = "DATOS DE ACELERACION",
                     *direction_key = "ORIENTACION ", *step_key = "INTERVALO DE MUESTREO, ",
                     *rate_key = "VEL. DE MUESTREO, ", *count_key = "NUM. TOTAL DE MUESTRAS, ",
                     *duration_key = "DURACION DEL REGISTRO (s), ", *peak_key = "ACEL. MAX.(Gal), ",
                     *factor_key = "FACTOR DE DECIMACION", *unit_key = "UNIDADES DE LOS DATOS",
                     *format_key = "FORMATO DATOS";

/// Index of the first line with a text, or the number of lines.
std::size_t find_line(const Lines& lines, std::string_view text) {
  const std::size_t end = std::min(lines.size(), longest_header);
  for (std::size_t i = 0; i < end; ++i)
    if (has(lines[i], text)) return i;
  return lines.size();
}

/// The entries `/V/N90E/N00E` of the lines for channels 1 to 6 and 7 to 12.
std::vector<std::string_view> entries(const Keys& header, const std::string& key) {
  std::vector<std::string_view> all;
  for (const char* channels : {"C1-C6", "C7-C12"})
    for (std::string_view rest = header.value(key + channels); !rest.empty();) {
      const std::size_t end = std::min(rest.find('/'), rest.size());
      if (const std::string_view one = trim(rest.substr(0, end)); !one.empty()) all.push_back(one);
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
  return all;
}

/// The number that all channels share.
double common(const Keys& header, const std::string& key, std::size_t channels) {
  const std::size_t line = header.line(key + "C1-C6");
  const std::vector<std::string_view> all = entries(header, key);
  std::optional<double> first;
  for (std::string_view one : all) {
    const std::string_view text = one;
    const std::optional<double> number = take_number(one);
    if (!number || !one.empty() || (first && *first != *number))
      refuse_line(line, "expected the same number for each channel, as in '/100/100/100', got " + quote(text));
    first = number;
  }
  if (all.size() != channels)
    refuse_line(line, "expected numbers for the " + std::to_string(channels) + " channels of the header, got " +
                          std::to_string(all.size()) + " in " + quote(header.value(key + "C1-C6")));
  return *first;
}

/// The direction in `N90E`, `N00E;`, `V;+`, `+V`.
std::string direction(std::string_view entry) {
  entry = trim(entry.substr(0, entry.find(';')));
  return squeeze(entry.starts_with('+') ? entry.substr(1) : entry);
}

/// Rejects a row of directions above the columns that names others than the header.
void check_directions(const Lines& lines, std::size_t row, const std::vector<Channel>& channels) {
  std::size_t k = 0;
  for (std::string_view rest = trim(lines[row]); !rest.empty(); ++k) {
    const std::size_t end = std::min(rest.find_first_of(" \t"), rest.size());
    if (k == channels.size() || !same(direction(rest.substr(0, end)), channels[k].name))
      refuse_line(row, "expected the directions that the header states, got " + quote(lines[row]));
    rest = trim(rest.substr(end));
  }
}

}  // namespace

bool is_asa(const Lines& lines) { return find_line(lines, file_line) < lines.size(); }

std::vector<Channel> read_asa(const Lines& lines) {
  if (const std::size_t line = find_line(lines, file_line); !has(lines[line], "ACELERACION"))
    refuse_line(line, "expected acceleration, got " + quote(lines[line]));
  const std::size_t section = find_line(lines, data_line);
  if (section == lines.size()) throw std::invalid_argument("the header has no " + quote(data_line));
  const Keys header(lines, section);

  std::vector<Channel> channels;
  for (const std::string_view entry : entries(header, direction_key)) {
    if (entry.starts_with('-') || after(entry, ";").find('-') != std::string_view::npos)
      refuse_line(header.line(std::string(direction_key) + "C1-C6"),
                  "expected directions of positive samples, as in '/V/N90E/N00E', got " + quote(entry));
    channels.push_back({.name = direction(entry)});
  }
  if (channels.empty()) throw std::invalid_argument("the header has no directions of its channels");

  const std::size_t step_line = header.line(std::string(step_key) + "C1-C6");
  const double dt = checked_step(common(header, step_key, channels.size()), step_line);
  if (!entries(header, rate_key).empty() && !(std::abs(common(header, rate_key, channels.size()) * dt - 1) < 0.01))
    refuse_line(step_line, "the time step disagrees with the samples per second, got " + quote(lines[step_line]));
  const std::size_t samples =
      as_count(common(header, count_key, channels.size()), header.line(std::string(count_key) + "C1-C6"), "samples");
  const bool is_timed = !entries(header, duration_key).empty();
  if (is_timed) {
    const double duration = common(header, duration_key, channels.size()), length = static_cast<double>(samples) * dt;
    if (!(std::abs(duration - length) <= 0.01 * duration + dt))
      refuse_line(header.line(std::string(duration_key) + "C1-C6"),
                  "the duration disagrees with the time step and the number of samples, got " +
                      quote(header.value(std::string(duration_key) + "C1-C6")));
  }
  if (!is_timed && header.has(factor_key) && header.number(factor_key) != 1)
    refuse_line(header.line(factor_key),
                "a factor of decimation needs the duration, got " + quote(header.value(factor_key)));

  // Gal (cm/s/s)
  const std::string_view unit = header.value(unit_key);
  const std::string units = squeeze(before(unit, "("));

  // Lines of dashes enclose the names above the columns.
  std::size_t first = section + 1;
  for (std::size_t i = first; i < std::min(section + 10, lines.size()); ++i) {
    if (trim(lines[i]).starts_with("--")) first = i + 1;
    if (has(lines[i], "CANAL-1") && i + 1 < lines.size()) check_directions(lines, i + 1, channels);
  }
  Reader reader(lines);
  reader.block(first, "header");
  Rows rows = read_rows(reader, channels.size(), fortran_width(header.value(format_key)));
  const auto repeats = [&](std::size_t row) {
    return std::ranges::all_of(rows.columns, [&](const auto& column) { return column[row] == column[row - 1]; });
  };
  std::size_t kept = rows.size();
  while (samples > 0 && kept > samples && repeats(kept - 1)) --kept;
  rows.lines.resize(kept);
  rows.require_size(samples);

  const std::vector<std::string_view> peaks = entries(header, peak_key);
  for (std::size_t k = 0; k < channels.size(); ++k) {
    Channel& channel = channels[k];
    channel.title = joined({squeeze(header.text("FECHA DEL SISMO") + " " + header.text("HORA EPICENTRO")),
                            squeeze(header.text("CLAVE DE LA ESTACION") + " " + header.text("NOMBRE DE LA ESTACION")),
                            channel.name});
    channel.start = header.text("HORA DE LA PRIMERA MUESTRA");
    channel.units = units;
    channel.dt = dt;
    channel.acceleration = std::move(rows.columns[k]);
    channel.acceleration.resize(kept);
    if (peaks.size() == channels.size())
      check_peak(channel, peaks[k], "gal", header.line(std::string(peak_key) + "C1-C6"));
  }
  return channels;
}

}  // namespace stickslip::records
