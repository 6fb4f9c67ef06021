// A cart as a sliding system: the event loop asks it what it asks a slider.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "carts/acceleration.hpp"
#include "carts/hold.hpp"
#include "carts/leg.hpp"
#include "carts/model.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/carts/response.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/run/detail/loop.hpp"
#include "stickslip/run/detail/system.hpp"

namespace stickslip::detail {

/// A short motion in which what begins to slide is slaved to its force.
struct CartCreep {
  double begin, duration;           ///< [s]
  double input;                     ///< work of the ground [m^2/s^2]
  const std::vector<double>& work;  ///< against the friction of each line and foot [m^2/s^2]
  /// r'' at the Gauss points of three, of which the gain of velocity is the weighted sum [m/s^2].
  const std::array<Vector2, 3>& accelerations;
};

/// Receives the motion of a cart while it is computed. Times are since the beginning of the segment [s].
class CartSink {
 public:
  virtual void follow(const CartLeg& leg, double begin, double duration, const CartState& end) = 0;
  /// Of the event loop: `breakaway` and `reversal` out of rest, `arrest`.
  virtual void event(EventKind kind, double time, const CartState& state) = 0;
  /// A line or a foot sticks, slips or reverses.
  virtual void happens(CartEventKind /*kind*/, double /*time*/, const CartState&, std::size_t /*line*/) {}
  virtual void creep(const CartCreep&, const CartState& /*end*/) {}
  /// How far a decision was from another one, over the accelerations that take part.
  virtual void decide(double /*margin*/) {}

 protected:
  ~CartSink() = default;
};

/// The memory of a cart's motion, kept from segment to segment.
struct CartWorkspace {
  explicit CartWorkspace(const CartModel& cart)
      : model(cart), leg(cart), fresh(cart.contacts()), turning(3 * cart.casters) {}

  const CartModel& model;
  CartLeg leg;
  AccelerationProblem problem;
  CartHold hold;  // while it rests
  bool knows_hold = false;
  bool slaving = false;             // a slow start goes on in the next segment
  std::vector<std::uint8_t> fresh;  // as CartLeg::begin
  std::vector<std::size_t> asked;   // the lines of the problem
  CartState end;                    // of the leg
  std::vector<std::int8_t> before;  // the lines before an event
  Zonotope still;                   // of the lines that stick
  CartState stage;                  // of a step
  std::vector<double> turning;      // rates of the headings at three points of a step
  std::vector<double> work;
  std::vector<std::int8_t> modes;  // at the first of these points
};

struct CartDeparture {
  bool leaves = false;
  double delay = 0;
  bool beyond = false;            // the load lies beyond what holds already
  bool tied = false;              // several faces meet
  const Vector3* face = nullptr;  // through which it leaves; null: in a direction without friction
  double excess = 0;              // of the load over that face, then [m/s^2]
  bool departs() const noexcept { return leaves; }
};

struct CartSlide {
  enum class Now { leg, halt, slow_foot, slaved };  // what comes next, without a leg

  CartLeg* leg;
  CartLeg::Event next;
  Now now = Now::leg;
  double stop = never;  // stops are passages

  struct Leg {
    double time;
  };
  bool moves() const noexcept { return now == Now::leg; }
  Leg whole() const noexcept { return {leg->duration()}; }
  Leg until(double t) const noexcept { return {t}; }
};

struct CartPassage {
  bool passes = false;
  CartSlide::Leg leg{};
};

/// A cart during one segment (a SlidingSystem).
class CartSystem {
 public:
  static constexpr int most_steps = 1'000'000;
  static constexpr double a_little = 1e-6;  // after which a tie is decided [s]

