#include "stickslip/ground/station.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "ground/records/text.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/ground/orientation.hpp"

namespace stickslip {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw std::invalid_argument("read_station: " + message); }

/// Exact where it is 0, 1 or -1.
double sine_of_degrees(double angle) {
  int quarters = 0;
  const double rest = std::remquo(angle, 90, &quarters) * (std::numbers::pi / 180);
  const double value = (quarters & 1) == 0 ? std::sin(rest) : std::cos(rest);
  return (quarters & 2) == 0 ? value : -value;
}

std::string label(const RecordComponent& component) {
  const std::string& orientation = component.motion.orientation();
  return !orientation.empty() ? orientation : !component.name.empty() ? component.name : component.motion.name();
}

/// Checks the properties that two components must share: sensor, step or times, start, and the number of samples unless a
/// common length is requested.
void require_one_time_base(const RecordComponent& a, const RecordComponent& b, bool common_length) {
  const GroundMotion &one = a.motion, &other = b.motion;
  const auto differ = [&](const std::string& what, const std::string& x, const std::string& y) {
    refuse("components must have the same " + what + ", got " + x + " (" + label(a) + ") and " + y + " (" + label(b) +
           ")");
  };
  const auto step = [](const GroundMotion& m) {
    return std::isnan(m.dt()) ? std::string("uneven times") : detail::shortest(m.dt()) + " s";
  };
  if (!a.sensor.empty() && !b.sensor.empty() && a.sensor != b.sensor) differ("sensor", a.sensor, b.sensor);
  if (step(one) != step(other)) differ("time step", step(one), step(other));
  if (!a.start.empty() && !b.start.empty() && a.start != b.start) differ("start", a.start, b.start);
  if (one.samples() != other.samples() && !common_length)
    differ("number of samples (or ask for the common length)", std::to_string(one.samples()),
           std::to_string(other.samples()));
  for (std::size_t i = 0; std::isnan(one.dt()) && i < std::min(one.samples(), other.samples()); ++i)
    if (one.time(i) != other.time(i))
      differ("times", detail::shortest(one.time(i)) + " s", detail::shortest(other.time(i)) + " s");
}

struct Horizontal {
  const RecordComponent* component;
  double azimuth;
};

/// The requested azimuth.
double azimuth_along(const std::string& along, const std::vector<Horizontal>& horizontals) {
  if (along.empty()) return horizontals[0].azimuth;
  for (const Horizontal& h : horizontals)
    if (records::same(along, h.component->name) || records::same(along, h.component->motion.orientation()))
      return h.azimuth;
  if (const std::optional<double> azimuth = azimuth_of(along)) return *azimuth;
  std::string known;
  for (const Horizontal& h : horizontals) known += (known.empty() ? "" : ", ") + label(*h.component);
  refuse("along must be an azimuth in degrees or one of the horizontal components (" + known + "), got " +
         records::quote(along));
}

/// The name of a component's motion without the component.
std::string station_name(const RecordComponent& component) {
  std::string name = component.motion.name();
  const std::string end = ", " + component.name;
  if (!component.name.empty() && name.ends_with(end)) name.resize(name.size() - end.size());
  return name;
}

}  // namespace

GroundMotion station_motion(std::span<const RecordComponent> components, const std::string& along, bool common_length) {
  if (components.empty()) refuse("needs at least one component, got none");
  std::vector<Horizontal> horizontals;
  const RecordComponent* vertical = nullptr;
  for (const RecordComponent& component : components) {
    const std::string& orientation = component.motion.orientation();
    if (const std::optional<double> azimuth = azimuth_of(orientation)) {
      horizontals.push_back({&component, *azimuth});
    } else if (upward(orientation) != 0) {
      if (vertical != nullptr)
        refuse("needs one vertical component at most, got two: " + vertical->motion.name() + " and " +
               component.motion.name());
      vertical = &component;
    } else {
      refuse("needs to know where each component points, but " + component.motion.name() +
             (orientation.empty() ? std::string(" does not say") : " says " + records::quote(orientation)) +
             "; give its orientation");
    }
    require_one_time_base(components[0], component, common_length);
  }
  if (horizontals.empty() || horizontals.size() > 2)
    refuse("needs one or two horizontal components, got " + std::to_string(horizontals.size()));

  std::size_t count = components[0].motion.samples();
  for (const RecordComponent& component : components) count = std::min(count, component.motion.samples());
  const double azimuth = azimuth_along(along, horizontals);
  const Horizontal &u = horizontals.front(), &w = horizontals.back();
  const auto towards = [&](double direction) {
    std::vector<double> n(count);
    const double across = sine_of_degrees(w.azimuth - u.azimuth);
    const double of_u = sine_of_degrees(w.azimuth - direction) / across,
                 of_w = sine_of_degrees(direction - u.azimuth) / across;
    for (std::size_t i = 0; i < count; ++i)
      n[i] = of_u * u.component->motion.acceleration()[i] + of_w * w.component->motion.acceleration()[i];
    return n;
  };
  std::vector<double> axis, transverse, up;
  if (horizontals.size() == 1) {
    if (azimuth != u.azimuth)
      refuse("needs two horizontal components for the azimuth " + detail::shortest(azimuth) + ", got " +
             label(*u.component) + " alone");
    axis.assign(u.component->motion.acceleration().begin(),
                u.component->motion.acceleration().begin() + static_cast<std::ptrdiff_t>(count));
  } else {
    constexpr double least = 0.9848;  // cos of 10 degrees
    if (!(std::abs(sine_of_degrees(w.azimuth - u.azimuth)) >= least))
      refuse("needs horizontal components that are perpendicular to within 10 degrees, got " + label(*u.component) +
             " and " + label(*w.component));
    axis = towards(azimuth);
    transverse = towards(azimuth + 90);
  }
  if (vertical != nullptr)
    for (std::size_t i = 0; i < count; ++i)
      up.push_back(upward(vertical->motion.orientation()) * vertical->motion.acceleration()[i]);

  std::string orientation;
  for (const Horizontal& h : horizontals)
    if (h.azimuth == azimuth) orientation = h.component->motion.orientation();
  if (orientation.empty()) orientation = orientation_at(azimuth);
  const GroundMotion& first = u.component->motion;
  const std::string station = station_name(*u.component);
  std::string name = station + (station.empty() ? "" : ", ") + orientation;
  const auto motion = [&]() -> GroundMotion {
    if (!std::isnan(first.dt())) return {std::move(axis), first.dt(), first.interpolation(), std::move(name)};
    std::vector<double> times(count);
    for (std::size_t i = 0; i < count; ++i) times[i] = first.time(i);
    return {std::move(axis), std::move(times), first.interpolation(), std::move(name)};
  }();
  return motion.with_orientation(orientation).with_components(std::move(transverse), std::move(up));
}

}  // namespace stickslip
