#include "ground/records/labels.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <span>
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

/// The words of a text: runs of letters, also divided where a capital follows a small letter: accX, UDacc.
std::vector<std::string_view> words_of(std::string_view text) {
  const auto is_capital = [](char c) { return c >= 'A' && c <= 'Z'; };
  const auto is_part = [](char c) { return is_letter(c) || static_cast<unsigned char>(c) >= 0x80; };
  std::vector<std::string_view> words;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at;
    while (end < text.size() && is_part(text[end]) &&
           !(end > at && is_capital(text[end]) && is_letter(text[end - 1]) && !is_capital(text[end - 1])))
      ++end;
    if (end > at) words.push_back(text.substr(at, end - at));
    at = std::max(end, at + 1);
  }
  return words;
}

struct Words {
  std::string_view what;
  Texts beginnings;  // of words with four letters or more; shorter ones are whole words
};

bool begins_with(std::string_view word, std::string_view beginning) {
  return beginning.size() < 4 ? same(word, beginning) : same(word.substr(0, beginning.size()), beginning);
}

/// What one of the words names, or nothing.
std::string named(const std::vector<std::string_view>& words, std::span<const Words> all) {
  for (const Words& one : all)
    for (const std::string_view word : words)
      for (const std::string_view beginning : one.beginnings)
        if (begins_with(word, beginning)) return std::string(one.what);
  return {};
}

/// What words name that is no history of acceleration, even where their unit is one of acceleration.
std::string kind_of_value(const std::vector<std::string_view>& words) {
  static const Words all[] = {
      {"a period", {"period", "per\xC3\xADodo", "p\xC3\xA9riode", "periyot", "schwing", "\xE5\x91\xA8\xE6\x9C\x9F"}},
      {"a frequency", {"freq", "hz"}},
      {"a spectral value",
       {"sa", "sah", "sav", "se", "psa", "sv", "psv", "sd", "fas", "psd", "fft", "spectr", "fourier", "response",
        "rotd", "gmrot", "sagm", "damping"}},
      {"a peak", {"peak", "pga", "pgv", "pgd", "max", "maximum", "min", "minimum", "kmax"}},
      {"a level of yielding", {"ky", "yield", "critical", "threshold"}},
      {"a quantity of a response", {"friction", "spring", "damper", "slip"}},
      {"a result of processing",
       {"pseudo", "std", "error", "integral", "integrated", "cumulative", "cum", "squared", "abs", "log", "ln"}},
      {"a rotation", {"angular", "rotational"}},
  };
  return named(words, all);
}

/// What words name that is no acceleration, unless they stand beside that word.
std::string other_quantity(const std::vector<std::string_view>& words) {
  static const Words all[] = {
      {"a velocity",
       {"vel", "veloc", "velo", "speed", "geschw", "vitesse", "udot", "velx", "vely", "velz", "gvel", "vg", "hastighet",
        "h\xC4\xB1z", "snelheid", "\xE9\x80\x9F\xE5\xBA\xA6"}},
      {"a displacement",
       {"disp", "displ", "dsp", "dis", "dg", "desloc", "drift", "position", "pos", "weg", "verschieb", "deplac",
        "d\xC3\xA9plac", "desplaz", "spostam"}},
      {"a number of counts", {"counts", "adc", "raw"}},
      {"a voltage", {"volt", "volts", "voltage"}},
      {"a mark of quality", {"quality", "flag", "qc", "status"}},
      {"a temperature", {"temp", "temper", "humid"}},
      {"a force", {"force", "shear", "kraft", "load", "stress", "strain", "pressure", "moment"}},
      {"a rotation", {"angle", "rotat", "tilt", "gyro", "omega", "roll", "pitch", "yaw"}},
      {"a measure of intensity", {"arias", "cav", "intensity", "energy", "magnitude", "ia"}},
      {"a statement of errors", {"sigma", "noise"}},
      {"a place", {"lat", "lon", "latitude", "longitude", "depth", "elevation"}},
      {"another derivative", {"jerk"}},
  };
  return named(words, all);
}

bool is_acceleration_word(std::string_view word) {
  return is_one_of(word, {"acc", "accel", "acceleration", "accelerations", "accelerogram", "beschl", "beschleunigung",
                          "aceleracion", "accelerazione", "ivme"});
}