  CartSystem(CartWorkspace& work, const CartSegment& ground, CartState& state)
      : work_(work), model_(work.model), ground_(ground), state_(state) {
    std::fill(work_.fresh.begin(), work_.fresh.end(), std::uint8_t{0});
    if (state_.mode == CartMode::moving && state_.lines.size() != model_.contacts()) {
      state_.lines.assign(model_.contacts(), 0);
      decide_all();
    }
    if (std::exchange(work_.slaving, false)) {
      slaved_ = from_rest;
      slaving_ = true;
    }
  }

  double left() const noexcept { return ground_.duration - now_; }
  double elapsed() const noexcept { return now_; }
  const CartState& state() const noexcept { return state_; }
  const CartState& resting_state() const noexcept { return state_; }
  bool at_rest() const noexcept { return state_.mode == CartMode::rest; }
  bool has_stopped() const noexcept { return stopped_; }

  /// The margins of all faces are linear in time.
  CartDeparture departure() {
    find_hold();
    const double turn = ground_.weightless();
    CartDeparture first;
    double soonest = never;
    const auto piece = [&](double begin, double end) {
      const Vector3 from = load_at(state_, begin), to = load_at(state_, end);
      const double heavy_from = weight_at(begin), heavy_to = weight_at(end);
      const auto look = [&](const Vector3* face, double f0, double f1) {
        if (!(std::max(f0, f1) > 0)) return;
        const double delay = begin - now_ + (f0 >= 0 ? 0 : (end - begin) * (f0 / (f0 - f1)));
        const bool meets = std::abs(delay - soonest) <= 1e-9 * left();
        if (delay < soonest || (meets && f0 > first.excess)) first = {true, delay, false, first.tied, face, f0};
        first.tied = meets || (first.tied && !(delay < soonest));
        soonest = std::min(soonest, delay);
      };
      if (work_.hold.has_feet()) {
        if (work_.hold.surely_carries(from, heavy_from) && work_.hold.surely_carries(to, heavy_to)) return;
        // Loads are carried in an interval of time: from outside each plane cuts nearer.
        Vector3 normal{};
        if (work_.hold.leaves(from, heavy_from, normal)) {
          first = {true, begin - now_, !(begin > now_), false, nullptr};
          return;
        }
        double part = 1;
        for (int steps = 0; steps < 100; ++steps) {
          Vector3 load = scaled(1 - part, from);
          add_to(load, part, to);
          if (!work_.hold.leaves(load, (1 - part) * heavy_from + part * heavy_to, normal)) break;
          const double most = work_.hold.support(normal);
          const double f0 = dot(normal, from) - most * heavy_from, f1 = dot(normal, to) - most * heavy_to;
          const double next = f0 >= 0 ? 0 : f0 / (f0 - f1);
          first = {true, begin - now_ + (end - begin) * std::min(next, part), false, false, nullptr};
          if (!(next < part)) break;
          part = next;
        }
        if (!first.leaves) work_.hold.learn(norm(from) > norm(to) ? from : to);
        return;
      }
      const Zonotope& lines = work_.hold.lines();
      for (const Zonotope::Face& face : lines.faces())
        look(&face.normal, dot(face.normal, from) - face.reach * heavy_from,
             dot(face.normal, to) - face.reach * heavy_to);
      if (lines.rank() == 3) return;
      const Vector3 out = lines.outside(from), out_end = lines.outside(to);
      const double size = std::max(norm(from), norm(to));
      const auto beside = [&](const Vector3& f) { return norm(f) > 1e-12 * size ? norm(f) : 0.0; };
      look(nullptr, beside(out), beside(out_end));
    };
    if (turn > now_ && turn < ground_.duration) {
      piece(now_, turn);
      if (!first.leaves) piece(turn, ground_.duration);
    } else {
      piece(now_, ground_.duration);
    }
    // A load barely beyond leaves through its face; what it moves is not known better from the problem.
    if (first.face != nullptr && first.excess > 1e-6 * norm(load_at(state_, now_))) first.beyond = true;
    return first;
  }

