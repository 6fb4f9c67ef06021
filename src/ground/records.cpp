#include "stickslip/ground/records.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "stickslip/error.hpp"
#include "stickslip/units.hpp"

namespace stickslip {
namespace {

namespace fs = std::filesystem;

using Lines = std::vector<std::string_view>;

/// One component as its file gives it.
struct Component {
  std::string name{};  // empty where the format has none
  std::string title{};
  std::string units{};  // empty where the file states none
  double dt = 0;        // unless there are times
  std::vector<double> times{};
  std::vector<double> acceleration{};
};

// ---- text

bool is_blank(char c) { return c == ' ' || c == '\t'; }

bool is_separator(char c) { return is_blank(c) || c == ',' || c == ';'; }

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool same(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](char x, char y) { return lower(x) == lower(y); });
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Bytes of the UTF-8 sequence at the front of `text`, or 0.
std::size_t sequence(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  const std::size_t length = lead < 0x80   ? 1
                             : lead < 0xC0 ? 0
                             : lead < 0xE0 ? 2
                             : lead < 0xF0 ? 3
                             : lead < 0xF8 ? 4
                                           : 0;
  const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; };
  return length > 0 && length <= text.size() && std::ranges::all_of(text.substr(1, length - 1), continues) ? length : 0;
}

/// Whether a sequence is a character: no overlong form, no surrogate, nothing above U+10FFFF.
bool is_character(std::string_view sequence) {
  const auto bytes = [sequence](std::size_t count) {
    unsigned value = 0;
    for (const char c : sequence.substr(0, count)) value = value << 8 | static_cast<unsigned char>(c);
    return value;
  };
  switch (sequence.size()) {
    case 1:
      return true;
    case 2:
      return bytes(1) >= 0xC2;
    case 3:
      return bytes(2) >= 0xE0A0 && bytes(2) / 0x20 != 0xEDA0 / 0x20;
    case 4:
      return bytes(2) >= 0xF090 && bytes(2) < 0xF490;
    default:
      return false;
  }
}

/// Text from outside as valid UTF-8 of at most `longest` bytes, with blanks for control characters.
std::string printable(std::string_view text, std::size_t longest) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = sequence(text);
    std::string_view shown = text.substr(0, length);
    if (!is_character(shown)) shown = "\xEF\xBF\xBD";  // U+FFFD, the replacement character
    if ((shown >= "\0" && shown < " ") || shown == "\x7F" || (shown >= "\xC2\x80" && shown < "\xC2\xA0")) shown = " ";
    if (result.size() + shown.size() > longest) return result + "...";
    result += shown;
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return result;
}

/// A name in a file, every run of blanks as one.
std::string squeeze(std::string_view text) {
  constexpr std::size_t longest = 256;  // each channel of a file repeats the names of event and station
  std::string result;
  for (const char c : printable(trim(text), longest))
    if (c != ' ' || !(result.empty() || result.back() == ' ')) result += c;
  if (result.ends_with(' ')) result.pop_back();
  return result;
}

/// Without the blanks and the one comma or semicolon at the front.
std::string_view after_separator(std::string_view text) {
  text = trim(text);
  if (text.starts_with(',') || text.starts_with(';')) text = trim(text.substr(1));
  return text;
}

/// Where `key` starts in `text`, in upper or lower case, or npos.
std::size_t find(std::string_view text, std::string_view key) {
  const auto found = std::ranges::search(text, key, [](char a, char b) { return lower(a) == lower(b); });
  return found.empty() && !key.empty() ? std::string_view::npos
                                       : static_cast<std::size_t>(found.begin() - text.begin());
}

bool has(std::string_view text, std::string_view key) { return find(text, key) != std::string_view::npos; }

std::string_view before(std::string_view text, std::string_view key) { return text.substr(0, find(text, key)); }

std::string_view after(std::string_view text, std::string_view key) {
  const std::size_t at = find(text, key);
  return at == std::string_view::npos ? std::string_view() : text.substr(at + key.size());
}

/// The beginning of a text, for a message.
std::string quote(std::string_view text) { return "'" + printable(trim(text), 48) + "'"; }

