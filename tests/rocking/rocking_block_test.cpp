// Rigid blocks that rock, slide and fly: reference values, impacts, limits, balances and bad input.
#include "stickslip/rocking/rocking_block.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "rocking/rigid_impact.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/rocking/integrate.hpp"
#include "stickslip/sliding/integrate.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"
#include "support/reference.hpp"
#include "support/size.hpp"

using namespace stickslip;
using Catch::Matchers::ContainsSubstring;
using reference::Value;

namespace {

constexpr double g = standard_gravity, pi = std::numbers::pi;

GroundMotion reference_motion(const Value& row) {
  std::vector<double> n, up;
  const double vertical = row.number("vertical", 0), factor = row["factor"];
  for (int m = 0; m <= 200; ++m) {
    n.push_back(factor * (2 * std::sin(0.7 * m) + 1.3 * std::cos(1.9 * m + 0.4)));
    if (vertical > 0) up.push_back(vertical * 2.5 * std::cos(0.5 * m + 0.2));
  }
  const GroundMotion motion(n, 0.1);
  return up.empty() ? motion : motion.with_components({}, up);
}

RockingBlock reference_block(const Value& row) {
  const double b = row["b"], h = row["h"], left = row.number("b_left", b);
  RockingBlockSize size{.width = b + left, .height = 2 * h, .mu = row["mu"]};
  size.center.emplace((left - b) / 2, h);
  size.gyration_radius = std::sqrt((b * b + h * h) / 3);
  if (row.has("lever")) size.lever = row["lever"];
  return RockingBlock(size);
}

// Whether an event begins a mode, or is an impact, at a time with twelve digits.
bool has_event(const RockingResponse& r, double time, const std::string& mode) {
  return std::any_of(r.events.begin(), r.events.end(), [&](const RockingEvent& event) {
    if (std::abs(event.time - time) > 5.1e-12 * time) return false;
    const bool arrives = event.kind == RockingEventKind::impact || event.kind == RockingEventKind::landing;
    if (mode == "impact") return arrives;
    if (mode == "flight") return event.kind == RockingEventKind::liftoff;
    if (mode == "rest") return event.kind == RockingEventKind::rest;
    if (mode == "rock")
      return arrives || event.kind == RockingEventKind::uplift || event.kind == RockingEventKind::stick;
    return arrives || event.kind == RockingEventKind::slip;
  });
}

}  // namespace

TEST_CASE("rigid block: reference values") {
  for (const Value& row : reference::rows("rocking", "rigid_blocks")) {
    CAPTURE(row["id"].as<std::string>());
    RockingOptions options;
    options.rotation = row.number("theta0", 0);
    const RockingBlock block = reference_block(row);
    const RockingResponse r = integrate(block, reference_motion(row), options);
    const double within = row["compare"];
    CHECK(r.overturned == row["overturned"].as<int>());
    CHECK(r.impacts == static_cast<std::size_t>(row["impacts"].as<int>()));
    CHECK(r.liftoffs == static_cast<std::size_t>(row["liftoffs"].as<int>()));
    CHECK(r.energy.dissipated == Approx(row["friction"]).margin(within));
    CHECK(r.energy.impact == Approx(row["loss"]).margin(within));
    CHECK(r.sliding_distance == Approx(row["slid"]).margin(within));
    CHECK(std::abs(r.energy.imbalance()) <= 1e-12 * std::max(1.0, r.energy.impact));
    for (const Value& begins : row["first_modes"].items()) {
      const double time = begins.items()[0];
      const std::string mode = begins.items()[1].as<std::string>();
      CAPTURE(time, mode);
      if (time > 0) CHECK(has_event(r, time, mode));
    }
    for (const Value& sample : row["samples"].items()) {
      const std::vector<double> values = sample.list();
      const auto i = static_cast<std::size_t>(values[0]);
      CHECK(std::abs(r.rotation[i] - values[1]) <= within);
      CHECK(std::abs(r.displacement[i] - values[2]) <= within);
    }
    if (r.overturned != 0) {
      CHECK(r.overturned_at == Approx(row["time_overturned"]).epsilon(within));
      CHECK(r.displacement.back() == Approx(row["base_then"]).margin(within));
      CHECK(std::abs(r.rotation.back()) == pi / 2);
      continue;
    }
    CHECK(std::abs(r.rotation.back() - row["rotation"]) <= within);
    CHECK(std::abs(r.rate.back() - row["rate"]) <= 10 * within);
    CHECK(std::abs(r.residual - row["base"]) <= within);
    CHECK(r.peak == Approx(row["peak"]).margin(within));
    if (row.has("peak_time")) CHECK(r.peak_time == Approx(row["peak_time"]).epsilon(within));
  }
}

