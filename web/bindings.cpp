// The library for the page: records, ground motions, intensity measures and the responses of sliders, as functions of
// numbers and bytes; see exports.hpp.
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "exports.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/base/parts.hpp"
#include "stickslip/base/plausibility.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/excitation/gaussian.hpp"
#include "stickslip/excitation/spectrum.hpp"
#include "stickslip/friction/laws.hpp"
#include "stickslip/friction/static_kinetic.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/ground/intensity_measures.hpp"
#include "stickslip/ground/orientation.hpp"
#include "stickslip/ground/records.hpp"
#include "stickslip/ground/response_spectrum.hpp"
#include "stickslip/ground/station.hpp"
#include "stickslip/ground/strong_motion.hpp"
#include "stickslip/planar/integrate.hpp"
#include "stickslip/planar/margins.hpp"
#include "stickslip/planar/slider.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/sliding/any_slider.hpp"
#include "stickslip/sliding/detail/engine_of.hpp"
#include "stickslip/sliding/forces.hpp"
#include "stickslip/sliding/integrate.hpp"
#include "stickslip/sliding/margins.hpp"
#include "stickslip/sliding/trajectory.hpp"

// What the page never asks of a law, and would be a tenth of the module: harmonic motions, and histories alone.
namespace stickslip::detail {
namespace {
[[noreturn]] void leave_out() { throw std::logic_error("the page leaves this out"); }
}  // namespace

#define STICKSLIP_LEAVE_OUT(Law)                                                                             \
  template <>                                                                                                \
  void EngineOf<Law>::move(Segments<HarmonicSegment>&, double, double, State&, Sink&) const {                \
    leave_out();                                                                                             \
  }                                                                                                          \
  template <>                                                                                                \
  void EngineOf<Law>::record(const GroundMotion&, State&, NoRecorder&, const HistorySpans&) const {          \
    leave_out();                                                                                             \
  }                                                                                                          \
  template <>                                                                                                \
  void EngineOf<Law>::record(const GroundMotion&, Contact, State&, NoRecorder&, const HistorySpans&) const { \
    leave_out();                                                                                             \
  }
STICKSLIP_LAWS(STICKSLIP_LEAVE_OUT)
}  // namespace stickslip::detail

namespace stickslip::web {

std::vector<char> given;
std::vector<double> answer;
std::string said;

namespace {
std::map<int, RecordComponent> kept;
int next = 0;
}  // namespace

const RecordComponent& of(int number) { return kept.at(number); }

}  // namespace stickslip::web