/// Words that say nothing beside a direction.
bool is_neutral(std::string_view word) {
  return is_acceleration_word(word) ||
         is_one_of(word,
                   {"a",    "ag",        "ug",        "in",         "the",           "component", "comp",   "channel",
                    "chan", "ch",        "corrected", "cor",        "filtered",      "ground",    "motion", "dir",
                    "axis", "direction", "richtung",  "komponente", "accelerometer", "linear"});
}

/// The direction that a label states: its whole name, a text in brackets, or one of its words; one letter only beside
/// words that say nothing else.
std::string direction_in(std::string_view name, const std::vector<std::string_view>& bracketed) {
  const bool is_number = name.find_first_not_of("0123456789.-+eE ") == std::string_view::npos &&
                         name.find_first_of("0123456789") != std::string_view::npos;
  if (is_number) return name.size() == 3 ? orientation_in(name) : std::string();  // 090; pandas labels columns 0, 1, 2
  if (const std::string whole = orientation_in(name); !whole.empty() && whole == name) return whole;
  for (const std::string_view text : bracketed)
    if (std::string found = orientation_in(text); !found.empty() && found == text && !is_digit(text[0])) return found;
  const std::vector<std::string_view> words = words_of(name);
  const bool neutral = std::ranges::all_of(words, [](std::string_view word) {
    return word.size() == 1 || is_neutral(word) || is_one_of(word, {"up", "down"});
  });
  std::string found;
  bool no_direction = false;
  for (std::string_view word : words) {
    bool direction = false;  // az, ugz, accz, zacc
    for (const std::string_view begin : {"a", "ag", "ug", "acc", "accel"})
      if (word.size() == begin.size() + 1 && same(word.substr(0, begin.size()), begin) && lower(word.back()) == 'z') {
        word = word.substr(begin.size());
        direction = true;
        break;
      }
    for (const std::string_view end : {"z", "ud", "up"})  // zacc, UDacc, accud
      if (word.size() == end.size() + 3 && (same(word.substr(end.size()), "acc") || same(word.substr(0, 3), "acc"))) {
        const std::string_view rest = same(word.substr(0, 3), "acc") ? word.substr(3) : word.substr(0, end.size());
        if (!same(rest, end)) continue;
        word = rest;
        direction = true;
        break;
      }
    const auto at = static_cast<std::size_t>(word.data() - name.data());
    const bool of_number =
        (at > 0 && is_digit(name[at - 1])) || (at + word.size() < name.size() && is_digit(name[at + word.size()]));
    const bool letter =
        word.size() == 1 && !direction && (!neutral || of_number || !is_one_of(word, {"N", "E", "S", "W", "Z", "V"}));
    if (letter || is_neutral(word)) continue;
    // "made up" and "scaled up" are no directions; "RSN1_A-UP" and "acc up" are.
    const bool after_mark = at > 0 && (name[at - 1] == '-' || name[at - 1] == '_') && word[0] < 'a';
    if (is_one_of(word, {"up", "down"}) && !after_mark && !neutral && words.size() > 1) {
      no_direction = true;
      continue;
    }
    const std::string one = orientation_in(word);
    if (!one.empty() && !is_digit(one[0]) && found.empty()) found = one;
  }
  if (!found.empty() || no_direction) return found;
  found = orientation_in(name);  // N28W, N-S, 230 deg; a letter alone was not one above
  return found.size() > 1 ? found : std::string();
}

/// Sets the unit that a text in brackets or at the end of a label names. Returns whether it is one.
bool set_unit(Label& label, std::string_view unit) {
  // One letter in brackets is rather a direction than newton or volt.
  const bool letter =
      trim(unit).size() == 1 && std::string_view("NEWVZUD").find(trim(unit)[0]) != std::string_view::npos;
  if (find_acceleration_unit(unit)) {
    label.unit = std::string(trim(unit));
  } else if (const std::optional<double> seconds = find_time_unit(trim(unit)); seconds && !letter) {
    label.quantity = Quantity::time;
    label.seconds = *seconds;
  } else if (std::string other = quantity_with_unit(unit); !other.empty() && !letter) {
    label.quantity = Quantity::other;
    label.other = std::move(other);
  } else {
    return false;
  }
  return true;
}

