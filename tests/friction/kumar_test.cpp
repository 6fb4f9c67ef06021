// Friction that depends on pressure, speed and temperature: the heat, limits, scaling, and an independent integration.
#include "stickslip/friction/kumar.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

#include "stickslip/core.hpp"
#include "stickslip/sliding/floor_motion.hpp"
#include "stickslip/sliding/forces.hpp"
#include "stickslip/sliding/margins.hpp"
#include "support/catch.hpp"
#include "support/heated_surface.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;

static_assert(HeatedLaw<KumarFriction> && MemoryLaw<KumarFriction> && !MemorylessLaw<KumarFriction>);
static_assert(form_of<KumarFriction::Now> == Form::numeric && !HeatedLaw<Degrading>);

namespace {

using Parameters = KumarFriction::Parameters;

const Parameters usual{.mu_ref = 0.06, .static_pressure = 50e6, .reference_pressure = 50e6, .contact_radius = 0.2};

Parameters with_radius(double radius) {
  Parameters p = usual;
  p.contact_radius = radius;
  return p;
}

/// H of heat t^k that lasts for t.
double exact_half_integral(int k, double t) {
  return std::pow(t, k + 0.5) * std::tgamma(k + 1.0) * std::tgamma(0.5) / std::tgamma(k + 1.5);
}

GroundMotion shaking(bool vertical = false) {
  std::vector<double> n, up;
  for (int m = 0; m <= 1500; ++m) {
    n.push_back(3 * std::sin(0.07 * m) + 2 * std::cos(0.19 * m + 0.4));
    up.push_back(2.5 * std::cos(0.05 * m + 0.2));
  }
  const GroundMotion motion(n, 0.01);
  return vertical ? motion.with_components({}, up) : motion;
}

GroundMotion motion_part(const GroundMotion& motion, std::ptrdiff_t from, std::ptrdiff_t to) {
  const auto part = [&](std::span<const double> all) {
    return all.empty() ? std::vector<double>() : std::vector<double>(all.begin() + from, all.begin() + to + 1);
  };
  return GroundMotion(part(motion.acceleration()), motion.dt()).with_components({}, part(motion.vertical()));
}

/// Where a slip from x at a speed stops without a load, by Heun's rule with even steps; the heat is straight between
/// steps, and its half-integral exact for that.
double independent_stop(const Parameters& p, double x, double v, double h) {
  const double edge = p.contact_radius * std::sqrt(std::acos(-1.0) / 4);
  std::vector<double> q;
  const auto mu = [&](double speed, double t) { return coefficient(p, speed, t); };
  const auto heat = [&](double at, double speed, double t) {
    return std::abs(at) < edge ? mu(speed, t) * p.static_pressure * speed : 0;
  };
  double t = p.temperature;
  q.push_back(heat(x, v, t));
  for (;;) {
    const double a = standard_gravity * mu(v, t);
    std::vector<double> next = q;
    double end_v = v - h * a, end_x = x + h * (v + end_v) / 2, end_t = t;
    for (int sweep = 0; sweep < 3; ++sweep) {
      next.resize(q.size());
      next.push_back(heat(end_x, std::max(end_v, 0.0), end_t));
      end_t = celsius(p, next, h);
      end_v = v - h * (a + standard_gravity * mu(std::max(end_v, 0.0), end_t)) / 2;
      end_x = x + h * (v + end_v) / 2;
    }
    if (end_v <= 0) return x + v * v / (2 * a);
    x = end_x, v = end_v, t = end_t;
    q = next;
  }
}

}  // namespace

TEST_CASE("the surface's heat is the half-integral of what was made", "[kumar]") {
  for (const double time : {1e-6, 1e-4, 1e-2, 1.0, 30.0, 500.0})
    for (int k = 0; k <= 8; ++k) {
      if (k > 1 && time < 1e-5) break;  // most of it lasts for less than 1 us
      std::array<double, 9> q{};
      q[static_cast<std::size_t>(k)] = 1;
      SurfaceHeat heat;
      CHECK(!heat.warm());
      heat.heat(q, SurfaceHeat::Step(time));
      const double exact = exact_half_integral(k, time) / std::pow(time, k);
      CHECK(std::abs(heat.half_integral() / exact - 1) <= 6e-7);

      SurfaceHeat in_parts;
      std::array<double, 9> rest{};  // (0.3 + 0.7 s)^k
      for (int j = 0; j <= k; ++j)
        rest[static_cast<std::size_t>(j)] = std::tgamma(k + 1.0) / (std::tgamma(j + 1.0) * std::tgamma(k - j + 1.0)) *
                                            std::pow(0.7, j) * std::pow(0.3, k - j);
      in_parts.heat(q, SurfaceHeat::Step(0.3 * time), 0.3);
      in_parts.heat(rest, SurfaceHeat::Step(0.7 * time));
      CHECK(std::abs(in_parts.half_integral() / heat.half_integral() - 1) <= 1e-12);
    }
  // It cools as heat that was made earlier.
  for (const double time : {0.01, 1.0, 100.0}) {
    SurfaceHeat heat;
    heat.heat({1}, SurfaceHeat::Step(time));
    heat.rest(time);
    CHECK(std::abs(heat.half_integral() - 2 * (std::sqrt(2 * time) - std::sqrt(time))) <= 6e-7 * 2 * std::sqrt(time));
    CHECK(std::abs(SurfaceHeat::with(heat.half_integral()).half_integral() / heat.half_integral() - 1) <= 1e-14);
  }
}

