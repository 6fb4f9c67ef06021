#include "ground/records/labels.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <utility>

#include "ground/records/units.hpp"
#include "stickslip/ground/orientation.hpp"

namespace stickslip::records {
namespace {

using Texts = std::initializer_list<std::string_view>;

bool is_letter(char c) { return lower(c) >= 'a' && lower(c) <= 'z'; }

bool is_one_of(std::string_view text, Texts texts) {
  return std::ranges::any_of(texts, [text](std::string_view one) { return same(one, text); });
}

/// The words of a text: runs of letters.
std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at;
    while (end < text.size() && is_letter(text[end])) ++end;
    if (end > at) words.push_back(text.substr(at, end - at));
    at = std::max(end, at + 1);
  }
  return words;
}

struct Words {
  std::string_view what;
  Texts words;
};

/// Words for quantities that are no history of acceleration, also where their unit is one of acceleration.
constexpr std::string_view spectral_value = "a spectral value";
std::string other_quantity(const std::vector<std::string_view>& words) {
  static const Words all[] = {
      {"a velocity", {"vel", "velo", "veloc", "velocity", "velocities", "speed"}},
      {"a displacement", {"disp", "displ", "displacement", "displacements", "drift", "position"}},
      {"a period", {"period", "periods"}},
      {"a frequency", {"freq", "frequency", "frequencies"}},
      {spectral_value, {"sa", "psa", "sv", "psv", "sd", "fas", "psd", "spectrum", "spectra", "spectral", "fourier"}},
      {"a peak", {"peak", "pga", "pgv", "pgd", "max", "maximum", "min", "minimum"}},
      {"a level of yielding", {"ky", "yield"}},
      {"a number of counts", {"counts"}},
      {"a mark of quality", {"quality", "flag", "qc"}},
      {"a temperature", {"temp", "temperature"}},
      {"a force", {"force", "shear"}},
      {"a rotation", {"angle", "rotation", "tilt"}},
      {"a measure of intensity", {"arias", "cav", "intensity"}},
      {"a statement of errors", {"std", "sigma", "error", "noise"}},
  };
  for (const Words& one : all)
    for (const std::string_view word : words)
      if (is_one_of(word, one.words)) return std::string(one.what);
  return {};
}

bool is_acceleration_word(std::string_view word) {
  return is_one_of(word, {"acc", "accel", "acceleration", "accelerations", "accelerogram"});
}

/// Sets quantity, name and seconds by the words of a label whose unit is known.
void set_quantity(Label& label) {
  const std::vector<std::string_view> words = words_of(label.name);
  const auto any = [&](Texts texts) {
    return std::ranges::any_of(words, [&](std::string_view word) { return is_one_of(word, texts); });
  };
  std::string_view whole = trim(label.name);
  while (whole.ends_with('.') || whole.ends_with(':')) whole.remove_suffix(1);
  if (std::string other = other_quantity(words); !other.empty()) {
    label.quantity = Quantity::other;
    label.other = std::move(other);
  } else if (label.quantity == Quantity::other) {
    return;  // by its unit
  } else if (std::ranges::any_of(words, is_acceleration_word)) {
    label.quantity = Quantity::acceleration;
  } else if (whole.empty() && label.unit.empty() && label.quantity == Quantity::unknown) {
    label.quantity = Quantity::index;
  } else if (is_one_of(whole, {"no", "nr", "num", "number", "#", "index", "idx", "i", "row", "sample", "samples",
                               "frame", "point", "points", "step", "id", "line", "count"}) ||
             (any({"time", "sample", "row", "point", "data"}) &&
              any({"step", "number", "no", "nr", "index", "count"})) ||
             any({"timestep", "unnamed"})) {
    label.quantity = Quantity::index;
  } else if (any({"time", "times", "zeit", "tiempo", "temps", "tempo"}) ||
             is_one_of(whole, {"t", "s", "sec", "secs", "second", "seconds"})) {
    label.quantity = Quantity::time;
  } else if (const std::optional<double> seconds = find_time_unit(whole); seconds && label.unit.empty()) {
    label.quantity = Quantity::time;
    label.seconds = *seconds;
  }
}