std::string joined(std::initializer_list<std::string> parts) {
  std::string result;
  for (const std::string& part : parts)
    if (!part.empty()) result += (result.empty() ? "" : ", ") + part;
  return result;
}

[[noreturn]] void refuse_line(std::size_t index, const std::string& message) {
  throw std::invalid_argument("line " + std::to_string(index + 1) + ": " + message);
}

// ---- numbers

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_sign(char c) { return c == '+' || c == '-'; }

/// The number at the front of a text, as C or Fortran print it: +.5, 1.0D-03.
///
/// Fortran leaves out the letter of a large exponent: 1.234-100 is 1.234E-100, while 1.234-100.5 are two numbers.
struct Numeral {
  explicit Numeral(std::string_view text) {
    const auto is = [text](std::size_t at, auto... kinds) { return at < text.size() && (kinds(text[at]) || ...); };
    const auto digits = [&](std::size_t at) {
      while (is(at, is_digit)) ++at;
      return at;
    };
    const auto is_point = [](char c) { return c == '.'; };
    const auto is_letter = [](char c) { return lower(c) == 'e' || lower(c) == 'd'; };

    const std::size_t start = is(0, is_sign) ? 1 : 0, whole = digits(start);
    const bool point = is(whole, is_point);
    mantissa = point ? digits(whole + 1) : whole;
    if (mantissa == start + (point ? 1 : 0)) return;
    exponent = end = mantissa;

    const bool letter = is(mantissa, is_letter);
    const std::size_t first = mantissa + (letter ? 1 : 0), figures = first + (is(first, is_sign) ? 1 : 0);
    const std::size_t last = digits(figures);
    if (last == figures || !(letter || (point && figures > first && !is(last, is_point, is_letter)))) return;
    exponent = first;
    end = last;
  }

  std::size_t mantissa = 0;  ///< where it ends
  std::size_t exponent = 0;  ///< where its sign or first digit is; `mantissa` if there is neither it nor a letter
  std::size_t end = 0;       ///< 0 if the text starts with no number
};

/// Takes the finite number at the front of `text`.
std::optional<double> take_number(std::string_view& text) {
  const Numeral numeral(text);
  std::string_view token = text.substr(0, numeral.end);
  std::string standard;
  if (numeral.end > numeral.mantissa && lower(token[numeral.mantissa]) != 'e') {
    standard.append(token.substr(0, numeral.mantissa)).append("e").append(token.substr(numeral.exponent));
    token = standard;
  }
  if (token.starts_with('+')) token.remove_prefix(1);  // from_chars takes no plus
  double value = 0;
  if (std::from_chars(token.data(), token.data() + token.size(), value).ec != std::errc()) return std::nullopt;
  text.remove_prefix(numeral.end);
  return value;
}

/// Appends the numbers of a line, and returns where one fails, or nothing.
///
/// A sign may part two numbers. Columns of `width` characters are resorted to where numbers run together
/// without one: a file's own word on its columns is less sure than its blanks.
std::string_view append_numbers(std::vector<double>& values, std::string_view line, std::size_t width) {
  const std::size_t count = values.size();
  for (std::string_view rest = trim(line); !rest.empty(); rest = trim(rest)) {
    const std::string_view here = rest;
    const std::optional<double> value = take_number(rest);
    if (!value || !(rest.empty() || is_blank(rest[0]) || is_sign(rest[0]))) {
      if (width == 0) return here;
      values.resize(count);
      for (std::size_t column = 0; column < line.size(); column += width) {
        std::string_view field = trim(line.substr(column, width));
        if (field.empty()) continue;
        const std::optional<double> fixed = take_number(field);
        if (!fixed || !field.empty()) return here;
        values.push_back(*fixed);
      }
      return {};
    }
    values.push_back(*value);
  }
  return {};
}

/// The number after a label, as in `DT= .01`, or nothing; `rest` becomes what follows it.
std::optional<double> labeled_number(std::string_view line, std::string_view label, std::string_view& rest) {
  const auto in_word = [](char c) { return is_digit(c) || (lower(c) >= 'a' && lower(c) <= 'z'); };
  std::size_t at = 0;
  for (std::size_t skip; (skip = find(line.substr(at), label)) != std::string_view::npos;) {
    at += skip;
    const bool starts = at == 0 || !in_word(line[at - 1]);
    at += label.size();
    if (!starts || (at < line.size() && in_word(line[at]))) continue;
    rest = trim(line.substr(at));
    if (rest.starts_with('=') || rest.starts_with(':')) rest = trim(rest.substr(1));
    const std::optional<double> value = take_number(rest);
    return rest.starts_with('.') || (!rest.empty() && is_sign(rest[0])) ? std::nullopt : value;
  }
  return std::nullopt;
}