TEST_CASE("rigid block: the first mode out of rest") {
  struct Row {
    double mu, load;
    RockingMode mode;
    int slip;
  };
  using enum RockingMode;
  for (const Row& row : {Row{0.25, -0.2, rest, 0},
                         {0.25, -0.28, slide, 1},
                         {0.35, -0.28, rest, 0},
                         {0.35, -0.31, right, 0},
                         {0.35, -0.5, right, 0},
                         {0.35, -0.55, right, 1},
                         {0.5, -0.5, right, 0},
                         {0.5, -2, right, 1},
                         {1.1, -4, right, 0},
                         {0.9, -4, right, 0},
                         {0.35, 0.6, left, -1}}) {
    CAPTURE(row.mu, row.load);
    RockingState state;
    advance(RockingBlock({.width = 0.6, .height = 2, .mu = row.mu}), {1e-4, row.load * g, row.load * g}, state);
    CHECK(state.mode == row.mode);
    CHECK(state.slip == row.slip);
    CHECK((state.velocity * row.slip > 0) == (row.slip != 0));
  }
  CHECK((1.0 / 3 * 1.09 + 0.09) / 0.3 == Approx(1.511111111111111111111));
}

TEST_CASE("rigid block: restitution by its geometry, by its lever and as given") {
  const RockingBlock block({.width = 0.6, .height = 2});
  CHECK(block.restitution_right() == Approx(0.8761467889908256880734).epsilon(1e-15));
  CHECK(block.restitution_right() == Approx(housner_restitution(block.alpha())).epsilon(1e-14));
  CHECK(RockingBlock({.width = 0.6, .height = 2, .lever = 0.5}).restitution_left() ==
        Approx(0.9360946745562130177515).epsilon(1e-15));
  RockingBlockSize uneven{.width = 0.7, .height = 2, .center = {{0.05, 1}}};
  uneven.gyration_radius = std::sqrt(1.09 / 3);
  CHECK(RockingBlock(uneven).restitution_left() == Approx(0.8161925601750547045952).epsilon(1e-15));
  CHECK(RockingBlock(uneven).alpha() == RockingBlock(uneven).alpha_right());
  uneven.restitution = 0.7;
  CHECK(RockingBlock(uneven).restitution_left() == Approx(0.7).epsilon(1e-14));
  CHECK(RockingBlock(uneven).restitution_right() == Approx(0.7).epsilon(1e-14));
  // The history of free rocking shows it, and the energy that the impact loses.
  uneven.restitution = 0.95;
  const RockingBlock given(uneven);
  RockingOptions tilted;
  tilted.rotation = 0.1;
  const RockingResponse r = integrate(given, GroundMotion({0, 0}, 0.7), tilted);  // one impact
  const auto impact = std::find_if(r.events.begin(), r.events.end(),
                                   [](const RockingEvent& event) { return event.kind == RockingEventKind::impact; });
  const double inertia = given.gyration_square() + 1, energy = g * (0.3 * std::sin(0.1) - 1 + std::cos(0.1));
  CHECK(impact->side == -1);
  CHECK(impact->rate == Approx(-std::sqrt(2 * energy / (inertia + 0.09))).epsilon(1e-13));
  CHECK(impact->speed == Approx(-impact->rate * 0.7).epsilon(1e-13));
  CHECK(r.energy.impact == Approx(energy - (inertia + 0.16) * std::pow(0.95 * impact->rate, 2) / 2).epsilon(1e-12));
}

