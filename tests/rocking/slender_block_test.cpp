// Slender blocks that rock: reference values, closed forms, balances, certificates and bad input.
#include "stickslip/rocking/slender_block.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "stickslip/base/error.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/rocking/integrate.hpp"
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
  for (int m = 0; m <= row.number("count", 400); ++m) {
    n.push_back(factor * (2 * std::sin(0.7 * m) + 1.3 * std::cos(1.9 * m + 0.4)));
    if (vertical > 0) up.push_back(vertical * 2.5 * std::cos(0.5 * m + 0.2));
  }
  const GroundMotion motion(n, row.number("dt", 0.1));
  return up.empty() ? motion : motion.with_components({}, up);
}

SlenderBlock reference_block(const Value& row) {
  return {row["p"], row["alpha"], row.number("alpha_left", row["alpha"]), row["restitution"]};
}

RockingOptions settled() {
  RockingOptions options;
  options.settle = true;
  return options;
}
RockingOptions tilted(double rotation, double rate = 0) {
  RockingOptions options = settled();
  options.rotation = rotation;
  options.rate = rate;
  return options;
}

std::vector<RockingEvent> of_kind(const RockingResponse& r, RockingEventKind kind) {
  std::vector<RockingEvent> events;
  for (const RockingEvent& event : r.events)
    if (event.kind == kind) events.push_back(event);
  return events;
}

GroundMotion still(double duration = 1) { return {{0, 0}, duration}; }

/// One sine or half of it, of an amplitude in alpha g, that first pushes to the right: then the ground stands still.
GroundMotion pulse(double amplitude, double omega, int samples, double cycles) {
  std::vector<double> n;
  for (int k = 0; k <= samples * cycles; ++k) n.push_back(-amplitude * std::sin(2 * pi * k / samples));
  n.back() = 0;
  const double dt = 2 * pi / omega / samples;
  n.insert(n.end(), 10, 0.0);
  return {n, dt};
}

}  // namespace

TEST_CASE("slender block: reference values") {
  for (const Value& row : reference::rows("rocking", "blocks")) {
    CAPTURE(row["id"].as<std::string>());
    const GroundMotion motion = reference_motion(row);
    const SlenderBlock block = reference_block(row);
    const RockingResponse r = integrate(block, motion);
    CHECK(r.overturned == row["overturned"].as<int>());
    CHECK(r.impacts == static_cast<std::size_t>(row["impacts"].as<int>()));
    CHECK(r.uplifts == static_cast<std::size_t>(row["uplifts"].as<int>()));
    // An error of the input grows by the condition of the response.
    const double alpha = row["alpha"], grown = std::max(1e-12, 30 * r.condition * 1.1e-16);
    CHECK(of_kind(r, RockingEventKind::impact).front().time == Approx(row["first_impact"]).epsilon(1e-13));
    CHECK(r.energy.impact == Approx(row["loss"]).epsilon(std::max(1e-12, grown)).margin(1e-15));
    CHECK(std::abs(r.energy.imbalance()) <= 1e-13 * std::max(1.0, r.energy.impact));
    if (!row.has("rotation")) continue;
    CHECK(std::abs(r.rotation.back() - row["rotation"]) <= grown * alpha);
    CHECK(std::abs(r.rate.back() - row["rate"]) <= 30 * grown * alpha * block.p());
    // By how much the peak moves with the scale of the motion: in one row by 1e10 times its relative change.
    constexpr double change = 1e-9;
    const double moves = std::abs(integrate(block, motion.scaled(1 + change)).peak / r.peak - 1) / change;
    const double of_peak = std::max(1e-12, 30 * moves * 1.1e-16);
    CHECK(r.peak == Approx(row["peak"]).epsilon(of_peak));
    CHECK(r.peak_time == Approx(row["peak_time"]).epsilon(of_peak));
    for (const Value& sample : row["samples"].items()) {
      const std::vector<double> both = sample.list();
      CHECK(std::abs(r.rotation[static_cast<std::size_t>(both[0])] - both[1]) <= grown * alpha);
    }
    if (row.has("time_of_rest")) {
      const RockingResponse to_rest = integrate(block, motion, settled());
      CHECK(to_rest.events.back().time == Approx(row["time_of_rest"]).epsilon(std::max(1e-9, 10 * grown)));
      CHECK(to_rest.rotation.back() == 0);
    }
  }
}