  Resumption depart(const CartDeparture& departure) {
    now_ = std::min(now_ + departure.delay, ground_.duration);
    state_.mode = CartMode::moving;
    state_.lines.assign(model_.contacts(), 0);
    work_.knows_hold = false;
    std::fill(work_.fresh.begin(), work_.fresh.end(), std::uint8_t{0});
    bool known = false;
    if (work_.hold.has_feet()) {
      slaved_ = departure.beyond ? after_stop : from_rest;
    } else if (departure.beyond || departure.tied) {
      ask_all();
      if (departure.beyond) {
        solve(state_, now_);
        known = !work_.problem.rests();
        if (known) take(1);
      }
      if (!known) {
        solve(state_, now_ + a_little);
        known = !work_.problem.rests();
        if (known) take(2);
      }
    }
    if (!known && departure.face != nullptr) {
      const Vector3 normal = *departure.face;
      for (std::size_t l = 0; l < model_.lines.size(); ++l) {
        state_.lines[l] = static_cast<std::int8_t>(work_.hold.lines().leaves(normal, l));
        work_.fresh[l] = state_.lines[l] == 0 ? 0 : departure.excess > 1e-12 * norm(load_at(state_, now_)) ? 1 : 2;
      }
    }
    return std::exchange(stopped_, false) && !(departure.delay > 0) ? Resumption::reversed : Resumption::from_rest;
  }

  CartSlide slide() {
    CartLeg& leg = work_.leg;
    if (const auto now = at_once(); now != CartSlide::Now::leg) return {&leg, {}, now};
    for (int tries = 0;; ++tries) {
      leg.begin(state_, ground_, now_, work_.fresh);
      // Forces can jump where a segment begins.
      if (tries > 0 || !(leg.excess() > 1e-9)) break;
      decide_all();
      if (const auto now = at_once(); now != CartSlide::Now::leg) return {&leg, {}, now};
    }
    return {&leg, leg.next()};
  }

  CartPassage passage(const CartSlide& slide) const noexcept {
    if (!slide.moves()) return {true, {0}};
    if (slide.next.what == CartLeg::What::nothing) return {};
    return {true, {slide.next.time}};
  }

  void show(const CartSlide& slide, const CartSlide::Leg& leg, CartSink& sink) {
    if (!slide.moves()) return;
    slide.leg->at(leg.time, work_.end);
    sink.follow(*slide.leg, now_, leg.time, work_.end);
  }

  bool pass(const CartSlide& slide, const CartPassage& passage, CartSink& sink) {
    using Now = CartSlide::Now;
    using What = CartLeg::What;
    if (slide.moves()) go(passage.leg);
    work_.before = state_.lines;
    if (slide.now == Now::halt) {
      rest();
      return true;
    }
    if (slide.now == Now::slaved) {
      creep(sink);
    } else if (slide.now == Now::slow_foot) {
      decide(CartModel::none, sink);
    } else if (slide.next.what == What::foot) {
      slaved_ = from_rest;
      return left() > 0;
    } else if (slide.next.what == What::face && slide.next.tied) {
      slide.leg->at(slide.next.time + a_little, work_.end);
      ask(-1);
      solve(work_.end, now_ + a_little);
      take(2);
    } else if (slide.next.what == What::face) {
      const Zonotope& stuck = slide.leg->stuck();
      const Vector3 normal = stuck.faces()[slide.next.which].normal;
      for (std::size_t j = 0; j < stuck.size(); ++j) {
        const std::size_t l = slide.leg->stuck_line(j);
        state_.lines[l] = static_cast<std::int8_t>(stuck.leaves(normal, j));
        if (state_.lines[l] != 0) work_.fresh[l] = 2;
      }
    } else {
      if (is_slow(model_.slow)) {
        rest();
        return true;
      }
      decide(slide.next.which, sink);
    }
    if (at_rest()) return true;
    for (std::size_t l = 0; l < model_.contacts(); ++l) {
      if (work_.before[l] == state_.lines[l]) continue;
      sink.happens(state_.lines[l] == 0   ? CartEventKind::stick
                   : work_.before[l] == 0 ? CartEventKind::slip
                                          : CartEventKind::reversal,
                   now_, state_, l);
    }
    if (now_ > mark_ + 1e-9) {
      mark_ = now_;
      hurries_ = 0;
    } else if (slide.moves() && ++hurries_ > 30) {
      hurries_ = 0;
      slaved_ = hurried;
    }
    return left() > 0;
  }

