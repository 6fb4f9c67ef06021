// Flows in closed form: the bases, the first root, the first stop.
#include <array>
#include <utility>

#include "support/catch.hpp"
#include "support/motions.hpp"

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

/// u, a and j: the speed is u + a t + j t^2/2, or its like with a spring.
struct Slip {
  double u, a, j;
};

template <class Oscillator>
ClosedForm<Oscillator> flow_of(const Oscillator& oscillator, const Slip& slip, double duration) {
  return {oscillator, Start{slip.u, slip.a, slip.j * duration}, duration};
}

// The speed, and the scale of its rounding error: its terms, and its possible change with t.
std::pair<Real, Real> speed(Real w, const Slip& slip, Real t) {
  const Real terms[] = {slip.u * exact_basis(0, w, t), slip.a * exact_basis(1, w, t), slip.j * exact_basis(2, w, t)};
  const Real size = std::abs(terms[0]) + std::abs(terms[1]) + std::abs(terms[2]);
  const Real steepest = w > 0 ? std::abs(slip.a) + std::abs(slip.j) / w + w * slip.u : 0;
  return {terms[0] + terms[1] + terms[2], size + t * steepest};
}

// The first stop, accurate to round-off: there the speed is only rounding error, and before it positive.
template <class Oscillator>
void stops_rightly(const Oscillator& oscillator, Real w, const Slip& slip, double duration) {
  const double stop = flow_of(oscillator, slip, duration).first_stop();
  const double until = std::min(stop, duration);
  INFO("u " << slip.u << ", a " << slip.a << ", j " << slip.j << ", duration " << duration << ", stop " << stop);
  bool moving = true, zero = true;
  for (int i = 1; i < 200; ++i) {
    const auto [v, terms] = speed(w, slip, Real(until) * i / 200);
    moving = moving && v >= -1e-15L * terms;
  }
  const auto [v, terms] = speed(w, slip, until);
  if (stop <= duration) {
    zero = std::abs(v) <= 1e-15L * terms;
  } else {
    CHECK(stop == never);
    moving = moving && v >= -1e-15L * terms;
  }
  CHECK(moving);
  CHECK(zero);
}

// b0 to b4 as the flow uses them.
template <class Oscillator>
std::array<double, 5> basis_of(const Oscillator& oscillator, double t) {
  const Progress u = flow_of(oscillator, {1, 0, 0}, t).at_horizon();
  const Progress a = flow_of(oscillator, {0, 1, 0}, t).at_horizon();
  const ClosedForm<Oscillator> push(oscillator, Start{0, 0, 1}, t);  // b2/t, b3/t, b4/t^2
  return {u.speed, a.speed, a.distance, push.at_horizon().distance * t, push.at_horizon().mean_distance * t * t};
}

}  // namespace

TEST_CASE("without a spring the basis is 1, t, t^2/2, t^3/6, t^4/24", "[closed_form]") {
  for (const double t : {1e-9, 0.1, 3.0, 1e6}) {
    const auto b = basis_of(polynomial, t);
    for (std::size_t k = 0; k <= 4; ++k) {
      const double exact = static_cast<double>(exact_basis(static_cast<int>(k), 0, t));
      CHECK(std::abs(b[k] - exact) <= 1e-15 * exact);
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
        const auto b = basis_of(Harmonic(w, kept), wt / w);
        double bound = 1;
        for (std::size_t k = 0; k <= 4; ++k) {
          if (k > 0) bound *= wt / w / static_cast<double>(k);
          INFO("w " << w << ", w t " << wt << ", k " << k);
          const double exact = static_cast<double>(exact_basis(static_cast<int>(k), w, static_cast<Real>(wt / w)));
          CHECK(std::abs(b[k] - exact) <= 4e-15 * bound * (k == 0 ? std::max(1.0, wt) : 1.0));
        }
      }
}

TEST_CASE("a slow spring has the basis of none", "[closed_form]") {
  const auto slow = basis_of(Harmonic(1e-9), 0.7), none = basis_of(polynomial, 0.7);
  for (std::size_t k = 0; k <= 4; ++k) CHECK(std::abs(slow[k] - none[k]) <= 1e-15 * none[k]);
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
    stops_rightly(polynomial, 0, {u, a, j}, std::exp(2 * normal(bits)));
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
    stops_rightly(Harmonic(w), w, {u, a, j}, 6 / w * std::exp(normal(bits)));
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
  // v = j (1 - cos w t) / w^2 touches zero after each period and rises again.
  const Harmonic oscillator(50);
  const auto flow = flow_of(oscillator, {0, 0, 1}, 1);
  CHECK(flow.first_stop() == never);
  CHECK(std::abs(flow.at(1).distance - (1 - std::sin(50.0) / 50) / 2500) <= 1e-18);
}

TEST_CASE("distance, speed and acceleration are each the integral of the next", "[closed_form]") {
  // Gauss-Legendre of three points over a step of 2^-6: exact to the sixth order.
  const double h = 0x1p-6, g = std::sqrt(0.6) * h / 2;
  const auto check = [&](const auto& flow) {
    for (double t = h; t < 1; t += h) {
      const auto left = flow.at(t), right = flow.at(t + h);
      const auto one = flow.at(t + h / 2 - g), two = flow.at(t + h / 2), three = flow.at(t + h / 2 + g);
      const auto integral = [&](auto member) {
        return h * (5 * one.*member + 8 * two.*member + 5 * three.*member) / 18;
      };
      CHECK(std::abs(right.distance - left.distance - integral(&Progress::speed)) <= 1e-14);
      CHECK(std::abs(right.speed - left.speed - integral(&Progress::acceleration)) <= 1e-14);
      CHECK(std::abs(right.mean_distance * (t + h) - left.mean_distance * t - integral(&Progress::distance)) <= 1e-14);
    }
  };
  check(flow_of(polynomial, {1, -0.3, 0.7}, 1));
  const Harmonic oscillator(1.5);
  check(flow_of(oscillator, {1, -0.3, 0.7}, 1));
}
