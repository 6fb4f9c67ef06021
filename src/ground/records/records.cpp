#include "stickslip/ground/records.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "ground/records/formats.hpp"
#include "ground/records/text.hpp"
#include "ground/records/units.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/ground/orientation.hpp"

namespace stickslip {
namespace {

namespace fs = std::filesystem;
using namespace records;

/// The number of bytes before the first one that is not ASCII.
std::size_t ascii_length(std::string_view text) {
  std::size_t at = 0;
  for (std::uint64_t eight = 0; at + sizeof eight <= text.size(); at += sizeof eight) {
    std::memcpy(&eight, text.data() + at, sizeof eight);
    if ((eight & 0x8080808080808080U) != 0) break;
  }
  while (at < text.size() && static_cast<unsigned char>(text[at]) < 0x80) ++at;
  return at;
}

bool is_utf8(std::string_view text) {
  for (text.remove_prefix(ascii_length(text)); !text.empty(); text.remove_prefix(ascii_length(text))) {
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

/// The text of a file in UTF-16, in the order of its bytes; a lone surrogate becomes U+FFFD.
std::string utf16_to_utf8(std::string_view text, bool little) {
  std::string result;
  const auto unit = [&](std::size_t i) {
    const auto low = static_cast<unsigned char>(text[i + (little ? 0 : 1)]),
               high = static_cast<unsigned char>(text[i + (little ? 1 : 0)]);
    return static_cast<std::uint32_t>(high << 8 | low);
  };
  const auto is_half = [](std::uint32_t code, std::uint32_t which) { return (code & 0xFC00) == which; };
  for (std::size_t i = 0; i + 1 < text.size(); i += 2) {
    std::uint32_t code = unit(i);
    if (is_half(code, 0xD800) && i + 3 < text.size() && is_half(unit(i + 2), 0xDC00)) {
      code = 0x10000 + ((code & 0x3FF) << 10) + (unit(i + 2) & 0x3FF);
      i += 2;
    } else if (is_half(code, 0xD800) || is_half(code, 0xDC00)) {
      code = 0xFFFD;
    }
    const auto add = [&](std::uint32_t bits) { result += static_cast<char>(bits); };
    if (code < 0x80) {
      add(code);
    } else if (code < 0x800) {
      add(0xC0 | code >> 6);
    } else if (code < 0x10000) {
      add(0xE0 | code >> 12);
    } else {
      add(0xF0 | code >> 18);
    }
    if (code >= 0x10000) add(0x80 | (code >> 12 & 0x3F));
    if (code >= 0x800) add(0x80 | (code >> 6 & 0x3F));
    if (code >= 0x80) add(0x80 | (code & 0x3F));
  }
  return result;
}

/// The text of a file in UTF-8, without its byte-order mark and what fills its last block: zeros, DOS end marks.
std::string decoded(std::string text) {
  const std::string_view mark = std::string_view(text).substr(0, 2);
  if (mark == "\xFF\xFE" || mark == "\xFE\xFF")
    text = utf16_to_utf8(std::string_view(text).substr(2), mark[0] == '\xFF');
  constexpr std::string_view filling("\0\x1A \t\r\n", 6);
  text.resize(text.find_last_not_of(filling) + 1);  // 0 if there is nothing else
  if (const std::size_t at = text.find('\0'); at != std::string::npos)
    throw std::invalid_argument("plain text is needed, got a NUL byte at offset " + std::to_string(at) +
                                " (a binary file, or UTF-16 without its byte-order mark)");
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  if (!is_utf8(text)) text = latin1_to_utf8(text);
  return text;
}

/// The lines of a text, whose ends are LF, CRLF, or CR alone; without DOS end marks at their ends.
Lines split(std::string_view text) {
  const char end_of_line = text.find('\n') == std::string_view::npos ? '\r' : '\n';
  Lines lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(end_of_line), text.size());
    std::string_view line = text.substr(0, end);
    while (line.ends_with('\r') || line.ends_with('\x1A')) line.remove_suffix(1);
    lines.push_back(line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  if (std::ranges::all_of(lines, [](std::string_view line) { return trim(line).empty(); }))
    throw std::invalid_argument("the file is empty");
  return lines;
}

// ---- the caller's request

[[noreturn]] void refuse_choice(const std::vector<Channel>& channels, const std::string& wanted) {
  constexpr std::size_t longest = 12;
  std::string known;
  for (std::size_t i = 0; i < std::min(longest, channels.size()); ++i)
    known += (i == 0 ? "" : ", ") + std::to_string(i + 1) + (channels[i].name.empty() ? "" : " ") +
             printable(channels[i].name, 24);
  if (channels.size() > longest) known += " and so on to " + std::to_string(channels.size());
  throw std::invalid_argument("select one component by name or number, available: " + known + "; got " +
                              quote(wanted.starts_with('#') ? wanted.substr(1) : wanted));
}

/// The requested ones: all if `wanted` is empty, otherwise the one with that name or number.
std::vector<Channel> choose(std::vector<Channel> channels, const std::string& wanted) {
  if (wanted.empty()) return channels;
  std::size_t matches = 0, index = 0;
  const bool number = wanted.starts_with('#');  // never a name
  for (std::size_t i = 0; i < channels.size() && !number; ++i)
    if (same(channels[i].name, wanted) || (!wanted.empty() && same(channels[i].label, wanted))) {
      ++matches;
      index = i;
    }
  // A direction, if one component has it.
  if (const std::string direction = orientation_in(wanted); matches == 0 && !direction.empty() && !is_digit(wanted[0]))
    for (std::size_t i = 0; i < channels.size(); ++i) {
      const std::string other =
          orientation_in(channels[i].orientation.empty() ? channels[i].name : channels[i].orientation);
      if (!other.empty() && azimuth_of(other) == azimuth_of(direction) && upward(other) == upward(direction)) {
        ++matches;
        index = i;
      }
    }
  if (matches == 0) {
    const auto [end, error] = std::from_chars(wanted.data() + (number ? 1 : 0), wanted.data() + wanted.size(), index);
    if (error == std::errc() && end == wanted.data() + wanted.size() && index >= 1 && index <= channels.size()) {
      matches = 1;
      --index;
    }
  }
  if (matches != 1) refuse_choice(channels, wanted);
  return {std::move(channels[index])};
}

/// Rejects a component whose units or time step are neither stated nor given, in one message.
void require_stated(const Channel& channel, const RecordOptions& options) {
  const bool units = !channel.units.empty() || !options.units.empty();
  const bool step = channel.dt || !channel.times.empty() || options.dt;
  if (units && step) return;
  const std::string missing = units  ? "no time step"
                              : step ? "no units of acceleration"
                                     : "no units of acceleration and no time step";
  std::string remedy = units ? "" : "pass units, such as \"g\" or \"m/s^2\"";
  if (!step) remedy += std::string(units ? "" : ", and ") + "pass dt, the seconds between samples";
  const std::string column = units || channel.label.empty() ? "" : ", column " + quote(channel.label);
  throw std::invalid_argument("the file states " + missing + ": " + remedy + column);
}

/// m/s^2 per unit of the file.
double scale(const std::string& stated, const std::string& given) {
  const double factor = acceleration_unit(stated.empty() ? given : stated);
  if (!given.empty() && acceleration_unit(given) != factor)
    throw std::invalid_argument("the file states " + quote(stated) + ", units given are " + quote(given));
  return factor;
}

/// The time step of the file [s].
double step(std::optional<double> stated, std::optional<double> given) {
  if (stated && given && *stated != *given)
    detail::refuse("the file states a time step of " + detail::shortest(*stated) + " s, dt given is", *given, "s");
  return stated ? *stated : *given;
}

/// Rejects a time step more than ten times the median one.
void refuse_gaps(const GroundMotion& motion) {
  std::vector<double> steps;
  for (std::size_t i = 0; i < motion.segments(); ++i) steps.push_back(motion.segment(i).duration);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  const auto seconds = [](double value) {  // differences of times, without their round-off
    char text[32];
    std::snprintf(text, sizeof text, "%.6g s", value);
    return std::string(text);
  };
  for (std::size_t i = 0; i < motion.segments(); ++i)
    if (const double one = motion.segment(i).duration; one > 10 * *middle)
      throw std::invalid_argument("a gap of " + seconds(one) + " after " + seconds(motion.time(i)) +
                                  ", over ten times the median time step, " + seconds(*middle) +
                                  "; pass gaps to keep it as a straight line");
}

/// @param file  the name of a file with one component, otherwise empty
RecordComponent component_of(Channel channel, const std::string& name, const std::string& file,
                             const RecordFormat& format, const RecordOptions& options) {
  require_stated(channel, options);
  const double factor = scale(channel.units, options.units);
  for (double& n : channel.acceleration) n *= factor;
  std::string title = channel.title.empty() ? name : std::move(channel.title);
  std::string orientation = orientation_in(channel.orientation.empty() ? channel.name : channel.orientation);
  RecordSources sources{.format = std::string(format.name)};
  sources.orientation = orientation.empty() ? "name of the file" : "in the file";
  if (orientation.empty()) orientation = orientation_in_file_name(file);
  if (orientation.empty()) sources.orientation.clear();
  const auto from = [](bool stated, std::string place, std::string_view usual) {
    return !stated ? "given" : place.empty() ? std::string(usual) : std::move(place);
  };
  sources.units = from(!channel.units.empty(), std::move(channel.units_from), format.units);
  sources.time_step = from(channel.dt || !channel.times.empty(), std::move(channel.step_from), format.time_step);
  const bool even = channel.times.empty();
  if (!even && options.dt) detail::refuse("the file states the times of its samples, dt given is", *options.dt, "s");
  const GroundMotion motion = even ? GroundMotion(std::move(channel.acceleration), step(channel.dt, options.dt),
                                                  Interpolation::linear, std::move(title))
                                   : GroundMotion(std::move(channel.acceleration), std::move(channel.times),
                                                  Interpolation::linear, std::move(title));
  if (!even && !options.gaps) refuse_gaps(motion);
  std::string units(channel.units.empty() ? "" : acceleration_unit_named(channel.units).name);
  return {motion.with_orientation(std::move(orientation)),
          std::move(channel.name),
          std::move(channel.start),
          std::move(units),
          std::move(channel.sensor),
          std::move(sources)};
}

/// Removes the blank lines at the top. Returns how many there were.
std::size_t drop_blank_lines(Lines& lines) {
  const auto first = std::ranges::find_if(lines, [](std::string_view line) { return !trim(line).empty(); });
  const auto blank = static_cast<std::size_t>(first - lines.begin());
  lines.erase(lines.begin(), first);
  return blank;
}

/// The channels of a file whose first lines were blank.
std::vector<Channel> read(const Format& format, const Lines& lines, std::size_t blank) {
  try {
    return format.read(lines);
  } catch (const BadLine& error) {
    throw std::invalid_argument("line " + std::to_string(error.index + blank + 1) + ": " + error.what());
  }
}

/// All requested components of a file.
std::vector<RecordComponent> parse(std::string content, const std::string& file, const RecordOptions& options,
                                   bool only_one) {
  try {
    const std::string text = decoded(std::move(content));
    Lines lines = split(text);
    const std::size_t blank = drop_blank_lines(lines);
    const Format& format = recognize(lines);
    std::vector<Channel> channels = read(format, lines, blank);
    const bool alone = channels.size() == 1;
    channels = choose(std::move(channels), options.component);
    if (only_one && channels.size() != 1) refuse_choice(channels, options.component);
    const std::size_t mark = file.rfind("::");  // before a file in an archive
    const std::string inner = mark == std::string::npos ? file : file.substr(mark + 2);
    const std::string name = fs::path(inner).stem().string();
    std::vector<RecordComponent> components;
    for (Channel& channel : channels)
      components.push_back(
          component_of(std::move(channel), printable(name, 256), alone ? inner : "", format.about, options));
    return components;
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("read_record: " + printable(file, 4096) + ": " + error.what());
  }
}

}  // namespace

std::optional<RecordFormat> record_format(std::string_view content) {
  try {
    const std::string text = decoded(std::string(content));
    Lines lines = split(text);
    drop_blank_lines(lines);
    return recognize(lines).about;
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

GroundMotion read_record(const fs::path& file, const RecordOptions& options) {
  return std::move(parse(load(file), file.string(), options, true)[0].motion);
}

GroundMotion parse_record(std::string_view content, const std::string& file, const RecordOptions& options) {
  return std::move(parse(std::string(content), file, options, true)[0].motion);
}

std::vector<RecordComponent> read_components(const fs::path& file, const RecordOptions& options) {
  return parse(load(file), file.string(), options, false);
}

std::vector<RecordComponent> parse_components(std::string_view content, const std::string& file,
                                              const RecordOptions& options) {
  return parse(std::string(content), file, options, false);
}

}  // namespace stickslip
