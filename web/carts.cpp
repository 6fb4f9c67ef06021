// Carts on four casters or wheels, for the page; see exports.hpp.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "exports.hpp"
#include "stickslip/carts/cart.hpp"
#include "stickslip/carts/integrate.hpp"
#include "stickslip/carts/response.hpp"
#include "stickslip/carts/support.hpp"
#include "stickslip/excitation/random.hpp"

namespace {

using namespace stickslip;
using namespace stickslip::web;

constexpr std::size_t wheels = 4;

/// A cart on four supports at the corners of a rectangle, front right, front left, rear right and rear left; angles in
/// degrees.
struct CartSettings {
  enum Kind { free, one_locked, two_locked, all_locked, fixed_behind };
  double kind, mu, base_length, base_width, body_length, body_width, gyration, trail, wheel_width, rolling_mu;
  double vertical, scale;
  double headings[wheels];
};
constexpr const char* setting_names =
    "wheels mu base_length base_width body_length body_width gyration trail wheel_width rolling_mu vertical scale "
    "headings.0 headings.1 headings.2 headings.3";

struct CartSummary {
  double peak, peak_yaw, peak_outline, peak_time, peak_corner, residual_axis, residual_transverse, residual_yaw,
      time_moving, rests;
  double margin, at_rest, events, samples, input, imbalance, pga;
};
constexpr const char* summary_names =
    "peak peak_yaw peak_outline peak_time peak_corner residual_axis residual_transverse residual_yaw time_moving rests "
    "margin "
    "at_rest events samples input imbalance pga";

/// How many of the supports are locked, in their order.
std::size_t locked(const CartSettings& s) {
  switch (static_cast<CartSettings::Kind>(static_cast<int>(s.kind))) {
    case CartSettings::one_locked:
      return 1;
    case CartSettings::two_locked:
      return 2;
    case CartSettings::all_locked:
      return wheels;
    default:
      return 0;
  }
}
bool is_fixed(const CartSettings& s, std::size_t i) {
  return static_cast<int>(s.kind) == CartSettings::fixed_behind && i >= wheels / 2;
}

std::vector<Vector2> corners(double length, double width) {
  return {{length / 2, width / 2}, {length / 2, -width / 2}, {-length / 2, width / 2}, {-length / 2, -width / 2}};
}

Cart cart_of(const CartSettings& s) {
  const std::vector<Vector2> places = corners(s.base_length, s.base_width);
  std::vector<Support> supports;
  for (std::size_t i = 0; i < wheels; ++i) {
    const double heading = s.headings[i] * (std::numbers::pi / 180);
    if (is_fixed(s, i))
      supports.push_back(FixedWheel{places[i], 0, s.mu, s.rolling_mu});
    else if (i < locked(s))
      supports.push_back(Foot::of_locked_caster(places[i], heading, s.mu, s.trail));
    else
      supports.push_back(SwivelCaster::from_geometry(places[i], heading, s.mu, s.trail, s.wheel_width, s.rolling_mu));
  }
  std::vector<Vector2> outline = corners(s.body_length, s.body_width);
  std::swap(outline[2], outline[3]);  // around it
  return {std::move(supports), s.gyration, {}, std::move(outline)};
}

/// Whether it comes to rest on any path.
bool settles(const CartSettings& s) { return s.rolling_mu > 0 || locked(s) > 0; }

/// It stops a motion that would keep the page busy for minutes: some carts stick and slip without end before they rest.
CartOptions options_of(const CartSettings& s, const GroundMotion& motion) {
  CartOptions options;
  options.settle = settles(s);
  // The library reports after each 4,096 legs and events; most motions have two or three for each sample, some a hundred.
  options.progress = [left = 12 + motion.samples() / 250]() mutable {
    if (left-- == 0)
      throw std::runtime_error(
          "the wheels stick and slip so often that the page stops; the command and Python continue, see below");
  };
  return options;
}

/// Both horizontal components, and the vertical one if it acts.
GroundMotion driven_in_plane(const CartSettings& s, const GroundMotion& record) {
  GroundMotion motion = record;
  if (!is(s.vertical))
    motion = record.has_transverse() ? record.with_components({record.transverse().begin(), record.transverse().end()})
                                     : record.component(Component::axis);
  return s.scale == 1 ? motion : motion.scaled(s.scale);
}

CartResponse response;
std::vector<double> plan, ground;

}  // namespace

