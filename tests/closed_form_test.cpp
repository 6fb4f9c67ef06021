// Flows in closed form: the bases, the first root, the first stop.
#include <numbers>

#include "catch.hpp"
#include "motions.hpp"

using namespace stickslip;
using namespace test;

namespace {

using Real = long double;

constexpr Polynomial polynomial;  // flows refer to their oscillator

// b_k = t^k (1/k! - z/(k+2)! + z^2/(k+4)! - ...), z = (w t)^2, for moderate w t; else by sine and cosine.
Real exact_basis(int k, Real w, Real t) {
  const Real z = w * w * t * t;
  if (z < 30) {
    Real term = 1, sum = 0;
    for (int i = 1; i <= k; ++i) term *= t / i;
    for (int i = k; i < 80; i += 2) sum += term, term *= -z / ((i + 1) * (i + 2));
    return sum;
  }
  const Real c = std::cos(w * t), s = std::sin(w * t), w2 = w * w;
  const Real values[] = {c, s / w, (1 - c) / w2, (t - s / w) / w2, (t * t / 2 - (1 - c) / w2) / w2};
  return values[k];
}

double member(const Basis& b, int k) {
  const double values[] = {b.b0, b.b1, b.b2, b.b3, b.b4};
  return values[k];
}

// The speed u + a t + j t^2/2 (or its like with a spring), and what its rounding is measured by: its terms, and how
// much it could change in t.
template <class Oscillator>
std::pair<Real, Real> speed(const Oscillator& oscillator, const Start& start, Real t) {
  const Real w = std::sqrt(Real(oscillator.stiffness()));
  const Real terms[] = {start.speed * exact_basis(0, w, t), start.acceleration * exact_basis(1, w, t),
                        start.load_rate * exact_basis(2, w, t)};
  const Real size = std::abs(terms[0]) + std::abs(terms[1]) + std::abs(terms[2]);
  const Real steepest = w > 0 ? std::abs(start.acceleration) + std::abs(start.load_rate) / w + w * start.speed : 0;
  return {terms[0] + terms[1] + terms[2], size + t * steepest};
}

// The first stop, true to round-off: there the speed is nothing but rounding, and before it positive.
template <class Oscillator>
void stops_rightly(const Oscillator& oscillator, const Start& start, double duration) {
  const ClosedForm<Oscillator> flow(oscillator, start, duration);
  const double stop = flow.first_stop();
  const double until = std::min(stop, duration);
  INFO("u " << start.speed << ", a " << start.acceleration << ", j " << start.load_rate << ", duration " << duration
            << ", stop " << stop);
  bool moving = true, zero = true;
  for (int i = 1; i < 200; ++i) {
    const auto [v, terms] = speed(oscillator, start, Real(until) * i / 200);
    moving = moving && v >= -1e-15L * terms;
  }
  if (stop <= duration) {
    const auto [v, terms] = speed(oscillator, start, stop);
    zero = std::abs(v) <= 1e-15L * terms;
  } else {
    CHECK(stop == never);
    moving = moving && speed(oscillator, start, duration).first >= -1e-15L * speed(oscillator, start, duration).second;
  }
  CHECK(moving);
  CHECK(zero);
}

}  // namespace

TEST_CASE("the polynomial basis is 1, t, t^2/2, t^3/6, t^4/24", "[closed_form]") {
  for (const double t : {0.0, 1e-9, 0.1, 3.0, 1e6}) {
    const Basis b = Polynomial::basis(t);
    for (int k = 0; k <= 4; ++k) {
      const double exact = static_cast<double>(exact_basis(k, 0, t));
      CHECK(std::abs(member(b, k) - exact) <= 4e-16 * exact);
    }
  }
}

TEST_CASE("the harmonic basis is right to round-off, for short times and for many periods", "[closed_form]") {
  // |b_k| <= t^k/k!. Where sines are used, w t > 1.4 and their arguments' rounding, 1.1e-16 w t, is at most
  // 1.1e-16 t^k in b_k; k! makes it 24 of the bound.
  for (const double w : {1e-6, 0.3, 1.3, 50.0, 1e4})
    for (const double wt :
         {1e-12, 1e-6, 1e-3, 0.1, 0.5, 1.0, 1.41, 1.42, 2.0, 3.0, 3.1415926, 5.0, 6.2831853, 50.0, 1e3})
      for (const double kept : {not_a_number, wt / w}) {
        const Harmonic oscillator(w, kept);
        const Basis b = oscillator.basis(wt / w);
        double bound = 1;
        for (int k = 0; k <= 4; ++k) {
          if (k > 0) bound *= wt / w / k;
          INFO("w " << w << ", w t " << wt << ", k " << k);
          const double exact = static_cast<double>(exact_basis(k, w, static_cast<Real>(wt / w)));
          CHECK(std::abs(member(b, k) - exact) <= 4e-15 * bound * (k == 0 ? std::max(1.0, wt) : 1.0));
        }
      }
}

TEST_CASE("a slow spring has the polynomial's basis", "[closed_form]") {
  const Basis slow = Harmonic(1e-9).basis(0.7), none = Polynomial::basis(0.7);
  for (int k = 0; k <= 4; ++k) CHECK(std::abs(member(slow, k) - member(none, k)) <= 2e-16 * member(none, k));
}

