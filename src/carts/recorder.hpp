// What is kept of the motion of a cart.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "carts/leg.hpp"
#include "carts/model.hpp"
#include "carts/system.hpp"
#include "numerics/each_root.hpp"
#include "stickslip/carts/integrate.hpp"
#include "stickslip/carts/response.hpp"
#include "stickslip/run/detail/event_log.hpp"

namespace stickslip::detail {

/// A point of the cart along a leg, since the start of the motion: coefficients in units of the duration.
struct PointSeries {
  int order = 0;
  double x[series::highest_order + 1], y[series::highest_order + 1];

  /// @param corner  from the center of mass, in the cart's frame
  /// @param from    where it was at the start
  void set(const CartLeg& leg, Vector2 corner, Vector2 from) noexcept {
    order = leg.order();
    for (int k = 0; k <= order; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const double c = leg.cosine()[i], s = leg.sine()[i];
      x[k] = leg.way_axis()[i] + corner.axis * c - corner.transverse * s;
      y[k] = leg.way_transverse()[i] + corner.axis * s + corner.transverse * c;
    }
    x[0] += leg.place().axis - from.axis;
    y[0] += leg.place().transverse - from.transverse;
  }
  Vector2 at(double s) const noexcept {
    double a = 0, b = 0;
    for (int k = order; k >= 0; --k) a = a * s + x[k], b = b * s + y[k];
    return {a, b};
  }
  double spread(const double* c) const noexcept {
    double sum = 0;
    for (int k = 1; k <= order; ++k) sum += std::abs(c[k]);
    return sum;
  }
  /// Call `use(place, s)` where the distance from the start may be largest.
  template <class Use>
  void for_each_turn(double until, Use&& use) const {
    const int degree = std::min(2 * order - 1, series::highest_order);
    if (degree < 1) return;
    double w[series::highest_order + 1];
    for (int k = 0; k <= degree; ++k) {  // half the rate of the square
      double sum = 0;
      for (int i = std::max(0, k - order + 1); i <= std::min(k, order); ++i)
        sum += (k - i + 1) * (x[i] * x[k - i + 1] + y[i] * y[k - i + 1]);
      w[k] = sum;
    }
    for_each_root(w, degree, [&](double s) {
      if (s < until) use(at(s), s);
    });
  }
  /// The same for the component along a direction.
  template <class Use>
  void for_each_turn_along(Vector2 direction, double until, Use&& use) const {
    if (order < 2) return;
    double w[series::highest_order + 1];
    for (int k = 0; k < order; ++k) w[k] = (k + 1) * (direction.axis * x[k + 1] + direction.transverse * y[k + 1]);
    for_each_root(w, order - 1, [&](double s) {
      if (s < until) use(at(s), s);
    });
  }
};

class NoCartSink final : public CartSink {
 public:
  void follow(const CartLeg&, double, double, const CartState&) override {}
  void event(EventKind, double, const CartState&) override {}
};

class CartRecorder final : public CartSink, public EventLog<CartEvent>, public Pace<4096> {
 public:
  CartRecorder(const CartModel& model, double begin, const CartState& state, const CartOptions& options,
               std::size_t event_limit, CartResponse& response)
      : EventLog(event_limit, {}),
        Pace(options.progress),
        model_(model),
        response_(response),
        begin_(begin),
        yaw_(state.yaw),
        rested_(state.mode == CartMode::rest) {
    const double c = std::cos(yaw_), s = std::sin(yaw_);
    const auto turned_by_yaw = [&](Vector2 corner) -> Vector2 {
      return {c * corner.axis - s * corner.transverse, s * corner.axis + c * corner.transverse};
    };
    for (const Vector2& corner : model.outline) starts_.push_back(turned_by_yaw(corner));
    for (const Wall& wall : options.walls) {
      const Vector2 across = (1 / norm(wall.direction)) * turned(wall.direction);
      double distance = dot(-wall.point, across);
      if (equal(distance, 0))
        for (const Vector2& start : starts_) distance += dot(start - wall.point, across);
      const Vector2 normal = distance < 0 ? -across : across;
      walls_.push_back({normal, dot(normal, wall.point)});
    }
    response.clearances.assign(walls_.size(), {});
    response.energy = {};
    response.energy.by_support.resize(model.wheels.size());
    for (const Vector2& start : starts_) see(start, begin);
  }

