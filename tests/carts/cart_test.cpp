// Carts on swivel casters, fixed wheels and feet: reference values, closed forms, limits, symmetries and bad input.
#include "stickslip/carts/cart.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "carts/acceleration.hpp"
#include "carts/zonotope.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/carts/integrate.hpp"
#include "stickslip/friction/caster.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/planar/integrate.hpp"
#include "stickslip/sliding/integrate.hpp"
#include "support/catch.hpp"
#include "support/reference.hpp"
#include "support/size.hpp"

using namespace stickslip;
using Catch::Matchers::ContainsSubstring;

namespace {

constexpr double g = standard_gravity, pi = std::numbers::pi;
constexpr double side = 0.09905911141297671, reach = 0.04088265419079833;
const std::vector<Vector2> corners{{0.4, 0.3}, {-0.4, 0.3}, {-0.4, -0.3}, {0.4, -0.3}};
const std::array<Vector2, 4> places{Vector2{0.3, 0.2}, Vector2{0.3, -0.2}, Vector2{-0.3, 0.2}, Vector2{-0.3, -0.2}};

GroundMotion shaking(double factor, std::size_t samples, double vertical = 0, double turned_by = 0) {
  std::vector<double> x, y, up;
  const double c = std::cos(turned_by), s = std::sin(turned_by);
  for (std::size_t i = 0; i < samples; ++i) {
    const auto m = static_cast<double>(i);
    const double ax = factor * (2 * std::sin(0.7 * m) + 1.3 * std::cos(1.9 * m + 0.4));
    const double ay = factor * (1.5 * std::sin(0.9 * m + 1.1) + 0.8 * std::cos(2.3 * m));
    x.push_back(c * ax - s * ay);
    y.push_back(s * ax + c * ay);
    up.push_back(vertical * 2.5 * std::cos(0.5 * m + 0.2));
  }
  const GroundMotion motion(std::move(x), 0.1);
  return vertical > 0 ? motion.with_components(std::move(y), std::move(up)) : motion.with_components(std::move(y));
}

GroundMotion still(std::size_t samples) { return {std::vector<double>(samples), 0.1}; }

Cart four_casters(const std::array<double, 4>& headings, double rolling, double gyration = 0.25) {
  std::vector<Support> supports;
  for (std::size_t i = 0; i < 4; ++i)
    supports.push_back(SwivelCaster{places[i], headings[i], side, reach, rolling, {}});
  return Cart(std::move(supports), gyration, {}, corners);
}

Cart four_feet(const std::array<double, 4>& mu, double gyration = 0.25) {
  std::vector<Support> supports;
  for (std::size_t i = 0; i < 4; ++i) supports.push_back(Foot{places[i], mu[i], {}});
  return Cart(std::move(supports), gyration, {}, corners);
}

CartOptions pushed(Vector2 velocity, double yaw_rate, bool settle = true) {
  CartOptions options;
  options.velocity = velocity;
  options.yaw_rate = yaw_rate;
  options.settle = settle;
  return options;
}

Cart random_cart(std::mt19937_64& bits, bool feet) {
  std::uniform_real_distribution<double> u(0, 1);
  const std::size_t count = 3 + bits() % 3;
  std::vector<Support> supports;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector2 at{0.6 * u(bits) - 0.3, 0.4 * u(bits) - 0.2};
    const double share = 1.0 / static_cast<double>(count), kind = u(bits), rolling = 0.02 * u(bits);
    if (feet && kind < 0.3)
      supports.push_back(Foot{at, 0.05 + 0.3 * u(bits), share});
    else if (kind < 0.75)
      supports.push_back(SwivelCaster{at, 6.3 * u(bits), 0.3 * u(bits), 0.02 + 0.1 * u(bits), rolling, share});
    else
      supports.push_back(FixedWheel{at, 6.3 * u(bits), 0.5 * u(bits), rolling, share});
  }
  return Cart(std::move(supports), 0.15 + 0.3 * u(bits));
}

// The same supports and outline after a function of their places and headings.
template <class Move>
Cart moved(const Cart& cart, double gyration, Move&& move) {
  std::vector<Support> supports = cart.supports();
  for (Support& support : supports)
    std::visit(
        [&](auto& one) {
          double none = 0;
          if constexpr (requires { one.heading; })
            move(one.at, one.heading);
          else
            move(one.at, none);
        },
        support);
  return Cart(std::move(supports), gyration);
}

}  // namespace