/// Sets the unit that a text in brackets or at the end of a label names. Returns whether it is one.
bool set_unit(Label& label, std::string_view unit) {
  if (find_acceleration_unit(unit)) {
    label.unit = std::string(trim(unit));
  } else if (const std::optional<double> seconds = find_time_unit(trim(unit))) {
    label.quantity = Quantity::time;
    label.seconds = *seconds;
  } else if (std::string other = quantity_with_unit(unit); !other.empty()) {
    label.quantity = Quantity::other;
    label.other = std::move(other);
  } else {
    return false;
  }
  return true;
}

/// The unit at the end of a name without brackets: `acc_g`, `Acc cm/s2`, `t/ms`, `Time in ms`.
void take_unit_at_end(Label& label) {
  const std::string name = label.name;
  for (std::size_t at = name.find_first_of(" _/"); at != std::string::npos; at = name.find_first_of(" _/", at + 1)) {
    std::string unit = name.substr(at + 1);
    std::ranges::replace(unit, '_', '/');
    const bool of_time = find_time_unit(unit).has_value(), of_acceleration = find_acceleration_unit(unit).has_value();
    // Letters that are units of other quantities, such as N, rather are directions; `acc_s` has no unit of time.
    if (!of_acceleration && !of_time && unit.find('/') == std::string::npos && !is_one_of(unit, {"cm", "mm", "hz"}))
      continue;
    Label shorter;
    shorter.name = std::string(trim(std::string_view(name).substr(0, at)));
    if (of_time) {
      set_quantity(shorter);
      if (shorter.quantity != Quantity::time && !is_one_of(shorter.name, {"time in", "t in"})) continue;
    }
    if (!set_unit(label, unit)) continue;
    label.name = shorter.name;
    if (is_one_of(label.name.substr(label.name.size() - std::min<std::size_t>(label.name.size(), 3)), {" in"}))
      label.name.resize(label.name.size() - 3);
    return;
  }
}

/// The number, and the unit after it or in brackets before it, in `(s) = 0.01`, `= .01 SEC,`; nothing if there is more.
struct Quotient {
  double value;
  std::string unit;
};
std::optional<Quotient> value_of(std::string_view text) {
  std::string unit;
  text = trim(text);
  if (text.starts_with('(') || text.starts_with('[')) {
    const std::size_t close = text.find_first_of(")]");
    if (close == std::string_view::npos) return std::nullopt;
    unit = std::string(trim(text.substr(1, close - 1)));
    text = trim(text.substr(close + 1));
  }
  if (text.starts_with('=') || text.starts_with(':')) text = trim(text.substr(1));
  const std::optional<double> value = take_number(text);
  if (!value) return std::nullopt;
  text = trim(text);
  if (text.starts_with('(') || text.starts_with('[')) text = trim(text.substr(1));
  while (!text.empty() && (text.back() == '.' || text.back() == ')' || text.back() == ']')) text.remove_suffix(1);
  if (!text.empty() && !unit.empty()) return std::nullopt;
  return Quotient{*value, text.empty() ? unit : std::string(trim(text))};
}

}  // namespace

bool Label::is_recognized() const {
  return (quantity != Quantity::unknown && !(quantity == Quantity::index && text.empty())) || !unit.empty() ||
         (words_of(name).size() <= 2 && !orientation_in(name).empty());
}

Label label_of(std::string_view text) {
  text = trim(text);
  Label label{.text = squeeze(text)};
  std::string name;
  std::vector<std::string_view> bracketed;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t open = std::min(text.find_first_of("([", at), text.size());
    name.append(text.substr(at, open - at));
    const std::size_t close = open < text.size() ? text.find(text[open] == '(' ? ')' : ']', open) : text.size();
    if (open < text.size() && close == std::string_view::npos) {
      name.append(text.substr(open));
      break;
    }
    if (open < text.size()) bracketed.push_back(trim(text.substr(open + 1, close - open - 1)));
    at = std::min(close, text.size() - 1) + 1;
  }
  label.name = squeeze(name);
  bool has_unit = false;
  for (auto one = bracketed.rbegin(); one != bracketed.rend() && !has_unit; ++one) has_unit = set_unit(label, *one);
  if (!has_unit) take_unit_at_end(label);
  set_quantity(label);
  // A text in brackets that reads like a unit and is none: a known one must be given.
  if (!has_unit && label.unit.empty() && label.quantity != Quantity::time && label.quantity != Quantity::other)
    for (const std::string_view one : bracketed)
      if (one.find("/s") != std::string_view::npos) label.unit = std::string(one);
  return label;
}

