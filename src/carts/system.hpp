// A cart as a sliding system: the event loop asks it what it asks a slider.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "carts/acceleration.hpp"
#include "carts/leg.hpp"
#include "carts/model.hpp"
#include "stickslip/carts/response.hpp"
#include "stickslip/error.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/sliding/detail/loop.hpp"
#include "stickslip/sliding/detail/system.hpp"

namespace stickslip::detail {

/// Receives the motion of a cart while it is computed. Times are since the beginning of the segment [s].
class CartSink {
 public:
  virtual void follow(const CartLeg& leg, double begin, double duration, const CartState& end) = 0;
  /// Of the event loop: `breakaway` and `reversal` out of rest, `arrest`.
  virtual void event(EventKind kind, double time, const CartState& state) = 0;
  /// A line of a wheel sticks, slips or reverses.
  virtual void happens(CartEventKind /*kind*/, double /*time*/, const CartState&, std::size_t /*line*/) {}
  /// How far a decision was from another one, over the accelerations that take part.
  virtual void decide(double /*margin*/) {}

 protected:
  ~CartSink() = default;
};

/// The memory of a cart's motion, kept from segment to segment.
struct CartWorkspace {
  explicit CartWorkspace(const CartModel& cart) : model(cart), leg(cart), fresh(cart.lines.size()) {}

  const CartModel& model;
  CartLeg leg;
  AccelerationProblem problem;
  Zonotope hold;  // of all lines, while it rests
  bool knows_hold = false;
  std::vector<std::uint8_t> fresh;  // as CartLeg::begin
  std::vector<std::size_t> asked;   // the lines of the problem
  std::vector<double> speeds;       // of the lines [m/s]
  CartState end;                    // of the leg
  std::vector<std::int8_t> before;  // the lines before an event
  Zonotope still;                   // of the lines that stick
};

struct CartDeparture {
  bool leaves = false;
  double delay = 0;
  bool beyond = false;            // the load lies beyond what holds already
  bool tied = false;              // several faces meet
  const Vector3* face = nullptr;  // through which it leaves; null: in a direction without friction
  bool departs() const noexcept { return leaves; }
};

struct CartSlide {
  CartLeg* leg;
  CartLeg::Event next;
  double stop = never;  // stops are passages

  struct Leg {
    double time;
  };
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
    if (state_.mode == CartMode::moving && state_.lines.size() != model_.lines.size()) {
      state_.lines.assign(model_.lines.size(), 0);
      decide_all();
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
    bool beyond = false;
    const auto piece = [&](double begin, double end) {
      const Vector3 from = load_at(state_, begin), to = load_at(state_, end);
      const double heavy_from = weight_at(begin), heavy_to = weight_at(end);
      const auto look = [&](const Vector3* face, double f0, double f1) {
        if (!(std::max(f0, f1) > 0)) return;
        const double delay = begin - now_ + (f0 >= 0 ? 0 : (end - begin) * (f0 / (f0 - f1)));
        const bool meets = std::abs(delay - soonest) <= 1e-9 * left();
        if (delay < soonest) soonest = delay, first = {true, delay, false, meets, face};
        first.tied = first.tied || meets;
        beyond = beyond || (f0 > 0 && !(begin > now_));
      };
      for (const Zonotope::Face& face : work_.hold.faces())
        look(&face.normal, dot(face.normal, from) - face.reach * heavy_from,
             dot(face.normal, to) - face.reach * heavy_to);
      if (work_.hold.rank() == 3) return;
      const Vector3 out = work_.hold.outside(from), out_end = work_.hold.outside(to);
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
    first.beyond = beyond;
    return first;
  }

  Resumption depart(const CartDeparture& departure) {
    now_ = std::min(now_ + departure.delay, ground_.duration);
    state_.mode = CartMode::moving;
    state_.lines.assign(model_.lines.size(), 0);
    work_.knows_hold = false;
    std::fill(work_.fresh.begin(), work_.fresh.end(), std::uint8_t{0});
    bool known = false;
    if (departure.beyond || departure.tied) {
      work_.asked.clear();
      for (std::size_t l = 0; l < model_.lines.size(); ++l) work_.asked.push_back(l);
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
        state_.lines[l] = static_cast<std::int8_t>(work_.hold.leaves(normal, l));
        work_.fresh[l] = state_.lines[l] != 0 ? 2 : 0;
      }
    }
    return std::exchange(stopped_, false) && !(departure.delay > 0) ? Resumption::reversed : Resumption::from_rest;
  }

  CartSlide slide() {
    CartLeg& leg = work_.leg;
    for (int tries = 0;; ++tries) {
      leg.begin(state_, ground_, now_, never, work_.fresh);
      // Forces can jump where a segment begins.
      if (tries > 0 || !(leg.excess() > 1e-9)) break;
      decide_all();
    }
    return {&leg, leg.next()};
  }

  CartPassage passage(const CartSlide& slide) const noexcept {
    if (slide.next.what == CartLeg::What::nothing) return {};
    return {true, {slide.next.time}};
  }

  void show(const CartSlide& slide, const CartSlide::Leg& leg, CartSink& sink) {
    slide.leg->at(leg.time, work_.end);
    sink.follow(*slide.leg, now_, leg.time, work_.end);
  }

