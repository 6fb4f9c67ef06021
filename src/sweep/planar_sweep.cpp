#include "stickslip/sweep/planar_sweep.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "base/threads.hpp"
#include "stickslip/error.hpp"

namespace stickslip::detail {
namespace {

struct Stopped {};

/// Impacts on a circular stop. The slider touches it at r, so that the radial velocity is that along r.
SideImpacts radial_impacts(std::span<const PlanarEvent> events) {
  SideImpacts result;
  for (const PlanarEvent& event : events) {
    if (event.kind != EventKind::impact) continue;
    ++result.count;
    result.speed = std::max(result.speed, std::abs(dot(event.velocity, event.displacement)) / norm(event.displacement));
  }
  return result;
}

class PlanarSweep {
 public:
  PlanarSweep(std::span<const PlanarSweepSlider> sliders, std::span<const GroundMotion* const> motions,
              const SweepOptions& options)
      : sliders_(sliders), motions_(motions), options_(options) {
    table_.sliders = sliders.size();
    table_.records = motions.size();
    table_.polarity = options.polarity;
    table_.polarities = options.polarity == Polarity::both ? 2 : 1;
    const std::size_t size = table_.sliders * table_.records * table_.polarities;
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (auto* values : {&table_.peak, &table_.sliding_distance}) values->assign(size, nan);
    table_.residual.assign(size, {nan, nan});
    table_.events.assign(size, 0);
    table_.airborne.assign(size, 0);
    if (std::ranges::any_of(sliders, &PlanarSweepSlider::has_stops)) table_.impacts.assign(size, {});
  }

  PlanarSweepTable run() {
    const std::size_t tasks = sliders_.size() * motions_.size();
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
      PlanarResponse storage;
      for (std::size_t task; !stopped_ && (task = next++) < tasks;) {
        const std::size_t record = task / sliders_.size(), slider = task % sliders_.size();
        for (const bool reversed : {false, true})
          if (sliders_[slider].mirrors ? !reversed : is_wanted(reversed)) run_one(slider, record, reversed, storage);
      }
    };
    run_on_threads(options_.threads, tasks, stopped_, work, [this] {
      if (options_.progress) options_.progress({done_, table_.peak.size()});
    });
    std::ranges::sort(table_.failures, {},
                      [](const SweepFailure& f) { return std::tuple(f.slider, f.record, f.polarity); });
    return std::move(table_);
  }

 private:
  bool is_wanted(bool reversed) const {
    return options_.polarity != (reversed ? Polarity::recorded : Polarity::reversed);
  }

  /// Integrates one combination, and enters it also in its mirror image where that is wanted.
  void run_one(std::size_t slider, std::size_t record, bool reversed, PlanarResponse& storage) {
    const auto check_stopped = [this] {
      if (stopped_) throw Stopped{};
    };
    PlanarIntegrateOptions how;
    how.settle = options_.settle;
    how.contact = options_.contact;
    how.progress = check_stopped;
    how.may_end_in_flight = true;
    const auto for_each_polarity = [&](const auto& enter) {
      for (const bool as : {false, true}) {
        if (!is_wanted(as) || (as != reversed && !sliders_[slider].mirrors)) continue;
        enter(as);
        ++done_;
      }
    };
    const auto fail = [&](const std::exception& error) {
      const std::scoped_lock lock(mutex_);
      for_each_polarity([&](bool as) {
        table_.failures.push_back({slider, record, as ? Polarity::reversed : Polarity::recorded, error.what()});
      });
    };
    try {
      const GroundMotion& motion = *motions_[record];
      storage = sliders_[slider].integrate(reversed ? motion.scaled(-1) : motion, how,
                                           std::exchange(storage, PlanarResponse{}));
      for_each_polarity([&](bool as) {
        write(table_.at(slider, record, as && table_.polarities == 2 ? 1 : 0), storage, as != reversed);
      });
    } catch (const ConvergenceError& error) {
      fail(error);
    } catch (const std::overflow_error& error) {
      fail(error);
    } catch (const std::invalid_argument& error) {
      fail(error);
    }
  }

  void write(std::size_t i, const PlanarResponse& response, bool mirrored) {
    const Vector2 residual = mirrored ? -response.residual : response.residual;
    table_.peak[i] = response.peak;
    table_.residual[i] = {residual.axis + 0.0, residual.transverse + 0.0};  // minus zero is zero
    table_.sliding_distance[i] = response.sliding_distance;
    table_.events[i] = response.events.size() - 1;
    table_.airborne[i] = response.state.in_flight ? 1 : 0;
    if (!table_.impacts.empty()) table_.impacts[i] = radial_impacts(response.events);
  }

  std::span<const PlanarSweepSlider> sliders_;
  std::span<const GroundMotion* const> motions_;
  const SweepOptions& options_;
  PlanarSweepTable table_;
  std::mutex mutex_;  // guards the failures
  std::atomic<bool> stopped_ = false;
  std::atomic<std::size_t> done_ = 0;
};

}  // namespace

PlanarSweepTable sweep(std::span<const PlanarSweepSlider> sliders, std::span<const GroundMotion* const> motions,
                       const SweepOptions& options) {
  if (sliders.empty()) throw std::invalid_argument("sweep: needs at least one slider, got an empty list");
  if (motions.empty()) throw std::invalid_argument("sweep: needs at least one ground motion, got an empty list");
  return PlanarSweep(sliders, motions, options).run();
}

}  // namespace stickslip::detail