TEST_CASE("Carts move as an independent program computes", "[carts]") {
  for (const reference::Value& row : reference::rows("carts", "carts")) {
    CAPTURE(row["id"].as<std::string>());
    const reference::Value params = row["params"], value = row["value"];
    std::vector<Support> supports;
    for (const reference::Value& one : params["supports"].items()) {
      const std::vector<reference::Value> v = one.items();
      const Vector2 at{v[1], v[2]};
      if (v[0].as<std::string>() == "caster")
        supports.push_back(SwivelCaster{at, v[6], v[4], v[7], v[5], double{v[3]}});
      else
        supports.push_back(FixedWheel{at, v[6], v[4], v[5], double{v[3]}});
    }
    const Cart cart(supports, params["radius_of_gyration"], Vector2{}, corners);
    const auto samples = static_cast<std::size_t>(double{params["samples"]});
    const double vertical =
        params.has("vertical") && params["vertical"].as<bool>() ? params.number("vertical_factor", 1) : 0;
    CartOptions options;
    if (params.has("start")) {
      const std::vector<double> start = params["start"].list();
      options = pushed({start[0], start[1]}, start[2], params.has("settle"));
      options.yaw = start[3];
    }
    const bool at_rest = params.has("at_rest");
    const CartResponse r =
        integrate(cart, at_rest ? still(samples) : shaking(params["factor"], samples, vertical), options);
    const double allowed = row["uncertainty"];
    const auto compare = [&](std::size_t i, const std::vector<double>& state) {
      CHECK(std::abs(r.displacement[i].axis - state[0]) <= allowed);
      CHECK(std::abs(r.displacement[i].transverse - state[1]) <= allowed);
      CHECK(std::abs(r.yaw[i] - state[2]) <= allowed);
      for (std::size_t c = 0; c < cart.casters(); ++c)
        CHECK(std::abs(r.headings[i * cart.casters() + c] + r.yaw[i] - state[3 + c]) <= allowed);
    };
    for (const std::size_t i : {25U, 50U, 75U})
      if (const std::string key = "at " + std::to_string(i); value.has(key.c_str()))
        compare(i, value[key.c_str()].list());
    compare(samples - 1, value["end"].list());
    CHECK(std::abs(r.peak - value["peak"]) <= allowed);
    CHECK(std::abs(r.peak_yaw - value["peak_yaw"]) <= allowed);
    CHECK(std::abs(r.peak_outline - value["peak_corner"]) <= allowed);
    CHECK(std::abs(r.energy.dissipated - value["friction"]) <= allowed);
    CHECK(r.rests == static_cast<std::size_t>(double{value["rests"]}));
    CHECK(std::abs(r.energy.imbalance()) <= 1e-13);
  }
}

TEST_CASE("Mirror pairs of casters follow the law of one axis", "[carts]") {
  const double heading = GENERATE(pi / 2, 1.0, 2.2);
  // On the line tan(psi/2) = exp(-x/r) tan(psi0/2): the law sech((x + x0)/r) starts at x0 = -r ln tan(psi0/2).
  const double x0 = -reach * std::log(std::tan(heading / 2));
  const GroundMotion motion = [&] {
    std::vector<double> a;
    for (int m = 0; m < 201; ++m) a.push_back(1.4 * std::sin(0.7 * m) + 0.91 * std::cos(1.9 * m + 0.4));
    return GroundMotion(std::move(a), 0.1);
  }();
  const CartResponse cart = integrate(four_casters({heading, -heading, heading, -heading}, 0), motion);
  IntegrateOptions options;
  options.displacement = x0;
  const Response slider = integrate(Slider(Caster(side * g, reach)), motion, options);
  for (std::size_t i = 0; i < motion.samples(); ++i) {
    CHECK(std::abs(cart.displacement[i].axis - (slider.displacement[i] - x0)) <= 1e-12);
    CHECK(std::abs(cart.displacement[i].transverse) <= 1e-14);
    CHECK(std::abs(cart.yaw[i]) <= 1e-14);
  }
}

TEST_CASE("Feet at one point slide as a planar slider does", "[carts]") {
  const GroundMotion motion = shaking(0.7, 101);
  const Cart cart({Foot{{0, 0}, 0.06, 0.5}, Foot{{0, 0}, 0.14, 0.5}}, 0.3);
  const CartResponse r = integrate(cart, motion);
  const PlanarResponse slider = integrate(PlanarSlider(Coulomb(0.1 * g)), motion);
  for (std::size_t i = 0; i < motion.samples(); ++i) CHECK(norm(r.displacement[i] - slider.displacement[i]) <= 1e-10);
  CHECK(r.peak_yaw <= 1e-14);
  CHECK(std::abs(r.peak - slider.peak) <= 1e-10);
}

TEST_CASE("A cart that spins on aligned casters stops at the angle of the closed form", "[carts]") {
  // Wheels on a circle of radius R trail at asin(r/R) and scrub at the rate of the yaw.
  const double radius = std::hypot(0.3, 0.2), gyration = 0.25, rolling = 0.01, rate = 2;
  const double trails = std::asin(reach / radius);
  std::array<double, 4> headings{};
  for (std::size_t i = 0; i < 4; ++i) headings[i] = std::atan2(places[i].transverse, places[i].axis) + pi / 2 - trails;
  const CartResponse r = integrate(four_casters(headings, rolling, gyration), still(81), pushed({}, rate));
  const double moment = side * g * reach + rolling * g * std::sqrt(radius * radius - reach * reach);
  CHECK(std::abs(r.residual_yaw - rate * rate * gyration * gyration / (2 * moment)) <= 1e-13);
  CHECK(r.peak <= 1e-14);
}

