#include "stickslip/ground/orientation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <vector>

#include "base/read_number.hpp"
#include "stickslip/base/error.hpp"

namespace stickslip {
namespace {

/// Upper case, without blanks.
std::string plain(std::string_view text) {
  std::string result;
  for (const char c : text)
    if (c != ' ' && c != '\t') result += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return result;
}

bool is_one_of(const std::string& word, std::initializer_list<const char*> words) {
  return std::ranges::any_of(words, [&](const char* one) { return word == one; });
}

/// In [0, 360), without the round-off of a sum of angles.
double reduced(double azimuth) {
  const double turn = std::fmod(std::round(std::fmod(azimuth, 360) * 1e9) / 1e9, 360);
  return turn < 0 ? turn + 360 : turn + 0.0;  // no -0
}

/// Whether a text in a file is an orientation. Numbers are azimuths up to a turn; one digit rather counts something.
bool is_orientation(std::string_view text) {
  if (const std::optional<double> number = detail::read_number(plain(text)))
    return std::abs(*number) <= 360 && (plain(text).size() > 1 || !(std::abs(*number) > 0));
  return azimuth_of(text) || upward(text) != 0;
}

bool points_alike(const std::string& a, const std::string& b) {
  return azimuth_of(a) == azimuth_of(b) && upward(a) == upward(b);
}

/// The words of a text outside brackets, and the hyphens and slashes between them.
std::vector<std::string> words(std::string_view text) {
  std::vector<std::string> found;
  std::string word;
  const auto end_word = [&] {
    if (!word.empty()) found.push_back(word);
    word.clear();
  };
  int depth = 0;
  for (const char c : text) {
    const bool opens = c == '(' || c == '[', closes = c == ')' || c == ']';
    depth = opens ? depth + 1 : closes && depth > 0 ? depth - 1 : depth;
    if (depth > 0 || closes || c == ' ' || c == '\t' || c == '_' || c == ',' || c == ';' || c == ':' || c == '=') {
      end_word();
    } else if (c == '-' || c == '/') {
      end_word();
      found.emplace_back(1, c);
    } else {
      word += c;
    }
  }
  end_word();
  return found;
}

/// The direction of a SEED channel of a motion, such as HNE, or BHZ00 with its location: band, instrument, direction.
std::string orientation_of_channel(std::string_view text) {
  const std::string whole = plain(text);
  std::string_view code = whole;
  if (code.size() == 5 && code[3] >= '0' && code[3] <= '9' && code[4] >= '0' && code[4] <= '9')
    code = code.substr(0, 3);
  if (code.size() == 3 && (code[2] == '1' || code[2] == '2'))  // NS1, UD2: of a pair of the Japanese networks
    if (const std::string pair(code.substr(0, 2)); is_one_of(pair, {"NS", "EW", "UD"})) return pair;
  const auto is = [&](std::size_t place, std::string_view letters) {
    return letters.find(code[place]) != std::string_view::npos;
  };
  return code.size() == 3 && is(0, "FGDCESHBMLVUR") && is(1, "HLGNM") && is(2, "ZNE") ? std::string(1, code[2])
                                                                                      : std::string();
}

}  // namespace

std::optional<double> azimuth_of(std::string_view orientation) {
  std::string text = plain(orientation);
  for (const std::string_view unit : {"DEGREES", "DEG.", "DEG", "\xC2\xB0"})
    if (const std::size_t at = text.find(unit); at != std::string::npos && at + unit.size() + 1 >= text.size())
      text.erase(at, unit.size());  // at the end, or before its quadrant: N 45 DEG E
  if (is_one_of(text, {"N", "NORTH", "N-S", "N/S", "NS", "S-N", "SN", "NORTH-SOUTH", "NORD", "NORTE", "KUZEY"}))
    return 0;
  if (is_one_of(text, {"E", "EAST", "E-W", "E/W", "EW", "W-E", "WE", "EAST-WEST", "OST", "EST", "ESTE", "DOGU"}))
    return 90;
  if (is_one_of(text, {"S", "SOUTH", "SUD", "SUR"})) return 180;
  if (is_one_of(text, {"W", "WEST", "OVEST", "OUEST", "OESTE"})) return 270;
  if (text.size() > 2 && is_one_of(text.substr(0, 1), {"N", "S"}) &&
      is_one_of(text.substr(text.size() - 1), {"E", "W"})) {
    const std::optional<double> angle = detail::read_number(std::string_view(text).substr(1, text.size() - 2));
    if (!angle || *angle < 0 || *angle > 90) return std::nullopt;
    const bool north = text.front() == 'N', east = text.back() == 'E';
    return reduced(north ? (east ? *angle : 360 - *angle) : (east ? 180 - *angle : 180 + *angle));
  }
  const std::optional<double> azimuth = detail::read_number(text);
  return azimuth ? std::optional(reduced(*azimuth)) : std::nullopt;
}

int upward(std::string_view orientation) {
  const std::string text = plain(orientation);
  if (is_one_of(text, {"UP",
                       "U",
                       "Z",
                       "UD",
                       "U-D",
                       "U/D",
                       "UP-DOWN",
                       "UPWARD",
                       "UPWARDS",
                       "V",
                       "VER",
                       "VERT",
                       "VERT.",
                       "VRT",
                       "VERTICAL",
                       "VERTICALE",
                       "VERTIKAL",
                       "SENKRECHT",
                       "DUSEY",
                       "D\xC3\xBC\xC5\x9F"
                       "EY"}))
    return 1;
  return is_one_of(text, {"DOWN", "DWN", "DN", "D", "DOWNWARD", "DOWNWARDS"}) ? -1 : 0;
}

std::string orientation_in(std::string_view text) {
  if (is_orientation(text)) return std::string(text);
  // Words of letters and digits; two that a hyphen or a slash joins are one if that is an orientation.
  std::string found;
  bool several = false;
  const auto add = [&](const std::string& orientation) {
    if (several)
      return;
    else if (found.empty())
      found = orientation;
    else
      several = several || !points_alike(found, orientation);
  };
  const std::vector<std::string> parts = words(text);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto at = [&](std::size_t k) { return i + k < parts.size() ? parts[i + k] : std::string(); };
    const bool is_joined = at(1) == "-" || at(1) == "/";
    const std::string both = is_joined ? at(0) + "-" + at(2) : std::string();
    const bool is_number = detail::read_number(at(0)).has_value();
    // N 45 states no quadrant, and no direction.
    const bool of_number = at(0).size() == 1 && detail::read_number(at(1)).has_value();
    if (is_joined && is_orientation(both)) {
      add(both);
      i += 2;
    } else if (is_number && is_one_of(plain(at(1)), {"DEG", "DEGREES", "\xC2\xB0"})) {
      add(at(0));
      ++i;
    } else if (is_one_of(plain(at(0)), {"UP", "DOWN"}) && (at(1) == "-" || (i > 0 && parts[i - 1] == "-"))) {
      continue;  // made-up, cool-down
    } else if (of_number && is_orientation(at(0))) {
      several = true;
    } else if (!is_number && at(0) != "-" && is_orientation(at(0))) {
      add(at(0));
    } else if (const std::string of_channel = orientation_of_channel(at(0)); !of_channel.empty()) {
      add(of_channel);
    }
  }
  return several ? std::string() : found;
}