  void follow(const CartLeg& leg, double begin, double duration, const CartState& end) override {
    count_work();
    response_.time_moving += duration;
    response_.energy.input += leg.input(duration);
    for (std::size_t l = 0; l < model_.contacts(); ++l) spend(l, leg.friction(l, duration));
    if (!(leg.duration() > 0)) return;
    const double until = std::min(duration / leg.duration(), 1.0);
    const auto time_of = [&](double s) { return when(begin + s * leg.duration()); };

    PointSeries point;
    point.set(leg, {}, {});
    const auto reach_center = [&](Vector2 at, double s) {
      if (!(norm(at) > response_.peak)) return;
      response_.peak = norm(at);
      response_.peak_time = time_of(s);
    };
    if (most(point) > response_.peak) {
      point.for_each_turn(until, reach_center);
      reach_center(end.displacement, until);
    }
    turn(leg, until, end.yaw);

    for (std::size_t i = 0; i < starts_.size(); ++i) {
      point.set(leg, model_.outline[i], starts_[i]);
      const auto reach_corner = [&](Vector2 at, double s) {
        if (!(norm(at) > response_.peak_outline)) return;
        response_.peak_outline = norm(at);
        response_.peak_outline_time = time_of(s);
        response_.peak_corner = i;
      };
      const Vector2 last = point.at(until);
      if (most(point) > response_.peak_outline) {
        point.for_each_turn(until, reach_corner);
        reach_corner(last, until);
      }
      const Vector2 here{point.x[0] + starts_[i].axis, point.y[0] + starts_[i].transverse};
      const double wide = point.spread(point.x), far = point.spread(point.y);
      Reach& reach = response_.reach;
      if (here.axis + wide > reach.high.axis || here.axis - wide < reach.low.axis)
        point.for_each_turn_along({1, 0}, until, [&](Vector2 at, double) { sweep(starts_[i] + at); });
      if (here.transverse + far > reach.high.transverse || here.transverse - far < reach.low.transverse)
        point.for_each_turn_along({0, 1}, until, [&](Vector2 at, double) { sweep(starts_[i] + at); });
      sweep(starts_[i] + last);
      for (std::size_t w = 0; w < walls_.size(); ++w) approach(w, point, starts_[i], until, leg.duration(), time_of);
    }
  }

  void creep(const CartCreep& creep, const CartState& end) override {
    count_work();
    response_.time_moving += creep.duration;
    response_.energy.input += creep.input;
    for (std::size_t l = 0; l < model_.contacts(); ++l) spend(l, creep.work[l]);
    const double time = when(creep.begin + creep.duration), c = std::cos(end.yaw), s = std::sin(end.yaw);
    if (norm(end.displacement) > response_.peak) response_.peak = norm(end.displacement), response_.peak_time = time;
    response_.peak_yaw = std::max(response_.peak_yaw, std::abs(end.yaw - yaw_));
    for (std::size_t i = 0; i < starts_.size(); ++i) {
      const Vector2 corner = model_.outline[i];
      const Vector2 at =
          end.displacement + Vector2{c * corner.axis - s * corner.transverse, s * corner.axis + c * corner.transverse};
      see(at, time);
      if (!(norm(at - starts_[i]) > response_.peak_outline)) continue;
      response_.peak_outline = norm(at - starts_[i]);
      response_.peak_outline_time = time;
      response_.peak_corner = i;
    }
  }

  void event(EventKind kind, double time, const CartState& state) override {
    switch (kind) {
      case EventKind::arrest:
        ++response_.rests;
        add(CartEventKind::rest, time, state);
        break;
      case EventKind::end:
        add(CartEventKind::end, time, state);
        break;
      default:
        add(CartEventKind::breakaway, time, state);
    }
  }
  void happens(CartEventKind kind, double time, const CartState& state, std::size_t line) override {
    if (line < model_.lines.size())
      add(kind, time, state, model_.lines[line].wheel, model_.lines[line].along);
    else
      add(kind, time, state, model_.feet[line - model_.lines.size()].wheel);
  }
  void decide(double margin) override { response_.margin = std::min(response_.margin, margin); }

  void finish(CartResponse& response) {
    for (const EventAt<CartEvent>& one : take()) {
      response.events.push_back(one.displacement);
      response.events.back().time = one.time;
    }
    // At the start it rests, or its load lies beyond what holds.
    if (rested_ &&
        !(response.events.front().kind == CartEventKind::breakaway && !(response.events.front().time > begin_)))
      ++response.rests;
  }

 private:
  struct Side {
    Vector2 normal;  // toward the cart
    double offset;
  };

