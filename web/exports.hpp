// What the functions that the page calls have in common: how bytes and numbers pass, and the ground motions that are kept.
//
// Every function that can fail returns a negative number if it did; `text()` is then the message. Arguments that are
// not numbers are bytes in `input(size)`, and results are numbers in `numbers()` or a line per item in `text()`. The
// functions that keep a ground motion return its number, which `discard` takes.
#pragma once

#include <cmath>
#include <cstring>
#include <exception>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/ground/records.hpp"
#include "stickslip/ground/station.hpp"

#ifdef __EMSCRIPTEN__
#define STICKSLIP_EXPORT(name) __attribute__((export_name(#name), used))
#else
#define STICKSLIP_EXPORT(name)
#endif

namespace stickslip::web {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

extern std::vector<char> given;     // what the page wrote
extern std::vector<double> answer;  // numbers for the page
extern std::string said;            // text for the page

const RecordComponent& of(int number);

/// Runs `work`, which returns a number of at least 0; -1 with its message if it throws.
template <class Work>
int guarded(Work&& work) {
  try {
    return work();
  } catch (const std::exception& error) {
    said = error.what();
    return -1;
  }
}

/// The settings that the input begins with.
template <class Settings>
Settings given_settings() {
  Settings settings;
  if (given.size() < sizeof settings) throw std::invalid_argument("wrong number of settings");
  std::memcpy(&settings, given.data(), sizeof settings);
  return settings;
}

/// The numbers that follow them.
template <class Settings>
std::vector<double> given_numbers() {
  std::vector<double> numbers((given.size() - sizeof(Settings)) / sizeof(double));
  std::memcpy(numbers.data(), given.data() + sizeof(Settings), numbers.size() * sizeof(double));
  return numbers;
}

inline bool is(double flag) { return flag > 0; }

inline std::optional<double> if_given(double value) { return std::isnan(value) ? std::nullopt : std::optional(value); }

/// The motion of the settings along its axis: with or without its vertical component, scaled.
template <class Settings>
GroundMotion driven(const Settings& s, const GroundMotion& record) {
  GroundMotion motion = is(s.vertical) ? record : record.component(Component::axis);
  return s.scale == 1 ? motion : motion.scaled(s.scale);
}

inline void answer_with(std::span<const double> values) { answer.assign(values.begin(), values.end()); }

/// Answers with the numbers of a summary.
template <class Summary>
void answer_with_summary(const Summary& summary) {
  answer.resize(sizeof summary / sizeof(double));
  std::memcpy(answer.data(), &summary, sizeof summary);
}

/// The numbers of settings and of a summary by their names, as `names` of each object says them.
inline void say_names(const char* settings, const char* summary) { said = std::string(settings) + "\n" + summary; }

}  // namespace stickslip::web