/// Sets quantity and seconds by the words of a label whose unit is known.
void set_quantity(Label& label) {
  const std::vector<std::string_view> split = words_of(label.name);
  std::vector<std::string_view> words = split;
  for (std::string_view rest = label.name; !rest.empty();
       rest.remove_prefix(std::min(rest.find_first_of(" _"), rest.size() - 1) + 1))
    words.push_back(rest.substr(0, rest.find_first_of(" _0123456789")));  // RotD50, whatever its capitals
  const auto any = [&](Texts texts) {
    return std::ranges::any_of(words, [&](std::string_view word) { return is_one_of(word, texts); });
  };
  std::string_view whole = trim(label.name);
  while (whole.ends_with('.') || whole.ends_with(':')) whole.remove_suffix(1);
  const bool accelerates = std::ranges::any_of(words, is_acceleration_word);
  std::string other = kind_of_value(words);
  // "Spectrum compatible acc (g)" is one, "spectral acceleration" is not.
  if (accelerates && !label.unit.empty() && is_one_of(other, {"a spectral value", "a frequency", "a period"}) &&
      !any({"spectral", "response", "psa"}))
    other.clear();
  if (is_one_of(whole, {"s_a", "s_v", "s_d"})) other = "a spectral value";
  if (is_one_of(whole, {"tn", "t_n", "t0", "t1", "per"})) other = "a period";
  if (other.empty() && !accelerates) other = other_quantity(words);
  if (other.empty() && label.unit.empty() && is_one_of(whole, {"v(t)", "d(t)", "u(t)"}))
    other = "a velocity or a displacement";
  if (other.empty() &&
      (whole == "v" || whole == "d" || whole == "u" || whole == "vx" || whole == "vy" || whole == "ux"))
    other = "a velocity or a displacement";
  if (!other.empty()) {
    label.quantity = Quantity::other;
    label.other = std::move(other);
  } else if (label.quantity == Quantity::other) {
    return;  // by its unit
  } else if (accelerates || !label.unit.empty()) {
    label.quantity = Quantity::acceleration;
  } else if (whole.empty() && label.quantity == Quantity::unknown) {
    label.quantity = Quantity::index;
  } else if (is_one_of(whole, {"no",   "nr",  "num",    "number",  "#",       "index",   "idx",
                               "i",    "row", "sample", "samples", "frame",   "point",   "points",
                               "step", "id",  "line",   "count",   "counter", "sample #"}) ||
             (any({"time", "sample", "row", "point", "data", "step"}) &&
              any({"step", "number", "no", "nr", "index", "count", "id"}) && words.size() > 1) ||
             any({"timestep", "unnamed"})) {
    label.quantity = Quantity::index;
  } else if (any({"time", "times", "zeit", "tiempo", "temps", "tempo", "zaman", "elapsed", "timestamp"}) ||
             is_one_of(whole, {"t", "s", "sec", "secs", "second", "seconds"})) {
    label.quantity = Quantity::time;
    if (const auto seconds = find_time_unit(split.back()); split.size() > 1 && seconds)
      label.seconds = *seconds;  // TimeMs
  } else if (const std::optional<double> seconds = find_time_unit(whole); seconds) {
    label.quantity = Quantity::time;
    label.seconds = *seconds;
  }
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
    for (const std::string_view end : {" in", " units of", " unit"})
      if (shorter.name.size() > end.size() &&
          same(std::string_view(shorter.name).substr(shorter.name.size() - end.size()), end))
        shorter.name.resize(shorter.name.size() - end.size());
    if (of_time) {
      set_quantity(shorter);
      if (shorter.quantity != Quantity::time) continue;
    }
    // A g may be anything, but not behind the word for acceleration or a direction.
    const std::vector<std::string_view> words = words_of(shorter.name);
    if (of_acceleration && unit.size() == 1 &&
        (words.empty() || same(shorter.name, "a") ||
         !(is_neutral(words.back()) || !direction_in(shorter.name, {}).empty())))
      continue;
    if (!set_unit(label, unit)) continue;
    label.name = shorter.name;
    return;
  }
}

/// Whether a text in brackets reads like a unit of acceleration: `0.1 g`, `mGal`, `m.s-2`, `% g`.
bool reads_like_unit(std::string_view text) {
  for (const std::string_view mark : {"/s", "s-2", "s^-2", "s\xE2\x81\xBB", "%", "\xE2\x80\xB0"})
    if (text.find(mark) != std::string_view::npos) return true;
  const std::vector<std::string_view> words = words_of(text);
  return std::ranges::any_of(words, [](std::string_view word) {
    return is_one_of(word, {"g", "gal", "gals", "mgal", "ug", "mg", "kg", "\xC2\xB5g", "\xCE\xBCg"});
  });
}