std::size_t as_count(double value, std::size_t line, std::string_view what) {
  if (!(value >= 0 && value < 1e15 && value == std::floor(value)))
    refuse_line(line, "the number of " + std::string(what) + " must be a whole number, got " + detail::shortest(value));
  return static_cast<std::size_t>(value);
}

/// Reads on from line to line.
class Reader {
 public:
  explicit Reader(const Lines& lines) : lines_(lines) {}

  /// The next line that is not blank; `what` is said to be missing where there is none.
  std::string_view line(const std::string& what) {
    if (done()) throw std::invalid_argument("the file ends before its " + what);
    return lines_[at_++];
  }

  /// The next `count` lines, as they stand.
  Lines block(std::size_t count, const std::string& what) {
    if (count > lines_.size() - at_) throw std::invalid_argument("the file ends within its " + what);
    const auto first = lines_.begin() + static_cast<std::ptrdiff_t>(at_);
    at_ += count;
    return {first, first + static_cast<std::ptrdiff_t>(count)};
  }

  /// The next `count` numbers, on lines of their own.
  std::vector<double> numbers(std::size_t count, const std::string& what, std::size_t width = 0) {
    std::vector<double> values;
    const std::string stated = std::to_string(count) + " " + what + " its header states";
    for (; values.size() < count; ++at_) {
      if (at_ == lines_.size())
        throw std::invalid_argument("the file ends after " + std::to_string(values.size()) + " of the " + stated);
      const std::string_view failed = append_numbers(values, lines_[at_], width);
      if (!failed.empty())
        refuse_line(at_, "expected number " + std::to_string(values.size() + 1) + " of the " + stated + ", got " +
                             quote(failed));
    }
    if (values.size() > count) refuse_line(at_ - 1, "more than the " + stated);
    return values;
  }

  bool done() {
    while (at_ < lines_.size() && trim(lines_[at_]).empty()) ++at_;
    return at_ == lines_.size();
  }

  /// Refuses to go on from a line that should not be there.
  void require_end(std::size_t samples) {
    if (!done()) refuse_line(at_, "more than the " + std::to_string(samples) + " samples the header states");
  }

  std::string_view peek() { return done() ? std::string_view() : lines_[at_]; }

  /// Index of the line last taken.
  std::size_t last() const { return at_ - 1; }

 private:
  const Lines& lines_;
  std::size_t at_ = 0;
};

/// What a line says after "unit": `units of G.`, `units=cm/sec2(04)`, `Unit: m/s^2`.
std::string stated_units(std::string_view line) {
  std::string_view rest = after(line, "unit");
  if (!rest.empty() && lower(rest[0]) == 's') rest.remove_prefix(1);
  const std::size_t start = rest.find_first_not_of(" \t:=");
  if (start == 0 || start == std::string_view::npos) return {};  // another word, as United
  rest.remove_prefix(start);
  if (same(rest.substr(0, 3), "of ")) rest = trim(rest.substr(3));
  rest = rest.substr(0, rest.find_first_of(" \t,;("));
  while (rest.ends_with('.')) rest.remove_suffix(1);
  return std::string(rest);
}

// ---- PEER AT2

bool is_peer(const Lines& lines) { return lines.size() > 3 && has(lines[3], "NPTS") && has(lines[3], "DT"); }

bool is_second(std::string_view unit) {
  constexpr std::string_view names[] = {"s", "sec", "secs", "second", "seconds"};
  return std::ranges::any_of(names, [unit](std::string_view name) { return same(unit, name); });
}

std::vector<Component> read_peer(const Lines& lines) {
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

  Component component{.title = squeeze(lines[1]), .units = stated_units(lines[2]), .dt = *dt};
  Reader reader(lines);
  reader.block(4, "header");
  component.acceleration = reader.numbers(samples, "samples");
  reader.require_end(samples);
  return {component};
}