TEST_CASE("Two fixed wheels behind the center make Chaplygin's sleigh", "[carts]") {
  // u = U tanh(c U t/(k^2 + c^2) + const), with the axle c behind the center; the casters in front carry nothing.
  const double c = 0.4, k = 0.5, rate = 0.6;
  const Cart cart({FixedWheel{{-c, 0.3}, 0, 100, 0, 0.5}, FixedWheel{{-c, -0.3}, 0, 100, 0, 0.5},
                   SwivelCaster{{c, 0}, 0, 0, 0.05, 0, 0.0}},
                  k, Vector2{-c, 0});
  // With the center of mass over the axle the sleigh is a disc: it turns and rolls as it began.
  const CartResponse disc = integrate(cart, still(21), pushed({0.3, 0}, rate, false));
  const double t = 2, radius = 0.3 / rate;
  CHECK(std::abs(disc.displacement[20].axis - radius * std::sin(rate * t)) <= 1e-13);
  CHECK(std::abs(disc.displacement[20].transverse - radius * (1 - std::cos(rate * t))) <= 1e-13);
  CHECK(std::abs(disc.yaw[20] - rate * t) <= 1e-13);
  CHECK(std::abs(disc.energy.dissipated) <= 1e-14);

  // Before it: strong side wheels on the axle and light ones ahead without friction, so that the center lies c ahead.
  const double share = 0.25;
  const Cart sleigh({FixedWheel{{-c, 0.3}, 0, 1000, 0, share}, FixedWheel{{-c, -0.3}, 0, 1000, 0, share},
                     SwivelCaster{{c, 0.3}, 0, 0, 0.05, 0, share}, SwivelCaster{{c, -0.3}, 0, 0, 0.05, 0, share}},
                    k);
  const double u0 = 0.5, w0 = 1.1, inertia = k * k + c * c;
  const CartResponse r = integrate(sleigh, still(41), pushed({u0, c * w0}, w0, false));
  const double fast = std::sqrt(u0 * u0 + inertia * w0 * w0), shift = std::atanh(u0 / fast);
  for (const std::size_t i : {10U, 20U, 40U}) {
    const double phase = c * fast * 0.1 * static_cast<double>(i) / inertia + shift;
    const double ahead = std::cos(r.yaw[i]) * r.velocity[i].axis + std::sin(r.yaw[i]) * r.velocity[i].transverse;
    CHECK(std::abs(ahead - fast * std::tanh(phase)) <= 1e-12);
    CHECK(std::abs(r.yaw_rate[i] - fast / std::sqrt(inertia) / std::cosh(phase)) <= 1e-12);
  }
}

TEST_CASE("Feet on a ring and on a disc stop at the known ratios of sliding and turning", "[carts]") {
  // v/(omega R) at the end: 1 on a ring with k = R, 0.6530 on a uniform disc; many feet stand for them.
  const bool disc = GENERATE(false, true);
  const double radius = 0.5, golden = pi * (3 - std::sqrt(5.0));
  const int count = disc ? 40 : 24;
  std::vector<Support> supports;
  double square = 0;
  for (int i = 0; i < count; ++i) {
    const double at = disc ? golden * i : 2 * pi * i / count;
    const double far = disc ? radius * std::sqrt((i + 0.5) / count) : radius;
    square += far * far / count;
    supports.push_back(Foot{{far * std::cos(at), far * std::sin(at)}, 0.3, 1.0 / count});
  }
  const Cart body(std::move(supports), std::sqrt(square));
  CartState state;
  state.velocity = {0.9, 0.1};
  state.yaw_rate = 0.7;
  const CartResponse r = integrate(body, still(11), pushed(state.velocity, state.yaw_rate));
  const double stop = r.events[r.events.size() - 2].time;
  advance(body, {stop - 1e-7, {}, {}}, state);
  // Forty feet are a disc to 5 %.
  CHECK(std::abs(norm(state.velocity) / (std::abs(state.yaw_rate) * radius) - (disc ? 0.6530 : 1)) <=
        (disc ? 0.05 : 2e-3));
  // The body stops in the direction in which friction takes least, of y = (v, k omega) with |y| = 1.
  const double k = body.radius_of_gyration(), c = std::cos(state.yaw), s = std::sin(state.yaw);
  const auto dissipation = [&](detail::Vector3 y) {
    y = detail::scaled(1 / detail::norm(y), y);
    double sum = 0;
    for (const Support& one : body.supports()) {
      const Vector2 at = std::get<Foot>(one).at - body.center();
      const Vector2 arm{c * at.axis - s * at.transverse, s * at.axis + c * at.transverse};
      sum += std::hypot(y[0] - y[2] / k * arm.transverse, y[1] + y[2] / k * arm.axis) / count;
    }
    return sum;
  };
  const detail::Vector3 last{state.velocity.axis, state.velocity.transverse, k * state.yaw_rate};
  const double size = detail::norm(last);
  for (const double step : {0.02, -0.02})
    for (const std::size_t i : {0U, 1U, 2U}) {
      detail::Vector3 other = last;
      other[i] += step * size;
      CHECK(dissipation(other) > dissipation(last) - 1e-5);
    }
}