/// Whether a label multiplies its unit: `Acc in milli g`, `Acc (g) *100`, `Acc 1e-3 g`.
bool is_multiplied(std::string_view label) {
  for (const std::string_view word : words_of(label))
    if (is_one_of(word, {"milli", "micro", "kilo", "percent", "pct"})) return true;
  for (std::size_t at = 0; at + 1 < label.size(); ++at) {  // `x10`, `/10`
    const bool times = lower(label[at]) == 'x' && (at == 0 || !is_letter(label[at - 1]));
    if ((times || label[at] == '/') && is_digit(label[at + 1])) return true;
  }
  const bool star = label.find('*') != std::string_view::npos && label.find("**") == std::string_view::npos;
  return star || has(label, " x 1") || has(label, "1e-") || has(label, "1e+") || has(label, "0.0") || has(label, "/ 1");
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
  if (!text.empty() && std::string_view("=:,;").find(text[0]) != std::string_view::npos) text = trim(text.substr(1));
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
         !direction.empty();
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
  label.direction = direction_in(label.name, bracketed);
  if (label.quantity == Quantity::acceleration && !label.unit.empty() && is_multiplied(text)) label.unit = label.text;
  if (label.quantity == Quantity::time && label.seconds == 1 && !has_unit)
    for (const std::string_view one : bracketed)
      if (!is_one_of(one, {"UTC", "GMT", "JST", "local", "relative", "t", "elapsed"}) && !is_second(one)) {
        label.quantity = Quantity::other;
        label.other = "a time in an unknown unit";
      }
  // A text in brackets that reads like a unit and is none: a known one must be given.
  if (!has_unit && label.unit.empty() && label.quantity != Quantity::time && label.quantity != Quantity::other)
    for (const std::string_view one : bracketed)
      if (reads_like_unit(one) && !is_one_of(one, {"G", "g's"})) label.unit = std::string(one);
  return label;
}

void split_row(std::string_view row, std::vector<std::string_view>& fields) {
  fields.clear();
  row = trim(row);
  /// Behind a separator; `mark` tells whether it is a comma or semicolon, with the blanks around it.
  const auto after_separators = [row](std::size_t at, bool& mark) {
    mark = !is_blank(row[at]);
    while (++at < row.size() && (is_blank(row[at]) || (!mark && is_separator(row[at]))))
      mark = mark || !is_blank(row[at]);
    return at;
  };
  bool separated = true;  // only there a quotation mark opens a field
  for (std::size_t begin = 0;;) {
    const bool opens = separated && begin < row.size() && row[begin] == '"';
    const std::size_t close = opens ? row.find('"', begin + 1) : std::string_view::npos;
    const bool quoted = close != std::string_view::npos;
    std::size_t end = quoted ? close + 1 : begin;
    while (!quoted && end < row.size() && !is_separator(row[end])) ++end;
    fields.push_back(quoted ? trim(row.substr(begin + 1, close - begin - 1)) : row.substr(begin, end - begin));
    if (end == row.size()) return;
    bool mark = true;
    separated = is_separator(row[end]);
    begin = separated ? after_separators(end, mark) : end;
    if (quoted && begin == row.size() && !mark) return;
  }
}

std::vector<std::string_view> split_at(std::string_view line, std::string_view marks) {
  std::vector<std::string_view> parts;
  std::size_t begin = 0;
  bool quoted = false;
  for (std::size_t at = 0; at <= line.size(); ++at) {
    if (at < line.size() && line[at] == '"') quoted = !quoted;
    if (at < line.size() && (quoted || marks.find(line[at]) == std::string_view::npos)) continue;
    parts.push_back(line.substr(begin, at - begin));
    if (at < line.size() && line[at] != '\t')  // a mark, and blanks after it
      while (at + 1 < line.size() && is_blank(line[at + 1])) ++at;
    begin = at + 1;
  }
  return parts;
}

namespace {

/// A label without its quotation marks.
std::string_view unquoted(std::string_view text) {
  text = trim(text);
  return text.size() > 1 && text.front() == '"' && text.back() == '"' ? text.substr(1, text.size() - 2) : text;
}

}  // namespace