  bool proceed(const CartSlide&, const CartSlide::Leg& leg) {
    const bool ends = !(leg.time < left());
    go(leg);
    return !ends;
  }

  void stop(const CartSlide&, const CartSlide::Leg&) const noexcept {}

  [[noreturn]] void stall() const {
    throw ConvergenceError("advance: in a segment of " + shortest(ground_.duration) +
                           " s the wheels of the cart stick and slip faster than its time can be resolved, at |v| = " +
                           shortest(norm(state_.velocity)) + " m/s, " + shortest(left()) + " s before its end");
  }

 private:
  void go(const CartSlide::Leg& leg) {
    now_ = leg.time < left() ? ground_.duration - pass_time(left(), leg.time) : ground_.duration;
    std::swap(state_.headings, work_.end.headings);
    state_.displacement = work_.end.displacement;
    state_.yaw = work_.end.yaw;
    state_.velocity = work_.end.velocity;
    state_.yaw_rate = work_.end.yaw_rate;
    // Several faces may open at once.
    if (leg.time > 1e-10 * work_.leg.duration()) std::fill(work_.fresh.begin(), work_.fresh.end(), std::uint8_t{0});
  }

  double weight_at(double t) const noexcept { return std::max(ground_.heavy(t), 0.0); }
  // In the cart's frame.
  Vector3 load_at(const CartState& state, double t) const noexcept {
    const Vector2 a = ground_.ground(t);
    const double c = std::cos(state.yaw), s = std::sin(state.yaw);
    return {-(c * a.axis + s * a.transverse), -(c * a.transverse - s * a.axis), 0};
  }

  void find_hold() {
    if (work_.knows_hold) return;
    work_.hold.set(model_, state_);
    work_.knows_hold = true;
  }

  double speed_of(const CartState& state, const Vector3& y, std::size_t l) const noexcept {
    if (l < model_.lines.size()) return dot(model_.row(model_.lines[l], state), y);
    const Vector2 v = CartModel::pivot(model_.wheels[model_.feet[l - model_.lines.size()].wheel], y);
    return std::hypot(v.axis, v.transverse);
  }
  bool is_slow(double speed) const noexcept { return norm(model_.velocities(state_)) <= speed; }

  // What comes without a leg.
  CartSlide::Now at_once() const {
    using Now = CartSlide::Now;
    if (at_rest()) return Now::halt;
    if (slaved_ > 0) return Now::slaved;
    if (model_.feet.empty() || !(ground_.heavy(now_) > 0)) return Now::leg;
    const Vector3 y = model_.velocities(state_);
    if (norm(y) <= model_.halted) return Now::halt;
    for (std::size_t l = model_.lines.size(); l < model_.contacts(); ++l)
      if (state_.lines[l] != 0 && speed_of(state_, y, l) <= model_.slow) return Now::slow_foot;
    return Now::leg;
  }

  // Asks for all that sticks, is slow, or is named.
  void ask(double slow, std::size_t named = CartModel::none) {
    const Vector3 y = model_.velocities(state_);
    work_.asked.clear();
    for (std::size_t l = 0; l < model_.contacts(); ++l)
      if (l == named || state_.lines[l] == 0 || std::abs(speed_of(state_, y, l)) <= slow) work_.asked.push_back(l);
  }
  void ask_all() {
    work_.asked.clear();
    for (std::size_t l = 0; l < model_.contacts(); ++l) work_.asked.push_back(l);
  }