TEST_CASE("rigid block: where friction decides nothing it says so") {
  RockingBlockSize size{.width = 0.6, .height = 2, .mu = 0.4, .gyration_radius = std::sqrt(0.05)};
  RockingBlockSize known = size;
  known.gyration_radius = std::sqrt(0.05 * 1.09);
  CHECK(RockingBlock(known).painleve_friction() == Approx(0.4582575694955840006588).epsilon(1e-14));
  CHECK(RockingBlock({.width = 0.6, .height = 2}).painleve_friction() == Approx(4.0 / 3).epsilon(1e-15));
  for (const auto& [mu, weight] :
       {std::pair(0.4, 0.1603747341493767735875), {0.6, -0.6541269772131017716254}, {0.9, -1.875879544256819589445}}) {
    size.mu = mu;
    const RockingBlock block(size);
    CHECK(detail::slip_denominator(block, detail::arm(block, 1, 0.1), 1) == Approx(weight).epsilon(1e-14));
    RockingState slips = RockingState::at(0.1, 0);
    slips.slip = 1;
    slips.velocity = 0.5;
    if (mu < 0.43) {
      advance(block, {0.01, 0, 0}, slips);
      continue;
    }
    const RockingState before = slips;
    CHECK_THROWS_AS(advance(block, {0.01, 0, 0}, slips), ConvergenceError);
    CHECK_THROWS_WITH(advance(block, {0.01, 0, 0}, slips),
                      ContainsSubstring("theta = 0.1") && ContainsSubstring("mu_P = 0.438"));
    CHECK(slips.velocity == before.velocity);
  }
}

TEST_CASE("rigid block: one that only slides or is thrown up flat is a slider") {
  for (const auto& [mu, factor, vertical] : {std::tuple(0.1, 1.0, 0.0), {0.4, 2.0, 5.5}, {0.2, 1.5, 3.0}}) {
    std::vector<double> n, up;
    for (int m = 0; m <= 200; ++m) {
      n.push_back(factor * (2 * std::sin(0.7 * m) + 1.3 * std::cos(1.9 * m + 0.4)));
      up.push_back(vertical * 2.5 * std::cos(0.5 * m + 0.2));
    }
    const GroundMotion motion = GroundMotion(n, 0.1).with_components({}, up);
    const RockingResponse block = integrate(RockingBlock({.width = 1, .height = 2, .mu = mu}), motion);
    const Response slider = integrate(Slider(Coulomb(mu * g)), motion);
    CHECK(block.peak == 0);
    double off = 0;
    for (std::size_t i = 0; i < n.size(); ++i)
      off = std::max(off, std::abs(block.displacement[i] - slider.displacement[i]));
    CHECK(off <= 1e-12);
    CHECK(block.energy.dissipated + block.energy.impact >= slider.energy.dissipated - 1e-12);
    CHECK(block.sliding_distance <= slider.sliding_distance + 1e-12);
  }
}

TEST_CASE("rigid block: a slender one is the slender block") {
  double last = 1;
  for (const double alpha : {0.03, 0.01, 0.003}) {
    std::vector<double> n;
    for (int m = 0; m <= 60; ++m) n.push_back(alpha * 5.3 * (2 * std::sin(0.7 * m) + 1.3 * std::cos(1.9 * m + 0.4)));
    const double width = 2 * std::tan(alpha);
    RockingBlockSize size{.width = width, .height = 2, .restitution = 0.9};
    const RockingResponse rigid = integrate(RockingBlock(size), GroundMotion(n, 0.1));
    const RockingResponse slender = integrate(SlenderBlock::from_size(width, 2, 0.9), GroundMotion(n, 0.1));
    REQUIRE(slender.overturned == 0);
    const double off = std::abs(rigid.rotation.back() - slender.rotation.back()) / alpha;
    const auto impacts = [](const RockingResponse& r) {
      return std::count_if(r.events.begin(), r.events.end(),
                           [](const RockingEvent& event) { return event.kind == RockingEventKind::impact; });
    };
    CHECK(impacts(rigid) == impacts(slender));
    CHECK(off < 0.4 * last);
    CHECK(off < 0.5 * alpha);
    last = off;
  }
}