std::string orientation_in_file_name(std::string_view name) {
  name = name.substr(std::min(name.find_last_of("/\\") + 1, name.size()));
  for (const std::string_view packed : {".gz", ".bz2", ".xz"})
    if (name.ends_with(packed)) name.remove_suffix(packed.size());
  // The extension of the Japanese networks, or what follows the last mark of the stem.
  const std::size_t point = name.rfind('.');
  if (point != std::string_view::npos) {
    std::string extension = plain(name.substr(point + 1));
    if (extension.size() == 3 && extension[2] >= '1' && extension[2] <= '2') extension.pop_back();
    if (is_one_of(extension, {"NS", "EW", "UD", "UP", "VER", "VERT"})) return extension;
  }
  std::string_view stem = name.substr(0, point);
  // What programs add to a name: " (1)", "_corrected".
  if (stem.ends_with(')'))
    if (const std::size_t open = stem.rfind(" ("); open != std::string_view::npos) stem = stem.substr(0, open);
  std::string end;
  const bool alone = stem.find_first_of("-_. ") == std::string_view::npos;
  do {
    const std::size_t mark = stem.find_last_of("-_. ");
    end = plain(stem.substr(mark + 1));  // the whole stem if there is no mark
    stem = stem.substr(0, mark == std::string_view::npos ? 0 : mark);
  } while (!stem.empty() && is_one_of(end, {"CORRECTED", "COR", "ACC", "ACCEL", "FILTERED", "RAW"}));
  if (alone && end.size() == 1) return {};  // e.csv
  if (is_one_of(end,
                {"N", "E", "S", "W", "NS", "EW", "UD", "UP", "DN", "DWN", "DOWN", "V", "VER", "VERT", "VERTICAL", "Z"}))
    return end;
  return orientation_of_channel(end);
}

std::string orientation_at(double azimuth) { return detail::shortest(reduced(azimuth)); }

}  // namespace stickslip