  void rest() {
    state_.velocity = {};
    state_.yaw_rate = 0;
    state_.mode = CartMode::rest;
    state_.lines.clear();
    slaved_ = 0;
    slaving_ = false;
    work_.knows_hold = false;
    stopped_ = true;
  }

  // The acceleration when the lines `asked` have no velocity.
  void solve(const CartState& state, double time) {
    const Vector3 y = model_.velocities(state);
    const double turning = y[2] / model_.gyration, heavy = weight_at(time);
    Vector3 p = load_at(state, time);
    p[0] += turning * y[1];
    p[1] -= turning * y[0];
    AccelerationProblem& problem = work_.problem;
    problem.clear();
    std::size_t next = 0;
    for (std::size_t l = 0; l < model_.lines.size(); ++l) {
      const CartModel::Line& line = model_.lines[l];
      const CartModel::Wheel& wheel = model_.wheels[line.wheel];
      const Vector2 e = model_.direction(wheel, state), n{-e.transverse, e.axis};
      const Vector3 row = CartModel::row_of(wheel, line.along ? e : n);
      if (next < work_.asked.size() && work_.asked[next] == l) {
        ++next;
        double beta = 0;
        if (wheel.caster != CartModel::none) {
          const Vector2 v = CartModel::pivot(wheel, y);
          const bool straight = wheel.across != CartModel::none && asks(wheel.across);
          const double turns = (straight ? 0 : stickslip::dot(n, v) * wheel.per_reach) - turning;
          beta = turns * (line.along ? stickslip::dot(n, v) : -stickslip::dot(e, v));
        }
        problem.add(row, beta, line.coefficient * heavy);
      } else {
        add_to(p, -state_.lines[l] * line.coefficient * heavy, row);
      }
    }
    for (std::size_t f = 0; f < model_.feet.size(); ++f) {
      const CartModel::Foot& foot = model_.feet[f];
      const std::size_t l = model_.lines.size() + f;
      const Vector3 axis = model_.row_axis(foot), transverse = model_.row_transverse(foot);
      if (asks(l)) {
        problem.add(axis, transverse, foot.coefficient * heavy);
        continue;
      }
      const Vector2 v = CartModel::pivot(model_.wheels[foot.wheel], y);
      const double speed = std::hypot(v.axis, v.transverse), force = foot.coefficient * heavy;
      if (state_.lines[l] == 0 || !(speed > 0)) continue;
      add_to(p, -force * v.axis / speed, axis);
      add_to(p, -force * v.transverse / speed, transverse);
    }
    problem.solve(p);
  }
  bool asks(std::size_t line) const noexcept {
    return std::binary_search(work_.asked.begin(), work_.asked.end(), line);
  }

  // What sticks or slides of all that is slow, and of one that is named.
  void decide(std::size_t named, CartSink& sink) {
    ask(model_.slow, named);
    solve(state_, now_);
    sink.decide(work_.problem.gap());
    take_or_creep();
  }
  // A foot that goes on through a velocity of zero starts anew.
  void take_or_creep() {
    for (std::size_t i = 0; i < work_.asked.size(); ++i)
      if (work_.asked[i] >= model_.lines.size() && work_.problem.slides(i) != 0) {
        slaved_ = after_stop;
        return;
      }
    take(1);
  }

  // The mode that the problem found.
  // @param begins  how many of the first derivatives of a new slip vanish
  void take(std::uint8_t begins) {
    std::fill(work_.fresh.begin(), work_.fresh.end(), std::uint8_t{0});
    for (std::size_t i = 0; i < work_.asked.size(); ++i) {
      const std::size_t l = work_.asked[i];
      state_.lines[l] = static_cast<std::int8_t>(work_.problem.slides(i));
      work_.fresh[l] = state_.lines[l] != 0 ? begins : std::uint8_t{0};
    }
    settle_speeds();
  }