TEST_CASE("Energy, rotation, mirror images, scale and splitting hold for random carts", "[carts]") {
  const bool feet = GENERATE(false, true);
  std::mt19937_64 bits(feet ? 17 : 5);
  const GroundMotion motion = shaking(1.1, 31);
  for (int i = 0; i < test::size(40, 4); ++i) {
    const Cart cart = random_cart(bits, feet);
    const double k = cart.radius_of_gyration();
    const CartResponse r = integrate(cart, motion);
    CAPTURE(i, feet);
    CHECK(std::abs(r.energy.imbalance()) <= (feet ? 1e-9 : 1e-12));
    double by_support = 0;
    for (const SupportWork& work : r.energy.by_support) by_support += work.scrub + work.roll + work.slide;
    CHECK(std::abs(by_support - r.energy.dissipated) <= 1e-12);
    const double allowed = feet ? 1e-7 : 1e-9;  // decisions near a tie let round-off grow
    if (r.margin < 1e-3) continue;

    const double angle = 0.7, c = std::cos(angle), s = std::sin(angle);
    const auto turned = [&](Vector2 v) -> Vector2 {
      return {c * v.axis - s * v.transverse, s * v.axis + c * v.transverse};
    };
    CartOptions options;
    options.yaw = angle;
    const CartResponse rotated = integrate(cart, shaking(1.1, 31, 0, angle), options);
    CHECK(norm(rotated.residual - turned(r.residual)) <= allowed);
    CHECK(std::abs(rotated.residual_yaw - r.residual_yaw) <= allowed);

    const Cart image = moved(cart, k, [](Vector2& at, double& heading) {
      at.transverse = -at.transverse;
      heading = -heading;
    });
    std::vector<double> x(motion.acceleration().begin(), motion.acceleration().end()), y;
    for (const double a : motion.transverse()) y.push_back(-a);
    const CartResponse mirrored = integrate(image, GroundMotion(x, 0.1).with_components(y));
    CHECK(std::abs(mirrored.residual.axis - r.residual.axis) <= allowed);
    CHECK(std::abs(mirrored.residual.transverse + r.residual.transverse) <= allowed);
    CHECK(std::abs(mirrored.residual_yaw + r.residual_yaw) <= allowed);

    // Splitting a support into two of half the share changes nothing.
    std::vector<Support> split = cart.supports();
    std::visit([](auto& one) { one.share = *one.share / 2; }, split.front());
    split.push_back(split.front());
    const CartResponse halves = integrate(Cart(std::move(split), k), motion);
    CHECK(norm(halves.residual - r.residual) <= allowed);
    CHECK(std::abs(halves.residual_yaw - r.residual_yaw) <= allowed);
  }
}

TEST_CASE("A user's loop over segments is the motion", "[carts]") {
  const GroundMotion motion = shaking(0.7, 51, 0.8);
  for (const Cart& cart : {four_casters({0.3, 2.0, -2.5, -0.7}, 0.01), four_feet({0.1, 0.1, 0.12, 0.09})}) {
    const CartResponse r = integrate(cart, motion);
    CartState state;
    for (std::size_t i = 0; i < motion.segments(); ++i) {
      const Segment s = motion.segment(i);
      advance(cart,
              {s.duration,
               {s.start, motion.transverse()[i]},
               {s.end, motion.transverse()[i + 1]},
               motion.vertical()[i],
               motion.vertical()[i + 1]},
              state);
    }
    CHECK(norm(state.displacement - r.residual) <= 1e-9);
    CHECK(std::abs(state.yaw - r.residual_yaw) <= 1e-9);
  }
}

