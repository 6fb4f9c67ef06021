#include "stickslip/carts/forces.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "carts/leg.hpp"
#include "carts/model.hpp"
#include "carts/run.hpp"
#include "carts/system.hpp"
#include "stickslip/run/detail/chords.hpp"
#include "stickslip/run/detail/largest.hpp"
#include "stickslip/run/detail/reading.hpp"

namespace stickslip {
namespace detail {
namespace {

// Shows the absolute acceleration of a cart: a `line` at rest, else a `curve`.
template <class Reader>
class AccelerationTracer final : public CartSink {
 public:
  explicit AccelerationTracer(Reader& reader) : reader_(reader) {}

  void begin_segment(const CartSegment& ground) {
    ground_ = &ground;
    now_ = 0;
  }
  void rest_until(double time) {
    if (!(time - now_ > 0x1p-40 * ground_->duration)) return;
    reader_.line(now_, time, ground_->ground(now_), ground_->ground(time));
    now_ = time;
  }

  void follow(const CartLeg& leg, double begin, double duration, const CartState&) override {
    rest_until(begin);
    if (!(leg.duration() > 0)) return;
    const double whole = leg.duration(), per_square = 1 / (whole * whole);
    curve(begin, duration, [&](double t) {
      Vector2 second{};
      for (int k = leg.order(); k >= 2; --k) {
        const auto i = static_cast<std::size_t>(k);
        second = (t / whole) * second + (k * (k - 1.0)) * Vector2{leg.way_axis()[i], leg.way_transverse()[i]};
      }
      return per_square * second;
    });
  }
  void creep(const CartCreep& creep, const CartState&) override {
    rest_until(creep.begin);
    const auto& [first, middle, last] = creep.accelerations;
    const double node = std::sqrt(15.0) / 10;  // of the first and last from the middle, in parts of the step
    const Vector2 rises = (1 / (2 * node)) * (last - first),
                  bends = (1 / (2 * node * node)) * (first - 2 * middle + last);
    curve(creep.begin, creep.duration, [&, by = creep.duration](double t) {
      const double s = t / by - 0.5;
      return middle + s * (rises + s * bends);
    });
  }
  void event(EventKind, double, const CartState&) override {}

 private:
  // The acceleration relative to the ground, `of(t)` since the beginning.
  template <class Of>
  void curve(double begin, double duration, const Of& of) {
    if (!(duration > 0)) return;
    now_ = begin + duration;
    reader_.curve(begin, duration, [&](double t) { return of(t) + ground_->ground(begin + t); });
  }

  Reader& reader_;
  const CartSegment* ground_ = nullptr;
  double now_ = 0;  // since the beginning of the segment [s]
};

// From the first to the last sample of a response.
template <class Reader>
void trace(const Cart& cart, const GroundMotion& motion, const CartResponse& response, Reader& reader) {
  const CartModel model(cart);
  CartWorkspace work(model);
  CartState state = start_of(model, response);
  AccelerationTracer<Reader> tracer(reader);
  for (std::size_t i = 0; i + 1 < response.displacement.size(); ++i) {
    const CartSegment ground = i < motion.segments() ? cart_segment(motion, i) : calm_for(motion.last_step());
    reader.begin_segment(motion.time(i), ground.duration, i == motion.segments());
    tracer.begin_segment(ground);
    move(work, ground, state, tracer);
    tracer.rest_until(ground.duration);
  }
}

// Reads the acceleration at samples, and the largest one.
class ForcesReader {
 public:
  explicit ForcesReader(std::size_t samples) : samples_(samples) { forces.acceleration.reserve(samples); }

  /// @param ended  whether the ground motion ends here, so that the value before it counts
  void begin_segment(double time, double duration, bool ended) {
    begin_ = time;
    short_ = 0x1p-20 * duration;
    ++wanted_;
    if (ended) keep(last_);
  }
  void line(double begin, double end, Vector2 first, Vector2 last) {
    if (end > short_) keep(first);
    look(begin, first);
    look(end, last);
    last_ = last;
  }
  template <class At>
  void curve(double begin, double duration, const At& at) {
    if (begin + duration > short_) keep(at(0));
    look_for_largest(duration, 8, forces.peak, [&](double t) {
      const Vector2 now = at(t);
      look(begin + t, now);
      return norm(now);
    });
    last_ = at(duration);
  }
  void finish() {
    wanted_ = samples_;
    keep(last_);
  }

  CartForces forces;

 private:
  void keep(Vector2 acceleration) {
    while (forces.acceleration.size() < wanted_) forces.acceleration.push_back(acceleration + Vector2{0.0, 0.0});
  }
  void look(double time, Vector2 acceleration) {
    if (!(norm(acceleration) > (1 + 1e-13) * forces.peak)) return;
    forces.peak = norm(acceleration);
    forces.peak_time = begin_ + time;
  }

  std::size_t samples_, wanted_ = 0;
  double begin_ = 0;
  double short_ = 0;  // pieces that end before are none: what just stops or turns goes on for some rounding errors [s]
  Vector2 last_{};
};

class FloorReader {
 public:
  explicit FloorReader(double tolerance) : tolerance_(tolerance) {}

  void begin_segment(double, double, bool) {}
  void line(double begin, double end, Vector2 first, Vector2 last) {
    floor.segments.push_back({end - begin, first, last});
  }
  template <class At>
  void curve(double, double duration, const At& at) {
    const auto point = [&](double t) { return CurvePoint{t, t, at(t)}; };
    add_chords(point, point(0), point(duration), tolerance_, 0x1p-20 * duration, floor);
  }

  PlanarFloorMotion floor;

 private:
  double tolerance_;
};

}  // namespace
}  // namespace detail

CartForces forces(const Cart& cart, const GroundMotion& motion, const CartResponse& response) {
  detail::ForcesReader reader(response.displacement.size());
  detail::trace(cart, motion, response, reader);
  reader.finish();
  return std::move(reader.forces);
}

PlanarFloorMotion floor_motion(const Cart& cart, const GroundMotion& motion, const CartResponse& response,
                               double tolerance) {
  detail::check_floor(response, motion.samples(), tolerance);
  const double largest = std::max(forces(cart, motion, response).peak, std::numeric_limits<double>::min());
  detail::FloorReader reader(tolerance * largest);
  detail::trace(cart, motion, response, reader);
  return std::move(reader.floor);
}

}  // namespace stickslip