void split_row(std::string_view row, std::vector<std::string_view>& fields) {
  fields.clear();
  row = trim(row);
  for (std::size_t begin = 0, at = 0;; ++at) {
    if (at < row.size() && row[at] == '"' && at == begin) {  // up to the other quotation mark
      const std::size_t close = row.find('"', at + 1);
      if (close != std::string_view::npos) {
        begin = at + 1;
        at = close;
        fields.push_back(trim(row.substr(begin, at - begin)));
        if (++at >= row.size()) return;
        if (is_separator(row[at])) {
          bool mark = !is_blank(row[at]);
          while (at + 1 < row.size() && (is_blank(row[at + 1]) || (!mark && is_separator(row[at + 1])))) {
            ++at;
            mark = mark || !is_blank(row[at]);
          }
          begin = at + 1;
          if (begin == row.size() && mark) fields.push_back({});
          if (begin == row.size()) return;
          continue;
        }
        begin = at;
        continue;
      }
    }
    if (at < row.size() && !is_separator(row[at])) continue;
    fields.push_back(row.substr(begin, at - begin));
    if (at == row.size()) return;
    bool mark = !is_blank(row[at]);
    while (at + 1 < row.size() && (is_blank(row[at + 1]) || (!mark && is_separator(row[at + 1])))) {
      ++at;
      mark = mark || !is_blank(row[at]);
    }
    begin = at + 1;
  }
}

std::vector<Label> labels_in(std::string_view line, std::size_t columns) {
  line = without_mark(line);
  // First at commas, semicolons and tabs, and at two blanks; then at each blank.
  const auto at_marks = [&] {
    std::vector<std::string_view> parts;
    std::size_t begin = 0;
    bool quoted = false;
    for (std::size_t at = 0; at <= line.size(); ++at) {
      if (at < line.size() && line[at] == '"') quoted = !quoted;
      if (at < line.size() && (quoted || (line[at] != ',' && line[at] != ';' && line[at] != '\t'))) continue;
      parts.push_back(line.substr(begin, at - begin));
      if (at < line.size() && line[at] != '\t')  // a mark, and blanks after it
        while (at + 1 < line.size() && is_blank(line[at + 1])) ++at;
      begin = at + 1;
    }
    return parts;
  };
  const auto at_blanks = [&](std::size_t fewest) {
    std::vector<std::string_view> parts;
    std::size_t begin = 0, blanks = 0;
    for (std::size_t at = 0; at <= line.size(); ++at) {
      if (at < line.size() && is_blank(line[at])) {
        ++blanks;
        continue;
      }
      const bool of_label = at < line.size() && (line[at] == '(' || line[at] == '[');  // a unit after its name
      if (at == line.size() || (blanks >= fewest && at > begin && !of_label)) {
        parts.push_back(trim(line.substr(begin, at - begin)));
        begin = at;
      }
      blanks = 0;
    }
    return parts;
  };
  for (std::vector<std::string_view> parts : {at_marks(), at_blanks(2), at_blanks(1)}) {
    while (parts.size() > columns && trim(parts.back()).empty()) parts.pop_back();  // of a spreadsheet
    if (parts.size() != columns) continue;
    std::vector<Label> labels;
    for (std::string_view part : parts) {
      part = trim(part);
      if (part.size() > 1 && part.front() == '"' && part.back() == '"') part = part.substr(1, part.size() - 2);
      labels.push_back(label_of(part));
    }
    if (std::ranges::any_of(labels, &Label::is_recognized)) return labels;
  }
  return {};
}

bool is_comment(std::string_view line) {
  line = trim(line);
  return line.starts_with('#') || line.starts_with('%') || line.starts_with('!') || line.starts_with("//");
}

std::string_view without_mark(std::string_view line) {
  line = trim(line);
  while (!line.empty() && (line[0] == '#' || line[0] == '%' || line[0] == '!' || line[0] == '/'))
    line = trim(line.substr(1));
  return line;
}

