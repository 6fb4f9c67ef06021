// Coulomb friction: a block with one slip level, or one for each direction.
#include <numbers>
#include <tuple>
#include <utility>

#include "support/catch.hpp"
#include "support/long_double_slider.hpp"
#include "support/motions.hpp"
#include "support/outcome.hpp"
#include "support/reference.hpp"

using namespace stickslip;
using namespace test;

namespace {

// 100,000 segments, a few roundings of x each, of either sign: sqrt(4e5) * 1.1e-16 = 7e-14 of the scale of x; friction
// forgets errors of the velocity. Rounding that always goes one way is what the rest of the 1e-12 allows for.
constexpr double long_run = 1e-12;
constexpr std::size_t long_samples = 100'001;

void agrees_with_long_double(double backward, double natural_frequency, const GroundMotion& motion) {
  const Response response = integrate(Slider(Coulomb(1, backward), natural_frequency), motion);
  LongDoubleSlider second(1, backward, natural_frequency);
  double worst = 0, worst_velocity = 0;
  for (std::size_t i = 0; i < motion.segments(); ++i) {
    const Segment segment = motion.segment(i);
    second.advance(segment.duration, segment.start, segment.end);
    worst = std::max(worst, std::abs(response.displacement[i + 1] - static_cast<double>(second.displacement)));
    worst_velocity =
        std::max(worst_velocity, std::abs(response.velocity[i + 1] - static_cast<double>(second.velocity)));
  }
  INFO("backward " << backward << ", natural frequency " << natural_frequency);
  CHECK(worst <= long_run * response.peak);
  CHECK(worst_velocity <= long_run * largest(response.velocity));
  CHECK(std::abs(response.peak - static_cast<double>(second.peak)) <= long_run * response.peak);
  CHECK(std::abs(response.energy.dissipated - static_cast<double>(second.dissipated)) <=
        long_run * response.energy.dissipated);
  CHECK(count(response.events) == Counts{second.breakaways, second.arrests, second.reversals});
}

}  // namespace

TEST_CASE("a block under record A moves as 50 digits say, in all eight forms", "[coulomb]") {
  // 400 segments, a few roundings each of at most 1.1e-16 of the scale, friction forgetting those of the velocity:
  // below 400 * 2 * 1.1e-16 = 9e-14 even if all went one way.
  for (const auto& run : reference::rows("sliders", "coulomb")) {
    INFO(run["id"].as<std::string>());
    const bool linear = run["interpolation"].as<std::string>() == "linear";
    const Response r = integrate(Slider(Coulomb(1, run["backward"]), run["natural_frequency"]),
                                 record_a(linear ? Interpolation::linear : Interpolation::constant));
    const double x = 1e-13 * run["peak"], v = 1e-13 * largest(r.velocity);
    CHECK(std::abs(r.residual - run["displacement"]) <= x);
    CHECK(std::abs(r.state.velocity - run["velocity"]) <= v);
    CHECK(std::abs(r.peak - run["peak"]) <= x);
    CHECK(std::abs(r.energy.dissipated - run["dissipated"]) <= 1e-13 * run["dissipated"]);
    CHECK(count(r.events) == Counts{run["breakaways"].as<int>(), run["arrests"].as<int>(), run["reversals"].as<int>()});
    check_samples(r, run, x, v);
  }
}

TEST_CASE("100,000 pieces of random ground slide a block as long doubles and bisection say", "[coulomb]") {
  const auto [backward, natural_frequency] =
      GENERATE(std::pair{1.0, 0.0}, std::pair{1.6, 0.0}, std::pair{infinity, 0.0}, std::pair{1.0, 1.3},
               std::pair{1.6, 9.0}, std::pair{infinity, 0.2});
  agrees_with_long_double(backward, natural_frequency, broadband(1, long_samples));
}

TEST_CASE("other random grounds, smoothed or held, slide it so too", "[coulomb]") {
  for (const double natural_frequency : {0.0, 2.0}) {
    agrees_with_long_double(1, natural_frequency, broadband(2, long_samples / 4, true));
    agrees_with_long_double(1, natural_frequency, broadband(3, long_samples / 4, false, Interpolation::constant));
    agrees_with_long_double(1.6, natural_frequency, broadband(4, long_samples / 4, true, Interpolation::constant));
    agrees_with_long_double(infinity, natural_frequency, broadband(5, long_samples / 4, true));
  }
}