// ---- COSMOS V1, V2

bool is_cosmos(const Lines& lines) { return has(lines[0], "(Format v"); }

/// Columns of a Fortran format as `Format=(8F10.5)`, or 0.
std::size_t stated_width(std::string_view line) {
  std::string_view rest = after(after(line, "Format="), "(");
  while (!rest.empty() && is_digit(rest[0])) rest.remove_prefix(1);
  std::size_t width = 0;
  if (!rest.empty()) std::from_chars(rest.data() + 1, rest.data() + rest.size(), width);
  return width;
}

/// The number that starts a line as `100 Real-header values follow on 20 lines`.
std::size_t leading_count(const Reader& reader, std::string_view line, const std::string& what) {
  std::string_view rest = trim(line);
  const std::optional<double> count = take_number(rest);
  if (!count || !has(rest, what)) refuse_line(reader.last(), "expected a number of " + what + ", got " + quote(line));
  return as_count(*count, reader.last(), what);
}

std::vector<Component> read_cosmos(const Lines& lines) {
  std::vector<Component> components;
  Reader reader(lines);
  while (!reader.done()) {
    const std::string_view first = reader.line("header");
    if (!is_cosmos({first})) refuse_line(reader.last(), "expected the header of another channel, got " + quote(first));

    Component channel;
    std::string event, station;
    std::string_view line = reader.line("integer header");
    for (; !has(line, "Integer-header"); line = reader.line("integer header")) {
      if (has(line, "Record of ")) event = squeeze(after(line, "Record of "));
      if (has(line, "Code:")) station = squeeze(after(line, "Code:"));
      if (has(line, "Sta Chan")) channel.name = squeeze(before(after(line, ":"), "("));
    }
    reader.numbers(leading_count(reader, line, "Integer-header"), "integers", stated_width(line));

    line = reader.line("real header");
    const std::size_t header_line = reader.last();
    const std::vector<double> real =
        reader.numbers(leading_count(reader, line, "Real-header"), "reals", stated_width(line));
    if (real.size() < 62) refuse_line(header_line, "the time step is real 62, got " + std::to_string(real.size()));
    channel.dt = real[61] / 1000;

    line = reader.line("comments");
    for (std::string_view comment : reader.block(leading_count(reader, line, "Comment"), "comments"))
      if (has(comment, "SCNL")) {  // station, channel, network, location
        const std::string_view code = after(comment, ".");
        channel.name = squeeze(code.substr(0, code.find('.')));
      }
    channel.title = joined({event, station, channel.name});

    // Velocity and displacement may follow, with a header of their own or without.
    while (has(reader.peek(), " pts")) {
      line = reader.line("samples");
      const std::size_t samples = leading_count(reader, line, "pts");
      const std::vector<double> values = reader.numbers(samples, "samples", stated_width(line));
      if (same(trim(reader.peek()).substr(0, 3), "End"))
        reader.line("end");
      else if (!is_cosmos({reader.peek()}))
        reader.require_end(samples);
      if (!has(line, "accel")) continue;
      channel.units = stated_units(line);
      channel.acceleration = values;
      components.push_back(channel);
    }
  }
  if (components.empty()) throw std::invalid_argument("no channel of this COSMOS file holds acceleration");
  return components;
}

// ---- GeoNet V1A, V2A

bool is_geonet(const Lines& lines) {
  return has(lines[0], "corrected accelerogram") && lines.size() > 12 && lines[12].starts_with("Component");
}

std::vector<Component> read_geonet(const Lines& lines) {
  constexpr std::size_t columns = 10, width = 8;
  std::vector<Component> components;
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

    Component component{.units = "mm/s^2", .dt = real[25]};
    component.name = squeeze(before(trim(after(text[12], "Component")), " "));
    component.title =
        joined({squeeze(text[6]), squeeze(before(text[7], "  ")),
                squeeze(before(trim(after(text[1], "Site")), " ")) + " " + squeeze(text[2]), component.name});
    component.acceleration = reader.numbers(samples(34), "samples", width);
    reader.block((samples(35) + columns - 1) / columns, "velocities");
    reader.block((samples(36) + columns - 1) / columns, "displacements");
    components.push_back(std::move(component));
  }
  return components;
}