TEST_CASE("States at any time are those of a motion with more samples", "[carts]") {
  const GroundMotion coarse = shaking(0.7, 31, 0.8);
  constexpr std::size_t parts = 4;
  std::vector<double> along, across, up;
  for (std::size_t i = 0; i < coarse.segments(); ++i)
    for (std::size_t k = 0; k < parts; ++k) {
      const double part = static_cast<double>(k) / parts;
      along.push_back(std::lerp(coarse.acceleration()[i], coarse.acceleration()[i + 1], part));
      across.push_back(std::lerp(coarse.transverse()[i], coarse.transverse()[i + 1], part));
      up.push_back(std::lerp(coarse.vertical()[i], coarse.vertical()[i + 1], part));
    }
  along.push_back(coarse.acceleration().back());
  across.push_back(coarse.transverse().back());
  up.push_back(coarse.vertical().back());
  const GroundMotion fine = GroundMotion(along, 0.1 / parts).with_components(across, up);
  CartOptions options;
  options.yaw = 0.3;
  options.velocity = {0.1, -0.2};
  options.yaw_rate = 0.5;
  std::vector<double> times;
  for (std::size_t i = 0; i < fine.samples(); ++i) times.push_back(fine.time(i));
  for (const Cart& cart : {four_casters({0.3, 2.0, -2.5, -0.7}, 0.01), four_feet({0.1, 0.1, 0.12, 0.09})}) {
    const CartResponse few = integrate(cart, coarse, options), many = integrate(cart, fine, options);
    const std::vector<CartState> states = states_at(cart, coarse, few, times);
    for (std::size_t i = 0; i < times.size(); ++i) {
      CHECK(norm(states[i].displacement - many.displacement[i]) < 1e-9);
      CHECK(std::abs(states[i].yaw - many.yaw[i]) < 1e-9);
    }
    options.settle = true;
    const CartResponse whole = integrate(cart, coarse, options);
    const double ends[] = {whole.events.back().time};
    CHECK(states_at(cart, coarse, whole, ends)[0].mode == CartMode::rest);
    options.settle = false;
  }
}

TEST_CASE("Peaks, reach and clearance are those of a fine sampling", "[carts]") {
  const Cart cart = four_casters({0.3, 2.0, -2.5, -0.7}, 0.01);
  const GroundMotion motion = shaking(1.2, 41);
  CartOptions options;
  options.walls = {{{-0.45, 0}, {0, 1}}, {{0, -0.32}, {1, 0}}, {{5, 0}, {0, 1}}};
  const CartResponse r = integrate(cart, motion, options);
  constexpr int parts = 200;
  std::vector<double> x, y;
  for (std::size_t i = 0; i + 1 < motion.samples(); ++i)
    for (int p = 0; p < parts; ++p) {
      const double part = static_cast<double>(p) / parts;
      x.push_back((1 - part) * motion.acceleration()[i] + part * motion.acceleration()[i + 1]);
      y.push_back((1 - part) * motion.transverse()[i] + part * motion.transverse()[i + 1]);
    }
  const CartResponse fine = integrate(cart, GroundMotion(x, 0.1 / parts).with_components(y));
  double peak = 0, corner = 0, yaw = 0, right = -1, first = -1, least[3] = {9, 9, 9};
  for (std::size_t i = 0; i < fine.displacement.size(); ++i) {
    peak = std::max(peak, norm(fine.displacement[i]));
    yaw = std::max(yaw, std::abs(fine.yaw[i]));
    const double c = std::cos(fine.yaw[i]), s = std::sin(fine.yaw[i]);
    for (const Vector2& at : corners) {
      const Vector2 now =
          fine.displacement[i] + Vector2{c * at.axis - s * at.transverse, s * at.axis + c * at.transverse};
      corner = std::max(corner, norm(now - at));
      right = std::max(right, now.axis);
      const double distances[3] = {now.axis + 0.45, now.transverse + 0.32, 5 - now.axis};
      for (int w = 0; w < 3; ++w) least[w] = std::min(least[w], distances[w]);
      if (first < 0 && distances[0] < 0) first = static_cast<double>(i) * 0.1 / parts;
    }
  }
  // A sample is off by at most |a| dt^2/8 where the speed vanishes.
  const double near = 10 * std::pow(0.1 / parts, 2);
  CHECK((r.peak >= peak - 1e-12 && r.peak <= peak + near));
  CHECK((r.peak_yaw >= yaw - 1e-12 && r.peak_yaw <= yaw + 10 * near));
  CHECK((r.peak_outline >= corner - 1e-12 && r.peak_outline <= corner + near));
  CHECK((r.reach.high.axis >= right - 1e-12 && r.reach.high.axis <= right + near));
  for (std::size_t w = 0; w < 3; ++w)
    CHECK((r.clearances[w].least <= least[w] + 1e-12 && r.clearances[w].least >= least[w] - near));
  REQUIRE(first > 0);
  CHECK(std::abs(r.clearances[0].hit_time - first) <= 0.1 / parts);
  CHECK(r.clearances[0].hit_speed > 0);
  CHECK(std::isnan(r.clearances[2].hit_time));
}

TEST_CASE("An error of the headings grows as a perturbed motion shows", "[carts]") {
  // Straight ahead a trailing wheel forgets its error as exp(-s/r): of the way across r (1 - exp(-s/r)) remains at most.
  const Cart trailing({SwivelCaster{{0, 0}, 0, 0, reach, 0, {}}}, 0.25);
  CHECK(condition(trailing, still(11), pushed({1, 0}, 0, false)) == 0);  // without friction its wheel moves nothing
  // Wheels across the motion: with cos(psi) of the friction along the line a heading off by d changes the level by d^2/2
  // alone, but pushes the cart sideways by the level times d: at most a d t^2/2 after a time.
  const Cart across = four_casters({pi / 2, -pi / 2, pi / 2, -pi / 2}, 0);
  const double found = condition(across, still(11), pushed({0.2, 0}, 0, false));
  CHECK(found > 0);
  CHECK(found < side * g * 0.5);
  // A cart that rests does not feel its headings.
  CHECK(condition(four_casters({0.3, 2.0, -2.5, -0.7}, 0.01), still(11)) == 0);
  CHECK(condition(four_feet({0.1, 0.1, 0.1, 0.1}), still(11)) == 0);
  CHECK(condition(four_casters({0.3, 2.0, -2.5, -0.7}, 0.01), shaking(0.7, 101)) > 0.01);
}