  void add(CartEventKind kind, double time, const CartState& state, std::size_t support = CartEvent::no_support,
           bool along = false) {
    count_work();
    EventLog::add({}, time, {0, state.displacement, state.yaw, kind, support, along}, {});
  }
  void spend(std::size_t l, double work) noexcept {
    response_.energy.dissipated += work;
    auto& by_support = response_.energy.by_support;
    if (l < model_.lines.size())
      (model_.lines[l].along ? by_support[model_.lines[l].wheel].roll : by_support[model_.lines[l].wheel].scrub) +=
          work;
    else
      by_support[model_.feet[l - model_.lines.size()].wheel].slide += work;
  }
  static double most(const PointSeries& point) noexcept {
    return std::hypot(std::abs(point.x[0]) + point.spread(point.x), std::abs(point.y[0]) + point.spread(point.y));
  }
  void sweep(Vector2 at) noexcept {
    Reach& reach = response_.reach;
    reach.low = {std::min(reach.low.axis, at.axis), std::min(reach.low.transverse, at.transverse)};
    reach.high = {std::max(reach.high.axis, at.axis), std::max(reach.high.transverse, at.transverse)};
  }
  // A place of a corner.
  void see(Vector2 at, double time) noexcept {
    sweep(at);
    for (std::size_t w = 0; w < walls_.size(); ++w) come(w, dot(walls_[w].normal, at) - walls_[w].offset, time, 0);
  }
  void come(std::size_t w, double distance, double time, double speed) noexcept {
    Clearance& clearance = response_.clearances[w];
    if (distance < clearance.least) clearance.least = distance, clearance.time = time;
    if (!(distance <= 0) || !std::isnan(clearance.hit_time)) return;
    clearance.hit_time = time;
    clearance.hit_speed = speed;
  }
  template <class TimeOf>
  void approach(std::size_t w, const PointSeries& point, Vector2 start, double until, double seconds,
                TimeOf&& time_of) {
    const Side& wall = walls_[w];
    Clearance& clearance = response_.clearances[w];
    double distance[series::highest_order + 1], lowest = 0;
    for (int k = 0; k <= point.order; ++k) {
      distance[k] = wall.normal.axis * point.x[k] + wall.normal.transverse * point.y[k];
      if (k > 0) lowest -= std::abs(distance[k]);
    }
    distance[0] += dot(wall.normal, start) - wall.offset;
    if (distance[0] + lowest > clearance.least) return;
    if (distance[0] > 0 && !(clearance.hit_time < time_of(0))) {
      const double s = FirstRoot(distance, point.order).find();
      const double time = time_of(s);
      if (s <= until) hit(w, distance, point.order, s, time, seconds);
    }
    point.for_each_turn_along(wall.normal, until, [&](Vector2 at, double s) {
      come(w, dot(wall.normal, start + at) - wall.offset, time_of(s), 0);
    });
    come(w, dot(wall.normal, start + point.at(until)) - wall.offset, time_of(until), 0);
  }
  void hit(std::size_t w, const double* distance, int order, double s, double time, double seconds) noexcept {
    double rate = 0;
    for (int k = order; k > 0; --k) rate = rate * s + k * distance[k];
    Clearance& clearance = response_.clearances[w];
    // Several corners of a leg may hit.
    if (!std::isnan(clearance.hit_time) && !(time < clearance.hit_time)) return;
    clearance.hit_time = time;
    clearance.hit_speed = -rate / seconds;
  }
  void turn(const CartLeg& leg, double until, double last) {
    const auto reach = [&](double yaw) { response_.peak_yaw = std::max(response_.peak_yaw, std::abs(yaw - yaw_)); };
    double most = std::abs(leg.yaw()[0] - yaw_);
    for (int k = 1; k <= leg.order(); ++k) most += std::abs(leg.yaw()[static_cast<std::size_t>(k)]);
    if (!(most > response_.peak_yaw)) return;
    double w[series::highest_order + 1];
    for (int k = 0; k < leg.order(); ++k) w[k] = (k + 1) * leg.yaw()[static_cast<std::size_t>(k) + 1];
    for_each_root(w, leg.order() - 1, [&](double s) {
      if (s < until) reach(leg.value(leg.yaw(), s));
    });
    reach(last);
  }

  const CartModel& model_;
  CartResponse& response_;
  double begin_;                 // [s]
  double yaw_;                   // at the start
  bool rested_;                  // the same
  std::vector<Vector2> starts_;  // the corners at the start
  std::vector<Side> walls_;
};

}  // namespace stickslip::detail
