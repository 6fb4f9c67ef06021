#include "stickslip/carts/forces.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "carts/leg.hpp"
#include "carts/model.hpp"
#include "carts/run.hpp"
#include "carts/system.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/run/detail/chords.hpp"
#include "stickslip/run/detail/largest.hpp"
#include "stickslip/run/detail/reading.hpp"

namespace stickslip {
namespace detail {
namespace {

// Shows the absolute acceleration of a cart: a `line` at rest, else a `curve`. Pieces that are too short to be more than
// the round-off of what just stops or turns are covered by what follows them.
template <class Reader>
class AccelerationTracer final : public CartSink {
 public:
  explicit AccelerationTracer(Reader& reader) : reader_(reader) {}

  void begin_segment(const CartSegment& ground) {
    ground_ = &ground;
    shown_ = moved_ = 0;
  }
  void end_segment() {
    rest_until(ground_->duration);
    if (shown_ < ground_->duration) reader_.line(shown_, ground_->duration, last_, last_);
  }

  void follow(const CartLeg& leg, double begin, double duration, const CartState&) override {
    const double whole = leg.duration();
    piece(begin, whole > 0 ? duration : 0, [&](double t) {
      Vector2 second{};
      for (int k = leg.order(); k >= 2; --k) {
        const auto i = static_cast<std::size_t>(k);
        second = (t / whole) * second + (k * (k - 1.0)) * Vector2{leg.way_axis()[i], leg.way_transverse()[i]};
      }
      return (1 / (whole * whole)) * second + ground_->ground(begin + t);
    });
  }
  // The force is a parabola between the Gauss points, and what it is there beyond them: it may be another one after that.
  void creep(const CartCreep& creep, const CartState&) override {
    static const double node = std::sqrt(15.0) / 10;  // of the first and last from the middle, in parts of the step
    const auto absolute = [&](std::size_t i, double part) {
      return creep.accelerations[i] + ground_->ground(creep.begin + part * creep.duration);
    };
    const Vector2 first = absolute(0, 0.5 - node), middle = absolute(1, 0.5), last = absolute(2, 0.5 + node);
    const Vector2 rises = (1 / (2 * node)) * (last - first),
                  bends = (1 / (2 * node * node)) * (first - 2 * middle + last);
    piece(creep.begin, creep.duration, [&, by = creep.duration](double t) {
      const double s = std::clamp(t / by - 0.5, -node, node);
      return middle + s * (rises + s * bends);
    });
  }
  void event(EventKind, double, const CartState&) override {}

 private:
  // What has not moved since the last piece rests.
  void rest_until(double time) {
    if (!(time - moved_ > 0x1p-40 * ground_->duration)) return;
    last_ = ground_->ground(time);
    reader_.line(shown_, time, ground_->ground(shown_), last_);
    shown_ = moved_ = time;
  }
  /// @param at  `at(t)`: the acceleration at a time since its beginning
  template <class At>
  void piece(double begin, double duration, const At& at) {
    rest_until(begin);
    moved_ = begin + duration;
    if (!(duration > 0x1p-20 * ground_->duration)) return;
    if (begin > shown_) reader_.line(shown_, begin, at(0), at(0));
    reader_.curve(begin, duration, at);
    last_ = at(duration);
    shown_ = moved_;
  }

  Reader& reader_;
  const CartSegment* ground_ = nullptr;
  double shown_ = 0, moved_ = 0;  // until then, since the beginning of the segment [s]
  Vector2 last_{};                // at the end of what was shown
};

// From the first to the last sample of a response, and to its end.
template <class Reader>
void trace(const Cart& cart, const GroundMotion& motion, const CartResponse& response, Reader& reader) {
  const CartModel model(cart);
  CartWorkspace work(model);
  CartState state = start_of(model, response);
  AccelerationTracer<Reader> tracer(reader);
  const auto go = [&](const CartSegment& ground, double begin, double end, bool ended) {
    reader.begin_segment(begin, end, ended);
    tracer.begin_segment(ground);
    move(work, ground, state, tracer);
    tracer.end_segment();
  };
  const std::size_t samples = response.displacement.size();
  for (std::size_t i = 0; i + 1 < samples; ++i)
    go(i < motion.segments() ? cart_segment(motion, i) : calm_for(motion.last_step()), motion.time(i),
       motion.time(i + 1), i == motion.segments());
  const double last = motion.time(samples - 1), end = response.events.back().time;
  if (response.truncated && end > last) go(calm_for(end - last), last, end, false);
}

// Reads the acceleration at samples, and the largest one.
class ForcesReader {
 public:
  explicit ForcesReader(std::size_t samples) : samples_(samples) { forces.acceleration.reserve(samples); }

  /// @param ended  whether the ground motion ends where it begins, so that the value before it counts
  void begin_segment(double begin, double end, bool ended) {
    begin_ = begin;
    end_ = end;
    wanted_ = std::min(wanted_ + 1, samples_);
    if (ended) keep(last_);
  }
  void line(double begin, double end, Vector2 first, Vector2 last) {
    keep(first);
    look(begin, first);
    look(end, last);
    last_ = last;
  }
  template <class At>
  void curve(double begin, double duration, const At& at) {
    keep(at(0));
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
    const double size = norm(acceleration);
    if (!std::isfinite(size))
      throw std::overflow_error("forces: the acceleration of the cart is beyond the range of doubles at " +
                                shortest(begin_ + time) + " s");
    if (!(size > (1 + 1e-13) * forces.peak)) return;
    forces.peak = size;
    forces.peak_time = std::min(begin_ + time, end_);
  }

  std::size_t samples_, wanted_ = 0;
  double begin_ = 0, end_ = 0;  // of the segment [s]
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