TEST_CASE("a slip under heating is that of an independent integration", "[kumar]") {
  for (const double radius : {infinity, 0.3}) {
    const Parameters p = with_radius(radius);
    const KumarFriction law(p);
    State state = State::at(-0.5, 1);
    advance(Slider(law), Segment{10, 0, 0}, state);
    REQUIRE(state.mode == Mode::stuck);
    double before = 0;
    for (const double h : {4e-3, 2e-3, 1e-3}) {
      const double stop = independent_stop(p, -0.5, 1, h);
      const double error = std::abs(stop - state.displacement);
      // Of second order but for the start, where the temperature is a root of time; of first where heat jumps.
      if (before > 0 && radius > 1) CHECK(before / error >= 2.2);
      if (h < 1.5e-3) CHECK(error <= (radius > 1 ? 2e-5 : 6e-4));
      before = error;
    }
    // Hotter by some tens of degrees, and further than a cold slider by a fifth: what the test would miss otherwise.
    Parameters cold = p;
    cold.conductivity = infinity;
    State other = State::at(-0.5, 1);
    advance(Slider(KumarFriction(cold)), Segment{10, 0, 0}, other);
    CHECK(state.displacement - other.displacement > 0.1);
  }
}

TEST_CASE("without heat it is friction that depends on the speed", "[kumar]") {
  Parameters p = usual;
  p.conductivity = infinity;
  p.temperature = 35;
  p.static_pressure = 40e6;
  const double fast = standard_gravity * 0.06 * std::pow(0.7, 0.02 * -10) * 0.79 * (std::pow(0.7, 0.7) + 0.4);
  for (const double frequency : {0.0, 2.0}) {
    const Response one = integrate(Slider(KumarFriction(p), frequency), shaking());
    const Response other = integrate(Slider(VelocityDependent(fast / 2, fast, 100), frequency), shaking());
    CHECK(std::abs(one.peak - other.peak) <= 1e-7 * other.peak);
    CHECK(one.events.size() == other.events.size());
    CHECK(*std::max_element(one.temperature.begin(), one.temperature.end()) == 35);
  }
}

TEST_CASE("energy, mirror image and halves of a heated motion", "[kumar]") {
  for (const double radius : {0.2, 0.05, infinity})
    for (const bool vertical : {false, true})
      for (const bool pendulum : {false, true}) {
        const KumarFriction law(with_radius(radius));
        const auto slider = pendulum ? Slider<KumarFriction>::friction_pendulum(law, 2.2) : Slider(law);
        const GroundMotion motion = shaking(vertical);
        const Response r = integrate(slider, motion);
        CHECK(std::abs(r.energy.imbalance()) <= 1e-12 * r.energy.input);
        CHECK(r.temperature.size() == r.displacement.size());
        CHECK(r.temperature.front() == 20);
        CHECK(r.temperature.back() == Approx(law.temperature(r.state)).epsilon(1e-14));

        const Response mirrored = integrate(slider, motion.scaled(-1));
        CHECK(mirrored.residual == -r.residual);
        CHECK(mirrored.temperature == r.temperature);

        // In two halves, from the state at the end of the first: steps may differ, to the accuracy of the flows.
        State state = State::at(0, 0);
        const detail::LoadPieces pieces(motion, 0);
        for (std::size_t i = 0; i < motion.segments(); ++i) advance(slider, pieces.segment(i), state);
        CHECK(std::abs(state.displacement - r.residual) <= 1e-8 * r.peak);
        const GroundMotion first = motion_part(motion, 0, 700), second = motion_part(motion, 700, 1500);
        const Response a = integrate(slider, first);
        const Response b = integrate(slider, second,
                                     {.displacement = a.residual, .velocity = a.velocity.back(), .heat = a.state.heat});
        CHECK(std::abs(b.residual - r.residual) <= 1e-8 * r.peak);
        CHECK(std::abs(b.temperature.back() - r.temperature.back()) <= 1e-5);
      }
}

TEST_CASE("under a constant normal force it is a slider of that weight", "[kumar]") {
  // Friction is w mu, heat w mu p, and both with the pressure w p: the same as w mu_ref, and a conductivity of w k.
  const GroundMotion level = shaking();
  for (const double w : {0.6, 1.5}) {
    const std::vector<double> up(level.samples(), (w - 1) * standard_gravity);
    Parameters p = usual;
    const Response one = integrate(KumarFriction(p), level.with_components({}, up));
    p.mu_ref *= w;
    p.static_pressure *= w;
    p.conductivity *= w;
    const Response other = integrate(KumarFriction(p), level);
    CHECK(std::abs(one.residual - other.residual) <= 1e-8 * other.peak);
    CHECK(std::abs(one.temperature.back() - other.temperature.back()) <= 1e-5);
  }
}