TEST_CASE("slender block: free rocking") {
  const double p = 2, alpha = 0.2, r = 0.9, phi = 0.5;
  const RockingResponse free = integrate(SlenderBlock(p, alpha, r), still(), tilted(phi * alpha));
  const std::vector<RockingEvent> impacts = of_kind(free, RockingEventKind::impact);
  double amplitude = phi, time = std::acosh(1 / (1 - phi)) / p, rest = time;
  for (std::size_t k = 0; k < 6; ++k) {
    CHECK(impacts[k].time == Approx(time).epsilon(1e-13));
    amplitude = 1 - std::sqrt(1 - std::pow(r, 2 * (static_cast<double>(k) + 1)) * (1 - (1 - phi) * (1 - phi)));
    time += 2 * std::acosh(1 / (1 - amplitude)) / p;
  }
  for (int k = 1; k < 2000; ++k) {
    const double kept = std::pow(r, 2 * k) * (1 - (1 - phi) * (1 - phi));
    const double phi_k = kept / (1 + std::sqrt(1 - kept));
    rest += 2 * std::asinh(std::sqrt(phi_k * (2 - phi_k)) / (1 - phi_k)) / p;
  }
  CHECK(free.events.back().time == Approx(rest).epsilon(1e-11));  // bounces that end within 1e-7/p are skipped
  CHECK(free.events.back().rotation == 0);
  CHECK(free.energy.impact == Approx(p * p * phi * alpha * alpha * (1 - phi / 2)).epsilon(1e-12));
  // Beyond alpha it falls, on the side to which it tilts.
  const RockingResponse falls = integrate(SlenderBlock(p, alpha, r), still(), tilted(-1.001 * alpha));
  CHECK(falls.overturned == -1);
  CHECK(falls.peak_ratio > 1e300);
  // On the manifold's two sides: q = theta' + p (theta - alpha).
  CHECK(integrate(SlenderBlock(p, alpha, r), still(), tilted(0, p * alpha * (1 + 1e-9))).overturned == 1);
  CHECK(integrate(SlenderBlock(p, alpha, r), still(), tilted(0, p * alpha * (1 - 1e-9))).overturned == 0);
}

TEST_CASE("slender block: pulses that overturn it") {
  // Outcomes of one sampled sine: safe, overturned after one impact, safe again, overturned without an impact.
  const SlenderBlock block(2, 0.2, 0.9);
  struct Outcome {
    int side;
    std::size_t impacts;
  };
  const auto outcome = [&](double amplitude) {
    const RockingResponse r = integrate(block, pulse(amplitude * 0.2 * g, 10, 40, 1), settled());
    return Outcome{r.overturned, r.overturned != 0 ? of_kind(r, RockingEventKind::impact).size() : 0};
  };
  const std::array edges{3.02479929533496626, 6.33109960422415951, 7.18286102916019098};
  const std::array<Outcome, 4> outcomes{{{0, 0}, {-1, 1}, {0, 0}, {1, 0}}};
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (const bool above : {false, true}) {
      const Outcome found = outcome(edges[i] * (1 + (above ? 1e-9 : -1e-9)));
      CHECK(found.side == outcomes[i + above].side);
      CHECK(found.impacts == outcomes[i + above].impacts);
    }
  // A half sine: sqrt(A^2 - 1) + A exp(-(pi - asin(1/A))/Omega) = Omega. Straight lines between samples err by the square
  // of their number.
  for (const auto& [omega, amplitude] :
       {std::pair(1.0, 1.322396597907876566823), {3.0, 2.293872313439291852629}, {8.0, 4.787071268349915743167}}) {
    const auto falls = [&](double a) {
      return integrate(block, pulse(a * 0.2 * g, 2 * omega, 4000, 0.5), settled()).overturned;
    };
    CHECK(falls(amplitude * (1 - 2e-6)) == 0);
    CHECK(falls(amplitude * (1 + 2e-6)) == 1);
  }
}