  bool pass(const CartSlide& slide, const CartPassage& passage, CartSink& sink) {
    go(passage.leg);
    work_.before = state_.lines;
    if (slide.next.what == CartLeg::What::face && slide.next.tied) {
      slide.leg->at(slide.next.time + a_little, work_.end);
      work_.asked.clear();
      for (std::size_t l = 0; l < model_.lines.size(); ++l)
        if (state_.lines[l] == 0) work_.asked.push_back(l);
      solve(work_.end, now_ + a_little);
      take(2);
    } else if (slide.next.what == CartLeg::What::face) {
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
      work_.asked.clear();
      find_speeds();
      for (std::size_t l = 0; l < model_.lines.size(); ++l)
        if (l == slide.next.which || state_.lines[l] == 0 || std::abs(work_.speeds[l]) <= model_.slow)
          work_.asked.push_back(l);
      solve(state_, now_);
      sink.decide(work_.problem.gap());
      take(1);
    }
    for (std::size_t l = 0; l < model_.lines.size(); ++l) {
      if (work_.before[l] == state_.lines[l]) continue;
      sink.happens(state_.lines[l] == 0   ? CartEventKind::stick
                   : work_.before[l] == 0 ? CartEventKind::slip
                                          : CartEventKind::reversal,
                   now_, state_, l);
    }
    if (now_ > mark_ + 1e-9) {
      mark_ = now_;
      hurries_ = 0;
    } else if (++hurries_ > 30) {
      creep();
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
    work_.hold.clear();
    for (const CartModel::Line& line : model_.lines) work_.hold.add(model_.row(line, state_), line.coefficient);
    work_.hold.close();
    work_.knows_hold = true;
  }

  void find_speeds() {
    const Vector3 y = model_.velocities(state_);
    work_.speeds.resize(model_.lines.size());
    for (std::size_t l = 0; l < model_.lines.size(); ++l)
      work_.speeds[l] = state_.lines[l] == 0 ? 0 : dot(model_.row(model_.lines[l], state_), y);
  }
  bool is_slow(double speed) const noexcept { return norm(model_.velocities(state_)) <= speed; }

  void rest() {
    state_.velocity = {};
    state_.yaw_rate = 0;
    state_.mode = CartMode::rest;
    state_.lines.clear();
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
    problem.solve(p);
  }
  bool asks(std::size_t line) const noexcept {
    return std::binary_search(work_.asked.begin(), work_.asked.end(), line);
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
    bool any = false;
    for (std::size_t l = 0; l < model_.lines.size(); ++l)
      if (state_.lines[l] == 0) stuck.add(model_.row(model_.lines[l], state_), 0), any = true;
    if (!any) return;
    stuck.close();
    if (stuck.rank() == 3) {
      rest();
      return;
    }
    model_.set_velocities(state_, stuck.outside(model_.velocities(state_)));
  }

  // From velocities alone, or where forces have jumped.
  void decide_all() {
    const Vector3 y = model_.velocities(state_);
    work_.asked.clear();
    for (std::size_t l = 0; l < model_.lines.size(); ++l) {
      const double sigma = dot(model_.row(model_.lines[l], state_), y);
      if (state_.lines[l] == 0 && std::abs(sigma) > model_.slow)
        state_.lines[l] = static_cast<std::int8_t>(sigma > 0 ? 1 : -1);
      else if (state_.lines[l] == 0 || std::abs(sigma) <= model_.slow)
        work_.asked.push_back(l);
    }
    solve(state_, now_);
    take(1);
  }

  // Where events follow each other without progress of time, noise decides the signs: all slow lines are asked for a short
  // time.
  void creep() {
    hurries_ = 0;
    find_speeds();
    work_.asked.clear();
    for (std::size_t l = 0; l < model_.lines.size(); ++l)
      if (state_.lines[l] == 0 || std::abs(work_.speeds[l]) <= model_.steady) work_.asked.push_back(l);
    solve(state_, now_);
    if (work_.problem.rests() && is_slow(model_.steady)) {
      rest();
      return;
    }
    const double dt = std::min(1e-9, left());
    Vector3 y = model_.velocities(state_);
    for (const CartModel::Wheel& wheel : model_.wheels) {
      if (wheel.caster == CartModel::none) continue;
      const Vector2 e = model_.direction(wheel, state_), v = CartModel::pivot(wheel, y);
      state_.headings[wheel.caster] += dt * (stickslip::cross(e, v) * wheel.per_reach - state_.yaw_rate);
    }
    state_.displacement += dt * state_.velocity;
    state_.yaw += dt * state_.yaw_rate;
    add_to(y, dt, work_.problem.acceleration());
    model_.set_velocities(state_, y);
    now_ = dt < left() ? ground_.duration - pass_time(left(), dt) : ground_.duration;
    state_.lines.assign(model_.lines.size(), 0);
    decide_all();
  }

  CartWorkspace& work_;
  const CartModel& model_;
  const CartSegment& ground_;
  CartState& state_;
  double now_ = 0;  // since the beginning of the segment [s]
  double mark_ = -1;
  int hurries_ = 0;
  bool stopped_ = false;
};

}  // namespace stickslip::detail