namespace {

using namespace stickslip;
using namespace stickslip::web;

int keep(RecordComponent component) {
  kept.emplace(next, std::move(component));
  return next++;
}

/// What the page chooses beside the law; the names are those of the command's options. NaN is an option that is not
/// given.
struct Settings {
  double period, damping_ratio, spring_pendulum, slope, one_way, stop_gap, restitution, vertical, clipped, scale;
};
constexpr const char* setting_names =
    "period damping_ratio pendulum slope one_way stop_gap restitution vertical clipped scale";

Mounting mounting_of(const Settings& s) {
  Mounting on;
  if (!std::isnan(s.period)) {
    detail::require(std::isfinite(s.period) && s.period > 0, "period must be positive and finite", s.period, "s");
    on.natural_frequency = 2 * std::numbers::pi / s.period;
    on.pendulum = is(s.spring_pendulum);
    if (!std::isnan(s.damping_ratio)) {
      detail::require(std::isfinite(s.damping_ratio) && s.damping_ratio >= 0,
                      "damping ratio must be finite and at least 0", s.damping_ratio);
      on.damping = 2 * on.natural_frequency * s.damping_ratio;
    }
  }
  if (!std::isnan(s.slope)) on.slope_degrees = s.slope;
  on.one_way = is(s.one_way);
  if (!std::isnan(s.stop_gap)) on.stops = Stops(s.stop_gap, std::isnan(s.restitution) ? 0 : s.restitution);
  return on;
}

/// The laws of the library whose parts are listed, which the page can give; and those with static friction on top.
template <class Law>
using HasParts = std::bool_constant<WithParts<Law>>;
using PageLaws = LibraryLaws::where<HasParts>;
template <class Law>
using IsOffered = std::bool_constant<WithParts<Law> || is_static_kinetic<Law>>;
using PageSlider = decltype(detail::sliders_of(LibraryLaws::where<IsOffered>()));

/// The type of a part.
template <class T, class OfPart>
using ValueOf = std::remove_cvref_t<std::invoke_result_t<decltype(std::declval<OfPart>().get), const T&>>;

/// The next of the numbers as a value: an object of parts, a number, or a list, which follows its length.
template <class T>
T take(std::span<const double>& numbers) {
  if constexpr (WithParts<T>) {
    return std::apply([&](const auto&... part) { return T{take<ValueOf<T, decltype(part)>>(numbers)...}; }, T::parts());
  } else if constexpr (std::convertible_to<T, double>) {
    if (numbers.empty()) throw std::invalid_argument("wrong number of parts");
    const double value = numbers.front();
    numbers = numbers.subspan(1);
    return static_cast<T>(value);
  } else {
    T list(static_cast<std::size_t>(take<double>(numbers)));
    for (auto& value : list) value = take<double>(numbers);
    return list;
  }
}

/// A slider of the settings. The numbers are the place of the law among PageLaws, the level at rest [m/s^2], NaN if it
/// is that of the law, and the parts of the law.
PageSlider slider_of(const Settings& s, std::span<const double> numbers) {
  const Mounting on = mounting_of(s);
  auto left = take<int>(numbers);
  const auto static_level = take<double>(numbers);
  std::optional<PageSlider> slider;
  PageLaws::for_each([&]<class Law>() {
    if (left-- != 0) return;
    Law law = take<Law>(numbers);
    if constexpr (LibraryLaws::has<StaticKinetic<Law>>)
      if (!std::isnan(static_level)) slider = Slider(StaticKinetic(law, static_level), on);
    if (!slider) slider = Slider(std::move(law), on);
  });
  if (!slider) throw std::invalid_argument("unknown law");
  return *std::move(slider);
}

/// Says of each part of a law the name, unit and range.
template <WithParts T>
void say_parts(const char* law) {
  const auto say = [&](const auto& part) {
    using Value = ValueOf<T, decltype(part)>;
    if constexpr (WithParts<Value>) {
      say_parts<Value>(law);
    } else {
      said += std::string(law) + "\t" + part.name + "\t" + part.unit + "\n";
      answer.insert(answer.end(),
                    {part.range.low, part.range.high, part.range.open ? 1.0 : 0.0, std::integral<Value> ? 1.0 : 0.0});
    }
  };
  std::apply([&](const auto&... part) { (say(part), ...); }, T::parts());
}

Response response;
Forces floor_forces;
std::optional<GroundMotion> driving;

struct Summary {
  double peak, residual, sliding_distance, time_sliding, slips, impacts, liftoffs, at_rest;
  double events, samples, end, input, imbalance, margin, impact_margin, pga, hold, temperature;
};
constexpr const char* summary_names =
    "peak residual sliding_distance time_sliding slips impacts liftoffs at_rest events samples end input imbalance "
    "margin impact_margin pga hold temperature";

/// The response up to the final rest, or to the end of the motion if it never rests, as the command reports it.
template <class Law>
[[gnu::noinline]] Response settled(const Slider<Law>& slider, const GroundMotion& motion, bool clipped,
                                   Response storage) {
  IntegrateOptions options;
  options.contact = clipped ? Contact::clipped : Contact::flight;
  options.settle = true;
  try {
    return integrate(slider, motion, options, std::move(storage));
  } catch (const ConvergenceError&) {
    options.settle = false;
    return integrate(slider, motion, options);
  }
}

/// The margins; keeps the forces.
Margins read(const Trajectory& trajectory) {
  floor_forces = forces(trajectory);
  return margins(trajectory);
}

double size(double residual) { return residual; }
double size(Vector2 residual) { return norm(residual); }

/// Answers with the summary of a response on one axis or in the plane.
template <class Found>
void summarize(const Found& found, const Margins& margin, bool at_rest, double pga, double hold) {
  const auto count = [&](EventKind kind) {
    double total = 0;
    for (const auto& event : found.events) total += event.kind == kind ? 1 : 0;
    return total;
  };
  const Summary summary{
      found.peak,
      size(found.residual),
      found.sliding_distance,
      found.time_sliding,
      count(EventKind::breakaway) + count(EventKind::reversal),
      count(EventKind::impact),
      count(EventKind::liftoff),
      at_rest ? 1.0 : 0.0,
      static_cast<double>(found.events.size()),
      static_cast<double>(found.displacement.size()),
      found.events.back().time,
      found.energy.input,
      found.energy.imbalance(),
      margin.load,
      margin.impact,
      pga,
      hold,
      found.temperature.empty() ? undefined : *std::max_element(found.temperature.begin(), found.temperature.end())};
  answer_with_summary(summary);
}

template <class Law>
void slide(const Slider<Law>& slider, const GroundMotion& motion, bool clipped) {
  response = settled(slider, motion, clipped, std::move(response));
  const Margins margin = read(*trajectory(slider, motion, response));
  const double held = hold(law_at(slider.law(), State{}), 0, Direction::forward);
  summarize(response, margin, response.state.mode == Mode::stuck, motion.peak_acceleration(), held);
}

/// Slides in the plane; answers with the summary, and then the components of the displacement at each sample.
template <class Law>
void slide_in_plane(const Slider<Law>& on_axis, const GroundMotion& motion, bool clipped) {
  if constexpr (IsotropicLaw<Law>) {
    const PlanarSlider<Law> slider(on_axis.law(), on_axis.mounting());
    PlanarIntegrateOptions options;
    options.contact = clipped ? Contact::clipped : Contact::flight;
    PlanarResponse found;
    try {
      options.settle = true;
      found = integrate(slider, motion, options);
    } catch (const ConvergenceError&) {
      options.settle = false;
      found = integrate(slider, motion, options);
    }
    double pga = 0;
    for (std::size_t i = 0; i < motion.samples(); ++i)
      pga = std::max(pga, std::hypot(motion.acceleration()[i], motion.transverse()[i]));
    summarize(found, margins(slider, motion, found), found.state.mode == PlanarMode::stuck, pga,
              detail::hold_at(slider, PlanarState{}));
    for (const Vector2& place : found.displacement) answer.insert(answer.end(), {place.axis, place.transverse});
  } else {
    throw std::invalid_argument("in the plane friction must be the same in all directions");
  }
}

std::vector<double> copy_of(std::span<const double> values) { return {values.begin(), values.end()}; }

/// What the page shows of a component: a line of name, component, orientation, units, 1 upward or -1 downward, azimuth,
/// start and sensor, separated by tabs; empty where there is none.
std::string line_of(const RecordComponent& one) {
  const std::string& orientation = one.motion.orientation();
  const int up = upward(orientation);
  const std::optional<double> azimuth = azimuth_of(orientation);
  return one.motion.name() + "\t" + one.name + "\t" + orientation + "\t" + one.units + "\t" +
         (up != 0 ? std::to_string(up) : "") + "\t" + (azimuth ? detail::shortest(*azimuth) : "") + "\t" + one.start +
         "\t" + one.sensor + "\n";
}

/// The next of the texts in the input, each of which ends with a zero byte.
std::string take(std::string_view& input) {
  const std::size_t end = input.find('\0');
  std::string text(input.substr(0, end));
  input.remove_prefix(end + 1);
  return text;
}

}  // namespace