extern "C" {

STICKSLIP_EXPORT(cart_names) void cart_names() { say_names(setting_names, summary_names); }

/// Rolls. The input is the settings.
/// @return 0; `numbers` is the summary, and `cart_history` has the histories
STICKSLIP_EXPORT(roll) int roll(int number) {
  return guarded([&] {
    const auto settings = given_settings<CartSettings>();
    const GroundMotion motion = driven_in_plane(settings, of(number).motion);
    const Cart cart = cart_of(settings);
    response = integrate(cart, motion, options_of(settings, motion));
    const CartResponse& r = response;
    ground.assign(motion.acceleration().begin(), motion.acceleration().end());
    plan.clear();
    for (const Support& one : cart.supports()) {
      const Vector2 at = std::visit([](const auto& support) { return support.at; }, one);
      plan.insert(plan.end(), {static_cast<double>(one.index()), at.axis, at.transverse});
    }
    for (const Vector2& corner : cart.outline()) plan.insert(plan.end(), {corner.axis, corner.transverse});
    double pga = 0;
    for (std::size_t i = 0; i < motion.samples(); ++i)
      pga = std::max(pga, std::hypot(motion.acceleration()[i], motion.has_transverse() ? motion.transverse()[i] : 0));
    answer_with_summary(CartSummary{.peak = r.peak,
                                    .peak_yaw = r.peak_yaw,
                                    .peak_outline = r.peak_outline,
                                    .peak_time = r.peak_outline_time,
                                    .peak_corner = static_cast<double>(r.peak_corner),
                                    .residual_axis = r.residual.axis,
                                    .residual_transverse = r.residual.transverse,
                                    .residual_yaw = r.residual_yaw,
                                    .time_moving = r.time_moving,
                                    .rests = static_cast<double>(r.rests),
                                    .margin = r.margin,
                                    .at_rest = r.state.mode == CartMode::rest ? 1.0 : 0.0,
                                    .events = static_cast<double>(r.events.size()),
                                    .samples = static_cast<double>(r.displacement.size()),
                                    .input = r.energy.input,
                                    .imbalance = r.energy.imbalance(),
                                    .pga = pga});
    return 0;
  });
}

/// Peaks of the center [m], of the yaw [rad] and of the outline [m] of members `first` to `first + count - 1`, whose casters
/// that swivel have independent headings uniform over the circle: those of `Cart.with_random_headings`.
STICKSLIP_EXPORT(roll_at_random) int roll_at_random(int number, int first, int count, double seed) {
  return guarded([&] {
    const auto settings = given_settings<CartSettings>();
    const GroundMotion motion = driven_in_plane(settings, of(number).motion);
    const Cart cart = cart_of(settings);
    std::vector<double> headings(cart.casters());
    answer.clear();
    for (int member = first; member < first + count; ++member) {
      // As `detail::draw` draws parameters of this distribution; its file needs GSL.
      constexpr std::uint32_t purpose = 0x70617261;
      uniforms({static_cast<std::uint64_t>(seed), static_cast<std::uint64_t>(member), purpose}, headings);
      for (double& one : headings) one = (1 - one) * -std::numbers::pi + one * std::numbers::pi;
      const CartResponse r = integrate(cart.with_headings(headings), motion, options_of(settings, motion));
      answer.insert(answer.end(), {r.peak, r.peak_yaw, r.peak_outline});
    }
    return 0;
  });
}

/// What `roll` found: 0 and 1 the displacement of the center along the axis and across [m], 2 the yaw [rad], 3 the headings of
/// the casters that swivel [rad], sample by sample, 4 the ground acceleration along the axis [m/s^2], 5 the plan: for each
/// support its kind (0 swivel caster, 1 fixed wheel, 2 foot) and its place [m], then the corners of the outline.
STICKSLIP_EXPORT(cart_history) void cart_history(int which) {
  answer.clear();
  switch (which) {
    case 0:
      for (const Vector2& place : response.displacement) answer.push_back(place.axis);
      return;
    case 1:
      for (const Vector2& place : response.displacement) answer.push_back(place.transverse);
      return;
    case 2:
      return answer_with(response.yaw);
    case 3:
      return answer_with(response.headings);
    case 4:
      return answer_with(ground);
    case 5:
      return answer_with(plan);
  }
}

}  // extern "C"