TEST_CASE("What a parked cart holds is where it leaves", "[carts]") {
  const double direction = GENERATE(0.0, 0.4, 2.0, -1.3);
  const Vector2 along{std::cos(direction), std::sin(direction)};
  for (const Cart& cart : {four_casters({0.3, 2.0, -2.5, -0.7}, 0.01), four_feet({0.1, 0.1, 0.12, 0.09}),
                           Cart({Foot{{0.4, 0}, 0.2, {}}, FixedWheel{{-0.3, 0.25}, 0, 0.4, 0.01, {}},
                                 FixedWheel{{-0.3, -0.25}, 0, 0.4, 0.01, {}}},
                                0.25)}) {
    const double most = cart.holds(along), near = cart.casters() > 0 ? 1e-9 : 1e-4;
    for (const double part : {1 - near, 1 + near}) {
      CartState state;
      advance(cart, {0.5, (-part * most) * along, (-part * most) * along}, state);
      CHECK((norm(state.velocity) > 0) == (part > 1));
    }
  }
  // Two feet hold the sum of their friction along any direction.
  CHECK(std::abs(Cart({Foot{{0.3, 0}, 0.2, {}}, Foot{{-0.3, 0}, 0.2, {}}}, 0.3).holds(along) - 0.2 * g) <= 1e-9);
  // Wheels in line with the load hold by rolling alone, or not at all.
  CHECK(std::abs(four_casters({0, 0, 0, 0}, 0.01).holds({1, 0}) - 0.01 * g) <= 1e-12);
  CHECK(four_casters({0, 0, 0, 0}, 0).holds({1, 0}) == 0);
  CHECK(std::abs(four_casters({0, 0, 0, 0}, 0).holds({0, 1}) - side * g) <= 1e-12);
}

TEST_CASE("The acceleration of a cart minimizes its dissipation", "[carts]") {
  // Of random problems with lines and feet no direction leads lower, and the mode is that of the minimum.
  std::mt19937_64 bits(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i < test::size(200, 20); ++i) {
    detail::AccelerationProblem problem;
    const std::size_t lines = 1 + bits() % 6, feet = bits() % 3;
    std::vector<std::array<detail::Vector3, 2>> rows;
    std::vector<double> betas, levels;
    for (std::size_t j = 0; j < lines + feet; ++j) {
      const double x = 0.5 * normal(bits), y = 0.5 * normal(bits), angle = 3 * normal(bits);
      const double c = std::cos(angle), s = std::sin(angle);
      levels.push_back(std::abs(normal(bits)) / 2);
      if (j < lines) {
        rows.push_back({detail::Vector3{c, s, x * s - y * c}, {}});
        betas.push_back(i % 2 == 0 ? 0 : 0.3 * normal(bits));
        problem.add(rows.back()[0], betas.back(), levels.back());
      } else {
        rows.push_back({detail::Vector3{1, 0, -y}, {0, 1, x}});
        betas.push_back(0);
        problem.add(rows.back()[0], rows.back()[1], levels.back());
      }
    }
    const detail::Vector3 load{normal(bits), normal(bits), normal(bits)};
    const auto cost = [&](const detail::Vector3& a) {
      double sum = 0;
      for (std::size_t n = 0; n < 3; ++n) sum += (a[n] - load[n]) * (a[n] - load[n]) / 2;
      for (std::size_t j = 0; j < rows.size(); ++j)
        sum += levels[j] * std::hypot(detail::dot(rows[j][0], a) + betas[j], detail::dot(rows[j][1], a));
      return sum;
    };
    problem.solve(load);
    const detail::Vector3 a = problem.acceleration();
    const double least = cost(a);
    for (int tries = 0; tries < 30; ++tries) {
      detail::Vector3 other = a;
      const double size = std::pow(10.0, -tries % 6);
      for (double& component : other) component += size * normal(bits);
      CHECK(cost(other) >= least - 1e-11);
    }
    for (std::size_t j = 0; j < rows.size(); ++j) {
      const double rate = std::hypot(detail::dot(rows[j][0], a) + betas[j], detail::dot(rows[j][1], a));
      CHECK((problem.slides(j) != 0) == (rate > 1e-9));
    }
  }
}