// ---- USGS SMC

bool is_smc(const Lines& lines) {
  const std::string_view type = trim(lines[0]);
  if (type.size() < 2 || type[0] < '0' || type[0] > '6' || type[1] != ' ') return false;
  constexpr std::string_view types[] = {"ACCELEROGRAM", "UNKNOWN", "VELOCITY", "DISPLACEMENT", "SPECTRA"};
  return std::ranges::any_of(types, [type](std::string_view name) { return has(type, name); });
}

std::vector<Component> read_smc(const Lines& lines) {
  if (!has(lines[0], "ACCELEROGRAM")) refuse_line(0, "an accelerogram is needed, this file holds " + quote(lines[0]));
  Reader reader(lines);
  const Lines text = reader.block(11, "heading of 11 lines");
  const std::vector<double> integer = reader.numbers(48, "integers");
  const std::vector<double> real = reader.numbers(50, "reals");
  reader.block(as_count(integer[15], 12, "comments"), "comments");
  const std::size_t samples = as_count(integer[16], 13, "samples");
  if (const double unknown = real[0], rate = real[1]; !(rate > 0) || rate == unknown)
    refuse_line(17, "the sampling rate must be known and positive, got " + detail::shortest(rate) + " 1/s");

  Component component{.units = "cm/s^2", .dt = 1 / real[1]};
  component.name = squeeze(after(text[5], "component="));
  const auto known = [](std::string_view line) { return trim(line) == "*" ? std::string() : squeeze(line); };
  component.title =
      joined({known(text[3]), squeeze(before(after(text[5], "station ="), "component=")), component.name});
  component.acceleration = reader.numbers(samples, "samples");
  reader.require_end(samples);
  return {component};
}

// ---- two-column text

/// Whether a line starts with a number, be it NaN or infinite.
bool is_row(std::string_view line) {
  line = trim(line);
  const std::string_view token = line.substr(0, line.find_first_of(" \t,;"));
  const std::string_view word = token.substr(!token.empty() && is_sign(token[0]) ? 1 : 0);
  return !token.empty() && (Numeral(token).end == token.size() || same(word.substr(0, 3), "nan") || same(word, "inf") ||
                            same(word, "infinity"));
}

std::size_t first_row(const Lines& lines) {
  return static_cast<std::size_t>(std::ranges::find_if(lines, is_row) - lines.begin());
}

bool is_table(const Lines& lines) { return first_row(lines) < lines.size(); }

/// The texts in round or square brackets.
std::vector<std::string_view> bracketed(std::string_view line) {
  std::vector<std::string_view> texts;
  for (std::size_t open = line.find_first_of("(["); open != std::string_view::npos;
       open = line.find_first_of("([", open + 1)) {
    const std::size_t close = line.find(line[open] == '(' ? ')' : ']', open);
    if (close == std::string_view::npos) break;
    texts.push_back(trim(line.substr(open + 1, close - open - 1)));
    open = close;
  }
  return texts;
}

/// Reads units and title from the lines before the rows: units from the lowest line that has them, the title from the
/// topmost comment.
void read_table_header(const Lines& lines, std::size_t rows, Component& component) {
  for (std::size_t i = rows; i-- > 0;) {
    const std::string_view line = trim(lines[i]);
    if (component.units.empty()) {
      const std::vector<std::string_view> labels = bracketed(line);
      if (labels.size() > 1 && !is_second(labels[0]))
        refuse_line(i, "the first column must be time in seconds, its label says " + quote(labels[0]));
      if (labels.size() > 1)
        component.units = labels[1];
      else if (labels.size() == 1 && has(line, "acc") && !is_second(labels[0]))
        component.units = labels[0];
      else
        component.units = stated_units(line);
      if (!component.units.empty()) continue;
    }
    if (!line.starts_with('#')) continue;
    std::string title = squeeze(line.substr(1));
    if (has(title, ": ")) title = squeeze(after(title, ": "));
    while (!title.empty() && is_separator(title.back())) title.pop_back();
    if (!title.empty()) component.title = title;
  }
}

