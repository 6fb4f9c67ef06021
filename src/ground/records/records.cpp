#include "stickslip/ground/records.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "ground/records/formats.hpp"
#include "ground/records/text.hpp"
#include "stickslip/units.hpp"

namespace stickslip {
namespace {

namespace fs = std::filesystem;
using namespace records;

bool is_utf8(std::string_view text) {
  const auto is_long = [](char c) { return static_cast<unsigned char>(c) >= 0x80; };
  for (auto next = std::ranges::find_if(text, is_long); next != text.end();
       next = std::ranges::find_if(text, is_long)) {
    text.remove_prefix(static_cast<std::size_t>(next - text.begin()));
    const std::size_t length = sequence(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::string latin1_to_utf8(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code >= 0x80) result += static_cast<char>(0xC0 | code >> 6);
    result += static_cast<char>(code < 0x80 ? code : 0x80 | (code & 0x3F));
  }
  return result;
}

std::string load(const fs::path& file) {
  const auto fail = [&file](std::errc code) {
    throw fs::filesystem_error("read_record", file, std::make_error_code(code));
  };
  const fs::file_status status = fs::status(file);
  if (!fs::exists(status)) fail(std::errc::no_such_file_or_directory);
  if (fs::is_directory(status)) fail(std::errc::is_a_directory);
  if (!fs::is_regular_file(status)) fail(std::errc::not_supported);  // a pipe or a device may never end
  std::string text(fs::file_size(file), '\0');
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail(errno == 0 ? std::errc::io_error : std::errc(errno));
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (static_cast<std::size_t>(stream.gcount()) != text.size()) fail(std::errc::io_error);
  return text;
}

/// The text of a file without its byte-order mark and DOS end mark, in UTF-8.
std::string decoded(std::string text) {
  if (const std::size_t at = text.find('\0'); at != std::string::npos)
    throw std::invalid_argument("plain text is needed, got a NUL byte at offset " + std::to_string(at) +
                                " (a binary file, or UTF-16)");
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  if (text.ends_with('\x1A')) text.pop_back();
  return is_utf8(text) ? text : latin1_to_utf8(text);
}

Lines split(std::string_view text) {
  Lines lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    while (line.ends_with('\r')) line.remove_suffix(1);
    lines.push_back(line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  if (std::ranges::all_of(lines, [](std::string_view line) { return trim(line).empty(); }))
    throw std::invalid_argument("the file is empty");
  return lines;
}

// ---- what the caller asked for

Channel choose(std::vector<Channel> components, const std::string& wanted) {
  std::size_t matches = 0, index = 0;
  for (std::size_t i = 0; i < components.size(); ++i)
    if (wanted.empty() || same(components[i].name, wanted)) {
      ++matches;
      index = i;
    }
  if (matches == 0) {
    const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
    if (error == std::errc() && end == wanted.data() + wanted.size() && index >= 1 && index <= components.size()) {
      matches = 1;
      --index;
    }
  }
  if (matches == 1) return std::move(components[index]);
  constexpr std::size_t longest = 12;
  std::string known;
  for (std::size_t i = 0; i < std::min(longest, components.size()); ++i)
    known += (i == 0 ? "" : ", ") + std::to_string(i + 1) + (components[i].name.empty() ? "" : " ") +
             printable(components[i].name, 24);
  if (components.size() > longest) known += " and so on to " + std::to_string(components.size());
  throw std::invalid_argument("select one component by name or number, available: " + known + "; got " + quote(wanted));
}

/// m/s^2 per unit of the file.
double scale(const std::string& stated, const std::string& given) {
  if (stated.empty() && given.empty())
    throw std::invalid_argument("the file states no units of acceleration: pass units, such as \"g\" or \"m/s^2\"");
  const double factor = acceleration_unit(stated.empty() ? given : stated);
  if (!given.empty() && acceleration_unit(given) != factor)
    throw std::invalid_argument("the file states " + quote(stated) + ", units given are " + quote(given));
  return factor;
}

}  // namespace

double acceleration_unit(std::string_view name) {
  static constexpr std::pair<std::string_view, double> units[] = {
      {"g", standard_gravity}, {"m/s^2", 1},       {"cm/s^2", 0.01},   {"gal", 0.01},
      {"mm/s^2", 0.001},       {"ft/s^2", 0.3048}, {"in/s^2", 0.0254},
  };
  // Every way to write a unit is brought to the one in the table.
  constexpr std::size_t longest = 32;  // the names below with room to spare
  std::string unit;
  for (const char c : name)
    if (!is_blank(c) && unit.size() <= longest) unit += lower(c);
  if (unit.size() > longest) unit.clear();
  for (const auto& [variant, plain] : {std::pair<std::string_view, std::string_view>{"\xC2\xB2", "2"},  // superscript 2
                                       {"sec", "s"},
                                       {"**", "^"},
                                       {"s/s", "s^2"},
                                       {"s2", "s^2"},
                                       {"g's", "g"}})
    for (std::size_t at; (at = unit.find(variant)) != std::string::npos;) unit.replace(at, variant.size(), plain);
  std::string known;
  for (const auto& [text, factor] : units) {
    if (unit == text) return factor;
    known.append(known.empty() ? "" : ", ").append(text);
  }
  throw std::invalid_argument("unknown unit of acceleration " + quote(name) + "; known are " + known);
}

GroundMotion read_record(const fs::path& file, const RecordOptions& options) {
  std::string content = load(file);
  try {
    const std::string text = decoded(std::move(content));
    const Lines lines = split(text);
    Channel component = choose(recognize(lines).read(lines), options.component);
    const double factor = scale(component.units, options.units);
    for (double& n : component.acceleration) n *= factor;
    std::string name = component.title.empty() ? printable(file.stem().string(), 256) : std::move(component.title);
    if (component.times.empty())
      return {std::move(component.acceleration), component.dt, Interpolation::linear, std::move(name)};
    return {std::move(component.acceleration), std::move(component.times), Interpolation::linear, std::move(name)};
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("read_record: " + printable(file.string(), 4096) + ": " + error.what());
  }
}

}  // namespace stickslip