std::vector<Label> labels_in(std::string_view line, std::size_t columns) {
  line = without_mark(line);
  // First at commas, semicolons and tabs, and at two blanks; then at each blank.
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
  for (std::vector<std::string_view> parts :
       {split_at(line, ",;\t"), split_at(line, ";"), split_at(line, "\t"), at_blanks(2), at_blanks(1)}) {
    while (parts.size() > columns && trim(parts.back()).empty()) parts.pop_back();  // of a spreadsheet
    if (parts.size() != columns) continue;
    std::vector<Label> labels;
    for (const std::string_view part : parts) labels.push_back(label_of(unquoted(part)));
    if (std::ranges::any_of(labels, [](const Label& label) { return label.is_recognized(); })) return labels;
  }
  return {};
}

bool is_level(std::string_view line, std::size_t columns) {
  const std::vector<std::string_view> parts = split_at(line, ",;\t");
  return parts.size() == columns && trim(parts[0]).empty() && !trim(line).empty();
}

std::vector<Label> labels_of_levels(const Lines& levels, std::size_t columns) {
  std::vector<std::string> texts(columns);
  for (const std::string_view level : levels) {
    const std::vector<std::string_view> parts = split_at(level, ",;\t");
    std::string_view above;  // of cells that are merged, the first one has the text
    for (std::size_t k = 0; k < std::min(columns, parts.size()); ++k) {
      if (const std::string_view part = unquoted(parts[k]); !part.empty() || level == levels.back()) above = part;
      if (!above.empty()) texts[k] += (texts[k].empty() ? "" : " ") + std::string(above);
    }
  }
  std::vector<Label> labels;
  for (const std::string& text : texts) labels.push_back(label_of(text));
  return labels;
}

bool is_comment(std::string_view line) {
  line = trim(line);
  for (const std::string_view error : {"#N/A", "#DIV/0!", "#VALUE!", "#NUM!", "#REF!", "#NAME?", "#NULL!"})
    if (line.starts_with(error)) return false;  // of a spreadsheet
  return line.starts_with('#') || line.starts_with('%') || line.starts_with('!') || line.starts_with("//");
}

std::string_view without_mark(std::string_view line) {
  line = trim(line);
  while (!line.empty() && (line[0] == '#' || line[0] == '%' || line[0] == '!' || line[0] == '/'))
    line = trim(line.substr(1));
  return line;
}

std::vector<std::string> units_in(std::string_view line, std::size_t columns) {
  std::vector<std::string_view> fields;
  if (!same(trim(line).substr(0, 2), "%g")) line = without_mark(line);  // a unit, and no mark of a comment
  // What may stand before the unit.
  bool says_unit = false, says_acceleration = false, says_which = false;  // `units:`, `units are`
  const std::string_view whole = line;
  for (std::string_view rest = line;;) {
    std::size_t end = 0;
    while (end < rest.size() && is_letter(rest[end])) ++end;
    const std::string_view word = rest.substr(0, end);
    const bool of_unit = is_one_of(word, {"unit", "units"}), of_acceleration = is_acceleration_word(word);
    if (rest.substr(end).starts_with('/')) break;  // in/s^2
    if (!of_unit && !of_acceleration &&
        !is_one_of(word,
                   {"ground", "motion", "time", "series", "history", "data", "values", "in", "the", "of", "are", "is"}))
      break;
    says_unit = says_unit || of_unit;
    says_acceleration = says_acceleration || of_acceleration;
    rest = trim(rest.substr(end));
    says_which = says_which || (says_unit && is_one_of(word, {"are", "is", "in", "of"}));
    if (rest.starts_with(':') || rest.starts_with('=')) {
      says_which = says_which || says_unit;
      rest = trim(rest.substr(1));
    }
    line = rest;
  }
  const auto bare = [](std::string_view text) {
    text = trim(text);
    if (text.size() > 1 && (text[0] == '(' || text[0] == '[') && (text.back() == ')' || text.back() == ']'))
      text = trim(text.substr(1, text.size() - 2));
    while (text.ends_with('.')) text.remove_suffix(1);
    return text;
  };
  if (!says_unit && !says_acceleration) line = whole;
  if (find_acceleration_unit(bare(line))) return {std::string(bare(line))};
  // A unit for each column; the last ones may be empty.
  split_row(line, fields);
  while (fields.size() > columns && trim(fields.back()).empty()) fields.pop_back();
  std::vector<std::string> units;
  bool known = !fields.empty(), some = false;
  for (const std::string_view field : fields) {
    const std::string unit(bare(field));
    const bool of_record = find_acceleration_unit(unit) || find_time_unit(unit) || !quantity_with_unit(unit).empty();
    known = known && (of_record || unit.empty() || unit == "-");
    some = some || of_record;
    units.push_back(unit == "-" ? std::string() : unit);
  }
  const bool fits = fields.size() == columns || (fields.size() < columns && find_time_unit(fields[0]));
  if (known && some && fits && (columns > 1 || says_unit)) {
    units.resize(columns);
    return units;
  }
  // "units: furlong/s^2" and "unit: counts" are no remarks; "units: g (1 g = 9.81 m/s2)" states g.
  if (says_which && !line.empty()) {
    const std::string_view before = bare(line.substr(0, line.find('(')));
    if (find_acceleration_unit(before)) return {std::string(before)};
    if (line.size() <= 24) return {std::string(bare(line))};
  }
  return {};
}