TEST_CASE("the first root of a speed lies ahead, or round by infinity, or nowhere", "[closed_form]") {
  CHECK(first_root(1, -1, 0) == 1);                 // 1 - y
  CHECK(first_root(2, -3, 2) == 1);                 // 2 - 3 y + y^2
  CHECK(first_root(1, -2, 2) == 1);                 // (1 - y)^2: a graze
  CHECK(std::isnan(first_root(1, -2, 2 + 1e-15)));  // just misses zero
  CHECK(first_root(1, -2, 2 - 0x1p-50) <= 1);       // just passes it
  CHECK(first_root(0, 1, -1) == 2);                 // y - y^2/2
  CHECK(first_root(2, 3, 2) == -2);                 // (1 + y)(2 + y): from minus infinity, -2 comes first
  CHECK(first_root(1, 1, -4) == 1);                 // 1 + y - 2 y^2
  CHECK(std::abs(first_root(1e-300, 1e-300, -4e-300) - 1) <= 1e-15);
  CHECK(std::abs(first_root(1e300, 1e300, -4e300) - 1) <= 1e-15);
  CHECK(std::abs(first_root(1e-20, -1, 1e-3) - 1e-20) <= 1e-35);  // no cancellation
  CHECK(std::abs(first_root(1e-20, 1, -1) - 2) <= 1e-15);
}

TEST_CASE("a slip without a spring stops where its speed first comes to zero", "[closed_form]") {
  std::mt19937_64 bits(12);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 3000; ++i) {
    const double u = i % 5 == 0 ? 0 : std::abs(normal(bits)) * std::exp(3 * normal(bits));
    const double a = i % 7 == 0 ? 0 : u == 0 ? std::abs(normal(bits)) : normal(bits);
    const double j = i % 11 == 0        ? 0
                     : u == 0 && a == 0 ? std::abs(normal(bits))
                                        : normal(bits) * std::exp(normal(bits));
    stops_rightly(polynomial, Start{u, a, j}, std::exp(2 * normal(bits)));
  }
}

TEST_CASE("a slip on a spring stops where its speed first comes to zero, were it after several periods",
          "[closed_form]") {
  std::mt19937_64 bits(13);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 3000; ++i) {
    const double w = std::exp(2 * normal(bits));
    const double u = i % 5 == 0 ? 0 : std::abs(normal(bits));
    const double a = w * (i % 7 == 0 ? 0 : u == 0 ? std::abs(normal(bits)) : normal(bits));
    const double j = w * w * (i % 11 == 0 ? 0 : u == 0 && a == 0 ? std::abs(normal(bits)) : 2 * normal(bits));
    stops_rightly(Harmonic(w), Start{u, a, j}, 6 / w * std::exp(normal(bits)));
  }
}

TEST_CASE("a stop next to the end of the time is not lost", "[closed_form]") {
  // u - t at durations around u: the stop is at u or at the end, whichever comes first.
  for (const double u : {0.1, 0.3, 1.0, 7.0})
    for (const double duration : {std::nextafter(u, 0), u, std::nextafter(u, 10)}) {
      const ClosedForm<Polynomial> flow(polynomial, Start{u, -1, 0}, duration);
      const double stop = flow.first_stop();
      CHECK((stop <= duration || flow.at(duration).speed > 0));
    }
}

TEST_CASE("a slip that has no push does not begin", "[closed_form]") {
  CHECK(ClosedForm<Polynomial>(polynomial, Start{0, -1, 5}, 1).first_stop() == 0);
  CHECK(ClosedForm<Polynomial>(polynomial, Start{0, 0, 0}, 1).first_stop() == 0);
  CHECK(ClosedForm<Polynomial>(polynomial, Start{0, 0, -1}, 1).first_stop() == 0);
  CHECK(ClosedForm<Polynomial>(polynomial, Start{0, 0, 1}, 1).first_stop() == never);
}

TEST_CASE("a steady push against a spring never stops, whole periods long", "[closed_form]") {
  // v = j (1 - cos w t) / w^2 touches zero after each period and goes on.
  const Harmonic oscillator(50);
  const ClosedForm<Harmonic> flow(oscillator, Start{0, 0, 1}, 1);
  CHECK(flow.first_stop() == never);
  CHECK(std::abs(flow.at(1).distance - (1 - std::sin(50.0) / 50) / 2500) <= 1e-18);
}

TEST_CASE("distance, speed, acceleration and area are each the integral of the next", "[closed_form]") {
  // Gauss-Legendre of three points over a step of 2^-6: exact to the sixth order.
  const double h = 0x1p-6, g = std::sqrt(0.6) * h / 2;
  const auto check = [&](const auto& flow) {
    for (double t = 0; t < 1; t += h) {
      const auto left = flow.at(t), right = flow.at(t + h);
      const auto one = flow.at(t + h / 2 - g), two = flow.at(t + h / 2), three = flow.at(t + h / 2 + g);
      const auto integral = [&](auto member) {
        return h * (5 * one.*member + 8 * two.*member + 5 * three.*member) / 18;
      };
      CHECK(std::abs(right.distance - left.distance - integral(&Progress::speed)) <= 1e-14);
      CHECK(std::abs(right.speed - left.speed - integral(&Progress::acceleration)) <= 1e-14);
      CHECK(std::abs(right.area - left.area - integral(&Progress::distance)) <= 1e-14);
    }
  };
  const Start start{1, -0.3, 0.7};
  check(ClosedForm<Polynomial>(polynomial, start, 1));
  const Harmonic oscillator(1.5);
  check(ClosedForm<Harmonic>(oscillator, start, 1));
}
