#include "stickslip/ground/orientation.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>

#include "base/read_number.hpp"
#include "stickslip/error.hpp"

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

}  // namespace

std::optional<double> azimuth_of(std::string_view orientation) {
  std::string text = plain(orientation);
  for (const char* unit : {"DEGREES", "DEG", "\xC2\xB0"})
    if (text.ends_with(unit)) text.resize(text.size() - std::string_view(unit).size());
  if (is_one_of(text, {"N", "NORTH", "N-S", "NS"})) return 0;
  if (is_one_of(text, {"E", "EAST", "E-W", "EW"})) return 90;
  if (is_one_of(text, {"S", "SOUTH"})) return 180;
  if (is_one_of(text, {"W", "WEST"})) return 270;
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
  if (is_one_of(text, {"UP", "U", "Z", "UD", "U-D", "V", "VER", "VERT", "VRT", "VERTICAL"})) return 1;
  return is_one_of(text, {"DOWN", "DWN", "DN", "D"}) ? -1 : 0;
}

std::string orientation_at(double azimuth) { return detail::shortest(reduced(azimuth)); }

}  // namespace stickslip