TEST_CASE("rigid block: mirror image, scaling, parts and energy") {
  int fallen = 0, flown = 0, slipped = 0;
  for (std::uint64_t seed = 0; seed < test::size(60U, 20U); ++seed) {
    const double part = static_cast<double>(seed % 10) / 10;
    std::vector<double> n = test::gaussian(seed, 200, 3 + 2 * part, true),
                        up = test::gaussian(seed + 500, 200, 1 + 5 * part, true);
    RockingBlockSize size{.width = 0.7, .height = 1.8, .mu = 0.3 + part, .center = {{0.05, 0.8}}};
    if (seed % 3 == 0) size.restitution = 0.85;
    const RockingBlock block(size);
    const GroundMotion motion = GroundMotion(n, 0.05).with_components({}, up);
    const RockingResponse r = integrate(block, motion);
    CAPTURE(seed, r.overturned, r.impacts, r.liftoffs);
    CHECK(std::abs(r.energy.imbalance()) <= 1e-12 * std::max(1.0, r.energy.impact + r.energy.dissipated));
    CHECK(r.energy.dissipated >= 0);
    CHECK(r.energy.impact >= 0);
    fallen += r.overturned != 0, flown += r.liftoffs > 0, slipped += r.sliding_distance > 0;
    // Mirrored, without any difference.
    std::vector<double> turned = n;
    for (double& value : turned) value = -value;
    size.center = {{-0.05, 0.8}};
    const RockingResponse m = integrate(RockingBlock(size), GroundMotion(turned, 0.05).with_components({}, up));
    CHECK(m.peak == r.peak);
    CHECK(m.overturned == -r.overturned);
    CHECK(m.events.size() == r.events.size());
    CHECK(m.residual == -r.residual);
    CHECK(m.rotation.back() == -r.rotation.back());
    // Four times as large and twice as slow, without any difference but in what is counted.
    RockingBlockSize large{
        .width = 2.8, .height = 7.2, .mu = size.mu, .restitution = size.restitution, .center = {{0.2, 3.2}}};
    const RockingResponse s = integrate(RockingBlock(large), GroundMotion(n, 0.1).with_components({}, up));
    CHECK(s.overturned == r.overturned);
    CHECK(s.peak == Approx(r.peak).epsilon(1e-9));
    // Segment by segment, with each divided in three.
    if (r.overturned != 0) continue;
    RockingState state;
    for (std::size_t i = 0; i + 1 < n.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        const auto at = [&](const std::vector<double>& of, int j) { return of[i] + (of[i + 1] - of[i]) * j / 3; };
        advance(block, {0.05 / 3, at(n, k), at(n, k + 1), at(up, k), at(up, k + 1)}, state);
      }
    CHECK(state.rotation == Approx(r.rotation.back()).margin(1e-8));
  }
  CHECK(fallen > 0);
  CHECK(flown > 0);
  CHECK(slipped > 0);
}

// Every case of an impact of the base, tried apart: one corner that sticks or slips while the other leaves, or both.
TEST_CASE("rigid block: exactly one case of an impact is consistent, and none creates energy") {
  std::mt19937_64 engine(11);
  const auto random = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(engine() >> 11) * 0x1p-53);
  };
  int cases[3] = {0, 0, 0};
  for (int i = 0; i < 10'000; ++i) {
    RockingBlockSize size{.width = random(0.2, 3), .height = random(0.5, 3)};
    size.center = {{size.width * random(-0.3, 0.3), size.height * random(0.2, 0.8)}};
    size.gyration_radius = random(0.2, 0.8) * std::hypot(size.width, size.height) / 2;
    const RockingBlock geometry(size);
    const double k = geometry.gyration_square(), h = geometry.center_height();
    const double b[2] = {geometry.right(), -geometry.left()};
    double least = 10;
    for (const double x : b) least = std::min(least, (k + x * x) / (std::abs(x) * h));
    size.mu = random(0.02, 0.99) * least;
    const RockingBlock block(size);
    const double mu = block.mu();
    // Rocking about one corner, or landing flat.
    detail::RigidVelocity v{random(-2, 2), random(-1, 0), 0};
    if (i % 2 == 0) {
      const double about = b[i / 2 % 2];
      v.w = about > 0 ? -random(0, 1) : random(0, 1);
      v.y = v.w * about;
    } else {
      v.w = random(v.y / -b[1], -v.y / b[0]) * 0.999;
    }
    int consistent = 0;
    for (const int c : {0, 1}) {
      const double x = b[c], down = v.y - v.w * x, across = v.x - v.w * h;
      if (!(down < 0)) continue;
      for (const int s : {-1, 0, 1}) {  // slips to a side, or sticks
        double t, p;
        const double nn = 1 + x * x / k, nt = x * h / k, tt = 1 + h * h / k;
        if (s == 0) {
          t = (nt * down - nn * across) / (nn * tt - nt * nt);
          p = -(down + nt * t) / nn;
          if (std::abs(t) > mu * p) continue;
        } else {
          p = -down / (nn - s * mu * nt);
          t = -s * mu * p;
          if (p < 0 || s * (across + tt * t + nt * p) <= 0) continue;
        }
        const double w = v.w + (-h * t - x * p) / k, other = v.y + p - w * b[1 - c];
        consistent += p >= 0 && other > 0;
      }
    }
    const double push = -v.y, t = std::abs(v.x) <= mu * push ? -v.x : -std::copysign(mu * push, v.x);
    const double right = (k * v.w - h * t - b[1] * push) / (b[0] - b[1]);
    consistent += right >= 0 && right <= push;
    CAPTURE(i, mu, v.x, v.y, v.w, block.right(), block.left(), h, k);
    CHECK(consistent == 1);
    const detail::RigidImpact found = base_impact(block, v);
    CHECK(kinetic_energy(block, found.after) <= kinetic_energy(block, v) * (1 + 1e-14));
    CHECK((found.side == 0) == (right >= 0 && right <= push));
    ++cases[found.side == 0 ? 0 : found.slip == 0 ? 1 : 2];
  }
  for (const int count : cases) CHECK(count > 100);
}

