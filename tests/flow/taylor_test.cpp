// The Taylor flow, and the first root of its speed.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;

namespace {

// Coefficients of the product of (1 - t / root) and of (1 - 2 c t + t^2 (c^2 + s^2)), whose roots are not real.
std::vector<double> polynomial(const std::vector<double>& roots,
                               const std::vector<std::pair<double, double>>& pairs = {}) {
  std::vector<long double> w{1};
  const auto times = [&](const std::vector<long double>& factor) {
    std::vector<long double> product(w.size() + factor.size() - 1);
    for (std::size_t i = 0; i < w.size(); ++i)
      for (std::size_t k = 0; k < factor.size(); ++k) product[i + k] += w[i] * factor[k];
    w = product;
  };
  for (const long double root : roots) times({1, -1 / root});
  for (const auto& [c, s] : pairs)
    times({1, -2 * c, static_cast<long double>(c) * c + static_cast<long double>(s) * s});
  return {w.begin(), w.end()};
}

double first_root_of(const std::vector<double>& w) {
  return FirstRoot(w.data(), static_cast<int>(w.size()) - 1).find();
}

}  // namespace

TEST_CASE("the first of single roots is found to round-off", "[taylor]") {
  CHECK(first_root_of({1}) == never);
  CHECK(first_root_of({1, 1}) == never);
  CHECK(first_root_of({1, -0.5}) == never);
  CHECK(std::abs(first_root_of({1, -1}) - 1) <= 1e-15);
  CHECK(first_root_of({1, -2}) == 0.5);
  CHECK(std::abs(first_root_of({1, -1e9}) - 1e-9) <= 1e-24);
  CHECK(std::abs(first_root_of(polynomial({0.3, 0.4, 0.9})) - 0.3) <= 1e-14);
  CHECK(std::abs(first_root_of(polynomial({1.5, 0.7, -3, 0.8, 2})) - 0.7) <= 1e-13);
  CHECK(std::abs(first_root_of(polynomial({0.999, 1.001})) - 0.999) <= 1e-12);
  CHECK(std::abs(first_root_of(polynomial({1e-6, 0.5, 0.6})) - 1e-6) <= 1e-20);
  CHECK(first_root_of(polynomial({1.01, 1.02, -0.5})) == never);
}

TEST_CASE("two roots close by are told from one, and from none", "[taylor]") {
  for (const double gap : {0.1, 1e-3, 1e-5}) {
    CHECK(std::abs(first_root_of(polynomial({0.4, 0.4 + gap})) - 0.4) <= 1e-15 / gap);
    CHECK(first_root_of(polynomial({}, {{1 / 0.4, gap}})) == never);
  }
}

TEST_CASE("a speed that touches zero and rises again does not stop", "[taylor]") {
  // (1 - 2t)^2 in exact numbers: a graze. Seen or not, nothing hangs.
  CHECK(first_root_of({1, -4, 4}) == never);
  // Roots that rounding can not part: either answer is right to its square root.
  const double root = first_root_of(polynomial({0.3, 0.3}));
  CHECK((root == never || std::abs(root - 0.3) <= 1e-7));
}

TEST_CASE("a speed that touches zero and then falls through it is caught there", "[taylor]") {
  // A triple root moves by the cube root of a rounding.
  for (const double r : {0.5, 0.3, 0.71}) CHECK(std::abs(first_root_of(polynomial({r, r, r})) - r) <= 1e-5);
}

TEST_CASE("the first root of random polynomials is where long doubles see the first change of sign", "[taylor]") {
  std::mt19937_64 bits(14);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 3000; ++i) {
    const auto degree = static_cast<std::size_t>(1 + i % 29);
    std::vector<double> w{std::abs(normal(bits))};
    for (std::size_t k = 1; k <= degree; ++k)
      w.push_back(normal(bits) * (i % 3 == 0 ? 1 : 1.0 / static_cast<double>(k)));
    const auto value = [&](long double t) {
      long double sum = 0;
      for (std::size_t k = w.size(); k-- > 0;) sum = sum * t + w[k];
      return sum;
    };
    double size = 0;
    for (const double c : w) size += std::abs(c);
    const double root = first_root_of(w);
    const double until = std::min(root, 1.0);
    bool positive = true;
    for (int s = 1; s < 400; ++s)
      positive = positive && value(static_cast<long double>(until) * s / 400) > -1e-13 * size;
    INFO("case " << i << ", root " << root);
    CHECK(positive);
    if (root < never) {
      CHECK(std::abs(value(root)) <= 1e-15 * size * static_cast<double>(degree + 1));
      CHECK((root > 0 && root <= 1));
    } else {
      CHECK(value(1) > -1e-15 * size);
    }
  }
}

