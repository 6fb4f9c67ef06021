#include "stickslip/carts/integrate.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "base/samples.hpp"
#include "base/states_by_steps.hpp"
#include "carts/model.hpp"
#include "carts/recorder.hpp"
#include "carts/run.hpp"
#include "carts/system.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/run/detail/loop.hpp"
#include "stickslip/run/detail/run.hpp"

namespace stickslip {
namespace detail {

CartSegment cart_segment(const GroundMotion& motion, std::size_t i) {
  const bool held = motion.interpolation() == Interpolation::constant;
  const Segment s = motion.segment(i);
  CartSegment ground{s.duration, {s.start, 0}, {s.end, 0}, standard_gravity, standard_gravity};
  if (motion.has_transverse()) {
    ground.start.transverse = motion.transverse()[i];
    ground.end.transverse = motion.transverse()[held ? i : i + 1];
  }
  if (motion.has_vertical()) {
    ground.heavy_start += motion.vertical()[i];
    ground.heavy_end += motion.vertical()[held ? i : i + 1];
  }
  return ground;
}

void move(CartWorkspace& work, const CartSegment& ground, CartState& state, CartSink& sink) {
  if (!(ground.duration > 0)) return;
  CartSystem system(work, ground, state);
  stickslip::detail::advance(system, sink);
}

CartSegment calm_for(double duration) noexcept { return {duration, {}, {}, standard_gravity, standard_gravity}; }

CartState start_of(const CartModel& model, const CartResponse& response) {
  CartState start = model.start();
  start.yaw = response.yaw.front();
  start.velocity = response.velocity.front();
  start.yaw_rate = response.yaw_rate.front();
  if (norm(start.velocity) > 0 || !equal(start.yaw_rate, 0)) start.mode = CartMode::moving;
  return start;
}

namespace {

class CartRun {
 public:
  using State = CartState;
  using Response = CartResponse;
  using Recorder = CartRecorder;

  CartRun(const CartModel& model, CartWorkspace& work, const GroundMotion& motion, const CartOptions& options,
          Samples samples)
      : model_(model), work_(work), motion_(motion), options_(options), samples_(samples) {}

  const GroundMotion& motion() const noexcept { return motion_; }
  const CartOptions& options() const noexcept { return options_; }

  State start() const {
    const auto finite = [](double value, const char* name, const char* unit) {
      require(std::isfinite(value), std::string("integrate: ") + name + " must be finite", value, unit);
    };
    finite(options_.yaw, "yaw", "rad");
    finite(options_.velocity.axis, "velocity", "m/s");
    finite(options_.velocity.transverse, "velocity", "m/s");
    finite(options_.yaw_rate, "yaw_rate", "rad/s");
    for (const Wall& wall : options_.walls) {
      for (const double value : {wall.point.axis, wall.point.transverse}) finite(value, "the point of a wall", "m");
      const double length = norm(wall.direction);
      require(std::isfinite(length) && length > 0, "integrate: the direction of a wall must be finite and not zero",
              length);
    }
    if (options_.settle && model_.feet.empty() &&
        std::none_of(model_.lines.begin(), model_.lines.end(), [](const CartModel::Line& line) { return line.along; }))
      throw std::invalid_argument(
          "integrate: without rolling resistance this cart may roll without end: give its wheels a rolling_mu, or "
          "integrate it "
          "without settle");
    State state = model_.start();
    state.yaw = options_.yaw;
    state.velocity = options_.velocity;
    state.yaw_rate = options_.yaw_rate;
    if (norm(state.velocity) > 0 || !equal(state.yaw_rate, 0)) state.mode = CartMode::moving;
    return state;
  }

  Recorder recorder(const State& state, Response& response) const {
    const std::size_t samples = samples_ == Samples::kept ? motion_.samples() : 0;
    response.displacement.reserve(samples);
    response.velocity.reserve(samples);
    response.yaw.reserve(samples);
    response.yaw_rate.reserve(samples);
    response.headings.reserve(samples * model_.casters);
    keep(state, response);
    if (motion_.has_transverse()) response.components += " + transverse";
    if (motion_.has_vertical()) response.components += " + vertical";
    return {model_, motion_.time(0), state, options_, max_events(motion_.segments()), response};
  }

  void walk(State& state, Recorder& recorder, Response& response) const {
    const std::size_t count = motion_.segments();
    for (std::size_t i = 0; i < count; ++i) {
      recorder.begin_segment(motion_.time(i), motion_.time(i + 1));
      move(work_, cart_segment(motion_, i), state, recorder);
      keep(state, response);
      if (i % Recorder::work_per_report == 0) recorder.report_progress();
    }
  }

  double settle(State& state, Recorder& recorder, Response& response) const {
    const double begin = motion_.time(motion_.segments());
    State sampled = state;
    double time = begin;
    for (double duration = 1; !is_stuck(state); duration *= 2) {
      const double before = kinetic(state);
      recorder.begin_segment(time, time + duration);
      move(work_, calm_for(duration), state, recorder);
      time += duration;
      constexpr double longest = 1e5;  // to rest, if it goes on to lose energy as slowly [s]
      if (is_stuck(state) || (before - kinetic(state)) * longest > before * duration) continue;
      throw ConvergenceError("integrate: without ground motion the cart does not come to rest: after " +
                             shortest(time - begin) + " s it still moves at " + shortest(norm(state.velocity)) +
                             " m/s and turns at " + shortest(state.yaw_rate) + " rad/s; integrate it without settle");
    }
    const double end = std::max(begin, recorder.last_event());
    if (samples_ == Samples::dropped) return end;
    CartWorkspace work(model_);
    NoCartSink none;
    for (std::size_t i = motion_.segments(); motion_.time(i) < end; ++i) {
      if (i + 1 >= 10 * motion_.samples()) {
        response.truncated = true;
        break;
      }
      move(work, calm_for(motion_.last_step()), sampled, none);
      if (!(motion_.time(i + 1) < end)) sampled = state;
      keep(sampled, response);
    }
    return end;
  }