extern "C" {

STICKSLIP_EXPORT(input) char* input(std::size_t size) {
  given.resize(size);
  return given.data();
}
STICKSLIP_EXPORT(text) const char* text() { return said.data(); }
STICKSLIP_EXPORT(text_size) std::size_t text_size() { return said.size(); }
STICKSLIP_EXPORT(numbers) const double* numbers() { return answer.data(); }
STICKSLIP_EXPORT(numbers_size) std::size_t numbers_size() { return answer.size(); }

/// The names of the numbers in settings and in summaries of sliders.
STICKSLIP_EXPORT(names) void names() { say_names(setting_names, summary_names); }

/// The ranges beyond which another unit is more probable. `text` has a line of quantity and of what has such values for
/// each, separated by a tab; `numbers` its bounds, the usual bounds, and from where on a value can only be meant.
STICKSLIP_EXPORT(ranges) void ranges() {
  said.clear();
  answer.clear();
  for (const PlausibleRange& range : plausible::ranges) {
    said += std::string(range.quantity) + "\t" + range.where + "\n";
    answer.insert(answer.end(), {range.low, range.high, range.usual_low, range.usual_high, range.meant_from});
  }
}

/// The laws, in the order of their numbers. `text` has a line of law, name and unit for each part, separated by tabs,
/// in the order in which they are given; `numbers` its bounds, whether the lower one is excluded, whether it is whole.
STICKSLIP_EXPORT(laws) void laws() {
  said.clear();
  answer.clear();
  PageLaws::for_each([]<class Law>() { say_parts<Law>(Law::class_name); });
}

/// Reads a record. The input is the file's name, units and component, each followed by a zero byte, and the content.
/// @param dt  NaN: as the file states
/// @return the number of the first component; `text` has a line for each
STICKSLIP_EXPORT(read) int read(double dt, int gaps) {
  return guarded([&] {
    std::string_view content(given.data(), given.size());
    const std::string file = take(content);
    RecordOptions options;
    options.units = take(content);
    options.component = take(content);
    if (!std::isnan(dt)) options.dt = dt;
    options.gaps = gaps != 0;
    std::vector<RecordComponent> components = parse_components(content, file, options);
    const int first = next;
    said.clear();
    for (RecordComponent& one : components) {
      said += line_of(one);
      keep(std::move(one));
    }
    return first;
  });
}

/// Keeps a motion whose samples [m/s^2] are the input: of the axis, and as many of each other component that there is.
STICKSLIP_EXPORT(make) int make(double dt, int transverse, int vertical) {
  return guarded([&] {
    const std::size_t parts = 1 + (transverse != 0 ? 1 : 0) + (vertical != 0 ? 1 : 0);
    const std::size_t samples = given.size() / sizeof(double) / parts;
    std::size_t next = 0;
    const auto part = [&](bool is_there) {
      std::vector<double> values(is_there ? samples : 0);
      std::memcpy(values.data(), given.data() + next * samples * sizeof(double), values.size() * sizeof(double));
      next += is_there ? 1 : 0;
      return values;
    };
    const GroundMotion motion(part(true), dt);
    std::vector<double> across = part(transverse != 0), up = part(vertical != 0);
    return keep({parts > 1 ? motion.with_components(std::move(across), std::move(up)) : motion});
  });
}

/// Keeps a stationary Gaussian motion with a Kanai-Tajimi spectrum; `frequency` in rad/s.
STICKSLIP_EXPORT(kanai_tajimi)
int kanai_tajimi(double s0, double frequency, double damping, double dt, double samples, double seed) {
  return guarded([&] {
    const GaussianExcitation source(Spectrum::kanai_tajimi(s0, frequency, damping), dt,
                                    static_cast<std::size_t>(samples));
    return keep({source.sample(static_cast<std::uint64_t>(seed), 0)});
  });
}

/// Keeps the motion of a station from the numbers, 32-bit integers, in the input.
STICKSLIP_EXPORT(station) int station() {
  return guarded([&] {
    std::vector<std::int32_t> numbers(given.size() / sizeof(std::int32_t));
    std::memcpy(numbers.data(), given.data(), numbers.size() * sizeof(std::int32_t));
    std::vector<RecordComponent> components;
    for (const std::int32_t number : numbers) components.push_back(of(number));
    return keep({station_motion(components, components.at(0).motion.orientation())});
  });
}

/// Says where a component points; the input is its component and orientation, each followed by a zero byte.
/// @return 0; `text` has its line
STICKSLIP_EXPORT(point) int point(int number) {
  return guarded([&] {
    std::string_view content(given.data(), given.size());
    RecordComponent& one = kept.at(number);
    one.name = take(content);
    one.motion = one.motion.with_orientation(take(content));
    said = line_of(one);
    return 0;
  });
}

STICKSLIP_EXPORT(discard) void discard(int number) { kept.erase(number); }

/// The accelerations of a motion [m/s^2].
STICKSLIP_EXPORT(acceleration) int acceleration(int number) {
  return guarded([&] {
    answer_with(of(number).motion.acceleration());
    return 0;
  });
}

/// The times of the samples of a motion, and of the `more` samples that follow the last [s].
STICKSLIP_EXPORT(times) int times(int number, int more) {
  return guarded([&] {
    const GroundMotion& motion = of(number).motion;
    answer.resize(motion.samples() + static_cast<std::size_t>(more));
    for (std::size_t i = 0; i < answer.size(); ++i) answer[i] = motion.time(i);
    return 0;
  });
}

/// dt, NaN for uneven times, and duration [s], PGA [m/s^2], PGV [m/s], PGD [m], CAV [m/s], Arias intensity [m/s] and Tm
/// [s] of a motion, and D5-95, D5-75 and the begin of both [s], NaN where they are not defined.
STICKSLIP_EXPORT(measures) int measures(int number) {
  return guarded([&] {
    const GroundMotion& motion = of(number).motion;
    answer = {motion.dt(),
              motion.duration(),
              motion.peak_acceleration(),
              peak_velocity(motion),
              peak_displacement(motion),
              cumulative_absolute_velocity(motion),
              arias_intensity(motion),
              mean_period(motion),
              undefined,
              undefined,
              undefined};
    try {
      const StrongMotion strong = strong_motion(motion);
      answer[8] = strong.duration;
      answer[9] = strong.duration_5_75;
      answer[10] = strong.begin;
    } catch (const std::invalid_argument&) {  // no acceleration, or a straight line
    }
    return 0;
  });
}

/// The pseudo-accelerations [m/s^2] of a motion at the periods [s] in the input: a response spectrum.
STICKSLIP_EXPORT(response_spectrum) int response_spectrum(int number, double damping) {
  return guarded([&] {
    std::vector<double> periods(given.size() / sizeof(double));
    std::memcpy(periods.data(), given.data(), periods.size() * sizeof(double));
    answer = stickslip::response_spectrum(of(number).motion, std::move(periods), {damping}).values;
    return 0;
  });
}

/// Slides. The input is the settings and the law.
/// @return 0; `numbers` is the summary, and `history` has the histories
STICKSLIP_EXPORT(slide) int slide(int number) {
  return guarded([&] {
    const Settings settings = given_settings<Settings>();
    driving = driven(settings, of(number).motion);
    std::visit([&](const auto& slider) { slide(slider, *driving, is(settings.clipped)); },
               slider_of(settings, given_numbers<Settings>()));
    return 0;
  });
}

/// Peaks and magnitudes of residuals [m] of `count` sliders, whose laws follow the settings: a sliding spectrum.
STICKSLIP_EXPORT(spectrum) int spectrum(int number, int count) {
  return guarded([&] {
    const Settings settings = given_settings<Settings>();
    const std::vector<double> laws = given_numbers<Settings>();
    const std::size_t size = laws.size() / static_cast<std::size_t>(std::max(count, 1));
    const GroundMotion motion = driven(settings, of(number).motion);
    answer.clear();
    Response one;
    for (std::size_t i = 0; i < laws.size(); i += size) {
      const auto slide = [&](const auto& slider) {
        one = settled(slider, motion, is(settings.clipped), std::move(one));
      };
      try {
        std::visit(slide, slider_of(settings, std::span(laws).subspan(i, size)));
        answer.insert(answer.end(), {one.peak, std::abs(one.residual)});
      } catch (const std::invalid_argument&) {  // it slides under its own weight
        answer.insert(answer.end(), {undefined, undefined});
      }
    }
    return 0;
  });
}

/// Slides in the plane under both horizontal components; the input is the settings and the law.
/// @return 0; `numbers` is the summary, whose residual is a distance, and then x and y at each sample [m]
STICKSLIP_EXPORT(path) int path(int number) {
  return guarded([&] {
    const Settings settings = given_settings<Settings>();
    const GroundMotion& record = of(number).motion;
    GroundMotion motion = is(settings.vertical) ? record : record.with_components(copy_of(record.transverse()));
    if (settings.scale != 1) motion = motion.scaled(settings.scale);
    std::visit([&](const auto& slider) { slide_in_plane(slider, motion, is(settings.clipped)); },
               slider_of(settings, given_numbers<Settings>()));
    return 0;
  });
}

/// What `slide` found: 0 displacement [m], 1 velocity [m/s], 2 force on the mass per unit mass [m/s^2], 3 ground
/// acceleration [m/s^2], 4 resistance of friction [m/s^2], 5 time, displacement, velocity and kind of each event, 6 the
/// height above the ground [m], empty if it never leaves it.
STICKSLIP_EXPORT(history) void history(int which) {
  answer.clear();
  switch (which) {
    case 0:
      return answer_with(response.displacement);
    case 1:
      return answer_with(response.velocity);
    case 2:
      for (std::size_t i = 0; i < floor_forces.friction.size(); ++i) answer.push_back(floor_forces.total(i));
      return;
    case 3:
      if (driving) answer_with(driving->acceleration());
      return;
    case 4:
      return answer_with(floor_forces.friction);
    case 5:
      for (const Event& event : response.events)
        answer.insert(answer.end(), {event.time, event.displacement, event.velocity,
                                     static_cast<double>(static_cast<int>(event.kind))});
      return;
    case 6:
      return answer_with(response.gap);
  }
}

}  // extern "C"