TEST_CASE("a constant law in disguise flows as the closed forms say", "[taylor]") {
  std::mt19937_64 bits(15);
  std::normal_distribution<double> normal;
  for (const double natural_frequency : {0.0, 0.5, 1.3, 20.0}) {
    const Slider slider(Disguised{1}, natural_frequency);
    for (int i = 0; i < 300; ++i) {
      const double duration = 0.1 * (1 + i % 5);
      const Start start{std::abs(normal(bits)), i % 3 == 0 ? 0 : normal(bits), 10 * normal(bits) * duration};
      const TaylorFlow<Disguised> taylor(slider, Direction::forward, normal(bits), start, duration);
      const auto agree = [&](const auto& closed) {
        const double horizon = taylor.horizon();
        REQUIRE((horizon > 0 && horizon <= duration));
        const double speed =
            start.speed + std::abs(start.acceleration) * duration + std::abs(start.gain) * duration / 2;
        for (const double part : {0.1, 0.5, 0.9, 1.0}) {
          const Progress t = taylor.at(part * horizon), c = closed.at(part * horizon);
          CHECK(std::abs(t.distance - c.distance) <= 1e-14 * speed * duration);
          CHECK(std::abs(t.speed - c.speed) <= 1e-14 * speed);
          CHECK(std::abs(t.mean_distance - c.mean_distance) <= 1e-14 * speed * duration);
          // its derivative is a rounding of the largest term, some wn larger
          CHECK((c.speed == 0 ||
                 std::abs(t.acceleration - c.acceleration) <= 1e-13 * speed * (1 / duration + natural_frequency)));
        }
        const double one = taylor.first_stop(), other = closed.first_stop();
        if (std::min(one, other) < 0.999 * horizon) {
          // at a flat crossing, time is known only as well as the speed allows
          CHECK((one == Approx(other).epsilon(1e-9) || closed.at(std::min(one, other)).speed <= 1e-14 * speed));
        }
      };
      if (natural_frequency == 0) {
        const Polynomial oscillator;
        agree(ClosedForm<Polynomial>(oscillator, start, duration));
      } else {
        const Harmonic oscillator(natural_frequency);
        agree(ClosedForm<Harmonic>(oscillator, start, duration));
      }
    }
  }
}

TEST_CASE("a constant law in disguise slides through records as a block does", "[taylor]") {
  for (const double natural_frequency : {0.0, 1.3, 30.0})
    for (const auto interpolation : {Interpolation::linear, Interpolation::constant}) {
      const GroundMotion motion = record_a(interpolation);
      const Response block = integrate(Slider(Coulomb(1), natural_frequency), motion);
      const Response taylor = integrate(Slider(Disguised{1}, natural_frequency), motion);
      CHECK(difference(block.displacement, taylor.displacement) <= 1e-13 * block.peak);
      CHECK(difference(block.velocity, taylor.velocity) <= 1e-13 * largest(block.velocity));
      CHECK(std::abs(block.peak - taylor.peak) <= 1e-13 * block.peak);
      CHECK(count(block.events) == count(taylor.events));
    }
}