/// How finely times are printed: to so many places, as by %.2f, or to so many digits, as by %.3e and %g.
///
/// Zeros at the end may be left out: the most places and the most digits count.
class Resolution {
 public:
  void add(std::string_view token) {
    const Numeral numeral(token);
    const std::string_view mantissa = token.substr(0, numeral.mantissa);
    std::string_view power = token.substr(numeral.exponent);
    if (power.starts_with('+')) power.remove_prefix(1);
    int exponent = 0;
    std::from_chars(power.data(), power.data() + power.size(), exponent);

    const auto position = [](std::size_t at) { return static_cast<int>(at); };
    const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
    const int places = position(mantissa.size() - std::min(point + 1, mantissa.size()));
    most_places_ = std::max(most_places_, places - exponent);
    const std::size_t first = mantissa.find_first_of("123456789");
    if (first == std::string_view::npos) return decades_.push_back(std::numeric_limits<int>::min() / 2);
    const int before = position(point) - position(first);  // digits before the point; negative: zeros after it
    decades_.push_back((before > 0 ? before - 1 : before) + exponent);
    most_digits_ = std::max(most_digits_, (before > 0 ? before : before + 1) + places);
  }

  /// One unit of the last place of each time [s].
  std::vector<double> units() const {
    std::vector<double> units;
    units.reserve(decades_.size());
    for (int previous = 0; const int decade : decades_) {
      const int exponent = std::max(-most_places_, decade + 1 - most_digits_);
      units.push_back(!units.empty() && exponent == previous ? units.back() : std::pow(10., exponent));
      previous = exponent;
    }
    return units;
  }

 private:
  int most_places_ = std::numeric_limits<int>::min() / 2;
  int most_digits_ = 0;
  std::vector<int> decades_{};  // of the first digit of each time
};

/// The smallest step with which even times can lie between two bounds each.
///
/// It is the steepest line from an upper bound to a later lower one. A line that is not steep enough is replaced by the
/// one that exceeds it most, until none does.
double smallest_step(const std::vector<double>& lower, const std::vector<double>& upper) {
  const std::size_t last = lower.size() - 1;
  for (double step = (lower[last] - upper[0]) / static_cast<double>(last);;) {
    double steeper = step, most = 0, lowest = upper[0];
    for (std::size_t i = 1, from = 0; i <= last; ++i) {
      const double line = static_cast<double>(i) * step;
      if (const double excess = lower[i] - line - lowest; excess > most) {
        most = excess;
        steeper = (lower[i] - upper[from]) / static_cast<double>(i - from);
      }
      if (const double top = upper[i] - line; top < lowest) {
        lowest = top;
        from = i;
      }
    }
    if (!(steeper > step)) return step;
    step = steeper;
  }
}

/// The step of times that are even as far as they are printed: the shortest decimal that fits them all.
std::optional<double> even_step(const std::vector<double>& times, const std::vector<double>& units) {
  const std::size_t count = times.size();
  const double length = times.back() - times.front(), mean = length / static_cast<double>(count - 1);
  const double coarsest = *std::ranges::max_element(units);
  const double farthest = std::max(std::abs(times.front()), std::abs(times.back()));
  const double sums =
      2 * static_cast<double>(count) * std::numeric_limits<double>::epsilon() * farthest;  // if added up
  if (!std::isfinite(length)) return std::nullopt;
  // Rounding explains uneven steps only where a missing sample could not hide in it, and in more than a handful. A
  // tenth more than a print's rounding is for times computed in single precision.
  for (const double rounding : {0., 0.55}) {
    if (rounding > 0 && (mean < 2 * coarsest || length < 100 * coarsest)) break;
    std::vector<double> lower(count), upper(count), minus_lower(count), minus_upper(count);
    for (std::size_t i = 0; i < count; ++i) {
      const double margin = rounding * units[i] + sums;
      minus_lower[i] = -(lower[i] = times[i] - times[0] - margin);
      minus_upper[i] = -(upper[i] = times[i] - times[0] + margin);
    }
    const double smallest = smallest_step(lower, upper), largest = -smallest_step(minus_upper, minus_lower);
    if (!(smallest <= largest)) continue;
    const double middle = smallest / 2 + largest / 2;
    for (double power = 1; std::abs(middle) * power < 1e15; power *= 10)
      if (const double dt = std::round(middle * power) / power; smallest <= dt && dt <= largest)
        return dt + 0.;  // no -0
    return middle;
  }
  return std::nullopt;
}