// Time stepping without events (Moreau): positions at midpoints, and velocities after impulses that hold 0 <= v_n, 0 <= p_n,
// v_n p_n = 0 and |p_t| <= mu p_n at corners that touch the ground. First order.
TEST_CASE("rigid block: states at any time are those of a motion with more samples") {
  constexpr int parts = 8;
  const auto motion = [](int divided) {
    std::vector<double> n, up;
    for (int m = 0; m <= 60 * divided; ++m) {
      const auto at = [](int k) { return 1.3 * (2 * std::sin(0.7 * k) + 1.3 * std::cos(1.9 * k + 0.4)); };
      const int k = m / divided;
      n.push_back(std::lerp(at(k), at(k + 1), static_cast<double>(m % divided) / divided));
      up.push_back(0.5 + 0.01 * m / divided);
    }
    return GroundMotion(n, 0.1 / divided).with_components({}, up);
  };
  const RockingBlock block({.width = 0.5, .height = 2, .mu = 0.5});
  const GroundMotion coarse = motion(1), fine = motion(parts);
  RockingOptions options;
  options.rotation = 0.05;
  const RockingResponse few = integrate(block, coarse, options), many = integrate(block, fine, options);
  REQUIRE(many.impacts > 3);
  std::vector<double> times;
  for (std::size_t i = 0; i < fine.samples(); ++i) times.push_back(fine.time(fine.samples() - 1 - i));
  const std::vector<RockingState> states = states_at(block, coarse, few, times);
  for (std::size_t i = 0; i < times.size(); ++i) {
    CHECK(std::abs(states[times.size() - 1 - i].rotation - many.rotation[i]) < 1e-12);
    CHECK(std::abs(states[times.size() - 1 - i].rate - many.rate[i]) < 1e-11);
  }
  options.settle = true;
  const RockingResponse whole = integrate(block, coarse, options);
  const double ends = whole.events.back().time, after[] = {6.05, ends, 0};
  REQUIRE(ends > 6.05);
  const std::vector<RockingState> then = states_at(block, coarse, whole, after);
  CHECK(then[0].mode != RockingMode::rest);
  CHECK(then[1].mode == whole.state.mode);
  CHECK(std::abs(then[2].rotation - 0.05) <= 0);
  CHECK_THROWS_AS(states_at(block, coarse, few, after), std::invalid_argument);
}