TEST_CASE("what friction takes is the slip level times the way slid", "[coulomb]") {
  const Response r = integrate(Coulomb(1.7), broadband(6, 10'000));
  CHECK(std::abs(r.energy.dissipated - 1.7 * r.sliding_distance) <= 1e-13 * r.energy.dissipated);
}

TEST_CASE("mirrored ground moves a block with mirrored levels in mirror image, to the last bit", "[coulomb]") {
  for (const double natural_frequency : {0.0, 1.3})
    for (const double backward : {1.0, 1.6}) {
      const GroundMotion motion = broadband(7, 5'000);
      const Response one = integrate(Slider(Coulomb(1, backward), natural_frequency), motion);
      const Response other = integrate(Slider(Coulomb(backward, 1), natural_frequency), motion.scaled(-1));
      bool mirrored = one.events.size() == other.events.size();
      for (std::size_t i = 0; i < motion.samples(); ++i)
        mirrored = mirrored && one.displacement[i] == -other.displacement[i] && one.velocity[i] == -other.velocity[i];
      for (std::size_t i = 0; mirrored && i < one.events.size(); ++i)
        mirrored = one.events[i].time == other.events[i].time && one.events[i].kind == other.events[i].kind &&
                   one.events[i].displacement == -other.events[i].displacement;
      CHECK(mirrored);
      CHECK(one.energy.input == other.energy.input);
      CHECK(one.energy.dissipated == other.energy.dissipated);
    }
}

TEST_CASE("a block with two equal levels is a block with one, to the last bit", "[coulomb]") {
  const GroundMotion motion = broadband(8, 5'000);
  const Response one = integrate(Coulomb(1.3), motion), two = integrate(Coulomb(1.3, 1.3), motion);
  CHECK(one.displacement == two.displacement);
  CHECK(one.velocity == two.velocity);
}

TEST_CASE("a level backward that is never reached might as well be infinite", "[coulomb]") {
  const GroundMotion motion = broadband(9, 5'000);
  const Response high = integrate(Coulomb(1, 1e3), motion), infinite = integrate(Coulomb(1, infinity), motion);
  CHECK(high.displacement == infinite.displacement);
  CHECK(high.velocity == infinite.velocity);
  CHECK(largest(infinite.velocity) > 0);
  CHECK(std::ranges::all_of(infinite.velocity, [](double v) { return v >= 0; }));
}

TEST_CASE("Newmark's block on a rectangular pulse slides V^2 / 2N (1 - N/A)", "[coulomb]") {
  // Newmark, Effects of earthquakes on dams and embankments, Geotechnique 15(2), 1965: ground at A for V/A; the block
  // follows at most at N. Their velocities part by (A - N) V/A, then meet again at V/N: the area between them.
  for (const auto& [pulse, yield, lasting] : {std::tuple{5.0, 1.0, 0.3}, {2.0, 1.9, 1.0}, {9.81, 0.01, 0.25}}) {
    const double speed = pulse * lasting;
    const GroundMotion motion({-pulse, 0, 0}, {0, lasting, 2 * speed / yield}, Interpolation::constant);
    const Response r = integrate(Coulomb(yield, infinity), motion);
    const double way = speed * speed / (2 * yield) * (1 - yield / pulse);
    CHECK(std::abs(r.residual - way) <= 1e-15 * speed * speed / (2 * yield) * 4);
    CHECK(r.peak == r.residual);
    REQUIRE(r.events.size() == 3);
    CHECK(r.events[1].kind == EventKind::arrest);
    CHECK(std::abs(r.events[1].time - speed / yield) <= 1e-15 * speed / yield * 4);
  }
}

TEST_CASE("a pulse of ground acceleration moves a block as thesis (5.7), (5.8) and (5.32) say", "[coulomb][pulse]") {
  // b for dt, then -b for dt. x' is piecewise linear, so that trapezoids give x exactly.
  for (const double b : {1.0 + 0x1p-20, 1.5, 2.0, 10.0, -10.0, -3.0, 1e6})
    for (const double dt : {1.0, 0.3}) {
      const double a = 1, m = std::abs(b), sgn = b > 0 ? 1 : -1;
      const double turn = 2 * dt * (m / (m + a)), rest = 2 * turn;
      const auto velocity = [&](double t) {  // (5.7)
        if (t <= dt) return -(m - a) * sgn * t;
        if (t <= turn) return (-(m - a) * dt + (m + a) * (t - dt)) * sgn;
        if (t <= 2 * dt) return (m - a) * (t - turn) * sgn;
        if (t <= rest) return (2 * dt * (m - a) * (a / (m + a)) - a * (t - 2 * dt)) * sgn;
        return 0.0;
      };
      std::vector<double> times;
      for (int i = 0; i <= 40; ++i) times.push_back(i * dt / 10);
      times.insert(times.end(), {turn, rest, 4.5 * dt});
      std::ranges::sort(times);
      times.erase(std::unique(times.begin(), times.end()), times.end());
      std::vector<double> n;
      for (const double t : times) n.push_back(t < dt ? b : t < 2 * dt ? -b : 0);
      const Response r = integrate(Coulomb(a), GroundMotion(n, times, Interpolation::constant));

      double x = 0, squared = 0;
      const double x_scale = m * dt * dt, v_scale = m * dt;
      for (std::size_t i = 0; i + 1 < times.size(); ++i) {
        const double v = velocity(times[i]), v1 = velocity(times[i + 1]), step = times[i + 1] - times[i];
        x += (v + v1) / 2 * step;
        squared += (v * v + v * v1 + v1 * v1) / 3 * step;
        // some 45 pieces, whose ends round by 1e-16 of 4 dt: 1e-14 of the scale
        CHECK(std::abs(r.displacement[i + 1] - x) <= 1e-14 * x_scale);
        CHECK(std::abs(r.velocity[i + 1] - v1) <= 1e-14 * v_scale);
      }
      const double beta = m / a;
      const double offset = -a * dt * dt * sgn * ((beta - 1) * beta / (beta + 1) * (1 - 2 / (beta + 1)));  // (5.8)
      const double area = 2 * a * a * dt * dt * dt * (beta - 1) * (beta - 1) * beta / (3 * (beta + 1)) *
                          (1 + 4 / ((beta + 1) * (beta + 1)));  // (5.32)
      CHECK(std::abs(r.residual - offset) <= 1e-14 * x_scale);
      CHECK(std::abs(squared - area) <= 1e-13 * area + 1e-14 * v_scale * v_scale * dt);
      CHECK(r.state.mode == Mode::stuck);
      CHECK(count(r.events) == Counts{1, 1, 1});
    }
}

TEST_CASE("a pulse of ten slip levels gives the reference's numbers", "[coulomb][pulse]") {
  // values.json pulse.coulomb.b10: thesis (5.7), (5.8), (5.32) with a = dt = 1, b = 10, against mpmath quadrature to
  // 1e-41.
  const Response r = integrate(Coulomb(1), steps({10, -10, 0, 0, 0}));
  CHECK(std::abs(r.velocity[1] + 9.0) <= 1e-15 * 9 * 4);
  CHECK(std::abs(r.velocity[2] - 1.636363636363636363636364) <= 1e-15 * 9 * 4);
  CHECK(std::abs(r.residual + 6.694214876033057851239669) <= 1e-15 * 9 * 4);
  CHECK(std::abs(r.peak - 8.181818181818181818181818) <= 1e-15 * 9 * 4);
  REQUIRE(r.events.size() == 4);
  CHECK(std::abs(r.events[1].time - 1.818181818181818181818182) <= 1e-15 * 4);
  CHECK(std::abs(r.events[2].time - 3.636363636363636363636364) <= 1e-15 * 4);
}

TEST_CASE("without friction a block stands still while the ground moves under it", "[coulomb]") {
  // x + ground displacement stays 0: both are cubics between the samples of a broken line.
  const GroundMotion motion = broadband(10, 1'000);
  const Response r = integrate(Coulomb(0), motion);
  long double ground = 0, ground_velocity = 0;
  double worst = 0;
  for (std::size_t i = 0; i < motion.segments(); ++i) {
    const auto [duration, start, end] = motion.segment(i);
    const long double h = duration;
    ground += h * ground_velocity + h * h * (2 * static_cast<long double>(start) + end) / 6;
    ground_velocity += h * (static_cast<long double>(start) + end) / 2;
    worst = std::max(worst, static_cast<double>(std::abs(r.displacement[i + 1] + ground)));
  }
  // Here nothing forgets the velocity's roundings, of 1.1e-16 each: over 1000 segments they sum up in x to at most
  // 1000^2 / 2 * 0.1 s * 2e-16 * speed.
  CHECK(worst <= 1e-11 * largest(r.velocity));
  CHECK(r.energy.dissipated == 0);
}

TEST_CASE("without friction and without ground motion nothing begins to move", "[coulomb]") {
  const Response r = integrate(Coulomb(0), line(0, 0, 10));
  CHECK(r.peak == 0);
  CHECK(count(r.events) == Counts{});
}

TEST_CASE("without friction a block on a spring swings for ever", "[coulomb]") {
  const double period = 2 * std::numbers::pi;
  const Response r = integrate(Slider(Coulomb(0), 1), steps({0, 0, 0, 0}, period / 4), from(1));
  CHECK(std::abs(r.displacement[1]) <= 1e-15);
  CHECK(std::abs(r.displacement[2] + 1) <= 1e-15);
  CHECK(std::abs(r.displacement[4] - 1) <= 1e-15);
  CHECK(std::abs(r.sliding_distance - 4) <= 1e-14);
}

TEST_CASE("a coefficient of friction is a level over g", "[coulomb]") {
  CHECK(Coulomb::from_friction(0.5).forward() == 0.5 * 9.80665);
}

TEST_CASE("Coulomb names the arguments that it rejects", "[coulomb][errors]") {
  CHECK_THROWS_WITH(Coulomb(-1), "Coulomb: slip_level must be finite and at least 0, got -1 m/s^2");
  CHECK_THROWS_WITH(Coulomb(not_a_number), "Coulomb: slip_level must be finite and at least 0, got nan m/s^2");
  CHECK_THROWS_WITH(Coulomb(infinity), "Coulomb: slip_level must be finite and at least 0, got inf m/s^2");
  CHECK_THROWS_WITH(Coulomb(1, -0.5), "Coulomb: backward must be at least 0, got -0.5 m/s^2");
  CHECK_THROWS_WITH(Coulomb(1, not_a_number), "Coulomb: backward must be at least 0, got nan m/s^2");
  CHECK_THROWS_WITH(Coulomb::from_friction(-0.1), "Coulomb: mu must be finite and at least 0, got -0.1");
  CHECK_THROWS_AS(Coulomb(-1), std::invalid_argument);
}