std::size_t count_columns(std::string_view row) {
  std::size_t columns = 1;
  for (row = trim(row); !row.empty(); row.remove_prefix(1)) {
    if (!is_separator(row[0])) continue;
    ++columns;
    bool mark = !is_blank(row[0]);  // blanks around one comma belong to it
    while (row.size() > 1 && (is_blank(row[1]) || (!mark && is_separator(row[1])))) {
      row.remove_prefix(1);
      mark = mark || !is_blank(row[0]);
    }
  }
  return columns;
}

/// Whether a line before the first row looks like a row whose time cannot be read, as `****, 0.1`.
bool is_row_without_time(std::string_view line) {
  line = trim(line);
  const std::size_t end = std::min(line.find_first_of(" \t,;"), line.size());
  const auto is_mark = [](char c) { return c == '*' || c == '.' || is_sign(c) || is_digit(c); };
  if (line.empty() || !std::ranges::all_of(line.substr(0, end), is_mark)) return false;
  std::string_view second = after_separator(line.substr(end));
  return take_number(second) && second.empty();
}

std::string known_formats();

std::vector<Component> read_table(const Lines& lines) {
  Component component;
  const std::size_t rows = first_row(lines);
  for (std::size_t i = 0; i < rows; ++i)
    if (is_row_without_time(lines[i])) refuse_line(i, "expected two finite numbers, got " + quote(lines[i]));
  read_table_header(lines, rows, component);

  Resolution resolution;
  for (std::size_t i = rows; i < lines.size(); ++i) {
    const std::string_view row = trim(lines[i]);
    if (row.empty()) continue;
    std::string_view rest = row;
    const std::optional<double> time = take_number(rest);
    const std::string_view token = row.substr(0, row.size() - rest.size());
    const std::string_view separated = rest;
    rest = after_separator(rest);
    const bool parted = rest.size() < separated.size();
    const std::string_view second = rest;
    const std::optional<double> acceleration = take_number(rest);
    if (!time || !parted || !acceleration || !rest.empty()) {
      if (const std::size_t columns = count_columns(row); columns != 2)
        refuse_line(i, "two columns are needed, time [s] and acceleration, got " + std::to_string(columns) + " in " +
                           quote(row) + (i == rows ? "; known formats are: " + known_formats() : ""));
      refuse_line(i, "expected two finite numbers, got " + quote(time && parted && !second.empty() ? second : row));
    }
    resolution.add(token);
    component.times.push_back(*time);
    component.acceleration.push_back(*acceleration);
  }
  if (component.times.size() < 2) refuse_line(rows, "at least two rows of numbers are needed, got 1");
  if (const std::optional<double> dt = even_step(component.times, resolution.units())) {
    component.dt = *dt;
    component.times.clear();
  }
  return {component};
}

// ---- the formats

/// A format is a row here and a function that reads it.
struct Format {
  std::string_view name;
  bool (*recognizes)(const Lines&);
  std::vector<Component> (*read)(const Lines&);
};

constexpr Format formats[] = {
    {"COSMOS V1 and V2", is_cosmos, read_cosmos},
    {"GeoNet V1A and V2A", is_geonet, read_geonet},
    {"USGS SMC", is_smc, read_smc},
    {"PEER AT2", is_peer, read_peer},
    {"two columns of seconds and acceleration", is_table, read_table},  // last: it takes whatever has a number
};

std::string known_formats() {
  std::string known;
  for (const Format& format : formats) known.append(known.empty() ? "" : "; ").append(format.name);
  return known;
}

const Format& recognize(const Lines& lines) {
  const auto* const format = std::ranges::find_if(formats, [&](const Format& f) { return f.recognizes(lines); });
  if (format == std::end(formats))
    throw std::invalid_argument("no known format of records; known are: " + known_formats());
  return *format;
}

// ---- the file

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

Component choose(std::vector<Component> components, const std::string& wanted) {
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
    Component component = choose(recognize(lines).read(lines), options.component);
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