TEST_CASE("rigid block: steps in time agree") {
  struct Case {
    double half, mu, factor, vertical;
    int samples;
  };
  for (const Case& one :
       {Case{0.3, 0.36, 5, 0, 60}, {0.3, 0.2, 3, 0, 60}, {0.5, 0.4, 2, 5.5, 60}, {0.25, 0.5, 1.3, 0, 40}}) {
    std::vector<double> n, up;
    for (int m = 0; m <= one.samples; ++m) {
      n.push_back(one.factor * (2 * std::sin(0.7 * m) + 1.3 * std::cos(1.9 * m + 0.4)));
      up.push_back(one.vertical * 2.5 * std::cos(0.5 * m + 0.2));
    }
    const RockingBlock block({.width = 2 * one.half, .height = 2, .mu = one.mu});
    const RockingResponse exact = integrate(block, GroundMotion(n, 0.1).with_components({}, up));
    const double k = block.gyration_square(), mu = one.mu;
    const int parts = test::size(10'000, 2'000);
    const double dt = 0.1 / parts;
    double x = 0, y = 1, theta = 0, peak = 0;
    detail::RigidVelocity v{0, 0, 0};
    for (std::size_t i = 0; i + 1 < n.size(); ++i)
      for (int j = 0; j < parts; ++j) {
        const double at = (j + 0.5) / parts;
        x += dt / 2 * v.x, y += dt / 2 * v.y, theta += dt / 2 * v.w;
        v.x -= dt * (n[i] + at * (n[i + 1] - n[i]));
        v.y -= dt * (g + up[i] + at * (up[i + 1] - up[i]));
        const detail::Arm r[2] = {detail::arm(block, 1, theta), detail::arm(block, -1, theta)};
        double p[2] = {0, 0}, q[2] = {0, 0};
        for (int sweep = 0; sweep < 60; ++sweep) {
          double changed = 0;
          for (const int c : {0, 1}) {
            if (y + r[c].y > 0) continue;
            const auto push = [&](double t, double up_by) {
              v.x += t, v.y += up_by, v.w += (r[c].y * t - r[c].x * up_by) / k;
              changed += std::abs(t) + std::abs(up_by);
            };
            const double lift = std::max(p[c] - (v.y - v.w * r[c].x) / (1 + r[c].x * r[c].x / k), 0.0) - p[c];
            p[c] += lift;
            push(0, lift);
            const double wish = q[c] - (v.x + v.w * r[c].y) / (1 + r[c].y * r[c].y / k);
            const double drag = std::clamp(wish, -mu * p[c], mu * p[c]) - q[c];
            q[c] += drag;
            push(drag, 0);
          }
          if (changed < 1e-15) break;
        }
        x += dt / 2 * v.x, y += dt / 2 * v.y, theta += dt / 2 * v.w;
        peak = std::max(peak, std::abs(theta));
      }
    CAPTURE(one.mu, one.factor, one.vertical);
    CHECK(peak == Approx(exact.peak).margin(test::size(1e-3, 5e-3)));
    CHECK(theta == Approx(exact.rotation.back()).margin(test::size(2e-3, 1e-2)));
    CHECK(x - std::sin(theta) == Approx(exact.residual).margin(test::size(2e-3, 1e-2)));
  }
}

TEST_CASE("rigid block: what settles and what does not") {
  RockingOptions options;
  options.settle = true;
  options.rotation = 0.2;
  const GroundMotion calm({0, 0}, 1.0);
  const RockingResponse free = integrate(RockingBlock({.width = 0.5, .height = 2, .mu = 0.8}), calm, options);
  CHECK(free.state.mode == RockingMode::rest);
  CHECK(free.rotation.back() == 0);
  CHECK(free.residual == 0);
  CHECK(free.energy.impact == Approx(free.energy.initial).epsilon(1e-12));
  options.rotation = -0.3;  // beyond atan(0.25)
  const RockingResponse falls = integrate(RockingBlock({.width = 0.5, .height = 2, .mu = 0.8}), calm, options);
  CHECK(falls.overturned == -1);
  CHECK(falls.peak == pi / 2);
  CHECK(std::abs(falls.energy.imbalance()) < 1e-12);
  options.rotation = 0.1;
  CHECK_THROWS_AS(integrate(RockingBlock({.width = 0.5, .height = 2, .restitution = 1.0}), calm, options),
                  ConvergenceError);
  CHECK_THROWS_AS(integrate(RockingBlock({.width = 0.5, .height = 2, .mu = 0.0}), calm, options), ConvergenceError);
}

TEST_CASE("rigid block: bad input") {
  const auto refused = [](const RockingBlockSize& size, const char* text) {
    CHECK_THROWS_AS(RockingBlock(size), std::invalid_argument);
    CHECK_THROWS_WITH(RockingBlock(size), ContainsSubstring(text));
  };
  refused({.width = 0, .height = 2}, "width must be positive and finite, got 0 m");
  refused({.width = 1, .height = -2}, "height must be positive and finite, got -2 m");
  refused({.width = 1, .height = 2, .mu = -0.1}, "mu must be at least 0 and finite");
  refused({.width = 1, .height = 2, .restitution = 1.2}, "restitution must be from 0 to 1");
  refused({.width = 1, .height = 2, .lever = -0.1}, "lever must be at least 0");
  refused({.width = 1, .height = 2, .restitution = 0.9, .lever = 1}, "not both");
  refused({.width = 1, .height = 2, .center = {{0.6, 1}}}, "center must be above the base");
  refused({.width = 1, .height = 2, .center = {{0, 2.5}}}, "center must be within the block");
  refused({.width = 1, .height = 2, .gyration_radius = 0}, "gyration_radius must be positive");
  RockingState state;
  CHECK_THROWS_AS(advance(RockingBlock({.width = 1, .height = 2}), {NAN, 0, 0}, state), std::invalid_argument);
}