TEST_CASE("Shares of the load are those of equal stiffness, or given", "[carts]") {
  const Cart even({Foot{{1, 1}, 0.1, {}}, Foot{{-1, 1}, 0.1, {}}, Foot{{-1, -1}, 0.1, {}}, Foot{{1, -1}, 0.1, {}}}, 1,
                  Vector2{0.2, -0.4});
  const std::vector<double> expected{0.2, 0.1, 0.3, 0.4};
  for (std::size_t i = 0; i < 4; ++i) CHECK(std::abs(even.shares()[i] - expected[i]) <= 1e-15);
  const Cart given({Foot{{1, 0}, 0.1, 0.75}, Foot{{-1, 0}, 0.1, 0.25}}, 1);
  CHECK(given.center() == Vector2{0.5, 0});
}

TEST_CASE("Carts refuse what they cannot mean, and name the support", "[carts]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](std::vector<Support> supports, const char* words, double gyration = 0.3,
                          std::optional<Vector2> center = {}) {
    CHECK_THROWS_WITH(Cart(std::move(supports), gyration, center), ContainsSubstring(words));
  };
  const Foot foot{{0, 0}, 0.1, {}};
  refused({}, "supports must be at least 1");
  refused({foot}, "radius_of_gyration must be positive", 0);
  refused({foot, Foot{{0, 0}, -0.1, {}}}, "support 1: mu must be finite and at least 0, got -0.1");
  refused({foot, SwivelCaster{{0, 0}, 0, 0.1, 0, 0, {}}}, "support 1: reach must be positive, got 0 m");
  refused({foot, SwivelCaster{{0, 0}, nan, 0.1, 1, 0, {}}}, "support 1: heading must be finite");
  refused({foot, FixedWheel{{0, nan}, 0, 0.1, 0, {}}}, "support 1: at must be finite");
  refused({Foot{{1, 0}, 0.1, {}}, Foot{{-1, 0}, 0.1, {}}}, "support 1 would carry a negative share", 0.3,
          Vector2{2, 0});
  refused({Foot{{1, 0}, 0.1, {}}, Foot{{-1, 0}, 0.1, {}}}, "off by, got 0.5 m", 0.3, Vector2{0, 0.5});
  refused({Foot{{1, 0}, 0.1, 0.5}, Foot{{-1, 0}, 0.1, {}}}, "support 1: it has no share");
  refused({Foot{{1, 0}, 0.1, 0.5}, Foot{{-1, 0}, 0.1, 0.6}}, "sum 1, got 1.1");
  refused({Foot{{1, 0}, 0.1, 0.5}, Foot{{-1, 0}, 0.1, 0.5}}, "where the shares put it", 0.3, Vector2{0.1, 0});

  const Cart cart = four_casters({0, 1, 2, 3}, 0);
  CHECK_THROWS_WITH(integrate(cart, still(3), pushed({1, 0}, 0)), ContainsSubstring("may roll without end"));
  CHECK_THROWS_WITH(cart.holds({0, 0}), ContainsSubstring("direction must be finite and not zero"));
  CHECK_THROWS_WITH(cart.with_headings(std::vector<double>{1.0}), ContainsSubstring("as many as"));
  CartOptions options;
  options.walls = {{{1, 0}, {0, 0}}};
  CHECK_THROWS_WITH(integrate(cart, still(3), options), ContainsSubstring("direction of a wall"));
  CartState state;
  CHECK_THROWS_WITH(advance(cart, {nan, {}, {}}, state), ContainsSubstring("must be finite"));
  CHECK_THROWS_WITH(advance(cart, {-1, {}, {}}, state), ContainsSubstring("at least 0"));
  // Nothing resists the turning of a cart on one wheel.
  CHECK_THROWS_AS(integrate(Cart({FixedWheel{{0, 0}, 0, 0.1, 0.1, {}}}, 0.3), still(3), pushed({}, 1)),
                  ConvergenceError);
}

TEST_CASE("A cart whose wheels are almost parallel rolls on after a stop", "[carts]") {
  // Headings of a few 1e-4 that differ by 5e-8: together the lines across would hold the cart, by less than the error of a decision.
  std::vector<Support> supports;
  for (const Vector2& at : {places[0], places[1]}) supports.push_back(SwivelCaster{at, 0, side, reach, 0.01, {}});
  for (const Vector2& at : {places[2], places[3]}) supports.push_back(FixedWheel{at, 0, 0.5, 0.01, {}});
  const Cart cart(std::move(supports), 0.25);
  for (const double apart : {5e-8, 1e-10, 1e-13, 0.0}) {
    CartState state;
    state.headings = {-0.00024781, -0.00024781 - apart};
    const double first = -0.11, last = -0.16, duration = 0.007;
    advance(cart, {duration, {first, 0}, {last, 0}}, state);
    // Rolling alone; the casters slip sideways by 1e-4 of it.
    const double rolls = (-(first + last) / 2 - 0.01 * g) * duration;
    CHECK(state.velocity.axis == Approx(rolls).epsilon(1e-3));
    advance(cart, {1, {}, {}}, state);
    CHECK(state.mode == CartMode::rest);
  }
  // In motion, through a rest that ends at once: a decision names the wrong direction of one line.
  CartState state{.displacement = {0.9968371698846167, 0.0015094527659777074},
                  .yaw = 0.0008531473346193742,
                  .velocity = {0.0017213810429339365, 1.264966205521309e-06},
                  .yaw_rate = -6.78752417754978e-07,
                  .headings = {-0.00023656053172625035, -0.00023660273043046184},
                  .mode = CartMode::moving,
                  .lines = {-1, 1, 0, 1, 0, 1, 0, 1}};
  advance(cart, {0.02, {-0.061048161446999996, 0}, {0.141228508645, 0}}, state);
  CHECK(state.velocity.axis < -1e-5);
  CHECK(state.velocity.axis > -1e-3);
}