TEST_CASE("at rest the surface cools, and holds more", "[kumar]") {
  const KumarFriction law(with_radius(infinity));
  const Slider slider(law);
  State hot = State::at(0, 1);
  advance(slider, Segment{10, 0, 0}, hot);
  REQUIRE(hot.mode == Mode::stuck);
  State state = hot;
  // A load that grows through the level within 2 s, which meanwhile rises by some percent.
  struct Watch {
    double time = -1;
    void slide(const stickslip::Slip&) const {}
    void event(EventKind kind, double when, const State&) {
      if (kind == EventKind::breakaway && time < 0) time = when;
    }
  } watch;
  advance(slider, Segment{2, 0, -0.4}, state, watch);
  REQUIRE(watch.time > 0);
  State then = hot;
  then.heat.rest(watch.time);
  const double level = law.level(0, 1, then.heat.half_integral());
  CHECK(std::abs(0.2 * watch.time - level) <= 1e-9);
  CHECK(level > 1.01 * law.level(0, 1, hot.heat.half_integral()));
  // No load: it only cools.
  State cooled = hot;
  advance(slider, Segment{5, 0, 0}, cooled);
  then = hot;
  then.heat.rest(5);
  CHECK(cooled.displacement == hot.displacement);
  CHECK(std::abs(cooled.heat.half_integral() / then.heat.half_integral() - 1) <= 1e-13);
}

TEST_CASE("quantities computed from a heated response", "[kumar]") {
  const KumarFriction law(usual);
  const auto slider = Slider<KumarFriction>::friction_pendulum(law, 2.2);
  const GroundMotion motion = shaking(true);
  const Response r = integrate(slider, motion);
  const Forces f = forces(slider, motion, r);
  for (std::size_t i = 0; i < r.displacement.size(); i += 7)
    if (!f.stuck[i] && std::abs(r.velocity[i]) > 1e-6) {
      const double weight = f.normal[i] / standard_gravity;
      const double level = law.level(std::abs(r.velocity[i]), weight, law.half_integral_at(r.temperature[i]));
      CHECK(std::abs(f.friction[i]) == Approx(weight * level).epsilon(1e-12));
    }
  const Margins m = margins(slider, motion, r);
  CHECK(m.load > 0);
  CHECK(m.load < infinity);
  const GroundMotion level = shaking();
  const Slider plain(law, 2);
  const Response settled = integrate(plain, level, {.settle = true});
  CHECK(settled.temperature.size() == settled.displacement.size());
  // The absolute acceleration integrates to the velocity of the mass, to the temperature's straight lines.
  double gained = 0, ground = 0;
  for (std::size_t i = 0; i + 1 < level.samples(); ++i)
    ground += 0.01 * (level.acceleration()[i] + level.acceleration()[i + 1]) / 2;
  for (const Segment& s : floor_motion(plain, level, settled).segments) gained += s.duration * (s.start + s.end) / 2;
  CHECK(std::abs(gained - ground) <= 1e-3);
}

TEST_CASE("a level that vanishes with the weight at the end of a segment is left by nothing", "[kumar]") {
  const GroundMotion falling =
      GroundMotion({0, 0, 0, 0, 3, 0}, 0.02).with_components({}, std::vector<double>{0, 0, -15, 0, 0, 0});
  for (const double mu : {0.05, 0.06}) {
    Parameters p = usual;
    p.mu_ref = mu;
    CHECK(integrate(Slider(KumarFriction(p), 2.0), falling).events.size() <= 10);
  }
  SurfaceHeat::Modes modes{};
  modes[3] = not_a_number;
  CHECK_THROWS_WITH(SurfaceHeat(modes), Catch::Matchers::ContainsSubstring("modes must be finite"));
}

TEST_CASE("bad parameters of KumarFriction are named", "[kumar]") {
  const auto refuses = [](auto change, const char* message) {
    Parameters p = usual;
    change(p);
    REQUIRE_THROWS_WITH(KumarFriction(p), Catch::Matchers::ContainsSubstring(message));
  };
  refuses([](Parameters& p) { p.mu_ref = -0.1; }, "mu_ref must be from 0 to 1e+300, got -0.1");
  refuses([](Parameters& p) { p.static_pressure = 0; }, "static_pressure must be positive");
  refuses([](Parameters& p) { p.static_pressure = 2e9; }, "pressures are in Pa");
  refuses([](Parameters& p) { p.reference_pressure = not_a_number; }, "reference_pressure must be positive");
  refuses([](Parameters& p) { p.contact_radius = 0; }, "contact_radius must be positive");
  refuses([](Parameters& p) { p.temperature = 500; }, "temperature must be from -100 to 400");
  refuses([](Parameters& p) { p.rate = -1; }, "rate must be finite");
  refuses([](Parameters& p) { p.diffusivity = infinity; }, "diffusivity must be positive");
  refuses([](Parameters& p) { p.conductivity = 0; }, "conductivity must be positive");
}