  // No velocity along what sticks.
  void settle_speeds() {
    Zonotope& stuck = work_.still;
    stuck.clear();
    for (std::size_t l = 0; l < model_.lines.size(); ++l)
      if (state_.lines[l] == 0) stuck.add(model_.row(model_.lines[l], state_), 0);
    for (std::size_t f = 0; f < model_.feet.size(); ++f) {
      if (state_.lines[model_.lines.size() + f] != 0) continue;
      stuck.add(model_.row_axis(model_.feet[f]), 0);
      stuck.add(model_.row_transverse(model_.feet[f]), 0);
    }
    if (stuck.size() == 0) return;
    stuck.close();
    if (stuck.rank() == 3)
      rest();
    else
      model_.set_velocities(state_, stuck.outside(model_.velocities(state_)));
  }

  // From velocities alone, or where forces have jumped.
  void decide_all() {
    const Vector3 y = model_.velocities(state_);
    for (std::size_t l = 0; l < model_.contacts(); ++l) {
      const double speed = speed_of(state_, y, l);
      if (state_.lines[l] == 0 && std::abs(speed) > model_.slow)
        state_.lines[l] = static_cast<std::int8_t>(speed > 0 ? 1 : -1);
    }
    ask(model_.slow);
    solve(state_, now_);
    take_or_creep();
  }

