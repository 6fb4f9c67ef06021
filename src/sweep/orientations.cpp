#include "stickslip/sweep/orientations.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "base/threads.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/ground/processing.hpp"

namespace stickslip::detail {
namespace {

struct Stopped {};

/// A place in the list of directions, and whether the response is that of the opposite direction.
struct Place {
  std::size_t index;
  bool turned;
};

/// The places of each angle from 0 to 360 degrees; to 180 where the response in the opposite direction is mirrored.
std::map<double, std::vector<Place>> places_of(std::span<const double> degrees, bool mirrored) {
  std::map<double, std::vector<Place>> places;
  for (std::size_t i = 0; i < degrees.size(); ++i) {
    require(std::isfinite(degrees[i]), "orientations: degrees[" + std::to_string(i) + "] must be finite", degrees[i],
            "degrees");
    double angle = std::fmod(degrees[i], 360);  // exact, so that rotation has the same bits
    if (angle < 0 && equal(angle + 360 - 360, angle)) angle += 360;
    const bool turned = mirrored && std::abs(angle) >= 180;
    if (turned) angle -= std::copysign(180, angle);
    places[angle + 0.0].push_back({i, turned});
  }
  return places;
}

}  // namespace

Orientations orientations(const SweepSlider& slider, bool mirrored, const GroundMotion& station,
                          std::span<const double> degrees, const OrientationsOptions& options) {
  if (degrees.empty()) throw std::invalid_argument("orientations: needs at least one direction, got an empty list");
  if (!station.has_transverse())
    throw std::invalid_argument("orientations: '" + station.name() + "' needs a transverse component, it has none");
  const auto grouped = places_of(degrees, mirrored);
  const std::vector<std::pair<double, std::vector<Place>>> tasks(grouped.begin(), grouped.end());

  Orientations result;
  result.peak.assign(degrees.size(), std::numeric_limits<double>::quiet_NaN());
  result.residual = result.peak;
  std::mutex mutex;  // guards the failures
  std::atomic<bool> stopped = false;
  std::atomic<std::size_t> done = 0;

  const auto work = [&](const NextTask& next) {
    const auto check_stopped = [&] {
      if (stopped) throw Stopped{};
    };
    const IntegrateOptions how{
        .settle = options.settle, .contact = options.contact, .progress = check_stopped, .may_end_in_flight = true};
    Response storage;
    for (std::size_t task; next(task);) {
      const auto& [angle, places] = tasks[task];
      const auto fail = [&, &these = places](const std::exception& error) {
        const std::scoped_lock lock(mutex);
        for (const Place& place : these) result.failures.push_back({place.index, error.what()});
      };
      try {
        storage = slider.integrate(rotated(station, angle), how, std::exchange(storage, Response{}));
        for (const auto& [index, turned] : places) {
          result.peak[index] = storage.peak;
          result.residual[index] = (turned ? -storage.residual : storage.residual) + 0.0;  // minus zero is zero
        }
      } catch (const ConvergenceError& error) {
        fail(error);
      } catch (const std::overflow_error& error) {
        fail(error);
      } catch (const std::invalid_argument& error) {
        fail(error);
      }
      done += places.size();
    }
  };
  run_on_threads(options.threads, tasks.size(), stopped, work, [&] {
    if (options.progress) options.progress(done, degrees.size());
  });
  std::ranges::sort(result.failures, {}, &OrientationFailure::place);
  return result;
}

}  // namespace stickslip::detail