  double kinetic(const State& state) const {
    const double turns = model_.gyration * state.yaw_rate;
    return (dot(state.velocity, state.velocity) + turns * turns) / 2;
  }
  double elastic(const State&) const { return 0; }
  void finish(State&& state, Response& response) const {
    response.residual = state.displacement;
    response.residual_yaw = state.yaw - options_.yaw;
    response.state = std::move(state);
  }

 private:
  void keep(const State& state, Response& response) const {
    if (samples_ == Samples::dropped) return;
    response.displacement.push_back(state.displacement);
    response.velocity.push_back(state.velocity);
    response.yaw.push_back(state.yaw);
    response.yaw_rate.push_back(state.yaw_rate);
    response.headings.insert(response.headings.end(), state.headings.begin(), state.headings.end());
  }

  const CartModel& model_;
  CartWorkspace& work_;
  const GroundMotion& motion_;
  const CartOptions& options_;
  Samples samples_;
};

CartResponse run(const Cart& cart, const GroundMotion& motion, const CartOptions& options, Samples samples) {
  const CartModel model(cart);
  CartWorkspace work(model);
  return integrate_run(CartRun(model, work, motion, options, samples), {});
}

}  // namespace

CartResponse integrate_without_samples(const Cart& cart, const GroundMotion& motion, const CartOptions& options) {
  return run(cart, motion, options, Samples::dropped);
}

}  // namespace detail

CartResponse integrate(const Cart& cart, const GroundMotion& motion, const CartOptions& options) {
  return detail::run(cart, motion, options, detail::Samples::kept);
}

double condition(const Cart& cart, const GroundMotion& motion, const CartOptions& options) {
  constexpr double change = 1e-9;  // [rad]
  const CartResponse first = integrate(cart, motion, options);
  std::vector<double> headings = detail::CartModel(cart).headings;
  for (double& heading : headings) heading += change;
  CartOptions other = options;
  if (headings.empty()) other.yaw += change;
  const CartResponse then = integrate(cart.with_headings(headings), motion, other);
  double most = 0;
  const std::size_t samples = std::min(first.displacement.size(), then.displacement.size());
  for (std::size_t i = 0; i < samples; ++i) {
    const double turns = (then.yaw[i] - other.yaw) - (first.yaw[i] - options.yaw);
    most = std::max(
        {most, norm(then.displacement[i] - first.displacement[i]), cart.radius_of_gyration() * std::abs(turns)});
  }
  return most / change;
}

void advance(const Cart& cart, const CartGround& segment, CartState& state) {
  const detail::CartModel model(cart);
  for (const double value :
       {segment.duration, segment.start.axis, segment.start.transverse, segment.end.axis, segment.end.transverse,
        segment.vertical_start, segment.vertical_end, state.displacement.axis, state.displacement.transverse, state.yaw,
        state.velocity.axis, state.velocity.transverse, state.yaw_rate})
    detail::require(std::isfinite(value), "advance: segment and state must be finite", value);
  detail::require(segment.duration >= 0, "advance: duration must be at least 0", segment.duration, "s");
  CartState moved = state;
  if (moved.headings.empty()) moved.headings = model.headings;
  detail::require(
      moved.headings.size() == model.casters,
      "advance: the state must have as many headings as the cart has swivel casters, " + std::to_string(model.casters),
      static_cast<double>(moved.headings.size()));
  for (const double value : moved.headings)
    detail::require(std::isfinite(value), "advance: headings must be finite", value, "rad");
  detail::require(moved.lines.empty() || moved.lines.size() == model.contacts(),
                  "advance: the lines of the state and feet of the state must be those of the cart, " +
                      std::to_string(model.contacts()),
                  static_cast<double>(moved.lines.size()));
  if (moved.mode == CartMode::rest && (norm(moved.velocity) > 0 || !detail::equal(moved.yaw_rate, 0)))
    moved.mode = CartMode::moving;
  detail::CartWorkspace work(model);
  detail::NoCartSink none;
  const detail::CartSegment ground{segment.duration, segment.start, segment.end,
                                   standard_gravity + segment.vertical_start, standard_gravity + segment.vertical_end};
  detail::move(work, ground, moved, none);
  state = std::move(moved);
}

std::vector<CartState> states_at(const Cart& cart, const GroundMotion& motion, const CartResponse& response,
                                 std::span<const double> times) {
  const detail::CartModel model(cart);
  detail::CartWorkspace work(model);
  detail::NoCartSink none;
  const auto step = [&](CartState& state, double duration, std::size_t i, double from, double to) {
    detail::CartSegment part = detail::calm_for(duration);
    if (i < motion.segments()) {
      const detail::CartSegment whole = detail::cart_segment(motion, i);
      const auto at = [](auto first, auto last, double share) { return first + share * (last - first); };
      part = {duration, at(whole.start, whole.end, from), at(whole.start, whole.end, to),
              at(whole.heavy_start, whole.heavy_end, from), at(whole.heavy_start, whole.heavy_end, to)};
    }
    detail::move(work, part, state, none);
  };
  return detail::states_by_steps(motion, times, detail::start_of(model, response), response.displacement.size(),
                                 response.events.back().time, response.state, step);
}

}  // namespace stickslip