  // A short step along the acceleration of the problem, where what begins to slide is slaved to its force, or where noise
  // decides signs: by Gauss collocation with three points. Out of rest the velocity has the direction u of the acceleration,
  // whose friction holds it there: y = u times the integral of |a|. It lags behind by |y| |u'|/L, which enters squared.
  void creep(CartSink& sink) {
    if (slaving_) {
      ask_all();
      // Forces can jump where a segment begins, or fall back to what holds.
      solve(state_, now_);
      const Vector3 rate = work_.problem.acceleration(), y = model_.velocities(state_);
      if (!(dot(rate, y) > (1 - 1e-4) * norm(rate) * norm(y)) || !(norm(rate) > 1e-9 * least_level())) {
        slaved_ = 0;
        slaving_ = false;
        return;
      }
    } else {
      ask(equal(slaved_, hurried) ? model_.steady : model_.slow);
    }
    double h = std::min(std::exchange(slaved_, 0), left());
    const std::size_t casters = model_.casters, contacts = model_.contacts();
    // The direction of a foot that slides changes within |V|/L.
    for (const CartModel::Foot& foot : model_.feet) {
      const std::size_t l = model_.lines.size() + static_cast<std::size_t>(&foot - model_.feet.data());
      const double level = foot.coefficient * weight_at(now_),
                   lever = std::hypot(model_.wheels[foot.wheel].lever_x, model_.wheels[foot.wheel].lever_y);
      if (!asks(l) && level > 0)
        h = std::min(h, 0.05 * speed_of(state_, model_.velocities(state_), l) / (level * (1 + lever * lever)));
    }
    const double asked = h;
    static const double root = std::sqrt(15.0);
    const double nodes[3] = {0.5 - root / 10, 0.5, 0.5 + root / 10}, weights[3] = {5.0 / 18, 4.0 / 9, 5.0 / 18};
    const double a[3][3] = {{5.0 / 36, 2.0 / 9 - root / 15, 5.0 / 36 - root / 30},
                            {5.0 / 36 + root / 24, 2.0 / 9, 5.0 / 36 - root / 24},
                            {5.0 / 36 + root / 30, 2.0 / 9 + root / 15, 5.0 / 36}};
    const Vector3 y0 = model_.velocities(state_);
    const double speed0 = norm(y0);
    const bool whole = work_.asked.size() == contacts && (slaving_ || !(speed0 > 0)) && !model_.feet.empty();
    slaving_ = false;
    const Vector3 first = whole && speed0 > 0 ? scaled(1 / speed0, y0) : Vector3{};
    CartState& stage = work_.stage;
    stage = state_;
    Vector3 rates[3]{}, speeds[3]{}, last{};  // last: the direction at the end
    double lag = 0;
    Vector2 ways[3]{};
    std::array<Vector2, 3> accelerations{};
    double yaws[3]{}, input = 0;
    work_.work.resize(contacts);
    // The state after parts of the step.
    const auto place = [&](const double(&by)[3], const Vector3& way) {
      Vector3 y = y0;
      if (whole) {
        double speed = speed0;
        for (std::size_t j = 0; j < 3; ++j) speed += h * by[j] * norm(rates[j]);
        const double size = norm(way);
        y = size > 0 ? scaled(speed / size, way) : Vector3{};
      }
      double yaw = state_.yaw;
      Vector2 x = state_.displacement;
      for (std::size_t j = 0; j < 3; ++j) {
        if (!whole) add_to(y, h * by[j], rates[j]);
        yaw += h * by[j] * yaws[j];
        x += h * by[j] * ways[j];
      }
      for (std::size_t c = 0; c < casters; ++c) {
        stage.headings[c] = state_.headings[c];
        for (std::size_t j = 0; j < 3; ++j) stage.headings[c] += h * by[j] * work_.turning[3 * c + j];
      }
      stage.yaw = yaw;
      stage.displacement = x;
      model_.set_velocities(stage, y);
      return y;
    };
    for (int tries = 0;; ++tries, h /= 2) {
      for (std::size_t j = 0; j < 3; ++j) rates[j] = {}, ways[j] = {}, yaws[j] = 0;
      std::fill(work_.turning.begin(), work_.turning.end(), 0.0);
      for (int rounds = 0; rounds < 12; ++rounds) {
        double change = 0, size = 0;
        for (std::size_t i = 0; i < 3; ++i) {
          const Vector3 y = place(a[i], rates[i]);
          speeds[i] = y;
          solve(stage, now_ + nodes[i] * h);
          if (i == 0) work_.modes = work_.problem.slides();
          const Vector3 rate = work_.problem.acceleration();
          for (std::size_t n = 0; n < 3; ++n) change = std::max(change, std::abs(rate[n] - rates[i][n]));
          size = std::max(size, norm(rate));
          rates[i] = rate;
          ways[i] = stage.velocity;
          yaws[i] = stage.yaw_rate;
          for (const CartModel::Wheel& wheel : model_.wheels) {
            if (wheel.caster == CartModel::none) continue;
            const Vector2 e = model_.direction(wheel, stage), v = CartModel::pivot(wheel, y);
            work_.turning[3 * wheel.caster + i] = stickslip::cross(e, v) * wheel.per_reach - stage.yaw_rate;
          }
        }
        if (change <= 1e-15 * size) break;
      }
      // The mode is one throughout, and a line that slid meanwhile has not turned.
      Vector3 y = place(weights, rates[2]);
      solve(stage, now_ + h);
      last = work_.problem.acceleration();
      if (whole) y = place(weights, last);
      lag = whole ? lag_of(first, rates, last, norm(y), h) : 0;
      bool turned =
          lag > 1e-3 || (whole && !(norm(last) > 0.2 * norm(rates[0]))) || work_.modes != work_.problem.slides();
      for (std::size_t l = 0; l < model_.lines.size(); ++l)
        turned = turned || (!asks(l) && state_.lines[l] * speed_of(stage, y, l) < -model_.slow);
      std::fill(work_.work.begin(), work_.work.end(), 0.0);
      input = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        place(a[i], rates[i]);
        const double c = std::cos(stage.yaw), s = std::sin(stage.yaw);
        const Vector2 felt{rates[i][0] - yaws[i] * speeds[i][1], rates[i][1] + yaws[i] * speeds[i][0]};
        accelerations[i] = {c * felt.axis - s * felt.transverse, s * felt.axis + c * felt.transverse};
        const Vector3 load = load_at(stage, now_ + nodes[i] * h);
        const double heavy = weight_at(now_ + nodes[i] * h);
        input += h * weights[i] * dot(load, speeds[i]);
        for (std::size_t l = 0; l < contacts; ++l)
          work_.work[l] += h * weights[i] * model_.coefficient(l) * heavy * std::abs(speed_of(stage, speeds[i], l));
      }
      // What is lost beside friction is the error of the step.
      double lost = input - (dot(y, y) - speed0 * speed0) / 2;
      for (const double work : work_.work) lost -= work;
      const bool exact = std::abs(lost) <= 1e-13 * standard_gravity * model_.gyration;
      if ((!turned && (exact || tries > 4)) || tries > 12) break;
    }
    const Vector3 y = place(weights, last);
    const double begin = now_;
    now_ = h < left() ? ground_.duration - pass_time(left(), h) : ground_.duration;
    std::swap(state_.headings, stage.headings);
    state_.displacement = stage.displacement;
    state_.velocity = stage.velocity;
    state_.yaw = stage.yaw;
    state_.yaw_rate = stage.yaw_rate;
    solve(state_, now_);
    sink.creep({begin, h, input, work_.work, accelerations}, state_);
    if (work_.problem.rests() && is_slow(model_.steady)) {
      rest();
      return;
    }
    for (std::size_t i = 0; i < work_.asked.size(); ++i) {
      const std::size_t l = work_.asked[i];
      const double speed = speed_of(state_, y, l);
      state_.lines[l] =
          static_cast<std::int8_t>(std::abs(speed) > model_.slow ? (speed > 0 ? 1 : -1) : work_.problem.slides(i));
    }
    std::fill(work_.fresh.begin(), work_.fresh.end(), std::uint8_t{0});
    settle_speeds();
    if (at_rest()) return;
    // As long as the acceleration is small beside friction, a series would take steps of |y|/L where a foot slides.
    const bool slides = std::any_of(state_.lines.begin() + static_cast<std::ptrdiff_t>(model_.lines.size()),
                                    state_.lines.end(), [](int mode) { return mode != 0; });
    if (!whole || !slides || !(lag < 1e-4) || !(norm(last) < 0.05 * least_level()) ||
        !(norm(last) > 0.5 * norm(rates[0])) || (h < asked && left() > 0))
      return;  // where a line turns a series goes on
    slaved_ = lag < 1e-5 ? 2 * h : h;
    slaving_ = true;
    work_.slaving = !(left() > 0);
  }
  // How far the velocity lags behind the acceleration: an angle.
  double lag_of(const Vector3& first, const Vector3 (&rates)[3], const Vector3& last, double speed, double h) const {
    const auto turn = [](const Vector3& u, const Vector3& v) {
      const double sizes = norm(u) * norm(v);
      return sizes > 0 ? norm(detail::cross(u, v)) / sizes : 0;
    };
    const double angle = std::max(turn(norm(first) > 0 ? first : rates[0], last), turn(rates[1], last));
    const double level = least_level();
    return level > 0 && h > 0 ? speed * angle / (h * level) : 0;
  }
  // The least friction of a foot [m/s^2].
  double least_level() const noexcept {
    double least = never;
    for (const CartModel::Foot& foot : model_.feet) least = std::min(least, foot.coefficient);
    return least * weight_at(now_);
  }

  static constexpr double from_rest = 1e-3, after_stop = 1e-5, hurried = 1e-9;  // short steps [s]

  CartWorkspace& work_;
  const CartModel& model_;
  const CartSegment& ground_;
  CartState& state_;
  double now_ = 0;  // since the beginning of the segment [s]
  double mark_ = -1;
  int hurries_ = 0;
  double slaved_ = 0;     // a short step is due [s]
  bool slaving_ = false;  // it goes on one before
  bool stopped_ = false;
};

}  // namespace stickslip::detail