TEST_CASE("A cart with a locked caster comes to rest without ground motion", "[carts]") {
  // About the foot, with all wheels rolling: no load is left that could move it again.
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> angle(-pi, pi), rate(-1, 1);
  for (int k = 0; k < 60; ++k) {
    std::vector<Support> supports{Foot{{0.27, 0.2}, 0.5, {}}};
    for (std::size_t i = 1; i < 4; ++i) supports.push_back(SwivelCaster{places[i], angle(random), 0.2, 0.03, 0.01, {}});
    const Cart cart(std::move(supports), 0.25);
    CartState state;
    state.velocity = {rate(random), rate(random)};
    state.yaw_rate = 3 * rate(random);
    state.mode = CartMode::moving;
    for (int second = 0; second < 5; ++second) advance(cart, {1, {}, {}}, state);
    CHECK(state.mode == CartMode::rest);
    CHECK(norm(state.displacement) < 1);
  }
}

TEST_CASE("A cart on feet under a load along one line moves as a slider", "[carts]") {
  std::mt19937_64 bits(5);
  std::uniform_real_distribution<double> u(0, 1);
  for (int n = 0; n < 100; ++n) {
    CAPTURE(n);
    const double mu = 0.02 + 0.6 * u(bits), direction = n % 2 == 0 ? 0 : 2 * pi * u(bits);
    std::vector<double> along, x, y;
    for (int i = 0; i < 200; ++i) along.push_back(8 * u(bits) * u(bits) * std::sin(0.7 * i));
    for (const double a : along) x.push_back(a * std::cos(direction)), y.push_back(a * std::sin(direction));
    const CartResponse r = integrate(four_feet({mu, mu, mu, mu}),
                                     GroundMotion(std::move(x), 0.05).with_components(std::move(y)), pushed({}, 0));
    const Response expected =
        integrate(Slider(Coulomb(mu * g)), GroundMotion(std::move(along), 0.05), {.settle = true});
    CHECK(std::abs(r.peak - expected.peak) < 1e-8 + 1e-6 * expected.peak);
  }
}

TEST_CASE("A cart on feet breaks away under the load that it holds, however slowly it grows", "[carts]") {
  const Cart cart({Foot{{0.34, -0.18}, 0.2}, Foot{{0.35, 0.19}, 0.2}, Foot{{-0.13, 0.3}, 0.5}, Foot{{-0.4, 0}, 0.5},
                   Foot{{-0.11, -0.29}, 0.1}},
                  0.485);
  const double holds = cart.holds(Vector2{0.6, 0.8}), dt = 1e-3;
  for (const double rate : {0.05, 1.0, 5.0}) {
    CAPTURE(rate);
    std::vector<double> x, y;
    for (double load = 0; load < 1.1 * holds; load += rate * dt) x.push_back(-0.6 * load), y.push_back(-0.8 * load);
    const GroundMotion motion = GroundMotion(std::move(x), dt).with_components(std::move(y));
    CHECK(integrate(cart, motion).events.front().time * rate == Approx(holds).epsilon(1e-6));
  }
}

TEST_CASE("States do not depend on which others are asked", "[carts]") {
  const Cart cart(
      {Foot{{0.3412994345289621, -0.1759825749076364}, 0.2}, Foot{{0.3533372181831855, 0.1890622997608256}, 0.2},
       Foot{{-0.127369924929353, 0.2956703564875106}, 0.5}, Foot{{-0.39967715009291227, -0.0004486994343815399}, 0.5},
       Foot{{-0.1138646081618272, -0.29099179951024357}, 0.1}},
      0.4851479329248457);
  const GroundMotion motion = GroundMotion({-1, -1, -4, -5, -2}, 0.1).with_components({-1, -1, -4, 1, 4});
  const CartResponse r = integrate(cart, motion);
  std::vector<double> times{r.events.front().time};
  for (int i = 0; i <= 3000; ++i) times.push_back(0.4 * i / 3000);
  const std::vector<CartState> states = states_at(cart, motion, r, times);
  for (std::size_t i = 0; i < r.velocity.size(); ++i) CHECK(norm(states[1 + 750 * i].velocity - r.velocity[i]) < 1e-8);
  const std::vector<double> late{motion.time(4), 0.41};
  CHECK_THROWS_WITH(states_at(cart, motion, r, late), ContainsSubstring("the end of the response"));
}
