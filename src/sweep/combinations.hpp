// The combinations of sliders, ground motions and polarities of a sweep, of sliders of any kind.
#pragma once

#include <algorithm>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "base/attempt.hpp"
#include "base/threads.hpp"
#include "stickslip/base/vector2.hpp"
#include "stickslip/sweep/sweep.hpp"

namespace stickslip::detail {

/// The impacts of the mirrored response. Those on a circular stop remain.
inline Impacts mirrored(const Impacts& impacts) noexcept { return {impacts.backward, impacts.forward}; }
inline const SideImpacts& mirrored(const SideImpacts& impacts) noexcept { return impacts; }

/// What a sweep keeps of a combination.
template <class Place, class Hits>
struct SweepOutcomeOf {
  double peak = 0;              ///< [m]
  Place residual{};             ///< [m]
  double sliding_distance = 0;  ///< [m]
  std::uint64_t events = 0;
  Hits impacts{};
  bool airborne = false;

  SweepOutcomeOf mirrored() const {
    SweepOutcomeOf other = *this;
    other.residual = -residual;
    other.impacts = detail::mirrored(impacts);
    return other;
  }
};

inline double without_minus_zero(double x) noexcept { return x + 0.0; }
inline Vector2 without_minus_zero(Vector2 r) noexcept { return {r.axis + 0.0, r.transverse + 0.0}; }

/// The table of a sweep, which all threads fill. A combination that fails is entered with its reason.
template <class Place, class Hits>
class Combinations {
 public:
  using Table = SweepTableOf<Place, Hits>;
  using Outcome = SweepOutcomeOf<Place, Hits>;

  Combinations(const Combinations&) = delete;
  Combinations& operator=(const Combinations&) = delete;

 protected:
  /// Motions and options are held by reference.
  Combinations(std::size_t sliders, bool have_stops, std::span<const GroundMotion* const> motions,
               const SweepOptions& options)
      : motions_(motions), options_(options) {
    if (sliders == 0) throw std::invalid_argument("sweep: needs at least one slider, got an empty list");
    if (motions.empty()) throw std::invalid_argument("sweep: needs at least one ground motion, got an empty list");
    table_.sliders = sliders;
    table_.records = motions.size();
    table_.polarity = options.polarity;
    table_.polarities = options.polarity == Polarity::both ? 2 : 1;
    const std::size_t size = table_.sliders * table_.records * table_.polarities;
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    Place nowhere{};
    if constexpr (std::same_as<Place, double>)
      nowhere = nan;
    else
      nowhere = {nan, nan};
    table_.residual.assign(size, nowhere);
    for (auto* values : {&table_.peak, &table_.sliding_distance}) values->assign(size, nan);
    table_.events.assign(size, 0);
    table_.airborne.assign(size, 0);
    if (have_stops) table_.impacts.assign(size, {});
  }
  ~Combinations() = default;

  const GroundMotion& motion(std::size_t record) const noexcept { return *motions_[record]; }
  std::size_t motions() const noexcept { return motions_.size(); }
  const SweepOptions& options() const noexcept { return options_; }

  /// Do all tasks.
  /// @param work  `work(next)` does the tasks that `next(task)` gives, until it returns false
  template <class Work>
  Table run(std::size_t tasks, const Work& work) {
    run_on_threads(options_.threads, tasks, stopped_, work, [this] {
      if (options_.progress) options_.progress({done_, table_.peak.size()});
    });
    std::ranges::sort(table_.failures, {},
                      [](const SweepFailure& f) { return std::tuple(f.slider, f.record, f.polarity); });
    return std::move(table_);
  }

  void check_stopped() const {
    struct Stopped {};
    if (stopped_) throw Stopped{};
  }

  bool is_wanted(bool reversed) const noexcept {
    return options_.polarity != (reversed ? Polarity::recorded : Polarity::reversed);
  }
  template <class Use>
  void for_each_polarity(Use&& use) const {
    for (const bool reversed : {false, true})
      if (is_wanted(reversed)) use(reversed);
  }

  void write(std::size_t slider, std::size_t record, bool reversed, const Outcome& outcome) {
    const std::size_t i = table_.at(slider, record, reversed && table_.polarities == 2 ? 1 : 0);
    table_.peak[i] = outcome.peak;
    table_.residual[i] = without_minus_zero(outcome.residual);
    table_.sliding_distance[i] = outcome.sliding_distance;
    table_.events[i] = outcome.events;
    table_.airborne[i] = outcome.airborne ? 1 : 0;
    if (!table_.impacts.empty()) table_.impacts[i] = outcome.impacts;
    ++done_;
  }
  void fail(std::size_t slider, std::size_t record, bool reversed, const std::string& message) {
    {
      const std::scoped_lock lock(mutex_);
      table_.failures.push_back({slider, record, reversed ? Polarity::reversed : Polarity::recorded, message});
    }
    ++done_;
  }

  /// Integrate a slider under a motion.
  /// @param mirrors     whether the response is also that of the other polarity, mirrored; both are entered if wanted
  /// @param how         options of `integrate`, to be completed
  /// @param impacts_of  `impacts_of(response)`, for the table
  template <class Slider, class Options, class Response, class ImpactsOf>
  void run_single(std::size_t slider, const Slider& integrate, std::size_t record, bool reversed, bool mirrors,
                  Options how, Response& storage, ImpactsOf&& impacts_of) {
    how.settle = options_.settle;
    how.contact = options_.contact;
    how.progress = [this] { check_stopped(); };
    how.may_end_in_flight = true;
    const auto for_each = [&](const auto& enter) {
      for_each_polarity([&](bool as) {
        if (as == reversed || mirrors) enter(as);
      });
    };
    attempt(
        [&] {
          const GroundMotion& motion = *motions_[record];
          storage = integrate(reversed ? motion.scaled(-1) : motion, how, std::exchange(storage, Response{}));
          const Outcome outcome{storage.peak,
                                storage.residual,
                                storage.sliding_distance,
                                storage.events.size() - 1,
                                table_.impacts.empty() ? Hits{} : impacts_of(storage.events),
                                storage.state.in_flight};
          for_each([&](bool as) { write(slider, record, as, as == reversed ? outcome : outcome.mirrored()); });
        },
        [&](const char* message) { for_each([&](bool as) { fail(slider, record, as, message); }); });
  }

 private:
  std::span<const GroundMotion* const> motions_;
  const SweepOptions& options_;
  Table table_;
  std::mutex mutex_;  // guards the failures
  std::atomic<bool> stopped_ = false;
  std::atomic<std::size_t> done_ = 0;
};

}  // namespace stickslip::detail
