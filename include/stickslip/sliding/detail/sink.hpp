// Where the segments of a motion come from and what the motion is shown to, for code that is compiled once for all
// laws.
#pragma once

#include <utility>

#include "stickslip/base/equal.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/sliding/observer.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/state/state.hpp"
#include "stickslip/state/surface_heat.hpp"

namespace stickslip::detail {

/// The motion during a slip or a part of one, without the type of its flow; valid while it is shown.
class SlipFlow {
 public:
  SlipFlow() = default;
  template <class Flow>
  explicit SlipFlow(const Flow& flow) noexcept : flow_(&flow), answers_(&answers_of<Flow>) {}

  /// @param t  since the beginning of the part [s]
  Progress at(double t) const { return answers_->at(flow_, t); }

  /// Whether its friction heats the sliding surface; if so, the heat at a time.
  bool heats() const noexcept { return answers_ != nullptr && answers_->heat != nullptr; }
  void heat(double t, SurfaceHeat& heat) const { answers_->heat(flow_, t, heat); }

  /// Work up to a time on a pendulum, of the deviation of N+ from g, per unit mass [m^2/s^2].
  double pendulum_work(double t) const { return answers_->pendulum_work ? answers_->pendulum_work(flow_, t) : 0; }

 private:
  struct Answers {
    Progress (*at)(const void*, double);
    void (*heat)(const void*, double, SurfaceHeat&) = nullptr;
    double (*pendulum_work)(const void*, double) = nullptr;
  };
  template <class Flow>
  static constexpr Answers answers() noexcept {
    Answers of{[](const void* flow, double t) -> Progress { return static_cast<const Flow*>(flow)->at(t); }};
    if constexpr (requires(const Flow& flow, double t, SurfaceHeat& heat) { flow.heat(t, heat); })
      of.heat = [](const void* flow, double t, SurfaceHeat& heat) { static_cast<const Flow*>(flow)->heat(t, heat); };
    if constexpr (requires(const Flow& flow, double t) { flow.pendulum_work(t); })
      of.pendulum_work = [](const void* flow, double t) { return static_cast<const Flow*>(flow)->pendulum_work(t); };
    return of;
  }
  template <class Flow>
  static constexpr Answers answers_of = answers<Flow>();

  const void* flow_ = nullptr;
  const Answers* answers_ = nullptr;
};

/// What a sink keeps of the energy.
enum class Account {
  none,
  without_friction,  ///< the engine adds all but the work of the load, which a Slip has, and that against friction
  whole              ///< the engine also adds the work against friction, slip by slip
};

/// Receives each slip, or part of one, and each event of a motion. Times are measured from the beginning of the segment
/// [s]. Engines are compiled for this type; Coulomb friction on level ground has its sinks inlined instead.
class Sink {
 public:
  virtual void slide(const Slip& slip, const SlipFlow& flow) = 0;
  virtual void event(EventKind kind, double time, const State& state) = 0;

  Account account() const noexcept { return account_; }
  Energy energy{};  ///< to which the engine adds what the account asks for

 protected:
  explicit Sink(Account account = Account::none) noexcept : account_(account) {}
  Sink(const Sink&) = default;
  Sink& operator=(const Sink&) = default;
  ~Sink() = default;

 private:
  Account account_;
};

/// A sink that ignores everything.
class NoSink final : public Sink {
 public:
  void slide(const Slip&, const SlipFlow&) override {}
  void event(EventKind, double, const State&) override {}
};

/// Shows a motion to an observer of any type.
template <MotionObserver Observer>
class ObserverSink final : public Sink {
 public:
  /// @param observer  held by reference
  explicit ObserverSink(Observer& observer) noexcept
      : Sink(EnergyObserver<Observer> ? Account::whole : Account::none), observer_(observer) {}

  void slide(const Slip& slip, const SlipFlow& flow) override {
    if constexpr (requires { observer_.follow(flow, slip.duration); }) observer_.follow(flow, slip.duration);
    show_energy();
    observer_.slide(slip);
  }
  void event(EventKind kind, double time, const State& state) override {
    show_energy();
    observer_.event(kind, time, state);
  }
  /// Show the energy of the last landing.
  void show_energy() {
    if constexpr (EnergyObserver<Observer>) {
      if (!equal(energy.dissipated, 0)) observer_.dissipate(std::exchange(energy.dissipated, 0));
      if (!equal(energy.impact, 0)) observer_.lose(std::exchange(energy.impact, 0));
    }
  }

 private:
  Observer& observer_;
};

/// The state of a slider between two segments.
class StateView : public BareState {
 public:
  explicit StateView(const BareState& state) noexcept : BareState(state) {}
  explicit StateView(const State& state) noexcept : BareState(state), whole_(&state) {}

  /// With the memory of the law.
  State state() const { return whole_ != nullptr ? *whole_ : State(*this); }
  /// Replaces what differs in a state with the same law's memory.
  void store(State& state) const {
    if (whole_ != nullptr)
      state = *whole_;
    else
      BareState::store(state);
  }

 private:
  const State* whole_ = nullptr;
};

/// Gives the segments of a motion, one after the other.
template <class AnySegment>
class Segments {
 public:
  using Given = AnySegment;

  /// @param now      the state at the end of the last segment, at first that at the start
  /// @param segment  where to put the next one
  /// @return whether there is a next one
  virtual bool next(const StateView& now, AnySegment& segment) = 0;

 protected:
  ~Segments() = default;
};

template <class AnySegment>
class OneSegment final : public Segments<AnySegment> {
 public:
  explicit OneSegment(const AnySegment& segment) noexcept : segment_(segment) {}

  bool next(const StateView&, AnySegment& segment) override {
    segment = segment_;
    return !std::exchange(given_, true);
  }

 private:
  AnySegment segment_;
  bool given_ = false;
};

}  // namespace stickslip::detail