TEST_CASE("a caster's flow keeps its energy, from wherever it starts", "[taylor]") {
  // v^2/2 + work + wn^2 x^2/2 less the work of the load is constant along each flow, to the roundings of its terms
  // and of x.
  std::mt19937_64 bits(16);
  std::normal_distribution<double> normal;
  for (const double natural_frequency : {0.0, 1.3}) {
    const double reach = 0.5;
    const Caster law(1, reach);
    const Slider slider(law, natural_frequency);
    for (int i = 0; i < 1000; ++i) {
      const double x = reach * 2 * normal(bits), u = std::abs(normal(bits)), load = 2 * normal(bits),
                   rate = 20 * normal(bits);
      const Direction direction = i % 2 == 0 ? Direction::forward : Direction::backward;
      const double s = sign(direction);
      const double net = s * (load - slider.stiffness() * x) - law.resist(x, direction);
      const TaylorFlow<Caster> flow(slider, direction, x, Start{u, net, rate * 0.5}, 0.5);
      const double stop = flow.first_stop(), t = std::min(stop, flow.horizon());
      const Progress end = flow.at(t);
      const double x1 = x + s * end.distance;
      const double gained = end.speed * end.speed / 2 - u * u / 2 + friction_work(law, x, end.distance, direction) +
                            slider.stiffness() * (x1 * x1 - x * x) / 2;
      const double given = s * load * end.distance + rate * t * (end.distance - end.mean_distance);
      const double terms = u * u + end.speed * end.speed + std::abs(load * end.distance) +
                           std::abs(rate * t * end.distance) + end.distance + law.resist(x, direction) * std::abs(x) +
                           slider.stiffness() * (x * x + x1 * x1);
      CHECK(std::abs(gained - given) <= 2e-15 * terms);
      if (stop <= flow.horizon()) {
        CHECK(end.speed <= 1e-14 * std::sqrt(terms));
      }
    }
  }
}

TEST_CASE("a sum of Taylor steps ends where one of the right length does", "[taylor]") {
  // Cut at random places, a flow is the same flow.
  const Caster law(1, 0.3);
  const Slider slider(law, 0.7);
  State whole = State::at(-0.9, 2.5), parts = whole;
  advance(slider, Segment{0.8, -1, 2}, whole);
  double before = 0;
  for (const double cut : {0.013, 0.2, 0.2000001, 0.55, 0.79, 0.8}) {
    advance(slider, Segment{cut - before, -1 + 3 * before / 0.8, -1 + 3 * cut / 0.8}, parts);
    before = cut;
  }
  CHECK(std::abs(whole.displacement - parts.displacement) <= 1e-14);
  CHECK(std::abs(whole.velocity - parts.velocity) <= 1e-14 * 2.5);
}

namespace {

/// Integrate over a segment in one step, and in `parts` parts; the largest difference of x relative to the distance.
template <class Law>
double apart(const Slider<Law>& slider, const LoadSegment& segment, const State& start, int parts) {
  State one = start, other = start;
  advance(slider, segment, one, NoObserver{}, Contact::clipped);
  for (int i = 0; i < parts; ++i) {
    const double begin = segment.duration * i / parts, end = segment.duration * (i + 1) / parts;
    advance(
        slider,
        LoadSegment{end - begin, segment.load(begin), segment.load(end), segment.normal(begin), segment.normal(end)},
        other, NoObserver{}, Contact::clipped);
  }
  const double way = std::max(std::abs(start.velocity) * segment.duration, std::abs(other.displacement));
  return std::abs(one.displacement - other.displacement) / way;
}

}  // namespace

TEST_CASE("a law that changes at low speeds alone is seen in one long step", "[taylor]") {
  // At a high speed the series shows nothing of the change, and where the normal force vanishes at the end of the step
  // the equation of motion does not either.
  std::mt19937_64 bits(4);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto between = [&](double low, double high) { return low + (high - low) * uniform(bits); };
  const double g = standard_gravity;
  double worst = 0;
  for (int problem = 0; problem < 1500; ++problem) {
    const double kinetic = between(0.5, 1.5), velocity = between(0.01, 0.1), time = between(0.05, 0.3);
    const int exponent = 2 + static_cast<int>(7 * uniform(bits));
    const double frequency = problem % 4 == 0 ? between(1, 12) : 0;
    const double load = between(-2, 1), speed = between(1, 5) * velocity;
    LoadSegment segment{time, load, load + between(-2, 3), g * between(0.7, 1.3), 0};
    // To zero at the end, or below zero, or constant with a load that turns.
    if (problem % 3 == 1) segment.normal_end = -g * between(0, 1);
    if (problem % 3 == 2) segment.normal_end = segment.normal_start, segment.load_end = between(1, 6);
    const State start = State::at(0, speed);
    const Stribeck stribeck(kinetic * between(1.2, 3), kinetic, velocity, exponent);
    const VelocityDependent rising(kinetic * between(0.1, 0.9), kinetic, between(100, 1000));
    worst = std::max(worst, apart(Slider(stribeck, frequency), segment, start, 64));
    worst = std::max(worst, apart(Slider(rising, frequency), segment, start, 64));
  }
  CHECK(worst <= 1e-10);
}