std::vector<std::string> units_in(std::string_view line, std::size_t columns) {
  line = without_mark(line);
  // What may stand before the unit.
  bool says_unit = false, says_acceleration = false;
  for (std::string_view rest = line;;) {
    std::size_t end = 0;
    while (end < rest.size() && is_letter(rest[end])) ++end;
    const std::string_view word = rest.substr(0, end);
    const bool of_unit = is_one_of(word, {"unit", "units"}), of_acceleration = is_acceleration_word(word);
    if (!of_unit && !of_acceleration &&
        !is_one_of(word,
                   {"ground", "motion", "time", "series", "history", "data", "values", "in", "the", "of", "are", "is"}))
      break;
    says_unit = says_unit || of_unit;
    says_acceleration = says_acceleration || of_acceleration;
    rest = trim(rest.substr(end));
    if (rest.starts_with(':') || rest.starts_with('=')) rest = trim(rest.substr(1));
    line = rest;
  }
  const auto bare = [](std::string_view text) {
    text = trim(text);
    if (text.size() > 1 && (text[0] == '(' || text[0] == '[') && (text.back() == ')' || text.back() == ']'))
      text = trim(text.substr(1, text.size() - 2));
    while (text.ends_with('.')) text.remove_suffix(1);
    return text;
  };
  if (find_acceleration_unit(bare(line))) return {std::string(bare(line))};
  // A unit for each column.
  std::vector<std::string_view> fields;
  split_row(line, fields);
  while (fields.size() > columns && trim(fields.back()).empty()) fields.pop_back();
  std::vector<std::string> units;
  bool known = !fields.empty();
  for (const std::string_view field : fields) {
    const std::string_view unit = bare(field);
    const bool of_acceleration = find_acceleration_unit(unit).has_value();
    known = known && (of_acceleration || unit.empty() || unit == "-" || find_time_unit(unit) ||
                      !quantity_with_unit(unit).empty());
    units.emplace_back(of_acceleration ? unit : std::string_view());
  }
  const bool some = std::ranges::any_of(units, [](const std::string& unit) { return !unit.empty(); });
  if (known && some && fields.size() == columns) return units;
  // "units: furlong/s^2" is no remark.
  if (says_unit && !says_acceleration && fields.size() == 1 && line.find("/s") != std::string_view::npos)
    return {std::string(bare(line))};
  return {};
}

std::optional<Size> size_in(std::string_view line) {
  line = without_mark(line);
  Size size;
  bool known = false;
  while (!line.empty()) {
    std::size_t end = line.find_first_of(",;");
    const std::string_view part = trim(line.substr(0, end));
    line = end == std::string_view::npos ? std::string_view() : trim(line.substr(end + 1));
    if (part.empty()) continue;
    const auto value_after = [&](Texts keys) -> std::optional<Quotient> {
      for (const std::string_view key : keys) {
        if (!same(part.substr(0, key.size()), key)) continue;
        const std::string_view rest = trim(part.substr(key.size()));
        if (!rest.empty() && (rest[0] == '=' || rest[0] == ':' || rest[0] == '(' || rest[0] == '['))
          return value_of(rest);
      }
      return std::nullopt;
    };
    if (const auto step =
            value_after({"dt", "delta t", "delta_t", "time step", "timestep", "time_step", "sampling interval",
                         "sample interval", "sampling period", "time interval", "time increment"})) {
      const std::optional<double> seconds = step->unit.empty() ? 1 : find_time_unit(step->unit);
      if (!seconds) return std::nullopt;
      size.dt = step->value * *seconds;
    } else if (const auto rate =
                   value_after({"sampling rate", "sample rate", "sampling frequency", "samplerate", "fs"})) {
      if (!rate->unit.empty() &&
          !is_one_of(rate->unit, {"hz", "1/s", "sps", "samples/s", "samples/sec", "samples per second"}))
        return std::nullopt;
      size.dt = 1 / rate->value;
    } else if (const auto count = value_after({"npts", "np", "number of points", "number of samples", "number of data",
                                               "samples", "points", "n"})) {
      size.samples = count->value;
    } else {
      return std::nullopt;
    }
    known = true;
  }
  return known ? std::optional(size) : std::nullopt;
}

}  // namespace stickslip::records