TEST_CASE("slender block: scaling, mirror image and parts") {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const std::vector<double> n = test::gaussian(seed, 300, 2, true);
    const SlenderBlock block(1.5 + 0.1 * static_cast<double>(seed), 0.2, 0.25, 0.85);
    const RockingResponse r = integrate(block, GroundMotion(n, 0.05));
    // Mirrored.
    std::vector<double> turned = n;
    for (double& value : turned) value = -value;
    const RockingResponse m = integrate(SlenderBlock(block.p(), 0.25, 0.2, 0.85), GroundMotion(turned, 0.05));
    CHECK(m.peak == r.peak);
    CHECK(m.overturned == -r.overturned);
    CHECK(m.rotation.back() == -r.rotation.back());
    // Angles and accelerations by 1/2; a power of two, so without rounding.
    std::vector<double> half = n;
    for (double& value : half) value /= 2;
    const RockingResponse s = integrate(SlenderBlock(block.p(), 0.1, 0.125, 0.85), GroundMotion(half, 0.05));
    CHECK(s.events.size() == r.events.size());
    if (r.overturned == 0) CHECK(2 * s.rotation[200] == Approx(r.rotation[200]).margin(1e-11));
    // Segment by segment, with each divided in three.
    RockingState state;
    for (std::size_t i = 0; i < 299 && r.overturned == 0; ++i)
      for (int part = 0; part < 3; ++part) {
        const auto at = [&](int k) { return n[i] + (n[i + 1] - n[i]) * k / 3; };
        advance(block, {0.05 / 3, at(part), at(part + 1)}, state);
      }
    if (r.overturned == 0 && r.condition < 1e4) {
      CHECK(std::abs(state.rotation - r.rotation.back()) <= 1e-11);
      CHECK((state.mode == RockingMode::rest) == (r.state.mode == RockingMode::rest));
    }
    CHECK(std::abs(r.energy.imbalance()) <= 1e-11);
  }
}

// Steps of theta' and theta, with an impact where theta changes its sign: first order, without events.
TEST_CASE("slender block: states at any time are those of a motion with more samples") {
  constexpr int parts = 8;
  const auto motion = [](int divided) {
    std::vector<double> n, up;
    for (int m = 0; m <= 60 * divided; ++m) {
      const auto at = [](int k) { return 2 * std::sin(0.7 * k) + 1.3 * std::cos(1.9 * k + 0.4); };
      const int k = m / divided;
      n.push_back(std::lerp(at(k), at(k + 1), static_cast<double>(m % divided) / divided));
      up.push_back(0.5 + 0.01 * m / divided);
    }
    return GroundMotion(n, 0.1 / divided).with_components({}, up);
  };
  const SlenderBlock block(2, 0.15, 0.9);
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

TEST_CASE("slender block: steps in time agree") {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const std::vector<double> n = test::gaussian(seed + 100, 120, 1.6, true);
    const double p = 2, alpha = 0.15, r = 0.9, dt = 0.05;
    const int parts = test::size(20000, 2000);
    const RockingResponse exact = integrate(SlenderBlock(p, alpha, r), GroundMotion(n, dt));
    if (exact.overturned != 0 || exact.condition > 50) continue;
    double theta = 0, rate = 0, peak = 0, side = 0;
    const double h = dt / parts;
    for (std::size_t i = 0; i + 1 < n.size(); ++i)
      for (int k = 0; k < parts; ++k) {
        const double load = n[i] + (n[i + 1] - n[i]) * (k + 0.5) / parts;
        if (side == 0) {
          if (std::abs(load) <= alpha * g) continue;
          side = load < 0 ? 1 : -1;
        }
        rate += h * p * p * (theta - side * alpha - load / g);
        theta += h * rate;
        if (side * theta < 0 || (theta == 0 && side * rate <= 0)) {
          if (std::abs(load) <= alpha * g && std::abs(rate) < 1e-4 * p * alpha) {
            theta = rate = side = 0;
            continue;
          }
          theta = 0;
          rate *= r;
          side = -side;
        }
        peak = std::max(peak, std::abs(theta));
      }
    CHECK(peak == Approx(exact.peak).epsilon(3e-3));
    CHECK(theta == Approx(exact.rotation.back()).margin(2e-2 * alpha));
  }
}