namespace {

constexpr std::string_view step_keys[] = {
    "dt",        "delta t",           "delta_t",         "delta",           "time step",     "timestep",
    "time_step", "sampling interval", "sample interval", "sampling period", "time interval", "time increment"};
constexpr std::string_view rate_keys[] = {"sampling rate", "sample rate", "sampling frequency", "sampling freq",
                                          "samplerate",    "fs",          "abtastrate"};
constexpr std::string_view count_keys[] = {
    "npts",   "np", "number of points", "number of samples", "number of data points", "number of data", "samples",
    "points", "n"};

/// What follows one of the keys and a mark, or, if it is all of the text, a number.
std::optional<Quotient> value_after(std::string_view text, std::span<const std::string_view> keys) {
  for (const std::string_view key : keys) {
    if (!same(text.substr(0, key.size()), key)) continue;
    std::string_view rest = text.substr(key.size());
    if (rest.starts_with('.')) rest.remove_prefix(1);
    rest = trim(rest);
    if (rest.empty()) continue;
    if (rest[0] == ',' || rest[0] == ';') rest = trim(rest.substr(1));  // of a table with two columns
    if (std::string_view("=:([").find(rest[0]) != std::string_view::npos || is_digit(rest[0]) || rest[0] == '.')
      if (const auto value = value_of(rest)) return value;
  }
  return std::nullopt;
}

/// Adds what a text states to a size. Returns whether it states anything, and nothing else.
bool add_statement(Size& size, std::string_view text) {
  const auto set_step = [&size](double dt) {
    const bool agrees = !size.dt || std::abs(*size.dt - dt) <= 1e-3 * dt;
    if (!size.dt) size.dt = dt;
    return agrees;
  };
  if (const auto step = value_after(text, step_keys)) {
    const std::optional<double> seconds = step->unit.empty() ? 1 : find_time_unit(step->unit);
    return seconds && set_step(step->value * *seconds);
  }
  if (const auto rate = value_after(text, rate_keys)) {
    return rate->value > 0 && set_step(1 / rate->value) &&
           (rate->unit.empty() ||
            is_one_of(rate->unit, {"hz", "1/s", "sps", "samples/s", "samples/sec", "samples per second"}));
  }
  if (const auto count = value_after(text, count_keys)) {
    size.samples = count->value;
    return count->unit.empty();
  }
  return false;
}

}  // namespace

std::optional<Size> size_in(std::string_view line) {
  line = without_mark(line);
  Size size;
  if (add_statement(size, line)) return size;
  // `200 0.01 NPTS, DT` of the first files of PEER
  std::string_view rest = line;
  if (const std::optional<double> count = take_number(rest)) {
    rest = after_separator(rest);
    const std::optional<double> dt = take_number(rest);
    rest = after_separator(rest);
    if (dt && same(rest.substr(0, 4), "npts") && has(rest, "dt")) return Size{dt, count};
    return std::nullopt;
  }
  // Several statements, which commas or semicolons separate, or blanks before the next one with its mark.
  const std::size_t last = line.rfind('=');  // npos + 1 is 0
  for (std::size_t begin = 0, at = 0; at <= line.size(); ++at) {
    const bool mark = at == line.size() || line[at] == ',' || line[at] == ';';
    const bool blank = !mark && is_blank(line[at]) && at > begin && is_digit(line[at - 1]) && at < last + 1;
    if (!mark && !blank) continue;
    const std::string_view part = trim(line.substr(begin, at - begin));
    begin = at + 1;
    if (!part.empty() && !add_statement(size, part)) return std::nullopt;
  }
  return size.dt || size.samples ? std::optional(size) : std::nullopt;
}

}  // namespace stickslip::records