TEST_CASE("slender block: no certificate of overturning is false") {
  int certified = 0;
  double longest = 0;
  for (std::uint64_t seed = 0; seed < test::size(10'000U, 300U); ++seed) {
    const double scale = 1 + static_cast<double>(seed % 7) / 3, dt = seed % 2 == 0 ? 0.02 : 0.1;
    std::vector<double> n = test::gaussian(seed, 150, scale, seed % 3 != 0);
    const SlenderBlock block(2, 0.15, 0.9);
    const RockingResponse r = integrate(block, GroundMotion(n, dt));
    if (r.overturned == 0) continue;
    ++certified;
    // Without the certificate: it never comes back to the middle, and falls.
    RockingState state;
    for (std::size_t i = 0; i + 1 < n.size(); ++i) {
      const double before = state.rotation;
      advance(block, {dt, n[i], n[i + 1]}, state);
      if (static_cast<double>(i) * dt >= r.overturned_at) CHECK(before * state.rotation > 0);
    }
    CHECK(state.rotation * r.overturned > 0);
    const double q = r.overturned * state.rate + block.p() * (r.overturned * state.rotation - block.alpha());
    CHECK((q > 0 || std::abs(state.rotation) >= pi / 2));
    longest = std::max(longest, r.overturned_at);
  }
  CHECK(certified > test::size(1000, 30));
}

TEST_CASE("slender block: the derivative by the scale is that of differences") {
  // The condition is the largest derivative at a sample; the last samples are compared by differences.
  for (const double scale : {0.9, 1.2, 1.5}) {
    std::vector<double> n;
    for (int m = 0; m <= 60; ++m) n.push_back(scale * (2 * std::sin(0.7 * m) + 1.3 * std::cos(1.9 * m + 0.4)));
    const SlenderBlock block(2, 0.2, 0.9);
    const auto at = [&](double by) { return integrate(block, GroundMotion(n, 0.1).scaled(by)).rotation; };
    const double h = 1e-6;
    const std::vector<double> more = at(1 + h), less = at(1 - h);
    double largest = 0;
    for (std::size_t i = 0; i < more.size(); ++i) largest = std::max(largest, std::abs(more[i] - less[i]) / (2 * h));
    CHECK(integrate(block, GroundMotion(n, 0.1)).condition == Approx(largest / 0.2).epsilon(1e-6));
  }
}

TEST_CASE("slender block: vertical motion that does not change is a change of g") {
  const std::vector<double> n = test::gaussian(3, 200, 0.9, true);
  const double factor = 1.2;
  const GroundMotion motion =
      GroundMotion(n, 0.05).with_components({}, std::vector<double>(n.size(), (factor - 1) * g));
  std::vector<double> lighter = n;
  for (double& value : lighter) value /= factor;
  const RockingResponse heavy = integrate(SlenderBlock(2, 0.2, 0.9), motion);
  const RockingResponse same = integrate(SlenderBlock(2 * std::sqrt(factor), 0.2, 0.9), GroundMotion(lighter, 0.05));
  REQUIRE(same.overturned == 0);
  CHECK(heavy.peak == Approx(same.peak).epsilon(1e-12));
  CHECK(heavy.rotation.back() == Approx(same.rotation.back()).margin(1e-12));
}

TEST_CASE("slender block: sizes, limits and bad input") {
  const SlenderBlock cabinet = SlenderBlock::from_size(0.6, 2);
  CHECK(cabinet.alpha() == Approx(std::atan(0.3)));
  CHECK(cabinet.p() == Approx(std::sqrt(0.75 * g / std::hypot(0.3, 1))));
  CHECK(cabinet.restitution() == Approx(0.8761467889908256880734).epsilon(1e-15));
  const double level = cabinet.alpha() * g, above = 1.0001 * level, below = 0.9999 * level;
  CHECK(integrate(cabinet, GroundMotion({0, below, -below, 0}, 0.5)).uplifts == 0);
  CHECK(integrate(cabinet, GroundMotion({0, below, -below, 0}, 0.5)).margin == Approx(1e-4).epsilon(1e-6));
  CHECK(integrate(cabinet, GroundMotion({0, above, 0}, 0.5)).uplifts == 1);
  CHECK(integrate(cabinet, GroundMotion({above, above, 0}, 0.5)).events[0].time == 0);

  const auto refused = [](auto&& make, const char* text) {
    CHECK_THROWS_AS(make(), std::invalid_argument);
    CHECK_THROWS_WITH(make(), ContainsSubstring(text));
  };
  refused([] { SlenderBlock(0, 0.2, 0.9); }, "p must be positive and finite, got 0 rad/s");
  refused([] { SlenderBlock(2, -0.2, 0.9); }, "alpha must be positive and below pi/2");
  refused([] { SlenderBlock(2, 0.2, 1.1); }, "restitution must be from 0 to 1, got 1.1");
  refused([] { SlenderBlock::from_size(3, 2); }, "too squat");
  refused([] { SlenderBlock::from_size(0.6, -2); }, "height must be positive and finite, got -2 m");
  refused([&] { integrate(cabinet, still(), tilted(1.6)); }, "rotation must be below pi/2");
  refused([&] { integrate(cabinet, still(), tilted(0, NAN)); }, "rate must be finite");
  refused(
      [&] {
        integrate(cabinet, GroundMotion({0, 1, 0}, 0.1).with_components({}, std::vector<double>{0, -10, 0}));
      },
      "leaves the ground");
  CHECK_THROWS_AS(integrate(SlenderBlock(2, 0.2, 1), still(), tilted(0.1)), ConvergenceError);
  // A motion that starts later than at zero.
  CHECK(integrate(cabinet, GroundMotion({0, 0, 0}, std::vector<double>{5, 6, 7}), tilted(0.1)).peak_time == 5);
  RockingState state;
  refused([&] { advance(cabinet, {NAN, 0, 0}, state); }, "must be finite");
}

TEST_CASE("The period of a slender block is that of free rocking") {
  const SlenderBlock equal(2, 0.2, 1), leaning(2, 0.2, 0.15, 1);
  CHECK(equal.period(0.1) == Approx(4 / 2.0 * std::acosh(2)).epsilon(1e-14));
  CHECK(equal.period(0.1) == equal.period(-0.1));
  CHECK(equal.period(1e-12) == Approx(4 / 2.0 * std::sqrt(2 * 1e-12 / 0.2)).epsilon(1e-11));
  for (const double start : {0.05, -0.1}) {
    // Let go at rest, it is back there after a period.
    RockingState state = RockingState::at(start, 0);
    advance(leaning, {leaning.period(start), 0, 0}, state);
    CHECK(state.rotation == Approx(start).epsilon(1e-13));
    CHECK(std::abs(state.rate) <= 1e-13);
  }
  CHECK_THROWS_WITH(equal.period(0.2), ContainsSubstring("below alpha and not zero, got 0.2 rad"));
  CHECK_THROWS_WITH(equal.period(0), ContainsSubstring("not zero"));
  CHECK_THROWS_WITH(leaning.period(0.15), ContainsSubstring("overturns on its other side"));
}

TEST_CASE("Whole steps of a slender block are those of its legs") {
  // With a vertical motion of zero every step takes a leg; only the certificate and the margin need its absence.
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  std::size_t impacts = 0;
  for (int k = 0; k < 40; ++k) {
    std::vector<double> n(600);
    double last = 0;
    for (double& value : n) value = last = 0.9 * last + 0.6 * normal(random);
    const GroundMotion motion(n, 0.02, k % 2 == 0 ? Interpolation::linear : Interpolation::constant);
    const SlenderBlock block(2, 0.2, k % 3 == 0 ? 0.15 : 0.2, 0.85);
    const RockingResponse whole = integrate(block, motion);
    const RockingResponse legs = integrate(block, motion.with_components({}, std::vector<double>(n.size())));
    impacts += whole.impacts;
    for (std::size_t i = 0; i < n.size(); ++i)
      if (whole.overturned == 0 || motion.time(i) <= whole.overturned_at) {
        // The same bits, but where the compiler contracts products and sums; that grows with the condition.
        const double room = 1e-13 * block.alpha() * (1 + whole.condition);
        REQUIRE(std::abs(whole.rotation[i] - legs.rotation[i]) <= room);
        REQUIRE(std::abs(whole.rate[i] - legs.rate[i]) <= 10 * room);
      }
    if (whole.overturned != 0) {
      // On its side, if the record is long enough for the fall.
      CHECK(std::abs(whole.rotation.back()) <= pi / 2);
      if (motion.time(n.size() - 1) > whole.overturned_at + 5) CHECK(std::abs(whole.rotation.back()) == pi / 2);
      continue;
    }
    const double grown = 1e-13 * (1 + whole.condition);
    CHECK(std::abs(whole.peak - legs.peak) <= grown * block.alpha());
    CHECK(whole.peak_time == Approx(legs.peak_time).epsilon(grown));
    CHECK(whole.impacts == legs.impacts);
    CHECK(whole.condition == Approx(legs.condition).epsilon(1000 * grown));
    CHECK(whole.energy.input == Approx(legs.energy.input).epsilon(10 * grown));
    CHECK(whole.time_rocking == Approx(legs.time_rocking).epsilon(10 * grown));
  }
  CHECK(impacts > 500);
}
